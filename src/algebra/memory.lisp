;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; What is asked again and again is kept: while the facts are the same, or until the public call
;;; ends. Keys begin with a number made from all parts of an expression: Lisp's own looks at the
;;; first few, in which most sums are alike, so that it would compare each with all that is kept.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/facts"))

(defun algebra-digest (e)
  "A whole number below 2^32, the same for equal E."
  (let ((digest 17))
    (declare (type (unsigned-byte 32) digest))
    (labels ((note (atom)
               (setq digest (logand #xffffffff (+ (* 31 digest) (logand #xffffff (sxhash atom))))))
             (walk (e)
               (loop while (consp e)
                     do (if (consp (car e)) (walk (car e)) (note (car e)))
                        (setq e (cdr e)))
               (note e)))
      (walk e)
      digest)))

(defun algebra-key (e)
  "A key for E in tables that compare by equal."
  (cons (algebra-digest e) e))

;;; While the facts are the same

(defstruct (algebra-memory (:conc-name memory-))
  (answers (make-hash-table :test #'equal))
  (facts '()))

(defparameter *algebra-most-answers* 500 "How many answers a memory keeps.")

(defun algebra-remembered (memory e function)
  "The value of FUNCTION, kept in MEMORY for E."
  (let ((answers (memory-answers memory)) (facts (core-facts)) (key (algebra-key e)))
    (when (or (not (equal facts (memory-facts memory)))
              (>= (hash-table-count answers) *algebra-most-answers*))
      (clrhash answers)
      (setf (memory-facts memory) facts))
    (multiple-value-bind (answer kept) (gethash key answers)
      (if kept answer (setf (gethash key answers) (funcall function))))))

;;; Until the call ends, whose options and signs of single names are the same all the time

(defparameter *algebra-most-kept* 20000 "How many answers are kept until the call ends.")

(defun algebra-kept (question e function)
  "The value of FUNCTION, kept for QUESTION and E: it must not depend on facts of a case."
  (let ((answers *core-answers*))
    (if (null answers)
        (funcall function)
        (let ((key (list* (algebra-digest e) question e)))
          (when (>= (hash-table-count answers) *algebra-most-kept*) (clrhash answers))
          (multiple-value-bind (answer kept) (gethash key answers)
            (if kept answer (setf (gethash key answers) (funcall function))))))))

(defun algebra-plain-p (e)
  "Whether E is made from names and rational numbers by sums, products and whole powers alone."
  (cond ((symbolp e) (or (core-users-name-p e) (null (symbol-package e))))
        ((atom e) (integerp e))
        ((eq (caar e) 'rat) t)
        ((or (mplusp e) (mtimesp e)) (every #'algebra-plain-p (cdr e)))
        (t (and (mexptp e) (integerp (caddr e)) (algebra-plain-p (cadr e))))))
