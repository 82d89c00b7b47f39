;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Bode's and Nyquist's plots of a transfer function (H. W. Bode, Network analysis and feedback
;;; amplifier design, 1945; H. Nyquist, Regeneration theory, 1932).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/frequency" "numerics/pictures" "numerics/time_plot"))

(defun numerics-line-items (places colour)
  (list (numerics-option '$points_joined t) (numerics-option '$point_size 0)
        (numerics-option '$line_width 1.5d0) (numerics-option '$color colour)
        (numerics-points places)))

(defun numerics-frequency-record (curve names columns)
  "[function = .., rows = [[w, ..], ..], columns = [..]]"
  (list '(mlist simp)
        (list '(mequal simp) '$function (numerics-frequency-curve-function curve))
        (list '(mequal simp) '$columns (cons '(mlist simp) names))
        (list '(mequal simp) '$rows
              (cons '(mlist simp)
                    (loop for point in (numerics-frequency-curve-points curve)
                          collect (cons '(mlist simp)
                                        (mapcar (lambda (k) (nth k point)) columns)))))))

(defun numerics-bode-scene (curve label column colour)
  (let ((places (loop for point in (numerics-frequency-curve-points curve)
                      collect (list (first point) (nth column point)))))
    (append (list (numerics-preamble "w" label "unset key" "set grid"
                                     "set format x '10^{%L}'")
                  (numerics-option '$logx t))
            (numerics-value-range places)
            (numerics-line-items places colour))))

(defun numerics-need-points (curve)
  (unless (numerics-frequency-curve-points curve)
    (core-error "the transfer function is 0 or has no value: there is nothing to draw")))

(defun $numerics_bode_plot (picture curve)
  "Gain and phase side by side; the record of what is drawn."
  (numerics-need-points curve)
  (numerics-draw picture
                 (numerics-bode-scene curve "gain, dB" 3 (first *numerics-colours*))
                 (numerics-bode-scene curve "phase, degrees" 4 (second *numerics-colours*)))
  (numerics-frequency-record curve '($w $decibel $degrees) '(0 3 4)))

(defun numerics-nyquist-range (places)
  "The options of draw that show all of PLACES with a margin."
  (let ((turned (numerics-value-range (mapcar #'reverse places))))
    (append (numerics-value-range places)
            (loop for option in turned collect (numerics-option '$xrange (third option))))))

(defun $numerics_nyquist_plot (picture curve)
  "The curve for w > 0, its mirror image for w < 0 thinner, and the point -1."
  (numerics-need-points curve)
  (let* ((places (loop for (nil re im) in (numerics-frequency-curve-points curve)
                       collect (list re im)))
         (mirrored (loop for (re im) in places collect (list re (- im)))))
    (numerics-draw picture
                   (append (list (numerics-preamble "Re" "Im" "unset key" "set grid"
                                                    "set size ratio -1"))
                           (numerics-nyquist-range (cons '(-1d0 0d0) (append places mirrored)))
                           (numerics-line-items places (first *numerics-colours*))
                           (list (numerics-option '$line_width 0.7d0)
                                 (numerics-points mirrored)
                                 (numerics-option '$points_joined nil)
                                 (numerics-option '$point_size 1.5d0)
                                 (numerics-option '$point_type '$plus)
                                 (numerics-option '$color (second *numerics-colours*))
                                 (numerics-points (list (list -1 0)))))))
  (numerics-frequency-record curve '($w $re $im) '(0 1 2)))
