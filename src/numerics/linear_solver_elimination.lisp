;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Elimination with partial pivoting, real, and complex with the imaginary parts apart (Golub &
;;; Van Loan: Matrix Computations, sections 3.4 and 4.3). One code serves full and banded
;;; matrices: the entry of row i and column j stands at i + j*stride + offset, and is no zero only
;;; where -upper-lower <= i - j <= lower (the exchanges of rows widen the upper band). Rows are
;;; exchanged column by column as the elimination reaches them; what is 0 in the row of the pivot
;;; costs nothing. On the diagonal of the factors stand the inverse pivots: many solutions follow
;;; one elimination, and a product takes a fifth of the time of a quotient.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/linear_solver_matrix"
                "numerics/linear_solver_scales"))

(defmacro numerics-with-band ((solver &rest more) &body body)
  "BODY with n, the widths, and (place i j) in the storage; MORE are names of vectors of SOLVER."
  `(let* ((n (numerics-solver-size ,solver)) (below (numerics-solver-lower ,solver))
          (above (min (1- n) (+ below (numerics-solver-upper ,solver))))
          (stride (numerics-solver-stride ,solver)) (offset (numerics-solver-offset ,solver))
          ,@(loop for name in more
                  collect `(,name (,(intern (format nil "NUMERICS-SOLVER-~a" name) :maxima)
                                   ,solver))))
     (declare (type (unsigned-byte 24) n below above stride offset)
              (ignorable below above))
     (flet ((place (i j)
              (declare (type (unsigned-byte 24) i j))
              (the numerics-index (+ i offset (the numerics-index (* j stride))))))
       (declare (inline place))
       ,@body)))

;;; Kernels: n numbers of X from the place FROM on, FACTOR times, are taken from those of Y from
;;; TO on. All places lie within the columns, so nothing is checked; four numbers a turn take half
;;; the time.

(defmacro numerics-subtract-multiple (n factor x from y to)
  `(let ((count ,n) (p ,from) (q ,to) (factor ,factor))
     (declare (type (unsigned-byte 24) count) (type numerics-index p q) (double-float factor)
              (optimize speed (safety 0)))
     (flet ((advance (by)
              (setq p (the numerics-index (+ p by)) q (the numerics-index (+ q by)))))
       (declare (inline advance))
       (loop repeat (ash count -2)
             do ,@(loop for k below 4
                        collect `(decf (aref ,y (+ q ,k)) (* factor (aref ,x (+ p ,k)))))
                (advance 4))
       (loop repeat (logand count 3)
             do (decf (aref ,y q) (* factor (aref ,x p)))
                (advance 1)))))

(defmacro numerics-subtract-complex-multiple (n factors x from y to)
  "FACTORS, X and Y are lists of the names of real and imaginary parts."
  `(let ((count ,n) (p ,from) (q ,to) (u ,(first factors)) (v ,(second factors)))
     (declare (type (unsigned-byte 24) count) (type numerics-index p q) (double-float u v)
              (optimize speed (safety 0)))
     (loop repeat count
           do (let ((a (aref ,(first x) p)) (b (aref ,(second x) p)))
                (decf (aref ,(first y) q) (- (* u a) (* v b)))
                (decf (aref ,(second y) q) (+ (* u b) (* v a))))
              (setq p (the numerics-index (1+ p)) q (the numerics-index (1+ q))))))

(defmacro numerics-multiply-by (n factor x from)
  "N numbers of X from the place FROM on are multiplied by FACTOR."
  `(let ((p ,from) (factor ,factor))
     (declare (type numerics-index p) (double-float factor) (optimize speed (safety 0)))
     (loop repeat ,n
           do (setf (aref ,x p) (* factor (aref ,x p))
                    p (the numerics-index (1+ p))))))

(defmacro numerics-multiply-complex (x y place u v)
  "The number of X and Y at PLACE times u + iv."
  `(let ((a (aref ,x ,place)) (b (aref ,y ,place)))
     (setf (aref ,x ,place) (- (* a ,u) (* b ,v))
           (aref ,y ,place) (+ (* a ,v) (* b ,u)))))

;;; Pivots.

(defmacro numerics-largest-below (count scales k place-and-size)
  "How far below the diagonal of column K, at most COUNT, the entry stands that is largest after it
is multiplied with its row's of SCALES. PLACE-AND-SIZE: (i e), the size E of the entry I below."
  (destructuring-bind (i e) place-and-size
    `(let ((chosen 0) (largest -1d0))
       (declare (type (unsigned-byte 24) chosen) (double-float largest))
       (loop for ,i of-type (unsigned-byte 24) from 0 to ,count
             do (let ((magnitude (* ,e (aref ,scales (+ ,k ,i)))))
                  (when (> magnitude largest) (setq largest magnitude chosen ,i))))
       chosen)))

(defun numerics-note-pivot (solver k row)
  (declare (type fixnum k row))
  (let ((scales (numerics-solver-row-scales solver)))
    (setf (aref (numerics-solver-pivots solver) k) row)
    (rotatef (aref scales k) (aref scales row))
    nil))

;;; The factors of the assembled matrix in its place; true where it is singular.

(defun numerics-eliminate (solver)
  (declare (optimize speed))
  (numerics-with-band (solver real row-scales)
    (dotimes (k n nil)
      (let* ((rows (min below (- n k 1))) (columns (min above (- n k 1)))
             (diagonal (place k k))
             (chosen (numerics-largest-below rows row-scales k
                                             (i (abs (aref real (+ diagonal i)))))))
        (declare (type (unsigned-byte 24) rows columns))
        (numerics-note-pivot solver k (+ k chosen))
        (rotatef (aref real diagonal) (aref real (+ diagonal chosen)))
        (let ((pivot (aref real diagonal)))
          (when (numerics-no-pivot-p solver (abs pivot) k)
            (return (numerics-note-singular solver k)))
          (setf (aref real diagonal) (/ pivot))
          (numerics-multiply-by rows (aref real diagonal) real (1+ diagonal)))
        (loop for j of-type (unsigned-byte 24) from (1+ k) to (+ k columns)
              do (let ((top (place k j)))
                   (rotatef (aref real top) (aref real (+ top chosen)))
                   (unless (= (aref real top) 0d0)
                     (numerics-subtract-multiple rows (aref real top)
                                                 real (1+ diagonal) real (1+ top)))))))))

(defmacro numerics-invert-complex (x y place)
  "The number of X and Y at PLACE becomes its inverse (Smith's division)."
  `(let ((u (aref ,x ,place)) (v (aref ,y ,place)))
     (if (< (abs v) (abs u))
         (let* ((ratio (/ v u)) (inverse (/ (+ u (* v ratio)))))
           (setf (aref ,x ,place) inverse
                 (aref ,y ,place) (- (* ratio inverse))))
         (let* ((ratio (/ u v)) (inverse (/ (+ v (* u ratio)))))
           (setf (aref ,x ,place) (* ratio inverse)
                 (aref ,y ,place) (- inverse))))))

(defun numerics-eliminate-complex (solver)
  (declare (optimize speed))
  (numerics-with-band (solver real imaginary row-scales)
    (dotimes (k n nil)
      (let* ((rows (min below (- n k 1))) (columns (min above (- n k 1)))
             (diagonal (place k k))
             (chosen (numerics-largest-below rows row-scales k
                                             (i (+ (abs (aref real (+ diagonal i)))
                                                   (abs (aref imaginary (+ diagonal i))))))))
        (declare (type (unsigned-byte 24) rows columns))
        (numerics-note-pivot solver k (+ k chosen))
        (rotatef (aref real diagonal) (aref real (+ diagonal chosen)))
        (rotatef (aref imaginary diagonal) (aref imaginary (+ diagonal chosen)))
        (when (numerics-no-pivot-p solver (+ (abs (aref real diagonal))
                                             (abs (aref imaginary diagonal))) k)
          (return (numerics-note-singular solver k)))
        (numerics-invert-complex real imaginary diagonal)
        (let ((u (aref real diagonal)) (v (aref imaginary diagonal)))
          (loop for p of-type numerics-index from (1+ diagonal)
                repeat rows
                do (numerics-multiply-complex real imaginary p u v)))
        (loop for j of-type (unsigned-byte 24) from (1+ k) to (+ k columns)
              do (let ((top (place k j)))
                   (rotatef (aref real top) (aref real (+ top chosen)))
                   (rotatef (aref imaginary top) (aref imaginary (+ top chosen)))
                   (unless (= (aref real top) (aref imaginary top) 0d0)
                     (numerics-subtract-complex-multiple
                      rows ((aref real top) (aref imaginary top))
                      (real imaginary) (1+ diagonal) (real imaginary) (1+ top)))))))))

;;; Use of the factors: the sign of the determinant, and solutions in place of right sides.

(defun numerics-determinant-sign (solver)
  (declare (optimize speed))
  (numerics-with-band (solver real pivots)
    (let ((orientation 1))
      (declare (type (integer -1 1) orientation))
      (dotimes (k n orientation)
        (unless (eq (= (aref pivots k) k) (> (aref real (place k k)) 0d0))
          (setq orientation (- orientation)))))))

(defun numerics-substitute (solver x)
  (declare (type numerics-vector x) (optimize speed))
  (numerics-with-band (solver real pivots)
    (dotimes (k n)
      (rotatef (aref x k) (aref x (aref pivots k)))
      (unless (= (aref x k) 0d0)
        (numerics-subtract-multiple (min below (- n k 1)) (aref x k)
                                    real (1+ (place k k)) x (1+ k))))
    (loop for k of-type (signed-byte 25) from (1- n) downto 0
          do (let ((rows (min above k)))
               (declare (type (unsigned-byte 24) rows))
               (setf (aref x k) (* (aref x k) (aref real (place k k))))
               (unless (= (aref x k) 0d0)
                 (numerics-subtract-multiple rows (aref x k)
                                             real (place (- k rows) k) x (- k rows)))))))

(defun numerics-substitute-complex (solver x y)
  (declare (type numerics-vector x y) (optimize speed))
  (numerics-with-band (solver real imaginary pivots)
    (dotimes (k n)
      (rotatef (aref x k) (aref x (aref pivots k)))
      (rotatef (aref y k) (aref y (aref pivots k)))
      (unless (= (aref x k) (aref y k) 0d0)
        (numerics-subtract-complex-multiple (min below (- n k 1)) ((aref x k) (aref y k))
                                            (real imaginary) (1+ (place k k)) (x y) (1+ k))))
    (loop for k of-type (signed-byte 25) from (1- n) downto 0
          do (let ((rows (min above k)) (u (aref real (place k k)))
                   (v (aref imaginary (place k k))))
               (declare (type (unsigned-byte 24) rows))
               (numerics-multiply-complex x y k u v)
               (unless (= (aref x k) (aref y k) 0d0)
                 (numerics-subtract-complex-multiple
                  rows ((aref x k) (aref y k))
                  (real imaginary) (place (- k rows) k) (x y) (- k rows)))))))
