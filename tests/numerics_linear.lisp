;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_linear.mac: matrices by chance, the same on every Lisp, and their systems
;;; solved in exact rational numbers, complex ones too.

(in-package :maxima)

(defvar *linear-seed* 1)

(defun linear-random (n)
  "A whole number below N (Knuth, The Art of Computer Programming 2, section 3.3.4)."
  (setq *linear-seed* (mod (+ (* 6364136223846793005 *linear-seed*) 1442695040888963407)
                           (expt 2 64)))
  (mod (ash *linear-seed* -33) n))

(defun linear-eighth () (/ (- (linear-random 65) 32) 8))

;;; Exact systems: a matrix is a vector of rows.

(defun linear-matrix (n)
  (coerce (loop repeat n collect (make-array n :initial-element 0)) 'vector))

(defun linear-rank-and-solution (a columns)
  "The rank of A, and its inverse times COLUMNS, rows of right sides, where there is one."
  (let* ((rows (map 'vector (lambda (row right) (concatenate 'vector row right)) a columns))
         (m (length rows)) (n (if (= m 0) 0 (length (aref a 0)))) (rank 0))
    (dotimes (j n)
      (let ((pivot (position-if (lambda (row) (/= 0 (aref row j))) rows :start rank)))
        (when pivot
          (rotatef (aref rows rank) (aref rows pivot))
          (let ((top (aref rows rank)))
            (dotimes (i m)
              (unless (or (= i rank) (= 0 (aref (aref rows i) j)))
                (let ((factor (/ (aref (aref rows i) j) (aref top j))))
                  (map-into (aref rows i) (lambda (x y) (- x (* factor y))) (aref rows i) top)))))
          (incf rank)
          (when (= rank m) (return)))))
    (values rank
            (when (= rank m n)
              (map 'vector (lambda (row i) (map 'vector (lambda (x) (/ x (aref row i)))
                                                (subseq row n)))
                   rows (loop for i below n collect i))))))

(defun linear-rank (a)
  (linear-rank-and-solution a (map 'vector (lambda (row) (declare (ignore row)) #()) a)))

(defun linear-inverse (a)
  (let ((unit (linear-matrix (length a))))
    (dotimes (i (length a)) (setf (aref (aref unit i) i) 1))
    (nth-value 1 (linear-rank-and-solution a unit))))

(defun linear-norm (rows)
  "A bound of the largest sum of sizes in a row."
  (reduce #'max (map 'list (lambda (row) (reduce #'+ (map 'vector #'linear-size row))) rows)))

(defun linear-size (z) (+ (abs (realpart z)) (abs (imagpart z))))

;;; A case: pattern and entries of J and M, a shift, and the matrix shift*M - J that they make.

(defstruct linear-case n pattern entries mass shift matrix)

(defun linear-random-pattern (n share)
  (let ((columns (make-array n)))
    (dotimes (j n (numerics-pattern-of-columns columns))
      (setf (aref columns j)
            (loop for i below n when (< (linear-random 100) share) collect i)))))

(defun linear-values (pattern)
  (map 'vector (lambda (row) (declare (ignore row)) (linear-eighth))
       (numerics-pattern-rows pattern)))

(defun linear-add-entries (matrix pattern values factor)
  (loop for i across (numerics-pattern-rows pattern)
        for j across (numerics-column-numbers pattern)
        for value across values
        do (incf (aref (aref matrix i) j) (* factor value))))

(defun linear-new-case (n share complex)
  (let* ((pattern (linear-random-pattern n share)) (entries (linear-values pattern))
         (mass-pattern (and (= 0 (linear-random 2)) (linear-random-pattern n share)))
         (mass-values (and mass-pattern (linear-values mass-pattern)))
         (shift (if complex
                    (complex (linear-eighth) (1+ (linear-random 8)))
                    (linear-eighth)))
         (matrix (linear-matrix n)) (unit (numerics-pattern-of-columns
                                           (map 'vector #'list (loop for i below n collect i)))))
    (linear-add-entries matrix pattern entries -1)
    (linear-add-entries matrix (or mass-pattern unit)
                        (or mass-values (make-array n :initial-element 1)) shift)
    (make-linear-case :n n :pattern pattern :entries entries :shift shift :matrix matrix
                      :mass (and mass-pattern
                                 (make-numerics-matrix :pattern mass-pattern
                                                       :values (linear-doubles mass-values))))))

(defun linear-doubles (values)
  (map 'numerics-vector (lambda (x) (coerce x 'double-float)) values))

(defun linear-solver (case complex kind)
  (let ((solver (numerics-make-solver (linear-case-n case) (linear-case-pattern case)
                                      (linear-case-mass case) :complex complex :kind kind))
        (shift (linear-case-shift case)))
    (setf (numerics-solver-shift solver) (coerce (realpart shift) 'double-float)
          (numerics-solver-shift-imaginary solver) (coerce (imagpart shift) 'double-float))
    solver))

(defun linear-solved (solver right)
  "The solution by SOLVER, in rational numbers."
  (let ((x (linear-doubles (map 'vector #'realpart right)))
        (y (linear-doubles (map 'vector #'imagpart right))))
    (if (numerics-solver-complex solver) (numerics-solve solver x y) (numerics-solve solver x))
    (map 'vector (lambda (u v) (complex (rational u) (rational v))) x y)))

(defun linear-accurate-p (case solver)
  "Whether the solution is as near to the exact one as 64*n*u*|A|*|1/A| says."
  (let* ((n (linear-case-n case)) (matrix (linear-case-matrix case))
         (inverse (linear-inverse matrix))
         (right (map 'vector (lambda (row) (declare (ignore row))
                               (if (numerics-solver-complex solver)
                                   (complex (linear-eighth) (linear-eighth))
                                   (linear-eighth)))
                     matrix))
         (exact (map 'vector (lambda (row) (reduce #'+ (map 'vector #'* row right))) inverse))
         (size (reduce #'max (map 'vector #'linear-size exact))))
    (<= (reduce #'max (map 'vector (lambda (a b) (linear-size (- a b)))
                           exact (linear-solved solver right)))
        (* 64 n (expt 2 -53) (linear-norm matrix) (linear-norm inverse) size))))

(defun linear-without (matrix row column)
  (map 'vector (lambda (entries) (if column
                                     (concatenate 'vector (subseq entries 0 column)
                                                  (subseq entries (1+ column)))
                                     entries))
       (if row (concatenate 'vector (subseq matrix 0 row) (subseq matrix (1+ row))) matrix)))

(defun linear-named-p (case solver)
  "Whether the column that SOLVER names follows from the others, and the row where it is named."
  (let* ((matrix (linear-case-matrix case)) (rank (linear-rank matrix))
         (row (numerics-solver-singular-row solver))
         (column (numerics-solver-singular-column solver)))
    (and (= rank (linear-rank (linear-without matrix nil column)))
         (or (null row) (= rank (linear-rank (linear-without matrix row nil)))))))

(defun linear-right-p (case complex kind)
  "Whether a solver of KIND solves CASE, or names what makes it singular."
  (let ((solver (linear-solver case complex kind))
        (regular (= (linear-case-n case) (linear-rank (linear-case-matrix case)))))
    (unwind-protect
         (let ((singular (numerics-with-masked-traps
                           (numerics-factor solver (linear-doubles (linear-case-entries case))))))
           (cond (singular (and (not regular) (linear-named-p case solver)))
                 (regular (linear-accurate-p case solver))))
      (numerics-release-solver solver))))

(defun linear-kind (name) (intern (string-left-trim "$" (symbol-name name)) :keyword))

(defun $linear_wrong (count largest share complex kind seed)
  "How many of COUNT cases of at most LARGEST rows, with SHARE percent of their entries, go wrong,
and whether more than a fiftieth of them was singular; none for KLU where it is not there."
  (let ((*linear-seed* seed) (wrong 0) (singular 0) (kind (linear-kind kind)))
    (dotimes (k (if (or (not (eq kind :klu)) (numerics-find-klu)) count 0)
                (list '(mlist simp) wrong (> singular (floor count 50))))
      (let ((case (linear-new-case (1+ (linear-random largest)) share complex)))
        (unless (linear-right-p case complex kind) (incf wrong))
        (when (< (linear-rank (linear-case-matrix case)) (linear-case-n case))
          (incf singular))))))

;;; Units: row i times 2^a_i changes nothing, and column j times 2^b_j makes nothing singular.

(defun linear-in-units (values pattern rows columns)
  (map 'vector (lambda (value i j) (* value (expt 2 (+ (aref rows i) (aref columns j)))))
       values (numerics-pattern-rows pattern) (numerics-column-numbers pattern)))

(defun linear-case-in-units (case rows columns)
  (let* ((new (copy-linear-case case)) (mass (or (linear-case-mass case)
                                                 (numerics-identity (linear-case-n case))))
         (pattern (numerics-matrix-pattern mass)))
    (setf (linear-case-entries new) (linear-in-units (linear-case-entries case)
                                                     (linear-case-pattern case) rows columns)
          (linear-case-mass new)
          (make-numerics-matrix
           :pattern pattern
           :values (linear-doubles (linear-in-units (map 'vector #'rational
                                                         (numerics-matrix-values mass))
                                                    pattern rows columns))))
    new))

(defun linear-solution-or-column (case complex kind right)
  "The solution, or the number of the column where CASE is singular."
  (let ((solver (linear-solver case complex kind)))
    (if (numerics-with-masked-traps
          (numerics-factor solver (linear-doubles (linear-case-entries case))))
        (numerics-solver-singular-column solver)
        (linear-solved solver right))))

(defun $linear_units (count largest complex kind seed)
  "[how many of COUNT cases are solved otherwise in other units of their equations, how many are
singular or not in those of their unknowns too]"
  (let ((*linear-seed* seed) (kind (linear-kind kind)) (others 0) (singular 0))
    (flet ((exponents (n) (coerce (loop repeat n collect (- (linear-random 161) 80)) 'vector)))
      (dotimes (k count (list '(mlist simp) others singular))
        (let* ((n (1+ (linear-random largest))) (case (linear-new-case n 50 complex))
               (rows (exponents n)) (columns (exponents n))
               (right (coerce (loop repeat n collect (linear-eighth)) 'vector))
               (none (make-array n :initial-element 0)))
          (flet ((solution (columns)
                   (linear-solution-or-column
                    (linear-case-in-units case rows columns) complex kind
                    (map 'vector (lambda (x a) (* x (expt 2 a))) right rows))))
            (let ((one (linear-solution-or-column case complex kind right)))
              (unless (equalp one (solution none)) (incf others))
              (unless (eq (numberp one) (numberp (solution columns))) (incf singular)))))))))

;;; Orders and choices.

(defun linear-pattern-of-edges (n edges)
  "Of the diagonal and EDGES, pairs of numbers, both ways."
  (let ((columns (make-array n)))
    (dotimes (j n) (setf (aref columns j) (list j)))
    (loop for (i . j) in edges
          do (push i (aref columns j))
             (push j (aref columns i)))
    (dotimes (j n (numerics-pattern-of-columns columns))
      (setf (aref columns j) (numerics-without-repeats (sort (aref columns j) #'<))))))

(defun linear-shuffled (n)
  (let ((order (make-array n)))
    (dotimes (i n) (setf (aref order i) i))
    (loop for i from (1- n) downto 1
          do (rotatef (aref order i) (aref order (linear-random (1+ i)))))
    order))

(defun linear-grid (rows columns)
  "A grid whose nodes are numbered by chance."
  (let ((order (linear-shuffled (* rows columns))) (edges '()))
    (flet ((node (i j) (aref order (+ j (* i columns)))))
      (dotimes (i rows)
        (dotimes (j columns)
          (when (< (1+ j) columns) (push (cons (node i j) (node i (1+ j))) edges))
          (when (< (1+ i) rows) (push (cons (node i j) (node (1+ i) j)) edges)))))
    (linear-pattern-of-edges (* rows columns) edges)))

(defun $linear_widths (rows columns seed)
  "[below, above] of the band of a grid after the order is found, and whether that is an order."
  (let* ((*linear-seed* seed) (pattern (linear-grid rows columns))
         (order (numerics-band-order pattern)))
    (multiple-value-bind (lower upper) (numerics-band-widths pattern order)
      (list '(mlist simp) lower upper
            (equalp (sort (copy-seq order) #'<) (numerics-natural-order (* rows columns)))))))

(defun $linear_kind (rows columns without)
  "What is chosen for the system of a grid, WITHOUT KLU or with it where it is there."
  (let ((*numerics-klu* (if without nil (numerics-find-klu))) (*linear-seed* 5)
        (n (* rows columns)))
    (let ((solver (numerics-make-solver n (linear-grid rows columns) nil)))
      (prog1 (string-downcase (symbol-name (numerics-solver-kind solver)))
        (numerics-release-solver solver)))))

(defun $linear_remark (rows columns)
  "What is said of the system of a grid without KLU."
  (let* ((*numerics-klu* nil) (*linear-seed* 5))
    (or (numerics-solver-remark
         (numerics-make-solver (* rows columns) (linear-grid rows columns) nil))
        "")))

(defun $linear_full (n)
  "A system of N rows that only sparse elimination can do, without that."
  (let ((*numerics-klu* nil))
    (numerics-make-solver
     n (linear-pattern-of-edges n (loop for i from 1 below n collect (cons 0 i))) nil)
    '$done))

(defun linear-difference (n pattern kind other complex)
  "The largest difference of two kinds of elimination on a system of N rows."
  (let* ((case (make-linear-case :n n :pattern pattern :entries (linear-values pattern)
                                 :shift (if complex (complex 40 30) 50)))
         (right (map 'vector (lambda (i) (declare (ignore i)) (linear-eighth))
                     (make-array n :initial-element 0))))
    (flet ((solution (kind)
             (let ((solver (linear-solver case complex kind)))
               (unwind-protect
                    (numerics-with-masked-traps
                      (dotimes (k 2) ; the second time KLU keeps its pivots
                        (numerics-factor solver (linear-doubles (linear-case-entries case))))
                      (linear-solved solver right))
                 (numerics-release-solver solver)))))
      (coerce (reduce #'max (map 'vector (lambda (a b) (linear-size (- a b)))
                                 (solution kind) (solution other)))
              'double-float))))

(defun $linear_klu_differs (rows columns other complex)
  "From OTHER on a grid; 0 where there is no KLU."
  (let ((*linear-seed* 3))
    (if (numerics-find-klu)
        (linear-difference (* rows columns) (linear-grid rows columns) :klu (linear-kind other)
                           complex)
        0)))

(defun $linear_differs (rows columns complex)
  (let ((*linear-seed* 3))
    (linear-difference (* rows columns) (linear-grid rows columns) :dense :banded complex)))

;;; Pivots kept by KLU that no longer serve.

(defun $linear_klu_pivots ()
  "The error of a second system whose pivots are 10^-12 of what they were; 0 without KLU."
  (if (null (numerics-find-klu))
      0
      (let* ((pattern (numerics-full-pattern 3))
             (solver (numerics-make-solver 3 pattern nil :kind :klu))
             (x (linear-doubles '(1 2 3))))
        (setf (numerics-solver-shift solver) 0d0)
        (unwind-protect
             (numerics-with-masked-traps
               (numerics-factor solver (linear-doubles '(-9 -1 -1 -1 -9 -1 -1 -1 -9)))
               (numerics-factor solver (linear-doubles '(-1/1000000000000 -1 -1
                                                         -1 -1/1000000000000 -1
                                                         -1 -1 -1/1000000000000)))
               (numerics-solve solver x)
               (reduce #'max (map 'vector (lambda (a b) (abs (- a b))) x '(2d0 1d0 0d0))))
          (numerics-release-solver solver)))))
