;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Solutions that differ at sight: of thousands of points each is compared with all others.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size"))

(defun $analysis_differ_at_sight (s other)
  "Whether the lists [x = .., ..] give different rational numbers to one of the names."
  (loop for (nil name value) in (cdr s)
        for number = (algebra-rational-number value)
        thereis (and number
                     (let ((there (find name (cdr other) :key #'cadr :test #'eq)))
                       (and there
                            (algebra-rational-number (caddr there))
                            (not (alike1 value (caddr there))))))))
