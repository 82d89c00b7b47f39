;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Compiled Lisp in the user's cache. A compiled file runs with the user's rights, so it is loaded
;;; only where nobody else can have written it: the file and our folders above it belong to the
;;; effective user, are no links, and no one else may write there. Else Lisp is compiled in memory
;;; and one line says why. Files are keyed by Lisp, Maxima and the text of all rooms that a part may
;;; be built from, so a stale one is never used; one that cannot be loaded is made anew.

(in-package :maxima)

(defvar *core-room-keys* (make-hash-table :test #'equal) "Room -> digest of its Lisp sources.")
(defvar *core-part-keys* (make-hash-table :test #'equal)
  "Room -> digest of the sources of all rooms that it may use, its own too.")
(defvar *core-cache* :unknown "Folder of compiled files that can be trusted, or nil.")

(defun core-say-uncached (control &rest arguments)
  "One line on why no compiled file is used."
  (format t "~&dynarch: compiled in memory, at every start anew: ~?~%" control arguments)
  nil)

;;; Whose are they

#-sbcl
(defun core-shell-quoted (name)
  "NAME between single quotes, as the shell takes it literally."
  (with-output-to-string (out)
    (write-char #\' out)
    (loop for c across name do (if (char= c #\') (write-string "'\\''" out) (write-char c out)))
    (write-char #\' out)))

#-sbcl
(defun core-shell-status (command)
  "The exit status of a command of the shell. (For Lisps that cannot ask about files.)"
  #+gcl (let ((status (si::system command))) (if (consp status) (car status) status))
  #+ecl (ash (ext:system command) -8)
  #-(or gcl ecl) (nth-value 2 (uiop:run-program command :ignore-error-status t)))

#-sbcl
(defun core-shell (control &rest names)
  "Whether the shell command CONTROL ends well; NAMES are put in quoted."
  (eql 0 (core-shell-status
          (apply #'format nil control (mapcar #'core-shell-quoted names)))))

#+sbcl
(defvar *core-effective-user*
  (sb-alien:alien-funcall
   (sb-alien:extern-alien "geteuid" (function sb-alien:unsigned-int))))

#+sbcl
(defun core-own-p (name kind &optional base)
  "Whether NAME is of KIND, a directory or a file, and only the effective user may write there. A
BASE may be a link, root's, or one of the folders where everybody may write but only remove what is
his own."
  (multiple-value-bind (found device inode mode links user)
      (if base (sb-unix:unix-stat name) (sb-unix:unix-lstat name))
    (declare (ignore device inode links))
    (and found
         (= (logand mode #o170000) (ecase kind (:folder #o040000) (:file #o100000)))
         (or (= user *core-effective-user*) (and base (zerop user)))
         (or (zerop (logand mode #o022)) (and base (logtest mode #o1000))))))

#-sbcl
(defun core-own-p (name kind &optional base)
  (core-shell
   (format nil "test -n \"$(find ~@[-H~*~] ~~a -maxdepth 0 -type ~a \\( -user \"$(id -u)\" ~
                ~@[-o -user 0~*~] \\) \\( ! -perm /022 ~@[-o -perm -1000~*~] \\))\""
           base (ecase kind (:folder "d") (:file "f")) base base)
   name))

(defun core-trusted-file-p (name)
  #+sbcl (core-own-p name :file)
  ;; Elsewhere the files were looked at together with their folder.
  #-sbcl (and (core-existing-file name) t))

#-sbcl
(defun core-own-files-p (folder)
  (core-shell "test -z \"$(find ~a -maxdepth 1 \\( ! -user \"$(id -u)\" -o -type l -o ~
               -perm /022 \\))\""
              folder))

;;; Where they are kept

(defun core-cache-base ()
  "The folder that holds caches of the user; nil where he has no home."
  (flet ((given (name)
           (let ((text (core-environment name))) (and text (plusp (length text)) text))))
    (or (given "XDG_CACHE_HOME")
        (and (given "HOME") (concatenate 'string (given "HOME") "/.cache")))))

(defun core-cache-folders (base)
  "Our folders in BASE, each in the one before: the last one is of one Lisp and one Maxima."
  (let ((system (substitute-if
                 #\_ (lambda (c) (not (or (alphanumericp c) (find c ".-"))))
                 (format nil "~a-~a-maxima-~a" (lisp-implementation-type)
                         (lisp-implementation-version) *autoconf-version*)))
        (folder (string-right-trim "/" base)))
    (loop for name in (list "dynarch" "lisp" system)
          collect (setq folder (concatenate 'string folder "/" name)))))

(defun core-make-folder (name)
  (or (core-existing-folder name)
      #+sbcl (sb-unix:unix-mkdir name #o700)
      #-sbcl (core-shell "mkdir -p -m 700 ~a" name)))

(defun core-existing-folder (name)
  #+sbcl (sb-unix:unix-lstat name)
  #-sbcl (core-shell "test -e ~a" name))

(defun core-checked-folder (base)
  "The folder of compiled files in BASE, made where it is missing, or nil and a line that says why."
  (let ((folders (core-cache-folders base)))
    (unless (core-existing-folder base)
      (ensure-directories-exist (core-pathname (concatenate 'string base "/"))
                                #+sbcl :mode #+sbcl #o700))
    (cond #-sbcl
          ((find-if (lambda (c) (find c "[]*?{}\\~")) base)
           (core-say-uncached "~a has letters in its name that mean others to Lisp" base))
          ((not (core-own-p base :folder t)) (core-say-foreign base))
          ((notevery #'core-make-folder folders)
           (core-say-uncached "~a cannot be written" base))
          ((find-if-not (lambda (name) (core-own-p name :folder)) folders)
           (core-say-foreign
            (find-if-not (lambda (name) (core-own-p name :folder)) folders)))
          #-sbcl
          ((not (core-own-files-p (car (last folders))))
           (core-say-foreign (car (last folders))))
          (t (concatenate 'string (car (last folders)) "/")))))

(defun core-say-foreign (name)
  (core-say-uncached "~a is not yours alone; others may write in it, it is another user's, or a ~
                      link. Remove it, or set XDG_CACHE_HOME to a folder of your own" name))

(defun core-cache-folder ()
  "Where compiled parts are kept, with a slash at its end, or nil."
  (when (eq *core-cache* :unknown)
    (let ((base (core-cache-base)))
      (setq *core-cache*
            (if base
                (core-checked-folder base)
                (core-say-uncached "HOME is not set; set HOME or XDG_CACHE_HOME")))))
  *core-cache*)

;;; How they are called

(defun core-digest-file (name key)
  "KEY carried on over the text of the file NAME."
  (flet ((carried (key text) (logand #xfffffffffffffff (+ (* 31 key) (sxhash text) 7))))
    #+sbcl ; one call of Lisp's own for the whole text: nothing here is compiled at this point
    (with-open-file (in (core-pathname name) :external-format :latin-1)
      (let ((text (make-string (file-length in))))
        (read-sequence text in)
        (carried key text)))
    #-sbcl ; elsewhere only the first letters of a long text may count
    (with-open-file (in (core-pathname name))
      (loop for line = (read-line in nil) while line do (setq key (carried key line)))
      key)))

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
  "A digest of all Lisp text that a part of ROOM may be built from."
  (or (gethash room *core-part-keys*)
      (let ((key 17))
        (dolist (name (core-rooms-used room))
          (setq key (logand #xfffffffffffffff (+ (* 131 key) (core-room-key name)))))
        (setf (gethash room *core-part-keys*) key))))

(defun core-compiled-name (part folder)
  (format nil "~a~a-~36r.~a" folder (substitute #\- #\/ part)
          (core-part-key (subseq part 0 (position #\/ part)))
          (pathname-type (compile-file-pathname "x.lisp"))))

;;; Making and loading them

(defun core-quietly (function)
  "Calls FUNCTION with compiler chatter switched off."
  (let ((*standard-output* (make-broadcast-stream)) (*error-output* (make-broadcast-stream))
        (*compile-verbose* nil) (*compile-print* nil) (*load-verbose* nil)
        (*merror-signals-$error-p* t)
        #+gcl (compiler::*cc* (concatenate 'string compiler::*cc* " -w")))
    (handler-bind ((warning #'muffle-warning)) (funcall function))))

(defun core-keep-to-user (name)
  "Takes from others the right to write the file NAME, which they have where the user's mask gives
it to them."
  #+sbcl (sb-alien:alien-funcall
          (sb-alien:extern-alien "chmod" (function sb-alien:int sb-alien:c-string
                                                   sb-alien:unsigned-int))
          name #o600)
  #-sbcl (core-shell "chmod 600 ~a" name))

(defun core-compile-to (source target)
  "Compiles SOURCE under a name of this process alone, then renames: other processes see a whole
file or none. Returns TARGET where that succeeds."
  (ignore-errors
   (let* ((draft (format nil "~a.~a.~a" (subseq target 0 (position #\. target :from-end t))
                         (core-process-id)
                         (pathname-type (compile-file-pathname "x.lisp"))))
          (made (core-quietly (lambda () (compile-file (core-pathname source)
                                                       :output-file (core-pathname draft))))))
     (when made
       (core-keep-to-user draft)
       (rename-file made (core-pathname target))
       (and (core-trusted-file-p target) target)))))

(defun core-compiler-p ()
  "Whether Lisp can be compiled here: GCL needs the C compiler it was built with, which a
distribution may leave out."
  #-gcl t
  #+gcl (let* ((command (string-left-trim " " compiler::*cc*))
               (name (subseq command 0 (position #\Space command))))
          (some (lambda (folder) (probe-file (concatenate 'string folder name)))
                '("" "/usr/bin/" "/usr/local/bin/" "/bin/"))))

(defun core-load-compiled (file)
  (and file (ignore-errors (core-quietly (lambda () (load (core-pathname file)))) t)))

(defun core-load-lisp (part source)
  "Loads the Lisp text SOURCE of PART, compiled."
  (let* ((folder (core-cache-folder))
         (target (and folder (core-compiled-name part folder))))
    (or (and target (core-trusted-file-p target) (core-load-compiled target))
        (and target (core-compiler-p) (core-load-compiled (core-compile-to source target)))
        (core-quietly (lambda () (load (core-pathname source)))))
    t))
