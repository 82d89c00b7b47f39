#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# The dialog by piped input: a whole description, answers put right, the end of input, a file that exists.

case $0 in */*) cd "${0%/*}/.." ;; esac
repository=$PWD
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
passed=0 failed=0

# expect NAME STATUS: counts one case
expect() {
  if [ "$2" -eq 0 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "FAILED dialog: $1"; sed 's/^/    /' answer | tail -n 25; fi
}

# ask CALL: hands the answers on standard input to a session that makes the call
ask() {
  { printf 'load("linmodel")$ load("circuits")$ display2d: false$\n%s;\n' "$1"; cat; } |
    timeout -k 5 120 "$repository/tools/maxima" --very-quiet >answer 2>&1
}

pendulum() {
  cat <<'END'
1
[phi, theta]
[m > 0, l > 0, g > 0];



constant
[0, 0, -g]
.

[3, 1]
[phi, theta]


[0, 0, l]
m
[[m*l^2, 0, 0], [0, m*l^2, 0], [0, 0, 0]]
.




spherical pendulum
END
}

{ pendulum; echo; echo; } | ask 'Lagrangian()'
[ -f mechanical.txt ] && grep -q 'title = "spherical pendulum"' mechanical.txt && grep -q '^\[result Lagrangian\]' mechanical.txt
expect 'a whole description is written with its result' $?
grep -q "Lagrangian(\"mechanical.txt\");" answer
expect 'the call that repeats the run is shown' $?
tr -d ' \n' <answer | grep -q "sin(theta)^2"
expect 'the answer is shown' $?
grep -q "2  system: bodies = 1" answer && grep -q "body 1: mass = m" answer
expect 'the description is echoed' $?

rm -f mechanical.txt
{ printf 'two\n?\n1;\nphi theta\n'; pendulum | tail -n +2; printf '99\n2\n1\n\nother.txt\n'; } | ask 'Lagrangian()'
[ -f other.txt ] && [ ! -f mechanical.txt ] && grep -q 'a positive integer' answer && grep -q 'column 5' answer &&
  tr -s ' \n' ' ' <answer | grep -q 'end of the value. Type a list of names, such as'
expect 'wrong answers are explained and asked again' $?

rm -f other.txt
pendulum | head -n 9 | ask 'Lagrangian()'
[ -z "$(ls | grep -v answer)" ] && grep -q 'input ended' answer
expect 'the end of input leaves nothing behind' $?

echo 'mine' >mechanical.txt
{ pendulum; echo; echo; echo no; echo new.txt; } | ask 'Lagrangian()'
[ "$(cat mechanical.txt)" = mine ] && [ -f new.txt ]
expect 'a file is not replaced without yes' $?
{ pendulum; echo; echo; echo yes; } | ask 'Lagrangian()'
grep -q 'coordinates = \[phi, theta\]' mechanical.txt
expect 'a file is replaced after yes' $?

# an item passed over is given by its key; what the function itself finds is said before the file is written
{ pendulum; printf 'force_function\nk*theta\nbody 1: axes\n[3, 1, 2]\n8\n[3, 1]\n\nadded.txt\n'; } | ask 'Lagrangian()'
grep -q 'force_function = k\*theta' added.txt && grep -q 'axes has 3 numbers' answer && grep -q '^axes = \[3, 1\]' added.txt
expect 'an item is added by its key, and the description is tried before it is written' $?

# a body, a rotor in it, a frame whose name is explained and refused once, a spring of an angle and one between points:
# what makes no sense beside an answer is not asked
carrier() {
  cat <<'END'
2
[phi]
[m > 0, l > 0, k > 0, J > 0, h, c > 0]
.

[3]
[phi]


[l, 0, 0]
m
.
1
[1]
[chi]
[l, 0, 0]


m
diag(J, 0, 0)



momentum(h)
?
if
arm


[3]
[1/2]
.
?
2
phi
k

c

[1, arm]
[[0, 0, 0], [0, 2*l, 0]]
k
l



gyroscopic pendulum
END
}
rm -f mechanical.txt
{ carrier; echo; echo; } | ask 'Lagrangian()'
grep -q '^rotor = momentum(h)' mechanical.txt && grep -q '^between = \[1, arm\]' mechanical.txt &&
  grep -q '^\[result Lagrangian\]' mechanical.txt && grep -q 'frame.: axes without mass' answer
expect 'a rotor, a frame and springs' $?
rm -f mechanical.txt

circuit() {
  cat <<'END'
[L1 > 0, C1 > 0, R1 > 0]
.
1 -> 2 L L1 i1
1 -> 2 L
2 -> 1 C C1 u1
2 -> 1 R R1




oscillator
END
}
{ circuit; echo; echo; } | ask 'MixedPotential()'
[ -f circuit.txt ] && grep -q '^1 -> 2 L L1 i1' circuit.txt && grep -q '^\[result MixedPotential\]' circuit.txt
expect 'a circuit is asked row by row' $?

# the paper's list on several lines with its full stop: the sign that it implies is said
graph() {
  printf '%s\n' '[L1 > 0, C1 > 0]' '[f1]' '' '' '{{{1, 2}, L1}, {{1, 2}, C1},' '{{1, 2}, f1}}.' . '' '' '' ''
}
rm -f circuit.txt
{ graph; echo; echo; } | ask 'MixedPotential()'
tr -d '\n' <answer | grep -q 'implies sign = generator' && grep -q '^graph = ' circuit.txt && grep -q '^\[result MixedPotential\]' circuit.txt
expect 'a graph as a list, and what it implies' $?

# what is there is shown, kept by Enter and removed by -: the row of a resistor, the parameters
rm -f circuit.txt
{ circuit; printf '%s\n' 4 '' 4 '2 -> 1 R R2' 1 '' 4 - title second '' changed.txt; } | ask 'MixedPotential()'
tr -d '\n' <answer | grep -q 'row (now 2 -> 1 R R1; Enter keeps it, - removes it)' &&
  tr -d '\n' <answer | grep -q 'Parameters, with what is assumed of them (now \[L1 > 0, C1 > 0, R1 > 0\]; Enter keeps' &&
  grep -q '^parameters = \[L1 > 0' changed.txt && [ "$(grep -c -- '->' changed.txt)" = 2 ] && ! grep -q 'R2' changed.txt && grep -q '^title = "second"' changed.txt
expect 'an item is kept by Enter and removed by -' $?
! grep -q '\[\[\]\]' answer && grep -q 'Names of functions left open \[Enter: none\]' answer
expect 'an empty default is none' $?

# a potential without branches
rm -f circuit.txt
{ printf '%s\n' '[L > 0, C > 0, R > 0]' '' '' '' '' '[i = L, u = C]' '-i*u - R*i^2/2' . '' '' '' ''; echo; echo; } | ask 'StateEquations()'
tr -d ' \n' <answer | grep -q "L\*'diff(i,t,1)=(-u)-R\*i" && grep -q '^\[result StateEquations\]' circuit.txt
expect 'a potential with its states alone' $?

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
