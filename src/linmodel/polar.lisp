;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Plane vectors of general expressions by polar angles, so that turns about one axis, one after
;;; the other, are one turn: (x, y) is the sum of
;;;     (p cos(u) + r sin(u), r cos(u) - p sin(u)),
;;; the vectors (p, r) in axes turned by u; a further turn adds to u. Two turns by a and b - a leave
;;; cos(b), and the velocities of a plane chain stay as short as the chain is.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "linmodel/product"))

(defun linmodel-sine (angle) (simplify (list '(%sin) angle)))
(defun linmodel-cosine (angle) (simplify (list '(%cos) angle)))

(defun linmodel-terms (e)
  (cond ((eql e 0) '())
        ((mplusp e) (cdr e))
        (t (list e))))

(defun linmodel-polar (x y)
  "The vector (X, Y) as a list of (u p r)."
  (let ((rest-y (linmodel-terms y)) (rest-x '()) (parts '()))
    (dolist (term (linmodel-terms x))
      (destructuring-bind (&optional part partner) (linmodel-polar-part term rest-y)
        (cond (part (push part parts)
                    (setq rest-y (remove partner rest-y :test #'alike1 :count 1)))
              (t (push term rest-x)))))
    (if (or rest-x rest-y)
        (cons (list 0 (addn (nreverse rest-x) nil) (addn rest-y nil)) parts)
        parts)))

(defun linmodel-polar-part (term others)
  "The (u p r) of the TERM of x and its partner among the OTHERS, the terms of y; or nil."
  (dolist (factor (linmodel-factors term))
    (when (linmodel-partner-possible-p factor others)
      (let ((part (linmodel-polar-pair term factor others)))
        (when part (return part))))))

(defun linmodel-partner-possible-p (factor others)
  "Whether FACTOR is cos(u) or sin(u) and sin(u) or cos(u) a factor among the OTHERS."
  (and (consp factor)
       (member (caar factor) '(%cos %sin))
       (loop with partner = (if (eq (caar factor) '%cos) '%sin '%cos)
             for other in others
             thereis (loop for e in (linmodel-factors other)
                           thereis (and (consp e) (eq (caar e) partner)
                                        (alike1 (cadr e) (cadr factor)))))))

(defun linmodel-polar-pair (term factor others)
  (let* ((angle (cadr factor))
         (cosine (eq (caar factor) '%cos))
         (coefficient (linmodel-of-factors (remove factor (linmodel-factors term) :test #'eq)))
         (partner (linmodel-product
                   coefficient (if cosine (linmodel-sine angle) (linmodel-cosine angle)))))
    (dolist (sign (if cosine '(-1 1) '(1 -1)))
      (let ((signed (if (= sign 1) partner (linmodel-negated partner))))
        (when (member signed others :test #'alike1)
          (return (list (if cosine
                            (list (mul (- sign) angle) coefficient 0)
                            (list (mul sign angle) 0 (mul sign coefficient)))
                        signed)))))))

(defun linmodel-turned-plane (x y angle)
  "(X, Y) in axes turned by ANGLE."
  (let ((turned-x 0) (turned-y 0))
    (loop for (u p r) in (linmodel-polar x y)
          for sum = (add u angle)
          for cosine = (linmodel-cosine sum)
          for sine = (linmodel-sine sum)
          do (setq turned-x (add turned-x (linmodel-product-or-0 p cosine)
                                 (linmodel-product-or-0 r sine))
                   turned-y (add turned-y (linmodel-product-or-0 r cosine)
                                 (linmodel-negated (linmodel-product-or-0 p sine)))))
    (list turned-x turned-y)))

(defun linmodel-product-or-0 (x y)
  (if (or (eql x 0) (eql y 0)) 0 (linmodel-product x y)))

(defun linmodel-plane-product (x y v w)
  "X*V + Y*W by polar angles where (X, Y) or (V, W) has one only; else nil."
  (let ((first (linmodel-polar x y)) (second (linmodel-polar v w)) (sum 0))
    (unless (and (cdr first) (cdr second))
      (dolist (one first sum)
        (dolist (other second)
          (setq sum (add sum (linmodel-polar-product one other))))))))

(defun linmodel-polar-product (one other)
  (destructuring-bind ((u p r) (z q s)) (list one other)
    (flet ((times (x y) (linmodel-product-or-0 x y)))
      (let ((along (add (times p q) (times r s))) (angle (sub u z)))
        (if (eql angle 0)
            along
            (add (times along (linmodel-cosine angle))
                 (times (sub (times r q) (times p s)) (linmodel-sine angle))))))))
