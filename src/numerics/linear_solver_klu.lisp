;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Sparse elimination by the library KLU (Davis & Palamadai Natarajan: Algorithm 907, ACM Trans.
;;; Math. Softw. 37, 2010) where it is installed: package libklu1 of Debian 12, libklu2 later. The
;;; order of elimination is found once; later matrices of the pattern take the pivots of the first
;;; as long as the factors do not grow. Complex numbers stand as pairs in one vector.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/native" "numerics/linear_solver_matrix"))

(defvar *numerics-klu-names* '("libklu.so.1" "libklu.so.2" "libklu.dylib"))
(defvar *numerics-klu* :unknown "The name under which the library was found, or nil.")

;;; What the library keeps: the common block is klu_common of klu.h, as 32-bit words. We read two
;;; words, and whether its layout is the one we know: default number 1 in halt_if_singular.

(defconstant +numerics-klu-halts+ 18)
(defconstant +numerics-klu-singular-column+ 23)
(defconstant +numerics-klu-growth+ 33 "The high word of a double-float number.")

(defstruct numerics-klu
  (common (numerics-index-zeros 256) :type (simple-array (unsigned-byte 32) (*)))
  (starts (numerics-index-zeros 0) :type (simple-array (unsigned-byte 32) (*)))
  (rows (numerics-index-zeros 0) :type (simple-array (unsigned-byte 32) (*)))
  (symbolic (make-array 1 :element-type '(unsigned-byte 64) :initial-element 0)
   :type (simple-array (unsigned-byte 64) (1)))
  (numeric (make-array 1 :element-type '(unsigned-byte 64) :initial-element 0)
   :type (simple-array (unsigned-byte 64) (1))))

(defun numerics-klu-defaults (klu)
  (numerics-foreign-call "klu_defaults" :int (:vector (numerics-klu-common klu)))
  klu)

(defun numerics-find-klu ()
  "The name of the library, or nil where there is none that we know."
  (when (eq *numerics-klu* :unknown)
    (setq *numerics-klu* (numerics-load-library *numerics-klu-names*))
    (when (and *numerics-klu*
               (/= 1 (aref (numerics-klu-common (numerics-klu-defaults (make-numerics-klu)))
                           +numerics-klu-halts+)))
      (setq *numerics-klu* nil)))
  *numerics-klu*)

;;; Analysis, factors, release.

(defun numerics-analyse-by-klu (solver)
  (let* ((pattern (numerics-solver-pattern solver))
         (klu (numerics-klu-defaults (make-numerics-klu :starts (numerics-pattern-starts pattern)
                                                        :rows (numerics-pattern-rows pattern)))))
    (setf (aref (numerics-klu-symbolic klu) 0)
          (numerics-foreign-call "klu_analyze" :address (:int (numerics-solver-size solver))
                                 (:vector (numerics-klu-starts klu))
                                 (:vector (numerics-klu-rows klu))
                                 (:vector (numerics-klu-common klu)))
          (numerics-solver-klu solver) klu)
    (when (zerop (aref (numerics-klu-symbolic klu) 0))
      (core-error "KLU cannot analyse a matrix of ~d rows" (numerics-solver-size solver)))
    solver))

(defun numerics-release-numeric (solver klu)
  (unless (zerop (aref (numerics-klu-numeric klu) 0))
    (if (numerics-solver-complex solver)
        (numerics-foreign-call "klu_z_free_numeric" :int (:vector (numerics-klu-numeric klu))
                               (:vector (numerics-klu-common klu)))
        (numerics-foreign-call "klu_free_numeric" :int (:vector (numerics-klu-numeric klu))
                               (:vector (numerics-klu-common klu))))))

(defun numerics-release-klu (solver)
  "The library's memory is given back; it is called for once."
  (let ((klu (numerics-solver-klu solver)))
    (when klu
      (numerics-release-numeric solver klu)
      (numerics-foreign-call "klu_free_symbolic" :int (:vector (numerics-klu-symbolic klu))
                             (:vector (numerics-klu-common klu)))
      (setf (numerics-solver-klu solver) nil))))

(defmacro numerics-klu-call (name complex-name result)
  "A call of those functions that take the matrix, the analysis and, for refactor, the factors."
  (let ((arguments '((:vector (numerics-klu-starts klu)) (:vector (numerics-klu-rows klu))
                     (:vector (numerics-solver-real solver))
                     (:address (aref (numerics-klu-symbolic klu) 0))))
        (factors '((:address (aref (numerics-klu-numeric klu) 0))))
        (common '((:vector (numerics-klu-common klu)))))
    (flet ((call (name)
             `(numerics-foreign-call ,name ,result ,@arguments
                                     ,@(unless (eq result :address) factors) ,@common)))
      `(if (numerics-solver-complex solver) ,(call complex-name) ,(call name)))))

(defun numerics-factor-anew-by-klu (solver klu)
  (numerics-release-numeric solver klu)
  (setf (aref (numerics-klu-numeric klu) 0)
        (numerics-klu-call "klu_factor" "klu_z_factor" :address))
  (when (zerop (aref (numerics-klu-numeric klu) 0))
    (let ((column (aref (numerics-klu-common klu) +numerics-klu-singular-column+)))
      (setf (numerics-solver-singular-column solver)
            (if (< column (numerics-solver-size solver)) column 0)
            (numerics-solver-singular-row solver) nil)
      t)))

(defun numerics-old-pivots-serve-p (solver klu)
  "Whether the pivots of the last factors do for this matrix: no column has grown by 2^13."
  (and (plusp (aref (numerics-klu-numeric klu) 0))
       (= 1 (numerics-klu-call "klu_refactor" "klu_z_refactor" :int))
       (= 1 (numerics-klu-call "klu_rgrowth" "klu_z_rgrowth" :int))
       (< (1- #x3f200000) (aref (numerics-klu-common klu) +numerics-klu-growth+) #x7ff00000)))

(defun numerics-factor-by-klu (solver)
  "True where the matrix is singular."
  (let ((klu (numerics-solver-klu solver)))
    (unless (numerics-old-pivots-serve-p solver klu)
      (numerics-factor-anew-by-klu solver klu))))

;;; Solving.

(defun numerics-solve-by-klu (solver x)
  (let ((klu (numerics-solver-klu solver)))
    (numerics-foreign-call "klu_solve" :int (:address (aref (numerics-klu-symbolic klu) 0))
                           (:address (aref (numerics-klu-numeric klu) 0))
                           (:int (numerics-solver-size solver)) (:int 1) (:vector x)
                           (:vector (numerics-klu-common klu)))))

(defun numerics-solve-complex-by-klu (solver x y)
  (declare (type numerics-vector x y) (optimize speed))
  (let ((klu (numerics-solver-klu solver)) (n (numerics-solver-size solver))
        (pairs (numerics-solver-work solver)))
    (declare (type (unsigned-byte 24) n))
    (dotimes (i n)
      (setf (aref pairs (* 2 i)) (aref x i)
            (aref pairs (1+ (* 2 i))) (aref y i)))
    (numerics-foreign-call "klu_z_solve" :int (:address (aref (numerics-klu-symbolic klu) 0))
                           (:address (aref (numerics-klu-numeric klu) 0)) (:int n) (:int 1)
                           (:vector pairs) (:vector (numerics-klu-common klu)))
    (dotimes (i n)
      (setf (aref x i) (aref pairs (* 2 i))
            (aref y i) (aref pairs (1+ (* 2 i)))))))
