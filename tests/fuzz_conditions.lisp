;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The adversary of conditions: what RouthHurwitz, LienardChipart, RealNegativeRoots and Definite
;;; say of polynomials and matrices with parameters under random facts, against exact points at
;;; which the facts hold. All of these say "if and only if": where the conditions hold the property
;;; must hold, where one fails it must fail. The property is found at the point by other ways:
;;; Routh's array of numbers, Sturm's count, elimination. Look first at conditions-case.

(in-package :maxima)

(load (core-pathname (concatenate 'string *core-root* "tests/fuzz_signs.lisp")))
(core-require "analysis/criteria"
              "analysis/definite")

;;; Properties of numbers

(defun conditions-stable-p (a)
  "Whether all roots of the polynomial with the coefficients A, highest first, a_0 > 0, have
negative real parts: Routh's reduction of the degree by one."
  (cond ((minusp (car a)) (conditions-stable-p (mapcar #'- a)))
        ((null (cdr a)) t)
        ((<= (cadr a) 0) nil)
        (t (let ((ratio (/ (car a) (cadr a))))
             (conditions-stable-p
              (cons (cadr a)
                    (loop for k from 2 below (length a)
                          collect (if (evenp k)
                                      (- (nth k a) (* ratio (or (nth (1+ k) a) 0)))
                                      (nth k a)))))))))

(defun conditions-polynomial (a x)
  (addn (loop for c in a for power downfrom (1- (length a))
              collect (mul (algebra-maxima-rational c) (power x power)))
        nil))

(defun conditions-real-negative-p (a)
  "All roots real, negative and distinct, by Sturm and the discriminant."
  (let ((p (conditions-polynomial a '$s)) (n (1- (length a))))
    (and (not (zerop (car (last a))))
         (= n ($nroots p '$minf 0))
         (or (= n 1) (not (eql 0 ($resultant p ($diff p '$s) '$s)))))))

(defun conditions-positive-p (rows)
  "Whether the symmetric matrix of numbers is positive definite, by elimination."
  (or (null rows)
      (let ((pivot (caar rows)))
        (and (plusp pivot)
             (conditions-positive-p
              (loop for row in (cdr rows)
                    collect (loop for x in (cdr row) for y in (cdar rows)
                                  collect (- x (/ (* (car row) y) pivot)))))))))

;;; Conditions at a point

(defun conditions-holds-p (condition point)
  (if (symbolp condition)
      condition
      (let ((value (- (signs-value (second condition) point)
                      (signs-value (third condition) point))))
        (ecase (caar condition)
          (mgreaterp (plusp value)) (mgeqp (>= value 0))
          (mlessp (minusp value)) (mleqp (<= value 0))
          ($notequal (not (zerop value)))))))

(defun conditions-hold-p (conditions point)
  (every (lambda (c) (conditions-holds-p c point)) (cdr conditions)))

;;; Random questions: (call expected-at-a-point)

(defvar *conditions-point* nil "A point at which the facts hold.")

(defun conditions-coefficient ()
  "Mostly not negative at the point, so that there is something to satisfy."
  (let* ((e (case (signs-random 4)
              (0 (signs-number-m))
              (1 (signs-choice *signs-names*))
              (t (signs-short))))
         (value (catch 'no-value (signs-value e *conditions-point*))))
    (if (and value (minusp value) (plusp (signs-random 4))) (mul -1 e) e)))

(defun conditions-product-coefficients ()
  "Of a product of two short factors, so that conditions come apart."
  (let ((p ($expand (mul (add '$s (conditions-coefficient))
                         (add (power '$s 2) (mul (conditions-coefficient) '$s)
                              (conditions-coefficient))))))
    (loop for k downfrom 3 to 0 collect ($coeff p '$s k))))

(defun conditions-coefficients ()
  (if (zerop (signs-random 3))
      (conditions-product-coefficients)
      (loop repeat (+ 2 (signs-random 3)) collect (conditions-coefficient))))

(defun conditions-question ()
  (let ((kind (signs-random 4)))
    (if (= kind 3)
        (conditions-matrix-question)
        (let* ((a (conditions-coefficients))
               (p (addn (loop for c in a for k downfrom (1- (length a))
                              collect (mul c (power '$s k)))
                        nil)))
          (list (list (nth kind '($analysis_routh_hurwitz $analysis_lienard_chipart
                                  $analysis_real_negative_roots))
                      p '$s)
                (lambda (point)
                  (let ((values (mapcar (lambda (c) (signs-value c point)) a)))
                    (cond ((zerop (car values)) (throw 'no-value nil))
                          ((= kind 2) (conditions-real-negative-p values))
                          (t (conditions-stable-p values))))))))))

(defun conditions-matrix-question ()
  (let* ((n (+ 2 (signs-random 2)))
         (entries (make-array (list n n))))
    (dotimes (i n)
      (dotimes (j (1+ i))
        (setf (aref entries i j) (conditions-coefficient) (aref entries j i) (aref entries i j))))
    (flet ((rows (f) (loop for i below n
                           collect (loop for j below n collect (funcall f (aref entries i j))))))
      (list (list '$analysis_positive_definite
                  (cons '($matrix simp)
                        (mapcar (lambda (row) (cons '(mlist simp) row)) (rows #'identity))))
            (lambda (point)
              (conditions-positive-p (rows (lambda (e) (signs-value e point)))))))))

(defun conditions-case ()
  "nil, or what is wrong with one random case. Questions that are refused are not judged."
  (let* ((*signs-names* '($a $b $c))
         (point (signs-point)) (*conditions-point* point)
         (facts (remove nil (loop repeat (signs-random 6)
                                  collect (catch 'no-value (signs-fact point)))))
         (points (signs-points facts point 40)))
    (destructuring-bind (call property) (conditions-question)
      (let ((conditions (let ((*core-facts* facts))
                          (core-attempt (lambda () (apply #'mfuncall call))))))
        (when conditions
          (loop for point in points
                for wrong = (catch 'no-value
                              (list (conditions-hold-p (car conditions) point)
                                    (funcall property point)))
                unless (or (null wrong) (eq (and (first wrong) t) (and (second wrong) t)))
                  return (list '(mlist simp) (car conditions) (cons '(mlist simp) (cdr call))
                               (car call) (cons '(mlist simp) facts) (signs-shown point))))))))

(defun $fuzz_conditions (count seed)
  "The failures among COUNT random cases from SEED."
  (signs-failures count seed #'conditions-case))

(defun $fuzz_conditions_in_tests ()
  "As many as a test has time for: GCL interprets what SBCL compiles."
  #+sbcl 250 #-sbcl 15)
