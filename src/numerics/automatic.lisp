;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The method that chooses: explicit steps until stability binds them and no longer accuracy (the
;;; test of stiffness of E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section
;;; IV.2), then implicit ones until the motion is no longer stiff, and so on. Where there is a
;;; mass matrix all steps are implicit, where there is no Jacobian explicit.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/decimals" "numerics/dormand_prince" "numerics/problem"
                "numerics/radau"))

(defun numerics-automatic-controls (problem controls implicit step)
  "A copy of CONTROLS, with the same counts, for the next method and its first STEP."
  (let ((copy (copy-numerics-controls controls)))
    (setf (numerics-controls-looks-for copy) (cond ((or (numerics-problem-mass problem)
                                                       (null (numerics-problem-jacobian problem)))
                                                   nil)
                                                   (implicit :end-of-stiffness)
                                                   (t :stiffness))
          (numerics-controls-first-step copy) step)
    copy))

(defun numerics-changes-text (times)
  "What is said of changes between the methods at TIMES."
  (format nil "explicit steps~{, ~a ones from t = ~a~}~[~:;; ~:*~d changes in all~]"
          (loop for time in times
                for implicit = t then (not implicit)
                repeat 4
                append (list (if implicit "implicit" "explicit")
                             (numerics-short-number time)))
          (if (> (length times) 4) (length times) 0)))

(defun numerics-automatic (problem controls moment state observer)
  "Integrates PROBLEM by the method that suits it at the time; the outcome of the last one, with a
sentence ABOUT where methods changed."
  (let ((implicit (and (numerics-problem-mass problem) t)) (times '())
        (step (numerics-controls-first-step controls)))
    (loop
      (let ((outcome (funcall (if implicit #'numerics-radau #'numerics-dopri) problem
                              (numerics-automatic-controls problem controls implicit step)
                              moment state observer)))
        (unless (member (numerics-outcome-status outcome) '(:stiff :not-stiff))
          (when times
            (setf (numerics-outcome-about outcome)
                  (format nil "~@[~a; ~]~a" (numerics-outcome-about outcome)
                          (numerics-changes-text (reverse times)))))
          (return outcome))
        (setq moment (numerics-outcome-moment outcome)
              state (numerics-outcome-state outcome)
              step (abs (numerics-outcome-step outcome))
              implicit (not implicit))
        (push (aref moment 0) times)))))
