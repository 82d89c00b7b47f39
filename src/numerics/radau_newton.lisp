;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The stages of a step of Radau IIA by the simplified Newton method, in the variables W = T^-1 Z
;;; where the system of three stages falls into one real and one complex system (Hairer & Wanner:
;;; Solving Ordinary Differential Equations II, section IV.8). It starts from the collocation
;;; polynomial of the last step and watches how it converges. See numerics-radau-find-stages first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/linear_solver" "numerics/linear_solver_matrix" "numerics/problem"
                "numerics/radau_coefficients" "numerics/radau_run" "numerics/sparse"))

(defparameter *numerics-radau-iterations* 7)

;;; Starting values.

(defun numerics-radau-guess-stages (run)
  (if (numerics-radau-run-first run)
      (numerics-with-radau (run z1 z2 z3 w1 w2 w3)
        (dolist (vector (list z1 z2 z3 w1 w2 w3)) (fill vector 0d0)))
      (numerics-radau-extrapolate run)))

(defmacro numerics-collocation (share p1 p2 p3 i)
  "The collocation polynomial of a step less its value at the end, SHARE of the step after that."
  `(* ,share (+ (aref ,p1 ,i)
                (* (- ,share (- c2 1d0))
                   (+ (aref ,p2 ,i) (* (- ,share (- c1 1d0)) (aref ,p3 ,i)))))))

(defun numerics-radau-extrapolate (run)
  (declare (optimize speed))
  (numerics-with-radau (run step accepted-step z1 z2 z3 w1 w2 w3 p1 p2 p3)
    (numerics-with-radau-numbers (c1 c2 i11 i12 i13 i21 i22 i23 i31 i32 i33)
      (let* ((ratio (/ step accepted-step)) (share1 (* c1 ratio)) (share2 (* c2 ratio)))
        (dotimes (i (length z1))
          (let ((a (numerics-collocation share1 p1 p2 p3 i))
                (b (numerics-collocation share2 p1 p2 p3 i))
                (c (numerics-collocation ratio p1 p2 p3 i)))
            (setf (aref z1 i) a
                  (aref z2 i) b
                  (aref z3 i) c
                  (aref w1 i) (+ (* i11 a) (* i12 b) (* i13 c))
                  (aref w2 i) (+ (* i21 a) (* i22 b) (* i23 c))
                  (aref w3 i) (+ (* i31 a) (* i32 b) (* i33 c)))))))))

;;; The two systems.

(defun numerics-radau-set-factors (run)
  "The factors for the step; true where a matrix is singular."
  (numerics-with-radau (run counts single pair step entries)
    (numerics-with-radau-numbers (single-root pair-root pair-turn)
      (setf (numerics-solver-shift single) (/ single-root step)
            (numerics-solver-shift pair) (/ pair-root step)
            (numerics-solver-shift-imaginary pair) (/ pair-turn step)))
    (incf (numerics-counts-factorisations counts) 2)
    (or (numerics-factor single entries) (numerics-factor pair entries))))

;;; One iteration.

(defun numerics-radau-stage (run share stage out)
  "X in SHARE of the step, at the beginning plus STAGE, into OUT; whether it is finite."
  (declare (double-float share) (type numerics-vector stage out) (optimize speed))
  (numerics-with-radau (run before point later moment step)
    (dotimes (i (length point)) (setf (aref point i) (+ (aref before i) (aref stage i))))
    (setf (aref later 0) (aref moment 0)
          (aref later 1) (aref moment 1))
    (numerics-advance later (* share step))
    (numerics-radau-rates run later point out)))

(defun numerics-radau-stages (run)
  (numerics-with-radau (run z1 z2 z3 r1 r2 r3)
    (numerics-with-radau-numbers (c1 c2)
      (and (numerics-radau-stage run c1 z1 r1)
           (numerics-radau-stage run c2 z2 r2)
           (numerics-radau-stage run 1d0 z3 r3)))))

(defun numerics-radau-right-sides (run)
  "T^-1 of the stages' rates, less the mass times what the eigenvalues make of w."
  (declare (optimize speed))
  (numerics-with-radau (run r1 r2 r3)
    (numerics-with-radau-numbers (i11 i12 i13 i21 i22 i23 i31 i32 i33)
      (dotimes (i (length r1))
        (let ((a (aref r1 i)) (b (aref r2 i)) (c (aref r3 i)))
          (setf (aref r1 i) (+ (* i11 a) (* i12 b) (* i13 c))
                (aref r2 i) (+ (* i21 a) (* i22 b) (* i23 c))
                (aref r3 i) (+ (* i31 a) (* i32 b) (* i33 c)))))))
  (if (numerics-radau-run-mass run)
      (numerics-radau-subtract-mass run)
      (numerics-radau-subtract-states run)))

(defmacro numerics-radau-subtract (i j factor)
  "FACTOR, the mass of row I and column J, with the eigenvalues over the step."
  `(let ((m (/ ,factor step)) (b (aref w2 ,j)) (c (aref w3 ,j)))
     (decf (aref r1 ,i) (* m single-root (aref w1 ,j)))
     (decf (aref r2 ,i) (* m (- (* pair-root b) (* pair-turn c))))
     (decf (aref r3 ,i) (* m (+ (* pair-turn b) (* pair-root c))))))

(defun numerics-radau-subtract-states (run)
  (declare (optimize speed))
  (numerics-with-radau (run step r1 r2 r3 w1 w2 w3)
    (numerics-with-radau-numbers (single-root pair-root pair-turn)
      (dotimes (i (length r1)) (numerics-radau-subtract i i 1d0)))))

(defun numerics-radau-subtract-mass (run)
  (declare (optimize speed))
  (numerics-with-radau (run step r1 r2 r3 w1 w2 w3 mass)
    (let* ((pattern (numerics-matrix-pattern mass)) (values (numerics-matrix-values mass))
           (starts (numerics-pattern-starts pattern)) (rows (numerics-pattern-rows pattern)))
      (numerics-with-radau-numbers (single-root pair-root pair-turn)
        (dotimes (j (length r1))
          (loop for k of-type numerics-index from (aref starts j) below (aref starts (1+ j))
                do (numerics-radau-subtract (aref rows k) j (aref values k))))))))

(defun numerics-radau-correct (run)
  "The changes r are added to w, and z = T w."
  (declare (optimize speed))
  (numerics-with-radau (run r1 r2 r3 w1 w2 w3 z1 z2 z3)
    (numerics-with-radau-numbers (t11 t12 t13 t21 t22 t23 t31)
      (dotimes (i (length r1))
        (let ((a (+ (aref w1 i) (aref r1 i))) (b (+ (aref w2 i) (aref r2 i)))
              (c (+ (aref w3 i) (aref r3 i))))
          (setf (aref w1 i) a
                (aref w2 i) b
                (aref w3 i) c
                (aref z1 i) (+ (* t11 a) (* t12 b) (* t13 c))
                (aref z2 i) (+ (* t21 a) (* t22 b) (* t23 c))
                (aref z3 i) (+ (* t31 a) b)))))))

(defun numerics-radau-iterate (run)
  "One iteration but for its last addition: the changes, and their size; true where all is finite."
  (when (numerics-radau-stages run)
    (numerics-radau-right-sides run)
    (numerics-with-radau (run single pair weights r1 r2 r3)
      (numerics-solve single r1)
      (numerics-solve pair r2 r3)
      (let ((change (numerics-weighted-size weights r1 r2 r3)))
        (setf (numerics-radau-run-change run) change)
        (numerics-finite-p change)))))

;;; The iteration. A small change says nothing by itself: it may be the Jacobian that is too
;;; large, and the stages what they were guessed to be. So one iteration is enough only where the
;;; same Jacobian has shown to be that of a linear problem, and changes that stay as they are, not
;;; by rounding, are refused.

(defun numerics-radau-find-stages (run)
  "Nil where the stages are found, else the factor by which the step must be shorter."
  (setf (numerics-radau-run-convergence run) 0d0
        (numerics-radau-run-remaining run)
        (let ((remaining (max (numerics-radau-run-remaining run) 1d-16)))
          (declare (type (double-float 1d-16) remaining))
          (expt remaining 0.8d0)))
  (loop for k from 1 to *numerics-radau-iterations*
        do (setf (numerics-radau-run-iterations run) k)
           (unless (numerics-radau-iterate run)
             (incf (numerics-counts-not-finite (numerics-radau-run-counts run)))
             (return 0.25d0))
           (let ((factor (and (> k 1) (numerics-radau-watch run k))))
             (when (and factor (not (numerics-radau-serves-p run))) (return factor))
             (setf (numerics-radau-run-last-change run) (numerics-radau-run-change run))
             (replace (numerics-radau-run-previous run) (numerics-radau-run-r1 run))
             (numerics-radau-correct run)
             (when (or factor (numerics-radau-converged-p run k)) (return nil)))
        finally (return (if (numerics-radau-serves-p run) nil 0.5d0))))

(defparameter *numerics-radau-trust* 8
  "Steps that one iteration may end after two have shown that the problem is as good as linear.")

(defun numerics-radau-converged-p (run k)
  (declare (type (integer 0 100) k))
  (numerics-with-radau (run change remaining newton-goal convergence)
    (cond ((> (* remaining change) newton-goal) nil)
          ((> k 1)
           (setf (numerics-radau-run-trust run)
                 (if (<= convergence 1d-8) *numerics-radau-trust* 0))
           t)
          ((plusp (numerics-radau-run-trust run)) (decf (numerics-radau-run-trust run)) t))))

(defun numerics-radau-serves-p (run)
  "Whether an iteration that rounding holds up, or that is slow, is near enough: a hundredth of the
tolerance, or three of what is expected to remain."
  (numerics-with-radau (run change remaining convergence)
    (if (< convergence 0.99d0)
        (<= (* remaining change) 0.03d0)
        (and (<= change 0.01d0)
             (or (numerics-radau-by-rounding-p run) (numerics-radau-solved-p run))))))

(defun numerics-radau-solved-p (run)
  "Whether the stages satisfy their equations to a hundredth of the tolerance, whatever the Jacobian
makes of the rest; then nothing is added to them. Without M, whose equations may be algebraic."
  (numerics-with-radau (run mass step weights r1 r2 r3)
    (when (and (null mass) (numerics-radau-stages run))
      (numerics-radau-right-sides run)
      (when (<= (* (abs step) (numerics-weighted-size weights r1 r2 r3)) 0.01d0)
        (dolist (change (list r1 r2 r3) t) (fill change 0d0))))))

(defun numerics-radau-by-rounding-p (run)
  "Whether the last two changes have no direction in common."
  (numerics-with-radau (run r1 previous weights)
    (let ((now (numerics-weighted-size weights r1)))
      (declare (double-float now))
      (dotimes (i (length r1)) (decf (aref previous i) (aref r1 i)))
      (let ((difference (numerics-weighted-size weights previous)))
        (declare (double-float difference))
        (or (= now 0d0) (> difference (* 0.5d0 now)))))))

(defun numerics-radau-watch (run k)
  "Notes how the changes shrink at iteration K; the factor for the step where they do not, or not
fast enough."
  (declare (optimize speed) (type (integer 1 100) k))
  (numerics-with-radau (run change last-change last-ratio)
    (let* ((ratio (if (= change 0d0)
                      0d0
                      (/ (abs change) (max (abs last-change) 1d-300))))
           (convergence (if (= k 2) ratio (sqrt (* ratio (abs last-ratio))))))
      (setf (numerics-radau-run-last-ratio run) ratio
            (numerics-radau-run-convergence run) convergence)
      (cond ((>= convergence 0.99d0) 0.5d0)
            (t (setf (numerics-radau-run-remaining run) (/ convergence (- 1d0 convergence)))
               (numerics-radau-too-slow run k))))))

(defun numerics-radau-too-slow (run k)
  "The factor for the step where the iterations that are left will not do."
  (declare (optimize speed) (type (integer 1 100) k))
  (numerics-with-radau (run change remaining convergence newton-goal)
    (let ((left (- (the (integer 1 100) *numerics-radau-iterations*) k))
          (last-change (/ (* remaining change) newton-goal)))
      (declare (double-float last-change))
      (loop repeat (1- left) do (setq last-change (* convergence last-change)))
      (when (and (plusp left) (>= last-change 1d0))
        (* 0.8d0 (expt (min 20d0 last-change) (/ -1d0 (+ 3 left))))))))

;;; One iteration says nothing of how they converge. But the slope at the end of the step is known
;;; soon, and what the last stage lacks there, divided by the matrix, is about the change that a
;;; second iteration would bring: beside a square root that goes to 0 the Jacobian that was kept may
;;; be so much too large that stages which are a thousand times too far seem to be found.

(defun numerics-radau-deceived-p (run)
  "Whether stages that one iteration found are not those of the slope ahead."
  (numerics-with-radau (run iterations change controls single weights r1)
    (when (= iterations 1)
      (numerics-radau-last-residual run)
      (numerics-solve single r1)
      (let ((next (numerics-weighted-size weights r1)))
        (and (> next (* 0.1d0 change))
             (> next (/ 1d-15 (numerics-controls-relative controls))))))))

(defun numerics-radau-last-residual (run)
  "X at the end of the step less M times the slope of the stages there, into r1."
  (numerics-with-radau (run ahead mass step w1 w2 w3 r1 r2)
    (numerics-with-radau-numbers (t31 single-root pair-root pair-turn)
      (dotimes (i (length r1))
        (setf (aref r2 i) (/ (+ (* t31 single-root (aref w1 i)) (* pair-root (aref w2 i))
                                (- (* pair-turn (aref w3 i))))
                             step))))
    (if mass
        (numerics-multiply (numerics-matrix-pattern mass) (numerics-matrix-values mass) r2 r1)
        (replace r1 r2))
    (map-into r1 #'- ahead r1)))
