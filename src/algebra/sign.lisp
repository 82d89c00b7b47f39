;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The sign of an expression from the facts of the current context, never asking: numbers exactly,
;;; products by their factors, sums by their terms, and by facts x > u put in as x = u + d, d > 0.
;;; What is not proved is unknown.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/zero" "algebra/interval"))

(defun $algebra_sign (e)
  "pos, neg, zero, pz (>= 0), nz (<= 0), pn (not zero) or unknown."
  (algebra-sign (algebra-normal-form e)))

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
  (let ((signs (mapcar #'algebra-part-sign terms)))
    (cond ((subsetp signs '($pos $pz $zero)) (if (member '$pos signs) '$pos '$pz))
          ((subsetp signs '($neg $nz $zero)) (if (member '$neg signs) '$neg '$nz))
          (t (algebra-fact-sign (addn terms nil))))))

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
  (let ((answer (algebra-quietly (lambda () ($sign e)))))
    (case answer
      (($pos $neg $zero $pz $nz $pn) answer)
      (t '$unknown))))

;;; Factors and facts.

(defun algebra-factored-sign (e)
  (let ((factored (algebra-quietly (lambda () ($factor e)))))
    (cond ((or (null factored) (alike1 factored e)) '$unknown)
          ((or (mtimesp factored) (mexptp factored)) (algebra-simple-sign factored))
          (t '$unknown))))

(defun algebra-shifted-sign (e)
  "Put x = u + d for each fact x > u of a symbol x, d positive, and look at the terms."
  (let ((shifted e) (positive nil))
    (dolist (fact (algebra-ordered-facts))
      (destructuring-bind (x . u) fact
        (unless (or (not (among x shifted)) (eql u 0))
          (let ((d (gensym)))
            (push d positive)
            (setq shifted (maxima-substitute (add u d) x shifted))))))
    (if positive
        (algebra-sign-with-positive ($expand shifted) positive)
        '$unknown)))

(defun algebra-ordered-facts ()
  "(x . u) for each fact x > u or u > x of a symbol, u not zero."
  (loop for fact in (cdr ($facts))
        when (and (consp fact) (eq (caar fact) 'mgreaterp) (symbolp (cadr fact))
                  (not ($constantp (cadr fact)))
                  (not ($constantp (caddr fact))))
          collect (cons (cadr fact) (caddr fact))))

(defun algebra-sign-with-positive (e symbols)
  (let ((signs (loop for term in (if (mplusp e) (cdr e) (list e))
                     collect (algebra-term-sign term symbols))))
    (cond ((subsetp signs '($pos $pz $zero)) (if (member '$pos signs) '$pos '$pz))
          ((subsetp signs '($neg $nz $zero)) (if (member '$neg signs) '$neg '$nz))
          (t '$unknown))))

(defun algebra-term-sign (term symbols)
  (let ((sign '$pos))
    (dolist (factor (if (mtimesp term) (cdr term) (list term)) sign)
      (unless (or (member factor symbols)
                  (and (mexptp factor) (member (cadr factor) symbols)))
        (setq sign (algebra-times-sign sign (algebra-part-sign factor)))))))

(defun algebra-not-zero-sign (e)
  (if (eq t (algebra-zero-test e)) '$zero '$unknown))
