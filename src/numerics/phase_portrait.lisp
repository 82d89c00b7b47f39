;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; PhasePortrait: equilibria with their verdicts, separatrices and trajectories in a plane of two
;;; states, drawn, and a record of what was drawn. Look first at $numerics_phase_portrait.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "algebra/program_record" "numerics/native"
                "numerics/pictures" "numerics/plane" "numerics/plane_axes"
                "numerics/rests_in_window" "numerics/run"
                "numerics/trajectories"))

(defstruct numerics-portrait plane rests separatrices trajectories)

(defun $numerics_portrait (plane said)
  "What is drawn of PLANE; SAID are the equilibria, or why there are none."
  (let ((portrait (numerics-with-masked-traps (numerics-portrait-of plane said))))
    (unless (or (numerics-portrait-separatrices portrait) (numerics-portrait-trajectories portrait))
      (core-error "nothing moves in this window: the rates of ~{~a~^, ~} vanish there or have no ~
                   value"
                  (loop for axis in (numerics-plane-axes plane)
                        collect (numerics-name-text (numerics-axis-name axis)))))
    portrait))

(defun numerics-portrait-of (plane said)
  (let* ((rests (numerics-rests-in-window plane said)) (found (numerics-rests-found rests))
         (separatrices (numerics-separatrices plane found)))
    (numerics-say-section plane rests)
    (make-numerics-portrait
     :plane plane :rests rests :separatrices separatrices
     :trajectories (numerics-fill-window plane separatrices
                                         (mapcar #'numerics-rest-place found)))))

(defun numerics-say-section (plane rests)
  (loop for (name . value) in (numerics-plane-held plane)
        do (numerics-say-about rests "~a is held at ~a~:[~;, from where it would move~]"
                               (numerics-state-text name) (core-words (list value))
                               (member name (numerics-plane-moving plane) :test #'alike1))))

;;; The drawing

(defun numerics-in-window (plane places)
  (let ((axes (numerics-plane-axes plane)))
    (loop for place in places collect (mapcar #'numerics-at-place axes place))))

(defun numerics-curve-items (plane curves colour width key)
  "Options and objects of CURVES; the first of them has the KEY."
  (append (list (numerics-option '$points_joined t) (numerics-option '$point_size 0)
                (numerics-option '$color colour) (numerics-option '$line_width width)
                (numerics-option '$key key))
          (loop for curve in curves
                for first = t then nil
                append (append (unless first (list (numerics-option '$key "")))
                               (list (numerics-points (numerics-in-window
                                                       plane (numerics-curve-points curve))))))
          (list (numerics-option '$key ""))))

(defparameter *numerics-arrow* 0.018d0 "The length of an arrow in windows.")

(defun numerics-arrow-items (plane curves)
  "Arrows of the last colour."
  (let ((width (numerics-axis-width (first (numerics-plane-axes plane)))))
    (append (list (numerics-option '$head_length (* *numerics-arrow* width))
                  (numerics-option '$head_angle 20) (numerics-option '$head_type '$filled))
            (loop for curve in curves
                  append (loop for arrow in (numerics-curve-arrows curve)
                               collect (numerics-arrow-item plane arrow))))))

(defun numerics-arrow-item (plane arrow)
  (destructuring-bind (u v du dv) arrow
    (destructuring-bind ((a b) (c d))
        (numerics-in-window plane (loop for share in '(-0.5d0 0.5d0)
                                        collect (list (+ u (* share *numerics-arrow* du))
                                                      (+ v (* share *numerics-arrow* dv)))))
      (list '($vector simp) (list '(mlist simp) a b) (list '(mlist simp) (- c a) (- d b))))))

(defun numerics-mark-items (plane rests)
  "Equilibria, each verdict in one object; a white ground keeps curves out of open signs."
  (cons (numerics-option '$points_joined nil)
        (loop for (verdict sign colour) in *numerics-marks*
              for places = (loop for rest in rests
                                 when (string= (numerics-rest-verdict rest) verdict)
                                   collect (numerics-rest-place rest))
              for points = (and places (numerics-points (numerics-in-window plane places)))
              when points
                append (list (numerics-option '$point_type '$filled_circle)
                             (numerics-option '$point_size 1.9d0)
                             (numerics-option '$color "#ffffff") (numerics-option '$key "") points
                             (numerics-option '$point_type sign)
                             (numerics-option '$point_size 1.6d0)
                             (numerics-option '$color colour) (numerics-option '$key verdict)
                             points))))

(defun numerics-portrait-items (portrait)
  (let ((plane (numerics-portrait-plane portrait)))
    (append (loop for axis in (numerics-plane-axes plane)
                  for range in '($xrange $yrange)
                  collect (numerics-option range
                                           (list '(mlist simp) (numerics-at-place axis 0d0)
                                                 (numerics-at-place axis 1d0))))
            (numerics-curve-items plane (numerics-portrait-trajectories portrait) "#6699cc" 1.2d0
                                  "trajectories")
            (numerics-arrow-items plane (numerics-portrait-trajectories portrait))
            (numerics-curve-items plane (numerics-portrait-separatrices portrait) "#222222" 1.8d0
                                  "separatrices")
            (numerics-arrow-items plane (numerics-portrait-separatrices portrait))
            (numerics-mark-items plane (numerics-rests-found
                                        (numerics-portrait-rests portrait))))))

(defun numerics-portrait-preamble (portrait)
  (destructuring-bind (horizontal vertical)
      (mapcar (lambda (axis) (numerics-state-text (numerics-axis-name axis)))
              (numerics-plane-axes (numerics-portrait-plane portrait)))
    (let ((about (numerics-rests-about (numerics-portrait-rests portrait))))
      (apply #'numerics-preamble horizontal vertical
             (append (loop for axis in (numerics-plane-axes (numerics-portrait-plane portrait))
                           for name in '("x" "y")
                           append (numerics-small-range-lines name (numerics-at-place axis 0d0)
                                                              (numerics-at-place axis 1d0)))
                     (when about
                       (list (numerics-title-line (numerics-title-items (reverse about))))))))))

(defun numerics-title-items (sentences)
  "SENTENCES with signs between them, without the reasons that follow a colon."
  (loop for (text . more) on sentences
        collect (format nil "~a~:[~;;~]" (subseq text 0 (search ": " text)) more)))

;;; For Maxima

(defun numerics-rest-record (plane rest)
  "[[x = .., y = ..], verdict]"
  (list '(mlist simp)
        (cons '(mlist simp)
              (loop for axis in (numerics-plane-axes plane)
                    for value in (numerics-rest-values rest)
                    collect (list '(mequal simp) (numerics-axis-name axis) value)))
        (numerics-rest-verdict rest)))

(defun $numerics_phase_portrait (picture portrait)
  "Draws PORTRAIT; the record of what was drawn."
  (let ((plane (numerics-portrait-plane portrait)) (rests (numerics-portrait-rests portrait)))
    (algebra-list
     (algebra-field '$equilibria
                    (cons '(mlist simp) (mapcar (lambda (rest) (numerics-rest-record plane rest))
                                                  (numerics-rests-found rests))))
     (algebra-field '$separatrices (length (numerics-portrait-separatrices portrait)))
     (algebra-field '$trajectories (length (numerics-portrait-trajectories portrait)))
     (algebra-field '$about (cons '(mlist simp) (reverse (numerics-rests-about rests))))
     (algebra-field '$file (numerics-draw picture (cons (numerics-portrait-preamble portrait)
                                                (numerics-portrait-items portrait)))))))
