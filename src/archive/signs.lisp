;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The signs that Maxima's simplifier asks for, judged plainly: from the form of an expression
;;; alone, without factoring, without facts, and without a question.

(in-package :maxima)

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
