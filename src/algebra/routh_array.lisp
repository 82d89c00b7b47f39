;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Where the roots of p = a_0 s^n + .. + a_n lie, p of whole numbers, by Routh's array: the
;;; changes of sign in its first column are the roots to the right, where no entry there vanishes
;;; (Gantmacher, The Theory of Matrices, XV, 3).  Modulo a prime the array tells that none does; the
;;; signs come from the same array of integers of 128 bits and more, each with a bound of its
;;; error.  p = g(s^2)*q: the roots of g(s^2) lie symmetric about 0, on the axis where g has a
;;; negative root; of h without multiple roots these are deg h less the roots of
;;; h(s^2) + s*h'(s^2) to the right (the index of w*h'(-w^2)/h(-w^2)).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/sturm" "algebra/whole_polynomials"))

(defun algebra-located-whole (p irregular)
  "(left axis right) of P; IRREGULAR counts so for a polynomial without roots on the axis in whose
array an entry vanishes."
  (let* ((zeros (algebra-trailing-zeros p))
         (places (algebra-located-beside-0 (butlast p zeros) irregular)))
    (list (first places) (+ zeros (second places)) (third places))))

(defun algebra-trailing-zeros (p)
  (position 0 (reverse p) :test-not #'eql))

(defun algebra-located-beside-0 (p irregular)
  "P does not vanish at 0."
  (cond ((null (cdr p)) (list 0 0 0))
        ((algebra-regular-p (algebra-alternate p) (algebra-alternate (cdr p)))
         (algebra-located-regular p))
        (t (let ((g (algebra-symmetric-part p)))
             (if (cdr g)
                 (mapcar #'+
                         (algebra-located-symmetric g)
                         (algebra-located-beside-0
                          (algebra-whole-quotient p (algebra-spread g)) irregular))
                 (funcall irregular p))))))

(defun algebra-alternate (p) (loop for c in p by #'cddr collect c))

(defun algebra-spread (g)
  "g(s^2)"
  (cons (car g) (loop for c in (cdr g) collect 0 collect c)))

(defun algebra-symmetric-part (p)
  "g, p(s) = g(s^2)*q(s), P not 0 at 0."
  (let ((above (algebra-alternate p)) (row (algebra-primitive (algebra-alternate (cdr p)))))
    (if row
        (algebra-common-polynomial above row)
        (algebra-primitive above))))

(defun algebra-located-regular (p)
  (let ((right (algebra-routh-right (algebra-alternate p) (algebra-alternate (cdr p)))))
    (list (- (length p) 1 right) 0 right)))

(defun algebra-located-symmetric (g)
  "Of g(s^2), G not 0 at 0."
  (let* ((degree (1- (length g)))
         (axis (loop for (part . multiplicity) in (algebra-square-free-parts g)
                     sum (* 2 multiplicity (algebra-negative-roots part)))))
    (list (- degree (/ axis 2)) axis (- degree (/ axis 2)))))

(defun algebra-negative-roots (h)
  "How many; H has no multiple roots and does not vanish at 0."
  (let ((slope (algebra-slope-numbers h)))
    (if (algebra-regular-p h slope)
        (- (length h) 1 (algebra-routh-right h slope))
        (algebra-real-roots-between h nil 0))))

(defun algebra-simple-whole-p (p)
  "Whether the roots of P that lie symmetric about 0 are simple."
  (let* ((zeros (algebra-trailing-zeros p))
         (g (algebra-symmetric-part (butlast p zeros))))
    (and (<= zeros 1)
         (or (null (cdr g))
             (null (cdr (algebra-common-polynomial g (algebra-slope-numbers g))))))))

;;; Modulo a prime: what does not vanish there does not vanish.

(defun algebra-regular-p (above row)
  "Whether it is proved that no entry of the first column vanishes; ROW may begin with zeros."
  (some (lambda (p) (algebra-regular-modulo-p above row p)) '(1073741789 1073741783)))

(defun algebra-regular-modulo-p (above row p)
  (declare (fixnum p))
  (flet ((image (row) (map 'simple-vector (lambda (c) (mod c p)) row)))
    (let ((above (image above)) (row (image row)))
      (loop while (plusp (length row))
            when (or (eql 0 (svref row 0)) (eql 0 (svref above 0))) return nil
              do (psetq above row
                        row (algebra-next-modulo above row p))
            finally (return t)))))

(defun algebra-next-modulo (above row p)
  (declare (simple-vector above row) (fixnum p))
  (let ((a (svref above 0)) (b (svref row 0)) (m (length row))
        (next (make-array (1- (length above)))))
    (declare (fixnum a b m))
    (dotimes (k (length next) next)
      (declare (fixnum k))
      (let ((x (svref above (1+ k))) (y (if (< (1+ k) m) (svref row (1+ k)) 0)))
        (declare (fixnum x y))
        (setf (svref next k)
              (mod (the fixnum (- (the fixnum (* b x)) (the fixnum (* a y)))) p))))))

;;; The same in numbers that are known but for an error, (number . error).  A row stands for any
;;; positive multiple of itself.

(defparameter *algebra-routh-bits* 128 "To begin with.")

(defun algebra-routh-right (above row)
  "The changes of sign in the first column, in which nothing vanishes."
  (let ((balance (algebra-row-balance above)))
    (flet ((entries (row)
             (mapcar (lambda (x) (cons x 0)) (algebra-balanced-row row balance))))
      (loop with above = (entries above) and row = (entries row)
            for bits = *algebra-routh-bits* then (* 2 bits)
            for right = (catch 'no-interval (algebra-routh-changes above row bits))
            when right return right))))

(defun algebra-row-balance (row)
  "k for which x = 2^k*y gives a polynomial in y whose first and last coefficients are about equal."
  (if (cdr row)
      (round (- (integer-length (car (last row))) (integer-length (car row)))
             (1- (length row)))
      0))

(defun algebra-balanced-row (row k)
  (loop for x in row
        for power downfrom (if (minusp k) 0 (1- (length row)))
        collect (ash x (* k power))))

(defun algebra-routh-changes (above row bits)
  (let ((above (algebra-rounded-row above bits)) (row (algebra-rounded-row row bits)))
    (loop for sign = (algebra-entry-sign (car above)) then next
          for next = (and row (algebra-entry-sign (car row)))
          while next
          count (/= sign next)
          do #-sbcl (core-watch)
             (psetq above row
                    row (algebra-rounded-row (algebra-next-row above row next) bits)))))

(defun algebra-entry-sign (entry)
  (if (> (abs (car entry)) (cdr entry))
      (signum (car entry))
      (throw 'no-interval nil)))

(defun algebra-next-row (above row sign)
  "SIGN*(b_0*a_k - a_0*b_k), SIGN that of b_0."
  (destructuring-bind ((b . error-b) . more-b) row
    (destructuring-bind ((a . error-a) . more-a) above
      (let* ((b (* sign b)) (a (* sign a))
             (size-b (+ (abs b) error-b)) (size-a (+ (abs a) error-a)))
        (loop for (x . error-x) in more-a
              for (y . error-y) = (or (pop more-b) '(0 . 0))
              collect (cons (- (* b x) (* a y))
                            (+ (* error-b (abs x)) (* error-x size-b)
                               (* error-a (abs y)) (* error-y size-a))))))))

(defun algebra-rounded-row (row bits)
  "ROW in numbers of BITS bits."
  (let ((shift (- bits (reduce #'max row :key (lambda (entry) (integer-length (car entry)))
                                         :initial-value 0))))
    (if (minusp shift)
        (loop for (x . error) in row
              collect (cons (ash x shift) (+ 2 (ash error shift))))
        row)))
