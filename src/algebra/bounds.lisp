;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Signs of polynomials by what bounds their names: by Sturm's count of the real roots between the
;;; bounds of the one name; by facts c*x + u > 0 put in as x = (d - u)/c, d > 0,
;;; one after the other, until all terms have one sign; by a proof from the facts.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/facts" "algebra/polynomial"))

(defun algebra-names-of (e) (cdr ($listofvars e)))

(defun algebra-powers-in (e x)
  "The coefficients of X in the expanded polynomial E, lowest first, or nil where E is none in X."
  (let ((degree (and (algebra-polynomial-in-p e x) ($hipow e x))))
    (and degree (loop for k from 0 to degree collect ($coeff e x k)))))

(defun algebra-polynomial-in-p (e x)
  "Whether X stands in the expanded E in whole powers only."
  (every (lambda (term)
           (every (lambda (factor)
                    (or (alike1 (algebra-base-of factor) x) (free factor x)))
                  (algebra-factors-of term)))
         (algebra-summands e)))

;;; One name: real roots between its bounds

(defun algebra-root-free-sign (e)
  "Of a polynomial with rational coefficients in one name without roots where the name may be."
  (let ((names (algebra-names-of e)))
    (if (and names (null (cdr names)) (symbolp (car names))
             (algebra-rational-polynomial-p e (car names)))
        (multiple-value-bind (low low-open high high-open) (algebra-range (car names))
          (algebra-sign-between e (car names) low low-open high high-open))
        '$unknown)))

(defun algebra-rational-polynomial-p (e x)
  (let ((powers (algebra-powers-in e x)))
    (and powers (<= (length powers) 200) (every #'algebra-rational-number powers))))

(defun algebra-range (x)
  "Four values: the largest known lower bound of X and whether it is left out, and the same above;
nil where there is none."
  (let ((low nil) (low-open nil) (high nil) (high-open nil))
    (flet ((above (bound open)
             (when (or (null low) (> bound low) (and (= bound low) open))
               (setq low bound low-open open)))
           (below (bound open)
             (when (or (null high) (< bound high) (and (= bound high) open))
               (setq high bound high-open open))))
      (loop for (e . sign) in (algebra-gaps *algebra-knowledge*)
            for powers = (and (not ($constantp e)) (equal (algebra-names-of e) (list x))
                              (algebra-powers-in e x))
            do (when (and (= (length powers) 2) (every #'algebra-rational-number powers))
                 (let* ((slope (algebra-rational-number (second powers)))
                        (bound (- (/ (algebra-rational-number (first powers)) slope)))
                        (sign (if (plusp slope) sign (algebra-opposite-sign sign))))
                   (case sign
                     ($pos (above bound t)) ($pz (above bound nil))
                     ($neg (below bound t)) ($nz (below bound nil))
                     ($zero (above bound nil) (below bound nil)))))))
    (values low low-open high high-open)))

(defun algebra-sign-between (e x low low-open high high-open)
  "The sign of the polynomial E in X between the bounds, where it has no root there."
  (let ((inner (algebra-roots-between e low high))
        (at-low (and low (algebra-number-sign-at e x low)))
        (at-high (and high (algebra-number-sign-at e x high))))
    (when (and high (eq at-high '$zero)) (decf inner (algebra-root-multiplicity e x high)))
    (cond ((and low high (>= low high)) '$unknown)
          ((plusp inner) '$unknown)
          (t (let ((sign (algebra-number-sign-at e x (algebra-point-between low high))))
               (if (or (and (not low-open) (eq at-low '$zero))
                       (and (not high-open) (eq at-high '$zero)))
                   (if (eq sign '$pos) '$pz '$nz)
                   sign))))))

(defun algebra-roots-between (e low high)
  "How many real roots E has in (LOW, HIGH], by Sturm's chain; exact."
  (flet ((point (bound otherwise) (if bound (cons (numerator bound) (denominator bound)) otherwise)))
    (let ((varlist nil) ($keepfloat nil) ($ratfac nil))
      (nroots (unipoly e e) (point low -1) (point high 1)))))

(defun algebra-root-multiplicity (e x root)
  (loop for k from 0
        for slope = e then ($diff slope x)
        while (eq '$zero (algebra-number-sign-at slope x root))
        finally (return k)))

(defun algebra-number-sign-at (e x number)
  (algebra-constant-sign (maxima-substitute (algebra-maxima-number number) x e)))

(defun algebra-maxima-number (number)
  (if (integerp number)
      number
      (list '(rat simp) (numerator number) (denominator number))))

(defun algebra-point-between (low high)
  (cond ((and low high) (/ (+ low high) 2))
        (low (1+ low))
        (high (1- high))
        (t 0)))

;;; Facts put in

(defvar *algebra-shifts-left* 0 "How many more facts may be put in.")

(defun algebra-shifted-sign (e)
  (let ((gaps (algebra-linear-gaps *algebra-knowledge*))
        (*algebra-shifts-left* (floor 16000 (+ 100 (algebra-size e)))))
    (loop for depth from 1 to (min 5 (length gaps))
          for sign = (algebra-shift e gaps depth)
          unless (eq sign '$unknown) return sign
          finally (return '$unknown))))

(defun algebra-linear-gaps (knowledge)
  "Sums of known sign, turned so that it is pos, pz or zero."
  (loop for (e . sign) in (knowledge-sums knowledge)
        append (case sign
                 (($pos $pz $zero) (list (cons e sign)))
                 (($neg $nz) (list (cons (algebra-turned e) (algebra-opposite-sign sign)))))))

(defun algebra-shift (e gaps depth)
  "The sign of E with DEPTH of the GAPS put in at most."
  (let ((sign (algebra-common-sign (algebra-summands e) #'algebra-part-sign)))
    (if (or (not (eq sign '$unknown)) (zerop depth) (minusp (decf *algebra-shifts-left*)))
        sign
        (loop for gap in gaps
              do (dolist (x (algebra-linear-names (car gap) e))
                   (let ((sign (algebra-shift-by e x gap (remove gap gaps :test #'eq) depth)))
                     (unless (eq sign '$unknown) (return-from algebra-shift sign))))
              finally (return '$unknown)))))

(defun algebra-linear-names (gap e)
  "Names in which E is a polynomial and GAP linear, with a coefficient of known sign."
  (loop for x in (algebra-names-of gap)
        when (and (symbolp x) (among x e) (algebra-polynomial-in-p e x)
                  (algebra-polynomial-in-p gap x) (eql 1 ($hipow gap x))
                  (member (algebra-part-sign ($coeff gap x 1)) '($pos $neg)))
          collect x))

(defun algebra-shift-by (e x gap others depth)
  "The sign of E with x = (d - u)/c from the GAP c*x + u = d."
  (let* ((c ($coeff (car gap) x 1))
         (u ($coeff (car gap) x 0))
         (d (if (eq (cdr gap) '$zero) 0 (gensym)))
         (*algebra-knowledge* (copy-algebra-knowledge *algebra-knowledge*)))
    (unless (eql d 0)
      (push (cons d (cdr gap)) (knowledge-items *algebra-knowledge*)))
    (flet ((put-in (polynomial) (algebra-linear-put-in polynomial x c (sub d u))))
      (let ((sign (algebra-shift (put-in e)
                                 (loop for (other . sign) in others
                                       collect (if (and (algebra-polynomial-in-p other x)
                                                        (or (evenp ($hipow other x))
                                                            (eq (algebra-part-sign c) '$pos)))
                                                   (cons (put-in other) sign)
                                                   (cons other sign)))
                                 (1- depth))))
        (if (and (oddp ($hipow e x)) (eq (algebra-part-sign c) '$neg))
            (algebra-opposite-sign sign)
            sign)))))

(defun algebra-linear-put-in (e x c value)
  "c^n times E of degree n in X, with VALUE/c for X."
  (let* ((powers (algebra-powers-in e x)) (n (1- (length powers))))
    ($expand (addn (loop for a in powers for k from 0
                         collect (mul a (power value k) (power c (- n k))))
                   nil))))

;;; A proof from the facts

(defun algebra-proved-sign (e)
  (let* ((gaps (append (algebra-gaps *algebra-knowledge*) (algebra-own-gaps e)))
         (sign (algebra-certificate e gaps)))
    (if (eq sign '$pos)
        sign
        (algebra-both-signs sign (algebra-opposite-sign
                                  (algebra-certificate (algebra-turned e) gaps))))))

(defun algebra-own-gaps (e)
  "What the kernels of E bring with them: signs, and |sin x|, |cos x| <= 1."
  (loop for kernel in (algebra-kernels-of (list e))
        unless (symbolp kernel)
          collect (cons kernel (algebra-part-sign kernel))
          and when (and (consp kernel) (member (caar kernel) '(%sin %cos))
                        (algebra-real-p (cadr kernel)))
                append (list (cons (add 1 kernel) '$pz) (cons (sub 1 kernel) '$pz))))
