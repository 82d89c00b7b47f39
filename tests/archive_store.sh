#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Writes that go wrong: killed in the middle, two writers, a full disk, a limit on file sizes, read-only folders and
# files; links, and names with special characters. The law: the archive is the old one or the new one, whole, the result
# comes back all the same, and nothing else lies in the folder. Runs on the Maxima of tools/maxima; MAXIMA names another.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"
work=$(mktemp -d) || exit 1
trap 'cd /; [ -z "${mounted-}" ] || umount "$work/small"; chattr -i "$work/folder" 2>/dev/null; chmod -R u+w "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1

cat >head <<'END'
# the pendulum of these tests
dynarch = 1
kind = equations

[system]
variables = [x]
equations = [x' = x]
END

fresh() { mkdir -p folder && rm -rf folder/* folder/.??* && cp head folder/a.txt; }

# maxima COMMANDS: runs them after the helpers; the log is in the file log.
maxima() {
  timeout -k 5 120 "$here/../tools/maxima" --very-quiet --batch-string="
    load(\"linmodel\")\$ load(core_path(\"tests/archive.lisp\"))\$
    put_result(path, name, size) := block([rows: makelist([k, sin(x)^k], k, 1, size)],
      print(test_save(path, [name], [rows], \"sha256:f\"), length(rows)))\$
    $1" </dev/null >log 2>&1
}

# whole FILE: says whether the archive is whole: it opens, and each result in it is fresh.
whole() {
  maxima "block([sheet: test_open(\"$1\")],
    for name in [\"A\", \"B\"] do print(second(test_result(\"$1\", name, \"sha256:f\"))))\$ print(end_reached)\$"
  grep -q '^end_reached' log && ! grep -q 'stale\|edited\|rror' log && echo whole || { cat log; echo broken; }
}

started_alike() { cmp -s head folder/a.txt && echo yes || echo no; }
files() { ls -A folder | tr '\n' ' '; }

# --- an ordinary write ---

fresh
maxima 'put_result("folder/a.txt", "A", 3)$'
check "the result is written" "$(grep -c '^true 3' log)" 1
check "nothing else lies in the folder" "$(files)" "a.txt "
check "the description is unchanged" "$(head -c "$(wc -c <head)" folder/a.txt | cmp - head && echo same)" same

# --- killed: at many moments of a loop of writes ---

fresh
maxima 'for k thru 3 do put_result("folder/a.txt", "A", 200)$' # the loop in earnest begins when everything is compiled
broken=0
for moment in 1 2 3 4 5 6; do
  fresh
  { maxima 'print(loop_begins)$ for k do put_result("folder/a.txt", "A", 50 + mod(k, 400))$'; } &
  loop=$!
  n=0
  until grep -q loop_begins log 2>/dev/null || [ $n -ge 300 ]; do n=$((n + 1)); sleep 0.1; done
  sleep "0.$((moment * 7 + 31))"
  # the Lisp itself, a child of tools/maxima and timeout: found by the folder it works in
  for process in /proc/[0-9]*; do
    [ "$(readlink "$process/cwd" 2>/dev/null)" = "$work" ] || continue
    case $(tr '\0' ' ' <"$process/cmdline" 2>/dev/null) in
      *put_result*) kill -KILL "${process#/proc/}" 2>/dev/null ;;
    esac
  done
  wait $loop 2>/dev/null
  [ "$(whole folder/a.txt | tail -n 1)" = whole ] || broken=$((broken + 1))
  head -c "$(wc -c <head)" folder/a.txt | cmp -s - head || broken=$((broken + 1))
done
check "killed six times: archives that broke" "$broken" 0
cp head folder/.dynarch-draft # as a writer leaves it that dies in the middle
maxima 'put_result("folder/a.txt", "A", 3)$ print(?lisp\-implementation\-type())$'
grep -q SBCL log && check "the draft of a writer that died is gone" "$(files)" "a.txt "

# --- two writers, each its own result, forty times ---

fresh
cp log log.before
writer() {
  timeout -k 5 200 "$here/../tools/maxima" --very-quiet --batch-string="
    load(\"linmodel\")\$ load(core_path(\"tests/archive.lisp\"))\$
    for k thru 40 do print(test_save(\"folder/a.txt\", [\"$1\"], [k], \"sha256:f\"))\$" </dev/null >"log.$1" 2>&1
}
writer A &
first=$!
writer B &
second=$!
wait $first $second
check "two writers: all writes done" "$(cat log.A log.B | grep -c '^true')" 80
check "two writers: both results stand, the last ones" \
  "$(grep -c '^value = 40$' folder/a.txt)" 2
check "two writers: the archive is whole" "$(whole folder/a.txt | tail -n 1)" whole
check "two writers: nothing else lies in the folder" "$(files)" "a.txt "

# --- a limit on file sizes: SIGXFSZ must not kill, and leaves nothing behind ---

fresh
maxima 'print(ready)$' # compiled already: the limit is for the archive alone
( ulimit -f 4; maxima 'put_result("folder/a.txt", "A", 2000)$ print(end_reached)$' 2>/dev/null )
check "a size limit: the session goes on" "$(grep -c '^end_reached' log)" 1
check "a size limit: a warning" "$(grep -c 'warning: the result is not saved.*disk is full, or a limit' log)" 1
check "a size limit: the archive is the old one" "$(started_alike)" yes
check "a size limit: nothing is left behind" "$(files)" "a.txt "

# --- a full disk ---

mkdir small
if mount -t tmpfs -o size=64k tmpfs "$work/small" 2>/dev/null; then
  mounted=yes
  cp head small/a.txt
  maxima 'put_result("small/a.txt", "A", 4000)$ print(end_reached)$'
  check "a full disk: a warning, and the session goes on" "$(grep -c 'warning: the result is not saved.*disk is full\|^end_reached' log)" 2
  check "a full disk: the archive is the old one" "$(cmp small/a.txt head && echo same)" same
  check "a full disk: nothing is left behind" "$(ls -A small | tr '\n' ' ')" "a.txt "
  umount "$work/small" && mounted=
else
  echo "no full disk here: it needs the right to mount a small one"
fi

# --- a folder and a file that are read-only ---

read_only() { # WHAT
  maxima 'put_result("folder/a.txt", "A", 3)$ print(end_reached)$'
  check "$1: a warning, and the session goes on" "$(grep -c 'warning: the result is not saved\|^end_reached' log)" 2
  check "$1: the archive is the old one" "$(started_alike)" yes
  check "$1: nothing is left behind" "$(files)" "a.txt "
}

fresh
if [ "$(id -u)" != 0 ]; then
  chmod a-w folder
  read_only "a read-only folder"
  chmod u+w folder
  chmod a-w folder/a.txt
  read_only "a read-only file"
  chmod 0 folder/a.txt
  maxima 'Lagrangian("folder/a.txt")$'
  check "a file that may not be read" "$(grep -c '^Lagrangian: folder/a.txt cannot be read: ' log)" 1
  chmod 640 folder/a.txt
elif chattr +i folder 2>/dev/null; then
  read_only "a folder that cannot be changed"
  chattr -i folder
else
  echo "no read-only folder here: root writes into every one"
fi

# --- links are followed, permissions kept ---

fresh
ln -s folder/a.txt link.txt
chmod 640 folder/a.txt
maxima 'put_result("link.txt", "A", 3)$'
check "a link stays a link" "$([ -L link.txt ] && echo yes)" yes
check "what the link leads to is written" "$(grep -c '^value = ' folder/a.txt)" 1
check "permissions stay" "$(stat -c %a folder/a.txt)" 640
rm link.txt

# a hard link cannot be kept by a file that takes another's name at one stroke: nothing is written
fresh
ln folder/a.txt other.txt
maxima 'put_result("folder/a.txt", "A", 3)$ print(end_reached)$'
check "a hard link: a warning, and the session goes on" \
  "$(grep -c 'warning: the result is not saved.*hard link\|^end_reached' log)" 2
check "a hard link: one file still, as it was" "$(started_alike) $(stat -c %h folder/a.txt)" "yes 2"
rm other.txt

# --- names with characters that mean something to Lisp or the shell ---

odd_name() { # NAME
  mkdir -p "odd/$(dirname -- "$1")" && cp head "odd/$1"
  maxima "put_result(\"odd/$1\", \"A\", 3)\$"
  check "the name $1" "$(grep -c '^value = ' "odd/$1") $(find odd -type f | wc -l)" "1 1"
  rm -rf odd
}

odd_name 'with a blank.txt'
odd_name 'a;b&c.d.e'
odd_name 'no_type'
odd_name "$(printf 'M\303\251canique/\316\250.txt')"
case $(maxima ':lisp (format t "~a~%" (lisp-implementation-type))'; cat log) in
  *SBCL*)
    odd_name 'a[1]*?.txt'
    odd_name 'folder[1]/{x} ~.txt'
    ;;
esac

summary
