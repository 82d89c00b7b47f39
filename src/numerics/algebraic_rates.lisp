;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; States y without a rate, which equations 0 = g(x, y) determine: y' = -g_y^-1 g_x x', and, where
;;; two of all states are the axes of a plane and w the others, w = w(a, b) with the slopes
;;; -g_w^-1 g_ab. All on the program; Cramer's rule needs no choice of pivots, and its determinant
;;; is what vanishes where a branch of w ends. See numerics-axis-rates and numerics-branch-elements.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/minors" "algebra/program_derivative" "algebra/program_from_expressions"
                "algebra/program_nodes" "forms/rates" "numerics/run"))

(defun numerics-no-rate-p (row)
  (every (lambda (entry) (eql (cdr entry) 0)) row))

(defun numerics-algebraic-states (rates)
  "The states of RATES that have no rate, but an equation 0 = .."
  (loop for row in (forms-rates-mass rates)
        for name in (forms-rates-states rates)
        when (numerics-no-rate-p row) collect name))

(defun numerics-rated-states (rates)
  (set-difference (forms-rates-states rates) (numerics-algebraic-states rates) :test #'alike1))

(defun numerics-closings (rates)
  "The elements g of their equations."
  (loop for row in (forms-rates-mass rates)
        for element in (forms-right-sides rates)
        when (numerics-no-rate-p row) collect element))

;;; Linear systems of elements

(defparameter *numerics-most-followed* 6 "States that a determinant is written out for.")

(defun numerics-determinant-element (rows)
  (let* ((n (length rows)) (all (algebra-all-of n)))
    (funcall (algebra-minors (make-array (list n n) :initial-contents rows) #'algebra-last-row
                             (lambda (sign entry minor)
                               (algebra-program-multiply (algebra-program-multiply sign entry)
                                                         minor))
                             #'algebra-program-add)
             all all)))

(defun numerics-with-column (rows place column)
  (loop for row in rows
        for element in column
        collect (append (subseq row 0 place) (list element) (nthcdr (1+ place) row))))

(defun numerics-cramer (rows column determinant)
  "The elements of -ROWS^-1 COLUMN."
  (loop for place below (length rows)
        collect (algebra-program-negate
                 (algebra-program-divide
                  (numerics-determinant-element (numerics-with-column rows place column))
                  determinant))))

(defun numerics-slope-rows (elements names)
  "The derivatives of ELEMENTS by NAMES, a row for each element."
  (let ((inputs (mapcar #'algebra-program-input names)))
    (loop for element in elements collect (algebra-program-gradient element inputs))))

;;; Rates

(defun numerics-rate-of (rates name)
  "The element of the rate of NAME, a state that has one."
  (nth (position name (forms-rates-states rates) :test #'alike1) (forms-right-sides rates)))

(defun numerics-algebraic-rates (rates)
  "((name . rate) ..) of the states without equations for their rates."
  (let* ((names (numerics-algebraic-states rates)) (closings (numerics-closings rates))
         (rows (numerics-slope-rows closings names))
         (moving (set-difference (forms-rates-states rates) names :test #'alike1))
         (drift (algebra-program-rates
                 closings (loop for x in moving
                                collect (cons (algebra-program-input x)
                                              (numerics-rate-of rates x))))))
    (mapcar #'cons names
            (numerics-cramer rows drift (numerics-sound-determinant rows names)))))

(defun numerics-sound-determinant (rows names)
  "The determinant of ROWS; an error where it vanishes, or is too long: 0 = g is to give NAMES."
  (when (> (length names) *numerics-most-followed*)
    (core-error "~{~a~^, ~} have no rates, but equations 0 = ..; a plane is drawn for at most ~d ~
                 such" (mapcar #'numerics-name-text names) *numerics-most-followed*))
  (let ((determinant (numerics-determinant-element rows)))
    (when (eql determinant 0)
      (core-error "the equations 0 = .. do not determine ~{~a~^, ~}"
                  (mapcar #'numerics-name-text names)))
    determinant))

(defun numerics-axis-rates (rates names)
  "The elements of the rates of NAMES, states of RATES with or without a rate of their own."
  (let ((algebraic (and (intersection names (numerics-algebraic-states rates) :test #'alike1)
                        (numerics-algebraic-rates rates))))
    (loop for name in names
          collect (or (cdr (assoc name algebraic :test #'alike1))
                      (numerics-rate-of rates name)))))

;;; What follows w over a plane

(defun numerics-branch-elements (names followed flow closings)
  "Lists of elements, for states (a, b) = NAMES and w = FOLLOWED that CLOSINGS determine: those of
w in a step of Newton's, the slopes w_a .. w_b .., those of FLOW, the rates of a and b, along the
branch, and the determinant of the derivatives of CLOSINGS by w."
  (let* ((rows (numerics-slope-rows closings followed))
         (determinant (numerics-sound-determinant rows followed))
         (tilts (loop for column in (apply #'mapcar #'list
                                            (numerics-slope-rows closings names))
                      collect (numerics-cramer rows column determinant))))
    (list (numerics-cramer rows closings determinant)
          (apply #'append tilts)
          (loop for name in names
                for tilt in tilts
                append (algebra-program-rates
                        flow (acons (algebra-program-input name) 1
                                    (mapcar #'cons (mapcar #'algebra-program-input followed)
                                            tilt))))
          (list determinant))))

(defun numerics-followed-rates (tilts flow)
  "The rates of w where those of a and b are FLOW; TILTS are the elements w_a .. w_b .."
  (let ((count (/ (length tilts) 2)))
    (loop for by-a in tilts
          for by-b in (nthcdr count tilts)
          repeat count
          collect (algebra-program-add
                   (algebra-program-multiply by-a (first flow))
                   (algebra-program-multiply by-b (second flow))))))
