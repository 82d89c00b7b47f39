;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Birkhoff's normal form of H = H2 + H3 + H4 + .. to the fourth order, for two pairs of imaginary
;;; roots lambda1, -lambda1, lambda2, -lambda2 (G. D. Birkhoff, Dynamical systems, ch. 3; V. I.
;;; Arnold, Mathematical methods, app. 7). In coordinates eta_k in which H2 is diagonal,
;;;     {eta_1, eta_-1} = beta_1,  {eta_2, eta_-2} = beta_2,  {eta^m, H2} = (m.lambda)*eta^m,
;;; the terms of H4 + 1/2*{H3, chi}, chi_m = h_m/(m.lambda), with m.lambda = 0 are what is left. The
;;; roots stay symbols with their relations; divisors are turned into norms, free of them.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/common_roots" "algebra/evaluate" "algebra/general_form"
                "algebra/groebner" "algebra/kernels" "algebra/normal" "algebra/quotient"
                "algebra/relations" "algebra/scan" "algebra/size"))

(defstruct (analysis-frequencies (:conc-name analysis-frequencies-))
  variables                                   ; the polynomials' symbols of lambda1, lambda2
  first second                                ; the relation, quotients: see analysis-power-rule
  ratio                                       ; nil, or r in lambda2 = -r*lambda1
  (powers (make-hash-table :test #'equal)))   ; (i j) -> lambda1^i*lambda2^j reduced

(defvar *analysis-frequencies* nil "the relation of the roots at hand")

;;; Quotients whose numerators contain the roots, reduced

(defun analysis-power (i j)
  (let ((powers (analysis-frequencies-powers *analysis-frequencies*)))
    (or (gethash (list i j) powers)
        (setf (gethash (list i j) powers) (analysis-power-rule i j)))))

(defun analysis-power-rule (i j)
  "lambda1^4 = -a*lambda1^2 - b, lambda2^2 = -a - lambda1^2; with a ratio r lambda2 = -r*lambda1 and
lambda1^2 = s. FIRST and SECOND are a, b or s."
  (let* ((f *analysis-frequencies*)
         (ratio (analysis-frequencies-ratio f))
         (a (analysis-frequencies-first f)))
    (flet ((less (quotient) (algebra-times (cons -1 1) quotient)))
      (cond ((and ratio (plusp j))
             (algebra-times (cons (expt (- ratio) j) 1) (analysis-power (+ i j) 0)))
            ((and ratio (> i 1)) (algebra-times a (analysis-power (- i 2) 0)))
            ((> j 1) (algebra-sum (list (less (algebra-times a (analysis-power i (- j 2))))
                                        (less (analysis-power (+ i 2) (- j 2))))))
            ((> i 3)
             (algebra-sum (list (less (algebra-times a (analysis-power (- i 2) j)))
                                (less (algebra-times (analysis-frequencies-second f)
                                                     (analysis-power (- i 4) j))))))
            (t (destructuring-bind (x y) (analysis-frequencies-variables f)
                 (cons (ptimes (if (zerop i) 1 (list x i 1)) (if (zerop j) 1 (list y j 1)))
                       1)))))))

(defun analysis-reduced (quotient)
  (destructuring-bind (n . d) quotient
    (let ((terms (algebra-monomial-terms n (analysis-frequencies-variables
                                            *analysis-frequencies*))))
      (analysis-roots-reduced
       (algebra-times (cons 1 d)
                      (if (every #'analysis-short-power-p terms)
                          (cons n 1)
                          (algebra-sum
                           (loop for ((i j) . a) in terms
                                 collect (algebra-times (cons a 1) (analysis-power i j))))))))))

(defun analysis-short-power-p (term)
  (destructuring-bind (i j) (car term)
    (if (analysis-frequencies-ratio *analysis-frequencies*)
        (and (zerop j) (< i 2))
        (and (< j 2) (< i 4)))))

(defun analysis-roots-reduced (quotient)
  "Square roots of parameters and numbers reduced too."
  (if (some #'algebra-kernel-degree (algebra-ring-kernels *algebra-ring*))
      (algebra-times (algebra-reduce (car quotient)) (cons 1 (cdr quotient)))
      quotient))

(defparameter *analysis-normal-form-work* 20000000
  "Products of single terms that a normal form may cost: some twenty seconds.")

(defun analysis-product (x y)
  (if (or (pzerop (car x)) (pzerop (car y)))
      (cons 0 1)
      (progn
        (decf *algebra-work-left* (* (algebra-monomials (car x)) (algebra-monomials (car y))))
        (when (minusp *algebra-work-left*)
          (core-error "the normal form is too long with these parameters; give some numbers"))
        (analysis-reduced (algebra-times x y)))))

;;; Polynomials in eta_1, eta_-1, eta_2, eta_-2: tables exponents -> quotient

(defun analysis-put-term (table exponents quotient)
  (unless (pzerop (car quotient)) (push quotient (gethash exponents table))))

(defun analysis-summed (table)
  "The table with the lists of its entries added."
  (let ((sums (make-hash-table :test #'equal)))
    (loop for exponents being the hash-keys of table using (hash-value quotients)
          for sum = (analysis-roots-reduced (algebra-sum quotients))
          unless (pzerop (car sum)) do (setf (gethash exponents sums) sum))
    sums))

(defun analysis-eta-product (p q &optional wanted)
  "P*Q; with WANTED only these of its terms."
  (let ((table (make-hash-table :test #'equal)))
    (loop for m being the hash-keys of p using (hash-value x)
          do (loop for n being the hash-keys of q using (hash-value y)
                   for exponents = (mapcar #'+ m n)
                   when (or (null wanted) (member exponents wanted :test #'equal))
                     do (analysis-put-term table exponents (analysis-product x y))))
    (analysis-summed table)))

(defun analysis-eta-monomial (exponents forms cache)
  "The product of powers of FORMS, tables, one of CACHE where it was met."
  (let ((place (position-if #'plusp exponents)))
    (cond ((gethash exponents cache))
          ((= 1 (reduce #'+ exponents)) (nth place forms))
          (t (setf (gethash exponents cache)
                   (analysis-eta-product
                    (nth place forms)
                    (analysis-eta-monomial (algebra-lowered exponents place) forms cache)))))))

(defun analysis-in-eta (terms forms cache &optional wanted)
  "The sum of TERMS (exponents . quotient) in z_i, these put in as FORMS."
  (let ((table (make-hash-table :test #'equal)))
    (loop for (exponents . a) in terms
          for place = (position-if #'plusp exponents)
          for product = (analysis-eta-product
                         (nth place forms)
                         (analysis-eta-monomial (algebra-lowered exponents place) forms cache)
                         wanted)
          do (loop for m being the hash-keys of product using (hash-value x)
                   do (analysis-put-term table m (analysis-product a x))))
    (analysis-summed table)))

;;; The normal form

(defun analysis-divisor-numbers (m)
  "(a b) with m.lambda = a*lambda1 + b*lambda2."
  (destructuring-bind (p q r s) m (list (- p q) (- r s))))

(defun analysis-half-bracket (cubic betas inverses wanted)
  "The WANTED terms of 1/2*{H3, chi}, each a list of quotients."
  (let ((table (make-hash-table :test #'equal))
        (terms (loop for m being the hash-keys of cubic using (hash-value x) collect (cons m x))))
    (dolist (p terms table)
      (dolist (q terms)
        (analysis-put-bracket table p q (cons 0 (first betas)) inverses wanted)
        (analysis-put-bracket table p q (cons 2 (second betas)) inverses wanted)))))

(defun analysis-put-bracket (table p q pair inverses wanted)
  "The part of 1/2*{x*eta^m, y/(n.lambda)*eta^n} in the PAIR (k . beta), the places k and k + 1, of
P = (m . x), Q = (n . y)."
  (destructuring-bind ((m . x) (n . y) (k . beta)) (list p q pair)
    (let ((number (- (* (nth k m) (nth (1+ k) n)) (* (nth (1+ k) m) (nth k n))))
          (exponents (loop for i in m for j in n for place from 0
                           collect (- (+ i j) (if (<= k place (1+ k)) 1 0)))))
      (when (and (/= number 0) (member exponents wanted :test #'equal))
        (let ((inverse (cdr (assoc (analysis-divisor-numbers n) inverses :test #'equal))))
          (analysis-put-term table exponents
                             (analysis-product
                              (analysis-product (cons number 2) beta)
                              (analysis-product inverse (analysis-product x y)))))))))

(defun analysis-normal-terms (cubic quartic betas inverses wanted)
  (let ((table (analysis-half-bracket cubic betas inverses wanted)))
    (loop for m being the hash-keys of quartic using (hash-value x)
          do (analysis-put-term table m x))
    (analysis-summed table)))

;;; What is asked: expressions in, expressions in lambda1, lambda2 out

(defmacro analysis-with-frequencies ((evaluate expressions lambdas relation) &body body)
  "EVALUATE is a function of an expression among EXPRESSIONS, a nested list: its quotient, reduced."
  `(analysis-call-with-frequencies ,expressions ,lambdas ,relation
                                   (lambda (,evaluate) ,@body)))

(defun analysis-call-with-frequencies (expressions lambdas relation function)
  (with-algebra-ring
    (let* ((skeletons (make-hash-table :test #'eq))
           (names (mapcar #'algebra-scan (cdr lambdas)))
           (relation (cdr relation)))
      (labels ((scan (e)
                 (if (mbagp e) (mapc #'scan (cdr e)) (setf (gethash e skeletons)
                                                           (algebra-scan e))))
               (value (e) (algebra-evaluate (if (atom e) (algebra-scan e)
                                                (gethash e skeletons)))))
        (mapc #'scan expressions)
        (mapc #'scan relation)
        (algebra-order-kernels)
        (let ((*analysis-frequencies*
                (make-analysis-frequencies :variables (mapcar #'algebra-kernel-variable names)
                                           :first (value (first relation))
                                           :second (value (second relation))
                                           :ratio (third relation))))
          (let ((*algebra-work-left* (core-sized *analysis-normal-form-work*)))
            (funcall function (lambda (e) (analysis-reduced (value e))))))))))

(defun $analysis_normal_coefficients (terms modes inverses lambdas relation wanted)
  "Coefficients of the WANTED monomials of the normal form. TERMS [coefficient, exponents] of H3 and
H4 in z, MODES [rows z_i in eta, betas, ..], INVERSES [[a, b], 1/(a*lambda1 + b*lambda2)], RELATION
[a, b] or [s, s, r]; of the third degree those of H3."
  (analysis-with-frequencies (value (list terms modes inverses) lambdas relation)
    (let* ((forms (loop for row in (cdr (second modes))
                        collect (analysis-linear-form (cdr row) value)))
           (cache (make-hash-table :test #'equal))
           (all (loop for (nil c e) in (cdr terms) collect (cons (cdr e) (funcall value c))))
           (asked (mapcar #'cdr (cdr wanted)))
           (cubic (analysis-in-eta (analysis-terms-of-degree 3 all) forms cache))
           (normal (if (= 3 (reduce #'+ (first asked)))
                       cubic
                       (analysis-normal-terms
                        cubic
                        (analysis-in-eta (analysis-terms-of-degree 4 all) forms cache asked)
                        (mapcar value (cdr (third modes)))
                        (loop for (nil numbers e) in (cdr inverses)
                              collect (cons (cdr numbers) (funcall value e)))
                        asked))))
      (cons '(mlist simp)
            (loop for exponents in asked
                  collect (analysis-quotient-shown (gethash exponents normal (cons 0 1))))))))

(defun analysis-linear-form (entries value)
  (let ((table (make-hash-table :test #'equal)))
    (loop for e in entries
          for place from 0
          for quotient = (funcall value e)
          unless (pzerop (car quotient))
            do (setf (gethash (loop for k below 4 collect (if (= k place) 1 0)) table) quotient))
    table))

(defun analysis-terms-of-degree (degree terms)
  (remove degree terms :key (lambda (term) (reduce #'+ (car term))) :test #'/=))

(defun analysis-quotient-shown (quotient)
  (algebra-general-quotient (car quotient) (cdr quotient)))

(defun $analysis_without_frequencies (e lambdas relation)
  "[coefficient, ..] of E in lambda1^i*lambda2^j, the first that of 1."
  (analysis-with-frequencies (value (list e) lambdas relation)
    (destructuring-bind (n . d) (funcall value e)
      (let ((terms (algebra-monomial-terms n (analysis-frequencies-variables
                                              *analysis-frequencies*))))
        (list* '(mlist simp)
               (analysis-quotient-shown
                (algebra-quotient-of (or (cdr (assoc '(0 0) terms :test #'equal)) 0) d))
               (loop for (exponents . a) in terms
                     unless (equal exponents '(0 0))
                       collect (analysis-quotient-shown (algebra-quotient-of a d))))))))
