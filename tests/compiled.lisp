;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Loads Lisp of the tests that is called too often to be interpreted: compiled, into the folder in
;;; which the suite runs.

(in-package :maxima)

(defun $load_compiled (name)
  (let ((draft (format nil "~a.~a" (subseq name 0 (position #\. name))
                       (pathname-type (compile-file-pathname "x.lisp")))))
    (core-quietly
     (lambda ()
       (load (if (core-compiler-p)
                 (compile-file (core-pathname (format nil "~atests/~a" *core-root* name))
                               :output-file (merge-pathnames draft))
                 (core-pathname (format nil "~atests/~a" *core-root* name))))))
    '$done))
