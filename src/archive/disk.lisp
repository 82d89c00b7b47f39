;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Files as the writer needs them: names in which no character is special, a rename that
;;; replaces, a lock, bytes that have reached the disk. A file is never changed in place: a whole
;;; new one takes its name, or nothing happens.
;;; Look first at archive-replace-file.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/bytes"))

;; Calls of the C library

#+sbcl
(defmacro archive-c-call (name result &rest arguments)
  "Calls the C function NAME; ARGUMENTS are (type value)."
  `(sb-alien:alien-funcall
    (sb-alien:extern-alien ,name (function ,result ,@(mapcar #'first arguments)))
    ,@(mapcar #'second arguments)))

(defun archive-rename (from to)
  "Gives the file FROM the name TO, replacing what is there; true when done."
  #+sbcl
  (zerop (archive-c-call "rename" sb-alien:int (sb-alien:c-string from) (sb-alien:c-string to)))
  #+gcl (si::rename from to)
  #+ecl (rename-file from to :if-exists t)
  #-(or sbcl gcl ecl) (rename-file from (make-pathname :type :unspecific :defaults to)))

(defun archive-unlink (name)
  #+sbcl (archive-c-call "unlink" sb-alien:int (sb-alien:c-string name))
  #+gcl (si::unlink name)
  #-(or sbcl gcl) (and (probe-file name) (delete-file name)))

(defun archive-may-write-p (name)
  "Whether the file NAME may be written as far as its mode says."
  #+sbcl (zerop (archive-c-call "access" sb-alien:int (sb-alien:c-string name) (sb-alien:int 2)))
  #-sbcl (progn name t))

(defun archive-hard-linked-p (name)
  "Whether the file NAME has another name as well: a new file in its place would split the two."
  #+sbcl (multiple-value-bind (found device inode mode links) (sb-unix:unix-stat name)
           (declare (ignore device inode mode))
           (and found (> links 1)))
  #-sbcl (zerop (core-shell-status
                 (format nil "test \"$(stat -L -c %h -- ~a)\" -gt 1 2>/dev/null"
                         (core-shell-quoted name)))))

(defun archive-copy-mode (from to)
  "Gives the file TO the permissions and, where it may be, the owner of FROM."
  #+sbcl (multiple-value-bind (found device inode mode links uid gid) (sb-unix:unix-stat from)
           (declare (ignore device inode links))
           (when found
             (archive-c-call "chown" sb-alien:int (sb-alien:c-string to)
                             (sb-alien:unsigned-int uid)
                             (sb-alien:unsigned-int gid))
             (archive-c-call "chmod" sb-alien:int (sb-alien:c-string to)
                             (sb-alien:unsigned-int (logand mode #o7777)))))
  #-sbcl (core-shell-status (format nil "chmod --reference=~a ~a 2>/dev/null"
                                       (core-shell-quoted from)
                                       (core-shell-quoted to))))

(defun archive-sync (stream)
  "What was written to STREAM is on the disk when this returns."
  (finish-output stream)
  #+sbcl (unless (zerop (archive-c-call "fsync" sb-alien:int
                                        (sb-alien:int (sb-sys:fd-stream-fd stream))))
           (error "the disk does not take it")))

(defun archive-process-number ()
  #+sbcl (archive-c-call "getpid" sb-alien:int)
  #+gcl (si::getpid)
  #-(or sbcl gcl) (get-universal-time))

(defun archive-ignore-size-limit ()
  "A file-size limit becomes an error of the stream; its signal, SIGXFSZ, would end SBCL."
  #+sbcl (sb-sys:enable-interrupt 25 :ignore))

;; Names

(defun archive-native-name (pathname)
  #+sbcl (sb-ext:native-namestring pathname)
  #-sbcl (namestring pathname))

(defun archive-folder (name)
  "The folder of the file NAME, with its last slash; \"\" for the working folder."
  (subseq name 0 (1+ (or (position #\/ name :from-end t) -1))))

(defun archive-followed (name)
  "The file that NAME is a link to, or NAME."
  (let ((true (ignore-errors (probe-file (archive-native-path name)))))
    (if true (archive-native-name true) name)))

;; A lock on the folder, so that writers take turns; the system releases it when a process dies

(defparameter *archive-lock-tries* 200
  "Tries, twenty in a second, before a writer goes on without the lock.")

(defvar *archive-locked* nil "True while this process has the lock on the folder it writes in.")

#+sbcl
(defun archive-flock (handle)
  "Tries for the lock on the open folder HANDLE; true when it is ours."
  (loop repeat *archive-lock-tries*
        thereis (zerop (archive-c-call "flock" sb-alien:int (sb-alien:int handle)
                                       (sb-alien:int 6)))
        do (sleep 0.05)))

(defun archive-lock (folder)
  "Two values: a handle of FOLDER to close afterwards, or nil, and whether its lock is ours."
  #+sbcl (let ((handle (archive-c-call "open" sb-alien:int
                                       (sb-alien:c-string (if (string= folder "") "." folder))
                                       (sb-alien:int #o2000000))))
           (if (minusp handle) (values nil nil) (values handle (archive-flock handle))))
  #-sbcl (progn folder (values nil nil)))

(defun archive-unlock (handle)
  #+sbcl (when handle (archive-c-call "close" sb-alien:int (sb-alien:int handle)))
  #-sbcl handle)

(defun archive-call-locked (name function)
  "Calls FUNCTION while no other writer of ours works in the folder of the file NAME."
  (multiple-value-bind (handle locked)
      (core-unhurried (lambda () (archive-lock (archive-folder name))))
    (unwind-protect (let ((*archive-locked* locked)) (funcall function))
      (archive-unlock handle))))

(defmacro archive-with-lock ((name) &body body)
  `(archive-call-locked ,name (lambda () ,@body)))

;; Replacing a file

(defvar *archive-drafts* 0 "Drafts written so far.")

(defun archive-draft-name (name)
  "A name for a draft in the folder of NAME: always the same under the lock, so that the draft of
a process that died is
taken away by the next one; else one that no other process has."
  (if *archive-locked*
      (format nil "~a.dynarch-draft" (archive-folder name))
      (format nil "~a.dynarch-~d-~d" (archive-folder name) (archive-process-number)
              (incf *archive-drafts*))))

(defmacro archive-or-fault (text &body body)
  "BODY; an error in it becomes one that says TEXT."
  `(handler-case (progn ,@body)
     (error () (core-error "~a" ,text))))

(defun archive-write-draft (draft bytes)
  "Writes BYTES to the new file DRAFT and makes sure that they arrived: not every Lisp reports a
full disk."
  (let ((out (archive-or-fault "no file can be made in its folder"
               (open (archive-native-path draft)
                     :direction :output :element-type '(unsigned-byte 8)
                                                 :if-exists :error :if-does-not-exist :create))))
    (archive-or-fault "the disk is full, or a limit on file sizes is reached"
      (let ((written nil))
        (unwind-protect (progn (write-sequence bytes out) (archive-sync out) (setf written t))
          (close out :abort (not written))))
      (unless (equalp bytes (archive-file-bytes draft)) (error "bytes are missing")))))

(defun archive-exists-p (name)
  #+gcl (and (si::stat name) t)
  #-gcl (and (probe-file (archive-native-path name)) t))

(defun archive-put-file (name bytes unchanged-p)
  "Gives the file NAME the content BYTES by way of a draft; nil, and no change, when UNCHANGED-P
says no at the end."
  (let ((draft (archive-draft-name name)) (done nil))
    (archive-unlink draft)
    (unwind-protect
         (progn
           (archive-write-draft draft bytes)
           (archive-copy-mode name draft)
           (when (funcall unchanged-p)
             (unless (archive-rename draft name) (core-error "the new file cannot take its name"))
             (setf done t)))
      (unless done (archive-unlink draft)))))

(defun archive-replace-file (name bytes &optional (unchanged-p (constantly t)))
  "The file NAME has BYTES as its content afterwards, or is what it was: nil when UNCHANGED-P
said no, else an error."
  (archive-ignore-size-limit)
  (when (> (length bytes) *archive-file-size*)
    (core-error "it would have ~d bytes, and archives of at most ~d bytes are read; ask for less, ~
                 such as fewer points, or give save = false"
                (length bytes) *archive-file-size*))
  (when (archive-exists-p name)
    (unless (archive-may-write-p name) (core-error "it is read-only"))
    (when (archive-hard-linked-p name)
      (core-error "the file has a second name (a hard link), and a new file would part the two; ~
                   make one of them a symbolic link, or give result = .. another file")))
  (core-unhurried (lambda () (archive-put-file name bytes unchanged-p))))
