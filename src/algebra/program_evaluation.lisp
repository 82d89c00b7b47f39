;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The value of a program: exactly at a rational point, where the sine and cosine of an input are
;;; rational numbers of the point, sin(x) = 3/5, cos(x) = 4/5, and those of sums of whole multiples
;;; of inputs follow by the theorems of addition; and in double-float numbers.
;;; See algebra-program-values first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"))

(defun algebra-program-values (elements point exactly)
  "The values of ELEMENTS; POINT is a list of (expression . number)."
  (let ((values (make-hash-table)) (turns (make-hash-table)))
    (flet ((value (element)
             (cond ((not (algebra-node-p element))
                    (if exactly element (coerce element 'double-float)))
                   (t (gethash (algebra-node-index element) values)))))
      (dolist (node (algebra-live-nodes elements))
        (setf (gethash (algebra-node-index node) values)
              (algebra-node-value node #'value point exactly turns)))
      (mapcar #'value elements))))

(defun algebra-node-value (node value point exactly turns)
  (let* ((left (algebra-node-left node)) (right (algebra-node-right node)))
    (flet ((x () (funcall value left)) (y () (funcall value right)))
      (case (algebra-node-operation node)
        (:input (algebra-input-value left point exactly))
        (:add (+ (x) (y)))
        (:subtract (- (x) (y)))
        (:negate (- (x)))
        (:multiply (* (x) (y)))
        (:divide (algebra-value-quotient (x) (y)))
        (:sine (if exactly (cdr (algebra-turn left point turns)) (sin (x))))
        (:cosine (if exactly (car (algebra-turn left point turns)) (cos (x))))
        (:root (if exactly (algebra-exact-root (x)) (algebra-double-root (x))))
        (t (algebra-function-node-value node #'x #'y exactly))))))

(defun algebra-function-node-value (node x y exactly)
  (let ((operation (algebra-node-operation node)))
    (cond (exactly (core-error "the value of ~(~a~) is not rational" operation))
          ((member operation '(:power :polar-angle))
           (algebra-function-of-doubles operation (funcall x) (funcall y)))
          (t (algebra-function-of-doubles operation (funcall x))))))

(defun algebra-value-quotient (x y)
  (if (zerop y) (core-error "a program divides by zero at this point") (/ x y)))

(defun algebra-double-root (x)
  (if (minusp x) (core-error "a program takes the square root of ~a" x) (sqrt x)))

(defun algebra-exact-root (x)
  (let ((root (and (>= x 0) (/ (isqrt (numerator x)) (isqrt (denominator x))))))
    (if (and root (= (* root root) x))
        root
        (core-error "the square root of ~a is not rational" x))))

(defun algebra-at-point (expression point)
  (cdr (assoc expression point :test #'alike1)))

(defun algebra-input-value (name point exactly)
  (let ((number (algebra-at-point name point)))
    (cond (number (if exactly number (coerce number 'double-float)))
          ((and (eq name '$%pi) (not exactly)) (coerce pi 'double-float))
          ((and (eq name '$%e) (not exactly)) (exp 1d0))
          (t (core-error "the point has no value for ~a" (mfuncall '$string name))))))

;;; A turn is (cosine . sine) of an angle.

(defun algebra-turn (element point turns)
  (cond ((eql element 0) (cons 1 0))
        ((not (algebra-node-p element)) (core-error "the sine of ~a is not rational" element))
        ((gethash (algebra-node-index element) turns))
        (t (setf (gethash (algebra-node-index element) turns)
                 (algebra-new-turn element point turns)))))

(defun algebra-new-turn (node point turns)
  (let ((left (algebra-node-left node)) (right (algebra-node-right node)))
    (flet ((turn (angle) (algebra-turn angle point turns)))
      (case (algebra-node-operation node)
        (:input (algebra-input-turn left point))
        (:add (algebra-turned-by (turn left) (turn right)))
        (:subtract (algebra-turned-by (turn left) (algebra-turned-back (turn right))))
        (:negate (algebra-turned-back (turn left)))
        (:multiply (if (integerp left)
                       (algebra-turned-times left (turn right))
                       (core-error "the sine of a product is not rational")))
        (t (core-error "the sine of a quotient or a function is not rational"))))))

(defun algebra-input-turn (name point)
  (let ((cosine (algebra-at-point (list '(%cos simp) name) point))
        (sine (algebra-at-point (list '(%sin simp) name) point)))
    (unless (and cosine sine)
      (core-error "the point has no sine and cosine of ~a" (mfuncall '$string name)))
    (cons cosine sine)))

(defun algebra-turned-back (turn) (cons (car turn) (- (cdr turn))))

(defun algebra-turned-by (a b)
  (cons (- (* (car a) (car b)) (* (cdr a) (cdr b)))
        (+ (* (cdr a) (car b)) (* (car a) (cdr b)))))

(defun algebra-turned-times (n turn)
  (if (minusp n)
      (algebra-turned-times (- n) (algebra-turned-back turn))
      (let ((turned (cons 1 0)))
        (dotimes (i n turned) (setq turned (algebra-turned-by turned turn))))))
