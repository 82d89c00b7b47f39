;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Branches and numbers of branches: those of a type, those that are not in a list, those with
;;; states in the person's order. Each branch is looked at once, whatever its place in the list is.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "circuits/elements"))

(defun $circuits_of_type (branches numbers types)
  "Those of NUMBERS whose branches are of one of TYPES."
  (let ((branches (coerce (cdr branches) 'simple-vector)))
    (cons '(mlist simp)
          (loop for number in (cdr numbers)
                when (member (circuits-branch-type (svref branches (1- number))) (cdr types))
                  collect number))))

(defun $circuits_of_types (branches types)
  "Those of BRANCHES that are of one of TYPES."
  (cons '(mlist simp)
        (remove-if-not (lambda (branch) (member (circuits-branch-type branch) (cdr types)))
                       (cdr branches))))

(defun $circuits_with_open_sign (branches)
  "Those of BRANCHES that store or resist and have no positive integer as their value."
  (cons '(mlist simp)
        (remove-if-not (lambda (branch)
                         (let ((value (circuits-branch-value branch)))
                           (and (member (circuits-branch-type branch) '(|$l| |$c| |$r|))
                                (not (and (integerp value) (plusp value))))))
                       (cdr branches))))

(defun circuits-marks (numbers count)
  "A vector of COUNT truths: which places are among NUMBERS."
  (let ((marks (make-array count :initial-element nil)))
    (dolist (number (cdr numbers) marks) (setf (svref marks (1- number)) t))))

(defun $circuits_complement (numbers count)
  "Those of 1, .., COUNT that are not among NUMBERS."
  (cons '(mlist simp)
        (loop for mark across (circuits-marks numbers count)
              for number from 1
              unless mark collect number)))

(defun circuits-in-named-order (circuit numbers)
  "NUMBERS of branches with states, those first that the key `states' names, in its order."
  (let ((named (cdr (circuits-circuit-named_states circuit)))
        (branches (coerce (cdr (circuits-circuit-branches circuit)) 'simple-vector)))
    (if named
        (circuits-by-places numbers branches (circuits-places-of named))
        numbers)))

(defun circuits-places-of (names)
  (let ((places (make-hash-table :test #'eq)) (place 0))
    (dolist (name names places)
      (setf (gethash name places) place)
      (incf place))))

(defun circuits-by-places (numbers branches places)
  "NUMBERS in the order of the PLACES of their states, those without one last."
  (flet ((place (number)
           (or (gethash (circuits-branch-state (svref branches (1- number))) places)
               (hash-table-count places))))
    (stable-sort (copy-list numbers) #'< :key #'place)))
