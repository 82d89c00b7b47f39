#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Exported programs are compiled and run in each language whose compiler is here, and agree to 1e-13 with the values that
# Maxima finds with 40 digits from expressions that no program has seen: all functions that a program knows; M and f of
# a chain of bodies with springs, dampers and a rotor, by MassForm.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

cat >make.mac <<'END'
(load("linmodel"), core_require("algebra/program_export"), fpprec: 40)$
write_lines(name, numbers) := block([stream: openw(name)],
  for e in numbers do printf(stream, "~a~%", ssubst("e", "b", string(bfloat(e)))), close(stream))$
export(name, program) := for pair in ['c = "c", 'fortran = "f90", 'python = "py", 'lisp = "lisp"] do
  ExportProgram(program, sconcat(name, ".", rhs(pair)), language = lhs(pair))$
test(name, program, outputs, point) := (
  export(name, program),
  write_lines(sconcat(name, ".x"), map(lambda([x], subst(point, x)), assoc('inputs, program))),
  write_lines(sconcat(name, ".y"), subst(point, outputs)))$

long: sum(sin(k*x)*cos(y/k - x)/(v + k)^2, k, 1, 80)$
elementary: [exp(x*y)*log(v), asin(x) - acos(y/2)*atan(v), atan2(y, -x), sinh(x)*cosh(y) - tanh(v), abs(y)*signum(y), signum(x - v),
  x^(1/3) + v^x + 2^y, max(x, y, v)/min(x, y), sqrt(x^2 + 2), 12345678901234567890123/98765432109876543210987*x]$
outputs: ['M = matrix([long, -1/3], [x - y, sqrt(x^2 + 2)]), 'f = append([long^2 - %pi, -long, 7, x, -2*x*v], elementary)]$
test("forces", algebra_program([x, y, v], outputs), flatten([args(rhs(first(outputs))), rhs(second(outputs))]),
  [x = 3/10, y = -7/5, v = 1/2])$

body(k) := ['parent = k - 1, 'axes = [3, 1], 'angles = [concat(q, 2*k - 1), concat(q, 2*k)], 'joint = if k = 1 then [0, 0, 0] else [0, 1/10, 4/5],
  'mass = 2 + k/3, 'centre = [0, 1/20, 2/5], 'inertia_centre = matrix([1/2, 0, 1/30], [0, 2/5, 0], [1/30, 0, 1/5])]$
chain: append(['kind = 'mechanical, 'bodies = 4, 'coordinates = makelist(concat(q, i), i, 6), 'parameters = [g > 0, k > 0, h],
   'field = 'constant, 'gravity = [0, 0, -g]], makelist(sconcat("body ", k) = body(k), k, 3),
  ["body 4" = ['parent = 3, 'axes = [3], 'angles = [chi], 'rotor = control(h*q1), 'mass = 1, 'inertia = diag_matrix(1/10, 1/10, 1/5)],
   "spring 1" = ['between = [1, 3], 'points = [[1, 0, 0], [0, 0, 1/2]], 'stiffness = k, 'length = 1/2, 'damping = 3/10],
   "spring 2" = ['angle = q3 - q5, 'stiffness = 2*k, 'rest = 1/5, 'damping = 1/10]])$
place: append([g = 981/100, k = 7/2, h = 3/4, 'diff(chi, t) = 11/4, chi = 5/8],
  makelist('diff(concat(q, i), t) = (mod(5*i, 9) - 4)/10, i, 6), makelist(concat(q, i) = (mod(3*i, 7) + 1)/10, i, 6))$
equations: MassForm(chain, form = factored, save = false)$
for pair in ["int.c" = c, "sin.c" = c, "end.f90" = fortran, "sin.f90" = fortran, "lambda.py" = python, "sin.py" = python, "list.lisp" = lisp] do
  ExportProgram(algebra_program([x, y], ['f = [sin(x)*y]]), lhs(pair), language = rhs(pair))$
test("chain", EquationProgram(chain, save = false), flatten([args(first(equations)), second(equations)]), place)$
END
timeout -k 5 300 "$here/../tools/maxima" --very-quiet -b make.mac >log 2>&1 </dev/null; [ -s chain.y ] || cat log
# a name with a folder, relative to the working one
mkdir made
"$here/../tools/maxima" --very-quiet --batch-string='load("linmodel")$ ExportProgram(EquationProgram("spherical_pendulum.txt", save = false), "made/pendulum.c", language = c)$' \
  >made.log 2>&1 </dev/null
check "a file in a folder" "$(find made -type f)" "made/pendulum.c"
if [ -n "${DYNARCH_GCL-}" ]; then
  rm made/pendulum.c
  MAXIMA=$DYNARCH_GCL MAXIMA_LISP=gcl "$here/../tools/maxima" --very-quiet --batch-string='load("linmodel")$
    ExportProgram(EquationProgram("spherical_pendulum.txt", save = false), "made/pendulum.c", language = c)$' >made.log 2>&1 </dev/null
  check "a file in a folder on GCL" "$(find made -type f)" "made/pendulum.c"
fi

check "values" "$(wc -l <forces.y) $(wc -l <chain.y)" "19 56"

# agree FILE EXPECTED: how many of its lines agree with the expected ones
agree() {
  paste "$2" "$1" | awk '{ d = $1 - $2; if (d < 0) d = -d; s = $1 < 0 ? -$1 : $1; if (s < 1) s = 1
                           if (NF == 2 && d <= 1e-13*s) n++ } END { print n + 0 }'
}

# language NAME COMPILER: runs each program by run_NAME, where the compiler is
language() {
  if ! command -v "$2" >/dev/null 2>&1; then
    echo "not run: $1, there is no $2 here, and tools/setup tests could not install it"
    return
  fi
  for program in forces chain; do
    nx=$(wc -l <$program.x) ny=$(wc -l <$program.y)
    "run_$1" $program >"$program.$1.values" 2>"$program.$1.messages" || cat "$program.$1.messages"
    check "$1: $program" "$(agree "$program.$1.values" $program.y)" "$ny"
  done
}

# the inputs, with $2 between them
numbers() { tr '\n' "$2" <"$1.x" | sed 's/.$//'; }

run_c() {
  cat >"$1.main.c" <<END
#include <stdio.h>
void $1(const double x[$nx], double y[$ny]);
int main(void)
{
  double x[$nx] = {$(numbers "$1" ,)}, y[$ny];
  $1(x, y);
  for (int k = 0; k < $ny; k++) printf("%.17e\n", y[k]);
  return 0;
}
END
  cc -std=c99 -Wall -Werror -O1 "$1.c" "$1.main.c" -o "$1.c.run" -lm && "./$1.c.run"
}

run_fortran() {
  cat >"$1.main.f90" <<END
program main
  implicit none
  double precision :: x($nx), y($ny)
  integer :: k
$(awk '{ sub("e", "d"); print "  x(" NR ") = " $1 }' "$1.x")
  call $1(x, y)
  do k = 1, $ny
    print '(ES25.17E3)', y(k)
  end do
end program main
END
  gfortran -O1 "$1.f90" "$1.main.f90" -o "$1.fortran.run" && "./$1.fortran.run"
}

run_python() {
  python3 -B -c "from $1 import $1
for value in $1([$(numbers "$1" ,)]): print('%.17e' % value)"
}

run_lisp() {
  cat >"$1.main.lisp" <<END
(let ((*standard-output* (make-broadcast-stream)) (*error-output* (make-broadcast-stream)))
  (load (compile-file "$1.lisp")))
(let ((x (make-array $nx :element-type 'double-float
                         :initial-contents '($(numbers "$1" ' ' | tr e d))))
      (y (make-array $ny :element-type 'double-float)))
  (loop for value across (funcall (intern (string-upcase "$1")) x y)
        do (format t "~a~%" (substitute #\e #\d (princ-to-string value)))))
END
  sbcl --noinform --non-interactive --no-userinit --load "$1.main.lisp"
}

# reserved NAME COMMAND..: a file named after a reserved word, compiled by COMMAND, where it is
reserved() {
  name=$1
  shift
  command -v "$1" >/dev/null 2>&1 || { echo "not run: $name, there is no $1 here"; return; }
  check "named after a reserved word: $name" "$("$@" 2>&1 && echo compiled)" "compiled"
}
reserved int.c cc -Wall -Werror -c int.c
reserved sin.c cc -Wall -Werror -c sin.c
reserved end.f90 gfortran -c end.f90
reserved sin.f90 gfortran -Wall -Werror -c sin.f90
reserved lambda.py python3 -B -c "compile(open('lambda.py').read(), 'lambda.py', 'exec')"
reserved sin.py python3 -B -c "from sin import program_sin
assert program_sin([0.5, 2.0])[0] > 0.9"
reserved list.lisp sbcl --noinform --non-interactive --no-userinit --eval '(let ((*standard-output* (make-broadcast-stream))) (load "list.lisp"))'

language c cc
language fortran gfortran
language python python3
language lisp sbcl
check "functions of a few hundred assignments" "$(grep -c '^static void' forces.c)" "$(( ($(grep -c '^  [yz]\[.* = ' forces.c) + 299) / 300 ))"
check "head" "$(sed -n 3p forces.c)" "//   x1 = x"
summary
