;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For tests/fuzz_names.mac: the names that our own functions bind, taken from the functions themselves, and expressions
;;; with other names, simplified anew.

(in-package :maxima)

(core-require "archive/dispatch")

(defun fuzz-parts ()
  "All parts of the rooms that are Maxima text."
  (loop for path in (directory (merge-pathnames "*/*.mac" (core-pathname (concatenate 'string *core-root* "src/"))))
        for name = (namestring path)
        for end = (search "/src/" name :from-end t)
        collect (subseq name (+ end 5) (- (length name) 4))))

(defun fuzz-bound-names (e)
  "Names that are bound in the Maxima function or form E: locals of blocks, parameters, variables of loops and lists."
  (cond ((atom e) '())
        ((not (consp (car e))) (mapcan #'fuzz-bound-names (copy-list e)))
        (t (append (case (caar e)
                     ((lambda mprog) (mapcar (lambda (x) (if (atom x) x (second x)))
                                             (and (consp (cadr e)) (cdadr e))))
                     ((mdo mdoin) (list (cadr e)))
                     (($makelist $create_list $sum $product) (list (caddr e))))
                   (mapcan #'fuzz-bound-names (copy-list (cdr e)))))))

(defun fuzz-ordinary-p (name)
  "Whether a person can have NAME as a parameter."
  (and (archive-symbol-p name) (not (boundp name)) (not (eq name '$t)) (not (mget name '$numer))
       (not (member (core-spelling name) *archive-keywords* :test #'string=))))

(defun $fuzz_local_names ()
  "The names that functions of our rooms bind, sorted."
  (let ((names '()))
    (dolist (part (fuzz-parts))
      (core-require part)
      (let ((functions (gethash part *core-loaded*)))
        (when (consp functions)
          (dolist (function functions)
            (setq names (union names (fuzz-bound-names (mget function 'mexpr))))))))
    (cons '(mlist simp)
          (sort (remove-if-not #'fuzz-ordinary-p (remove-duplicates names)) #'string< :key #'core-spelling))))

(defun $fuzz_function_name_p (name) (not (archive-maxima-function-p (core-spelling name))))

(defun fuzz-renamed (e names)
  (cond ((symbolp e) (or (cdr (assoc e names)) e))
        ((atom e) e)
        (t (cons (cons (or (cdr (assoc (caar e) names)) (caar e)) (remove 'simp (cdar e)))
                 (mapcar (lambda (part) (fuzz-renamed part names)) (cdr e))))))

(defun $fuzz_renamed (e equations)
  "E with the right sides of EQUATIONS for the left ones, all at once, heads of functions too."
  (resimplify (fuzz-renamed e (loop for (nil old new) in (cdr equations) collect (cons old new)))))

(defun fuzz-names (e)
  (cond ((archive-symbol-p e) (list e))
        ((atom e) '())
        (t (reduce #'union (mapcar #'fuzz-names (cdr e)) :initial-value '()))))

(defun $fuzz_names_in (e)
  (cons '(mlist simp) (sort (fuzz-names e) #'string< :key #'core-spelling)))

(defun $fuzz_call (name arguments)
  "A list of the value of the public function NAME, or the text of its error."
  (let ((*merror-signals-$error-p* t) ($errormsg nil))
    (handler-case (list '(mlist simp) (apply (core-symbol name) (cdr arguments)))
      (maxima-$error () (core-error-text)))))
