;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Drifts along a run of what should not change: first integrals, and balances, values to which the
;;; integral of a power over the time is added. It is taken along each step, at the nodes of a
;;; method by collocation, else at those of Gauss' formula of order 10 on the interpolated states.
;;; See numerics-see-drifts first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/quadrature"))

(defstruct numerics-drifts
  functions                                          ; (moment x out): values, then their sizes
  powers                                             ; nil, or (moment x out): what is to be added
  (count 0 :type fixnum)
  (first (numerics-zeros 0) :type numerics-vector)   ; the values at the start
  (values (numerics-zeros 0) :type numerics-vector)
  (largest (numerics-zeros 0) :type numerics-vector) ; drifts, then sizes
  (added (numerics-zeros 0) :type numerics-vector)   ; integrals of the powers
  (low (numerics-zeros 0) :type numerics-vector)     ; and their low parts
  (rates (numerics-zeros 0) :type numerics-vector)
  (moment (numerics-zeros 2) :type numerics-vector)
  (state (numerics-zeros 0) :type numerics-vector))

(defun numerics-new-drifts (functions powers count moment state)
  "Looks at COUNT values of FUNCTIONS, which gives after them what each of them is a sum of."
  (let ((values (numerics-zeros (* 2 count))) (largest (numerics-zeros (* 2 count))))
    (funcall functions moment state values)
    (loop for k from count below (* 2 count) do (setf (aref largest k) (abs (aref values k))))
    (make-numerics-drifts :functions functions :powers powers :count count
                          :first (subseq values 0 count) :values values :largest largest
                          :added (numerics-zeros count) :low (numerics-zeros count)
                          :rates (numerics-zeros count) :state (copy-seq state))))

(defun numerics-see-drifts (drifts step)
  "Notes the largest drifts and sizes at the end of STEP; nil."
  (declare (optimize speed))
  (let ((values (numerics-drifts-values drifts)) (largest (numerics-drifts-largest drifts))
        (first (numerics-drifts-first drifts)) (added (numerics-drifts-added drifts))
        (count (numerics-drifts-count drifts)))
    (when (numerics-drifts-powers drifts) (numerics-add-powers drifts step))
    (funcall (the function (numerics-drifts-functions drifts))
             (numerics-step-to step) (numerics-step-after step) values)
    (dotimes (k count nil)
      (let ((size (+ count k)) (more (aref added k)))
        (setf (aref largest k)
              (max (aref largest k) (abs (+ (- (aref values k) (aref first k)) more)))
              (aref largest size)
              (max (aref largest size) (abs (aref values size)) (abs more)))))))

(defun numerics-relative-drifts (drifts)
  "A list: each drift over the larger of the value at the start and the largest size; 0 where both
are 0."
  (loop with count = (numerics-drifts-count drifts) and largest = (numerics-drifts-largest drifts)
        for k below count
        for size = (max (abs (aref (numerics-drifts-first drifts) k)) (aref largest (+ count k)))
        collect (if (zerop size) (aref largest k) (/ (aref largest k) size))))

;;; Powers

(defun numerics-add-powers (drifts step)
  "Adds the integrals of the powers along STEP."
  (let ((moment (numerics-drifts-moment drifts)) (state (numerics-drifts-state drifts))
        (rates (numerics-drifts-rates drifts)) (length (numerics-step-length step)))
    (loop for (share . weight) in (or (numerics-step-nodes step) *numerics-quadrature*)
          do (numerics-step-moment step share moment)
             (numerics-step-state step share state)
             (funcall (the function (numerics-drifts-powers drifts)) moment state rates)
             (numerics-add-weighted drifts (* weight length)))))

(defun numerics-add-weighted (drifts weight)
  "WEIGHT times the rates, in sums whose low parts are kept."
  (declare (double-float weight))
  (let ((added (numerics-drifts-added drifts)) (low (numerics-drifts-low drifts))
        (rates (numerics-drifts-rates drifts)))
    (dotimes (k (numerics-drifts-count drifts))
      (let* ((before (aref added k)) (part (+ (* weight (aref rates k)) (aref low k)))
             (after (+ before part)))
        (setf (aref added k) after
              (aref low k) (- part (- after before)))))))
