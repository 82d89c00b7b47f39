;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Derivatives of functions with branches, which Maxima leaves as nouns. Away from the corners
;;;     max(u, v)' = v' + (u' - v') unit_step(u - v),  signum(u)' = unit_step(u)' = 0,
;;; and piecewise is differentiated piece by piece; abs(u)' = u u'/abs(u) is Maxima's own. At a
;;; corner the formulas say nothing: who puts in a point asks forms/piecewise.lisp, by the function
;;; that was differentiated, whether there is a derivative. See algebra-branch-slope first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/impulses" "algebra/nouns"))

(defparameter *algebra-branched* '($max $min %signum $unit_step $piecewise))

(defun algebra-branched-p (e)
  (and (algebra-call-p e)
       (or (and (member (caar e) *algebra-branched*) t)
           (some #'algebra-branched-p (cdr e)))))

(defun $algebra_diff (e &rest variables)
  "diff(E, x, n, ..), functions with branches differentiated too."
  (let ((slope (apply #'$diff (if *algebra-impulses* (algebra-with-signs e) e) variables)))
    (if (algebra-branched-p e) (algebra-branches-carried slope) slope)))

(defun algebra-branches-carried (e)
  "E with the derivatives of functions with branches carried out."
  (cond ((not (algebra-branched-p e)) e)
        ((eq (caar e) '%derivative) (algebra-carried-slope (cadr e) (cddr e) e))
        ((eq (caar e) '%integrate) (algebra-branches-in-integral e))
        ((or (eq (caar e) '%at) (member 'array (car e))) e)
        (t (algebra-with-parts e (mapcar #'algebra-branches-carried (cdr e))))))

(defun algebra-carried-slope (body variables noun)
  "The derivative NOUN of BODY, itself where neither the rules above nor Maxima carry it out."
  (if (and (loop for (x order) on variables by #'cddr
                 always (and (symbolp x) (typep order '(integer 1))))
           (algebra-carried-by-p body (car variables)))
      (let ((slope body))
        (loop for (x order) on variables by #'cddr
              do (loop repeat order do (setq slope (algebra-slope-by slope x))))
        slope)
      noun))

(defun algebra-carried-by-p (body x)
  "Whether the derivative of BODY by X is more than its noun: f(max(x, 0))' of an open f is none."
  (and (algebra-branched-p body)
       (or (member (caar body) *algebra-branched*)
           (not (alike1 ($diff body x) (list '(%derivative simp) body x 1))))))

(defun algebra-slope-by (e x)
  (if (and (algebra-call-p e) (member (caar e) *algebra-branched*))
      (algebra-branch-slope e x)
      ($algebra_diff e x)))

(defun algebra-branches-in-integral (e)
  "The integral E, of whose integrand only derivatives of what does not jump are carried out."
  (if (algebra-jump-derived-p (second e))
      e
      (algebra-with-parts e (cons (algebra-branches-carried (second e)) (cddr e)))))

(defun algebra-jump-derived-p (e)
  (and (algebra-call-p e)
       (or (and (eq (caar e) '%derivative) (algebra-jumping-p (cadr e)))
           (some #'algebra-jump-derived-p (cdr e)))))

(defun algebra-jumping-p (e) (and ($algebra_jumping_part e) t))

(defun $algebra_jumping_part (e &optional names)
  "A part of E that may jump by itself, one in which some of NAMES occurs if they are given."
  (and (algebra-call-p e)
       (or (some (lambda (part) ($algebra_jumping_part part names)) (cdr e))
           (and (member (caar e) '(%signum $unit_step $piecewise))
                (or (null names) (some (lambda (name) (among name e)) (cdr names)))
                e))))

(defun $algebra_diff_within (e x &optional (order 1))
  "diff(E, X, ORDER), functions with branches differentiated too, but of what jumps: its derivative
is an impulse, and no formula shows it."
  (loop repeat order
        do (setq e (if (algebra-jumping-p e) ($diff e x) ($algebra_diff e x))))
  e)

(defun algebra-branch-slope (e x)
  "The derivative of E, a function with branches, by the name X, away from its corners."
  (ecase (caar e)
    (%signum (mul 2 (algebra-impulse-at (second e)) ($algebra_diff (second e) x)))
    ($unit_step (mul (algebra-impulse-at (second e)) ($algebra_diff (second e) x)))
    ($max (algebra-extreme-slope '$max 1 (algebra-moving-first (cdr e) x) x))
    ($min (algebra-extreme-slope '$min -1 (algebra-moving-first (cdr e) x) x))
    ($piecewise (algebra-slope-of-pieces (cdr e) x))))

(defun algebra-moving-first (parts x)
  (append (remove-if-not (lambda (part) (among x part)) parts)
          (remove-if (lambda (part) (among x part)) parts)))

(defun algebra-extreme-slope (operator side parts x)
  "The derivative of the largest (SIDE 1) or smallest (-1) of PARTS: v' + (u' - v')*unit_step(..)."
  (if (null (cdr parts))
      ($algebra_diff (car parts) x)
      (let* ((u (car parts))
             (v (if (cddr parts) (simplifya (cons (list operator) (cdr parts)) nil) (cadr parts)))
             (of-u ($algebra_diff u x))
             (of-v (algebra-extreme-slope operator side (cdr parts) x)))
        (add of-v (mul (sub of-u of-v) (take '($unit_step) (mul side (sub u v))))))))

(defun algebra-slope-of-pieces (pieces x)
  "Of [condition, value], ..: each value's derivative; where all are one, that is all."
  (let* ((slopes (loop for (nil nil value) in pieces collect ($algebra_diff value x)))
         (last (second (car (last pieces)))))
    (if (and (member last '(t $otherwise))
             (every (lambda (slope) (alike1 slope (car slopes))) slopes))
        (car slopes)
        (cons '($piecewise simp)
              (loop for (nil condition nil) in pieces
                    for slope in slopes collect (list '(mlist simp) condition slope))))))
