;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Read by Maxima at its start (-p): load("linmodel"), load("circuits") and load("analysis") are then found
;;; from any folder, and so are the archives of examples, last. The repository is the parent of this file's folder.

(in-package :maxima)

(let ((repository (make-pathname :name nil :type nil :version nil
                                 :directory (butlast (pathname-directory *load-pathname*))
                                 :defaults *load-pathname*)))
  (setq $file_search_maxima
        (append (list '(mlist) (concatenate 'string (namestring repository) "$$$.mac"))
                (rest $file_search_maxima)
                (list (concatenate 'string (namestring repository) "examples/$$$.txt")))))
