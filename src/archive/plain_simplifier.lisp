;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Maxima's simplifier made plain, for text that nobody vouches for: with its own defaults, and
;;; signs judged from the form of an expression alone, without factoring, without facts, and without
;;; a question. One order of terms and factors is made before it sees them: its own order is not
;;; always one (where 2^x*y*f(z) has its 2^x depends on what came first), and what is read and
;;; written again must come to rest. Look first at archive-with-plain-simplifier.

(in-package :maxima)

(defun archive-simplified (e)
  "E, a form whose arguments are simplified, after Maxima's simplifier."
  (simplifya e t))

(defun archive-inert (operator arguments)
  "OPERATOR at simplified ARGUMENTS, which stays as it stands."
  (list* (list operator 'simp) arguments))

(defmacro archive-with-plain-simplifier (&body body)
  "BODY, while Maxima simplifies with its default flags and judges signs by archive-plain-sign."
  `(let (($simp t) ($numer nil) ($float nil) ($keepfloat nil) ($bftorat nil) ($radexpand t)
         ($logexpand t) ($domain '$real) ($m1pbranch nil) ($%emode t) ($%enumer nil)
         ($demoivre nil) ($exponentialize nil) ($halfangles nil) ($triginverses t) ($trigsign t)
         ($%piargs t) ($%iargs t) ($negdistrib t) ($expop 0) ($expon 0) ($maxposex 1000)
         ($maxnegex 1000) ($logsimp t) ($lognegint nil) ($numer_pbranch nil) ($logarc nil)
         ($ratsimpexpons nil) ($listarith t) ($doallmxops t) ($ratprint nil) ($ratfac nil)
         ($algebraic nil))
     (archive-calling-plain-signs (lambda () ,@body))))

(defvar *archive-kindp* nil "Maxima's own kindp while signs are plain, else nil.")

(defun archive-plain-kindp (e property)
  (and (not (archive-users-name-p e)) (funcall *archive-kindp* e property)))

(defun archive-calling-plain-signs (function)
  "Calls FUNCTION while signs are those of archive-plain-sign, and nothing is known of names."
  (if *archive-kindp*
      (funcall function)
      (let ((functions (mapcar #'symbol-function *core-sign-functions*))
            (*archive-kindp* (symbol-function 'kindp)))
        (unwind-protect (progn (archive-put-plain-signs) (funcall function))
          (loop for name in *core-sign-functions* for old in functions
                do (setf (symbol-function name) old))))))

(defun archive-put-plain-signs ()
  (dolist (name *core-sign-functions*)
    (setf (symbol-function name)
          (if (eq name 'kindp) #'archive-plain-kindp #'archive-plain-sign))))

;;; Signs

(defun archive-users-name-p (e)
  "True for a name of which the session may have declared something: no constant, no function."
  (and e (symbolp e)
       (let ((name (symbol-name e)))
         (and (> (length name) 1) (char= (char name 0) #\$) (char/= (char name 1) #\%)))))

(defun archive-number-sign (number)
  (cond ((zerop1 number) '$zero)
        ((mnegp number) '$neg)
        (t '$pos)))

(defun archive-plain-sign (e)
  "The sign of E as its numbers show it: $pos, $neg, $zero, $pz, $complex where E may leave the
reals, or $pnz where they show nothing."
  (cond ((mnump e) (archive-number-sign e))
        ((member e '($%pi $%e $inf)) '$pos)
        ((eq e '$%i) '$complex)
        ((atom e) '$pnz)
        (t (case (caar e)
             (mexpt (archive-power-sign (cadr e) (caddr e)))
             (mtimes (archive-product-sign (cdr e)))
             (mabs '$pz)
             (%log (if (eq (archive-plain-sign (cadr e)) '$pos) '$pnz '$complex))
             ((%asin %acos) '$complex)
             (t '$pnz)))))

(defun archive-power-sign (base exponent)
  (let ((sign (archive-plain-sign base)))
    (cond ((eq sign '$complex) '$complex)
          ((eq (archive-plain-sign exponent) '$complex) '$complex)
          ((eq sign '$pos) (if (archive-plainly-real-p exponent) '$pos '$pnz))
          ((and (integerp exponent) (evenp exponent) (plusp exponent)
                (archive-plainly-real-p base)) '$pz)
          (t '$pnz))))

(defun archive-plainly-real-p (e)
  "True when E is real for real values of its names: no logarithm, root or function that may
leave the reals."
  (cond ((atom e) (not (eq e '$%i)))
        ((mnump e) t)
        (t (case (caar e)
             ((mplus mtimes %sin %cos %tan %sinh %cosh %tanh %atan mabs)
              (loop for part in (cdr e) always (archive-plainly-real-p part)))
             (mexpt (and (archive-plainly-real-p (cadr e))
                         (or (integerp (caddr e)) (eq (cadr e) '$%e))
                         (archive-plainly-real-p (caddr e))))
             (t nil)))))

(defun archive-product-sign (factors)
  (let ((signs (mapcar #'archive-plain-sign factors)))
    (cond ((member '$complex signs) '$complex)
          ((member '$pnz signs) '$pnz)
          ((member '$pz signs) (if (oddp (count '$neg signs)) '$nz '$pz))
          ((oddp (count '$neg signs)) '$neg)
          (t '$pos))))

;;; Order

(defun archive-compared (a b)
  "Negative, 0 or positive: numbers, then names, then forms by operator and parts."
  (cond ((eq a b) 0)
        ((and (realp a) (realp b)) (cond ((< a b) -1) ((> a b) 1) (t 0)))
        ((realp a) -1)
        ((realp b) 1)
        ((and (atom a) (atom b)) (archive-strings-compared (string a) (string b)))
        ((atom a) -1)
        ((atom b) 1)
        (t (let ((operators (archive-strings-compared (string (caar a)) (string (caar b)))))
             (if (zerop operators) (archive-lists-compared (cdr a) (cdr b)) operators)))))

(defun archive-strings-compared (a b)
  (cond ((string< a b) -1) ((string> a b) 1) (t 0)))

(defun archive-lists-compared (a b)
  (loop
    (cond ((null a) (return (if b -1 0)))
          ((null b) (return 1)))
    (let ((parts (archive-compared (pop a) (pop b))))
      (unless (zerop parts) (return parts)))))

(defun archive-ordered (list)
  (sort (copy-list list) (lambda (a b) (minusp (archive-compared a b)))))
