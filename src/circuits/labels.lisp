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

(defun $circuits_with_all_labels (branches)
  "BRANCHES, each with its label."
  (cons '(mlist simp)
        (loop for branch in (cdr branches)
              for label in (cdr ($circuits_all_labels branches))
              collect (let ((labelled (copy-circuits-branch branch)))
                        (setf (circuits-branch-label labelled) label)
                        labelled))))

(defun circuits-free-label (type ordinal taken singles)
  "TYPE with the first number from ORDINAL on that is no label and no single value."
  (loop for k from ordinal
        for label = ($concat type k)
        unless (or (gethash label taken) (gethash label singles)) return label))

;;; Rows without a fault, as most are

(defun $circuits_plain_branches (rows)
  "The branches of ROWS, or false where something in one of them is to be looked at."
  (let ((branches (loop for row in (cdr rows)
                        for number from 1
                        collect (or (circuits-branch-of-plain-row number row)
                                    (return-from $circuits_plain_branches nil)))))
    (cons '(mlist simp) branches)))

(defun circuits-branch-of-plain-row (number row)
  (multiple-value-bind (label fields)
      (if (mequalp row) (values (second row) (third row)) (values nil row))
    (and ($listp fields) (circuits-plain-branch number label (cdr fields)))))

(defun $circuits_plain_branch (row)
  "The same of [number, label or false, tail, head, type, value(, state)]."
  (destructuring-bind (number label &rest fields) (cdr row)
    (circuits-plain-branch number label fields)))

(defun circuits-plain-branch (number label fields)
  "The branch of an R, L, C, E or I with FIELDS (tail head type value), a state perhaps behind."
  (destructuring-bind (&optional tail head type (value nil given) (state nil named) &rest more)
      fields
    (flet ((node-p (node) (or (integerp node) (circuits-name-p node))))
      (and given (null more) (node-p tail) (node-p head) (not (eq tail head))
           (or (null label) (circuits-name-p label))
           (if named
               (and (circuits-name-p state) (member type '(|$l| |$c|)))
               (member type '(|$r| |$l| |$c| |$e| |$i|)))
           (make-circuits-branch :label label :tail tail :head head :type type :value value
                                 :number number :state state :control '((mlist simp)))))))

(defun circuits-name-p (e) (and e (symbolp e) (not (eq e t))))

;;; States without a name of their own

(defun circuits-store-p (branch) (member (circuits-branch-type branch) '(|$l| |$c|)))

(defun $circuits_with_default_states (branches)
  "BRANCHES, states not named called i_LABEL and u_LABEL."
  (cons '(mlist simp)
        (loop for branch in (cdr branches)
              collect (if (and (circuits-store-p branch) (null (circuits-branch-state branch)))
                          (let ((named (copy-circuits-branch branch)))
                            (setf (circuits-branch-state named)
                                  ($concat (if (eq (circuits-branch-type branch) '|$l|)
                                               '$i_
                                               '$u_)
                                           (circuits-branch-label branch)))
                            named)
                          branch))))

(defun $circuits_states_are_names (branches)
  (loop for branch in (cdr branches)
        always (or (not (circuits-store-p branch))
                   (and (circuits-name-p (circuits-branch-state branch))
                        (not (eq (circuits-branch-state branch) '$t))))))

(defun $circuits_with_formulas (branches)
  "Those whose values are neither numbers nor names, and those with laws."
  (cons '(mlist simp)
        (remove-if (lambda (branch)
                     (let ((value (circuits-branch-value branch)))
                       (and (or (numberp value)
                                (and (circuits-name-p value) (not (eq value '$t))))
                            (not (member (circuits-branch-type branch) '(|$ru| |$ri|))))))
                   (cdr branches))))

;;; Names of all branches

(defun $circuits_branch_labels (branches)
  (cons '(mlist simp) (mapcar #'circuits-branch-label (cdr branches))))

(defun $circuits_branch_states (branches)
  "Their states, false where there is none."
  (cons '(mlist simp) (mapcar #'circuits-branch-state (cdr branches))))

(defun $circuits_names_of_states (branches)
  (cons '(mlist simp) (remove nil (mapcar #'circuits-branch-state (cdr branches)))))

;;; Branches by label, names in values

(defun $circuits_labelled (branches label)
  "The branch of that LABEL, or false."
  (find label (cdr branches) :key #'circuits-branch-label))

(defun $circuits_state_in_value (branches)
  "[branch, name] where the name of a state stands in the value of that branch, or []."
  (let ((states (make-hash-table :test #'eq)))
    (dolist (branch (cdr branches))
      (when (circuits-branch-state branch)
        (setf (gethash (circuits-branch-state branch) states) t)))
    (loop for branch in (cdr branches)
          for name = (find-if (lambda (name) (gethash name states))
                              (circuits-names-in (circuits-branch-value branch)))
          when name return (list '(mlist simp) branch name)
            finally (return '((mlist simp))))))

(defun circuits-names-in (e)
  (cond ((symbolp e) (list e))
        ((atom e) '())
        (t (mapcan #'circuits-names-in (copy-list (cdr e))))))

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
