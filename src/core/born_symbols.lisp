;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Which of Maxima's own symbols have other properties than at birth. All of them, two and a half
;;; thousand, are asked at each call, so what is as it was is passed over in step, without a copy,
;;; and long values that Maxima only ever replaces are not read again while they are the same ones.

(in-package :maxima)

(defparameter *core-lasting-properties*
  '(data con +labs -labs ulabs cmark subc fact var obj wn mark noun verb)
  "Properties that are not hidden: those of the data base of facts, and the bond of noun and verb.")

(defparameter *core-replaced-properties* '(grad integral arg-list sp2)
  "Properties whose values Maxima replaces and does not write into.")

(defun core-born-properties (symbol)
  "What Maxima was born with; the second value tells whether SYMBOL is one of its own."
  (gethash symbol *builtin-symbol-props*))

(defun core-lasting-p (key) (member key *core-lasting-properties*))

(defun core-same-p (a b)
  "As equal; most parts are the same symbol, which is seen here without a call."
  (loop
    (cond ((eq a b) (return t))
          ((not (and (consp a) (consp b))) (return (equal a b)))
          ((or (eq (car a) (car b)) (core-same-p (car a) (car b))) (setq a (cdr a) b (cdr b)))
          (t (return nil)))))

(defun core-changed-p (symbol born)
  "Whether SYMBOL of Maxima has other properties than those with which it was BORN, lasting ones
apart."
  (loop with now = (symbol-plist symbol)
        while (or now born)
        do (cond ((and now born (eq (car now) (car born)) (core-same-p (cadr now) (cadr born)))
                  (setq now (cddr now) born (cddr born)))
                 ((and now (core-lasting-p (car now))) (setq now (cddr now)))
                 ((and born (core-lasting-p (car born))) (setq born (cddr born)))
                 (t (return t)))))

(defun core-properties-to-see (symbol)
  "The properties of SYMBOL at birth, a value that is replaced only as the one that it is now."
  (loop for (key value) on (core-born-properties symbol) by #'cddr
        for now = (get symbol key)
        append (list key (if (and (member key *core-replaced-properties*) (equal now value))
                             now
                             value))))

(defvar *core-born-symbols*
  (mapcar (lambda (symbol) (cons symbol (core-properties-to-see symbol))) *builtin-symbols*)
  "Maxima's symbols, each with its properties at birth.")

(defun core-changed-symbols ()
  "Those of Maxima's symbols of which core-changed-p holds."
  (loop for (symbol . born) in *core-born-symbols*
        when (core-changed-p symbol born) collect symbol))
