;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The matrix M of M x' = X after the exchange of values, group by group of states that it joins. A
;;; state alone is divided by its entry; a group whose entries depend on the state is solved on the
;;; program; a constant group stays in M, which is never inverted, and so does what is singular,
;;; such as a state without an entry: then equations are algebraic. See numerics-settled-rates
;;; first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_nodes" "forms/fixed" "forms/judge"
                "forms/program_judge" "forms/rates" "forms/sparse_elimination" "forms/value"))

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
:regular, those that are singular or long; :rated, states without rates alone; t, none. A singular
one that may not stay is an error."
  (if (null (forms-rates-mass rates))
      rates
      (let* ((rows (forms-rates-mass rates)) (copy (copy-forms-rates rates)) (kept '())
             (right (coerce (forms-right-sides rates) 'vector)))
        (dolist (group (numerics-groups rows))
          (unless (numerics-settle-group copy group (numerics-group-rows group rows) right solved)
            (push group kept)))
        (setf (forms-rates-mass copy) (and kept (numerics-kept-rows (reverse kept) rows))
              (forms-rates-impulses copy) (numerics-settled-impulses rates solved))
        (forms-set-right-sides copy (coerce right 'list))
        copy)))

(defun numerics-settled-impulses (rates solved)
  "The impulses of RATES, their gaps divided as X is."
  (let ((n (length (forms-rates-states rates))))
    (loop for (u . gaps) in (forms-rates-impulses rates)
          collect (let ((copy (copy-forms-rates rates)))
                    (setf (forms-rates-impulses copy) '() (forms-rates-guards copy) '())
                    (forms-set-right-sides copy (loop for i below n
                                                      collect (or (cdr (assoc i gaps)) 0)))
                    (cons u (loop for gap in (forms-right-sides
                                              (numerics-settled-rates copy solved))
                                  for i from 0
                                  unless (eql gap 0) collect (cons i gap)))))))

(defun numerics-settle-group (rates group rows right solved)
  "Divides the elements of GROUP in the vector RIGHT; nil where the group stays."
  (let* ((constant (numerics-constant-p (loop for row in rows append (mapcar #'cdr row))
                                        (forms-rates-states rates)))
         (numbers (and constant (numerics-number-rows rows)))
         (singular (or (every #'null rows) (and numbers (numerics-kernel-of group numbers))))
         (names (numerics-guarded-names rates group))
         (stays (if singular
                    (or (member solved '(nil :regular))
                        (and (eq solved :rated) (every #'null rows)))
                    (and constant (cdr group) (numerics-mass-stays-p group solved)))))
    (when (and singular (not stays))
      (if (every #'null rows) (numerics-fault-algebraic names) (numerics-fault-group names)))
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

(defun numerics-fault-algebraic (names)
  (core-error "~{~a~^, ~} ~:[has~;have~] no rate, but an equation 0 = ..: Simulate serves such; ~
               else put in what follows from it, and give equations 'diff(x,t) = .. of the ~
               variables that are left"
              (mapcar (lambda (x) (core-words (list x))) names) (cdr names)))

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

;;; Groups of a constant matrix M in numbers, to 512 binary digits: whether one is regular, else the
;;; l and r with l M = 0, M r = 0; and pivots of a regular one. See numerics-kernel-of first.

(defparameter *numerics-dense-group* 150 "States of a group whose rank is found.")

(defstruct numerics-kernel group left right) ; of a group of places: bases of l and of r

(defun numerics-number-rows (rows)
  "ROWS with numbers in units of 2^-512 for their elements; nil where a name is in them."
  (let ((elements (loop for row in rows append (mapcar #'cdr row))))
    (unless (algebra-open-inputs-of elements)
      (let ((values (forms-program-values elements (forms-new-point nil))))
        (loop for row in rows
              collect (loop for (j) in row collect (cons j (pop values))))))))

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
          unless (aref echelon free) collect (numerics-exact-null-vector echelon free n))))

(defun numerics-exact-null-vector (echelon free n)
  "That of which the place FREE is 1."
  (let ((x (make-list n :initial-element 0)))
    (setf (nth free x) (forms-fixed 1))
    (loop for i from (1- free) downto 0
          for row = (aref echelon i)
          for known = (and row (forms-fixed-dot (rest row) (nthcdr (1+ i) x)))
          do (when row (setf (nth i x) (round (ash (- known) forms-digits) (first row)))))
    x))

;;; Pivots of a regular group, in double-float numbers.

(defun numerics-number-guards (names rows)
  "(name pivot . whole) of the regular and symmetric ROWS of NAMES."
  (let ((doubles (loop for row in rows
                       collect (loop for (j . x) in row
                                     collect (cons j (coerce (/ x (ash 1 forms-digits))
                                                             'double-float))))))
    (loop for step in (forms-sparse-factors
                       doubles (constantly 1d0)
                       (make-forms-arithmetic :subtract #'- :multiply #'* :divide #'/))
          for place = (forms-sparse-step-place step)
          collect (list* (nth place names)
                         (rational (forms-sparse-step-pivot step))
                         (rational (cdr (assoc place (nth place doubles))))))))

(defun numerics-symmetric-p (rows)
  (loop for row in rows
        for i from 0
        always (loop for (j . x) in row
                     always (eql x (or (cdr (assoc i (nth j rows))) 0)))))

;;; Where a constant M is singular, l M = 0 and M r = 0, the equations l.X = 0 have to determine the
;;; states along r: the matrix of the derivatives of l.X along r is regular, the index is 1.
;;; (E. Hairer, G. Wanner, Solving ordinary differential equations II, VI.1.)
;;; See numerics-checked-index first.

(defun numerics-checked-index (rates old values)
  "RATES, whose M is regular or of index 1. OLD are the rates before the exchange of VALUES, for the
message."
  (let* ((rows (forms-rates-mass rates))
         (kernels (loop for group in (numerics-groups rows)
                        for numbers = (numerics-number-rows (numerics-group-rows group rows))
                        for kernel = (and numbers (numerics-kernel-of group numbers))
                        when kernel collect kernel)))
    (when kernels (numerics-check-index rates kernels old values))
    rates))

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
  (let ((right (forms-right-sides rates)))
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
