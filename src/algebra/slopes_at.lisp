;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Values and first derivatives of expressions at a point, all at once and without derivatives ever
;;; written out (forward differentiation: Griewank, Walther, Evaluating Derivatives, ch. 3): each
;;; part has a value and a list ((k . slope) ..) of what does not vanish of its slopes in the names
;;; 1, 2, .. Long equations of chains of bodies are short at a point. Sums, products, powers, sines
;;; and cosines; of anything else that moves nothing is said.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size"))

(defun $algebra_slopes_at (expressions names values)
  "[[slope, ..], ..], a row for each of EXPRESSIONS with its slopes in the NAMES where VALUES, a
list of equations, are put in for names; or false."
  (let ((moving (make-hash-table :test #'eq)) (put (make-hash-table :test #'eq))
        (known (make-hash-table :test #'eq)) (count (length (cdr names))))
    (loop for name in (cdr names) for k from 0 do (setf (gethash name moving) k))
    (loop for (nil name value) in (cdr values) do (setf (gethash name put) value))
    (catch 'algebra-no-slopes
      (cons '(mlist simp)
            (loop for e in (cdr expressions)
                  for slopes = (cdr (algebra-with-slopes e moving put known))
                  collect (cons '(mlist simp)
                                (loop for k below count
                                      collect (or (cdr (assoc k slopes)) 0))))))))

(defun algebra-with-slopes (e moving put known)
  "(value . slopes) of E; KNOWN are those of the parts met before."
  (cond ((symbolp e)
         (multiple-value-bind (value given) (gethash e put)
           (let ((k (gethash e moving)))
             (cons (if given value e) (and k (list (cons k 1)))))))
        ((atom e) (list e))
        ((gethash e known))
        (t (setf (gethash e known)
                 (algebra-operation-with-slopes
                  e (lambda (part) (algebra-with-slopes part moving put known)) moving put)))))

(defun algebra-operation-with-slopes (e jet moving put)
  (case (caar e)
    (rat (list e))
    (mplus (algebra-sum-with-slopes (mapcar jet (cdr e))))
    (mtimes (reduce #'algebra-product-with-slopes (mapcar jet (cdr e))))
    (mexpt (algebra-power-with-slopes (funcall jet (second e)) (funcall jet (third e))))
    (%sin (algebra-turn-with-slopes (funcall jet (second e)) '%sin '%cos 1))
    (%cos (algebra-turn-with-slopes (funcall jet (second e)) '%cos '%sin -1))
    (t (if (algebra-still-p e moving put) (list e) (throw 'algebra-no-slopes nil)))))

(defun algebra-still-p (e moving put)
  "Whether no name that moves, or for which a value is put in, stands in E."
  (cond ((symbolp e) (not (or (nth-value 1 (gethash e moving)) (nth-value 1 (gethash e put)))))
        ((atom e) t)
        (t (every (lambda (part) (algebra-still-p part moving put)) (cdr e)))))

(defun algebra-merged-slopes (a b)
  "The sum of two lists of slopes, each in rising order."
  (let ((merged '()))
    (loop while (and a b)
          do (let ((i (caar a)) (j (caar b)))
               (cond ((< i j) (push (pop a) merged))
                     ((> i j) (push (pop b) merged))
                     (t (let ((sum (add (cdr (pop a)) (cdr (pop b)))))
                          (unless (eql sum 0) (push (cons i sum) merged)))))))
    (nreconc merged (or a b))))

(defun algebra-scaled-slopes (factor slopes)
  (cond ((eql factor 0) '())
        ((eql factor 1) slopes)
        (t (loop for (k . slope) in slopes
                 for product = (mul factor slope)
                 unless (eql product 0) collect (cons k product)))))

(defun algebra-sum-with-slopes (jets)
  (cons (addn (mapcar #'car jets) nil)
        (reduce #'algebra-merged-slopes (mapcar #'cdr jets))))

(defun algebra-product-with-slopes (a b)
  (cons (mul (car a) (car b))
        (algebra-merged-slopes (algebra-scaled-slopes (car b) (cdr a))
                               (algebra-scaled-slopes (car a) (cdr b)))))

(defun algebra-power-with-slopes (base power)
  "A base that may be 0 has a whole power above 0."
  (let ((n (algebra-rational-number (car power))) (b (car base)))
    (cond ((and (null (cdr base)) (null (cdr power)))
           (if (and (eql b 0) (not (and n (plusp n))))
               (throw 'algebra-no-slopes nil)
               (list (power b (car power)))))
          ((not (and (integerp n) (null (cdr power)))) (throw 'algebra-no-slopes nil))
          ((and (minusp n) (member (algebra-rational-number b) '(nil 0)))
           (throw 'algebra-no-slopes nil))
          (t (cons (power b n)
                   (algebra-scaled-slopes (mul n (if (= n 1) 1 (power b (1- n)))) (cdr base)))))))

(defun algebra-turn-with-slopes (angle function other sign)
  (flet ((of (name) (simplify (list (list name) (car angle)))))
    (cons (of function)
          (and (cdr angle) (algebra-scaled-slopes (mul sign (of other)) (cdr angle))))))

(defun $algebra_plainly_real (e)
  "Whether E is made of sums, products, whole powers, sines and cosines alone."
  (cond ((atom e) t)
        ((eq (caar e) 'mexpt) (and (integerp (third e)) ($algebra_plainly_real (second e))))
        (t (and (member (caar e) '(mplus mtimes rat %sin %cos))
                (every #'$algebra_plainly_real (cdr e))))))
