;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Packages of Maxima's share, loaded where they are needed. The first load compiles one; another
;;; session that does so at the same time may leave half a file to be read, so that it is tried
;;; again.

(in-package :maxima)

(defun core-load-share (name there-p)
  "Whether the package NAME of Maxima's share is there, by THERE-P, once it has been loaded."
  (flet ((loaded ()
           (let* ((*standard-output* (make-broadcast-stream))
                  (*error-output* *standard-output*))
             (handler-bind ((warning #'muffle-warning))
               (core-attempt (lambda () (funcall *core-reading* (lambda () ($load name)))))))))
    (loop for pause in (if ($file_search name) '(0 1 3 10) '(0))
          until (funcall there-p)
          do (sleep pause)
             (core-unhurried #'loaded))
    (funcall there-p)))
