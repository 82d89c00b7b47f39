;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A constant matrix M in numbers. Where M x' = X has a regular M its pivots are guards. Where it is
;;; singular, l M = 0 and M r = 0, the equations l.X = 0 must determine the states along r: the
;;; matrix of the derivatives of l.X along r is regular, the index is 1. (E. Hairer, G. Wanner,
;;; Solving ordinary differential equations II, VI.1.) See numerics-checked-mass first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "forms/fixed" "forms/judge"
                "forms/program_judge" "forms/rates" "forms/sparse_elimination" "forms/value"
                "numerics/rate_mass"))

(defparameter *numerics-dense-group* 150 "States of a group whose rank is found.")

(defstruct numerics-kernel group left right) ; of a group of places: bases of l and of r

(defun numerics-checked-mass (rates old values)
  "RATES with guards for what stays in M, which is regular or of index 1. OLD are the rates before
the exchange of VALUES, for the message."
  (let ((rows (forms-rates-mass rates)) (kernels '()))
    (dolist (group (numerics-groups rows) rates)
      (let ((numbers (numerics-number-rows (numerics-group-rows group rows))))
        (when (and numbers (not (numerics-unit-p numbers)))
          (let ((kernel (numerics-kernel-of group numbers)))
            (cond (kernel (push kernel kernels))
                  (t (setf (forms-rates-guards rates)
                           (append (forms-rates-guards rates)
                                   (numerics-number-guards rates group numbers)))))))))
    (when kernels (numerics-check-index rates (reverse kernels) old values))
    rates))

(defun numerics-number-rows (rows)
  "ROWS with numbers in units of 2^-512 for their elements; nil where a name is in them."
  (let ((elements (loop for row in rows append (mapcar #'cdr row))))
    (unless (remove-if (lambda (name) (member name '($%pi $%e))) (algebra-inputs-of elements))
      (let ((values (forms-program-values elements (forms-new-point nil))))
        (loop for row in rows
              collect (loop for (j) in row collect (cons j (pop values))))))))

(defun numerics-unit-p (rows) (and (null (cdr rows)) (equal (first rows) (list (cons 0 (forms-fixed 1))))))

;;; Rank.

(defun numerics-dense-rows (rows)
  (loop for row in rows
        collect (loop for j below (length rows) collect (or (cdr (assoc j row)) 0))))

(defun numerics-kernel-of (group rows)
  "The numerics-kernel of GROUP with the numbers ROWS; nil where they are regular."
  (when (<= (length group) *numerics-dense-group*)
    (let* ((dense (numerics-dense-rows rows)) (right (numerics-exact-null-vectors dense)))
      (when right
        (make-numerics-kernel
         :group group :right right
         :left (numerics-exact-null-vectors (forms-transposed dense)))))))

(defun numerics-exact-null-vectors (rows)
  "A basis of the x with ROWS x = 0."
  (let* ((n (length rows)) (echelon (coerce (values (forms-echelon rows n)) 'vector)))
    (loop for free below n
          unless (aref echelon free)
            collect (let ((x (make-list n :initial-element 0)))
                      (setf (nth free x) (forms-fixed 1))
                      (loop for i from (1- free) downto 0
                            for row = (aref echelon i)
                            do (when row
                                 (setf (nth i x)
                                       (round (ash (- (forms-fixed-dot (rest row) (nthcdr (1+ i) x)))
                                                   forms-digits)
                                              (first row)))))
                      x))))

;;; Pivots of a regular group, in double-float numbers.

(defun numerics-number-guards (rates group rows)
  (let ((doubles (loop for row in rows
                       collect (loop for (j . x) in row
                                     collect (cons j (coerce (/ x (ash 1 forms-digits))
                                                             'double-float)))))
        (names (numerics-guarded-names rates group)))
    (when (numerics-symmetric-p rows)
      (loop for step in (forms-sparse-factors
                         doubles (constantly 1d0)
                         (make-forms-arithmetic :subtract #'- :multiply #'* :divide #'/))
            for place = (forms-sparse-step-place step)
            collect (list* (nth place names)
                           (rational (forms-sparse-step-pivot step))
                           (rational (cdr (assoc place (nth place doubles)))))))))

(defun numerics-symmetric-p (rows)
  (loop for row in rows
        for i from 0
        always (loop for (j . x) in row
                     always (eql x (or (cdr (assoc i (nth j rows))) 0)))))

;;; Index.

(defun numerics-check-index (rates kernels old values)
  (let* ((point (forms-new-point t))
         (columns (catch 'forms-no-value (numerics-index-columns rates kernels point)))
         (n (length columns)))
    (when (and columns (member nil (forms-echelon columns n)))
      (let ((names (numerics-vanished-values kernels old values)))
        (core-error "~@[with ~{~a = 0~^, ~} ~]the matrix of ~{~a~^, ~} is singular, and the ~
                     equations that remain do not determine what it leaves open"
                    (mapcar (lambda (name) (core-words (list name))) names)
                    (mapcar (lambda (name) (core-words (list name)))
                            (numerics-kernel-states rates kernels)))))))

(defun numerics-kernel-states (rates kernels)
  (loop for kernel in kernels
        append (loop for i in (numerics-kernel-group kernel)
                     collect (nth i (forms-rates-states rates)))))

(defun numerics-index-columns (rates kernels point)
  "For each r the derivatives of all l.X along it."
  (let ((right (numerics-right-sides rates)))
    (loop for kernel in kernels
          append (loop for r in (numerics-kernel-right kernel)
                       collect (numerics-index-column rates kernels kernel r right point)))))

(defun numerics-index-column (rates kernels kernel r right point)
  (let* ((direction (loop for i in (numerics-kernel-group kernel)
                          for x in r
                          collect (cons (nth i (forms-rates-states rates)) x)))
         (places (loop for kernel in kernels append (numerics-kernel-group kernel)))
         (elements (mapcar (lambda (i) (nth i right)) places))
         (slopes (numerics-slopes elements point direction)))
    (loop for other in kernels
          for own = (loop for nil in (numerics-kernel-group other) collect (pop slopes))
          append (loop for l in (numerics-kernel-left other) collect (forms-fixed-dot l own)))))

(defun numerics-slopes (elements point direction)
  "The derivatives of ELEMENTS along the DIRECTION, by a quotient of differences."
  (flet ((values-after (step)
           (forms-program-values elements (forms-point-along point direction step))))
    (let ((step (forms-step forms-slope-digits)))
      (mapcar (lambda (after before)
                (forms-quotient-of-differences after before forms-slope-digits))
              (values-after step) (values-after (- step))))))

(defun numerics-vanished-values (kernels old values)
  "The names of VALUES that are 0 and stood in the rows of the KERNELS."
  (let ((inputs (algebra-inputs-of
                 (loop for kernel in kernels
                       append (loop for i in (numerics-kernel-group kernel)
                                    append (mapcar #'cdr (nth i (forms-rates-mass old))))))))
    (loop for (name . element) in values
          when (and (eql element 0) (member name inputs)) collect name)))
