;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a person wants of a run: the start, the span of time, and the options that are its wishes.
;;; The start, the span, points, tolerance and first_step are read here, from exact numbers (%pi/2
;;; is one), and what cannot be meant is refused in one sentence. See numerics-wishes first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/nearest" "numerics/decimals" "numerics/observers" "numerics/problem"))

(core-record numerics-wishes
  "METHOD a symbol; POINTS a number of rows or a list of times; TOLERANCE as typed; EVENTS a list of
expressions, of which the first STOP = true ends the run; DIGITS 0 for double-float numbers; STEP of
methods with a fixed one, or 0; ESTIMATE and CONDITIONING: whether these are wanted."
  method points tolerance events stop digits step estimate conditioning)

;;; Numbers

(defun numerics-number-or-nil (e)
  "The double-float number next to the Maxima constant E; nil where there is none."
  (let ((value (car (core-attempt (lambda () ($float e))))))
    (and (floatp value) (numerics-finite-p (coerce value 'double-float))
         (coerce value 'double-float))))

(defun numerics-double (e what)
  "The same; an error where there is none. WHAT it is, for the message."
  (or (numerics-number-or-nil e)
      (if (mnump e)
          (core-error "~a is beyond the range of double-float numbers, 1.8e308" what)
          (core-error "~a must be a number, found ~a" what (core-words (list e))))))

(defun numerics-items (list)
  (and (consp list) (consp (car list)) (eq (caar list) 'mlist) (cdr list)))

;;; The span of time: [t, a, b], or [a, b]

(defun numerics-read-span (span)
  "(a b), exact Maxima constants, of SPAN."
  (let ((items (numerics-items span)))
    (when (and (= (length items) 3) (eq (first items) '$t)) (pop items))
    (unless (= (length items) 2)
      (core-error "the span of time is [t, 0, 10], found ~a" (core-words (list span))))
    (destructuring-bind (from to) (mapcar (lambda (e) (numerics-double e "an end of the span"))
                                          items)
      (unless (< from to)
        (core-error "the span of time ends at ~a, not after its start ~a; ~
                     give the earlier time first"
                    (core-words (list (second items))) (core-words (list (first items))))))
    items))

;;; Rows

(defparameter *numerics-most-rows* 1000000)

(defun numerics-read-points (points from to)
  "The vector of the times of the rows between FROM and TO, double-float numbers."
  (cond ((and (integerp points) (<= 2 points *numerics-most-rows*))
         (numerics-uniform-times from to points))
        ((numerics-items points) (numerics-given-times (numerics-items points) from to))
        (t (core-error "points is the number of rows, from 2 to ~d, or a list of times; found ~a"
                       *numerics-most-rows* (core-words (list points))))))

(defun numerics-given-times (items from to)
  (let ((times (coerce (mapcar (lambda (e) (numerics-double e "a time in points")) items)
                       'numerics-vector)))
    (loop for time across times
          for before = nil then now
          for now = time
          do (unless (and (<= from now to) (or (null before) (< before now)))
               (core-error "the times in points increase, and lie within the span from ~a to ~a; ~
                            found ~a"
                           from to now)))
    times))

;;; Tolerance: r, or [r, a], or [r, [a1, ..]]: relative, and absolute of all or of each state

(defparameter *numerics-least-tolerance* 1d-13)

(defun numerics-read-tolerance (tolerance names)
  "Two values: the relative tolerance, and the vector of the scales a_i/r, one for each of NAMES."
  (let* ((items (or (numerics-items tolerance) (list tolerance)))
         (relative (numerics-double (first items) "tolerance"))
         (absolute (and (cdr items) (null (cddr items)) (second items))))
    (unless (<= 1 (length items) 2)
      (core-error "tolerance is a number, or [relative, absolute]; found ~a"
                  (core-words (list tolerance))))
    (numerics-check-tolerance relative)
    (values relative
            (map 'numerics-vector (lambda (a) (/ a relative))
                 (numerics-absolute-tolerances absolute relative names)))))

(defun numerics-check-tolerance (relative)
  (cond ((< relative *numerics-least-tolerance*)
         (core-error "a tolerance of ~a is below 1e-13, what double-float numbers can keep; for ~
                      more digits give digits = 30"
                     (numerics-short-number relative)))
        ((> relative 1d-1)
         (core-error "a tolerance of ~a means nothing; give one from 1e-13 to 0.1"
                     (numerics-short-number relative)))))

(defun numerics-absolute-tolerances (absolute relative names)
  "The list of a_i from what was given, nil, a number or a list of numbers."
  (let ((list (cond ((null absolute) (mapcar (constantly relative) names))
                    ((numerics-items absolute)
                     (mapcar (lambda (e) (numerics-double e "an absolute tolerance"))
                             (numerics-items absolute)))
                    (t (let ((a (numerics-double absolute "the absolute tolerance")))
                         (mapcar (constantly a) names))))))
    (unless (= (length list) (length names))
      (core-error "there are ~d absolute tolerances for ~d states: ~{~a~^, ~}"
                  (length list) (length names) (mapcar (lambda (e) (core-words (list e))) names)))
    (unless (every #'plusp list)
      (core-error "an absolute tolerance is greater than 0"))
    list))

;;; The length of the first step, of methods with a fixed one of all; 0: they choose it

(defun numerics-read-first-step (step)
  (unless (eql step 0)
    (let ((length (numerics-double step "first_step")))
      (unless (plusp length)
        (core-error "first_step is the length of a step, greater than 0; found ~a"
                    (core-words (list step))))
      length)))

;;; The start: values of the states, names in the order NAMES

(defun numerics-velocity-p (name) (and (consp name) (eq (caar name) '%derivative)))

(defun numerics-read-start (start names default)
  "The list of exact start values of NAMES from the equations START; DEFAULT, a function of the
name, gives those that are not named."
  (dolist (equation (numerics-items start))
    (unless (and (consp equation) (eq (caar equation) 'mequal))
      (core-error "the start is a list such as [theta = 1, 'diff(theta,t) = 0], found ~a"
                  (core-words (list start)))))
  (loop for name in names
        for equation = (find name (numerics-items start) :key #'second :test #'alike1)
        collect (if equation (third equation) (funcall default name))))

(defun numerics-check-start-names (start names quadratures)
  "An error for a name in START that is none of NAMES; velocities of coordinates that are left to
QUADRATURES follow from their momenta."
  (dolist (equation (numerics-items start))
    (let ((name (second equation)))
      (cond ((member name names :test #'alike1))
            ((member name quadratures :test #'alike1)
             (core-warn "~a follows from its momentum; its start value is not used"
                        (core-words (list name))))
            (t (numerics-refuse-start-name name names))))))

(defun numerics-refuse-start-name (name names)
  (let* ((spelled (core-words (list name)))
         (near (core-nearest spelled (mapcar (lambda (e) (core-words (list e))) names))))
    (core-error "~a is no state of this system~@[; did you mean ~a?~]; the states are ~{~a~^, ~}~
                 ~:[~;, without velocities: give a start in these~]"
                spelled near (mapcar (lambda (e) (core-words (list e))) names)
                (and (numerics-velocity-p name) (notany #'numerics-velocity-p names)))))
