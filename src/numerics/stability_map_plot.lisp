;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The picture of a map of stability: cells in the colour of their verdicts, boundaries, and a mark
;;; in each region where its verdict was found. Look first at $numerics_stability_map.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/pictures"))

(defun $numerics_stability_map (picture record strips)
  "Draws STRIPS, (axes cells boundaries marks); the RECORD of the map."
  (destructuring-bind (axes cells boundaries marks) (mapcar #'cdr (cdr strips))
    (numerics-draw picture
                   (cons (apply #'numerics-preamble
                                (loop for (nil name) in axes collect (numerics-state-text name)))
                         (append (loop for (nil nil low high) in axes
                                       for range in '($xrange $yrange)
                                       collect (numerics-option
                                                range (list '(mlist simp) low high)))
                                 (numerics-cell-items cells)
                                 (numerics-boundary-items boundaries)
                                 (numerics-verdict-items marks)))))
  record)

(defparameter *numerics-grounds*
  '(("asymptotically stable" "#b7dfc1") ("stable" "#c9c5e8") ("unstable" "#f4cfc4")
    ("not decided" "#dddddd"))
  "Each row: a verdict and the colour of its cells.")

(defun numerics-cell-items (cells)
  (append (list (numerics-option '$border nil) (numerics-option '$key ""))
          (loop for (verdict colour) in *numerics-grounds*
                for strips = (loop for (nil said strip) in cells
                                   when (and (string= said verdict) (cddr strip))
                                     collect (cdr strip))
                when strips
                  append (cons (numerics-option '$fill_color colour)
                               (mapcar #'numerics-strip strips)))))

(defun numerics-strip (rows)
  "A polygon about ((mlist) x low high) .."
  (let ((below (loop for (nil x low) in rows collect (list '(mlist simp) x low)))
        (above (loop for (nil x nil high) in rows collect (list '(mlist simp) x high))))
    (list '($polygon simp) (cons '(mlist simp) (append below (reverse above))))))

(defun numerics-boundary-items (boundaries)
  (append (list (numerics-option '$points_joined t) (numerics-option '$point_size 0)
                (numerics-option '$color "#222222") (numerics-option '$line_width 1.8d0))
          (loop for line in boundaries
                collect (numerics-points (mapcar #'cdr (cdr line))))
          (list (numerics-option '$points_joined nil))))

(defun numerics-verdict-items (marks)
  (loop for (verdict sign colour) in *numerics-marks*
        for places = (loop for (nil said place) in marks
                           when (string= said verdict) collect (cdr place))
        when places
          append (list (numerics-option '$point_type sign) (numerics-option '$point_size 1.6d0)
                       (numerics-option '$color colour) (numerics-option '$key verdict)
                       (numerics-points places))))
