;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What depends on coordinates and time alone, and its rate as a row [c_0, c_1, .., c_n]: the rate
;;; is c_0 + sum c_i q_i'. An expression is differentiated by the names that occur in it only, so
;;; that a chain of many bodies costs no more for each. Places of sections and links in their lists.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/exchange"))

(defun $linmodel_check_geometry (section key e)
  (let ((derivatives (forms-collect-derivatives e '())))
    (when derivatives
      ($core_fault section key key " must not contain velocities, found "
                   (car (last derivatives))))))

;;; Names

(defun linmodel-collect-names (e names)
  "Adds the symbols and subscripted names of E to the table NAMES."
  (cond ((symbolp e) (setf (gethash e names) t))
        ((consp e)
         (when (member 'array (car e)) (push e (gethash :subscripted names)))
         (dolist (part (cdr e)) (linmodel-collect-names part names)))))

(defun linmodel-names (e)
  (let ((names (make-hash-table :test #'eq)))
    (linmodel-collect-names e names)
    names))

(defun linmodel-named-p (name names)
  (if (symbolp name)
      (gethash name names)
      (member name (gethash :subscripted names) :test #'alike1)))

(defun $linmodel_first_occurring (list e)
  "The first of LIST that occurs in E, or false."
  (let ((names (linmodel-names e)))
    (find-if (lambda (name) (linmodel-named-p name names)) (cdr list))))

(defun $linmodel_unused_coordinate (q links)
  "The first coordinate that no angle, joint or rate of the LINKS has, or false."
  (let ((names (linmodel-names links)))
    (loop for x in (cdr q)
          for i from 1
          unless (or (linmodel-named-p x names) (linmodel-moved-p i links)) return x)))

(defun linmodel-moved-p (i links)
  (some (lambda (link)
          (some (lambda (turn) (not (eql 0 (nth i (cdr (fourth turn)))))) (cdr (fourth link))))
        (cdr links)))

;;; Rates

(defun linmodel-slope (e x names)
  (cond ((eq e x) 1)
        ((linmodel-named-p x names) ($diff e x))
        (t 0)))

(defun $linmodel_rate_row (e q)
  "de/dt as a row."
  (let ((names (linmodel-names e)))
    (cons '(mlist simp) (mapcar (lambda (x) (linmodel-slope e x names)) (cons '$t (cdr q))))))

;;; Places

(defun $linmodel_position (name names)
  (let ((place (position name (cdr names) :test #'core-key-equal)))
    (and place (1+ place))))

(defun $linmodel_last_position (name names)
  (let ((place (position name (cdr names) :test #'core-key-equal :from-end t)))
    (and place (1+ place))))
