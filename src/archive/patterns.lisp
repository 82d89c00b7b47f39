;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; How a function is called on expressions, as the register states it, (kind name .. &optional name
;;; ..): what fits so many arguments, and what a person types.

(in-package :maxima)

(defun archive-form-fits (form values)
  "Whether the number of VALUES fits FORM = (kind name .. &optional name ..)."
  (let* ((names (cdr form)) (optional (position "&optional" names :test #'equal))
         (least (or optional (length names)))
         (most (if optional (1- (length names)) least)))
    (<= least (length values) most)))

(defun archive-call-patterns (public)
  "The ways of calling PUBLIC, as a person types them."
  (let ((name (core-public-name public)))
    (append
     (when (core-public-kinds public)
       (list (format nil "~a(\"archive.txt\"~{, ~a~})" name (core-public-trailing public))))
     (loop for form in (core-public-forms public) collect (archive-pattern public form)))))

(defun archive-pattern (public form)
  (format nil "~a(~{~a~^, ~})" (core-public-name public)
          (remove "&optional" (cdr form) :test #'equal)))

(defun archive-equations-form (public &optional count)
  "The form of PUBLIC that begins with equations of motion, for COUNT arguments if that is given."
  (find-if (lambda (form)
             (and (equal (second form) "equations")
                  (or (null count) (archive-form-fits form (make-list count)))))
           (core-public-forms public)))

(defun archive-equations-advice (public)
  "What to say where equations of motion were given to PUBLIC for something else."
  (let ((form (archive-equations-form public)))
    (if form
        (format nil "these are equations of motion: call it as ~a~:[, without the names of the ~
                     variables, which follow from them~;~]"
                (archive-pattern public form)
                (member "variables" form :test #'equal))
        (format nil "equations of motion are not what it takes; Equilibria, FirstApproximation, ~
                     Stability and Simulate take them"))))
