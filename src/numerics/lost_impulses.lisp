;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Impulses that the right-hand side of a run does not show (forms/rates_impulses.lisp): the run
;;; ends where the argument of a sign that was differentiated leaves its side, unless what stood at
;;; the impulse vanishes there, as x^2 does where x^2*unit_step(x) begins. See
;;; numerics-impulse-part first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "forms/rates" "numerics/element_words"
                "numerics/event_samples" "numerics/events" "numerics/problem"
                "numerics/program" "numerics/routine"))

(defparameter *numerics-nothing-lost* 1d-9
  "A gap is 0, as far as rounding tells, below this share of the largest that was seen.")

(defstruct numerics-impulses
  lost                           ; lists (u gap ..), u no number
  events                         ; of the u
  gaps                           ; (moment x out), all in one vector
  (values (numerics-zeros 0) :type numerics-vector)
  (largest (numerics-zeros 0) :type numerics-vector))

(defun numerics-new-impulses (lost program)
  "What looks for impulses LOST, as rates have them, in PROGRAM; nil where there are none."
  (let ((lost (remove-if #'numberp lost :key #'first))
        (n (length (numerics-program-names program))))
    (when lost
      (with-numerics-program program
        (let* ((arguments (mapcar #'first lost)) (gaps (loop for (nil . gaps) in lost append gaps))
               (count (length gaps)))
          (make-numerics-impulses
           :lost lost
           :events (numerics-new-events (numerics-routine program arguments) n
                                        (mapcar (constantly 0) lost)
                                        (mapcar (constantly nil) lost) nil)
           :gaps (numerics-routine program gaps)
           :values (numerics-zeros count) :largest (numerics-zeros count)))))))

(defun numerics-gaps-at (impulses moment state)
  "The gaps there; the largest are noted."
  (let ((values (numerics-impulses-values impulses)) (largest (numerics-impulses-largest impulses)))
    (funcall (the function (numerics-impulses-gaps impulses)) moment state values)
    (map-into largest (lambda (a b) (if (> (abs b) a) (abs b) a)) largest values)
    values))

(defun numerics-impulse-at-p (impulses place)
  "Whether one of the gaps of PLACE, which have just been computed, is none by rounding alone."
  (let ((first (loop for (nil . gaps) in (subseq (numerics-impulses-lost impulses) 0 place)
                     sum (length gaps)))
        (count (length (cdr (nth place (numerics-impulses-lost impulses))))))
    (loop for k from first below (+ first count)
          thereis (> (abs (aref (numerics-impulses-values impulses) k))
                     (* *numerics-nothing-lost* (aref (numerics-impulses-largest impulses) k))))))

(defun numerics-impulse-in (impulses step &optional end)
  "The argument of a sign at whose zero in STEP, before the time END, an impulse is lost, or nil."
  (let ((events (numerics-impulses-events impulses)))
    (numerics-gaps-at impulses (numerics-step-to step) (numerics-step-after step))
    (loop for (share place) in (numerics-zeros-of-step events step)
          for event = (numerics-event-of events step share place 0)
          do (numerics-gaps-at impulses (numerics-event-moment event) (numerics-event-state event))
          when (and (not (eql end (aref (numerics-event-moment event) 0)))
                    (numerics-impulse-at-p impulses place))
            do (return (first (nth place (numerics-impulses-lost impulses)))))))

(defun numerics-impulse-part (impulses end found)
  "A part of an observer that calls FOUND with a phrase and ends the run before a step in which an
impulse is lost; one at the END of the run is none of it."
  (lambda (step)
    (let ((u (numerics-impulse-in impulses step end)))
      (when u
        (funcall found (format nil "where ~a = 0 a function that the equations are derivatives of ~
                                    jumps, and they do not show the impulse; give a smooth one"
                               (or (numerics-element-words u) "the argument of a sign")))
        (numerics-undo-step step)
        :stop))))

;;; In a window of a plane, along lines through it

(defun numerics-straight-step (before after)
  "A step of length 1 from one state straight to another."
  (make-numerics-step :from (numerics-moment 0d0) :to (numerics-moment 1d0)
                      :before before :after after
                      :interpolate (lambda (share out)
                                     (map-into out (lambda (x y) (+ x (* share (- y x))))
                                               before after))))

(defun numerics-impulse-in-window (impulses lows highs)
  "The argument of a sign at whose zero between LOWS and HIGHS, of two states, an impulse is lost;
or nil."
  (flet ((at (u v) (map 'numerics-vector (lambda (share low high) (+ low (* share (- high low))))
                        (list u v) lows highs)))
    (loop for k to 20
          for share = (+ 0.012d0 (* 0.0488d0 k))
          thereis (loop for (before after) in (list (list (at 0d0 share) (at 1d0 share))
                                                    (list (at share 0d0) (at share 1d0)))
                        do (setf (numerics-events-sides (numerics-impulses-events impulses)) nil)
                        thereis (numerics-impulse-in
                                 impulses (numerics-straight-step before after))))))

(defun numerics-refuse-impulses (rates)
  "An error where impulses may be lost, for what does not look on."
  (let ((lost (find-if-not #'numberp (forms-rates-impulses rates) :key #'first)))
    (when lost
      (core-error "where ~a = 0 a function that the equations are derivatives of jumps or has a ~
                   corner, and series do not see it; leave digits out, or give a smooth one"
                  (or (numerics-element-words (first lost)) "the argument of a sign")))))
