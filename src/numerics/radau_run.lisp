;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a run of Radau IIA holds between its steps, and what every part of it does with vectors.
;;; All vectors are made once; a step changes them in place.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/step_control" "numerics/linear_solver_matrix"
                "numerics/linear_solver"))

(defmacro numerics-define-radau-run (vectors numbers &rest fields)
  "The structure, its VECTORS of the length of the state, NUMBERS, and other FIELDS."
  `(defstruct numerics-radau-run
     ,@fields
     ,@(loop for number in numbers collect `(,number 0d0 :type double-float))
     ,@(loop for vector in vectors
             collect `(,vector (numerics-zeros 0) :type (simple-array double-float (*))))))

(numerics-define-radau-run
 (before after         ; the states at both ends of the step
  slope ahead          ; X there
  scales weights       ; s_i; what makes of an error its share of the tolerance
  z1 z2 z3             ; stages less the state at the beginning
  w1 w2 w3             ; T^-1 of these
  r1 r2 r3             ; right sides, then changes of w1, w2, w3
  previous             ; r1 of the iteration before
  p1 p2 p3             ; coefficients of the collocation polynomial of the last accepted step
  point error)
 (step                 ; the step that is tried
  next-step            ; the one after it
  factored-step        ; the step that the factors belong to, 0 for none
  accepted-step        ; the last accepted step
  accepted-error       ; and its error, at least 0.01
  largest-error        ; share of the tolerance that the error of the step tried takes
  change               ; share of it that the last Newton change takes
  last-change last-ratio ; the one before, and the ratio of those two
  convergence          ; ratio of the changes of the last iterations
  remaining            ; convergence/(1 - convergence)
  newton-goal          ; where the iteration ends
  resumed              ; the step before a jump made it shorter, or 0
  radius)              ; estimate of the spectral radius of the Jacobian
 problem controls counts
 (moment (numerics-zeros 2) :type (simple-array double-float (*)))
 (seen (make-numerics-step))     ; the step as the observer sees it
 (later (numerics-zeros 2) :type (simple-array double-float (*))) ; the moment of a stage
 pattern               ; of the Jacobian, and its entries
 (entries (numerics-zeros 0) :type (simple-array double-float (*)))
 single pair           ; the solvers of the real and of the complex system
 mass                  ; nil for the identity
 (jacobian :none)      ; :none, :old or :fresh: of the state at the beginning
 (first t)             ; no step was accepted so far
 (rejected nil)        ; the last step tried was rejected
 (last nil)            ; the step tried ends at the end of the controls
 (before-jump nil)     ; it leads to a jump
 (iterations 0 :type fixnum)
 (trust 0 :type fixnum)          ; steps that may end after one iteration
 (failure nil)         ; :not-finite or :no-convergence where the last step tried had no stages
 (orientation nil)     ; the sign of the determinant of the real system for short steps, if known
 (singular 0 :type fixnum)       ; how often in turn the matrices were singular
 (calm 0 :type fixnum)           ; steps in turn with step*radius < 1
 pace
 direction             ; of the power iterations for the radius, nil where it is not asked for
 about)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun numerics-radau-reader (field)
    (intern (format nil "NUMERICS-RADAU-RUN-~a" field) :maxima)))

(defmacro numerics-with-radau ((run &rest fields) &body body)
  "BODY with the values of FIELDS of RUN under their names."
  `(let ,(loop for field in fields
               collect `(,field (,(numerics-radau-reader field) ,run)))
     ,@body))

(defun numerics-new-radau (problem controls moment state)
  (let* ((n (numerics-problem-size problem)) (mass (numerics-problem-mass problem))
         (pattern (or (numerics-problem-pattern problem) (numerics-full-pattern n)))
         (run (make-numerics-radau-run
               :problem problem :controls controls :counts (numerics-controls-counts controls)
               :pace (make-numerics-pace :moment (copy-seq moment))
               :moment (copy-seq moment) :mass mass :before (copy-seq state)
               :after (copy-seq state) :scales (numerics-full-scales controls n)
               :pattern pattern
               :entries (numerics-zeros (length (numerics-pattern-rows pattern)))
               :single (numerics-make-solver n pattern mass)
               :pair (numerics-make-solver n pattern mass :complex t)
               :newton-goal (numerics-newton-goal (numerics-controls-relative controls)))))
    (macrolet ((make (&rest names)
                 `(setf ,@(loop for name in names
                                append `((,(numerics-radau-reader name) run)
                                         (numerics-zeros n))))))
      (setf (numerics-radau-run-about run)
            (numerics-solver-remark (numerics-radau-run-single run)))
      (make slope ahead weights z1 z2 z3 w1 w2 w3 r1 r2 r3 previous p1 p2 p3 point error))
    run))

(declaim (inline numerics-radau-limit))
(defun numerics-radau-limit (run step)
  "STEP, or the largest that is allowed."
  (declare (double-float step))
  (let ((largest (numerics-controls-largest-step (numerics-radau-run-controls run))))
    (if (and largest (> (abs step) (the double-float largest)))
        (float-sign step (the double-float largest))
        step)))

(defun numerics-newton-goal (relative)
  "A change that takes this share of the tolerance ends the iteration. It is less than in radau5.f:
what is left of it has the same sign for many steps, and adds up in what changes slowly."
  (max (/ 2.2d-17 relative) (min 0.03d0 (expt relative 0.6d0))))

(defun numerics-release-radau (run)
  (numerics-release-solver (numerics-radau-run-single run))
  (numerics-release-solver (numerics-radau-run-pair run)))

;;; Sums, rates, norms.

(defun numerics-add (x y out)
  (declare (type numerics-vector x y out) (optimize speed))
  (dotimes (i (length out)) (setf (aref out i) (+ (aref x i) (aref y i)))))

(defun numerics-radau-rates (run moment point out)
  "X at MOMENT and POINT into OUT; whether it is finite."
  (incf (numerics-counts-rates (numerics-radau-run-counts run)))
  (funcall (the function (numerics-problem-rates (numerics-radau-run-problem run)))
           moment point out)
  (numerics-finite-vector-p out))

(defun numerics-radau-weigh (run with-after)
  "The weights for the state at the beginning, or the larger of both ends."
  (declare (optimize speed))
  (numerics-with-radau (run before after scales weights controls)
    (let ((relative (numerics-controls-relative controls)))
      (dotimes (i (length weights))
        (let* ((x (aref before i)) (y (if with-after (aref after i) x)))
          (setf (aref weights i) (/ (* relative (numerics-scale x y (aref scales i))))))))))

(defmacro numerics-weighted-size (weights &rest vectors)
  "The largest of the numbers in VECTORS, weighted; not finite where one of them is not."
  `(let ((largest 0d0) (nothing 0d0))
     (declare (double-float largest nothing))
     (dotimes (i (length ,weights) (+ largest nothing))
       (let ((weight (aref ,weights i)))
         ,@(loop for vector in vectors
                 collect `(let ((part (* weight (abs (aref ,vector i)))))
                            (incf nothing (* 0d0 part))
                            (when (> part largest) (setq largest part))))))))
