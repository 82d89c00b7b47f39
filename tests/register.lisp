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

(defun register-lines (name)
  (with-open-file (in (core-pathname name)) (loop for line = (read-line in nil) while line collect line)))

(defun $register_texts_loaded ()
  "Maxima files of the parts that use a function of the share package stringproc."
  (cons '(mlist simp)
        (loop for room in '("forms" "linmodel" "circuits" "analysis")
              append (loop for file in (directory (merge-pathnames "*.mac" (core-pathname (format nil "~asrc/~a/" *core-root* room))))
                           when (some (lambda (line)
                                        (some (lambda (word) (search word line))
                                              '("stringp(" "simplode(" "charat(" "substring(" "ssearch(" "slength(")))
                                      (register-lines (namestring file)))
                             collect (pathname-name file)))))
