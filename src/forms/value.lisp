;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Values of expressions at a rational point, to 512 binary digits: whole numbers that count units
;;; of 2^-512. Sums and products of large expressions cost next to nothing so; functions are left
;;; to Maxima's long floats, once for each value.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/exchange"))

(defconstant forms-digits 512)

(defun forms-rational (e)
  (cond ((rationalp e) e)
        ((ratnump e) (/ (cadr e) (caddr e)))))

(defun forms-fixed (rational)
  (round (* rational (ash 1 forms-digits))))

(defun forms-no-value (e)
  (declare (ignore e))
  (throw 'forms-no-value nil))

(defun forms-fixed-value (e point known)
  "The value of E; POINT: name -> value; KNOWN: values of functions found before."
  (cond ((forms-rational e) (forms-fixed (forms-rational e)))
        ((symbolp e) (or (gethash e point) (forms-constant-value e known)))
        ((atom e) (forms-function-value (list '(mplus) e) '() known))
        ((forms-derivative-p e) (forms-derivative-value e point))
        (t (flet ((value (part) (forms-fixed-value part point known)))
             (case (caar e)
               (mplus (loop for part in (cdr e) sum (value part)))
               (mtimes (forms-fixed-product (mapcar #'value (cdr e))))
               (bigfloat (forms-fixed (forms-long-float-ratio e)))
               (mexpt (forms-fixed-power (value (cadr e)) (caddr e) #'value known))
               (t (forms-function-value e (mapcar #'value (cdr e)) known)))))))

(defun forms-derivative-value (e point)
  "The value of 'diff(q,t,n); those of all derivatives stand at the key %derivative."
  (loop for (derivative . value) in (gethash '%derivative point)
        when (and (eql (fourth e) (fourth derivative)) (alike1 (second e) (second derivative)))
          return value
        finally (forms-no-value e)))

(defun forms-fixed-product (factors)
  (let ((product (car factors)))
    (dolist (factor (cdr factors) product)
      (setq product (ash (* product factor) (- forms-digits))))))

(defun forms-fixed-power (base exponent value known)
  (if (integerp exponent)
      (let ((power (forms-fixed-product (cons (ash 1 forms-digits)
                                              (make-list (abs exponent) :initial-element base)))))
        (cond ((plusp exponent) power)
              ((zerop power) (forms-no-value exponent))
              (t (round (ash 1 (* 2 forms-digits)) power))))
      (forms-function-value '((mexpt)) (list base (funcall value exponent)) known)))

(defun forms-constant-value (e known)
  (if ($constantp e) (forms-function-value (list '(mplus) e) '() known) (forms-no-value e)))

(defun forms-function-value (e arguments known)
  "The function of E at ARGUMENTS; a constant is E itself."
  (let ((key (if arguments (cons (caar e) arguments) (cadr e))))
    (or (gethash key known)
        (setf (gethash key known) (forms-long-float-value e arguments)))))

(defun forms-long-float-value (e arguments)
  (let* (($fpprec 160) (fpprec (+ 2 (integer-length (expt 10 $fpprec))))
         (numbers (mapcar (lambda (x) ($bfloat (div x (ash 1 forms-digits)))) arguments))
         (found ($bfloat (if arguments
                             (simplifya (cons (list (caar e)) numbers) nil)
                             (cadr e)))))
    (if ($bfloatp found)
        (forms-fixed (forms-long-float-ratio found))
        (forms-no-value e))))

(defun forms-long-float-ratio (x)
  ;; ((bigfloat .. precision) mantissa exponent) is mantissa*2^(exponent - precision)
  (* (cadr x) (expt 2 (- (caddr x) (car (last (car x)))))))

(defun forms-set-value (e value point)
  (if (forms-derivative-p e)
      (push (cons e value) (gethash '%derivative point))
      (setf (gethash e point) value)))

(defun $forms_value (e point)
  "The value of E at POINT, equations name = rational number or 'diff(q,t) = rational number; false where it has none."
  (let ((fixed (make-hash-table :test #'eq)) (known (make-hash-table :test #'equal)))
    (dolist (equation (cdr point))
      (forms-set-value (second equation) (forms-fixed (forms-rational (third equation))) fixed))
    (let ((value (catch 'forms-no-value (forms-fixed-value e fixed known))))
      (and value (div value (ash 1 forms-digits))))))
