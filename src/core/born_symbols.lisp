;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Which of Maxima's own symbols have other properties than at birth. All of them, two and a half
;;; thousand, are asked at each call, so what is as it was is passed over in step, without a copy,
;;; and long values that Maxima only ever replaces are not read again while they are the same ones.
;;; Look first at core-changed-symbols.

(in-package :maxima)

(defparameter *core-lasting-properties*
  '(data con +labs -labs ulabs cmark subc fact var obj wn mark noun verb)
  "Properties that are not hidden: those of the data base of facts, and the bond of noun and verb.")

(defparameter *core-replaced-properties*
  '(grad integral arg-list sp2 mexpr distribute_over exp-form dissym texsym)
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

(defun core-in-step-p (plist born)
  "Whether PLIST has what the vector BORN has behind its first place, in the same order. (Half of
what an empty call takes is spent here: so the declarations.)"
  (declare (type list plist) (type simple-vector born) (optimize (speed 3) (safety 0)))
  (loop for k of-type fixnum from 1 below (length born)
        do (let ((value (svref born k)))
             (unless (and plist (or (eq (car plist) value) (core-same-p (car plist) value)))
               (return nil))
             (setq plist (cdr plist)))
        finally (return (null plist))))

(defun core-changed-p (now born)
  "Whether the properties NOW are others than those BORN with, lasting ones apart."
  (loop while (or now born)
        do (cond ((and now born (eq (car now) (car born)) (core-same-p (cadr now) (cadr born)))
                  (setq now (cddr now) born (cddr born)))
                 ((and now (core-lasting-p (car now))) (setq now (cddr now)))
                 ((and born (core-lasting-p (car born))) (setq born (cddr born)))
                 (t (return t)))))

(defun core-properties-to-see (born now)
  "The properties BORN; where there is nothing else to see, their values are the very ones NOW."
  (loop for (key value) on born by #'cddr
        for present = (getf now key)
        append (list key (cond ((core-lasting-p key) present)
                               ((eq key 'mprops)
                                (cons (car value)
                                      (core-properties-to-see (cdr value) (cdr present))))
                               ((and (member key *core-replaced-properties*)
                                     (equal present value))
                                present)
                               (t value)))))

(defun core-in-storage-order (symbols)
  "SYMBOLS in the order in which they lie in memory, where the Lisp tells: so they are read sooner."
  #+sbcl (sort (copy-list symbols) #'< :key #'sb-kernel:get-lisp-obj-address)
  #-sbcl symbols)

(defvar *core-born-symbols*
  (mapcar (lambda (symbol)
            (coerce (cons symbol (core-properties-to-see (core-born-properties symbol)
                                                         (symbol-plist symbol)))
                    'simple-vector))
          (core-in-storage-order *builtin-symbols*))
  "A vector of each of Maxima's symbols and its properties at birth, keys and values in turn.")

(defun core-changed-symbols ()
  "Those of Maxima's symbols of which core-changed-p holds."
  (loop for born in *core-born-symbols*
        for symbol = (svref born 0)
        unless (or (core-in-step-p (symbol-plist symbol) born)
                   (not (core-changed-p (symbol-plist symbol) (cdr (coerce born 'list)))))
          collect symbol))
