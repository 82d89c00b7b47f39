;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Groebner bases by Buchberger's algorithm (B. Buchberger; Becker, Weispfenning, Groebner Bases,
;;; ch. 5).  A polynomial is a list of (exponents . coefficient), the greatest monomial first;
;;; coefficients are integers or polynomials in parameters, and no fraction is ever formed: what
;;; a basis says follows from the given equations.  The work is counted, and too much is given up.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size"))

(defvar *algebra-degree-order* nil
  "true: monomials in the order of their degrees (graded, reversed); first: by the first exponent,
then so; false: lexicographic.")
(defvar *algebra-work-left* 0 "how many coefficients may still be formed")
(defvar *algebra-growing-basis* #() "what has been found of the last basis")
(defvar *algebra-taken* nil "polynomials in parameters that were taken as not zero")

;;; Monomials

(defun algebra-greater-monomial-p (a b)
  (cond ((null *algebra-degree-order*)
         (loop for x fixnum in a
               for y fixnum in b
               unless (= x y) return (> x y)))
        ((and (eq *algebra-degree-order* 'first) (/= (the fixnum (first a)) (the fixnum (first b))))
         (> (the fixnum (first a)) (the fixnum (first b))))
        (t (algebra-greater-degree-p a b))))

(defun algebra-greater-degree-p (a b)
  (let ((of-a (algebra-exponents-degree a))
        (of-b (algebra-exponents-degree b))
        (answer nil))
    (declare (fixnum of-a of-b))
    (if (/= of-a of-b)
        (> of-a of-b)
        (loop for x fixnum in a
              for y fixnum in b
              unless (= x y) do (setq answer (< x y))
              finally (return answer)))))

(defun algebra-exponents-degree (a)
  (let ((degree 0))
    (declare (fixnum degree))
    (dolist (x a degree) (incf degree (the fixnum x)))))

(defun algebra-monomial-divides-p (a b)
  (loop for x fixnum in a
        for y fixnum in b
        always (<= x y)))

(defun algebra-monomial-lcm (a b)
  (loop for x fixnum in a
        for y fixnum in b
        collect (if (> x y) x y)))

(defun algebra-coprime-p (a b)
  (loop for x fixnum in a
        for y fixnum in b
        always (or (zerop x) (zerop y))))

(defun algebra-monomial-quotient (a b) (mapcar #'- a b))

;;; Polynomials

(defun algebra-lead (p) (caar p))

(defun algebra-lead-coefficient (p) (cdar p))

(defun algebra-combined (c p d shift q)
  "c*P + d*x^SHIFT*Q."
  (let ((shifted (loop for (monomial . a) in q
                       collect (cons (mapcar #'+ monomial shift) (ptimes d a))))
        (scaled (algebra-scaled c p))
        (sum nil))
    (algebra-count-work shifted)
    (loop while (and scaled shifted)
          do (let ((a (caar scaled)) (b (caar shifted)))
               (cond ((equal a b)
                      (let ((coefficient (pplus (cdr (pop scaled)) (cdr (pop shifted)))))
                        (unless (pzerop coefficient) (push (cons a coefficient) sum))))
                     ((algebra-greater-monomial-p a b) (push (pop scaled) sum))
                     (t (push (pop shifted) sum)))))
    (nreconc sum (or scaled shifted))))

(defun algebra-scaled (c p)
  (if (eql c 1)
      p
      (progn (algebra-count-work p)
             (loop for (monomial . a) in p collect (cons monomial (ptimes c a))))))

(defun algebra-count-work (p)
  (algebra-spend (loop for (nil . a) in p
                       sum (if (integerp a)
                               (1+ (ash (integer-length a) -6))
                               (* 4 (algebra-monomials a))))))

(defun algebra-spend (work)
  #-sbcl (core-watch)
  (decf *algebra-work-left* work)
  (when (minusp *algebra-work-left*) (throw 'algebra-too-large 'too-large)))

(defun algebra-shared-divisor (a b)
  "The greatest divisor of two coefficients; of polynomials it costs about as much as a product."
  (unless (or (integerp a) (integerp b))
    (algebra-spend (ash (* (algebra-monomials a) (algebra-monomials b)) -3)))
  (pgcd a b))

(defun algebra-content-of (p)
  (let ((content 0))
    (loop for (nil . a) in p
          until (eql content 1)
          do (setq content (algebra-shared-divisor content a)))
    content))

(defun algebra-without-content (p)
  "P divided by what all its coefficients have in common, its first one positive."
  (if (null p)
      p
      (let* ((content (algebra-content-of p))
             (divisor (if (pminusp (pquotient (algebra-lead-coefficient p) content))
                          (pminus content)
                          content)))
        (algebra-take content)
        (if (eql divisor 1)
            p
            (loop for (monomial . a) in p collect (cons monomial (pquotient a divisor)))))))

(defun algebra-cancelling (a b)
  "c and d with c*A = d*B, without a common factor."
  (let ((common (algebra-shared-divisor a b)))
    (values (pquotient b common) (pquotient a common))))

(defun algebra-take (coefficient)
  (unless (integerp coefficient) (pushnew coefficient *algebra-taken* :test #'equal)))

;;; Division

(defun algebra-divided-rest (p basis)
  "The rest of P divided by the BASIS, and the factor by which P had to be multiplied."
  (let ((rest nil) (factor 1))
    (loop while p
          do (let ((divisor (find-if (lambda (g) (algebra-monomial-divides-p (algebra-lead g)
                                                                             (algebra-lead p)))
                                     basis)))
               (if divisor
                   (multiple-value-bind (c d)
                       (algebra-cancelling (algebra-lead-coefficient p)
                                           (algebra-lead-coefficient divisor))
                     (setq p (algebra-combined c p (pminus d)
                                               (algebra-monomial-quotient (algebra-lead p)
                                                                          (algebra-lead divisor))
                                               divisor)
                           rest (algebra-scaled c rest)
                           factor (ptimes c factor)))
                   (push (pop p) rest))))
    (values (nreverse rest) factor)))

(defun algebra-critical-polynomial (p q)
  "Multiples of P and Q, subtracted so that their first terms cancel."
  (let ((lcm (algebra-monomial-lcm (algebra-lead p) (algebra-lead q))))
    (multiple-value-bind (c d)
        (algebra-cancelling (algebra-lead-coefficient p) (algebra-lead-coefficient q))
      (algebra-combined 1 (algebra-combined 0 nil c
                                            (algebra-monomial-quotient lcm (algebra-lead p)) p)
                        (pminus d) (algebra-monomial-quotient lcm (algebra-lead q)) q))))

;;; Buchberger's algorithm, a pair being (i j lcm of the first terms); which pairs are needed:
;;; R. Gebauer, H. M. Moeller, On an installation of Buchberger's algorithm, J. Symb. Comp. 6, 1988.

(defun algebra-basis-of (polynomials &optional known degree)
  "The reduced Groebner basis in the order at hand of POLYNOMIALS and the basis KNOWN; what does not
come from pairs of more than a DEGREE."
  (let ((basis (algebra-growing known))
        (pairs nil))
    (setq *algebra-growing-basis* basis)
    (dolist (p polynomials)
      (setq pairs (algebra-joined-to-basis (algebra-rest-of p basis) basis pairs)))
    (loop while (and pairs
                     (or (null degree)
                         (<= (algebra-exponents-degree (third (first pairs))) degree)))
          do (let ((p (algebra-pair-polynomial (pop pairs) basis)))
               (setq pairs (algebra-joined-to-basis (algebra-rest-of p basis) basis pairs))))
    (algebra-reduced-basis (coerce basis 'list))))

(defun algebra-growing (elements)
  (make-array (length elements) :adjustable t :fill-pointer t :initial-contents elements))

(defun algebra-rest-of (p basis)
  (algebra-without-content (values (algebra-divided-rest p (coerce basis 'list)))))

(defun algebra-pair-polynomial (pair basis)
  (algebra-critical-polynomial (aref basis (first pair)) (aref basis (second pair))))

(defun algebra-joined-to-basis (p basis pairs)
  "Joins P, a rest by the BASIS, to it; the pairs to be looked at, new ones among them."
  (if (null p)
      pairs
      (let ((h (algebra-lead p))
            (j (vector-push-extend p basis)))
        (algebra-take (algebra-lead-coefficient p))
        (merge 'list
               (sort (algebra-needed-pairs h j basis) #'algebra-pair-before-p)
               (remove-if (lambda (pair) (algebra-pair-covered-p pair h basis)) pairs)
               #'algebra-pair-before-p))))

(defun algebra-pair-before-p (a b) (algebra-greater-degree-p (third b) (third a)))

(defun algebra-pair-covered-p (pair h basis)
  "Whether the PAIR follows from those of both its elements with the new one, of first term H."
  (destructuring-bind (i j lcm) pair
    (and (algebra-monomial-divides-p h lcm)
         (not (equal lcm (algebra-monomial-lcm h (algebra-lead (aref basis i)))))
         (not (equal lcm (algebra-monomial-lcm h (algebra-lead (aref basis j))))))))

(defun algebra-needed-pairs (h j basis)
  "Of the pairs of element J, of first term H, with those before it."
  (let ((waiting (loop for i below j
                       collect (list i j (algebra-monomial-lcm h (algebra-lead (aref basis i))))))
        (kept '()))
    (loop while waiting
          do (let* ((pair (pop waiting))
                    (lcm (third pair)))
               (flet ((divides-p (other) (algebra-monomial-divides-p (third other) lcm)))
                 (when (or (algebra-coprime-p h (algebra-lead (aref basis (first pair))))
                           (notany #'divides-p (append kept waiting)))
                   (push pair kept)))))
    (remove-if (lambda (pair) (algebra-coprime-p h (algebra-lead (aref basis (first pair)))))
               kept)))

(defun algebra-reduced-basis (basis)
  (let ((least (loop for g in basis
                     unless (some (lambda (h)
                                    (and (not (eq h g))
                                         (algebra-monomial-divides-p (algebra-lead h)
                                                                     (algebra-lead g))
                                         (or (not (equal (algebra-lead h) (algebra-lead g)))
                                             (member g (member h basis)))))
                                  basis)
                       collect g)))
    (sort (loop for g in least
                collect (algebra-without-content
                         (algebra-divided-rest g (remove g least :test #'eq))))
          (lambda (g h) (algebra-greater-monomial-p (algebra-lead g) (algebra-lead h))))))
