;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Every name of Lisp is defined once: functions, macros, and what structures define by themselves
;;; (make-.., copy-.., ..-p, accessors), in all rooms. The later one would replace the earlier in
;;; silence.

(in-package :maxima)

(defun definitions-of-structure (form)
  "The names that a defstruct defines."
  (destructuring-bind ((name &rest options) &rest slots)
      (cons (if (consp (second form)) (second form) (list (second form)))
            (remove-if #'stringp (cddr form)))
    (flet ((option (key) (find key options :key (lambda (o) (if (consp o) (car o) o))))
           (named (control &rest arguments)
             (intern (string-upcase (apply #'format nil control arguments)) :maxima)))
      (append (list (named "make-~a" name) (named "copy-~a" name))
              (unless (option :predicate) (list (named "~a-p" name)))
              (loop for slot in slots
                    collect (named "~a~a"
                                   (if (option :conc-name)
                                       (string (second (option :conc-name)))
                                       (format nil "~a-" name))
                                   (if (consp slot) (car slot) slot)))))))

(defun definitions-of (form)
  (when (consp form)
    (case (car form)
      ((defun defmacro defmspec defmfun defgeneric) (list (second form)))
      (defstruct (definitions-of-structure form))
      ((eval-when progn let) (mapcan #'definitions-of (cddr form))))))

(defun definitions-in (file)
  (with-open-file (in (core-pathname file))
    (let ((*package* (find-package :maxima)))
      (loop for form = (read in nil in) until (eq form in) append (definitions-of form)))))

(defun definitions-files ()
  (loop for (room) in *core-rooms*
        append (mapcar #'namestring
                       (directory (concatenate 'string *core-root* "src/" room "/*.lisp")))))

(defun $definitions_twice ()
  "[[name, file, file], ..] of names that two files define."
  (let ((seen (make-hash-table :test #'eq)) (twice '()))
    (dolist (file (definitions-files) (cons '(mlist simp) twice))
      (dolist (name (definitions-in file))
        (let ((other (gethash name seen)))
          (when (and other (not (equal other file)))
            (push (list '(mlist simp) (string name) other file) twice))
          (setf (gethash name seen) file))))))
