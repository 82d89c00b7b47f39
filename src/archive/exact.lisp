;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What is typed in a call made exact. A decimal of at most 15 digits is the fraction that was
;;; typed, 0.3 is 3/10, which is said once, and so is 1/0.3, which Maxima divides. A number that
;;; needs more digits comes from a rounding before the call, as 0.1+0.2-0.3 does, and is refused.
;;; Start values, spans of time and all that a run takes may be any numbers: its rows are such
;;; numbers themselves. Sums and products over whole numbers are written out. Look first at
;;; archive-exact-decimals and archive-sums-written-out.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/plain_simplifier" "archive/speller" "archive/tokens" "archive/types"))

(defparameter *archive-exact-digits* 15 "Digits that a double keeps of every decimal.")
(defparameter *archive-inverse-digits* 8
  "Digits of a decimal whose inverse is recognised; with more a rounding could look like one.")

(defun archive-decimal-p (e) (or (floatp e) ($bfloatp e)))

(defun archive-binary-number (e)
  "Two values: E = m*2^x, a double or a bigfloat, exactly, and half the step to its neighbours."
  (multiple-value-bind (m x)
      (if (floatp e)
          (multiple-value-bind (m x sign) (integer-decode-float e) (values (* sign m) x))
          (values (cadr e) (- (caddr e) (car (last (car e))))))
    (values (* m (expt 2 x)) (expt 2 (1- x)))))

(defun archive-rounded-decimal (number digits)
  "NUMBER rounded to so many significant DIGITS."
  (let* ((bits (- (integer-length (numerator number)) (integer-length (denominator number))))
         (unit (expt 10 (- (floor (* bits 30103) 100000) digits))))
    (loop while (>= (abs (/ number unit)) (expt 10 digits)) do (setq unit (* 10 unit)))
    (* unit (round number unit))))

(defun archive-fraction-of-decimal (e digits)
  "The rational that E prints as, with at most so many DIGITS; nil if it needs more."
  (multiple-value-bind (number half-step) (archive-binary-number e)
    (if (zerop number)
        0
        (loop for n from 1 to digits
              for fraction = (archive-rounded-decimal number n)
              when (<= (abs (- fraction number)) half-step) return fraction))))

(defun archive-finite-p (e)
  (or (not (floatp e)) (<= (abs e) most-positive-double-float)))

(defun archive-fraction-of-inverse (e)
  "1/d, where d is a short decimal and E the number next to 1/d; else nil."
  (multiple-value-bind (number half-step) (archive-binary-number e)
    (loop for n from 1 to *archive-inverse-digits*
          for fraction = (/ 1 (archive-rounded-decimal (/ 1 number) n))
          when (<= (abs (- fraction number)) half-step) return fraction)))

(defun archive-decimal-text (e)
  (cond ((or ($bfloatp e) (not (archive-finite-p e))) (core-words (list e)))
        ((minusp e) (concatenate 'string "-" (archive-spell-double (- e))))
        (t (archive-spell-double e))))

(defvar *archive-takes-long-decimals* nil "Whether numbers are wanted of what is typed.")

(defun archive-exact-decimal (e)
  "Two values: the rational number that E was, and whether that is a guess worth telling."
  (let ((fraction (and (archive-finite-p e)
                       (or (archive-fraction-of-decimal e *archive-exact-digits*)
                           (archive-fraction-of-inverse e)))))
    (cond (fraction (values fraction t))
          ((and *archive-takes-long-decimals* (archive-finite-p e)) (archive-long-decimal e))
          (t (archive-refuse-decimal e)))))

(defun archive-long-decimal (e)
  (or (archive-fraction-of-decimal e 17) (values (archive-binary-number e))))

(defun archive-refuse-decimal (e)
  (if (archive-finite-p e)
      (core-error "~a arrived, a decimal of more than ~a digits: it was rounded before the call, ~
                   as 0.1+0.2-0.3 is; type fractions"
                  (archive-decimal-text e) *archive-exact-digits*)
      (core-error "~a arrived, which is no number" (archive-decimal-text e))))

;;; Where they stand

(defvar *archive-decimals* '() "Decimals found in a call, with their fractions, newest first.")

(defun archive-floating-key-p (key)
  (or (eq key $values) (member key '($start $time $limit $tolerance $tolerances $cell))))

(defun archive-with-parts (e parts)
  "E with other PARTS, simplified where these are numbers, sums, products, powers or functions."
  (cond ((every #'eq parts (cdr e)) e)
        ((or (mbagp e) (member (caar e) '(mequal mgreaterp mlessp mgeqp mleqp mnotequal
                                          %derivative %integrate %sum %product %limit %at lambda)))
         (cons (car e) parts))
        (t (simplifya (cons (remove 'simp (car e)) parts) t))))

(defun archive-check-decimal-power (base exponent)
  (when (and (archive-decimal-p exponent) (not (archive-decimal-p base))
             (> (abs (archive-binary-number exponent)) 1000))
    (core-error "the exponent ~a is a decimal; type it as an integer"
                (archive-decimal-text exponent))))

(defun archive-plain-part-p (e)
  "Whether no decimals are looked for in E: names, exact numbers, what is no expression."
  (or (atom e) (atom (car e)) (member (caar e) '(rat mrat))))

(defun archive-without-decimals (e)
  "E with fractions for its decimals."
  (cond ((archive-decimal-p e)
         (multiple-value-bind (number guessed) (archive-exact-decimal e)
           (let ((fraction (archive-maxima-number number)))
             (when guessed (pushnew (cons e fraction) *archive-decimals* :test #'equal))
             fraction)))
        ((archive-plain-part-p e) e)
        ((and (mequalp e) (archive-floating-key-p (cadr e)))
         (list (car e) (cadr e) (archive-with-any-decimals (caddr e))))
        (t (when (mexptp e) (archive-check-decimal-power (cadr e) (caddr e)))
           (archive-with-parts e (mapcar #'archive-without-decimals (cdr e))))))

(defun archive-with-any-decimals (e)
  "E with fractions for its decimals, however many digits these have."
  (cond ((and (archive-decimal-p e) (archive-finite-p e))
         (archive-maxima-number (archive-long-decimal e)))
        ((archive-plain-part-p e) e)
        (t (archive-with-parts e (mapcar #'archive-with-any-decimals (cdr e))))))

(defun archive-say-decimals (decimals)
  (let ((text (format nil "decimals are taken as fractions: ~{~a is ~a~^, ~}~:[~;, ..~]"
                      (loop for (decimal . fraction) in decimals
                            repeat 3
                            collect (archive-decimal-text decimal)
                            collect (core-cut (core-words (list fraction))))
                      (nthcdr 3 decimals))))
    (unless (member text *core-warnings* :test #'string=)
      (push text *core-warnings*)
      (core-note "~a" text))))

(defun archive-holds-decimal-p (e)
  (cond ((archive-decimal-p e) t)
        ((archive-plain-part-p e) nil)
        (t (loop for part in (cdr e) thereis (archive-holds-decimal-p part)))))

(defun archive-exact-decimals (arguments &optional numerical)
  "ARGUMENTS of a call, options included, with fractions for decimals; NUMERICAL: of a run."
  (if (some #'archive-holds-decimal-p arguments)
      (archive-made-exact arguments numerical)
      arguments))

(defun archive-made-exact (arguments numerical)
  (let* ((*archive-decimals* '())
         (*archive-takes-long-decimals* numerical)
         (exact (archive-with-plain-simplifier (mapcar #'archive-without-decimals arguments))))
    (when *archive-decimals* (archive-say-decimals (reverse *archive-decimals*)))
    exact))

;;; Sums and products as nouns, 'sum(x^k, k, 1, 3). One without a definite number of terms would be
;;; taken for an open function of its parts: archive/argument_checks refuses it. Derivatives and
;;; integrals as verbs, which a list that is quoted as a whole holds: there diff is 'diff.

(defparameter *archive-most-terms* 10000 "The most terms of a sum that is written out.")

(defun archive-definite-sum-p (e)
  "Whether E is a sum or product over a name between whole numbers."
  (and (archive-head-p e '%sum '%product)
       (archive-symbol-p (third e))
       (integerp (fourth e))
       (integerp (fifth e))))

(defun archive-holds-sum-p (e)
  "Whether a sum, a product or a verb is in E, or a name that is spelled so."
  (if (atom e)
      (member e '(%sum %product $diff $integrate))
      (or (archive-head-p e '%sum '%product '$diff '$integrate)
          (loop for part in (cdr e) thereis (archive-holds-sum-p part)))))

(defun archive-written-out (e)
  "E with its definite sums and products carried out, and nouns for verbs, from the inside."
  (cond ((atom e) e) ; a name too, which may be diff
        ((not (archive-holds-sum-p e)) e)
        ((archive-definite-sum-p e) (archive-sum-written-out e))
        ((archive-head-p e '$diff '$integrate) (archive-as-noun e))
        (t (archive-with-parts e (mapcar #'archive-written-out (cdr e))))))

(defun archive-sum-written-out (e)
  (destructuring-bind (body index first last) (cdr e)
    (core-within-size (1+ (- last first)) *archive-most-terms* (core-words (list e)) "terms")
    (loop with body = (archive-written-out body)
          for k from first to last
          collect (archive-written-out (maxima-substitute k index body)) into terms
          finally (return (if (eq (caar e) '%sum) (addn terms nil) (muln terms nil))))))

(defun archive-as-noun (e)
  "'diff(e, x, n) for diff(e, x, n), also of a derivative by the same name; 'integrate alike."
  (destructuring-bind (body &optional x (n 1) &rest more) (mapcar #'archive-written-out (cdr e))
    (cond ((eq (caar e) '$integrate) (list* '(%integrate simp) body (nthcdr 2 e)))
          ((or more (not (archive-symbol-p x)) (not (integerp n))) e)
          ((and (archive-head-p body '%derivative) (eq (third body) x) (null (nthcdr 4 body)))
           (list '(%derivative simp) (second body) x (+ n (fourth body))))
          (t (list '(%derivative simp) body x n)))))

(defun archive-sums-written-out (arguments)
  "ARGUMENTS of a call with their definite sums and products carried out, and nouns for verbs."
  (if (some #'archive-holds-sum-p arguments)
      (archive-with-plain-simplifier (mapcar #'archive-written-out arguments))
      arguments))
