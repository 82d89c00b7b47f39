;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Impulses that the right-hand side of a run does not show (forms/rates_impulses.lisp). Where u
;;; changes its sign the states jump by gap/|u'|, u' being the rate of u; a run ends there unless
;;; that is below what its tolerance lets count, as for x^2*unit_step(x), whose gap is x^2. Where
;;; u' vanishes with u, as that of x^3 does, the jump is seen from beside. The step is cut at the
;;; zero, so that events before it are met. See numerics-impulse-parts first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "numerics/element_words" "numerics/event_samples"
                "numerics/events" "numerics/problem" "numerics/program" "numerics/routine"))

(defstruct numerics-impulse
  u                                ; an element, no number
  (first 0 :type fixnum)           ; of its gaps in the vector of all
  places)                          ; of the states that jump

(defstruct numerics-impulses
  list                             ; of numerics-impulse
  events                           ; of the u
  gaps                             ; (moment x out): all gaps
  (values (numerics-zeros 0) :type numerics-vector)
  allowed                          ; (state place): the jump that does not count
  (cut nil))                       ; the event at which a step was cut, and its impulse

(defun numerics-new-impulses (lost program allowed)
  "What looks for impulses LOST, as rates have them, in PROGRAM; nil where there are none. ALLOWED
is a function (state place)."
  (let ((lost (remove-if (lambda (one) (or (numberp (first one)) (null (rest one)))) lost))
        (n (length (numerics-program-names program))) (first 0))
    (when lost
      (with-numerics-program program
        (make-numerics-impulses
         :list (loop for (u . gaps) in lost
                     collect (make-numerics-impulse :u u :first first
                                                    :places (mapcar #'car gaps))
                     do (incf first (length gaps)))
         :events (numerics-new-events (numerics-routine program (mapcar #'first lost)) n
                                      (mapcar (constantly 0) lost)
                                      (mapcar (constantly nil) lost) nil)
         :gaps (numerics-routine program (loop for (nil . gaps) in lost
                                               append (mapcar #'cdr gaps)))
         :values (numerics-zeros first) :allowed allowed)))))

;;; How large the jump is

(defun numerics-beside (step)
  "The share of STEP that is looked at on both sides of a zero: short, but more than rounding."
  (max 1d-5 (min 0.25d0 (/ (* 1d-8 (1+ (abs (aref (numerics-step-from step) 0))))
                           (abs (numerics-step-length step))))))

(defun numerics-u-at (impulses step place share)
  (aref (numerics-events-at (numerics-impulses-events impulses) step (max 0d0 (min 1d0 share)))
        place))

(defun numerics-rise-about (impulses step place share width)
  "By how much the u in PLACE rises about SHARE of STEP, a time."
  (let ((from (max 0d0 (- share width))) (to (min 1d0 (+ share width))))
    (/ (- (numerics-u-at impulses step place to) (numerics-u-at impulses step place from))
       (* (- to from) (abs (numerics-step-length step))))))

(defun numerics-jump-counts-p (impulses step place share rise)
  "Whether a state jumps by more than is allowed, going by the gaps at SHARE of STEP and the RISE of
u."
  (let* ((impulse (nth place (numerics-impulses-list impulses))) (moment (numerics-zeros 2))
         (values (numerics-impulses-values impulses))
         (state (numerics-step-state step share (copy-seq (numerics-step-before step)))))
    (numerics-step-moment step share moment)
    (funcall (the function (numerics-impulses-gaps impulses)) moment state values)
    (loop for k from (numerics-impulse-first impulse)
          for i in (numerics-impulse-places impulse)
          thereis (> (abs (aref values k))
                     (* (abs rise) (funcall (numerics-impulses-allowed impulses) state i))))))

(defun numerics-impulse-at-p (impulses step place share)
  "Whether an impulse counts at the zero of the u in PLACE at SHARE of STEP."
  (let* ((near (numerics-beside step))
         (rise (numerics-rise-about impulses step place share near))
         (wide (numerics-rise-about impulses step place share (* 2 near))))
    (if (> (abs wide) (* 1.5d0 (abs rise)))
        (loop for beside in (list (- share near) (+ share near))
              thereis (and (<= 0d0 beside 1d0)
                           (numerics-jump-counts-p
                            impulses step place beside
                            (numerics-rise-about impulses step place beside (/ near 8)))))
        (numerics-jump-counts-p impulses step place share rise))))

;;; Along a run

(defun numerics-impulse-in (impulses step end)
  "The first event in STEP at which an impulse counts, and its u; nil where there is none. One at
the time END, as far as rounding tells, is none."
  (let ((events (numerics-impulses-events impulses)))
    (unless (= 0d0 (numerics-step-length step))
      (loop for (share place) in (numerics-zeros-of-step events step)
            for event = (numerics-event-of events step share place 0)
            when (and (not (numerics-at-end-p event step end))
                      (numerics-impulse-at-p impulses step place share))
              do (return (list event share
                               (numerics-impulse-u
                                (nth place (numerics-impulses-list impulses)))))))))

(defun numerics-at-end-p (event step end)
  (and end
       (<= (abs (- end (aref (numerics-event-moment event) 0)))
           (* 1d-12 (+ (abs end) (abs (numerics-step-length step)))))))

(defun numerics-impulse-parts (impulses end stopped found)
  "Two parts of an observer, before and after that which looks for events: the first cuts a step at
an impulse, the second calls FOUND with a phrase where the step ends there, and no event at which
the run was to stop has STOPPED it."
  (list
   (lambda (step)
     (let ((lost (numerics-impulse-in impulses step end)))
       (setf (numerics-impulses-cut impulses) lost)
       (when lost (numerics-end-step step (second lost) (first lost)))
       nil))
   (lambda (step)
     (let ((cut (numerics-impulses-cut impulses)))
       (when (and cut
                  (= (aref (numerics-step-to step) 0)
                     (aref (numerics-event-moment (first cut)) 0)))
         (unless (funcall stopped)
           (funcall found (numerics-impulse-words (third cut))))
         :stop)))))

(defun numerics-impulse-words (u)
  (format nil "where ~a = 0 a function that the equations are derivatives of jumps, and they do ~
               not show the impulse; give a smooth one"
          (or (numerics-element-words u) "an argument of its signs")))

;;; In a window of a plane, along lines through it

(defun numerics-straight-step (before after)
  "A step of length 1 from one state straight to another."
  (make-numerics-step :from (numerics-moment 0d0) :to (numerics-moment 1d0)
                      :before before :after after
                      :interpolate (lambda (share out)
                                     (map-into out (lambda (x y) (+ x (* share (- y x))))
                                               before after))))

(defun numerics-impulse-in-window (impulses lows highs)
  "The u at whose zero between LOWS and HIGHS, of two states, an impulse is lost; or nil."
  (flet ((at (u v) (map 'numerics-vector (lambda (share low high) (+ low (* share (- high low))))
                        (list u v) lows highs)))
    (loop for k to 20
          for share = (+ 0.012d0 (* 0.0488d0 k))
          thereis (loop for (before after) in (list (list (at 0d0 share) (at 1d0 share))
                                                    (list (at share 0d0) (at share 1d0)))
                        do (setf (numerics-events-sides (numerics-impulses-events impulses)) nil)
                        thereis (third (numerics-impulse-in
                                        impulses (numerics-straight-step before after) nil))))))
