;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Derivatives at a point of functions with kinks and jumps: max, min, abs, signum, unit_step,
;;; piecewise.
;;; Near a point where it is decided which branch holds the function is that branch, and so is its
;;; derivative; where two branches meet there is none. Look first at forms-kinked-slope.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/sign" "forms/exchange"))

(defparameter *forms-kinked* '($max $min mabs %signum $unit_step $piecewise))

(defun forms-kinked-p (e)
  (and (consp e)
       (or (member (caar e) *forms-kinked*) (some #'forms-kinked-p (cdr e)))))

(defun forms-kinked-slope (e pairs)
  "The derivative noun E at the point PAIRS; nil where it is not decided which branch holds there."
  (when (and (eq (caar e) '%derivative) (forms-kinked-p (cadr e)))
    (let ((branch (catch 'forms-no-branch (forms-branch (cadr e) pairs))))
      (when (and branch (not (forms-kinked-p branch)))
        (forms-exchange (apply #'$diff branch (cddr e)) pairs)))))

(defun forms-branch (e pairs)
  "E with the branches that hold at the point; leaves forms-no-branch with nil where that is open."
  (cond ((not (forms-kinked-p e)) e)
        ((not (member (caar e) *forms-kinked*))
         (forms-with-parts e (mapcar (lambda (part) (forms-branch part pairs)) (cdr e))))
        ((eq (caar e) '$piecewise) (forms-piece e pairs))
        (t (let ((parts (mapcar (lambda (part) (forms-branch part pairs)) (cdr e))))
             (ecase (caar e)
               (%signum (forms-side-of e (car parts) pairs))
               (mabs (mul (forms-side-of e (car parts) pairs) (car parts)))
               ($unit_step (if (eql 1 (forms-side-of e (car parts) pairs)) 1 0))
               (($max $min) (forms-extreme e parts pairs)))))))

(defun forms-side-of (e u pairs)
  "1 or -1, the sign of U at the point; E, whose kink it is, has no derivative where U is 0."
  (case ($algebra_sign (forms-exchange u pairs))
    ($pos 1)
    ($neg -1)
    ($zero (forms-no-slope e))
    (t (throw 'forms-no-branch nil))))

(defun forms-no-slope (e)
  (core-error "~a has no derivative where its branches meet" (core-words (list e))))

(defun forms-extreme (e parts pairs)
  "The one of PARTS that is the largest, or smallest, at the point."
  (let ((better (if (eq (caar e) '$max) '$pos '$neg)) (open nil))
    (flet ((wins-p (part)
             (loop for other in (remove part parts :test #'alike1)
                   for sign = ($algebra_sign (forms-exchange (sub part other) pairs))
                   do (unless (member sign '($pos $neg $zero)) (setq open t))
                   always (eq sign better))))
      (cond ((find-if #'wins-p parts))
            (open (throw 'forms-no-branch nil))
            (t (forms-no-slope e))))))

(defun forms-piece (e pairs)
  "The value of piecewise([condition, value], ..) whose condition is the first that holds."
  (loop for (nil condition value) in (cdr e)
        when (forms-condition-holds-p e condition pairs) return (forms-branch value pairs)
        finally (return (throw 'forms-no-branch nil))))

(defun forms-condition-holds-p (e condition pairs)
  (cond ((member condition '(t $otherwise)) t)
        ((atom condition) (throw 'forms-no-branch nil))
        (t (let ((side (forms-side-of e (sub (second condition) (third condition)) pairs)))
             (case (caar condition)
               ((mgreaterp mgeqp) (= side 1))
               ((mlessp mleqp) (= side -1))
               (t (throw 'forms-no-branch nil)))))))

;;; For Maxima.

(defun $forms_kink_at (e point)
  "A function in E that has no derivative at POINT, equations; else false."
  (let ((pairs (forms-read-pairs (cdr point))))
    (labels ((find-kink (e)
               (cond ((atom e) nil)
                     ((some #'find-kink (cdr e)))
                     ((and (member (caar e) *forms-kinked*)
                           (null (core-attempt (lambda ()
                                                 (catch 'forms-no-branch
                                                   (forms-branch e pairs))))))
                      e))))
      (find-kink e))))
