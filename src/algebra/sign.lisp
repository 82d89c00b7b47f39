;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The sign of an expression from the facts of the current context, never asking: numbers exactly,
;;; products by their factors, sums by their terms, and by facts x > u put in as x = u + d, d > 0.
;;; What is not proved is unknown.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/zero" "algebra/interval"))

(defvar *algebra-signs* nil "signs of symbols found during one call: (symbol . sign), ..")

(defun $algebra_sign (e)
  "pos, neg, zero, pz (>= 0), nz (<= 0), pn (not zero) or unknown."
  (let* ((*algebra-signs* nil)
         (sign (algebra-part-sign e)))
    (if (member sign '($pos $neg $zero))
        sign
        (algebra-sign (algebra-normal-form e)))))

(defun $algebra_positive (e)
  "true, false or unknown"
  (case ($algebra_sign e)
    ($pos t)
    (($neg $zero $nz) nil)
    (t '$unknown)))

(defun algebra-sign (e)
  (if ($constantp e)
      (algebra-constant-sign e)
      (algebra-first-answer
       (list #'algebra-simple-sign #'algebra-factored-sign #'algebra-shifted-sign
             #'algebra-not-zero-sign)
       e)))

(defun algebra-first-answer (methods e)
  "The first exact sign, else the strongest half answer."
  (let ((answer '$unknown))
    (dolist (method methods answer)
      (let ((sign (funcall method e)))
        (case sign
          (($pos $neg $zero) (return sign))
          ($unknown)
          (t (setq answer (algebra-both-signs answer sign))
             (when (member answer '($pos $neg $zero)) (return answer))))))))

(defun algebra-both-signs (a b)
  "The sign of which A and B are both known."
  (cond ((eq a '$unknown) b)
        ((or (eq b '$unknown) (eq a b)) a)
        ((subsetp '($pz $nz) (list a b)) '$zero)
        ((subsetp '($pz $pn) (list a b)) '$pos)
        ((subsetp '($nz $pn) (list a b)) '$neg)
        (t a)))

(defun algebra-constant-sign (e)
  (let ((number (algebra-rational-number e)))
    (cond (number (cond ((plusp number) '$pos) ((minusp number) '$neg) (t '$zero)))
          ((eq t (algebra-zero-test e)) '$zero)
          (t (case (algebra-interval-sign e)
               (1 '$pos)
               (-1 '$neg)
               (t '$unknown))))))

;;; Sums and products.

(defun algebra-simple-sign (e)
  (cond ((atom e) (algebra-fact-sign e))
        ((mplusp e) (algebra-sum-sign (cdr e)))
        ((mtimesp e) (algebra-product-sign (cdr e)))
        ((mexptp e) (algebra-power-sign (cadr e) (caddr e)))
        (t (algebra-fact-sign e))))

(defun algebra-part-sign (e)
  (if ($constantp e) (algebra-constant-sign e) (algebra-simple-sign e)))

(defun algebra-sum-sign (terms)
  "Terms of one sign; else what the facts say of the whole."
  (let ((sign (algebra-common-sign terms #'algebra-part-sign)))
    (if (eq sign '$unknown)
        (algebra-fact-sign (addn terms nil))
        sign)))

(defun algebra-common-sign (terms sign-of)
  "The sign of a sum of TERMS that do not work against each other, else unknown."
  (let ((sum '$zero))
    (dolist (term terms sum)
      (setq sum (algebra-plus-sign sum (funcall sign-of term)))
      (when (eq sum '$unknown) (return sum)))))

(defun algebra-plus-sign (a b)
  (cond ((eq a '$zero) b)
        ((eq b '$zero) a)
        ((and (member a '($pos $pz)) (member b '($pos $pz))) (if (eq a '$pos) a b))
        ((and (member a '($neg $nz)) (member b '($neg $nz))) (if (eq a '$neg) a b))
        (t '$unknown)))

(defun algebra-product-sign (factors)
  (let ((sign '$pos))
    (dolist (factor factors sign)
      (setq sign (algebra-times-sign sign (algebra-part-sign factor))))))

(defun algebra-times-sign (a b)
  (cond ((or (eq a '$zero) (eq b '$zero)) '$zero)
        ((or (eq a '$unknown) (eq b '$unknown)) '$unknown)
        ((eq a '$pos) b)
        ((eq b '$pos) a)
        ((eq a '$neg) (algebra-opposite-sign b))
        ((eq b '$neg) (algebra-opposite-sign a))
        ((and (eq a '$pn) (eq b '$pn)) '$pn)
        ((or (eq a '$pn) (eq b '$pn)) '$unknown)
        ((eq a b) '$pz)
        (t '$nz)))

(defun algebra-opposite-sign (sign)
  (case sign
    ($pos '$neg) ($neg '$pos) ($pz '$nz) ($nz '$pz)
    (t sign)))

(defun algebra-power-sign (base exponent)
  (let ((sign (algebra-part-sign base))
        (number (algebra-rational-number exponent)))
    (cond ((eq sign '$pos) '$pos)
          ((not (integerp number)) (algebra-fact-sign (power base exponent)))
          ((evenp number) (cond ((or (minusp number) (member sign '($neg $pn))) '$pos)
                                ((eq sign '$zero) '$zero)
                                (t '$pz)))
          ((and (minusp number) (eq sign '$zero)) '$unknown)
          (t sign))))

;;; Maxima's own knowledge.

(defun algebra-fact-sign (e)
  (or (and (symbolp e) (cdr (assoc e *algebra-signs* :test #'eq)))
      (let ((answer (if (< (algebra-size e) 1000)
                        (algebra-quietly (lambda () ($sign e))))))
        (unless (member answer '($pos $neg $zero $pz $nz $pn)) (setq answer '$unknown))
        (when (symbolp e) (push (cons e answer) *algebra-signs*))
        answer)))

;;; Factors and facts.

(defun algebra-factored-sign (e)
  (let ((factored (if (< (algebra-size e) 1000)
                      (algebra-quietly (lambda () ($factor e))))))
    (cond ((or (null factored) (alike1 factored e)) '$unknown)
          ((or (mtimesp factored) (mexptp factored)) (algebra-simple-sign factored))
          (t '$unknown))))

(defvar *algebra-shifts-left* 0 "how many more facts may be put in")

(defun algebra-shifted-sign (e)
  "Put x = u + d for facts x > u, d positive, one after the other, until all terms have one sign."
  (let ((gaps (algebra-gaps (cdr ($facts))))
        (*algebra-shifts-left* (floor 16000 (+ 100 (algebra-size e)))))
    (loop for depth from 1 to (min 4 (length gaps))
          for sign = (algebra-shift e gaps nil depth)
          unless (eq sign '$unknown) return sign
          finally (return '$unknown))))

(defun algebra-gaps (facts)
  "(gap . strict) for each fact gap > 0 or gap >= 0 that is more than the sign of a symbol."
  (loop for fact in facts
        when (and (consp fact) (member (caar fact) '(mgreaterp mgeqp)))
          append (let ((gap (sub (cadr fact) (caddr fact))))
                   (if (mplusp gap) (list (cons gap (eq (caar fact) 'mgreaterp)))))))

(defun algebra-shift (e gaps signs depth)
  "The sign of E with some of the GAPS put in; SIGNS of the symbols that stand for gaps."
  (let ((sign (algebra-sign-with e signs)))
    (if (or (not (eq sign '$unknown)) (zerop depth) (minusp (decf *algebra-shifts-left*)))
        sign
        (loop for (gap . strict) in gaps
              do (dolist (x (algebra-shiftable gap e))
                   (let* ((d (gensym))
                          (shifted ($expand (maxima-substitute
                                             (algebra-solved-gap gap x d) x e)))
                          (sign (algebra-shift shifted (remove gap gaps :key #'car :test #'eq)
                                               (acons d (if strict '$pos '$pz) signs)
                                               (1- depth))))
                     (unless (eq sign '$unknown)
                       (return-from algebra-shift sign))))
              finally (return '$unknown)))))

(defun algebra-shiftable (gap e)
  "Symbols of E that stand in the sum GAP as a term x or -x and nowhere else."
  (loop for term in (cdr gap)
        for x = (if (and (mtimesp term) (eql (cadr term) -1) (null (cdddr term)))
                    (caddr term)
                    term)
        when (and (symbolp x) (not ($constantp x)) (among x e)
                  (not (among x (remove term (cdr gap) :test #'eq))))
          collect x))

(defun algebra-solved-gap (gap x d)
  "u + d or u - d from gap = d: the value of X."
  (let ((rest (maxima-substitute 0 x gap)))
    (if (member x (cdr gap) :test #'eq)
        (sub d rest)
        (sub rest d))))

(defun algebra-sign-with (e signs)
  (algebra-common-sign (if (mplusp e) (cdr e) (list e))
                       (lambda (term) (algebra-term-sign term signs))))

(defun algebra-term-sign (term signs)
  (let ((sign '$pos))
    (dolist (factor (if (mtimesp term) (cdr term) (list term)) sign)
      (setq sign (algebra-times-sign sign (algebra-factor-sign factor signs))))))

(defun algebra-factor-sign (factor signs)
  (let ((known (cdr (assoc (if (mexptp factor) (cadr factor) factor) signs :test #'eq))))
    (or known (algebra-part-sign factor))))

(defun algebra-not-zero-sign (e)
  (if (eq t (algebra-zero-test e)) '$zero '$unknown))
