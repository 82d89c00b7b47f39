;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The languages of exported programs, C, Fortran, Python and Lisp: how each writes numbers,
;;; operations, assignments and the frame of a routine, and which names a routine cannot have in it.

(in-package :maxima)

(defstruct algebra-language
  name comment        ; name of the language, and what begins a line of comment
  number              ; text of a rational number
  formats             ; operation -> format of its parts
  place               ; text of place k, from 1, of array x, y or z
  assignment          ; format of an assignment
  first-lines         ; function of name, lengths of x, y, z and of the number of parts
  begin end           ; of part k: functions of name and k, or of name, lengths and k
  last-lines)

;;; Numbers: quotients of whole numbers that double-float numbers hold, else the nearest of these.

(defun algebra-exported-number (x whole quotient marker)
  "X by the format WHOLE or QUOTIENT, or as a decimal with MARKER before its exponent."
  (cond ((> (max (abs (numerator x)) (denominator x)) (expt 2 53)) (algebra-double-text x marker))
        ((integerp x) (format nil whole x))
        (t (format nil quotient (numerator x) (denominator x)))))

(defun algebra-double-text (x marker)
  (let* ((*read-default-float-format* 'double-float)
         (text (string-downcase (prin1-to-string (coerce x 'double-float))))
         (mark (position-if #'alpha-char-p text)))
    (format nil "~a~a~a" (subseq text 0 mark) marker (if mark (subseq text (1+ mark)) "0"))))

(defun algebra-c-number (x) (algebra-exported-number x "~d.0" "(~d.0/~d.0)" "e"))
(defun algebra-fortran-number (x) (algebra-exported-number x "(~d.0d0)" "(~d.0d0/~d.0d0)" "d"))
(defun algebra-lisp-number (x) (algebra-exported-number x "~d.0d0" "(/ ~d.0d0 ~d.0d0)" "d"))

;;; Operations. What the languages write alike comes last, so that each can say it differently.

(defparameter *algebra-infix-formats*
  '((:add . "~a + ~a") (:subtract . "~a - ~a") (:negate . "-~a") (:multiply . "~a*~a")
    (:divide . "~a/~a") (:sine . "sin(~a)") (:cosine . "cos(~a)") (:root . "sqrt(~a)")
    (:exponential . "exp(~a)") (:logarithm . "log(~a)") (:arcsine . "asin(~a)")
    (:arccosine . "acos(~a)") (:arctangent . "atan(~a)") (:polar-angle . "atan2(~a, ~a)")
    (:hyperbolic-sine . "sinh(~a)") (:hyperbolic-cosine . "cosh(~a)")
    (:hyperbolic-tangent . "tanh(~a)") (:absolute . "abs(~a)") (:power . "~a**~a")))

(defparameter *algebra-c-formats*
  (append '((:absolute . "fabs(~a)") (:power . "pow(~a, ~a)")
            (:sign . "(double)((~a > 0.0) - (~:*~a < 0.0))"))
          *algebra-infix-formats*))

(defparameter *algebra-fortran-formats*
  (append '((:sign . "merge(0.0d0, sign(1.0d0, ~a), ~:*~a == 0.0d0)")) *algebra-infix-formats*))

(defparameter *algebra-python-formats*
  (append '((:sign . "float((~a > 0.0) - (~:*~a < 0.0))")) *algebra-infix-formats*))

(defparameter *algebra-lisp-formats*
  '((:add . "(+ ~a ~a)") (:subtract . "(- ~a ~a)") (:negate . "(- ~a)")
    (:multiply . "(* ~a ~a)") (:divide . "(/ ~a ~a)")
    (:sine . "(sin ~a)") (:cosine . "(cos ~a)") (:root . "(sqrt ~a)")
    (:exponential . "(exp ~a)") (:logarithm . "(log ~a)") (:arcsine . "(asin ~a)")
    (:arccosine . "(acos ~a)") (:arctangent . "(atan ~a)") (:polar-angle . "(atan ~a ~a)")
    (:hyperbolic-sine . "(sinh ~a)") (:hyperbolic-cosine . "(cosh ~a)")
    (:hyperbolic-tangent . "(tanh ~a)") (:absolute . "(abs ~a)") (:sign . "(signum ~a)")
    (:power . "(expt ~a ~a)")))

(defun algebra-lines (&rest lines) (format nil "~{~a~%~}" lines))

(defun algebra-part-numbers (parts) (loop for k from 1 to parts collect k))

(defparameter *algebra-languages*
  (list
   (make-algebra-language
    :name "c" :comment "//" :number #'algebra-c-number :formats *algebra-c-formats*
    :place (lambda (array k) (format nil "~a[~d]" array (1- k)))
    :assignment "  ~a = ~a;~%"
    :first-lines (lambda (name nx ny nz parts)
                   (declare (ignore name nx ny nz parts))
                   (algebra-lines "#include <math.h>" ""))
    :begin (lambda (name nx ny nz k)
             (declare (ignore nx ny nz))
             (algebra-lines (format nil "static void ~a_~d(const double *x, double *y, double *z)"
                                    name k)
                            "{"))
    :end (lambda (name k) (declare (ignore name k)) (algebra-lines "}" ""))
    :last-lines (lambda (name nx ny nz parts)
                  (format nil
                          "void ~a(const double x[~d], double y[~d])~%{~%  double z[~d];~%~{~a~}}~%"
                          name (max nx 1) (max ny 1) nz
                          (loop for k in (algebra-part-numbers parts)
                                collect (format nil "  ~a_~d(x, y, z);~%" name k)))))
   (make-algebra-language
    :name "fortran" :comment "!" :number #'algebra-fortran-number :formats *algebra-fortran-formats*
    :place (lambda (array k) (format nil "~a(~d)" array k))
    :assignment "  ~a = ~a~%"
    :first-lines (lambda (name nx ny nz parts) (declare (ignore name nx ny nz parts)) "")
    :begin (lambda (name nx ny nz k)
             (algebra-lines (format nil "subroutine ~a_~d(x, y, z)" name k) "  implicit none"
                            (format nil "  double precision, intent(in) :: x(~d)" (max nx 1))
                            (format nil "  double precision, intent(inout) :: y(~d), z(~d)"
                                    (max ny 1) nz)))
    :end (lambda (name k) (algebra-lines (format nil "end subroutine ~a_~d" name k) ""))
    :last-lines (lambda (name nx ny nz parts)
                  (algebra-lines
                   (format nil "subroutine ~a(x, y)" name) "  implicit none"
                   (format nil "  double precision, intent(in) :: x(~d)" (max nx 1))
                   (format nil "  double precision, intent(out) :: y(~d)" (max ny 1))
                   (format nil "  double precision :: z(~d)~{~%  call ~a~}" nz
                           (loop for k in (algebra-part-numbers parts)
                                 collect (format nil "~a_~d(x, y, z)" name k)))
                   (format nil "end subroutine ~a" name))))
   (make-algebra-language
    :name "python" :comment "#" :number #'algebra-c-number
    :formats *algebra-python-formats*
    :place (lambda (array k) (format nil "~a[~d]" array (1- k)))
    :assignment "    ~a = ~a~%"
    :first-lines (lambda (name nx ny nz parts)
                   (declare (ignore name nx ny nz parts))
                   (algebra-lines "from math import (acos, asin, atan, atan2, cos, cosh, exp, log,"
                                  "                  sin, sinh, sqrt, tan, tanh)" "" ""))
    :begin (lambda (name nx ny nz k)
             (declare (ignore nx ny nz))
             (algebra-lines (format nil "def _~a_~d(x, y, z):" name k)))
    :end (lambda (name k) (declare (ignore name k)) (algebra-lines "" ""))
    :last-lines (lambda (name nx ny nz parts)
                  (declare (ignore nx))
                  (format nil "def ~a(x):~%    y = [0.0]*~d~%    z = [0.0]*~d~%~{~a~}    return y~%"
                          name ny nz
                          (loop for k in (algebra-part-numbers parts)
                                collect (format nil "    _~a_~d(x, y, z)~%" name k)))))
   (make-algebra-language
    :name "lisp" :comment ";;;" :number #'algebra-lisp-number
    :formats *algebra-lisp-formats*
    :place (lambda (array k) (format nil "(aref ~a ~d)" array (1- k)))
    :assignment "  (setf ~a ~a)~%"
    :first-lines (lambda (name nx ny nz parts) (declare (ignore name nx ny nz parts)) "")
    :begin (lambda (name nx ny nz k)
             (declare (ignore nx ny nz))
             (algebra-lines (format nil "(defun ~a-~d (x y z)" name k)
                            "  (declare (type (simple-array double-float (*)) x y z)"
                            "           (ignorable x y z))"))
    :end (lambda (name k) (declare (ignore name k)) (algebra-lines "  nil)" ""))
    :last-lines (lambda (name nx ny nz parts)
                  (declare (ignore nx ny))
                  (format nil "(defun ~a (x y)~%  (let ((z (make-array ~d ~a)))~%~{~a~}    y))~%"
                          name nz ":element-type 'double-float"
                          (loop for k in (algebra-part-numbers parts)
                                collect (format nil "    (~a-~d x y z)~%" name k)))))))

(defun algebra-language-named (name)
  (or (find (string-downcase (core-spelling name)) *algebra-languages*
            :key #'algebra-language-name :test #'string=)
      (core-error "the languages are c, fortran, python and lisp, found ~a" (core-spelling name))))

;;; Names that a routine cannot have in its language: words that the language keeps for itself, and
;;; functions of its library that the text of a program calls or that the compiler knows with other
;;; arguments. Letters are small, as in the names of routines.

(defparameter *algebra-elementary-functions*
  '("acos" "acosh" "asin" "asinh" "atan" "atan2" "atanh" "cos" "cosh" "erf" "erfc" "exp" "hypot"
    "log" "log10" "sin" "sinh" "sqrt" "tan" "tanh"))

(defparameter *algebra-c-mathematics*
  (append *algebra-elementary-functions*
          '("cbrt" "ceil" "copysign" "exp2" "expm1" "fabs" "fdim" "floor" "fma" "fmax" "fmin"
            "fmod" "frexp" "ilogb" "ldexp" "lgamma" "llrint" "llround" "log1p" "log2" "logb"
            "lrint" "lround" "modf" "nan" "nearbyint" "nextafter" "nexttoward" "pow" "remainder"
            "remquo" "rint" "round" "scalbln" "scalbn" "tgamma" "trunc"))
  "Functions of math.h; each has siblings whose names end in f and l.")

(defparameter *algebra-c-words*
  (append
   '("alignas" "alignof" "asm" "auto" "bool" "break" "case" "char" "const" "constexpr" "continue"
     "default" "do" "double" "else" "enum" "extern" "false" "float" "for" "goto" "if" "inline"
     "int" "long" "main" "nullptr" "register" "restrict" "return" "short" "signed" "sizeof"
     "static" "struct" "switch" "true" "typedef" "typeof" "union" "unsigned" "void" "volatile"
     "while" "abort" "abs" "calloc" "exit" "free" "gamma" "isinf" "isnan" "j0" "j1" "jn" "labs"
     "linux" "malloc" "memcpy" "memset" "printf" "puts" "realloc" "scanf" "signgam" "strcmp"
     "strlen" "unix" "y0" "y1" "yn")
   (loop for name in *algebra-c-mathematics*
         append (loop for end in '("" "f" "l") collect (concatenate 'string name end)))))

(defparameter *algebra-fortran-words*
  (append *algebra-elementary-functions*
          '("abs" "aint" "anint" "block" "call" "common" "complex" "conjg" "contains" "dble" "dim"
            "do" "dot_product" "double" "else" "end" "entry" "epsilon" "floor" "function" "gamma"
            "huge" "if" "implicit" "index" "int" "integer" "kind" "len" "logical" "main" "matmul"
            "max" "merge" "min" "mod" "module" "none" "precision" "print" "procedure" "product"
            "program" "read" "real" "return" "scale" "sign" "size" "spread" "stop" "subroutine"
            "sum" "tiny" "transpose" "use" "where" "write" "x" "y" "z"))
  "x, y and z are the arguments of the routine itself.")

(defparameter *algebra-python-words*
  (append *algebra-elementary-functions*
          '("and" "as" "assert" "async" "await" "break" "class" "continue" "def" "del" "elif"
            "else" "except" "finally" "for" "from" "global" "if" "import" "in" "is" "lambda"
            "match" "nonlocal" "not" "or" "pass" "raise" "return" "try" "while" "with" "yield"
            "abs" "all" "any" "bool" "complex" "dict" "float" "int" "len" "list" "map" "math" "max"
            "min" "object" "pow" "print" "range" "round" "set" "str" "sum" "super" "tuple" "type"
            "zip")))

(defun algebra-reserved-name-p (name language)
  "Whether NAME cannot be the name of a routine in LANGUAGE; Common Lisp knows its own words."
  (if (string= language "lisp")
      (eq (nth-value 1 (find-symbol (string-upcase name) :common-lisp)) :external)
      (member name (cond ((string= language "c") *algebra-c-words*)
                         ((string= language "fortran") *algebra-fortran-words*)
                         (t *algebra-python-words*))
              :test #'string=)))
