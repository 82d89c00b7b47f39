;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Loads parts on demand. A part is named by room and subject, "forms/lagrange"; it is loaded once,
;;; and again when kill() has removed it. Lisp comes from the cache of compiled files.

(in-package :maxima)

(defvar *core-loaded* (make-hash-table :test #'equal)
  "Part -> names of the Maxima functions it defined, or t for Lisp.")
(defvar *core-loading* #'funcall "Calls a function that loads a part: the watch waits for it.")
(defvar *core-reading* #'funcall
  "What calls a function that reads Maxima text, so that it is read under Maxima's own grammar.")

(defun core-load-mac (source)
  "Loads Maxima text; its functions stay off the user's list `functions', so kill(all) leaves them.
Returns their names."
  (funcall
   *core-reading*
   (lambda ()
     (let (($functions (list '(mlist simp))) ($values (copy-list $values)) ($load_pathname nil))
       ($batchload (core-pathname source))
       (mapcar #'caar (cdr $functions))))))

(defun core-part-alive (part)
  (let ((names (gethash part *core-loaded*)))
    (if (consp names) (every (lambda (name) (mget name 'mexpr)) names) names)))

(defun core-loaded-unwatched (part source)
  "Loads SOURCE; a call that needs it is not stopped meanwhile."
  (flet ((loaded ()
           (let ((lisp (core-existing-file (concatenate 'string source "lisp"))))
             (or (if lisp
                     (core-load-lisp part lisp)
                     (core-load-mac (concatenate 'string source "mac")))
                 t))))
    (funcall *core-loading* #'loaded)))

(defun core-require (&rest parts)
  "Loads those of PARTS that are not there."
  (dolist (part parts)
    (unless (core-part-alive part)
      (setf (gethash part *core-loaded*) t)
      (let ((source (format nil "~asrc/~a." *core-root* part)) (done nil))
        (unwind-protect
             (setf (gethash part *core-loaded*) (core-loaded-unwatched part source)
                   done t)
          (unless done (remhash part *core-loaded*)))))))

(defun $core_require (&rest parts)
  (apply #'core-require parts)
  '$done)

(core-require "core/messages" "core/sizes" "core/records" "core/register" "core/guard" "core/watch"
              "core/faces")
#+sbcl (core-require "core/alarm")
