;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; How a plan is called, whatever computes its nodes: (time x out), and with seeds (seed out) for
;;; the second stage. Here the lengths of the vectors are checked, once for all that is unsafe
;;; below; outputs that are constant are written, and the product of rows is added.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/linear_rows" "numerics/plan" "numerics/problem"))

(defun numerics-entries (plan work slot first second)
  "Two functions. FIRST and SECOND, functions (x work out), compute in the vector WORK, SLOT gives
the place of a node in it."
  (let ((after (numerics-after plan slot)) (states (numerics-plan-states plan))
        (length (numerics-plan-length plan)))
    (if (numerics-plan-seeded plan)
        (values (numerics-entry work first states nil nil)
                (numerics-seed-entry work second states after length))
        (values (numerics-entry work first states after length) nil))))

(defun numerics-entry (work compute states after length)
  "LENGTH nil: what is computed gives nothing out yet."
  (declare (type function compute) (fixnum states) (type numerics-vector work))
  (lambda (time x out)
    (declare (type numerics-vector time x out) (optimize speed))
    (unless (and (= (length x) states) (or (null length) (= (length out) (the fixnum length))))
      (numerics-wrong-length))
    (setf (aref work 0) (aref time 0))
    (funcall compute x work out)
    (when after (funcall (the function after) x work out))
    out))

(defun numerics-seed-entry (work compute states after length)
  (declare (type function compute) (fixnum states length) (type numerics-vector work))
  (lambda (seed out)
    (declare (type numerics-vector seed out) (optimize speed))
    (unless (and (= (length seed) states) (= (length out) length)) (numerics-wrong-length))
    (funcall compute seed work out)
    (when after (funcall (the function after) seed work out))
    out))

(defun numerics-wrong-length ()
  (core-error "a vector of another length was given to a program"))

(defun numerics-after (plan slot)
  "The function (x work out) that does what the nodes do not; nil for nothing."
  (let ((fixed (numerics-plan-fixed plan)) (product (numerics-product-of plan slot)))
    (cond ((and fixed product)
           (let ((fill (numerics-filler fixed)))
             (lambda (x work out)
               (numerics-multiply-rows product x work out)
               (funcall fill x work out))))
          (product (lambda (x work out) (numerics-multiply-rows product x work out)))
          (fixed (numerics-filler fixed)))))

(defun numerics-filler (fixed)
  (let ((places (numerics-index-vector (mapcar #'car fixed)))
        (numbers (numerics-double-vector (mapcar #'cdr fixed))))
    (declare (type numerics-indices places) (type numerics-vector numbers))
    (lambda (x work out)
      (declare (ignore x work) (type numerics-vector out) (optimize speed))
      (dotimes (k (length places))
        (setf (aref out (aref places k)) (aref numbers k))))))

(defun numerics-product-of (plan slot)
  (let ((rows (numerics-plan-rows plan)))
    (flet ((state-place (node)
             (let ((place (numerics-input-place plan node)))
               (and (eq (car place) :state) (cdr place)))))
      (and rows (numerics-new-product rows #'state-place slot #'numerics-constant-double)))))
