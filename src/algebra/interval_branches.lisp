;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Intervals of functions with branches: abs, max, min, signum and unit_step (0 at 0, as Maxima
;;; has it) of intervals, piecewise by those of its values that may hold. An interval is a pair
;;; (lo . hi) of integers in units of the caller.

(in-package :maxima)

(defun algebra-i-abs (a)
  (cond ((minusp (cdr a)) (cons (- (cdr a)) (- (car a))))
        ((plusp (car a)) a)
        (t (cons 0 (max (- (car a)) (cdr a))))))

(defun algebra-i-extreme (extreme intervals)
  "EXTREME, max or min, of INTERVALS: it grows with each of them."
  (cons (reduce extreme intervals :key #'car) (reduce extreme intervals :key #'cdr)))

(defun algebra-i-signum (a unit)
  (cons (* unit (signum (car a))) (* unit (signum (cdr a)))))

(defun algebra-i-step (a unit)
  (flet ((step-of (x) (if (plusp x) unit 0)))
    (cons (step-of (car a)) (step-of (cdr a)))))

(defun algebra-i-branched (e of unit)
  "The interval of the function with branches E, OF being that of a part; else nil."
  (case (caar e)
    (mabs (algebra-i-abs (funcall of (cadr e))))
    ($max (algebra-i-extreme #'max (mapcar of (cdr e))))
    ($min (algebra-i-extreme #'min (mapcar of (cdr e))))
    (%signum (algebra-i-signum (funcall of (cadr e)) unit))
    ($unit_step (algebra-i-step (funcall of (cadr e)) unit))
    ($piecewise (algebra-i-pieces (cdr e) of))))

(defun algebra-i-pieces (pieces of)
  "What holds all values up to the first whose condition surely holds."
  (let ((met '()))
    (loop for (nil condition value) in pieces
          for holds = (algebra-i-condition condition of)
          unless (eq holds 'no) do (push (funcall of value) met)
          until (eq holds 'yes)
          finally (unless (eq holds 'yes) (throw 'no-interval nil)))
    (cons (reduce #'min met :key #'car) (reduce #'max met :key #'cdr))))

(defun algebra-i-condition (condition of)
  "yes, no or unknown."
  (cond ((member condition '(t $otherwise)) 'yes)
        ((or (atom condition) (not (member (caar condition) '(mgreaterp mgeqp mlessp mleqp))))
         (throw 'no-interval nil))
        (t (algebra-i-compared (caar condition) (funcall of (cadr condition))
                               (funcall of (caddr condition))))))

(defun algebra-i-compared (relation a b)
  (ecase relation
    (mgreaterp (algebra-i-above a b #'> #'<=))
    (mgeqp (algebra-i-above a b #'>= #'<))
    (mlessp (algebra-i-above b a #'> #'<=))
    (mleqp (algebra-i-above b a #'>= #'<))))

(defun algebra-i-above (a b holds fails)
  (cond ((funcall holds (car a) (cdr b)) 'yes)
        ((funcall fails (cdr a) (car b)) 'no)
        (t 'unknown)))
