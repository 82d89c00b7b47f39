;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Two diagrams of work and precision, log-log, from the record of ErrorAgainstTime: the error at
;;; the end over seconds and over evaluations of the right side, a curve for each method; below the
;;; lines of the reference's floor and of the conditioning nothing is known. What failed stands
;;; underneath. Look first at $numerics_error_plot.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/messages" "numerics/decimals" "numerics/error_against_time"
                "numerics/pictures" "numerics/time_plot"))

(defun numerics-of-row (row column)
  "What ROW, a Maxima list, has in COLUMN."
  (nth (position column *numerics-row-columns*) (cdr row)))

(defun numerics-rows-by-method (rows)
  "((method row ..) ..) in the order of ROWS."
  (let ((groups '()))
    (dolist (row rows (mapcar (lambda (group) (cons (first group) (reverse (rest group))))
                              (reverse groups)))
      (let* ((method (numerics-of-row row '$method)) (group (assoc method groups)))
        (if group
            (push row (rest group))
            (push (list method row) groups))))))

(defparameter *numerics-least-shown* 1d-17 "An error of 0 stands here.")

(defun numerics-cost-places (rows cost)
  "Places (cost error) of those of ROWS that have both; COST is a column."
  (loop for row in rows
        for x = (numerics-of-row row cost)
        for error = (numerics-of-row row '$error)
        when (and error x (plusp x)) collect (list x (max error *numerics-least-shown*))))

;;; What failed

(defun numerics-failure-lines (groups)
  "A sentence for each method that did not come to the end at all its tolerances."
  (loop for (method . rows) in groups
        for failed = (find-if-not #'numerics-reached-row-p rows)
        when failed
          collect (format nil "~a at ~a: ~a~:[~;; tighter ones skipped~]" (core-spelling method)
                          (numerics-tolerance-text (numerics-of-row failed '$tolerance))
                          (numerics-of-row failed '$status)
                          (rest (member failed rows)))))

(defun numerics-reached-row-p (row)
  (eql (search "reached the end" (numerics-of-row row '$status)) 0))

;;; A diagram

(defparameter *numerics-point-types*
  '($circle $filled_square $filled_up_triangle $filled_diamant $filled_down_triangle))
(defparameter *numerics-point-sizes* '(2.6d0 1.8d0 1.6d0 1.4d0 1.2d0))

(defun numerics-method-items (groups cost)
  "A curve for each method; the signs become smaller, and the first is open, so that one that lies
on another shows it: the first is the method that chooses one of the others."
  (append (list (numerics-option '$points_joined t) (numerics-option '$line_width 1.6d0))
          (loop for (method . rows) in groups
                for colour in *numerics-colours*
                for sign in *numerics-point-types*
                for point-size in *numerics-point-sizes*
                for places = (numerics-cost-places rows cost)
                when places
                  append (list (numerics-option '$color colour)
                               (numerics-option '$point_type sign)
                               (numerics-option '$point_size point-size)
                               (numerics-option '$key (core-spelling method))
                               (numerics-points places)))))

(defun numerics-floor-items (floors range)
  "Lines across RANGE for FLOORS, (text value type of line)."
  (list* (numerics-option '$point_size 0) (numerics-option '$line_width 2)
         (loop for (text value type) in floors
               when value
                 append (list (numerics-option '$color "#222222") (numerics-option '$line_type type)
                              (numerics-option '$key text)
                              (numerics-points (list (list (first range) value)
                                                     (list (second range) value)))))))

(defun numerics-decades (values)
  "The decades around VALUES."
  (if values
      (flet ((power (x) (expt 10d0 x)))
        (let ((low (floor (- (log (reduce #'min values) 10) 0.1d0)))
              (high (ceiling (+ (log (reduce #'max values) 10) 0.1d0))))
          (list (power low) (power high))))
      (list 1d-6 1d0)))

(defun numerics-range-command (axis range)
  (format nil "set ~arange [~a:~a]" axis (numerics-short-number (first range))
          (numerics-short-number (second range))))

(defun numerics-diagram (groups cost floors preamble)
  "The scene of the errors of GROUPS over the column COST, with lines for FLOORS; PREAMBLE is a
function of further commands."
  (let* ((places (loop for (nil . rows) in groups append (numerics-cost-places rows cost)))
         (width (numerics-decades (mapcar #'first places)))
         (height (numerics-decades (append (mapcar #'second places)
                                           (remove nil (mapcar #'second floors))))))
    ;; The option yrange of draw takes ends below 1e-15 for equal, and moves them.
    (append (list (funcall preamble (numerics-range-command "x" width)
                           (numerics-range-command "y" height))
                  (numerics-option '$logx t) (numerics-option '$logy t))
            (numerics-method-items groups cost)
            (numerics-floor-items floors width)
            (unless places
              (list (list '($label simp)
                          (list '(mlist simp) (numerics-why-empty groups)
                                (sqrt (apply #'* width)) (sqrt (apply #'* height)))))))))

(defun numerics-why-empty (groups)
  (if (loop for (nil . rows) in groups thereis (some #'numerics-reached-row-p rows))
      "there is no reference"
      "no method reached the end"))

(defun numerics-diagram-preamble (label room lines)
  "The preamble as a function of further commands. Below the axis there is ROOM for so many lines,
and at the foot of the picture stand LINES."
  (let ((foot (loop for (text . more) on lines
                    collect (format nil "set label ~a at screen 0.05, screen 0 offset character 0, ~
                                         ~d left noenhanced"
                                    (numerics-gnuplot-text text) (1+ (length more))))))
    (lambda (&rest commands)
      (apply #'numerics-preamble label "error at the end"
             "set key samplen 2" "set format xy '10^{%L}'" "set grid" "unset label"
             (format nil "set bmargin ~d" (+ 4 room))
             (append commands foot)))))

(defun $numerics_error_plot (picture record)
  "Draws RECORD, and gives it."
  (let* ((groups (numerics-rows-by-method (cdr ($core_get record '$rows))))
         (lines (numerics-failure-lines groups)) (room (length lines))
         (floors (list (list "reference"
                             ($core_get ($core_get record '$reference) '$floor) '$dashes)
                       (list "conditioning" ($core_get record '$conditioning) '$dots))))
    ;; What stands below goes with the diagram that is drawn last: each wipes its own half.
    (numerics-draw picture
                   (numerics-diagram groups '$seconds floors
                                     (numerics-diagram-preamble "seconds" room '()))
                   (numerics-diagram groups '$rhs floors
                                     (numerics-diagram-preamble "evaluations of the right side"
                                                                room lines)))
    record))
