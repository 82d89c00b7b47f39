;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Values of expressions at a rational point, to 512 binary digits: whole numbers that count units
;;; of 2^-512. Sums that occur in several places are evaluated once. A name without a value gets a
;;; random one where the point is a random one; a function left open is a polynomial. Functions
;;; other than sine and cosine are left to Maxima's long floats, once for each value. A derivative
;;; that Maxima carries out is a formula; else, as of max(x,0), it is a quotient of differences. An
;;; integral is never carried out: its value is sum w_k f(s_k) with Takahasi and Mori's nodes
;;; (double exponential formulas, 1974). See forms-fixed-value first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/random_numbers" "forms/exchange" "forms/fixed" "forms/open_functions"))

(defstruct forms-point
  (names (make-hash-table :test #'eq)) ; name -> value
  (derivatives '())                    ; ('diff(q,t,n) . value), ..
  (sums (make-hash-table :test #'eq))  ; sum or power -> value
  known                                ; function and arguments -> value, at any point
  random)                              ; whether other names have values too

(defun forms-new-point (random)
  (make-forms-point :known (make-hash-table :test #'equal) :random random))

(defun forms-moved-point (point)
  "A copy of POINT for other values: what is remembered of sums is not in it."
  (let ((names (make-hash-table :test #'eq)))
    (maphash (lambda (name value) (setf (gethash name names) value)) (forms-point-names point))
    (make-forms-point :names names :derivatives (copy-alist (forms-point-derivatives point))
                      :known (forms-point-known point) :random (forms-point-random point))))

(defun forms-place (e point)
  "The value that POINT gives the name or derivative E, or nil."
  (if (symbolp e)
      (gethash e (forms-point-names point))
      (cdr (assoc e (forms-point-derivatives point) :test #'alike1))))

(defun forms-set-place (e value point)
  (cond ((symbolp e) (setf (gethash e (forms-point-names point)) value))
        (t (setf (forms-point-derivatives point)
                 (acons e value (remove e (forms-point-derivatives point)
                                        :test #'alike1 :key #'car))))))

(defun forms-rational (e)
  (cond ((rationalp e) e)
        ((ratnump e) (/ (cadr e) (caddr e)))))

(defun forms-fixed-value (e point)
  (cond ((forms-rational e) (forms-fixed (forms-rational e)))
        ((symbolp e) (or (forms-place e point) (forms-symbol-value e point)))
        ((atom e) (forms-function-value (list '(mplus) e) '() point))
        ((or (forms-derivative-p e) (member 'array (car e))) (forms-variable-value e point))
        (t (case (caar e)
             (mtimes (forms-product-value (cdr e) point))
             (bigfloat (forms-fixed (forms-long-float-ratio e)))
             ((mplus mexpt)
              (let ((sums (forms-point-sums point)))
                (or (gethash e sums)
                    (setf (gethash e sums) (forms-sum-value e point)))))
             (t (forms-operation-value e point))))))

(defun forms-product-value (factors point)
  (let ((product (forms-fixed-value (car factors) point)))
    (dolist (factor (cdr factors) product)
      (setq product (if (integerp factor)
                        (* factor product)
                        (forms-fixed-times product (forms-fixed-value factor point)))))))

(defun forms-sum-value (e point)
  (if (eq (caar e) 'mplus)
      (loop for part in (cdr e) sum (forms-fixed-value part point))
      (forms-power-value (forms-fixed-value (cadr e) point) (caddr e) point)))

(defun forms-power-value (base exponent point)
  (if (integerp exponent)
      (let ((power (forms-fixed-power base (abs exponent))))
        (cond ((plusp exponent) power)
              ((zerop power) (forms-no-value exponent))
              (t (forms-fixed-inverse power))))
      (forms-function-value '((mexpt)) (list base (forms-fixed-value exponent point)) point)))

(defun forms-bound-noun-p (e)
  (member (caar e) '(%derivative %integrate %at)))

(defun forms-operation-value (e point)
  (flet ((parts () (mapcar (lambda (part) (forms-fixed-value part point)) (cdr e))))
    (cond ((forms-bound-noun-p e) (forms-noun-value e point))
          ((eq (caar e) '$piecewise) (forms-pieces-value e point))
          ((eq (caar e) '$unit_step)
           (if (plusp (forms-fixed-value (second e) point)) (forms-fixed 1) 0))
          ((forms-open-function-p (caar e)) (forms-open-value (caar e) (parts)))
          (t (forms-function-value e (parts) point)))))

(defun forms-pieces-value (e point)
  "Of piecewise([condition, value], ..) the value with the first condition that holds."
  (loop for (nil condition value) in (cdr e)
        when (forms-condition-value condition point) return (forms-fixed-value value point)
        finally (return (forms-no-value e))))

(defun forms-condition-value (condition point)
  "Whether CONDITION holds at POINT."
  (flet ((holds (part) (forms-condition-value part point))
         (by (test) (funcall test (forms-fixed-value (second condition) point)
                             (forms-fixed-value (third condition) point))))
    (cond ((atom condition)
           (if (member condition '(nil t $otherwise)) condition (forms-no-value condition)))
          (t (case (caar condition)
               (mgreaterp (by #'>))
               (mgeqp (by #'>=))
               (mlessp (by #'<))
               (mleqp (by #'<=))
               (mand (every #'holds (cdr condition)))
               (mor (some #'holds (cdr condition)))
               (mnot (not (holds (second condition))))
               (t (forms-no-value condition)))))))

(defun forms-open-value (name arguments)
  "The polynomial of the function NAME at ARGUMENTS, as forms-open-polynomial has it."
  (flet ((coefficient (k) (forms-fixed (forms-open-coefficient name k))))
    (loop for k from 1
          for x in arguments
          for y in (append (cdr arguments) (list (car arguments)))
          sum (forms-fixed-times (coefficient k) x)
          sum (forms-fixed-times (coefficient (- k)) (forms-fixed-times x y)))))

(defun forms-variable-value (e point)
  (or (forms-place e point)
      (if (forms-point-random point)
          (let ((value (forms-random-value e)))
            (forms-set-place e value point)
            value)
          (forms-no-value e))))

(defun forms-symbol-value (e point)
  (if ($constantp e)
      (forms-function-value (list '(mplus) e) '() point)
      (forms-variable-value e point)))

(defun forms-random-value (e) (forms-fixed (algebra-random-number e)))

(defun forms-function-value (e arguments point)
  "The function of E at ARGUMENTS; a constant is E itself."
  (let ((key (if arguments (cons (caar e) arguments) (cadr e)))
        (known (forms-point-known point)))
    (or (gethash key known)
        (setf (gethash key known)
              (if (and arguments (member (caar e) '(%sin %cos)))
                  (forms-sine-value (car arguments) (caar e) known)
                  (forms-long-float-value e arguments))))))

(defun forms-sine-value (x operator known)
  "Sine or cosine of X; both are known afterwards."
  (multiple-value-bind (sine cosine) (forms-fixed-sine-cosine x)
    (setf (gethash (list '%sin x) known) sine
          (gethash (list '%cos x) known) cosine)
    (if (eq operator '%sin) sine cosine)))

(defun forms-long-float-value (e arguments)
  (forms-check-sizes (caar e) arguments)
  (let ((found (car (core-attempt (lambda () (forms-long-float e arguments))))))
    (if ($bfloatp found)
        (forms-fixed (forms-long-float-ratio found))
        (forms-no-value e))))

(defun forms-long-float (e arguments)
  "Maxima's long float of the function of E at ARGUMENTS, of the constant E without."
  (let* (($fpprec 160) (fpprec (+ 2 (integer-length (expt 10 $fpprec))))
         (numbers (mapcar (lambda (x) ($bfloat (div x (ash 1 forms-digits)))) arguments)))
    ($bfloat (if arguments
                 (simplifya (cons (list (caar e)) numbers) nil)
                 (cadr e)))))

(defun forms-check-sizes (operator arguments)
  "No value where Maxima's long floats would be too long, or would take too long."
  (flet ((digits (x) (- (integer-length x) forms-digits)))
    (let ((most (reduce #'max (mapcar #'digits arguments) :initial-value 0)))
      (when (or (> most 200)
                (and (eq operator 'mexpt)
                     (> (+ (digits (second arguments))
                           (integer-length (abs (digits (first arguments)))))
                        (integer-length forms-most-digits)))
                (and (member operator '(%sinh %cosh %tanh %sech %csch %coth mfactorial %gamma))
                     (> most 13)))
        (forms-no-value operator)))))

(defun forms-long-float-ratio (x)
  ;; ((bigfloat .. precision) mantissa exponent) is mantissa*2^(exponent - precision)
  (* (cadr x) (expt 2 (- (caddr x) (car (last (car x)))))))

;;; Nouns: derivatives, once or twice with respect to one name, and integrals.

(defun forms-noun-value (e point)
  (case (caar e)
    (%integrate (forms-integral-value e point))
    (t (let ((closed ($forms_closed e)))
         (cond ((or (atom closed) (not (eq (caar closed) (caar e))))
                (forms-fixed-value closed point))
               ((eq (caar e) '%derivative) (forms-difference-value closed point))
               (t (forms-no-value e)))))))

(defun forms-difference-value (e point)
  (destructuring-bind (body x &optional (order 1) &rest more) (cdr e)
    (unless (and (symbolp x) (member order '(1 2)) (null more)) (forms-no-value e))
    (let ((here (forms-fixed-value x point)) (step 100))
      (flet ((value (k)
               (let ((moved (forms-moved-point point)))
                 (forms-set-place x (+ here (* k (ash 1 (- forms-digits step)))) moved)
                 (forms-fixed-value body moved))))
        (if (= order 1)
            (ash (- (value 1) (value -1)) (1- step))
            (ash (+ (value 1) (value -1) (* -2 (value 0))) (* 2 step)))))))

;;; Integrals:
;;;     s = (a+b)/2 + (b-a)/2 tanh(pi/2 sinh(k h))
;;; serves integrands that are singular at the ends, too. Where half the step gives another value
;;; there is none.

(defparameter *forms-node-step* 31/512
  "About 1/16; no multiple of its half is 1, at which Maxima's long exponential is off by 2^-53.")
(defparameter *forms-node-count* 84
  "Nodes on each side at this step: the last ones are 10^-110 from the ends.")
(defconstant forms-tail-digits 160 "Binary digits behind which the last terms have to lie.")
(defconstant forms-integral-digits 75
  "Binary digits to which both sums have to agree: the finer one then has twice as many.")
(defvar *forms-nodes* nil "Nodes and weights in turn at half the step, ((1 - tanh) . weight), ..")

(defun forms-bigfloat-fixed (e)
  "A constant expression in units of 2^-512."
  (forms-fixed (forms-long-float-ratio ($bfloat e))))

(defun forms-node (u)
  "(1 - tanh(v) . weight), v = pi/2 sinh(u): 1 - tanh(v) = 2/(1 + exp(2v))."
  (let* ((v (mul '((rat simp) 1 2) '$%pi (take '(%sinh) ($bfloat u))))
         (cosh (take '(%cosh) ($bfloat v))))
    (cons (forms-bigfloat-fixed (div 2 (add 1 (power '$%e ($bfloat (mul 2 v))))))
          (forms-bigfloat-fixed (div (mul '((rat simp) 1 2) '$%pi (take '(%cosh) ($bfloat u)))
                                     (mul cosh cosh))))))

(defun forms-nodes ()
  "The nodes for k = 0, 1, .. at half the step."
  (or *forms-nodes*
      (setq *forms-nodes*
            (let* (($fpprec 160) (fpprec (+ 2 (integer-length (expt 10 160)))))
              (loop for k from 0 to (* 2 *forms-node-count*)
                    collect (forms-node (forms-maxima-ratio (* k (/ *forms-node-step* 2)))))))))

(defun forms-maxima-ratio (x)
  (div (numerator x) (denominator x)))

(defun forms-integral-value (e point)
  (destructuring-bind (body variable &rest limits) (cdr ($forms_closed e))
    (unless (and (symbolp variable) (= (length limits) 2)) (forms-no-value e))
    (forms-definite-value body variable
                          (forms-fixed-value (first limits) point)
                          (forms-fixed-value (second limits) point)
                          point)))

(defun forms-definite-value (body variable a b point)
  (let ((half (ash (- b a) -1)) (whole 0) (fine 0) (last 0))
    (flet ((value (s)
             (let ((moved (forms-moved-point point)))
               (forms-set-place variable s moved)
               (forms-fixed-value body moved))))
      (loop for (near . weight) in (forms-nodes)
            for k from 0
            for offset = (forms-fixed-times half near)
            for term = (forms-fixed-times
                        weight (if (zerop k)
                                   (value (+ a half))
                                   (+ (value (+ a offset)) (value (- b offset)))))
            do (incf fine term)
               (setq last term)
               (when (evenp k) (incf whole term))))
    (when (> (integer-length last) (- forms-digits forms-tail-digits)) (forms-no-value last))
    (forms-agreed (forms-fixed-times half (forms-times-step whole *forms-node-step*))
                  (forms-fixed-times half (forms-times-step fine (/ *forms-node-step* 2))))))

(defun forms-times-step (sum step)
  (round (* sum step)))

(defun forms-agreed (whole fine)
  (if (< (abs (- whole fine)) (ash (+ (ash 1 forms-digits) (abs fine))
                                   (- forms-integral-digits)))
      fine
      (forms-no-value fine)))

;;; For Maxima.

(defun forms-given-point (equations)
  (let ((point (forms-new-point nil)))
    (dolist (equation (cdr equations) point)
      (forms-set-place (second equation) (forms-fixed (forms-rational (third equation))) point))))

(defun $forms_value (e point)
  "The value of E at POINT, equations name = rational number or 'diff(q,t) = rational number; false
where it has none."
  (let ((value (catch 'forms-no-value (forms-fixed-value e (forms-given-point point)))))
    (and value (div value (ash 1 forms-digits)))))

(defun $forms_determinant_value (matrix point)
  "The value at POINT, as for forms_value; false where an entry or a product has none."
  (let* ((point (forms-given-point point))
         (value (catch 'forms-no-value
                  (forms-fixed-determinant
                   (loop for (nil . row) in (cdr matrix)
                         collect (mapcar (lambda (e) (forms-fixed-value e point)) row))))))
    (and value (div value (forms-fixed 1)))))

(defun $forms_combinations (items rows columns)
  "For each of ITEMS, rows of numbers as ROWS are, whether it is a combination of ROWS; of these the
first COLUMNS tell which."
  (flet ((numbers (row) (mapcar (lambda (e) (forms-fixed (forms-rational e))) (cdr row))))
    (let ((echelon (values (forms-echelon (mapcar #'numbers (cdr rows)) columns))))
      (cons '(mlist simp)
            (mapcar (lambda (item) (forms-in-echelon-p (numbers item) echelon)) (cdr items))))))
