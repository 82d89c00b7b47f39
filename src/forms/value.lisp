;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Values of expressions at a rational point, to 512 binary digits: whole numbers that count units
;;; of 2^-512. Sums that occur in several places are evaluated once. A name without a value gets a
;;; rational one that its spelling decides, where the point is a random one; a function left open is
;;; the polynomial of sample.lisp. Functions other than sine and cosine are left to Maxima's long
;;; floats, once for each value. See forms-fixed-value first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/exchange" "forms/fixed" "forms/sample"))

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

(defvar *forms-noun-value* nil "The value of a noun at a point, see noun_value.lisp.")

(defun forms-bound-noun-p (e)
  (member (caar e) '(%derivative %integrate %at)))

(defun forms-operation-value (e point)
  (flet ((parts () (mapcar (lambda (part) (forms-fixed-value part point)) (cdr e))))
    (cond ((forms-bound-noun-p e) (funcall *forms-noun-value* e point))
          ((forms-open-function-p (caar e)) (forms-open-value (caar e) (parts)))
          (t (forms-function-value e (parts) point)))))

(defun forms-open-value (name arguments)
  "sum c_k x_k + sum d_k x_k x_(k+1) as in forms-sample-polynomial."
  (flet ((coefficient (k) (forms-fixed (forms-rational (forms-sample-coefficient name k)))))
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

(defun forms-random-value (e)
  "A value between 1/4 and 3/4 that the spelling of E decides."
  (let ((state 20011))
    (loop for character across (if (symbolp e) (symbol-name e) (coerce (mstring e) 'string))
          do (setq state (mod (+ (* 7141 state) 54773 (* 331 (char-code character))) 259200)))
    (forms-fixed (+ 1/4 (/ state 524288)))))

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
