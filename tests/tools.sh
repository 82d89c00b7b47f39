#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# tools/maxima hands on arguments, folder and exit status, and finds the packages from folders with odd names;
# tools/setup, given a distribution of straw, builds once, never leaves half a Maxima, and says what is missing; tools/dist makes a release.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
tools=$here/../tools
. "$here/check"
work=$PWD
cached_home=${XDG_CACHE_HOME:-$HOME/.cache}

program() { cat >"$1" && chmod +x "$1"; }

# --- tools/maxima with a Maxima of straw, which shows what it was given ---

program straw <<'END'
#!/bin/sh
case $1 in
  --version) echo "Maxima ${STRAW_VERSION:-5.47.0}"; exit ;;
  --directories) echo "maxima-imagesdir=/straw/binary-$MAXIMA_LISP"; exit ;;
esac
[ "$1" != -p ] || shift 2
printf '[%s]' "$@"
printf ' %s\n' "$PWD"
exit 7
END
mkdir "a folder"
shown=$(cd "a folder" && XDG_CACHE_HOME=$work/known MAXIMA=$work/straw "$tools/maxima" 'a b' "it's" '' '*' '"q"' --x=1 '\n')
check "exit status" $? 7
check "arguments and folder" "$shown" "[a b][it's][][*][\"q\"][--x=1][\\n] $work/a folder"
STRAW_VERSION=5.45.1 XDG_CACHE_HOME=$work/old MAXIMA=$work/straw "$tools/maxima" >old.log 2>&1
check "too old a Maxima is refused" $? 1
MAXIMA=$work/none "$tools/maxima" >none.log 2>&1
check "no such Maxima" "$(cat none.log)" "dynarch: MAXIMA=$work/none is not a program"

# --- the packages are found from folders with odd names, and by a link ---

odd_folder() {
  mkdir -p "$1" && cp -r "$tools" "$1/tools" && echo 'dummy_found: 42$' >"$1/dummy.mac"
  answer=$("$1/tools/maxima" --very-quiet --batch-string='load("dummy")$ print(answer = dummy_found)$' </dev/null)
  check "in the folder $1" "$(printf '%s\n' "$answer" | tail -n 1)" "answer = 42 "
}

odd_folder "with blanks"
odd_folder "$(printf 'M\303\251canique \316\250')"
odd_folder "brackets [1]"
odd_folder "{a,b} ~ * ?"
ln -s "with blanks/tools/maxima" link
check "by a link" "$(./link --very-quiet --batch-string='load("dummy")$ print(dummy_found)$' </dev/null | tail -n 1)" "42 "
check "without a locale" "$(env -u LANG -u LC_ALL -u LC_CTYPE "$tools/maxima" --very-quiet \
  --batch-string='print(slength("'"$(printf '\303\251')"'"))$' </dev/null | tail -n 1)" "1 "

# --- tools/setup with a distribution of straw: apt-get hands out a source package that builds in no time ---

mkdir bin
program bin/maxima <<'END'
#!/bin/sh
exit 1
END
program bin/gnuplot </dev/null
program bin/sbcl </dev/null
program bin/sudo <<'END'
#!/bin/sh
exit 1
END
program bin/apt-get <<'END'
#!/bin/sh
# Shows the lists that it is given; `update` and `source` work, unless told to fail.
echo "$@" >>"$STRAW/apt.log"
case "$*" in *" ${STRAW_FAILS:-nothing}"*) exit 100 ;; esac
for option; do
  case $option in
    Dir::Etc::SourceParts=*) cat "${option#*=}"/* >"$STRAW/lists" ;;
    Dir::State::Lists=*) : >"${option#*=}/straw_Sources" ;;
  esac
done
case "$*" in *" source "*) cp "$STRAW/maxima_5.47.0.orig.tar.gz" . ;; esac
END
STRAW=$work
PATH=$work/bin:$PATH
DYNARCH_APT_LISTS=$work/apt
export STRAW PATH DYNARCH_APT_LISTS
unset MAXIMA

mkdir -p maxima-5.47.0 apt/sources.list.d
program maxima-5.47.0/configure <<'END'
#!/bin/sh
exit 0
END
cat >maxima-5.47.0/Makefile <<'END'
all:
	echo built >>$(STRAW)/builds
	sleep $${STRAW_SLOW:-1}
	test ! -e $(STRAW)/break
install:
	mkdir -p $(DESTDIR)/dynarch/bin $(DESTDIR)/dynarch/share/info
	cp $(STRAW)/straw $(DESTDIR)/dynarch/bin/maxima
END
tar -czf maxima_5.47.0.orig.tar.gz maxima-5.47.0
echo 'deb [arch=amd64] http://one.example/ stable main' >apt/sources.list
printf 'Types: deb\nURIs: http://two.example/\nSuites: stable\nComponents: main\n' >apt/sources.list.d/two.sources
cp -r apt apt.before

fresh() { # a new cache
  XDG_CACHE_HOME=$work/cache.$1
  export XDG_CACHE_HOME
}

fresh broken
: >break
"$tools/setup" >/dev/null 2>broken.log
check "a build that breaks" $? 1
check "nothing of it is left" "$(ls "$XDG_CACHE_HOME/dynarch" | grep -c maxima)" 0
check "it says what to do" "$(grep -c 'MAXIMA=/path/to/maxima' broken.log)" 1
rm -f break builds
"$tools/setup" >/dev/null 2>&1
check "the next one succeeds" $? 0
"$tools/maxima" x >/dev/null 2>&1
check "and its Maxima runs" $? 7
check "one-line lists" "$(grep -c '^deb-src \[arch=amd64\] http://one.example/ stable main$' lists)" 1
check "deb822 lists" "$(grep -c '^Types: deb deb-src$' lists)" 1
check "the system's lists are as they were" "$(diff -r apt.before apt)" ""

fresh concurrent
rm -f builds
"$tools/setup" >/dev/null 2>&1 & first=$!
"$tools/setup" >/dev/null 2>&1 & second=$!
wait $first; first=$?
wait $second; second=$?
check "two at once succeed" "$first $second" "0 0"
check "and build once" "$(grep -c built builds)" 1

fresh killed
rm -f builds
STRAW_SLOW=60 "$tools/setup" >/dev/null 2>&1 & setup=$!
while [ ! -e builds ]; do sleep 0.1; done
kill -KILL $setup
check "a killed build is no Maxima" "$(ls "$XDG_CACHE_HOME/dynarch" | grep -c '^maxima')" 0

fresh offline
STRAW_FAILS=source "$tools/setup" >/dev/null 2>offline.log
check "no source package" $? 1
check "it names what failed" "$(grep -c 'fetching Maxima.s source package *failed' offline.log)" 1

if [ "$(id -u)" != 0 ]; then
  check "a cache that cannot be written" "$(XDG_CACHE_HOME=/ "$tools/setup" 2>&1)" \
    "dynarch: cannot write in //dynarch (XDG_CACHE_HOME chooses another place)"
fi
XDG_CACHE_HOME=$cached_home

# --- tools/dist: the release of the last commit, where there is a history ---

if git -C "$tools" rev-parse --verify --quiet HEAD >/dev/null 2>&1; then
  release=$("$tools/dist" "$work")
  version=$(sed -n 's/^(defparameter \*core-version\* "\([0-9.]*\)".*/\1/p' "$tools/../src/core/faces.lisp")
  check "the name of the release" "$release" "$work/dynarch-$version.tar.gz"
  check "it holds the packages" "$(tar tzf "$release" | grep -c "^dynarch-$version/[a-z]*\.mac$")" 3
  check "and nothing of the maintainers' machines" "$(tar tzf "$release" | grep -c '/\.')" 0
fi

summary
