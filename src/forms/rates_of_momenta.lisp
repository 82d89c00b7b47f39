;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates with momenta, on programs. Hamilton's form, no function H being formed:
;;;     q' = v,   p' = dL/dq - dR/dq' + Q + sum lambda_j a_j   at   v = M^-1 (p - a),
;;; a the momenta at rest. Routh's form: the accelerations of all coordinates at those velocities of
;;; the cyclic ones that their momenta p_l determine; the cyclic coordinates themselves follow by
;;; quadrature. See forms-hamilton-rates and forms-routh-rates first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative"
                "algebra/program_from_expressions" "algebra/program_nodes" "forms/dynamics"
                "forms/equations_as_program" "forms/fixed" "forms/judge" "forms/momenta_judge"
                "forms/program_judge" "forms/rates" "forms/rates_integrals"
                "forms/rates_of_motion" "forms/value"))

;;; Elements with other elements for some inputs.

(defun forms-put-in-bonds (bonds pairs)
  (loop for bond in bonds
        collect (destructuring-bind (value rate right . row)
                    (forms-put (list* (forms-bond-value bond) (forms-bond-rate bond)
                                      (forms-bond-right bond) (forms-bond-row bond))
                               pairs)
                  (make-forms-bond :value value :rate rate :right right :row row))))

(defun forms-put-lists (lists pairs)
  (let ((elements (forms-put (apply #'append lists) pairs)))
    (loop for list in lists collect (loop for nil in list collect (pop elements)))))

(defun forms-kept-items (items task constant)
  "Those of ITEMS, one for each coordinate, whose momentum is not CONSTANT; that is a list of
(coordinate . name of its momentum)."
  (loop for item in items
        for x in (forms-task-q task)
        unless (assoc x constant :test #'alike1) collect item))

;;; Hamilton's form.

(defun forms-hamilton-rates (dynamics names constant)
  "NAMES are those of the momenta of all coordinates, of which those of CONSTANT are no states."
  (let* ((velocities (forms-velocities-of-momenta dynamics names))
         (pushes (forms-put (forms-free-pushes dynamics)
                            (mapcar #'cons (forms-task-v (forms-dynamics-task dynamics))
                                    velocities)))
         (motion (forms-canonical-motion-of dynamics names velocities pushes)))
    (forms-check-hamilton dynamics names motion)
    (forms-canonical-rates dynamics names motion constant
                           (forms-canonical-integrals
                            dynamics names motion
                            (forms-integrals-in-momenta dynamics names velocities)
                            (forms-canonical-point dynamics names)))))

(defun forms-canonical-motion-of (dynamics names velocities pushes)
  "The motion with the constraints of DYNAMICS, VELOCITIES put in."
  (let* ((task (forms-dynamics-task dynamics))
         (bonds (forms-put-in-bonds (forms-dynamics-bonds dynamics)
                                    (mapcar #'cons (forms-task-v task) velocities)))
         (multipliers (forms-canonical-multipliers task names velocities pushes bonds))
         (forces pushes))
    (loop for bond in bonds
          for multiplier in multipliers
          do (setq forces (forms-program-moved forces multiplier (forms-bond-row bond))))
    (make-forms-canonical-motion :velocities velocities :forces forces :bonds bonds
                                 :multipliers multipliers)))

(defun forms-canonical-point (dynamics names)
  "A random point with the momenta, NAMES, that its velocities give."
  (let ((point (forms-trial-point (forms-momentum-trial dynamics)))
        (terms (funcall (forms-dynamics-terms dynamics))))
    (catch 'forms-no-value
      (forms-set-places names (forms-program-values (forms-program-terms-momenta terms) point)
                        point))
    point))

(defun forms-canonical-integrals (dynamics names motion integrals point)
  "INTEGRALS in coordinates and the momenta NAMES, as rates have them."
  (let ((task (forms-dynamics-task dynamics))
        (multipliers (forms-canonical-motion-multipliers motion)))
    (forms-checked-integrals
     integrals
     (append (mapcar #'cons (forms-task-q task) (forms-canonical-motion-velocities motion))
             (mapcar #'cons names (forms-canonical-motion-forces motion)))
     (forms-reactions multipliers
                      (mapcar #'forms-bond-row (forms-canonical-motion-bonds motion))
                      (length names))
     (forms-power-of-constraints dynamics multipliers) point)))

(defun forms-canonical-rates (dynamics names motion constant integrals)
  (let ((task (forms-dynamics-task dynamics)))
    (flet ((kept (items) (forms-kept-items items task constant)))
      (let ((elements (append (kept (forms-canonical-motion-velocities motion))
                              (kept (forms-canonical-motion-forces motion)))))
        (make-forms-rates
         :program *algebra-program* :pairs '()
         :states (append (kept (forms-task-q task)) (kept names)) :momenta (kept names)
         :outputs (cons (cons '$rates (cons :list elements))
                        (forms-momentum-bonds dynamics (forms-canonical-motion-bonds motion)
                                              (forms-canonical-motion-multipliers motion)
                                              constant))
         :guards (forms-dynamics-pivots dynamics)
         :inertia (forms-dynamics-inertia dynamics)
         :integrals (remove-if (lambda (name) (rassoc name constant)) integrals
                              :key #'forms-first-integral-name)
         :angles (forms-angles (kept (forms-task-q task)) elements))))))

(defun forms-velocities-of-momenta (dynamics names)
  "M^-1 (p - a)."
  (let* ((task (forms-dynamics-task dynamics))
         (terms (funcall (forms-dynamics-terms dynamics)))
         (at-rest (forms-put (forms-program-terms-momenta terms)
                             (loop for v in (forms-task-v task) collect (cons v 0)))))
    (funcall (forms-dynamics-solve dynamics)
             (mapcar (lambda (p a) (algebra-program-subtract (algebra-program-input p) a))
                     names at-rest))))

(defun forms-free-pushes (dynamics)
  "dL/dq - dR/dq' + Q."
  (let ((terms (funcall (forms-dynamics-terms dynamics))))
    (mapcar (lambda (slope damping force)
              (algebra-program-add (algebra-program-subtract slope damping) force))
            (forms-program-terms-slopes terms)
            (forms-program-terms-damping terms)
            (forms-program-terms-forces terms))))

(defun forms-canonical-multipliers (task names velocities forces bonds)
  "lambda from the rates of g_j(q, p, t), which vanish: with G = dg/dp, G A^T lambda = -g' at the
FORCES alone."
  (when bonds
    (let ((rates (acons (algebra-program-input '$t) 1
                        (forms-input-rates (append (forms-task-q task) names)
                                           (append velocities forces))))
          (values (mapcar #'forms-bond-rate bonds)))
      (forms-program-solution
       (loop for g in values
             for row = (algebra-program-gradient g (mapcar #'algebra-program-input names))
             collect (loop for bond in bonds
                           collect (forms-program-product row (forms-bond-row bond))))
       (mapcar #'algebra-program-negate (algebra-program-rates values rates))
       *forms-dependent-constraints*))))

(defun forms-input-rates (names elements)
  (mapcar (lambda (name element) (cons (algebra-program-input name) element)) names elements))

(defun forms-momentum-bonds (dynamics bonds multipliers constant)
  "The outputs of the BONDS, whose elements have other velocities put in."
  (when bonds
    (let* ((task (forms-dynamics-task dynamics))
           (dynamics (copy-forms-dynamics dynamics)))
      (setf (forms-dynamics-bonds dynamics) bonds)
      (loop for (name . value) in (forms-bond-outputs
                                   dynamics
                                   (list (cons '$multipliers (cons :list multipliers))))
            collect (cons name
                          (if (eq (car value) :matrix)
                              (cons :matrix (loop for row in (cdr value)
                                                  collect (forms-kept-items row task constant)))
                              value))))))

;;; Of a function H of coordinates and momenta: q' = dH/dp, p' = -dH/dq + Q.

(defun forms-rates-of-hamiltonian (function forces names task)
  (let* ((velocities (algebra-program-gradient
                      function (mapcar #'algebra-program-input names)))
         (slopes (algebra-program-gradient
                  function (mapcar #'algebra-program-input (forms-task-q task))))
         (dynamics (make-forms-dynamics
                    :task task :bonds (forms-task-bonds task) :guards (constantly '())
                    :solve (lambda (pushes)
                             (algebra-program-rates velocities (forms-input-rates names pushes)))))
         (motion (forms-canonical-motion-of
                  dynamics names velocities
                  (mapcar #'algebra-program-subtract forces slopes))))
    (values (forms-canonical-rates
             dynamics names motion '()
             (forms-canonical-integrals
              dynamics names motion
              (forms-integrals-of-hamiltonian function slopes forces names motion)
              (forms-new-point t)))
            motion)))

;;; Routh's form.

(defun forms-routh-rates (dynamics names constant)
  "CONSTANT: ((coordinate . name of its momentum) ..); NAMES are those of all momenta."
  (let* ((task (forms-dynamics-task dynamics))
         (velocities (forms-cyclic-velocities dynamics constant))
         (outputs (forms-checked-outputs dynamics))
         (pairs (forms-cyclic-pairs task constant velocities))
         (bonds (forms-put-in-bonds (forms-dynamics-bonds dynamics) pairs)))
    (destructuring-bind (accelerations multipliers)
        (forms-put-lists (list (forms-output-list '$accelerations outputs)
                               (forms-output-list '$multipliers outputs))
                         pairs)
      (forms-check-cyclic-velocities dynamics constant velocities)
      (flet ((kept (items) (forms-kept-items items task constant)))
        (let ((elements (append (mapcar #'algebra-program-input (kept (forms-task-v task)))
                                (kept accelerations))))
          (make-forms-rates
           :program *algebra-program*
           :states (append (kept (forms-task-q task))
                           (kept (mapcar #'cdr (forms-task-names task))))
           :pairs (kept (forms-task-names task))
           :outputs (list* (cons '$rates (cons :list elements))
                           (cons '$quadratures (cons :list velocities))
                           (forms-momentum-bonds dynamics bonds multipliers constant))
           :cyclic (mapcar #'car constant)
           :guards (forms-put-in-guards (forms-dynamics-pivots dynamics) pairs)
           :split (length (kept (forms-task-q task)))
           :inertia (forms-dynamics-inertia dynamics)
           :integrals (forms-routh-integrals dynamics names constant pairs elements
                                             multipliers)
           :angles (forms-angles (kept (forms-task-q task)) elements)))))))

(defun forms-routh-integrals (dynamics names constant pairs elements multipliers)
  "Those of the remaining coordinates, whose rates and whose velocities' are ELEMENTS."
  (let ((task (forms-dynamics-task dynamics)))
    (flet ((kept (items) (forms-kept-items items task constant)))
      (forms-checked-integrals
       (remove-if (lambda (integral) (rassoc (forms-conserved-name integral) constant))
                  (forms-put-in-integrals (forms-motion-integrals dynamics names) pairs))
       (mapcar #'cons (append (kept (forms-task-q task)) (kept (forms-task-v task))) elements)
       (forms-reactions multipliers (mapcar #'forms-bond-row (forms-dynamics-bonds dynamics))
                        (length names))
       (forms-power-of-constraints dynamics multipliers)
       (forms-trial-point (forms-momentum-trial dynamics))))))

(defun forms-cyclic-pairs (task constant velocities)
  "What is put in: 0 for the cyclic coordinates, on which nothing depends, and their VELOCITIES."
  (append (loop for (x) in constant collect (cons x 0))
          (loop for (x) in constant
                for v in velocities
                collect (cons (forms-velocity-name x task) v))))

(defun forms-put-in-guards (guards pairs)
  (loop for (name . guard) in guards
        collect (destructuring-bind (pivot whole)
                    (forms-put (list (car guard) (cdr guard)) pairs)
                  (list* name pivot whole))))

(defun forms-cyclic-velocities (dynamics constant)
  "The velocities of the coordinates of CONSTANT momenta, A_cc^-1 (p_c - b_c), b_c the momenta
where they rest."
  (let* ((task (forms-dynamics-task dynamics))
         (terms (funcall (forms-dynamics-terms dynamics)))
         (names (loop for (x) in constant collect (forms-velocity-name x task)))
         (momenta (loop for (x) in constant
                        collect (nth (forms-coordinate-place x task)
                                     (forms-program-terms-momenta terms))))
         (rest (loop for v in names collect (cons v 0)))
         (rest-pairs (append rest (loop for (x) in constant collect (cons x 0)))))
    (forms-program-solution
     (loop for momentum in momenta
           collect (forms-put (algebra-program-gradient momentum
                                                        (mapcar #'algebra-program-input names))
                              rest-pairs))
     (loop for (nil . p) in constant
           for momentum in (forms-put momenta rest-pairs)
           collect (algebra-program-subtract (algebra-program-input p) momentum))
     "the momenta of the cyclic coordinates do not determine their velocities")))
