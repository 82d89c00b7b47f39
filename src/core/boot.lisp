;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The first file a package loads: it finds the repository, keeps compiled Lisp in the user's
;;; cache, and loads parts on demand. A part is named by room and subject, "forms/lagrange"; it is
;;; loaded once, and again when kill() has removed it. Compiled files are keyed by Lisp, Maxima and
;;; the text of the rooms a part is built from, so a stale one is never used.

(in-package :maxima)

(defvar *core-root* nil "Folder of the repository, as a string that ends in a slash.")
(defvar *core-loaded* (make-hash-table :test #'equal)
  "Part -> names of the Maxima functions it defined, or t for Lisp.")
(defvar *core-room-keys* (make-hash-table :test #'equal) "Room -> digest of its Lisp sources.")
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
  #-(or sbcl gcl) (declare (ignore name)))

(defun core-process-id ()
  #+sbcl (funcall (intern "GETPID" (if (find-package "SB-POSIX") "SB-POSIX" "SB-UNIX")))
  #-sbcl (logand (get-internal-real-time) #xffffff))

(defun core-cache-folder ()
  "Where compiled parts are kept: one folder a Lisp and a Maxima; nil where the user has no home."
  (let* ((given (core-environment "XDG_CACHE_HOME"))
         (home (core-environment "HOME"))
         (base (cond ((and given (plusp (length given))) given)
                     ((and home (plusp (length home))) (concatenate 'string home "/.cache")))))
    (and base
         (format nil "~a/dynarch/lisp/~a/" (string-right-trim "/" base)
                 (substitute-if #\_ (lambda (c) (not (or (alphanumericp c) (find c ".-"))))
                                (format nil "~a-~a-maxima-~a" (lisp-implementation-type)
                                        (lisp-implementation-version) *autoconf-version*))))))

(defun core-digest-file (name key)
  "KEY carried on over the lines of the file NAME."
  (with-open-file (in (core-pathname name))
    (loop for line = (read-line in nil) while line
          do (setq key (logand #xfffffffffffffff (+ (* 31 key) (sxhash line) 7))))
    key))

(defun core-room-files (room)
  (sort (mapcar #'namestring
                (directory (merge-pathnames "*.lisp" (core-pathname
                                               (format nil "~asrc/~a/" *core-root* room)))))
        #'string<))

(defun core-room-key (room)
  (or (gethash room *core-room-keys*)
      (setf (gethash room *core-room-keys*)
            (let ((key 1))
              (dolist (file (core-room-files room) key)
                (setq key (core-digest-file file key)))))))

(defun core-part-key (room)
  "A digest of all Lisp text that a part of ROOM may be built from: its own room, the core and the
algebra."
  (let ((key 17))
    (dolist (name (remove-duplicates
                   (list "core" (if (equal room "archive") "core" "algebra") room) :test #'equal)
                  key)
      (setq key (logand #xfffffffffffffff (+ (* 131 key) (core-room-key name)))))))

(defun core-quietly (function)
  "Calls FUNCTION with compiler chatter switched off."
  (let ((*standard-output* (make-broadcast-stream)) (*error-output* (make-broadcast-stream))
        (*compile-verbose* nil) (*compile-print* nil) (*load-verbose* nil)
        (*merror-signals-$error-p* t)
        #+gcl (compiler::*cc* (concatenate 'string compiler::*cc* " -w")))
    (handler-bind ((warning #'muffle-warning)) (funcall function))))

(defun core-compile-to (source target)
  "Compiles SOURCE under a name of this process alone, then renames: other processes see a whole
file or none."
  (ignore-errors
   (ensure-directories-exist (core-pathname target))
   (let* ((draft (format nil "~a.~a.~a" (subseq target 0 (position #\. target :from-end t))
                         (core-process-id)
                         (pathname-type (compile-file-pathname "x.lisp"))))
          (made (core-quietly (lambda () (compile-file (core-pathname source)
                                                       :output-file (core-pathname draft))))))
     (when made (rename-file made (core-pathname target)))
     target)))

(defun core-compiler-p ()
  "Whether Lisp can be compiled here: GCL needs the C compiler it was built with, which a
distribution may leave out."
  #-gcl t
  #+gcl (let* ((command (string-left-trim " " compiler::*cc*))
               (name (subseq command 0 (position #\Space command))))
          (some (lambda (folder) (probe-file (concatenate 'string folder name)))
                '("" "/usr/bin/" "/usr/local/bin/" "/bin/"))))

(defun core-load-lisp (part source)
  (let* ((room (subseq part 0 (position #\/ part)))
         (folder (core-cache-folder))
         (target (and folder
                      (format nil "~a~a-~36r.~a" folder (substitute #\- #\/ part)
                              (core-part-key room)
                              (pathname-type (compile-file-pathname "x.lisp")))))
         (compiled (and target (or (core-existing-file target)
                                   (and (core-compiler-p) (core-compile-to source target)
                                        (core-existing-file target))))))
    (unless (and compiled
                 (ignore-errors (core-quietly (lambda () (load (core-pathname compiled)))) t))
      (load (core-pathname source)))
    t))

(defun core-load-mac (source)
  "Loads Maxima text; its functions stay off the user's list `functions', so kill(all) leaves them.
Returns their names."
  (let (($functions (list '(mlist simp))) ($values (copy-list $values)) ($load_pathname nil))
    ($batchload (core-pathname source))
    (mapcar #'caar (cdr $functions))))

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

(core-require "core/messages" "core/register" "core/guard" "core/watch" "core/faces")
#+sbcl (core-require "core/alarm")
