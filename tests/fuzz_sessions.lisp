;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A random hostile session, for tests/fuzz_sessions.sh. fuzz_session(seed) draws statements that
;;; disturb: options, values, operators, aliases, rules, arrays, properties, share packages; it reads
;;; all of them and the calls first, carries them out, and prints the answers to the calls. The
;;; packages are loaded before the disturbance or after it. The law: the answers are those of
;;; seed 0, which disturbs nothing.

(in-package :maxima)

(defvar *fuzz-state* 1)

(defun fuzz-below (n)
  "A whole number from 0 to N - 1, the same on every Lisp."
  (setq *fuzz-state* (mod (+ (* 6364136223846793005 *fuzz-state*) 1442695040888963407)
                          (expt 2 64)))
  (mod (ash *fuzz-state* -33) n))

(defun fuzz-pick (items) (nth (fuzz-below (length items)) items))

(defparameter *fuzz-calls*                ; without lines of progress, which come when they come
  (mapcar
   (lambda (call) (format nil "~a, progress = false)" (string-right-trim ")" call)))
   '("Lagrangian(\"spherical_pendulum.txt\")"
     "RouthEquations(\"spherical_pendulum.txt\")"
     "InvariantManifolds(\"spherical_pendulum.txt\", extend = [theta])"
     "HamiltonEquations(\"pendulum_lagrangian.txt\")"
     "FirstIntegrals(\"pendulum_lagrangian.txt\")"
     "MassForm(\"chaplygin_sleigh.txt\")"
     "MixedPotential(\"nonlinear_circuit.txt\")"
     "StateEquations(\"nonlinear_circuit.txt\")"
     "Stability(\"equilibria.txt\")"
     "Stability(\"satellite.txt\")"
     "RouthLyapunov(\"lagrange_top.txt\")"
     "PolynomialIntegrals(\"sokolov_e3.txt\", 2)"
     "Equilibria(\"lorenz.txt\")"
     "DiracScheme(\"gauge_rotation.txt\")"
     "EulerPoisson(\"satellite_gyrodyne.txt\")"
     "TransferFunction(\"sallen_key.txt\", v(4), U)"
     "StateEquations(\"linear_pair.txt\", matrices = true)"
     "BranchQuantities(\"flip_flop.txt\")"
     "BraytonMoser(\"tunnel_diode.txt\")"
     "PortHamiltonian(\"gyrator_tanks.txt\")"
     "Simulate(\"van_der_pol.txt\", save = false)"
     "Lagrangian(\"no such file.txt\")")))

(defparameter *fuzz-names*
  '("m" "g" "l" "t" "x" "y" "z" "phi" "theta" "psi" "p" "q" "p_theta" "u1" "u3" "u4" "L" "L1" "R" "C"
    "C1" "E0" "J" "b" "e" "s" "v" "a" "A" "B" "V0" "K" "f" "c1" "th" "lambda" "lambda1" "z1" "n" "k"
    "kind" "mass" "bodies" "axes" "mechanical" "circuit" "auto" "check" "constant"))

(defparameter *fuzz-numbers* '("0" "1" "-1" "2" "7" "1/3" "0.1" "2.5b0" "1e10" "%pi" "sqrt(2)" "%i" "inf"))

(defparameter *fuzz-words*
  '("at" "kind" "of" "with" "names" "rate" "rows" "first" "body" "motion" "order" "lists" "name" "@@"
    "+=" "<<" "->" "|" "~" "=>" "=="))

(defparameter *fuzz-functions*
  '("sin" "cos" "exp" "log" "sqrt" "diff" "abs" "f" "V" "first" "length" "append" "map" "subst" "ratsimp"
    "expand" "lfreeof" "integrate" "determinant" "rhs" "lhs"))

(defparameter *fuzz-packages*
  '("abs_integrate" "to_poly_solve" "simplify_sum" "vect" "linearalgebra" "functs" "lrats" "diag"
    "opsubst" "stringproc" "trigtools" "absimp" "facexp" "ineq" "disol" "scifac" "bernstein" "rducon"
    "ntrig" "atrig1" "spangl" "eigen"))

(defparameter *fuzz-statements*
  ;; ~n a name, ~k a number, ~w a word, ~f a function, ~p a package
  '("~n : ~k" "~n : ~n" "~n : ~f(~n)" "~n[~k] : ~k" "~n[aa] := aa^2" "~n(x) := ~k*x" "~f(x) := ~k*x"
    "~n(x) ::= ~k" "array(~n, 3)" "numerval(~n, ~k)" "defstruct(~n(aa, bb))" "define_variable(~n, ~k, any)"
    "alias(other_~n, ~n)" "alias(~n, other_~n)" "ordergreat(~n)" "orderless(~n)"
    "infix(\"~w\")" "infix(\"~w\", 60, 190)" "prefix(\"~w\")" "postfix(\"~w\")" "nary(\"~w\")" "nofix(\"~w\")"
    "matchfix(\"<<\", \">>\")" "matchfix(\"~w\", \"end\")" "infix(\"~n\")" "prefix(\"~n\")"
    "infix(\"+\", 30, 30)" "infix(\"=\", 200, 200)" "prefix(\"-\", 20)" "nary(\"*\", 10)" "infix(\"^\", 20, 20)"
    "tellsimp(~n^2, ~k)" "tellsimpafter(~n*aa, ~k)" "tellsimpafter(~f(aa), foreign(aa))"
    "tellsimp(~n, ~k)" "tellsimpafter(aa*bb, foreign(aa, bb))" "tellsimpafter(aa + bb, foreign(aa, bb))"
    "tellsimpafter('diff(aa, t), 0)" "tellsimpafter(aa^2, foreign(aa))" "tellsimpafter([aa], aa)"
    "defrule(~n, ~f(aa), aa)" "let(~n, ~k)" "gradef(~f(x), ~k)" "gradef(~n, ~n, ~k)" "depends(~n, ~n)"
    "declare(~n, noun)" "declare(~n, evfun)" "declare(~n, evflag)" "declare(~n, mainvar)" "declare(~n, scalar)"
    "declare(~n, nonscalar)" "declare(~n, bindtest)" "declare(~f, linear)" "declare(~f, multiplicative)"
    "declare(~n, symmetric)" "declare(~n, commutative)" "declare(~n, lassociative)" "declare(~n, outative)"
    "declare(\"#\", alphabetic)" "declare(\"~w\", alphabetic)" "atvalue(~f(x), x = 0, ~k)" "put(~n, ~k, ~n)"
    "tellrat(~n^2 - 2)" "ratvars(~n, ~n, ~n)" "ratweight(~n, 2)" "modulus : 13" "modulus : 7" "ibase : 16"
    "obase : 2" "obase : 30" "fpprec : 5" "fpprec : 60" "linel : 20" "matchdeclare(~n, true)" "load(\"~p\")"
    "load(\"~p\")" "load(\"~p\")" "ratprint : false" "trace(~f)" "setcheck : [~n]"
    "listconstvars : true" "matrix_element_mult : \"+\"" "matrix_element_add : \"*\"" "gcd : false"
    "display2d : false" "domain : complex" "assumescalar : all" "ratepsilon : 1" "maxapplydepth : 1"
    "dotexptsimp : false" "transpose_flag : ~n" "simp : false" "errexp1 : 1" "expop : 3" "expon : 3"
    "triginverses : all" "halfangles : true" "exponentialize : true" "demoivre : true" "trigexpand : true"
    "radexpand : all" "logexpand : super" "m1pbranch : true" "factlim : 1" "inflag : true" "powerdisp : true"
    "piece : ~k" "%rnum : 7" "labels : []" "remvalue(all)" "kill(~f)" "dispflag : false" "breakup : false"))

(defun fuzz-filled (template)
  (with-output-to-string (out)
    (loop with i = 0 while (< i (length template))
          for c = (char template i)
          do (cond ((char= c #\~)
                    (incf i)
                    (write-string
                     (fuzz-pick (ecase (char template i)
                                  (#\n *fuzz-names*) (#\k *fuzz-numbers*) (#\w *fuzz-words*)
                                  (#\f *fuzz-functions*) (#\p *fuzz-packages*)))
                     out))
                   (t (write-char c out)))
             (incf i))))

(defun fuzz-read (text)
  (with-input-from-string (in (concatenate 'string text "$")) (caddr (mread in nil))))

(defun fuzz-flags ()
  "Options of Maxima whose default is true or false, but those that end or silence the session."
  (let ((names '()))
    (maphash (lambda (name default)
               (when (and (char= (char (string name) 0) #\$) (member default '(t nil)) (boundp name)
                          (not (member name '($true $ttyoff $debugmode $batch_answers_from_file $showtime
                                              $noundisp $transrun $errormsg $setcheckbreak)))
                          (not (get name 'assign)))
                 (push name names)))
             *variable-initial-values*)
    (sort names #'string<)))

(defun fuzz-turned-flag ()
  (let ((name (fuzz-pick (fuzz-flags))))
    (list (format nil "~a turned" name)
          `((msetq) ,name ,(not (gethash name *variable-initial-values*))))))

(defun fuzz-statement ()
  "A text and the statement read."
  (if (zerop (fuzz-below 3))
      (fuzz-turned-flag)
      (let ((text (fuzz-filled (fuzz-pick *fuzz-statements*))))
        (list text (fuzz-read text)))))

(defun fuzz-load-packages ()
  (dolist (package '("linmodel" "circuits" "analysis")) (mfuncall '$load package)))

(defun fuzz-disturb (statements)
  (loop for (text statement) in statements
        do (format t "~&hostile: ~a~%" text)
           (let ((*standard-output* (make-broadcast-stream))) (errcatch (meval statement)))))

(defun $fuzz_session (seed)
  "Disturbs the session as SEED says, prints the answers to the calls, and ends Maxima."
  (setq *fuzz-state* (+ (* 7919 seed) 17))
  (let* ((early (evenp (fuzz-below 2)))
         (calls (mapcar #'fuzz-read *fuzz-calls*))
         (statements (and (plusp seed) (loop repeat (+ 1 (fuzz-below 12)) collect (fuzz-statement)))))
    (when early (fuzz-load-packages))
    (fuzz-disturb statements)
    (unless early (fuzz-load-packages))
    (loop for text in *fuzz-calls* for call in calls
          do (format t "~&== ~a~%" text)
             (let ((answer (car (errcatch (meval call))))) ($plainly text answer)))
    (format t "~&== end~%")))
