#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Compiled Lisp and the built Maxima run with the user's rights. The laws: what is in the cache is used if it is whole, of
# the present text of all rooms a part is built from, and nobody else can have written it; else it is made anew or left
# alone, and one line says why. A planted program shows that the cases can fail: where it may run, it does.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/../tools/find"
. "$here/check"
find_maxima
find_gcl_maxima
user_is_root() { [ "$user" = 0 ]; }

repository=$PWD/copy
mkdir "$repository" && cp -r "$here/../tools" "$here/../src" "$here/../doc" "$here/../linmodel.mac" "$repository"
MAXIMA=$maxima
export MAXIMA
XDG_CACHE_HOME=$PWD/cache
export XDG_CACHE_HOME

start() { # what a start with linmodel says
  timeout -k 5 300 "$repository/tools/maxima" --very-quiet --batch-string='load("linmodel")$ print("loaded")$' </dev/null 2>&1 |
    grep -v '^ *$\|^load(\|^print('
}
start_gcl() { (MAXIMA=$gcl_maxima MAXIMA_LISP=gcl; export MAXIMA MAXIMA_LISP; start); }
why() { sed -n 's/^dynarch: compiled in memory, at every start anew: //p'; }
folder() { echo "$XDG_CACHE_HOME"/dynarch/lisp/SBCL*; }
fresh() { rm -rf "$XDG_CACHE_HOME"; }

# --- files are made for the user alone, whatever his mask, and used ---

first=$(umask 0 && start)
check "the first start says nothing" "$first" "loaded "
check "nobody else may write" "$(find "$XDG_CACHE_HOME/dynarch" -perm /022)" ""
made=$(ls -i "$(folder)")
start >/dev/null
check "the second start makes nothing" "$(ls -i "$(folder)")" "$made"
cp -r "$(folder)" whole

# --- a part is made anew when a room changes that it may be built from, and only then ---

compiled() { ls "$(folder)" | grep -c "^$1-"; }
before="$(compiled core) $(compiled forms) $(compiled linmodel) $(compiled circuits)"
changed() { # ROOM: a change of it makes anew parts of: core forms linmodel circuits
  fresh
  cp -r whole "$PWD/old"
  start >/dev/null
  echo '(defvar *changed-here* nil)' >>"$repository/src/$1/register.lisp"
  start >/dev/null
  echo "$(compiled core) $(compiled forms) $(compiled linmodel) $(compiled circuits)"
  sed -i '$d' "$repository/src/$1/register.lisp"
  rm -rf old
}
twice() { for count; do printf '%s ' $((count * 2)); done; }
set -- $before
check "forms: also what is built upon it" "$(changed forms)" "$1 $(($2 * 2)) $(($3 * 2)) $(($4 * 2))"
check "linmodel: itself alone" "$(changed linmodel)" "$1 $2 $(($3 * 2)) $4"
check "core: all" "$(changed core) " "$(twice $before)"

# --- a broken file, and one that others could have written, is replaced ---

fresh
start >/dev/null
one() { echo "$(folder)"/core-messages-*; }
size=$(wc -c <"$(one)")
replaced() { # WHAT: the file is as it was made, the start works, and the next one makes nothing
  check "$1: it starts" "$(start)" "loaded "
  check "$1: replaced" "$(wc -c <"$(one)") $(find "$(one)" -perm /022 -o -type l)" "$size "
  made=$(ls -i "$(folder)")
  start >/dev/null
  check "$1: for good" "$(ls -i "$(folder)")" "$made"
}
: >"$(one)"
replaced "an empty file"
head -c $((size / 2)) "$(one)" >half && cat half >"$(one)"
replaced "half a file"
head -c 4000 /dev/zero >"$(one)"
replaced "another file"
chmod g+w "$(one)"
replaced "a file that the group may write"
mv "$(one)" elsewhere && ln -s "$PWD/elsewhere" "$(ls whole/core-messages-* | sed "s|^whole|$(folder)|")"
replaced "a link"
if user_is_root; then
  chown 65534 "$(one)"
  replaced "a file of another user"
fi

# --- a folder that others may write in, or of another user, or a link ---

plant() { # the part that is loaded first is now one that leaves the file `ran'
  echo "(with-open-file (out \"$PWD/ran\" :direction :output :if-exists :append :if-does-not-exist :create) (print 1 out))" >plant.lisp
  "$repository/tools/maxima" --very-quiet --batch-string=':lisp (compile-file "plant.lisp")
' </dev/null >/dev/null 2>&1
  cat plant.fasl >"$(one)"
}
not_run() { # WHAT FOLDER
  rm -f ran
  said=$(start | why)
  check "$1: why" "${said%% *}" "$2"
  check "$1: one line" "$(printf '%s\n' "$said" | wc -l)" 1
  check "$1: not run" "$(ls ran 2>&1 | grep -c '^ran')" 0
}
plant
start >/dev/null
check "the planted file runs where it may" "$(ls ran)" ran
top=$XDG_CACHE_HOME
for place in "$top" "$top/dynarch" "$top/dynarch/lisp" "$(folder)"; do
  fresh
  start >/dev/null
  plant
  chmod o+w "$place"
  not_run "others may write in ${place#"$PWD"/}" "$place"
  [ -z "$gcl_maxima" ] || check "on GCL too" "$(start_gcl | why | sed 's/ .*//')" "$([ "$place" = "$(folder)" ] || echo "$place")"
  chmod o-w "$place"
  user_is_root || continue
  chown 65534 "$place"
  not_run "another user's ${place#"$PWD"/}" "$place"
  chown 0 "$place"
done
mv "$top/dynarch/lisp" elsewhere.lisp && ln -s "$PWD/elsewhere.lisp" "$top/dynarch/lisp"
not_run "a link" "$top/dynarch/lisp"
fresh

# --- no home, and names with odd letters ---

check "no home, no cache" "$(unset HOME XDG_CACHE_HOME; start | why)" "HOME is not set; set HOME or XDG_CACHE_HOME"
XDG_CACHE_HOME="$PWD/a [1]*? {b,c}~"
made=$(start)
check "odd letters: it starts" "$made" "loaded "
check "odd letters: and is kept" "$(ls "$(ls -d "$XDG_CACHE_HOME"/dynarch/lisp/SBCL*)" | wc -l)" "$(ls whole | wc -l)"

# --- the Maxima that set-up built ---

unset MAXIMA MAXIMA_PREFIX
mkdir bin && for name in maxima gnuplot sbcl; do printf '#!/bin/sh\nexit 1\n' >bin/$name; done && chmod +x bin/*
printf '#!/bin/sh\nexit 1\n' >bin/apt-get && chmod +x bin/apt-get
PATH=$PWD/bin:$PATH
mkdir -p straw/dynarch/maxima-5.47.0/bin && echo maxima-5.47.0 >straw/dynarch/maxima
printf '#!/bin/sh\necho planted\n' >straw/dynarch/maxima-5.47.0/bin/maxima && chmod 755 straw/dynarch/maxima-5.47.0/bin/maxima
chmod -R go-w straw
XDG_CACHE_HOME=$PWD/straw
tool() { "$repository/tools/maxima" 2>&1 </dev/null | sed -n 's|in /[^;]*|in ..|; s/^dynarch: \([^;]*\);.*/\1/; $p'; }
check "a Maxima in the user's own cache" "$(tool)" planted
for place in straw straw/dynarch straw/dynarch/maxima-5.47.0 straw/dynarch/maxima-5.47.0/bin straw/dynarch/maxima-5.47.0/bin/maxima; do
  chmod o+w $place
  check "not where others may write: $place" "$(tool | cut -c 1-29)" "others than you may write in "
  chmod o-w $place
  user_is_root || continue
  chown 65534 $place
  check "not another user's: $place" "$(tool | cut -c 1-29)" "others than you may write in "
  chown 0 $place
done
check "no home" "$(unset HOME XDG_CACHE_HOME; tool)" "HOME is not set"

summary
