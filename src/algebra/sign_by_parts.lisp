;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The sign of an expression as it stands: numbers exactly, names, kernels and sums as the facts
;;; give them, products and powers by their factors, sums by terms that agree. Signs are pos, neg,
;;; zero, pz (>= 0), nz (<= 0), pn (not zero) and unknown; they speak of real values of the names
;;; for which the expression is defined.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/constant_sign" "algebra/noun_values" "algebra/nouns" "algebra/size"
                "algebra/zero"))

(defstruct (algebra-knowledge (:conc-name knowledge-))
  facts           ; the relations it was made from
  (items '())     ; ((name or kernel . sign) ..)
  (names (make-hash-table :test #'eq)) ; the same entries by their names
  (sums '())      ; ((expanded sum . sign) ..)
  (turned '())    ; ((- the same sum . that entry) ..)
  (products '())  ; (((factor factor ..) . sign) ..), of factors whose signs are open
  (contradiction nil)
  (memo (make-hash-table :test #'equal)))

(defvar *algebra-knowledge* nil "What is known of names, kernels and sums.")

(defun algebra-part-sign (e)
  (if (algebra-constant-p e) (algebra-constant-sign e) (algebra-simple-sign e)))

(defun algebra-constant-sign (e)
  (let ((number (algebra-rational-number e)))
    (cond (number (cond ((plusp number) '$pos) ((minusp number) '$neg) (t '$zero)))
          ((eq t (algebra-zero-test e)) '$zero)
          (t (case (algebra-interval-sign e)
               (1 '$pos)
               (-1 '$neg)
               (t '$unknown))))))

(defun algebra-simple-sign (e)
  (cond ((atom e) (algebra-known-item e))
        ((mplusp e) (algebra-sum-sign e))
        ((mtimesp e) (algebra-product-sign (cdr e)))
        ((mexptp e) (algebra-both-signs (algebra-known-item e)
                                        (algebra-power-sign (cadr e) (caddr e))))
        (t (algebra-both-signs (algebra-known-item e) (algebra-function-sign e)))))

;;; What the facts say

(defun algebra-known-item (e)
  (or (and *algebra-knowledge* (cdr (algebra-entry-of-item e))) '$unknown))

(defun algebra-entry-of-item (e)
  "What is known of E, a name or a kernel: (E . sign), or nil. Names may be thousands."
  (if (symbolp e)
      (gethash e (knowledge-names *algebra-knowledge*))
      (assoc e (knowledge-items *algebra-knowledge*) :test #'alike1)))

(defun algebra-known-sum (sum)
  (let ((entry (and *algebra-knowledge* (algebra-entry-of-sum sum))))
    (if entry
        (cdr entry)
        (let ((turned (and *algebra-knowledge*
                           (assoc sum (knowledge-turned *algebra-knowledge*) :test #'alike1))))
          (if turned (algebra-opposite-sign (cddr turned)) '$unknown)))))

(defun algebra-entry-of-sum (sum)
  (assoc sum (knowledge-sums *algebra-knowledge*) :test #'alike1))

(defun algebra-same-factors-p (a b)
  (null (set-exclusive-or a b :test #'alike1)))

(defun algebra-sign-by-products (factors)
  "Of the product of FACTORS: that of a known one, or of several that are not zero, in whose product
all others are squares; else unknown."
  (let ((known (and *algebra-knowledge* (knowledge-products *algebra-knowledge*))))
    (or (cdr (assoc factors known :test #'algebra-same-factors-p))
        (loop with rows = (remove-if-not (lambda (row) (member (cdr row) '($pos $neg))) known)
              with rest = (cons factors '$pos)
              while (car rest)
              do (let ((row (pop rows)))
                   (unless row (return '$unknown))
                   (flet ((reduced (other) (algebra-without-factor (caar row) row other)))
                     (when (car row)
                       (setq rows (mapcar #'reduced rows)
                             rest (reduced rest)))))
              finally (return (cdr rest))))))

(defun algebra-without-factor (factor row other)
  "OTHER, ROW multiplied to it where FACTOR stands in it."
  (if (member factor (car other) :test #'alike1)
      (cons (set-exclusive-or (car other) (car row) :test #'alike1)
            (algebra-times-sign (cdr other) (cdr row)))
      other))

(defun algebra-note-sum (sum turned sign)
  (let ((entry (cons sum sign)))
    (push entry (knowledge-sums *algebra-knowledge*))
    (push (cons turned entry) (knowledge-turned *algebra-knowledge*))))

;;; Signs of sums, products, powers

(defun algebra-both-signs (a b)
  "The sign of which A and B are both known."
  (cond ((eq a '$unknown) b)
        ((or (eq b '$unknown) (eq a b)) a)
        ((subsetp '($pz $nz) (list a b)) '$zero)
        ((subsetp '($pz $pn) (list a b)) '$pos)
        ((subsetp '($nz $pn) (list a b)) '$neg)
        ((member a '($pos $neg $zero)) a)
        (t b)))

(defun algebra-sign-values (sign)
  (ecase sign
    ($pos '(1)) ($neg '(-1)) ($zero '(0)) ($pz '(0 1)) ($nz '(-1 0)) ($pn '(-1 1))))

(defun algebra-opposite-sign (sign)
  (case sign
    ($pos '$neg) ($neg '$pos) ($pz '$nz) ($nz '$pz)
    (t sign)))

(defun algebra-sum-sign (sum)
  (algebra-both-signs (algebra-known-sum sum)
                      (algebra-common-sign (cdr sum) #'algebra-part-sign)))

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

(defun $algebra_times_sign (a b) (algebra-times-sign a b))

(defun algebra-power-sign (base exponent)
  "Roots of odd order of negative numbers are real, as Maxima has them."
  (let ((number (algebra-rational-number exponent)))
    (cond ((and number (oddp (denominator number)))
           (algebra-odd-root-sign (algebra-part-sign base) number base))
          (number (case (algebra-part-sign base)
                    ($pos '$pos)
                    ($zero (if (plusp number) '$zero '$unknown))
                    ($pz (if (plusp number) '$pz '$pos))
                    (t '$unknown)))
          ((and (eq (algebra-part-sign base) '$pos) (algebra-real-p exponent)) '$pos)
          (t '$unknown))))

(defun algebra-odd-root-sign (sign number base)
  "The sign of base^(p/q), q odd."
  (cond ((eq sign '$zero) (if (plusp number) '$zero '$unknown))
        ((oddp (numerator number))
         (if (minusp number)
             (algebra-both-signs sign (if (algebra-real-p base) '$pn '$unknown))
             sign))
        ((or (member sign '($pos $neg $pn))
             (and (minusp number) (algebra-real-p base)))
         '$pos)
        ((or (not (eq sign '$unknown)) (algebra-real-p base)) '$pz)
        (t '$unknown)))

;;; Functions

(defun algebra-function-sign (e)
  (let ((arguments (cdr e)))
    (case (caar e)
      (mabs (case (algebra-part-sign (car arguments))
              (($pos $neg $pn) '$pos)
              ($zero '$zero)
              (t '$pz)))
      (%cosh (if (algebra-real-p (car arguments)) '$pos '$unknown))
      ((%sin %cos) (algebra-sine-sign (caar e) (car arguments)))
      ((%sinh %tanh %atan %asinh %signum) (algebra-part-sign (car arguments)))
      ($unit_step (algebra-step-sign (algebra-part-sign (car arguments))))
      (%log (if (eq (algebra-part-sign (car arguments)) '$pos)
                (algebra-part-sign (sub (car arguments) 1))
                '$unknown))
      ($max (algebra-largest-sign (mapcar #'algebra-part-sign arguments)))
      ($min (algebra-opposite-sign
             (algebra-largest-sign
              (mapcar (lambda (part) (algebra-opposite-sign (algebra-part-sign part)))
                      arguments))))
      (t (let ((value (algebra-noun-value e)))
           (if value (algebra-part-sign value) '$unknown))))))

(defun algebra-step-sign (sign)
  (case sign ($pos '$pos) (($neg $nz $zero) '$zero) (t '$pz)))

(defun algebra-sine-sign (function u)
  "Of sin or cos of U that the facts bound between multiples of a quarter turn."
  (let ((u (if (eq function '%cos) (add u (div '$%pi 2)) u)))
    (flet ((above (k) (algebra-bounded-sign (sub u (mul k '$%pi)))))
      (if (algebra-bounded-p u)
          (loop for k in '(-2 -1 0 1)
                for low = (above k)
                for high = (if (member low '($pos $pz $zero))
                               (algebra-opposite-sign (above (1+ k))))
                do (when (member high '($pos $pz $zero))
                     (return (algebra-signed-half-turn k low high)))
                finally (return '$unknown))
          '$unknown))))

(defun algebra-signed-half-turn (k low high)
  "The sign of sin(u) where u - k*%pi and (k+1)*%pi - u have the signs LOW and HIGH."
  (let ((sign (if (and (eq low '$pos) (eq high '$pos)) '$pos '$pz)))
    (if (evenp k) sign (algebra-opposite-sign sign))))

(defun algebra-bounded-p (u)
  "Whether U is short and the facts speak of its names beside numbers."
  (and *algebra-knowledge*
       (< (algebra-size u) 40)
       (let ((names (cdr ($listofvars u))))
         (and names
              (loop for name in names
                    always (some (lambda (fact) (among name fact))
                                 (knowledge-facts *algebra-knowledge*)))))))

(defun algebra-bounded-sign (e)
  "pos or pz where E is a positive multiple of a fact and a constant, neg or nz where -E is."
  (let ((names ($listofvars e)) (e ($expand e)) (opposite ($expand (mul -1 e))))
    (or (loop for fact in (knowledge-facts *algebra-knowledge*)
              when (and (< (algebra-size fact) 20) (equal names ($listofvars fact)))
                do (let ((above (algebra-sign-beyond e (cadr names) fact))
                         (below (algebra-sign-beyond opposite (cadr names) fact)))
                     (cond (above (return above))
                           (below (return (algebra-opposite-sign below))))))
        '$unknown)))

(defun algebra-sign-by-one-fact (e)
  "Of a short sum in one name, by a fact beside a constant, such as x < sqrt(2)."
  (if (and *algebra-knowledge* (< (algebra-size e) 20) (null (cddr ($listofvars e))))
      (algebra-bounded-sign e)
      '$unknown))

(defun algebra-sign-beyond (e x fact)
  "pos or pz where E = k*d + c by the FACT d > 0 or d >= 0 on X, k a positive number, c >= 0."
  (multiple-value-bind (d needed) (core-fact-difference fact)
    (let* ((slope ($coeff ($expand d) x))
           (k (and (mnump slope) (not (zerop1 slope)) (div ($coeff e x) slope)))
           (rest (and k (mnump k) ($expand (sub e (mul k d))))))
      (and rest
           (member needed '($pos $pz))
           (eq (algebra-part-sign k) '$pos)
           (algebra-constant-p rest)
           (case (algebra-constant-sign rest) ($pos '$pos) ($zero needed))))))

(defun algebra-largest-sign (signs)
  "The sign of the largest of numbers with these SIGNS."
  (cond ((member '$pos signs) '$pos)
        ((every (lambda (sign) (eq sign '$neg)) signs) '$neg)
        ((intersection '($pz $zero) signs)
         (if (subsetp signs '($neg $nz $zero)) '$zero '$pz))
        ((subsetp signs '($neg $nz)) '$nz)
        (t '$unknown)))

(defun algebra-real-p (e)
  "Whether E is real for real values of its names that the facts allow, where it is defined."
  (cond ((atom e) (not (eq e '$%i)))
        ((mnump e) t)
        ((not (every #'algebra-real-p (cdr e))) nil)
        ((mexptp e) (algebra-real-power-p (cadr e) (caddr e)))
        (t (case (caar e)
             (%log (eq (algebra-part-sign (cadr e)) '$pos))
             ((%asin %acos %acosh %atanh %asec %acsc %acoth %asech) nil)
             (t t)))))

(defun algebra-real-power-p (base exponent)
  (let ((number (algebra-rational-number exponent)))
    (or (and number (oddp (denominator number)))
        (member (algebra-part-sign base) (if number '($pos $pz $zero) '($pos))))))
