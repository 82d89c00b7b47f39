;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The first file a package loads: it finds the repository and loads parts on demand. A part is
;;; named by room and subject, "forms/lagrange"; it is loaded once, and again when kill() has removed
;;; it. The two files loaded from their text, cache and rooms, see to compiled Lisp.

(in-package :maxima)

(defvar *core-root* nil "Folder of the repository, as a string that ends in a slash.")
(defvar *core-loaded* (make-hash-table :test #'equal)
  "Part -> names of the Maxima functions it defined, or t for Lisp.")
(defvar *core-loading* #'funcall "Calls a function that loads a part: the watch waits for it.")
(defvar *core-archive* nil "The archive a call works on, while it runs.")

(setq *core-root*
      (let* ((file (or *load-truename* (truename *load-pathname*)))
             (name #+sbcl (sb-ext:native-namestring file) #-sbcl (namestring file))
             (end (search "src/core/boot." name :from-end t)))
        (subseq name 0 end)))

(defun core-pathname (name)
  "A pathname for NAME, in which no character is a wild card."
  #+sbcl (sb-ext:parse-native-namestring name)
  #-sbcl (pathname name))

(defun core-existing-file (name)
  (and (probe-file (core-pathname name)) name))

(defun core-environment (name)
  #+sbcl (sb-ext:posix-getenv name)
  #+gcl (si::getenv name)
  #+ecl (ext:getenv name)
  #-(or sbcl gcl ecl) (declare (ignore name)))

(defun core-process-id ()
  #+sbcl (funcall (intern "GETPID" (if (find-package "SB-POSIX") "SB-POSIX" "SB-UNIX")))
  #-sbcl (logand (get-internal-real-time) #xffffff))

(defun core-load-mac (source)
  "Loads Maxima text; its functions stay off the user's list `functions', so kill(all) leaves them.
Returns their names."
  (core-clean
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

;; What these do once or twice at a start costs less than to compile them.
(let (#+sbcl (sb-ext:*evaluator-mode* :interpret))
  (dolist (file '("rooms" "cache"))
    (load (core-pathname (format nil "~asrc/core/~a.lisp" *core-root* file)))))

(core-require "core/messages" "core/register" "core/guard" "core/watch" "core/faces")
#+sbcl (core-require "core/alarm")
