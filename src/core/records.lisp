;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Records with named fields in both languages. (core-record forms-actions (rayleigh 0) forces)
;;; makes the structure forms-actions with its accessors in Lisp, and for Maxima the function
;;; forms_actions(rayleigh, forces), which makes one, and forms_actions_rayleigh(record), .., which
;;; read it. Records stay inside: what a person gets are lists of equations.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun core-maxima-name (&rest parts)
    "The symbol that Maxima code spells PARTS, joined by underlines."
    (intern (substitute #\_ #\- (string-upcase (format nil "$~{~a~^_~}" parts))) :maxima)))

;; forms_actions_with(record, 'forces = Q) is a copy with another value of that field.

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun core-record-reader (name field) (intern (format nil "~a-~a" name field) :maxima))

  (defun core-record-maker (name required optional)
    (let ((fields (append required (mapcar #'car optional))))
      `(defun ,(core-maxima-name name)
           (,@required ,@(when optional `(&optional ,@optional)))
         (,(intern (format nil "MAKE-~a" name) :maxima)
          ,@(loop for field in fields
                  append (list (intern (symbol-name field) :keyword) field))))))

  (defun core-record-changer (name fields)
    `(defun ,(core-maxima-name name "with") (record &rest changes)
       (let ((copy (,(intern (format nil "COPY-~a" name) :maxima) record)))
         (dolist (change changes copy)
           (ecase (cadr change)
             ,@(loop for field in fields
                     collect `(,(core-maxima-name field)
                               (setf (,(core-record-reader name field) copy)
                                     (caddr change))))))))))

(defmacro core-record (name documentation &rest fields)
  "A structure NAME; each of FIELDS is a symbol or, after those, (symbol default)."
  (let* ((required (remove-if #'consp fields))
         (optional (remove-if-not #'consp fields))
         (all (append required (mapcar #'car optional))))
    `(progn
       (defstruct ,name ,documentation ,@all)
       ,(core-record-maker name required optional)
       ,(core-record-changer name all)
       ,@(loop for field in all
               collect `(defun ,(core-maxima-name name field) (record)
                          (,(core-record-reader name field) record)))
       ',name)))
