;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Curves of states and of expressions in them against time, drawn from the rows of a run. What is
;;; to be drawn is read before the run. Look first at $numerics_time_plot.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_from_expressions"
                "algebra/program_nodes" "forms/rates" "numerics/native" "numerics/pictures"
                "numerics/problem" "numerics/program" "numerics/rate_program" "numerics/routine"
                "numerics/run" "numerics/run_options"))

(defstruct numerics-curves
  labels     ; texts
  routine)   ; (moment state out): the values

(defun numerics-read-plot (plot)
  "The expressions of the option PLOT, one or a list of them."
  (let ((expressions (or (numerics-items plot) (list plot))))
    (when (or (find t expressions) (find nil expressions) (some #'stringp expressions)
              (some (lambda (e) (and (consp e) (member (caar e) '(mequal mlist)))) expressions))
      (core-error "plot is a list of states or of expressions in them, such as [x, x^2 + y^2]; ~
                   found ~a" (core-words (list plot))))
    expressions))

(defun $numerics_curves (plot rates values start)
  "What the option PLOT wants of the rows of RATES with VALUES."
  (with-algebra-program
    (let* ((expressions (numerics-read-plot plot))
           (pairs (numerics-parameter-pairs values rates))
           (rates (numerics-with-quadratures (numerics-exchanged-rates rates pairs) start))
           (elements (algebra-exchanged (mapcar #'algebra-program-element expressions)
                                        (algebra-exchange-by pairs))))
      (numerics-check-names rates elements)
      (make-numerics-curves
       :labels (mapcar #'numerics-state-text expressions)
       :routine (numerics-routine (make-numerics-program :algebra *algebra-program*
                                                         :names (forms-rates-states rates))
                                  elements)))))

(defun numerics-curve-places (curves rows)
  "A list of places (t value) for each of CURVES; what has no value is left out."
  (let* ((count (length (numerics-curves-labels curves))) (out (numerics-zeros count))
         (places (make-array count :initial-element '())))
    (dolist (row rows (map 'list #'reverse places))
      (destructuring-bind (time . state) (mapcar (lambda (x) (numerics-double x "a row"))
                                                 (numerics-items row))
        (numerics-with-masked-traps
          (funcall (numerics-curves-routine curves) (numerics-moment time)
                   (coerce state 'numerics-vector) out)
          (dotimes (k count)
            (when (numerics-finite-p (aref out k))
              (push (list time (aref out k)) (aref places k)))))))))

(defparameter *numerics-colours*
  '("#4477aa" "#cc3311" "#228833" "#aa3377" "#ee7733" "#009988" "#bbaa00" "#555555"))

(defun numerics-value-range (places)
  "The option of draw that shows all of PLACES, with a margin; none where they are too large."
  (when places
    (let* ((low (reduce #'min places :key #'second)) (high (reduce #'max places :key #'second))
           (margin (* 0.04d0 (- (/ high 2) (/ low 2)))))
      (when (and (plusp margin) (< (max (abs low) (abs high)) 1d300))
        (list (numerics-option '$yrange (list '(mlist simp) (- low (* 2 margin))
                                              (+ high (* 2 margin)))))))))

(defun numerics-time-items (labels curves)
  "CURVES, lists of places, each under its of LABELS."
  (loop for places in curves
        for label in labels
        for k from 0
        when places
          append (list (numerics-option '$color (nth (mod k (length *numerics-colours*))
                                                     *numerics-colours*))
                       (numerics-option '$key (numerics-doubled-quotes (core-cut label)))
                       (numerics-points places))))

(defparameter *numerics-most-named-curves* 30 "The names of more would take the place of curves.")

(defun numerics-late-digits-p (low high)
  "Whether numbers from LOW to HIGH differ in late digits only, which gnuplot would not write."
  (< (- high low) (* 1d-4 (max (abs low) (abs high)))))

(defun numerics-time-lines (labels places)
  "Lines of gnuplot: no legend for many LABELS; all digits where numbers differ in late ones; axes
that are very short."
  (flet ((ends (key) (values (reduce #'min places :key key) (reduce #'max places :key key))))
    (multiple-value-bind (begin end) (ends #'first)
      (multiple-value-bind (low high) (ends #'second)
        (append
         (when (nthcdr *numerics-most-named-curves* labels) '("unset key"))
         (when (numerics-late-digits-p begin end)
           '("set format x '%.15g'" "set xtics autofreq rotate"))
         (when (numerics-late-digits-p low high) '("set format y '%.15g'"))
         (numerics-small-range-lines "x" begin end)
         (numerics-small-range-lines "y" low high))))))

(defun numerics-check-curves (labels places)
  "A line where one of LABELS has no PLACES; an error where none has."
  (let ((empty (loop for label in labels for curve in places unless curve collect label)))
    (when empty
      (funcall (if (some #'identity places) #'core-warn #'core-error)
               "~{~a~^, ~} ha~:[s~;ve~] no value at any row: there is nothing to draw"
               empty (cdr empty)))))

(defun $numerics_time_plot (picture curves rows)
  "Draws CURVES from ROWS, and gives these."
  (let ((labels (numerics-curves-labels curves))
        (places (numerics-curve-places curves (numerics-items rows))))
    (numerics-check-curves labels places)
    (numerics-draw picture
                   (append (list (apply #'numerics-preamble "t"
                                        (if (cdr labels) "" (first labels))
                                        (numerics-time-lines labels (apply #'append places)))
                                 (numerics-option '$points_joined t)
                                 (numerics-option '$point_size 0)
                                 (numerics-option '$line_width 1.5d0))
                           (numerics-value-range (apply #'append places))
                           (numerics-time-items labels places)))
    rows))
