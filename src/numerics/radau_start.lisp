;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; How a run of Radau IIA begins. With a singular mass matrix M of index 1 the combinations n of
;;; equations with n M = 0 are algebraic, n X(t, x) = 0, and fix x in the directions r with M r =
;;; 0: Newton's method for x + sum c_k r_k has the matrix (n_i J r_k). A start that satisfies them
;;; within the tolerance is consistent; another is mended by this iteration where the controls ask
;;; for it, else it ends the run.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/step_control" "numerics/sparse"
                "numerics/linear_solver" "numerics/linear_solver_matrix" "numerics/radau_run"
                "numerics/radau_stiffness"))

(defun numerics-radau-begin (run)
  "The status in which RUN ends before its first step, or nil."
  (numerics-radau-watch-stiffness run)
  (or (numerics-radau-first-slope run)
      (and (numerics-radau-run-mass run) (numerics-radau-check-start run))
      (numerics-radau-choose-first-step run)))

(defun numerics-radau-first-slope (run)
  (numerics-with-radau (run moment before slope)
    (if (numerics-radau-rates run moment before slope) nil :not-finite)))

;;; A consistent start.

(defun numerics-combined (combination vector)
  (declare (type numerics-vector vector))
  (loop for (index . weight) in combination sum (* weight (aref vector index))))

(defun numerics-spread (directions factors out)
  "The combination of DIRECTIONS, lists of (index . weight), with FACTORS into OUT."
  (declare (type numerics-vector factors out))
  (fill out 0d0)
  (loop for direction in directions
        for k from 0
        do (loop for (index . weight) in direction
                 do (incf (aref out index) (* (aref factors k) weight))))
  out)

(defstruct numerics-algebraic
  equations directions   ; the combinations n and r
  residuals              ; n X
  changes                ; of the state, by one step of the iteration
  solver)

(defun numerics-radau-check-start (run)
  (let ((equations (numerics-null-vectors (numerics-radau-run-mass run) nil)))
    (when equations
      (let ((part (make-numerics-algebraic
                   :equations equations
                   :directions (numerics-null-vectors (numerics-radau-run-mass run) t)
                   :changes (numerics-zeros (length (numerics-radau-run-before run)))
                   :solver (numerics-make-solver (length equations) nil nil :kind :dense))))
        (or (numerics-radau-algebraic-changes run part)
            (cond ((<= (numerics-radau-size-of-changes run part) 1d0) nil)
                  ((numerics-controls-mends-start (numerics-radau-run-controls run))
                   (numerics-radau-mend-start run part))
                  (t (numerics-radau-say-inconsistent run part))))))))

(defun numerics-radau-algebraic-changes (run part)
  "One step of Newton's method for the algebraic equations, as changes of the state; a status where
they do not fix it."
  (numerics-with-radau (run problem counts moment before slope entries)
    (let* ((equations (numerics-algebraic-equations part))
           (solver (numerics-algebraic-solver part)) (m (length equations))
           (right (map-into (numerics-zeros m) (lambda (n) (numerics-combined n slope))
                            equations)))
      (incf (numerics-counts-jacobians counts))
      (funcall (numerics-problem-jacobian problem) moment before entries)
      (setf (numerics-algebraic-residuals part) (copy-seq right)
            (numerics-solver-shift solver) 0d0)
      (cond ((not (numerics-finite-vector-p entries)) :not-finite)
            ((numerics-factor solver (numerics-radau-algebraic-matrix run part))
             (numerics-radau-say-index run part))
            (t (numerics-solve solver right)
               (numerics-spread (numerics-algebraic-directions part) right
                                (numerics-algebraic-changes part))
               nil)))))

(defun numerics-radau-algebraic-matrix (run part)
  "The entries n_i J r_k, by columns."
  (numerics-with-radau (run pattern entries r1 r2)
    (let* ((equations (numerics-algebraic-equations part)) (m (length equations))
           (matrix (numerics-zeros (* m m))) (unit (numerics-zeros 1)) (place -1))
      (setf (aref unit 0) 1d0)
      (dolist (direction (numerics-algebraic-directions part) matrix)
        (numerics-spread (list direction) unit r1)
        (numerics-multiply pattern entries r1 r2)
        (dolist (equation equations)
          (setf (aref matrix (incf place)) (numerics-combined equation r2)))))))

(defun numerics-radau-size-of-changes (run part)
  "As shares of the tolerance, the largest."
  (numerics-radau-weigh run nil)
  (let ((weights (numerics-radau-run-weights run)) (changes (numerics-algebraic-changes part)))
    (declare (type numerics-vector weights changes))
    (numerics-weighted-size weights changes)))

(defun numerics-radau-mend-start (run part)
  (numerics-with-radau (run before newton-goal)
    (loop repeat 30
          do (let ((change (numerics-radau-size-of-changes run part)))
               (map-into before #'+ before (numerics-algebraic-changes part))
               (let ((status (or (numerics-radau-first-slope run)
                                 (numerics-radau-algebraic-changes run part))))
                 (when status (return status)))
               (when (<= change newton-goal) (return nil)))
          finally (return (numerics-radau-say-inconsistent run part)))))

;;; What is said.

(defun numerics-state-name (problem i)
  (let ((name (nth i (numerics-problem-names problem))))
    (if name (core-words (list name)) (format nil "x~d" (1+ i)))))

(defun numerics-number-text (x)
  (string-trim " " (format nil "~,6g" x)))

(defun numerics-largest-index (vector)
  (let ((largest 0))
    (dotimes (i (length vector) largest)
      (when (> (abs (aref vector i)) (abs (aref vector largest))) (setq largest i)))))

(defun numerics-equation-number (combination)
  "The number, from 1, of the equation that weighs most in COMBINATION."
  (1+ (car (numerics-largest-entry combination))))

(defun numerics-radau-say-inconsistent (run part)
  (numerics-with-radau (run before problem)
    (let* ((worst (numerics-largest-index (numerics-algebraic-residuals part)))
           (changes (numerics-algebraic-changes part)) (i (numerics-largest-index changes)))
      (setf (numerics-radau-run-about run)
            (format nil "the start does not satisfy the algebraic equation ~d, whose residual is ~
                         ~a; ~a = ~a would have to be near ~a"
                    (numerics-equation-number (nth worst (numerics-algebraic-equations part)))
                    (numerics-number-text (aref (numerics-algebraic-residuals part) worst))
                    (numerics-state-name problem i) (numerics-number-text (aref before i))
                    (numerics-number-text (+ (aref before i) (aref changes i)))))
      :inconsistent)))

(defun numerics-radau-say-index (run part)
  (let ((solver (numerics-algebraic-solver part)))
    (setf (numerics-radau-run-about run)
          (format nil "the algebraic equations do not determine ~a at the start (equation ~d is ~
                       none for it): the index of the system is higher than 1"
                  (numerics-state-name
                   (numerics-radau-run-problem run)
                   (car (numerics-largest-entry
                         (nth (numerics-solver-singular-column solver)
                              (numerics-algebraic-directions part)))))
                  (numerics-equation-number (nth (numerics-solver-singular-row solver)
                                                 (numerics-algebraic-equations part)))))
    :singular))

(defun numerics-singular-sentence (solver problem)
  "What a person reads of the singular matrix of SOLVER."
  (let ((row (numerics-solver-singular-row solver)))
    (format nil "the matrix of the implicit method is singular: ~:[~*~;equation ~d and ~]the ~
                 others do not determine ~a"
            row (and row (1+ row))
            (numerics-state-name problem (numerics-solver-singular-column solver)))))

;;; The first step, and a trial far shorter.

(defun numerics-radau-choose-first-step (run)
  (numerics-with-radau (run problem controls moment before slope mass)
    (let* ((left (numerics-time-left controls moment)) (trial (* 1d-9 left))
           (given (numerics-controls-first-step controls)))
      (unless (= left 0d0)
        (let ((factored (numerics-radau-factor-trial run trial)))
          (setf (numerics-radau-run-step run)
                (numerics-radau-limit
                 run
                 (cond (given (float-sign left (abs given)))
                       ((and mass factored) (numerics-radau-first-step-with-mass run trial))
                       (mass trial)
                       (t (numerics-first-step problem controls moment before slope 4)))))))
      nil)))

(defun numerics-radau-factor-trial (run trial)
  "The factors of the real system for the step TRIAL and the sign of their determinant; true where
there are such."
  (numerics-with-radau (run problem counts moment before entries single)
    (incf (numerics-counts-jacobians counts))
    (incf (numerics-counts-factorisations counts))
    (funcall (numerics-problem-jacobian problem) moment before entries)
    (setf (numerics-solver-shift single) (/ trial))
    (when (and (numerics-finite-vector-p entries) (not (numerics-factor single entries)))
      (setf (numerics-radau-run-orientation run) (numerics-orientation single))
      t)))

(defun numerics-radau-first-step-with-mass (run trial)
  "In which the state moves by a hundredth or a scale's thousandth, by the slope that one step
TRIAL of the linearly implicit Euler method shows; shorter for small tolerances."
  (numerics-with-radau (run controls moment before slope scales single r1)
    (let ((left (numerics-time-left controls moment)))
      (replace r1 slope)
      (numerics-solve single r1)
      (* (signum left)
         (min 1d0 (expt (* 1d6 (numerics-controls-relative controls)) 0.25d0))
         (numerics-trial-step (numerics-scaled-size before before scales)
                              (/ (numerics-scaled-size r1 before scales) (abs trial))
                              (abs left))))))
