;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; First integrals of a motion, on its program, for a run that tells how well it keeps them: the
;;; energy sum v_i dL/dv_i - L, Jacobi's integral where the frame moves, with the power that it
;;; loses otherwise, and the momentum of each coordinate on which nothing depends (E. T. Whittaker,
;;; Analytical dynamics, sections 38, 41). With the left sides e_i of Lagrange's equations the rate
;;; of such a V is sum y_i e_i less that power, y the velocities or a unit vector: by that it is
;;; judged at a random point. See forms-motion-integrals first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "algebra/program_exchange"
                "algebra/program_from_expressions" "algebra/program_nodes" "forms/agreement"
                "forms/dynamics" "forms/equations_as_program" "forms/fixed" "forms/judge"
                "forms/momenta_judge" "forms/program_judge" "forms/rates" "forms/value"))

(defstruct forms-conserved
  name value size (power 0) ; see forms-first-integral; without the power of constraints that move
  weights)                  ; y

(defun forms-motion-integrals (dynamics names)
  "Those of DYNAMICS, in coordinates and velocities; NAMES are those of the momenta."
  (let ((terms (funcall (forms-dynamics-terms dynamics))))
    (append (forms-energy-integrals dynamics terms)
            (loop for name in names
                  for stays in (forms-staying-momenta dynamics terms)
                  for place from 0
                  when stays collect (forms-momentum-integral name dynamics terms place)))))

(defun forms-at-rest (elements dynamics)
  "ELEMENTS without velocities, or nil where these have no value then."
  (catch 'forms-no-integral
    (algebra-exchanged elements
                       (algebra-exchange-by
                        (loop for v in (forms-task-v (forms-dynamics-task dynamics))
                              collect (cons v 0)))
                       (lambda (denominator)
                         (declare (ignore denominator))
                         (throw 'forms-no-integral nil)))))

(defun forms-size-of (elements)
  "The sum of the sizes of ELEMENTS."
  (algebra-program-sum
   (mapcar (lambda (e) (if (numberp e) (abs e) (algebra-program-function :absolute e))) elements)))

;;; The energy is T2 - A0, L = T2 + T1 + A0 of these degrees in the velocities: its parts are as
;;; large as T2 + |A0|.

(defun forms-energy-integrals (dynamics terms)
  (let* ((function (forms-program-terms-function terms))
         (velocities (forms-program-terms-velocities terms))
         (rest (first (forms-at-rest (list function) dynamics))))
    (when rest
      (let ((energy (algebra-program-subtract
                     (first (algebra-program-rates (list function)
                                                   (mapcar #'cons velocities velocities)))
                     function)))
        (list (make-forms-conserved
               :name '$energy :value energy :weights velocities
               :size (forms-size-of (list (algebra-program-add energy rest) rest))
               :power (forms-lost-power function velocities
                                        (mapcar #'algebra-program-subtract
                                                (forms-program-terms-forces terms)
                                                (forms-program-terms-damping terms)))))))))

(defun forms-lost-power (function velocities forces)
  "dL/dt - v.Q; the same of -H."
  (algebra-program-subtract
   (first (algebra-program-rates (list function) (list (cons (algebra-program-input '$t) 1))))
   (forms-program-product velocities forces)))

(defun forms-power-of-constraints (dynamics multipliers)
  "What constraints lose that move by themselves: sum lambda_j a_j0."
  (forms-program-product multipliers
                         (forms-at-rest (mapcar #'forms-bond-rate (forms-dynamics-bonds dynamics))
                                        dynamics)))

;;; Momenta

(defun forms-staying-momenta (dynamics terms)
  "For each momentum whether it is constant, and not 0, at a random point."
  (let* ((point (forms-trial-point (forms-momentum-trial dynamics)))
         (momenta (forms-program-terms-momenta terms))
         (columns (list* (forms-program-terms-slopes terms)
                         (mapcar #'algebra-program-subtract (forms-program-terms-forces terms)
                                 (forms-program-terms-damping terms))
                         (mapcar #'forms-bond-row (forms-dynamics-bonds dynamics))))
         (found (forms-program-values-on-all-sides (apply #'append momenta columns) point)))
    (loop with n = (length momenta)
          for k below n
          collect (and found
                       (not (forms-negligible-p (nth k found)))
                       (loop for place from (+ n k) below (length found) by n
                             always (forms-negligible-p (nth place found)))))))

(defun forms-momentum-integral (name dynamics terms place)
  "p = sum M_j v_j + a, whose parts are as large as these."
  (let* ((momentum (nth place (forms-program-terms-momenta terms)))
         (velocities (forms-program-terms-velocities terms))
         (rest (forms-at-rest (list momentum) dynamics)))
    (make-forms-conserved
     :name name :value momentum
     :size (forms-size-of
            (append rest (mapcar #'algebra-program-multiply
                                 (algebra-program-gradient momentum velocities) velocities)))
     :weights (forms-unit-weights place (length velocities)))))

(defun forms-unit-weights (place n) (loop for k below n collect (if (= k place) 1 0)))

;;; In other variables

(defun forms-put-in-integrals (integrals pairs)
  (loop for integral in integrals
        collect (destructuring-bind (value size power . weights)
                    (forms-put (list* (forms-conserved-value integral)
                                      (forms-conserved-size integral)
                                      (forms-conserved-power integral)
                                      (forms-conserved-weights integral))
                               pairs)
                  (make-forms-conserved :name (forms-conserved-name integral) :value value
                                       :size size :power power :weights weights))))

(defun forms-integrals-in-momenta (dynamics names velocities)
  "Those of coordinates and momenta, where the VELOCITIES are elements; a momentum is a variable."
  (let ((integrals (forms-put-in-integrals
                    (forms-motion-integrals dynamics names)
                    (mapcar #'cons (forms-task-v (forms-dynamics-task dynamics)) velocities))))
    (dolist (integral integrals integrals)
      (when (member (forms-conserved-name integral) names)
        (setf (forms-conserved-value integral)
              (algebra-program-input (forms-conserved-name integral)))))))

(defun forms-integrals-of-hamiltonian (function slopes forces names motion)
  "Those of H(q, p), a FUNCTION with SLOPES dH/dq: itself, and momenta."
  (let ((velocities (forms-canonical-motion-velocities motion))
        (rest (first (forms-put (list function) (loop for p in names collect (cons p 0))))))
    (cons (make-forms-conserved
           :name '$energy :value function :weights velocities
           :size (forms-size-of (list (algebra-program-subtract function rest) rest))
           :power (forms-lost-power (algebra-program-negate function) velocities forces))
          (loop for name in names
                for place from 0
                when (forms-nought-p (list* (nth place slopes) (nth place forces)
                                            (loop for bond in (forms-canonical-motion-bonds motion)
                                                  collect (nth place (forms-bond-row bond))))
                                     (forms-new-point t))
                  collect (make-forms-conserved
                           :name name :value (algebra-program-input name)
                           :size (forms-size-of (list (algebra-program-input name)))
                           :weights (forms-unit-weights place (length names)))))))

;;; As rates have them

(defun forms-checked-integrals (integrals direction left pushed point)
  "INTEGRALS as forms-rates has them, shown to have their rates at POINT; DIRECTION: ((name .
element) ..), the rates of names inside; LEFT: what the motion leaves of the left sides, e; PUSHED:
the power of constraints."
  (when integrals
    (forms-verdict-of "first integrals: their rates at a random point"
                      (or (catch 'forms-no-value
                            (forms-integral-pairs integrals direction left point))
                          '((nil)))
                      point))
  (loop for integral in integrals
        for name = (forms-conserved-name integral)
        collect (forms-first-integral
                 name (forms-conserved-value integral) (forms-conserved-size integral)
                 (if (eq name '$energy)
                     (algebra-program-add (forms-conserved-power integral) pushed)
                     0))))

(defun forms-integral-pairs (integrals direction left point)
  (let ((rates (acons '$t (forms-fixed 1)
                      (mapcar #'cons (mapcar #'car direction)
                              (forms-program-values (mapcar #'cdr direction) point)))))
    (loop for integral in integrals
          for value = (forms-conserved-value integral)
          collect (cons (first (forms-slopes-along
                                (list (lambda (point)
                                        (first (forms-program-values (list value) point))))
                                point rates))
                        (first (forms-program-values
                                (list (algebra-program-subtract
                                       (forms-program-product (forms-conserved-weights integral)
                                                              left)
                                       (forms-conserved-power integral)))
                                point))))))

(defun forms-reactions (multipliers rows n)
  "What constraints leave of N left sides: sum lambda_j a_j."
  (let ((left (make-list n :initial-element 0)))
    (loop for multiplier in multipliers
          for row in rows
          do (setq left (forms-program-moved left multiplier row)))
    left))
