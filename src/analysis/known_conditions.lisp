;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Single conditions, e > 0, e >= 0, notequal(e, 0), ..: whether one is known to hold, which is
;;; asked thousands of times for a verdict with parameters; whether it follows from another at
;;; sight; what must hold for roots in it to be real. See conditions.mac for lists of them.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/memory" "algebra/nouns" "algebra/packed_polynomials" "algebra/sign"
                "algebra/size"))

(defparameter *analysis-signs-of-conditions*
  '((mgreaterp (mlist) $pos) (mlessp (mlist) $neg) (mgeqp (mlist) $pos $zero $pz)
    (mleqp (mlist) $neg $zero $nz) ($notequal (mlist) $pos $neg $pn))
  "The signs of a - b of which one makes a > b hold, and so on.")

(defun $analysis_too_long (e)
  "Whether E has so many nodes that nothing is judged of it."
  (> (algebra-size e) (core-sized 4000)))

(defun $analysis_difference (condition)
  "Of the sides of a CONDITION."
  (sub (cadr condition) (caddr condition)))

(defun $analysis_known (condition)
  "Whether CONDITION is known to hold."
  (let ((signs (and (consp condition) (cdr (assoc (caar condition)
                                                  *analysis-signs-of-conditions*)))))
    (and signs
         (not ($analysis_too_long condition))
         ($algebra_sign_among ($analysis_difference condition) signs))))

(defun $analysis_known_sign (f)
  (if ($analysis_too_long f) '$unknown ($algebra_sign f)))

;;; c > 0 follows from d > 0 where c >= k*d, k > 0

(defun $analysis_beyond (condition conditions)
  "Whether CONDITION, a > b, follows so from one of CONDITIONS, which are among the facts."
  (and (analysis-positive-p condition)
       (or (member condition (cdr conditions) :test #'alike1)
           (let ((e ($analysis_difference condition)))
             (and (algebra-seen-among-p e '($pos))
                  (loop with expanded = (analysis-expanded e)
                        for other in (cdr conditions)
                        thereis (and (analysis-positive-p other)
                                     (analysis-multiple-beyond-p
                                      e expanded ($analysis_difference other)))))))
       t))

(defun analysis-expanded (e) (algebra-kept 'expanded e (lambda () ($expand e))))

(defun analysis-positive-p (condition)
  (and (consp condition) (eq (caar condition) 'mgreaterp)))

(defun analysis-multiple-beyond-p (e expanded f)
  "Whether E >= k*F for one of the numbers k > 0 that come into question."
  (loop for k in (analysis-multiples expanded (analysis-expanded f))
        thereis (algebra-sign-among (sub e (mul k f)) '($pos $zero $pz))))

(defun analysis-multiples (e f)
  "1, and positive numbers k for which a term of E - k*F vanishes, both expanded."
  (let ((terms (algebra-summands e)) (others (algebra-summands f)))
    (if (or (eql f 0)
            (>= (+ (algebra-size e) (algebra-size f)) 100)
            (> (* (length terms) (length others)) 50))
        '(1)
        (remove-duplicates
         (cons 1 (loop for a in terms
                       append (loop for b in others
                                    for k = (analysis-positive-ratio a b)
                                    when k collect k)))
         :test #'alike1 :from-end t))))

(defun analysis-positive-ratio (a b)
  "The number A/B of two terms where it is rational and positive, else nil."
  (let ((number (if (and (algebra-plain-p a) (algebra-plain-p b))
                    (analysis-plain-ratio a b)
                    (algebra-rational-number (div a b)))))
    (and number (plusp number) (algebra-maxima-rational number))))

(defun analysis-plain-ratio (a b)
  "The same of products of a number and of powers of names."
  (flet ((parts (term)
           (let* ((factors (algebra-factors-of term))
                  (number (algebra-rational-number (car factors))))
             (if number (values number (cdr factors)) (values 1 factors)))))
    (multiple-value-bind (c factors) (parts a)
      (multiple-value-bind (d others) (parts b)
        (and (= (length factors) (length others)) (every #'alike1 factors others) (/ c d))))))

;;; Real roots: u >= 0 for each u^(p/q), q even

(defun $analysis_even_root (e)
  "Whether E is sqrt(u) or its like: real where u >= 0, then positive where u is."
  (and (mexptp e) (ratnump (caddr e)) (evenp (caddr (caddr e)))))

(defun $analysis_radicands (e)
  "The conditions u >= 0 under which the roots in E, or in a list, are real."
  (cons '(mlist simp) (analysis-radicands e)))

(defun analysis-radicands (e)
  (unless ($mapatom e)
    (append (and ($analysis_even_root e)
                 (not (algebra-constant-p (cadr e)))
                 (list (simplify (list '(mgeqp) (cadr e) 0))))
            (mapcan #'analysis-radicands (cdr e)))))

;;; Products

(defun $analysis_powers_of (product)
  "[[factor, power], ..] of a PRODUCT as it stands."
  (cons '(mlist simp)
        (loop for f in (algebra-factors-of product)
              collect (if (and (mexptp f) (integerp (caddr f)))
                          (cons '(mlist simp) (cdr f))
                          (list '(mlist simp) f 1)))))
