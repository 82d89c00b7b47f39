;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Read at the start of the Maxima that tools/maxima starts, which says where the repository is:
;;; load("linmodel"), load("circuits") and load("analysis") are then found from any folder, and so are, last, the
;;; archives of examples that the manual uses.

(in-package :maxima)

(let ((repository (maxima-getenv "DYNARCH_REPOSITORY")))
  (setq $file_search_maxima
        (append (list '(mlist) (concatenate 'string repository "/$$$.mac"))
                (rest $file_search_maxima)
                (list (concatenate 'string repository "/examples/$$$.txt")))))

;; Young data is collected every 64 MB, or as before where the heap is small: pages that are used again need not be
;; fetched, which was a tenth of the time of a first call, and less memory is taken.
#+sbcl (when (< (* 64 1024 1024) (sb-ext:bytes-consed-between-gcs))
         (setf (sb-ext:bytes-consed-between-gcs) (* 64 1024 1024))
         (sb-ext:gc :gen 0)) ; from here on
