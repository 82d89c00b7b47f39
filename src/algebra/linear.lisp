;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Linear equations with symbolic coefficients: Cramer's rule for M x = b,
;;;     x_j = sum over i of (-1)^(i+j) b_i M_ij/det M,
;;; M_ij the minor without row i and column j, canonical or unexpanded; elimination with exact zero
;;; tests for systems that are singular or not square.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/kernels" "algebra/minors" "algebra/zero"
                "algebra/evaluate" "algebra/matrices" "algebra/normal" "algebra/quotient"
                "algebra/relations" "algebra/scan"))

(defun $algebra_inverse_times (m b)
  "x with M x = b, b a list (x a list) or a matrix of columns (x a matrix)."
  (algebra-check-square m "the matrix of linear equations")
  (cond (($matrixp b) (algebra-solve-columns m b))
        (($listp b)
         (cons '(mlist simp)
               (mapcar #'cadr (cdr (algebra-solve-columns m (algebra-column b))))))
        (t (core-error "a list or a matrix was expected on the right, found ~A"
                       (algebra-short-text b)))))

(defun algebra-column (b)
  (cons '($matrix simp) (loop for x in (cdr b) collect (list '(mlist simp) x))))

(defun algebra-solve-columns (m b)
  (unless (= (length m) (length b))
    (core-error "~A equations but ~A right sides" (length (cdr m)) (length (cdr b))))
  (with-algebra-ring
    (let* ((rows (append (algebra-scan-rows m) (algebra-scan-rows b)))
           (n (length (cdr m)))
           (quotients (progn (algebra-order-kernels)
                             (mapcar (lambda (row) (mapcar #'algebra-evaluate row)) rows))))
      (algebra-cramer (subseq quotients 0 n) (nthcdr n quotients)))))

(defun algebra-cramer (rows right)
  (multiple-value-bind (matrix denominators) (algebra-row-denominators rows)
    (let* ((cofactors (algebra-cofactors (algebra-rectangle matrix)))
           (determinant (algebra-expand-first-row matrix cofactors))
           (cleared (loop for row in right
                          for d in denominators
                          collect (loop for b in row collect (algebra-times b (cons d 1))))))
      (when (algebra-zero-polynomial-p determinant)
        (core-error "the matrix of linear equations is singular"))
      (cons '($matrix simp)
            (loop for j below (length rows)
                  collect (cons '(mlist simp)
                                (algebra-cramer-row cofactors j cleared determinant)))))))

(defun algebra-expand-first-row (matrix cofactors)
  (let ((sum 0))
    (loop for entry in (car matrix)
          for j from 0
          do (setq sum (pplus sum (ptimes entry (aref cofactors 0 j)))))
    (algebra-reduce-angles sum)))

(defun algebra-cramer-row (cofactors j right determinant)
  (loop for column below (length (car right))
        collect (algebra-general-reduced
                 (algebra-over-polynomial
                  (algebra-sum (loop for row in right
                                     for i from 0
                                     collect (algebra-times (cons (aref cofactors i j) 1)
                                                            (nth column row))))
                  determinant))))

(defun algebra-over-polynomial (quotient d)
  (cons (car quotient) (ptimes (cdr quotient) d)))

;;; The same on general expressions, nothing multiplied out, for solutions that are too long in the
;;; canonical form. Minors are made from those of their later rows, so that the expressions share
;;; their parts.

(defun $algebra_short_inverse_times (m b terms)
  "x with M x = b in the canonical form; an error where a product would have more than TERMS."
  (let ((*algebra-limit* terms) (*algebra-advice* "take form = factored"))
    ($algebra_inverse_times m b)))

(defun $algebra_unexpanded_inverse_times (m b)
  "x with M x = b, b a list: sums of products of the elements."
  (algebra-check-square m "the matrix of linear equations")
  (let ((matrix (algebra-rectangle (mapcar #'cdr (cdr m)))) (right (cdr b)))
    (algebra-guard (algebra-unexpanded-size matrix right)
                   "the equations solved for the accelerations"
                   "take EquationProgram with solved = true")
    (algebra-unexpanded-solution matrix right)))

(defun algebra-unexpanded-solution (matrix right)
  (let* ((n (length right))
         (minor (algebra-minors matrix #'algebra-first-row #'mul #'add))
         (determinant (funcall minor (algebra-all-of n) (algebra-all-of n))))
    (when (eql determinant 0) (core-error "the matrix of linear equations is singular"))
    (flet ((numerator (j)
             (addn (loop for b in right
                         for i from 0
                         collect (mul (if (evenp (+ i j)) 1 -1) b
                                      (funcall minor (algebra-all-but i n) (algebra-all-but j n))))
                   nil)))
      (cons '(mlist simp)
            (loop for j below n collect (div (numerator j) determinant))))))

(defun algebra-unexpanded-size (matrix right)
  "How many nodes the solution would have, written out."
  (let* ((n (length right))
         (size (algebra-minors matrix #'algebra-first-row
                               (lambda (sign entry size)
                                 (declare (ignore sign))
                                 (+ 1 (algebra-size entry) size))
                               #'+)))
    (loop for j below n
          sum (+ (funcall size (algebra-all-of n) (algebra-all-of n))
                 (loop for b in right
                       for i from 0
                       sum (+ (algebra-size b)
                              (funcall size (algebra-all-but i n) (algebra-all-but j n))))))))

;;; b . M^-1 . b

(defun $algebra_inverse_form (m b)
  "b . M^-1 . b for a symmetric M: one numerator over one determinant."
  (algebra-check-square m "the matrix of a quadratic form")
  (unless (and ($listp b) (= (length b) (length m)))
    (core-error "a list of ~A elements was expected, found ~A"
                (length (cdr m)) (algebra-short-text b)))
  (with-algebra-ring
    (let ((rows (append (algebra-scan-rows m) (list (mapcar #'algebra-scan (cdr b))))))
      (algebra-order-kernels)
      (setq rows (mapcar (lambda (row) (mapcar #'algebra-evaluate row)) rows))
      (algebra-general-reduced (algebra-inverse-form (butlast rows) (car (last rows)))))))

(defun algebra-inverse-form (rows b)
  (multiple-value-bind (matrix denominators) (algebra-row-denominators rows)
    (let* ((cofactors (algebra-cofactors (algebra-rectangle matrix)))
           (determinant (algebra-expand-first-row matrix cofactors)))
      (algebra-over-polynomial
       (algebra-sum
        (loop for b-i in b
              for d in denominators
              for i from 0
              append (loop for b-j in b
                           for j from 0
                           collect (algebra-product
                                    (list b-i (cons d 1) (cons (aref cofactors i j) 1) b-j)))))
       determinant))))

;;; Elimination on general expressions, for systems of any shape.

(defun algebra-echelon (rows columns)
  "Reduced echelon form of ROWS, pivots in the first COLUMNS only."
  (let ((done nil))
    (dotimes (column columns)
      (let ((candidates (remove-if (lambda (row) (algebra-decided-zero-p (nth column row))) rows)))
        (when candidates
          (let* ((pivot (algebra-least candidates
                                       (lambda (row) (algebra-size (nth column row)))))
                 (leading (algebra-scale-row pivot (nth column pivot))))
            (flet ((clear (row) (algebra-clear-column row leading column)))
              (setq rows (mapcar #'clear (remove pivot rows :test #'eq))
                    done (append (mapcar #'clear done) (list leading))))))))
    (append done rows)))

(defun algebra-scale-row (row pivot)
  (mapcar (lambda (e) (algebra-normal-form (div e pivot))) row))

(defun algebra-clear-column (row leading column)
  (let ((factor (nth column row)))
    (if (eql factor 0)
        row
        (mapcar (lambda (e l) (algebra-normal-form (sub e (mul factor l)))) row leading))))

(defun $algebra_solve_linear (equations unknowns)
  "[x = .., ..] with free unknowns kept as themselves, or [] if the equations contradict."
  (let* ((xs (cdr unknowns))
         (rows (mapcar (lambda (equation) (algebra-equation-row equation xs)) (cdr equations)))
         (echelon (algebra-echelon rows (length xs))))
    (if (some (lambda (row) (algebra-contradiction-p row)) echelon)
        '((mlist simp))
        (cons '(mlist simp) (algebra-solutions echelon xs)))))

(defun algebra-equation-row (equation xs)
  "Coefficients of the unknowns, then the negative rest."
  (let* ((e (if (mequalp equation) (sub (cadr equation) (caddr equation)) equation))
         (rest (algebra-normal-form (algebra-substitute-zero e xs)))
         (coefficients (loop for x in xs
                             collect (algebra-normal-form (algebra-linear-coefficient e x xs)))))
    (unless (eq t (algebra-zero-test
                   (sub e (add rest (addn (mapcar #'mul coefficients xs) nil)))))
      (core-error "~A is not linear in the unknowns" (algebra-short-text equation)))
    (append coefficients (list (mul -1 rest)))))

(defun algebra-substitute-zero (e xs)
  (dolist (x xs e)
    (setq e (maxima-substitute 0 x e))))

(defun algebra-linear-coefficient (e x xs)
  "e at x = 1 without e at x = 0, the other unknowns zero."
  (let ((others (algebra-substitute-zero e (remove x xs :test #'alike1))))
    (sub (maxima-substitute 1 x others) (maxima-substitute 0 x others))))

(defun algebra-contradiction-p (row)
  (and (every #'algebra-decided-zero-p (butlast row))
       (not (algebra-decided-zero-p (car (last row))))))

(defun algebra-solutions (rows xs)
  (let ((pivots (loop for row in rows
                      for place = (position-if-not #'algebra-decided-zero-p (butlast row))
                      when place collect (cons place row))))
    (loop for x in xs
          for place from 0
          for row = (cdr (assoc place pivots))
          collect (list '(mequal simp) x (if row (algebra-solution row place xs) x)))))

(defun algebra-solution (row place xs)
  (algebra-normal-form
   (sub (car (last row))
        (addn (loop for coefficient in (butlast row)
                    for x in xs
                    for k from 0
                    unless (= k place) collect (mul coefficient x))
              nil))))
