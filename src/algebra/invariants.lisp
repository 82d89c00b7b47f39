;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Polynomials f(x) that a field X leaves alone, X.grad f = 0: linear equations for the
;;; coefficients of f, one for each monomial of the left side.  Modulo a prime, parameters being
;;; numbers, there are at least as many f as without; where as many are known the rest is spared.
;;; Else the equations, which fall apart into blocks, are solved exactly: rational ones modulo
;;; primes (rank.lisp), others by elimination without fractions, rows with few entries first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common_roots" "algebra/evaluate" "algebra/groebner" "algebra/kernels"
                "algebra/matrices" "algebra/modular" "algebra/normal" "algebra/quotient"
                "algebra/rank" "algebra/relations" "algebra/scan" "algebra/size"))

(defparameter *algebra-invariant-work* 4000000
  "Coefficients that the elimination may cost: some twenty seconds.")

(defun $algebra_invariants (fields names least most known)
  "[places of independent ones among KNOWN, further f], f of degrees from LEAST to MOST, FIELDS and
KNOWN polynomials with whole coefficients. False where parameters are bound; `too_large'."
  (with-algebra-ring
    (let* ((*algebra-may-give-up* t)
           (*algebra-work-left* (core-sized *algebra-invariant-work*))
           (skeletons (mapcar #'algebra-scan (append (cdr fields) (cdr known))))
           (kernels (mapcar #'algebra-scan (cdr names)))
           (answer (catch 'algebra-too-large
                     (algebra-order-kernels)
                     (if (algebra-polynomial-kernels-p kernels)
                         (algebra-invariants-of (mapcar (lambda (s) (algebra-whole-terms s kernels))
                                                        skeletons)
                                                kernels least most)))))
      (if (eq answer 'too-large) '$too_large answer))))

(defun algebra-whole-terms (skeleton kernels)
  (destructuring-bind (n . d) (algebra-evaluate skeleton)
    (unless (eql d 1) (core-error "polynomials with whole coefficients were expected"))
    (algebra-monomial-terms n (mapcar #'algebra-kernel-variable kernels))))

(defun algebra-invariants-of (terms kernels least most)
  (let* ((n (length kernels))
         (known (nthcdr n terms))
         (places (algebra-monomial-places (algebra-monomials-between n least most)))
         (blocks (algebra-column-blocks (algebra-invariant-rows (subseq terms 0 n) places)
                                        (hash-table-count places)))
         (point (algebra-modular-point 20011))
         (chosen (algebra-independent-vectors known places point)))
    (list '(mlist simp)
          (cons '(mlist simp) (mapcar #'1+ chosen))
          (cons '(mlist simp)
                (if (< (length chosen) (algebra-nullity-at blocks point))
                    (algebra-further-invariants known blocks places point kernels))))))

;;; The equations

(defun algebra-monomials-between (n least most)
  (loop for degree from most downto least append (algebra-monomials-of-degree n degree)))

(defun algebra-monomials-of-degree (n degree)
  "Lists of N exponents."
  (if (= n 1)
      (list (list degree))
      (loop for first from degree downto 0
            append (loop for rest in (algebra-monomials-of-degree (1- n) (- degree first))
                         collect (cons first rest)))))

(defun algebra-monomial-places (monomials)
  (let ((places (make-hash-table :test #'equal)))
    (loop for monomial in monomials
          for place from 0
          do (setf (gethash monomial places) place))
    places))

(defun algebra-invariant-rows (fields places)
  "Equations ((column . coefficient) ..), columns ascending."
  (let ((rows (make-hash-table :test #'equal)))
    (loop for monomial being the hash-keys of places using (hash-value column)
          do (loop for (exponents . a) in (algebra-derived-monomial monomial fields)
                   do (push (cons column a) (gethash exponents rows))))
    (loop for row being the hash-values of rows
          for sorted = (algebra-added-entries row)
          when sorted collect sorted)))

(defun algebra-derived-monomial (monomial fields)
  "Terms of the field applied to MONOMIAL, some alike."
  (loop for field in fields
        for power in monomial
        for i from 0
        unless (zerop power)
          append (loop for (exponents . a) in field
                       collect (cons (mapcar #'+ (algebra-lowered monomial i) exponents)
                                     (ptimes power a)))))

(defun algebra-added-entries (entries)
  "Entries of one column added; none that is 0."
  (let ((sums nil))
    (loop for (column . a) in (sort entries #'< :key #'car)
          do (if (eql column (caar sums))
                 (setf (cdar sums) (pplus a (cdar sums)))
                 (push (cons column a) sums)))
    (nreverse (delete-if (lambda (entry) (pzerop (cdr entry))) sums))))

;;; Blocks: columns that equations join, with these equations

(defun algebra-column-blocks (rows count)
  "((columns . rows) ..), columns ascending."
  (let ((parent (make-array count)) (blocks (make-hash-table)))
    (dotimes (k count) (setf (aref parent k) k))
    (labels ((root (k)
               (loop until (= k (aref parent k))
                     do (setf (aref parent k) (aref parent (aref parent k))
                              k (aref parent k)))
               k))
      (dolist (row rows)
        (loop for (column . nil) in (rest row)
              do (setf (aref parent (root column)) (root (caar row)))))
      (loop for k from (1- count) downto 0
            do (push k (car (or (gethash (root k) blocks)
                                (setf (gethash (root k) blocks) (list nil))))))
      (dolist (row rows) (push row (cdr (gethash (root (caar row)) blocks)))))
    (loop for block being the hash-values of blocks collect block)))

(defun algebra-dense-rows (block value)
  "Rows of a BLOCK with the VALUE of each coefficient in the places of its columns."
  (destructuring-bind (columns . rows) block
    (loop for row in rows
          collect (loop for column in columns
                        for entry = (assoc column row)
                        collect (if entry (funcall value (cdr entry)) 0)))))

(defun algebra-nullity-at (blocks point)
  "Dimension of the null space modulo the prime at POINT."
  (loop for block in blocks
        for rows = (algebra-dense-rows block (lambda (a) (algebra-modular-value a point)))
        sum (- (length (car block))
               (if rows (length (algebra-echelon-modulo rows (algebra-prime))) 0))))

;;; Vectors that are independent at a point

(defun algebra-independent-vectors (vectors places point)
  "Numbers of those of VECTORS of terms that are no combination of those before."
  (if vectors
      (let ((columns (loop for terms in vectors
                           collect (algebra-vector-at terms places point))))
        (mapcar #'car
                (algebra-echelon-modulo (loop for k below (hash-table-count places)
                                              collect (loop for column in columns
                                                            collect (aref column k)))
                                        (algebra-prime))))))

(defun algebra-vector-at (terms places point)
  (let ((vector (make-array (hash-table-count places) :initial-element 0)))
    (loop for (exponents . a) in terms
          do (setf (aref vector (gethash exponents places)) (algebra-modular-value a point)))
    vector))

(defun algebra-further-invariants (known blocks places point kernels)
  "Expressions that complete KNOWN to a basis."
  (let* ((monomials (algebra-places-in-order places))
         (found (loop for block in blocks
                      append (loop for vector in (algebra-block-null-space block)
                                   collect (loop for (column . a) in vector
                                                 collect (cons (aref monomials column) a)))))
         (count (length known))
         (chosen (algebra-independent-vectors (append known found) places point)))
    (loop for k in chosen
          when (>= k count)
            collect (algebra-expression-of (nth (- k count) found) kernels))))

(defun algebra-places-in-order (places)
  (let ((monomials (make-array (hash-table-count places))))
    (loop for monomial being the hash-keys of places using (hash-value k)
          do (setf (aref monomials k) monomial))
    monomials))

;;; The null space of a block, vectors ((column . coefficient) ..) of polynomials in parameters

(defun algebra-block-null-space (block)
  (destructuring-bind (columns . rows) block
    (cond ((null rows) (loop for column in columns collect (list (cons column 1))))
          ((every (lambda (row) (every (lambda (entry) (integerp (cdr entry))) row)) rows)
           (algebra-rational-block-null-space block))
          (t (algebra-sparse-null-space columns rows)))))

(defun algebra-rational-block-null-space (block)
  (loop for vector in (algebra-rational-null-space (algebra-dense-rows block #'identity))
        for whole = (algebra-without-fractions (mapcar #'algebra-rational-number vector))
        collect (loop for column in (car block)
                      for a in whole
                      unless (eql a 0) collect (cons column a))))

(defun algebra-sparse-null-space (columns rows)
  (let* ((steps (algebra-sparse-steps rows))
         (pivots (mapcar #'car steps)))
    (loop for free in columns
          unless (member free pivots)
            collect (algebra-null-vector free steps))))

(defun algebra-sparse-steps (rows)
  "((pivot column . row) ..), the last one first: each row contains no pivot of those before it."
  (let ((steps nil))
    (loop while rows
          do (let* ((row (algebra-least rows #'algebra-row-cost))
                    (column (car (algebra-least row (lambda (entry)
                                                      (algebra-poly-size (cdr entry)))))))
               (push (cons column row) steps)
               (setq rows (loop for other in (delete row rows :test #'eq)
                                for left = (algebra-eliminated column other row)
                                when left collect left))))
    steps))

(defun algebra-row-cost (row)
  (loop for (nil . a) in row sum (if (integerp a) 1 (* 2 (algebra-poly-size a)))))

(defun algebra-eliminated (column row pivot-row)
  "ROW without its entry in COLUMN, by a multiple of PIVOT-ROW, without common factor."
  (let ((entry (assoc column row)))
    (if (null entry)
        row
        (multiple-value-bind (c d)
            (algebra-cancelling (cdr entry) (cdr (assoc column pivot-row)))
          (let ((left (algebra-combined-rows c row (pminus d) pivot-row)))
            (algebra-count-work left)
            (algebra-primitive-row left))))))

(defun algebra-combined-rows (c row d other)
  (let ((sum nil))
    (loop while (or row other)
          do (cond ((or (null other) (and row (< (caar row) (caar other))))
                    (push (cons (caar row) (ptimes c (cdar row))) sum)
                    (pop row))
                   ((or (null row) (< (caar other) (caar row)))
                    (push (cons (caar other) (ptimes d (cdar other))) sum)
                    (pop other))
                   (t (let ((a (pplus (ptimes c (cdar row)) (ptimes d (cdar other)))))
                        (unless (pzerop a) (push (cons (caar row) a) sum)))
                      (pop row)
                      (pop other))))
    (nreverse sum)))

(defun algebra-primitive-row (row)
  (let ((content (algebra-content-of row)))
    (if (or (null row) (member content '(1 -1)))
        row
        (loop for (column . a) in row collect (cons column (pquotient a content))))))

(defun algebra-null-vector (free steps)
  "The vector with 1 in the place FREE and 0 in those of the other free unknowns, made whole."
  (let ((values (list (list* free 1 1))))
    (loop for (column . row) in steps
          do (let ((sum (algebra-sum
                         (loop for (other . a) in row
                               for value = (cdr (assoc other values))
                               when value collect (algebra-times (cons (pminus a) 1) value)))))
               (unless (pzerop (car sum))
                 (push (cons column (algebra-quotient-of (car sum)
                                                         (ptimes (cdr sum)
                                                                 (cdr (assoc column row)))))
                       values))))
    (multiple-value-bind (whole d) (algebra-common-denominator (mapcar #'cdr values))
      (declare (ignore d))
      (algebra-primitive-row (loop for (column . nil) in values
                                   for a in whole collect (cons column a))))))
