;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Corners at a point: whether a function with branches has a derivative where some of them meet
;;; (forms-branches-agree-p), term by term; and whether one that jumps, or whose corner moves with
;;; velocities, leaves traces beside the point which equations that are its derivatives do not show.
;;; See forms-corner first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/exchange" "forms/piecewise"))

(defun forms-terms-p (e) (member (caar e) '(mplus mlist $matrix mequal)))

(defun forms-in-names-p (e names)
  (some (lambda (name) (among name e)) names))

(defun forms-some-term (function e names)
  "The first value of FUNCTION, of a term of E with branches and some of NAMES, that is not nil."
  (cond ((or (atom e) (not (forms-kinked-p e)) (not (forms-in-names-p e names))) nil)
        ((forms-terms-p e) (some (lambda (part) (forms-some-term function part names)) (cdr e)))
        (t (funcall function e))))

(defun $forms_corner_at (e names point)
  "A function in E that has no value, or none with derivatives by all NAMES, common to the branches
that meet at POINT, equations; else false."
  (forms-some-term (lambda (term) (forms-corner term (cdr names) (forms-putting (cdr point))))
                   e (cdr names)))

(defun $forms_split_at (e names point)
  "A function in E whose branches have no common value at POINT, equations, NAMES moving; or false."
  (forms-some-term (lambda (term) (forms-corner term '() (forms-putting (cdr point))))
                   e (cdr names)))

(defun forms-corner (e names at-point)
  (let ((branches (forms-branches-or-nil e at-point)))
    (and (cdr branches)
         (not (forms-branches-agree-p branches names at-point))
         (forms-kink-at e at-point))))

(defun $forms_undecided_at (e names point)
  "A function with branches in E of which it is not decided which hold at POINT; else false."
  (forms-some-term (lambda (term)
                     (and (null (forms-branches-or-nil term (forms-putting (cdr point))))
                          (forms-first-kinked term)))
                   e (cdr names)))

(defun $forms_branch_at (e point)
  "E with one of the branches that meet at POINT for each of its terms that has branches."
  (let ((at-point (forms-putting (cdr point))))
    (labels ((chosen (e)
               (cond ((not (forms-kinked-p e)) e)
                     ((forms-terms-p e) (forms-with-parts e (mapcar #'chosen (cdr e))))
                     (t (or (car (forms-branches-or-nil e at-point)) e)))))
      (chosen e))))

;;; Beside the point: terms that jump there, and terms whose corner moves with velocities, have
;;; impulses as derivatives, unless their branches have one value and slope all along the corner.

(defun $forms_impulse_at (e names velocities point)
  "A function in E whose derivatives may be impulses near POINT; else false."
  (forms-some-term (lambda (term)
                     (forms-impulse term (cdr names) (cdr velocities) (forms-putting (cdr point))))
                   e (cdr names)))

(defun forms-impulse (e names velocities at-point)
  (let ((kinks (forms-kinks-met e at-point)))
    (and (some (lambda (kink)
                 (or (member (caar kink) '(%signum $unit_step $piecewise))
                     (forms-in-names-p kink velocities)))
               kinks)
         (not (forms-joined-along-p e (forms-names-in kinks names) at-point))
         (car kinks))))

(defun forms-kinks-met (e at-point)
  "The functions in E of which several branches meet at the point."
  (and (forms-kinked-p e)
       (append (loop for part in (cdr e) append (forms-kinks-met part at-point))
               (and (member (caar e) *forms-kinked*) (forms-meeting-p e at-point) (list e)))))

(defun forms-names-in (es names)
  (remove-if-not (lambda (name) (some (lambda (e) (among name e)) es)) names))

(defun forms-joined-along-p (e moving at-point)
  "Whether the corner of E is where the one name of MOVING has its value, whatever the others are,
and value and slope of all branches agree there."
  (and (null (cdr moving))
       (forms-branches-agree-p
        (forms-branches e at-point) moving
        (forms-putting (list (list '(mequal simp) (car moving)
                                   (funcall at-point (car moving))))))))
