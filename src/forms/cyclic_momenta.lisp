;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates in the form that a call asks for: Lagrange's, Routh's or Hamilton's. Which coordinates are
;;; cyclic is seen in the program: neither L nor what acts depends on them, no force does work on
;;; them, no constraint holds them. What does not vanish at sight is tried at a random point.
;;; See forms-rates-in-form first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "algebra/program_exchange"
                "algebra/program_from_expressions" "algebra/program_nodes" "forms/actions"
                "forms/dynamics" "forms/equations_as_program" "forms/rates_impulses" "forms/judge"
                "forms/momenta" "forms/momenta_judge" "forms/program_judge" "forms/rates"
                "forms/rates_of_momenta" "forms/rates_of_motion"))

(core-record forms-wanted-form
  "FORM is lagrange, routh or hamilton; NAMES of the momenta of all coordinates, which must not
occur in the expressions TAKEN; GIVEN: values of momenta, equations by name; CYCLIC: auto, or the
coordinates to be left out; ROTORS: coordinates that are left out in any form."
  form names taken (given *forms-none*) (cyclic '$auto) (rotors *forms-none*))

(defun forms-rates-in-form (dynamics wanted)
  (let ((rotors (cdr (forms-wanted-form-rotors wanted))))
    (case (forms-wanted-form-form wanted)
      ($hamilton (forms-hamilton-of-wanted dynamics wanted rotors))
      ($routh (forms-routh-of-cyclic dynamics wanted (forms-cyclic-names dynamics wanted)))
      (t (if rotors
             (forms-routh-of-cyclic dynamics wanted rotors)
             (forms-rates-of-dynamics dynamics (cdr (forms-wanted-form-names wanted))))))))

(defun forms-hamilton-of-wanted (dynamics wanted rotors)
  (forms-check-momentum-names dynamics wanted (forms-task-q (forms-dynamics-task dynamics)))
  (forms-with-given-momenta
   (forms-hamilton-rates dynamics (cdr (forms-wanted-form-names wanted))
                         (forms-named-momenta dynamics wanted rotors))
   wanted))

(defun forms-routh-of-cyclic (dynamics wanted cyclic)
  (let ((constant (forms-named-momenta dynamics wanted cyclic)))
    (forms-check-momentum-names dynamics wanted cyclic)
    (when (= (length cyclic) (length (forms-task-q (forms-dynamics-task dynamics))))
      (core-error "all coordinates are cyclic: nothing is left but the momenta ~{~a~^, ~}"
                  (loop for (nil . p) in constant collect (core-words (list p)))))
    (forms-with-given-momenta
     (forms-routh-rates dynamics (cdr (forms-wanted-form-names wanted)) constant) wanted)))

(defun forms-named-momenta (dynamics wanted coordinates)
  "((coordinate . name of its momentum) ..) in the order of all coordinates."
  (loop for x in (forms-task-q (forms-dynamics-task dynamics))
        for p in (cdr (forms-wanted-form-names wanted))
        when (member x coordinates :test #'alike1) collect (cons x p)))

(defun forms-check-momentum-names (dynamics wanted coordinates)
  (mfuncall '$forms_check_new_names
            (cons '(mlist simp) (mapcar #'cdr (forms-named-momenta dynamics wanted coordinates)))
            (forms-wanted-form-taken wanted)
            (cons '(mlist simp) (forms-task-q (forms-dynamics-task dynamics)))))

(defun forms-with-given-momenta (rates wanted)
  "RATES with the values of momenta that are given and no states."
  (let ((pairs (loop for (nil name value) in (cdr (forms-wanted-form-given wanted))
                     unless (member name (forms-rates-states rates))
                       collect (cons name (algebra-program-element value)))))
    (if pairs
        (forms-exchanged-rates rates (algebra-exchange-by pairs) #'algebra-fault-division)
        rates)))

;;; Cyclic coordinates.

(defun forms-cyclic-names (dynamics wanted)
  "The coordinates that WANTED leaves out, rotors among them."
  (let* ((q (forms-task-q (forms-dynamics-task dynamics)))
         (rotors (cdr (forms-wanted-form-rotors wanted)))
         (cyclic (forms-wanted-form-cyclic wanted)))
    (if (eq cyclic '$auto)
        (forms-found-cyclic dynamics q)
        (progn
          (forms-check-cyclic dynamics cyclic q)
          (remove-if-not (lambda (x) (member x (append rotors (cdr cyclic)) :test #'alike1)) q)))))

(defun forms-found-cyclic (dynamics q)
  (let ((obstacles (mapcar (lambda (x) (forms-cyclic-obstacle dynamics x)) q)))
    (or (loop for x in q
              for obstacle in obstacles
              unless obstacle collect x)
        (core-error "no cyclic coordinate: ~{~a: ~a~^; ~}"
                    (loop for x in q
                          for obstacle in obstacles
                          append (list (core-words (list x)) obstacle))))))

(defun forms-check-cyclic (dynamics cyclic q)
  (unless (and (consp cyclic) (eq (caar cyclic) 'mlist) (cdr cyclic))
    (core-error "cyclic must be a list of coordinates, found ~a" (core-words (list cyclic))))
  (dolist (x (cdr cyclic))
    (unless (member x q :test #'alike1)
      (core-error "~a is not among the coordinates ~a" (core-words (list x))
                  (core-words (list (cons '(mlist simp) q)))))
    (let ((obstacle (forms-cyclic-obstacle dynamics x)))
      (when obstacle (core-error "~a is not cyclic: ~a" (core-words (list x)) obstacle)))))

(defun forms-slopes-by (elements x)
  (loop for element in elements
        append (algebra-program-gradient element (list (algebra-program-input x)))))

(defun forms-cyclic-obstacle (dynamics x)
  "What keeps X from being cyclic, or nil."
  (let* ((task (forms-dynamics-task dynamics)) (place (forms-coordinate-place x task))
         (velocity (forms-velocity-name x task))
         (terms (funcall (forms-dynamics-terms dynamics)))
         (acting (append (forms-program-terms-damping terms) (forms-program-terms-forces terms)))
         (bonds (forms-dynamics-bonds dynamics))
         (point (forms-trial-point (forms-momentum-trial dynamics))))
    (flet ((of (reader) (nth place (funcall reader terms)))
           (nought-p (&rest elements) (forms-nought-p elements point)))
      (cond ((not (nought-p (of #'forms-program-terms-slopes))) "L depends on it")
            ((forms-nought-p (forms-slopes-by (list (of #'forms-program-terms-momenta)) velocity)
                             point)
             "L does not contain the square of its velocity")
            ((not (nought-p (of #'forms-program-terms-damping)))
             "Rayleigh's function contains its velocity")
            ((not (nought-p (of #'forms-program-terms-forces))) "a force does work on it")
            ((not (forms-nought-p (forms-slopes-by acting x) point)) "a force depends on it")
            ((not (forms-nought-p
                   (append (loop for bond in bonds collect (nth place (forms-bond-row bond)))
                           (forms-slopes-by (mapcar #'forms-bond-rate bonds) x))
                   point))
             "a constraint contains it")))))

;;; For Maxima.

(defun $forms_rates_of_task (system task wanted)
  (with-algebra-program
    (forms-with-impulses
      (forms-rates-in-form (forms-dynamics-of-function system (forms-read-task task)) wanted))))
