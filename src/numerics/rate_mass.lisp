;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The matrix M of M x' = X after the exchange of values, group by group of states that it joins. A
;;; state alone is divided by its entry; a group whose entries depend on the state is solved on the
;;; program; a constant group stays in M, which is never inverted, and so does what is singular,
;;; such as a state without an entry: then equations are algebraic. See numerics-settled-rates
;;; first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_nodes"
                "forms/rates" "forms/sparse_elimination" "numerics/mass_rank"))

;;; Groups.

(defun numerics-groups (rows)
  "The lists of places, each sorted, that the sparse ROWS join."
  (let ((parent (make-array (length rows))) (members (make-hash-table)))
    (dotimes (i (length rows)) (setf (aref parent i) i))
    (labels ((root (i) (if (= i (aref parent i)) i (setf (aref parent i) (root (aref parent i))))))
      (loop for row in rows
            for i from 0
            do (loop for (j . element) in row
                     unless (eql element 0) do (setf (aref parent (root i)) (root j))))
      (loop for i from (1- (length rows)) downto 0 do (push i (gethash (root i) members)))
      (sort (loop for group being the hash-values of members collect group) #'< :key #'first))))

(defun numerics-group-rows (group rows)
  "The ROWS of GROUP, their places counted in it."
  (loop for i in group
        collect (loop for (j . element) in (nth i rows)
                      unless (eql element 0) collect (cons (position j group) element))))

(defun numerics-constant-p (elements states)
  "Whether ELEMENTS depend neither on STATES nor on the time."
  (notany (lambda (name) (or (eq name '$t) (member name states :test #'algebra-same-name-p)))
          (algebra-inputs-of elements)))

;;; Each group.

(defun numerics-settled-rates (rates solved)
  "RATES with X divided by M as far as it goes. SOLVED, of constant groups: nil, they stay in M;
:regular, those that are singular or long; t, none, and a singular one is an error."
  (if (null (forms-rates-mass rates))
      rates
      (let* ((rows (forms-rates-mass rates)) (copy (copy-forms-rates rates)) (kept '())
             (right (coerce (numerics-right-sides rates) 'vector)))
        (dolist (group (numerics-groups rows))
          (unless (numerics-settle-group copy group (numerics-group-rows group rows) right solved)
            (push group kept)))
        (setf (forms-rates-mass copy) (and kept (numerics-kept-rows (reverse kept) rows)))
        (numerics-set-right-sides copy (coerce right 'list))
        copy)))

(defun numerics-right-sides (rates)
  (cdr (cdr (assoc '$rates (forms-rates-outputs rates)))))

(defun numerics-set-right-sides (rates elements)
  (setf (forms-rates-outputs rates)
        (cons (cons '$rates (cons :list elements))
              (remove '$rates (forms-rates-outputs rates) :key #'car))))

(defun numerics-settle-group (rates group rows right solved)
  "Divides the elements of GROUP in the vector RIGHT; nil where the group stays."
  (let* ((constant (numerics-constant-p (loop for row in rows append (mapcar #'cdr row))
                                        (forms-rates-states rates)))
         (numbers (and constant (numerics-number-rows rows)))
         (singular (or (every #'null rows) (and numbers (numerics-kernel-of group numbers))))
         (names (numerics-guarded-names rates group))
         (stays (if singular
                    (not (eq solved t))
                    (and constant (cdr group) (numerics-mass-stays-p group solved)))))
    (when (and singular (not stays)) (numerics-fault-group names))
    (when (and numbers (cdr group) (not singular))
      (numerics-guard-group rates (numerics-constant-guards names rows numbers)))
    (unless stays
      (let ((steps (numerics-solve-group names group rows right)))
        (unless constant (numerics-guard-group rates (numerics-group-guards names rows steps))))
      t)))

(defun numerics-mass-stays-p (group solved)
  "Whether the constant regular GROUP stays in M; a long one would fill the program."
  (or (null solved)
      (and (eq solved :regular) (> (length group) *numerics-dense-group*))))

(defun numerics-guard-group (rates guards)
  (setf (forms-rates-guards rates) (append (forms-rates-guards rates) guards)))

(defparameter *numerics-exact-group* 8 "States of a group whose pivots are found exactly.")

(defun numerics-constant-guards (names rows numbers)
  "Guards of a constant group with ROWS, NUMBERS being their values."
  (cond ((not (numerics-symmetric-p numbers)) '())
        ((<= (length names) *numerics-exact-group*)
         (numerics-group-guards names rows (forms-sparse-factors rows (constantly 1))))
        (t (numerics-number-guards names numbers))))

(defun numerics-fault-group (names)
  (core-error "the matrix of ~{~a~^, ~} is singular: the rates do not follow from the equations"
              (mapcar (lambda (x) (core-words (list x))) names)))

(defun numerics-solve-group (names group rows right)
  "The steps of the elimination by which the elements of GROUP in RIGHT are solved."
  (let ((steps (forms-sparse-factors (numerics-symmetric-rows rows names)
                                     (lambda (place)
                                       (declare (ignore place))
                                       (numerics-fault-group names)))))
    (loop for i in group
          for element in (forms-sparse-solution steps (mapcar (lambda (i) (aref right i)) group))
          do (setf (aref right i) element))
    steps))

(defun numerics-guarded-names (rates group)
  "The states of GROUP; coordinates in place of their velocities."
  (let ((n (forms-rates-split rates)))
    (loop for i in group
          collect (nth (if (and n (>= i n)) (- i n) i) (forms-rates-states rates)))))

(defun numerics-symmetric-rows (rows names)
  "ROWS, or an error where they are not symmetric."
  (loop for row in rows
        for i from 0
        do (loop for (j . element) in row
                 unless (eql element (cdr (assoc i (nth j rows))))
                   do (core-error "the matrix of ~{~a~^, ~} is not symmetric; leave solved = true ~
                                   out"
                                  (mapcar (lambda (x) (core-words (list x))) names))))
  rows)

(defun numerics-group-guards (names rows steps)
  (loop for step in steps
        for place = (forms-sparse-step-place step)
        collect (list* (nth place names) (forms-sparse-step-pivot step)
                       (cdr (assoc place (nth place rows))))))

(defun numerics-kept-rows (groups rows)
  "ROWS of the GROUPS that stay, rows of the unit matrix for the others."
  (let ((kept (loop for group in groups append group)))
    (loop for row in rows
          for i from 0
          collect (if (member i kept) row (list (cons i 1))))))
