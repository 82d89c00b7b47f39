;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Packages of Maxima's share, loaded where they are needed. The first load compiles one; another
;;; session that does so at the same time, for as long as it takes beside other work, leaves half a
;;; file to be read: then it is tried again, at last with files of its own.

(in-package :maxima)

(defun core-load-share (name there-p)
  "Whether the package NAME of Maxima's share is there, by THERE-P, once it has been loaded."
  (flet ((loaded ()
           (let* ((*standard-output* (make-broadcast-stream))
                  (*error-output* *standard-output*))
             (handler-bind ((warning #'muffle-warning))
               (core-attempt (lambda () (funcall *core-reading* (lambda () ($load name)))))))))
    (loop for (pause . own) in (if ($file_search name) '((0) (1) (3) (3 . t) (1 . t)) '((0)))
          until (funcall there-p)
          do (sleep pause)
             (core-unhurried (if own (lambda () (core-with-own-objects #'loaded)) #'loaded)))
    (funcall there-p)))

(defun core-with-own-objects (function)
  "Calls FUNCTION while what Maxima compiles goes into a folder that no other session knows."
  #-sbcl (funcall function)
  #+sbcl
  (let ((*maxima-objdir* (format nil "~a/dynarch~d-objects" $maxima_tempdir
                                 (sb-unix:unix-getpid))))
    (unwind-protect (funcall function)
      (ignore-errors (sb-ext:delete-directory (concatenate 'string *maxima-objdir* "/")
                                              :recursive t)))))
