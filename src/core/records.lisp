;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Records with named fields in both languages. (core-record forms-actions (rayleigh 0) forces)
;;; makes the structure forms-actions with its accessors in Lisp, and for Maxima the function
;;; forms_actions(rayleigh, forces), which makes one, and forms_actions_rayleigh(record), .., which
;;; read it. Records stay inside: what a person gets are lists of equations. A record called
;;; (forms-special forms-actions) is one of the latter, to which fields are added: it is made from
;;; one, forms_special(actions, ..), and read by the names of both.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun core-maxima-name (&rest parts)
    "The symbol that Maxima code spells PARTS, joined by underlines."
    (intern (substitute #\_ #\- (string-upcase (format nil "$~{~a~^_~}" parts))) :maxima)))

;; forms_actions_with(record, 'forces = Q) is a copy with another value of that field.

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun core-record-reader (name field) (intern (format nil "~a-~a" name field) :maxima))

  (defun core-record-fields (name) (get name 'core-record-fields))

  (defun core-record-key (field) (intern (symbol-name field) :keyword)))

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun core-record-maker (name parent required optional)
    (let ((fields (append required (mapcar #'car optional))))
      `(defun ,(core-maxima-name name)
           (,@(when parent (list parent)) ,@required ,@(when optional `(&optional ,@optional)))
         (,(intern (format nil "MAKE-~a" name) :maxima)
          ,@(loop for field in (core-record-fields parent)
                  append `(,(core-record-key field) (,(core-record-reader parent field) ,parent)))
          ,@(loop for field in fields append (list (core-record-key field) field))))))

  (defun core-record-changer (name fields)
    `(defun ,(core-maxima-name name "with") (record &rest changes)
       (let ((copy (,(intern (format nil "COPY-~a" name) :maxima) record)))
         (dolist (change changes copy)
           (ecase (cadr change)
             ,@(loop for field in fields
                     collect `(,(core-maxima-name field)
                               (setf (,(core-record-reader name field) copy)
                                     (caddr change))))))))))

(defmacro core-record (name-and-parent documentation &rest fields)
  "A structure NAME, or (NAME PARENT); each of FIELDS is a symbol or, after those, (symbol
default)."
  (destructuring-bind (name &optional parent)
      (if (consp name-and-parent) name-and-parent (list name-and-parent))
    (let* ((required (remove-if #'consp fields))
           (optional (remove-if-not #'consp fields))
           (own (append required (mapcar #'car optional)))
           (all (append (core-record-fields parent) own)))
      `(progn
         (eval-when (:compile-toplevel :load-toplevel :execute)
           (setf (get ',name 'core-record-fields) ',all))
         (defstruct ,(if parent `(,name (:include ,parent)) name) ,documentation ,@own)
         ,(core-record-maker name parent required optional)
         ,(core-record-changer name all)
         ,@(loop for field in all
                 collect `(defun ,(core-maxima-name name field) (record)
                            (,(core-record-reader name field) record)))
         ',name))))
