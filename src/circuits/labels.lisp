;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Labels of branches: given, else the value when that is a name used once, else type and ordinal;
;;; and names that stand twice. Each branch is looked at once.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "circuits/elements"))

(defun circuits-counts (items)
  "Table of how often each of ITEMS, symbols, stands there."
  (let ((counts (make-hash-table :test #'eq)))
    (dolist (item items counts) (incf (gethash item counts 0)))))

(defun circuits-single-values (branches taken)
  "Table of the names that are the value of one branch only and no label in the table TAKEN."
  (let ((values (circuits-counts (remove-if-not #'symbolp
                                                (mapcar #'circuits-branch-value branches))))
        (singles (make-hash-table :test #'eq)))
    (loop for name being the hash-keys of values using (hash-value count)
          do (when (and (= count 1) (not (gethash name taken))) (setf (gethash name singles) t)))
    singles))

(defun $circuits_all_labels (branches)
  "The labels of BRANCHES, in their order."
  (let* ((taken (circuits-counts (remove nil (mapcar #'circuits-branch-label (cdr branches)))))
         (singles (circuits-single-values (cdr branches) taken))
         (ordinals (make-hash-table :test #'eq)))
    (cons '(mlist simp)
          (loop for branch in (cdr branches)
                for type = (circuits-branch-type branch)
                for value = (circuits-branch-value branch)
                for ordinal = (incf (gethash type ordinals 0))
                for label = (cond ((circuits-branch-label branch))
                                  ((and (symbolp value) (gethash value singles)) value)
                                  (t (circuits-free-label type ordinal taken singles)))
                do (setf (gethash label taken) 1)
                collect label))))

(defun circuits-free-label (type ordinal taken singles)
  "TYPE with the first number from ORDINAL on that is no label and no single value."
  (loop for k from ordinal
        for label = ($concat type k)
        unless (or (gethash label taken) (gethash label singles)) return label))

(defun $circuits_equal_names (names)
  "[k, l], the places of the first name in NAMES that stands twice, or []; false is no name."
  (let ((places (make-hash-table :test #'eq)))
    (loop for name in (cdr names)
          for k from 1
          do (cond ((null name))
                   ((gethash name places)
                    (return (list '(mlist simp) (gethash name places) k)))
                   (t (setf (gethash name places) k)))
          finally (return '((mlist simp))))))
