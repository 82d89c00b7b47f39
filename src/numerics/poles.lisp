;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Poles that a step passes. A method judges a step by a few values of the right-hand side; between
;;; them it may divide by zero, and the step come out with a state that looks right: of y' = tan(t),
;;; whose pole is no double-float number, steps of the last place lead to the other side. So signs
;;; of what is divided by are compared at both ends of each step. Where one has changed, the place
;;; is found, and the right-hand side X looked at there: b X, b the divisor, goes to 0 with b where
;;; X stays finite, as sin(x)/x does; at a pole it does not. See numerics-pole-part first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/element_words" "numerics/event_samples" "numerics/events"
                "numerics/problem" "numerics/program" "numerics/right_side_divisors"
                "numerics/routine" "numerics/zeros_between"))

(defstruct numerics-poles
  elements rates routine scales                         ; RATES (moment x out): X
  (signs nil)                                           ; of the elements before the step
  (values (numerics-zeros 0) :type numerics-vector)     ; of the elements
  (moment (numerics-zeros 2) :type numerics-vector)
  (state (numerics-zeros 0) :type numerics-vector)
  (slope (numerics-zeros 0) :type numerics-vector))

(defun numerics-new-poles (program positive rates scales)
  "What looks for poles of the RATES of PROGRAM, of whose divisors the elements POSITIVE are none;
nil where there cannot be any. SCALES are those of the states."
  (with-numerics-program program
    (let ((elements (numerics-divisors (numerics-program-rates program) positive))
          (n (length (numerics-program-names program))))
      (when elements
        (make-numerics-poles :elements elements :rates rates :scales scales
                             :routine (numerics-routine program elements)
                             :values (numerics-zeros (length elements))
                             :state (numerics-zeros n) :slope (numerics-zeros n))))))

(defun numerics-pole-part (poles found)
  "A part of an observer that calls FOUND with words for what vanishes, and the time, and ends the
run before a step over a pole."
  (lambda (step)
    (let ((place (numerics-passed-pole poles step)))
      (when place
        (funcall found (numerics-element-words (nth place (numerics-poles-elements poles)))
                 (numerics-pole-time poles step place))
        (numerics-undo-step step)
        :stop))))

(defun numerics-passed-pole (poles step)
  "The place of a divisor of which STEP passes a pole, or nil."
  (unless (numerics-poles-signs poles)
    (setf (numerics-poles-signs poles)
          (make-array (length (numerics-poles-elements poles)) :initial-element 0))
    (numerics-note-signs poles (numerics-step-from step) (numerics-step-before step)))
  (loop for place in (numerics-note-signs poles (numerics-step-to step)
                                          (numerics-step-after step))
        when (numerics-pole-p poles step place) do (return place)))

(defun numerics-note-signs (poles moment state)
  "Notes the signs at STATE; the places of those that have changed. At 0 the last one stays."
  (let ((values (numerics-poles-values poles)) (signs (numerics-poles-signs poles)) (changed '()))
    (funcall (the function (numerics-poles-routine poles)) moment state values)
    (dotimes (place (length values) changed)
      (let ((before (svref signs place)) (now (numerics-side (aref values place))))
        (unless (or (eql now 0) (eql now before))
          (setf (svref signs place) now)
          (unless (eql before 0) (push place changed)))))))

;;; Whether a divisor that changed its sign makes a pole

(defun numerics-divisor-at (poles step place share)
  "The value of the divisor PLACE at SHARE of STEP; the moment and the state there are noted."
  (let ((moment (numerics-poles-moment poles)) (state (numerics-poles-state poles)))
    (numerics-step-moment step share moment)
    (numerics-step-state step share state)
    (funcall (the function (numerics-poles-routine poles)) moment state
             (numerics-poles-values poles))
    (aref (numerics-poles-values poles) place)))

(defun numerics-strength (poles step place share)
  "Two values: the divisor b there, and the vector b X; nil where that has no value."
  (let ((b (numerics-divisor-at poles step place share)) (slope (numerics-poles-slope poles)))
    (funcall (the function (numerics-poles-rates poles)) (numerics-poles-moment poles)
             (numerics-poles-state poles) slope)
    (values b (let ((product (map 'numerics-vector (lambda (x) (* b x)) slope)))
                (and (/= b 0d0) (every #'numerics-finite-p product) product)))))

(defun numerics-divisor-zero (poles step place)
  "The share of STEP where the divisor PLACE vanishes."
  (numerics-zero-between (lambda (share) (numerics-divisor-at poles step place share)) 0d0 1d0
                         (numerics-share-tolerance step)))

(defun numerics-pole-time (poles step place)
  (let ((moment (numerics-poles-moment poles)))
    (numerics-step-moment step (numerics-divisor-zero poles step place) moment)
    (aref moment 0)))

(defun numerics-pole-p (poles step place)
  "Whether b X, of the divisor b at PLACE, does not vanish where b does: at the zero of b, as near
as numbers come, it is compared with that at a small distance."
  (let* ((tolerance (numerics-share-tolerance step)) (distance (sqrt tolerance))
         (share (numerics-divisor-zero poles step place)))
    (multiple-value-bind (near at-near) (numerics-strength-near poles step place share tolerance)
      (multiple-value-bind (far at-far)
          (numerics-greater-strength poles step place (numerics-shares-about share distance))
        (flet ((visible (change) (numerics-visible-strengths poles step far change)))
          (cond ((> (abs near) (abs far)) nil)
                ((and at-near at-far)
                 (numerics-strength-stays-p (abs (/ near far)) at-near
                                            (numerics-at-least at-far (visible 1d-6))
                                            (visible (/ 1d-15 distance))))
                (t t)))))))

(defun numerics-shares-about (share distance)
  (list (max 0d0 (- share distance)) (min 1d0 (+ share distance))))

(defun numerics-strength-near (poles step place share tolerance)
  "That at SHARE, or beside it where there is none."
  (dolist (share (cons share (numerics-shares-about share tolerance)) (values 0d0 nil))
    (multiple-value-bind (b product) (numerics-strength poles step place share)
      (when product (return (values b product))))))

(defun numerics-greater-strength (poles step place shares)
  "That at the one of two SHARES where the divisor is greater."
  (destructuring-bind (left right)
      (loop for share in shares
            collect (multiple-value-list (numerics-strength poles step place share)))
    (values-list (if (> (abs (first left)) (abs (first right))) left right))))

(defun numerics-visible-strengths (poles step b change)
  "The b X, of the value B, that change each component of the state by CHANGE of its scale in STEP,
or in the last place of the time."
  (let* ((from (aref (numerics-step-from step) 0)) (to (aref (numerics-step-to step) 0))
         (length (max (abs (- to from)) (* double-float-epsilon (+ (abs to) (abs from)))
                      least-positive-normalized-double-float)))
    (map 'numerics-vector
         (lambda (x scale) (abs (/ (* change b (+ (abs x) scale)) length)))
         (numerics-step-before step) (numerics-poles-scales poles))))

(defun numerics-at-least (strengths least)
  (map 'numerics-vector (lambda (a b) (max (abs a) b)) strengths least))

(defun numerics-strength-stays-p (ratio near far least)
  "Whether a component of NEAR is more than is left of that of FAR when b goes down by RATIO: half
its square root; and more than LEAST, which at the small distance changes the state in its last
place. (Where a sum that has become small is divided by another, as t - a by t - (b + a), b = 0
up to rounding, NEAR is rounding alone.)"
  (loop for a across near
        for b across far
        for c across least
          thereis (> (abs a) (max c (* 0.5d0 (sqrt ratio) b)))))
