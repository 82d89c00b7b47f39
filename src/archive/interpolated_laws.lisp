;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A law by its points, f(u) = [[0, 0], [s, h, 0], [3*s, 0]]: the polynomial of least degree with
;;; these values and derivatives, h*u*(u - 3*s)^2/(4*s^3). By divided differences, a place counted
;;; once for each number (J. Stoer, R. Bulirsch, Introduction to numerical analysis, 2.1.5); places
;;; that are not seen to be equal count as different.

(in-package :maxima)

(defun archive-points-p (value)
  "Whether VALUE is [[place, value, derivative, ..], ..]."
  (flet ((list-p (x) (and (consp x) (eq (caar x) 'mlist)))
         (formula-p (x) (not (or (stringp x) (member x '(nil t))
                                 (and (consp x) (member (caar x) '(mlist mequal $matrix)))))))
    (and (list-p value) (cdr value)
         (every (lambda (point) (and (list-p point) (cddr point) (every #'formula-p (cdr point))))
                (cdr value)))))

(defun archive-points-or (check)
  "A check of values that are points, or else fit CHECK."
  (lambda (value) (if (archive-points-p value) value (funcall check value))))

(defun archive-laws-as-formulas (laws)
  "LAWS [f(u) = .., ..] with the polynomial where points stand."
  (cons (car laws)
        (loop for law in (cdr laws)
              collect (if (archive-points-p (third law))
                          (list (car law) (second law)
                                (archive-polynomial-through (archive-places-apart law)
                                                            (second (second law))))
                          law))))

(defun archive-places-apart (law)
  "The points of LAW; an error where a place stands twice, or where it has more arguments than one."
  (let ((points (third law)))
    (when (cddr (second law))
      (core-error "laws: a law by its points has one argument"))
    (loop for (point . others) on (cdr points)
          do (when (some (lambda (other) (eql 0 ($ratsimp (sub (second point) (second other)))))
                         others)
               (core-error "laws: ~a stands twice among the places; a derivative stands behind the ~
                            value" (core-words (list (second point))))))
    points))

(defun archive-polynomial-through (points x)
  "The polynomial in X through POINTS."
  (let* ((nodes (coerce (loop for (nil place . numbers) in (cdr points)
                              append (loop for nil in numbers collect (cons place numbers)))
                        'simple-vector))
         (n (length nodes))
         (sum 0))
    (labels ((place (i) (car (svref nodes i)))
             (same-p (i j) (eq (cdr (svref nodes i)) (cdr (svref nodes j))))
             (difference (i j table)
               (if (same-p i j)
                   (div (nth (- j i) (cdr (svref nodes i))) (list '(mfactorial simp) (- j i)))
                   (div (sub (gethash (cons (1+ i) j) table) (gethash (cons i (1- j)) table))
                        (sub (place j) (place i))))))
      (let ((table (make-hash-table :test #'equal)))
        (loop for width below n
              do (loop for i from 0 below (- n width)
                       do (setf (gethash (cons i (+ i width)) table)
                                (simplify (difference i (+ i width) table)))))
        (loop for k below n
              for product = 1 then (mul product (sub x (place (1- k))))
              do (setq sum (add sum (mul (gethash (cons 0 k) table) product))))
        ($factor ($ratsimp sum))))))
