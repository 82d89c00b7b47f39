;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The branch of states without rates over the axes of a plane: which states follow from these,
;;; what is computed of them, and the point from which they are followed. That is the start, or lies
;;; over the middle of the window. Look first at numerics-branch-of.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "forms/rates" "numerics/algebraic_rates"
                "numerics/decimals" "numerics/followed_branch" "numerics/native"
                "numerics/plane_axes" "numerics/problem" "numerics/program"
                "numerics/routine" "numerics/run" "numerics/run_options"))

(defun numerics-followed-states (rates names)
  "The states that follow from those of the axes NAMES by equations 0 = .."
  (let* ((algebraic (numerics-algebraic-states rates))
         (axes (intersection names algebraic :test #'alike1)))
    (when (and axes (/= 2 (length (numerics-rated-states rates))))
      (core-error "~{~a~^, ~} follow~:[s~;~] from an equation 0 = .. and can be an axis only where ~
                   two states have rates; take states with rates"
                  (mapcar #'numerics-name-text axes) (cdr axes)))
    (and algebraic
         (loop for name in (forms-rates-states rates)
               unless (or (member name names :test #'alike1)
                          (not (or axes (member name algebraic :test #'alike1))))
                 collect name))))

(defun numerics-branch-of (axes followed elements start)
  "The branch of FOLLOWED over AXES by ELEMENTS, two rates and what vanishes, and the rates of
FOLLOWED."
  (let* ((names (mapcar #'numerics-axis-name axes)) (flow (subseq elements 0 2))
         (closings (nthcdr 2 elements))
         (parts (numerics-branch-elements names followed flow closings))
         (branch (numerics-routines-of-branch (append names followed) followed parts)))
    (numerics-start-branch branch axes start
                           (numerics-values-over (append names followed) closings))
    (cons branch (numerics-followed-rates (second parts) flow))))

(defun numerics-values-over (names elements)
  "The function of a state, a vector, that gives the values of ELEMENTS."
  (let ((routine (numerics-routine (make-numerics-program :algebra *algebra-program* :names names)
                                   elements))
        (moment (numerics-moment 0d0)) (count (length elements)))
    (lambda (state)
      (let ((out (numerics-zeros count)))
        (funcall routine moment state out)
        out))))

(defun numerics-routines-of-branch (names followed parts)
  (destructuring-bind (newton tilts slopes determinant)
      (loop for elements in parts collect (numerics-values-over names elements))
    (make-numerics-branch :names followed :newton newton :tilts tilts :slopes slopes
                          :determinant determinant)))

(defun numerics-start-number (name start)
  (let ((given (find name (numerics-items start) :key #'second :test #'alike1)))
    (and given (numerics-double (third given) "a start value"))))

(defun numerics-start-branch (branch axes start closings)
  "Lets BRANCH be followed from START, or from the middle of the window where that does not name
both of AXES; CLOSINGS is a function of the state, what vanishes."
  (let* ((named (loop for axis in axes
                      collect (numerics-start-number (numerics-axis-name axis) start)))
         (place (if (every #'identity named)
                    named
                    (loop for axis in axes collect (numerics-at-place axis 0.5d0)))))
    (numerics-with-masked-traps
      (setf (numerics-branch-known branch)
            (coerce (append place (numerics-branch-begin branch place start closings))
                    'numerics-vector))
      (unless (numerics-settle-branch branch (mapcar #'numerics-axis-width axes))
        (numerics-fault-branch branch axes)))))

(defun numerics-branch-begin (branch place start closings)
  "The values of START for what is followed; one that it does not name is what is nearest to 0."
  (let* ((names (numerics-branch-names branch))
         (given (loop for name in names collect (numerics-start-number name start))))
    (cond ((every #'identity given) given)
          ((cdr names) (numerics-ask-for-start names))
          (t (list (or (numerics-zero-near-0 (numerics-value-over place closings))
                       (numerics-ask-for-start names)))))))

(defun numerics-value-over (place closings)
  "The value of CLOSINGS over PLACE, as a function of the third number."
  (let ((state (coerce (append place '(0d0)) 'numerics-vector)))
    (lambda (w)
      (setf (aref state 2) w)
      (aref (funcall closings state) 0))))

(defun numerics-ask-for-start (names)
  (core-error "~{~a~^, ~} follow~:[s~;~] from equations 0 = ..; give start = [~:*~:*~{~a = ..~^, ~
               ~}] on the branch that is to be drawn"
              (mapcar #'numerics-name-text names) (cdr names)))

(defun numerics-fault-branch (branch axes)
  (core-error "near ~{~a = ~a~^, ~} the equations 0 = .. have no solution for ~{~a~^, ~} that can ~
               be followed; give a start that fulfils them"
              (loop for name in (append (mapcar #'numerics-axis-name axes)
                                        (numerics-branch-names branch))
                    for x across (numerics-branch-known branch)
                    append (list (numerics-name-text name) (numerics-short-number x)))
              (mapcar #'numerics-name-text (numerics-branch-names branch))))
