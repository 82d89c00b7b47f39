;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Read at the start of the Maxima that tools/maxima starts, which says where the repository is:
;;; load("linmodel"), load("circuits") and load("analysis") are then found from any folder.

(in-package :maxima)

(setq $file_search_maxima
      (list* '(mlist)
             (concatenate 'string (maxima-getenv "DYNARCH_REPOSITORY") "/$$$.mac")
             (rest $file_search_maxima)))
