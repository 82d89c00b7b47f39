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

(defun $register_wrong_parts ()
  "[function, part] of rules whose part does not define the function."
  (let ((defined (make-hash-table :test #'equal)))
    (flet ((names (part)
             (or (gethash part defined)
                 (setf (gethash part defined) (uses-part-defined (uses-read part))))))
      (cons '(mlist simp)
            (loop for rule in (register-rules)
                  for name = (core-spelling (rule-function rule))
                  unless (member name (names (rule-part rule)) :test #'string=)
                    collect (list '(mlist simp) name (rule-part rule)))))))

(defun register-parameters (function)
  "Two values: the least and the most number of arguments of FUNCTION."
  (let* ((mexpr (mget function 'mexpr))
         (list (if mexpr
                   (cdr (second mexpr))
                   #+sbcl (sb-kernel:%fun-lambda-list (fdefinition function))))
         (optional (position '&optional list)))
    (if optional (values optional (1- (length list))) (values (length list) (length list)))))

(defun $register_wrong_arity ()
  "[function, number of inputs] of rules whose function takes another number of arguments."
  (cons '(mlist simp)
        (loop for rule in (register-rules)
              for count = (length (rule-inputs rule))
              unless (and (core-rule-ready-p rule)
                          (multiple-value-bind (least most) (register-parameters (rule-function rule))
                            (<= least count most)))
                collect (list '(mlist simp) (rule-function rule) count))))

(defun register-known-names ()
  "Names of quantities, arguments, options, keys of the archive and what its reader marks."
  (append (mapcar #'first *archive-top-rows*)
          (loop for name being the hash-keys of *core-rules* collect name)
          (loop for public being the hash-values of *core-publics*
                append (core-public-options public)
                append (core-public-trailing public)
                append (loop for form in (core-public-forms public) append (cdr form)))
          (loop for kind in (core-kind-names)
                append (mapcar #'archive-key-name (archive-option-keys kind)))
          '("description" "form" "coordinates")))

(defun $register_unknown_inputs ()
  "[quantity, input] of rules that take what nothing gives."
  (let ((known (register-known-names)))
    (cons '(mlist simp)
          (loop for name being the hash-keys of *core-rules* using (hash-value rules)
                append (loop for rule in rules
                             append (loop for input in (archive-rule-sources rule)
                                          for wanted = (archive-input-name input)
                                          unless (member wanted known :test #'string=)
                                            collect (list '(mlist simp) name wanted)))))))

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

(defun register-calls-p (word line)
  "Whether LINE of Maxima calls the function WORD."
  (let ((place (search (concatenate 'string word "(") line)))
    (and place (or (zerop place)
                   (not (or (alphanumericp (char line (1- place))) (find (char line (1- place)) "_%")))))))

(defun $register_counting_sums ()
  "Maxima files of the parts that call sum or product: these evaluate their terms twice, and take a
name of the user that is that of the counter for the counter."
  (cons '(mlist simp)
        (loop for room in '("forms" "linmodel" "circuits" "analysis")
              append (loop for file in (directory (merge-pathnames "*.mac" (core-pathname (format nil "~asrc/~a/" *core-root* room))))
                           when (some (lambda (line) (or (register-calls-p "sum" line) (register-calls-p "product" line)))
                                      (uses-lines (uses-plain (uses-text (namestring file)))))
                             collect (pathname-name file)))))

(defun $register_texts_loaded ()
  "Maxima files of the parts that use a function of the share package stringproc."
  (cons '(mlist simp)
        (loop for (room) in *core-rooms*
              append (loop for file in (directory (merge-pathnames "*.mac" (core-pathname (format nil "~asrc/~a/" *core-root* room))))
                           when (some (lambda (line)
                                        (some (lambda (word) (search word line))
                                              '("stringp(" "simplode(" "charat(" "substring(" "ssearch(" "slength(")))
                                      (register-lines (namestring file)))
                             collect (pathname-name file)))))
