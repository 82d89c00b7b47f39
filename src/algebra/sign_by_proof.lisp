;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; A proof that e > 0 from g_1 > 0, g_2 >= 0, ..: e = sum c_k p_k, c_k >= 0, the p_k products of
;;; the g_j and squares of monomials; the c_k by linear programming over the rationals (Krivine;
;;; Handelman, Representing polynomials by positive linear functions on compact convex
;;; polyhedra, Pacific J. Math. 132, 1988). That 0 has such a form with a p_k > 0 proves that
;;; the g_j contradict each other.
;;; It begins with that linear programming.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/memory" "algebra/packed_polynomials" "algebra/sign_by_parts"))

;;; Linear programming over the rationals: the largest c.x where A x = b, x >= 0, by the simplex
;;; method in two phases with Bland's rule, which does not cycle (Chvatal, Linear Programming, 3).
;;; Exact; for some dozens of rows and columns.

(defun algebra-simplex (a b c)
  "The largest c.x for A x = b, x >= 0, or nil where there is no such x; :unbounded. A is a list of
rows, B the list of right sides, C the costs; all rational."
  (let* ((columns (length c)) (rows (length a))
         (table (make-array (list (1+ rows) (+ columns rows 1)) :initial-element 0))
         (basis (make-array rows)))
    (algebra-simplex-fill table basis a b)
    (algebra-simplex-phase-one table basis columns)
    (if (zerop (aref table rows (+ columns rows)))
        (progn (algebra-simplex-drive-out table basis columns)
               (algebra-simplex-costs table basis c)
               (algebra-simplex-run table basis columns))
        nil)))

(defun algebra-simplex-fill (table basis a b)
  "Rows with right sides that are not negative, each with a variable of its own in the basis."
  (let* ((rows (length a)) (last (1- (array-dimension table 1))) (columns (- last rows)))
    (loop for row in a for right in b for i from 0
          for sign = (if (minusp right) -1 1)
          do (loop for x in row for j from 0 do (setf (aref table i j) (* sign x)))
             (setf (aref table i (+ columns i)) 1
                   (aref table i last) (* sign right)
                   (aref basis i) (+ columns i)))))

(defun algebra-simplex-phase-one (table basis columns)
  "Makes the sum of the rows' own variables as small as it goes."
  (let ((rows (length basis)) (last (1- (array-dimension table 1))))
    (dotimes (j (1+ last))
      (unless (<= columns j (1- last))
        (setf (aref table rows j) (- (loop for i below rows sum (aref table i j))))))
    (algebra-simplex-run table basis columns)))

(defun algebra-simplex-drive-out (table basis columns)
  "Takes the rows' own variables, which are 0 now, out of the basis where that can be done."
  (dotimes (i (length basis))
    (when (>= (aref basis i) columns)
      (let ((j (loop for j below columns
                     unless (zerop (aref table i j)) return j)))
        (when j (algebra-simplex-pivot table basis i j))))))

(defun algebra-simplex-costs (table basis c)
  "The last row: costs of the columns, with sign changed, expressed by those outside the basis."
  (let ((rows (length basis)) (last (1- (array-dimension table 1))))
    (dotimes (j (1+ last)) (setf (aref table rows j) 0))
    (loop for cost in c for j from 0 do (setf (aref table rows j) (- cost)))
    (dotimes (i rows)
      (let ((cost (if (< (aref basis i) (length c)) (nth (aref basis i) c) 0)))
        (unless (zerop cost)
          (dotimes (j (1+ last))
            (incf (aref table rows j) (* cost (aref table i j)))))))))

(defun algebra-simplex-run (table basis columns)
  "Pivots until no cost is negative: the value, or :unbounded."
  (let ((rows (length basis)) (last (1- (array-dimension table 1))))
    (loop
      (let ((j (loop for j below columns
                     when (minusp (aref table rows j)) return j)))
        (unless j (return (aref table rows last)))
        (let ((i (algebra-simplex-leaving table basis j)))
          (unless i (return :unbounded))
          (algebra-simplex-pivot table basis i j))))))

(defun algebra-simplex-leaving (table basis j)
  "The row that bounds column J most, of several that with the least variable."
  (let ((best nil) (least nil) (last (1- (array-dimension table 1))))
    (dotimes (i (length basis) best)
      (when (plusp (aref table i j))
        (let ((ratio (/ (aref table i last) (aref table i j))))
          (when (or (null best) (< ratio least)
                    (and (= ratio least) (< (aref basis i) (aref basis best))))
            (setq best i least ratio)))))))

(defun algebra-simplex-pivot (table basis i j)
  (let ((width (array-dimension table 1)) (pivot (aref table i j)))
    (dotimes (k width) (setf (aref table i k) (/ (aref table i k) pivot)))
    (dotimes (row (array-dimension table 0))
      (let ((factor (aref table row j)))
        (unless (or (= row i) (zerop factor))
          (dotimes (k width)
            (unless (zerop (aref table i k))
              (decf (aref table row k) (* factor (aref table i k))))))))
    (setf (aref basis i) j)))

;;; ---- sign by proof

(defparameter *algebra-certificate-size* 6000
  "Largest product of the numbers of monomials and of products for which a proof is sought.")

;;; Generators: (table . strict)

(defun algebra-generators (gaps kernels)
  "What the GAPS ((e . sign) ..) say, as tables with whether they are strict; the number 1; squares
of kernels."
  (append
   (list (cons (algebra-table-of 1 kernels) t))
   (loop for (e . sign) in gaps
         append (ecase sign
                  ($pos (list (cons (algebra-table-of e kernels) t)))
                  ($neg (list (cons (algebra-table-of (algebra-turned e) kernels) t)))
                  ($pz (list (cons (algebra-table-of e kernels) nil)))
                  ($nz (list (cons (algebra-table-of (algebra-turned e) kernels) nil)))
                  ($zero (list (cons (algebra-table-of e kernels) nil)
                               (cons (algebra-table-of (algebra-turned e) kernels) nil)))
                  (($pn $unknown) '())))))

(defun algebra-square-generators (kernels known)
  "Squares of those names among the KERNELS whose sign is not KNOWN, not strict."
  (loop for kernel in kernels for place from 0
        unless (or (not (symbolp kernel)) (member kernel known :test #'eq))
          collect (let ((table (algebra-new-table)))
                    (setf (gethash (algebra-monomial-of place 2) table) 1)
                    (cons table nil))))

(defun algebra-next-products (products generators degree)
  "Each of PRODUCTS times each of GENERATORS, up to DEGREE, with those there were."
  (algebra-distinct-generators
   (append products
           (loop for (p . strict) in products
                 append (loop for (g . also) in generators
                              when (<= (+ (algebra-table-degree p) (algebra-table-degree g)) degree)
                                collect (cons (algebra-table-product p g) (and strict also)))))))

(defun algebra-distinct-generators (generators)
  (let ((seen (make-hash-table :test #'equal)) (distinct '()))
    (dolist (g generators (nreverse distinct))
      (let ((key (sort (loop for m being the hash-keys of (car g) using (hash-value x)
                             unless (zerop x) collect (cons m x))
                       #'< :key #'car)))
        (unless (or (null key) (gethash (cons key (cdr g)) seen))
          (setf (gethash (cons key (cdr g)) seen) t)
          (push g distinct))))))

;;; The proof

(defun algebra-certified-sign (e gaps)
  "The sign of the expanded E that is proved from the GAPS, or unknown."
  (let ((sign (algebra-certificate e gaps)))
    (if (eq sign '$pos)
        sign
        (algebra-both-signs sign (algebra-opposite-sign
                                  (algebra-certificate (algebra-turned e) gaps))))))

(defun algebra-certificate (e gaps)
  "pos or pz where that is proved of the expanded polynomial E from the GAPS, else unknown."
  (let ((gaps (algebra-related-gaps e gaps)))
    (algebra-kept 'certificate (list* *algebra-certificate-size* e gaps)
                  (lambda () (algebra-new-certificate e gaps)))))

(defun algebra-new-certificate (e gaps)
  (let* ((kernels (algebra-kernels-of (cons e (mapcar #'car gaps))))
         (target (algebra-table-of e kernels))
         (degree (max 2 (algebra-table-degree target)))
         (generators (remove-if (lambda (g) (> (algebra-table-degree (car g)) degree))
                                (append (algebra-generators gaps kernels)
                                        (algebra-square-generators kernels
                                                                   (mapcar #'car gaps))))))
    (if (or (> (length kernels) 12) (> degree 8))
        '$unknown
        (algebra-certified target generators degree))))

(defun algebra-related-gaps (e gaps)
  "Those of GAPS that share names with E, or with others that do; all where E has none."
  (let ((names (cdr ($listofvars e))) (related '()))
    (if (null names)
        gaps
        (loop for more = (remove-if-not
                          (lambda (gap) (intersection names (cdr ($listofvars (car gap)))
                                                      :test #'alike1))
                          (set-difference gaps related))
              while more
              do (setq related (append related more)
                       names (union names (cdr ($listofvars (cons '(mlist) (mapcar #'car more))))
                                    :test #'alike1))
              finally (return related)))))

(defun algebra-certified (target generators degree)
  "The answer by the generators, else by products of two, of three, .. of them."
  (let ((answer '$unknown))
    (loop with products = generators
          for sign = (algebra-certified-by target products)
          do (cond ((member sign '($pos :too-large)) (setq answer (if (eq sign '$pos) sign answer))
                    (return answer))
                   ((eq sign '$pz) (setq answer sign)))
             (let ((next (algebra-next-products products (cdr generators) degree)))
               (when (= (length next) (length products)) (return answer))
               (setq products next)))))

(defun algebra-certified-by (target products)
  (let ((monomials (algebra-monomials-of (cons target (mapcar #'car products)))))
    (if (> (* (length monomials) (length products)) *algebra-certificate-size*)
        :too-large
        (let ((lacking (algebra-lacking-strictness target products monomials)))
          (cond ((null lacking) '$unknown)
                ((= lacking 1) '$pz)
                (t '$pos))))))

(defun algebra-monomials-of (tables)
  (let ((seen (algebra-new-table)) (monomials '()))
    (dolist (table tables (nreverse monomials))
      (loop for m being the hash-keys of table
            unless (gethash m seen)
              do (setf (gethash m seen) t)
                 (push m monomials)))))

(defun algebra-lacking-strictness (target products monomials)
  "The least s >= 0 for which TARGET = sum c_k p_k where the c_k of strict p_k and s sum up to 1 or
more: 1 where none of these is needed; nil where there is no such sum."
  (let* ((strict (mapcar (lambda (p) (if (cdr p) 1 0)) products))
         (value (algebra-simplex
                 (cons (append strict (list 1 -1))
                       (loop for m in monomials
                             collect (append (mapcar (lambda (p) (gethash m (car p) 0)) products)
                                             '(0 0))))
                 (cons 1 (loop for m in monomials collect (gethash m target 0)))
                 (append (mapcar (constantly 0) strict) (list -1 0)))))
    (and value (- value))))

(defun algebra-gaps-contradict-p (gaps)
  "Whether the GAPS are proved to contradict each other: a sum of products of them, one of these
positive, vanishes."
  (and gaps (eq '$pos (algebra-certificate 0 gaps))))
