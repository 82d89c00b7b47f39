;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Branches and numbers of branches: those of a type, those that are not in a list, those with
;;; states in the person's order. Each branch is looked at once, whatever its place in the list is.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/sign" "circuits/elements"))

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

(defun $circuits_controlled_of (branches)
  "Those of BRANCHES that others control."
  ($circuits_of_types branches '((mlist) |$ev| |$g| |$o| |$f| |$h|)))

(defun $circuits_with_open_sign (branches)
  "Those of BRANCHES that store or resist and whose value is no positive integer, and no name that
is known to be positive."
  (cons '(mlist simp)
        (remove-if-not (lambda (branch)
                         (and (member (circuits-branch-type branch) '(|$l| |$c| |$r|))
                              (not (circuits-plainly-positive-p (circuits-branch-value branch)))))
                       (cdr branches))))

(defun circuits-plainly-positive-p (value)
  (cond ((integerp value) (plusp value))
        ((symbolp value) (eq ($algebra_sign value) '$pos))))

(defun $circuits_count (items)
  "1, 2, .. for the elements of a list."
  (cons '(mlist simp) (loop for nil in (cdr items) for number from 1 collect number)))

(defun $circuits_laws_in (circuit)
  "Numbers of the nonlinear resistors."
  (let ((branches (circuits-circuit-branches circuit)))
    ($circuits_of_type branches ($circuits_count branches) '((mlist) |$ru| |$ri|))))

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
