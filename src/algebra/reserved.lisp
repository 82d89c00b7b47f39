;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Names that a routine of an exported program cannot have in its language: words that the
;;; language keeps for itself, and functions of its library that the text of a program calls or
;;; that the compiler knows with other arguments. Letters are small, as in the names of routines.

(in-package :maxima)

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
