;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What looks on while a method steps: a list of functions of the step, each of which says nil,
;;; :changed or :stop. The order matters: first what changes the state (projection), then what may
;;; end the step (events), then what reads it (drifts, rows, progress). Rows are numbers in one
;;; vector, (time, state) after (time, state).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/decimals" "numerics/problem"))

(defun numerics-observer (parts)
  "One observer that asks all of PARTS, functions of the step, in their order."
  (lambda (step)
    (let ((answer nil))
      (dolist (part parts answer)
        (let ((said (funcall (the function part) step)))
          (when (and said (not (eq answer :stop))) (setq answer said)))))))

;;; Rows

(defstruct numerics-rows
  times                                              ; vector along the run; nil: each step
  project                                            ; nil, or (moment x)
  (next 0 :type fixnum)                              ; the next of the times
  (width 0 :type fixnum)
  (count 0 :type fixnum)
  (numbers (numerics-zeros 0) :type numerics-vector)
  (moment (numerics-zeros 2) :type numerics-vector)
  (state (numerics-zeros 0) :type numerics-vector))

(defun numerics-uniform-times (start end count)
  "COUNT times from START to END, both among them."
  (let ((times (numerics-zeros count)) (last (1- count)))
    (dotimes (k count times)
      (setf (aref times k)
            (if (= k last) end (+ start (/ (* k (- end start)) last)))))))

(defun numerics-add-row (rows time state)
  "A row of TIME and STATE at the end of ROWS; the vector grows by doubling."
  (declare (double-float time) (type numerics-vector state))
  (let ((place (* (numerics-rows-count rows) (numerics-rows-width rows)))
        (numbers (numerics-rows-numbers rows)))
    (when (> (+ place (numerics-rows-width rows)) (length numbers))
      (setq numbers (replace (numerics-zeros (* 2 (+ place (numerics-rows-width rows)))) numbers))
      (setf (numerics-rows-numbers rows) numbers))
    (setf (aref numbers place) time)
    (replace numbers state :start1 (1+ place))
    (incf (numerics-rows-count rows))))

(defun numerics-new-rows (times moment state project)
  "Rows at TIMES; the first is STATE at MOMENT where it is asked for. PROJECT brings a state that
was found between two steps back to the constraints."
  (let ((rows (make-numerics-rows :times times :project project :width (1+ (length state))
                                  :state (copy-seq state)))
        (start (aref moment 0)))
    (when (or (null times) (and (plusp (length times)) (= (aref times 0) start)))
      (numerics-add-row rows start state)
      (setf (numerics-rows-next rows) 1))
    rows))

(defun numerics-add-rows-between (rows step)
  "The rows at those of the times that STEP reaches; it has no length where it was undone."
  (let ((from (numerics-step-from step)) (length (numerics-step-length step))
        (times (numerics-rows-times rows)) (state (numerics-rows-state rows))
        (moment (numerics-rows-moment rows)))
    (declare (type numerics-vector from times state moment) (double-float length))
    (loop while (and (/= length 0d0) (< (numerics-rows-next rows) (length times)))
          do (let* ((time (aref times (numerics-rows-next rows)))
                    (share (/ (- time (aref from 0) (aref from 1)) length)))
               (when (> share 1d0) (return))
               (cond ((= share 1d0) (replace state (numerics-step-after step)))
                     (t (funcall (the function (numerics-step-interpolate step)) share state)
                        (when (numerics-rows-project rows)
                          (setf (aref moment 0) time (aref moment 1) 0d0)
                          (funcall (numerics-rows-project rows) moment state))))
               (numerics-add-row rows time state)
               (incf (numerics-rows-next rows))))))

(defun numerics-see-rows (rows step)
  "Adds what STEP has to ROWS; nil."
  (if (numerics-rows-times rows)
      (numerics-add-rows-between rows step)
      (numerics-add-row rows (aref (numerics-step-to step) 0) (numerics-step-after step)))
  nil)

(defun numerics-finish-rows (rows outcome)
  "The last row is where the run ended, whether that time was asked for or not."
  (let ((time (aref (numerics-outcome-moment outcome) 0)) (count (numerics-rows-count rows)))
    (unless (and (plusp count)
                 (= time (aref (numerics-rows-numbers rows)
                               (* (1- count) (numerics-rows-width rows)))))
      (numerics-add-row rows time (numerics-outcome-state outcome)))))

(defun numerics-row-state (rows k)
  (let ((place (* k (numerics-rows-width rows))))
    (subseq (numerics-rows-numbers rows) (1+ place) (+ place (numerics-rows-width rows)))))

;;; Progress

(defun numerics-progress-part (controls)
  "A part that tells the watch where the run is, every thousand steps, and looks at the clock."
  (let ((steps 0))
    (declare (fixnum steps))
    (lambda (step)
      (when (>= (incf steps) 1000)
        (setq steps 0)
        (core-progress "t = ~a of ~a" (numerics-short-number (aref (numerics-step-to step) 0))
                       (numerics-short-number (numerics-controls-end controls))))
      nil)))
