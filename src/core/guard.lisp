;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The guard around every computation: a clean session, facts in a context of their own, no
;;; question asked; and everything as it was afterwards, errors included.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/session" "core/facts"))

(defvar *core-guarded* nil "True inside the guard.")

(defparameter *core-sign-functions* '($sign $csign $asksign kindp)
  "Functions of Maxima that know what was assumed or declared, or ask: others stand for them while
an archive is read.")

;; In a saved core SBCL calls functions by their place. The first time that one is replaced it looks
;; through all code for such calls, 5 ms each: at the start, not in somebody's first call.
#+sbcl (dolist (name (cons 'retrieve *core-sign-functions*))
         (setf (symbol-function name) (symbol-function name)))

(defun core-refuse-question (message &rest ignored)
  (declare (ignore ignored))
  (merror "~A" (format nil "undecided question: ~a"
                       (remove #\Newline (core-words (if (and (consp message) (consp (car message)))
                                                         (cdr message)
                                                         (list message)))))))

(defun core-without-questions (function)
  "Calls FUNCTION; where Maxima would ask the person something, an error is signalled instead."
  (let ((asking (symbol-function 'retrieve)))
    (unwind-protect (progn (setf (symbol-function 'retrieve) #'core-refuse-question)
                           (funcall function))
      (setf (symbol-function 'retrieve) asking))))

(defun core-guarded (facts function)
  "The value of FUNCTION in a clean session with FACTS."
  (if *core-guarded*
      (funcall function)
      (let ((*core-guarded* t))
        (core-clean (lambda ()
                      (core-without-questions (lambda () (core-with-facts facts function))))))))

(defun core-failure-text (condition)
  "What to tell the person of a Lisp error."
  (format nil
          "~@[~a: ~]the computation failed inside (~a); please report it with the input that ~
           shows it"
          *core-function*
          (remove #\Newline (princ-to-string condition))))

(defun core-caught (function)
  "Two values: what FUNCTION returns, and nil or the text of the error that ended it. Maxima's own
bindings are undone."
  (let ((text nil) (values nil) (*merror-signals-$error-p* t) (errcatch (cons bindlist loclist)))
    (declare (special errcatch))
    (handler-case
        (setq values (catch 'core-throw (with-errcatch-tag-$errors (funcall function))))
      (maxima-$error () (setq text (core-error-text)))
      #+sbcl (sb-sys:interactive-interrupt (c) (errlfun1 errcatch) (error c))
      #+sbcl (storage-condition ()
               (setq text (format nil "~@[~a: ~]memory is exhausted; give Maxima a larger heap, ~
                                       or a smaller system" *core-function*)))
      (error (condition) (setq text (core-failure-text condition))))
    (when text (errlfun1 errcatch))
    (values values text)))

(defparameter *core-no-value*
  '("0 to a negative exponent" "encountered log(0)" "atan2(0,0) is undefined" "ivision by 0"
    "ivision by zero" "0^0")
  "What Maxima says where a formula has no value.")

(defun core-maximas-text ()
  "What Maxima says of its own error; of a formula without value more than that."
  (let ((text (string-right-trim '(#\Newline #\Space)
                                 (with-output-to-string (*standard-output*) ($errormsg)))))
    (if (some (lambda (words) (search words text)) *core-no-value*)
        (format nil "a formula has no value on the way (~a); see whether all functions are ~
                     defined at the values that are given or assumed" (string-right-trim "." text))
        text)))

(defun core-error-text ()
  "The text of Maxima's last error, with the name of the function before it."
  (let* ((text (cond ((not (and (cdr $error) (stringp (cadr $error)))) "unknown error")
                     ((and (equal (cadr $error) "~A") (stringp (caddr $error))) (caddr $error))
                     (t (core-maximas-text))))
         (prefix (and *core-function* (concatenate 'string *core-function* ": "))))
    (if (and prefix (not (eql (search prefix text) 0))) (concatenate 'string prefix text) text)))
