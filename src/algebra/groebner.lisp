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
  (let ((of-a (reduce #'+ a))
        (of-b (reduce #'+ b))
        (answer nil))
    (if (/= of-a of-b)
        (> of-a of-b)
        (loop for x in a
              for y in b
              unless (= x y) do (setq answer (< x y))
              finally (return answer)))))

(defun algebra-monomial-divides-p (a b) (every #'<= a b))

(defun algebra-monomial-lcm (a b) (mapcar #'max a b))

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
  (decf *algebra-work-left*
        (loop for (nil . a) in p
              sum (if (integerp a) (1+ (ash (integer-length a) -6)) (* 4 (algebra-monomials a)))))
  (when (minusp *algebra-work-left*) (throw 'algebra-too-large 'too-large)))

(defun algebra-content-of (p)
  (let ((content 0))
    (loop for (nil . a) in p
          until (eql content 1)
          do (setq content (pgcd content a)))
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
  (let ((common (pgcd a b)))
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

;;; Buchberger's algorithm

(defun algebra-basis-of (polynomials &optional known degree)
  "The reduced Groebner basis in the order at hand of POLYNOMIALS and the basis KNOWN; what does not
come from pairs of more than a DEGREE."
  (let ((basis (make-array (max 8 (length known)) :adjustable t :fill-pointer 0))
        (pairs nil))
    (dolist (p known) (vector-push-extend p basis))
    (dolist (p polynomials)
      (setq pairs (algebra-joined-to-basis p basis pairs)))
    (loop while pairs
          do (let ((pair (algebra-next-pair pairs)))
               (setq pairs (delete pair pairs :test #'eq))
               (unless (or (and degree (> (reduce #'+ (third pair)) degree))
                           (algebra-superfluous-pair-p pair basis pairs))
                 (destructuring-bind (i j lcm) pair
                   (declare (ignore lcm))
                   (setq pairs (algebra-joined-to-basis
                                (algebra-critical-polynomial (aref basis i) (aref basis j))
                                basis pairs))))))
    (algebra-reduced-basis (coerce basis 'list))))

(defun algebra-joined-to-basis (p basis pairs)
  "Joins the rest of P to the BASIS; the pairs to be looked at, new ones among them."
  (let ((rest (algebra-without-content (algebra-divided-rest p (coerce basis 'list)))))
    (if (null rest)
        pairs
        (let ((j (vector-push-extend rest basis)))
          (algebra-take (algebra-lead-coefficient rest))
          (append (loop for i below j
                        collect (list i j (algebra-monomial-lcm (algebra-lead (aref basis i))
                                                                (algebra-lead rest))))
                  pairs)))))

(defun algebra-next-pair (pairs)
  (let ((best (first pairs)))
    (dolist (pair (rest pairs) best)
      (when (algebra-greater-degree-p (third best) (third pair)) (setq best pair)))))

(defun algebra-superfluous-pair-p (pair basis pairs)
  "Buchberger's two criteria."
  (destructuring-bind (i j lcm) pair
    (or (equal lcm (mapcar #'+ (algebra-lead (aref basis i)) (algebra-lead (aref basis j))))
        (loop for k below (length basis)
              thereis (and (/= k i) (/= k j)
                           (algebra-monomial-divides-p (algebra-lead (aref basis k)) lcm)
                           (not (algebra-waiting-p i k pairs))
                           (not (algebra-waiting-p j k pairs)))))))

(defun algebra-waiting-p (i j pairs)
  (find-if (lambda (pair) (and (= (first pair) (min i j)) (= (second pair) (max i j)))) pairs))

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
