;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Arithmetic of general expressions that the simplifier does too slowly or too lengthily.
;;; Products: two lists of factors in Maxima's order become one, powers of one base joined. The
;;; simplifier copies every factor each time, which costs as much as the recursion over bodies
;;; itself; to it are left numbers times sums, roots of numbers and exponents that are no whole
;;; numbers. Turns of plane vectors: by polar angles, see the second half.

(in-package :maxima)

(defun linmodel-general-product (x y)
  (cond ((eql x -1) (linmodel-negated y))
        ((eql y -1) (linmodel-negated x))
        (t (let ((first (linmodel-factors x)) (second (linmodel-factors y)))
             (if (and (linmodel-plain-p first) (linmodel-plain-p second)
                      (not (and (mnump (car first)) (mnump (car second)))))
                 (linmodel-of-factors (linmodel-joined first second))
                 (mul x y))))))

(defun linmodel-factors (e)
  (if (mtimesp e) (cdr e) (list e)))

(defun linmodel-negated (e)
  "-E; a sum is negated term by term."
  (cond ((mplusp e) (cons (car e) (mapcar #'linmodel-negated (cdr e))))
        ((mnump e) (mul -1 e))
        ((not (mtimesp e)) (list '(mtimes simp) -1 e))
        ((not (mnump (cadr e))) (list* '(mtimes simp) -1 (cdr e)))
        ((not (eql (cadr e) -1)) (list* (car e) (mul -1 (cadr e)) (cddr e)))
        (t (linmodel-of-factors (cddr e)))))

(defun linmodel-plain-p (factors)
  "No number alone; all exponents are whole numbers."
  (and (or (cdr factors) (not (mnump (car factors))))
       (loop for factor in factors
             always (or (not (mexptp factor)) (integerp (caddr factor))))))

(defun linmodel-base (e) (if (mexptp e) (cadr e) e))
(defun linmodel-exponent (e) (if (mexptp e) (caddr e) 1))

(defun linmodel-joined (first second)
  (let ((factors '()))
    (loop while (and first second)
          do (let ((x (car first)) (y (car second)))
               (cond ((alike1 (linmodel-base x) (linmodel-base y))
                      (let ((power (linmodel-power (pop first) (pop second))))
                        (when power (push power factors))))
                     ((linmodel-before-p x y) (push (pop first) factors))
                     (t (push (pop second) factors)))))
    (nreconc factors (or first second))))

(defun linmodel-power (x y)
  "The product of two powers of one base; nil where it is 1."
  (let ((base (linmodel-base x)) (exponent (+ (linmodel-exponent x) (linmodel-exponent y))))
    (case exponent
      (0 nil)
      (1 base)
      (t (list '(mexpt simp) base exponent)))))

(defun linmodel-before-p (x y)
  (or (mnump x) (and (not (mnump y)) (great y x))))

(defun linmodel-of-factors (factors)
  (cond ((null factors) 1)
        ((cdr factors) (cons '(mtimes simp) factors))
        (t (car factors))))

;;; Plane vectors by polar angles, so that turns about one axis, one after the other, are one turn:
;;; (x, y) is the sum of
;;;     (p cos(u) + r sin(u), r cos(u) - p sin(u)),
;;; the vectors (p, r) in axes turned by u; a further turn adds to u. Two turns by a and b - a leave
;;; cos(b), and the velocities of a plane chain stay as short as the chain is.

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
         (partner (linmodel-general-product
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
  (if (or (eql x 0) (eql y 0)) 0 (linmodel-general-product x y)))

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
