#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Exported programs are compiled and run in each language whose compiler is here, and agree to 1e-13 with the values that
# Maxima finds from the expressions with 40 digits.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/check"
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

cat >make.mac <<'END'
(load("linmodel"), core_require("algebra/export"), 0)$
long: sum(sin(k*x)*cos(y/k - x)/(v + k)^2, k, 1, 80)$
outputs: ['M = matrix([long, -1/3], [x - y, sqrt(x^2 + 2)]), 'f = [long^2 - %pi, -long, 7, x, -2*x*v]]$
program: algebra_program([x, y, v], outputs)$
algebra_export(program, "forces.c", c, false)$
algebra_export(program, "forces.f90", fortran, false)$
algebra_export(program, "forces.py", python, false)$
algebra_export(program, "forces.lisp", lisp, false)$
fpprec: 40$
numbers: flatten([args(rhs(first(outputs))), rhs(second(outputs))])$
numbers: bfloat(subst([x = 3/10, y = -7/5, v = 1/2], numbers))$
stream: openw("expected")$
for e in numbers do printf(stream, "~a~%", ssubst("e", "b", string(e)))$
close(stream)$
END
timeout -k 5 120 "$here/../tools/maxima" --very-quiet -b make.mac >log 2>&1 </dev/null; [ -s expected ] || cat log
outputs=$(wc -l <expected)
check "values" "$outputs" 9

# agree FILE: how many of its lines agree with the expected ones
agree() {
  paste expected "$1" | awk '{ d = $1 - $2; if (d < 0) d = -d; s = $1 < 0 ? -$1 : $1; if (s < 1) s = 1
                               if (NF == 2 && d <= 1e-13*s) n++ } END { print n + 0 }'
}

language() { # NAME COMPILER: runs the rest of the arguments as a command
  name=$1 compiler=$2
  shift 2
  if command -v "$compiler" >/dev/null 2>&1; then
    "$@" >"$name.values" 2>"$name.messages" || cat "$name.messages"
    check "$name" "$(agree "$name.values")" "$outputs"
  else
    echo "not run: $name, there is no $compiler here"
  fi
}

run_c() {
  cat >main.c <<'END'
#include <stdio.h>
void forces(const double x[3], double y[9]);
int main(void)
{
  double x[3] = {0.3, -1.4, 0.5}, y[9];
  forces(x, y);
  for (int k = 0; k < 9; k++) printf("%.17e\n", y[k]);
  return 0;
}
END
  cc -std=c99 -Wall -Werror -O1 forces.c main.c -o c.run -lm && ./c.run
}

run_fortran() {
  cat >main.f90 <<'END'
program main
  implicit none
  double precision :: x(3) = (/ 0.3d0, -1.4d0, 0.5d0 /), y(9)
  integer :: k
  call forces(x, y)
  do k = 1, 9
    print '(ES25.17E3)', y(k)
  end do
end program main
END
  gfortran -O1 forces.f90 main.f90 -o fortran.run && ./fortran.run
}

run_python() {
  python3 -B -c 'from forces import forces
for value in forces([0.3, -1.4, 0.5]): print("%.17e" % value)'
}

run_lisp() {
  sbcl --noinform --non-interactive --no-userinit --eval '(let ((*standard-output* (make-broadcast-stream)) (*error-output* (make-broadcast-stream)))
    (load (compile-file "forces.lisp")))' --eval '(let ((x (make-array 3 :element-type (quote double-float) :initial-contents (list 0.3d0 -1.4d0 0.5d0)))
    (y (make-array 9 :element-type (quote double-float))))
    (loop for value across (funcall (intern "FORCES") x y) do (format t "~a~%" (substitute #\e #\d (princ-to-string value)))))'
}

language c cc run_c
language fortran gfortran run_fortran
language python python3 run_python
language lisp sbcl run_lisp
check "functions of a few hundred assignments" "$(grep -c '^static void' forces.c)" "$(( ($(grep -c '^  [yz]\[.* = ' forces.c) + 299) / 300 ))"
check "head" "$(sed -n 3p forces.c)" "//   x1 = x"
summary
