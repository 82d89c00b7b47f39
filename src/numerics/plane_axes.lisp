;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The axes of a plane of two states: their ends, which of them are angles, and after how many
;;; whole turns of an angle all rates are the same. Places along an axis go from 0 to 1.
;;; Look first at numerics-read-axes.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "forms/rates" "numerics/native" "numerics/problem"
                "numerics/program" "numerics/routine" "numerics/run" "numerics/run_options"))

(defstruct numerics-axis
  name                            ; the state
  (low 0d0 :type double-float) (width 1d0 :type double-float)
  turns)                          ; whole turns after which all rates are the same, nil for none

(core-record numerics-window
  "HORIZONTAL and VERTICAL are [name, low, high] as typed, START equations for what is held."
  horizontal vertical start)

;;; The window

(defparameter *numerics-largest-end* 1d100)
(defparameter *numerics-narrowest-axis* 1d-9 "In parts of the larger of its ends.")
(defparameter *numerics-longest-angle* (* 200 pi) "A hundred turns.")

(defun numerics-check-axis (axis ends)
  "An error where AXIS with ENDS, numbers as typed, cannot be drawn."
  (let* ((low (numerics-axis-low axis)) (width (numerics-axis-width axis))
         (largest (max (abs low) (abs (+ low width)))))
    (unless (plusp width)
      (core-error "the axis of ~a ends at ~a, not after its start ~a; give the smaller number first"
                  (numerics-name-text (numerics-axis-name axis)) (core-words (list (second ends)))
                  (core-words (list (first ends)))))
    (unless (and (<= largest *numerics-largest-end*)
                 (>= largest (/ *numerics-largest-end*))
                 (> width (* *numerics-narrowest-axis* largest)))
      (core-error "the axis of ~a from ~a to ~a is too ~:[wide~;narrow~] to be drawn"
                  (numerics-name-text (numerics-axis-name axis))
                  (core-cut (core-words (list (first ends))))
                  (core-cut (core-words (list (second ends)))) (<= largest *numerics-largest-end*)))
    (when (and (numerics-axis-turns axis) (> width *numerics-longest-angle*))
      (core-error "the axis of the angle ~a goes through more than 100 turns; take a shorter one"
                  (numerics-name-text (numerics-axis-name axis))))
    axis))

(defun numerics-read-axis (items rates period)
  "PERIOD tells of a state after how many turns all is the same."
  (destructuring-bind (name . ends) (numerics-items items)
    (unless (member name (forms-rates-states rates) :test #'alike1)
      (numerics-refuse-start-name name (forms-rates-states rates)))
    (destructuring-bind (from to)
        (mapcar (lambda (e) (numerics-double e "an end of an axis")) ends)
      (numerics-check-axis
       (make-numerics-axis :name name :low from
                           :width (numerics-with-masked-traps (- to from))
                           :turns (and (member name (forms-rates-angles rates) :test #'alike1)
                                       (funcall period name)))
       ends))))

(defun numerics-read-axes (window rates)
  (let* ((period (numerics-period-of rates))
         (axes (list (numerics-read-axis (numerics-window-horizontal window) rates period)
                     (numerics-read-axis (numerics-window-vertical window) rates period))))
    (when (alike1 (numerics-axis-name (first axes)) (numerics-axis-name (second axes)))
      (core-error "both axes are ~a; take two states"
                  (numerics-name-text (numerics-axis-name (first axes)))))
    axes))

(defun numerics-place (axis number)
  "Where the state NUMBER stands along AXIS: 0 at its low end, 1 at its high one."
  (declare (double-float number))
  (/ (- number (numerics-axis-low axis)) (numerics-axis-width axis)))

(defun numerics-at-place (axis place)
  (declare (double-float place))
  (+ (numerics-axis-low axis) (* place (numerics-axis-width axis))))

;;; What the rates truly depend on, at three places: a program may name a state that cancels

(defun numerics-some-places (n)
  (loop for k from 1 to 3
        collect (map 'numerics-vector (lambda (i) (+ 0.4d0 (* 0.3d0 (sin (* k i)))))
                     (loop for i from 1d0 to n collect i))))

(defun numerics-element-routine (rates elements)
  "The function (moment state out) of ELEMENTS, the state being one of RATES."
  (numerics-routine (make-numerics-program :algebra *algebra-program*
                                           :names (forms-rates-states rates))
                    elements))

(defun numerics-same-after-p (routine count x place way)
  "Whether the COUNT values of ROUTINE at X are the same where the state at PLACE is moved on by
WAY."
  (let ((later (copy-seq x)) (here (numerics-zeros count)) (there (numerics-zeros count)))
    (incf (aref later place) way)
    (numerics-with-masked-traps
      (funcall routine (numerics-moment 0d0) x here)
      (funcall routine (numerics-moment 0d0) later there)
      (every (lambda (a b) (<= (abs (- a b)) (* 1d-9 (+ 1 (abs a))))) here there))))

;;; Turns: what stands in sin(x/2) is the same after two of them

(defparameter *numerics-most-turns* 12)

(defun numerics-period-of (rates)
  "The function of a state that gives the number of turns after which all RATES are the same; nil
where it is not found."
  (let* ((names (forms-rates-states rates)) (n (length names)) (places (numerics-some-places n))
         (routine (numerics-element-routine rates (forms-right-sides rates))))
    (lambda (name)
      (let ((place (position name names :test #'alike1)))
        (loop for turns from 1 to *numerics-most-turns*
              when (every (lambda (x) (numerics-same-after-p routine n x place (* 2 pi turns)))
                          places)
                return turns)))))
