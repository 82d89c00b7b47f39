;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For the test of the register: what it promises, as lists that a test can compare.

(in-package :maxima)

(defun register-rules ()
  (loop for rules being the hash-values of *core-rules* append (remove-if-not #'rule-function rules)))

(defun $register_missing_functions ()
  "Pure functions that a rule names and no part defines."
  (cons '(mlist simp)
        (loop for rule in (register-rules)
              unless (ignore-errors (core-rule-ready-p rule))
                collect (format nil "~a in ~a" (core-spelling (rule-function rule)) (rule-part rule)))))

(defun $register_without_rule ()
  "Public functions that no rule serves."
  (cons '(mlist simp)
        (loop for public being the hash-keys of *core-publics*
              unless (gethash public *core-rules*) collect public)))

(defun $register_not_in_a_face ()
  "Public functions that no package lists."
  (cons '(mlist simp)
        (loop for public being the hash-keys of *core-publics*
              unless (fboundp (core-symbol public)) collect public)))
