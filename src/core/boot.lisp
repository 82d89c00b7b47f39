;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The first file a package loads: it finds the repository, and loads from their text the files
;;; that load all others: the table of rooms, the cache of compiled Lisp, and parts.

(in-package :maxima)

(defvar *core-root* nil "Folder of the repository, as a string that ends in a slash.")

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

;; What the first two do once or twice at a start costs less than to compile them.
(flet ((load-core (file) (load (core-pathname (format nil "~asrc/core/~a.lisp" *core-root* file)))))
  (let (#+sbcl (sb-ext:*evaluator-mode* :interpret))
    (load-core "rooms")
    (load-core "cache"))
  (load-core "parts"))
