;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What is seen at sight of two solutions [x = .., ..]: of thousands each is compared with all.

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

(defun $analysis_left_to_prove (other s)
  "Those equations x = .. of OTHER but such as stand in S, with values of names that S leaves free."
  (let ((given (mapcar #'cadr (cdr s))))
    (remove-if (lambda (equation)
                 (destructuring-bind (name value) (cdr equation)
                   (let ((there (find name (cdr s) :key #'cadr :test #'eq)))
                     (and there (alike1 value (caddr there))
                          (or (atom value) ($lfreeof (cons '(mlist) given) value))
                          (not (member value given :test #'eq))))))
               other :start 1)))
