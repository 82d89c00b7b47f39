;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The common roots of polynomials: algebra_triangular(e, x), equations that follow from e = 0 and
;;; whose unknowns vanish one after the other, from which e follows in turn; algebra_real_points(e,
;;; x), how many real roots there are.  Where there are finitely many, the quotient ring has a
;;; finite basis b_i: the lexicographic basis comes by linear algebra (Faugere, Gianni, Lazard,
;;; Mora), and the form tr(f -> b_i*b_j*f) has the number of real points as its signature (Hermite;
;;; Pedersen, Roy, Szpirglas).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/evaluate" "algebra/general_form" "algebra/groebner" "algebra/kernels"
                "algebra/normal" "algebra/relations" "algebra/scan"
                "algebra/matrices" "algebra/size"))

(defparameter *algebra-most-points* 48 "dimension of the quotient ring up to which it is formed")
(defparameter *algebra-most-exponent* 200 "exponent up to which bases are sought")
(defparameter *algebra-basis-work* 400000 "coefficients that a basis may cost: some seconds")

(defun $algebra_triangular (polynomials names)
  "[lexicographic Groebner basis, greatest first; parameters taken as not zero]; false where there
are roots or functions of the unknowns or bound parameters; where it is too long a sentence."
  (algebra-with-polynomials polynomials names
    (lambda (terms numbers kernels)
      (let ((*algebra-taken* nil))
        (list '(mlist simp)
              (cons '(mlist simp) (mapcar (lambda (p) (algebra-expression-of p kernels))
                                          (algebra-lexicographic-basis terms numbers)))
              (cons '(mlist simp) (mapcar #'algebra-general *algebra-taken*)))))))

(defun $algebra_real_points (polynomials names)
  "The number of real common roots; false where there are infinitely many, parameters, or too much."
  (let ((count (algebra-with-polynomials polynomials names
                 (lambda (terms numbers kernels)
                   (declare (ignore kernels))
                   (and numbers
                        (let ((*algebra-degree-order* t))
                          (algebra-real-points-of
                           (algebra-basis-of (algebra-sorted-polynomials terms)))))))))
    (if (stringp count) nil count)))

(defun algebra-real-points-of (basis)
  (let ((standard (algebra-standard-monomials basis)))
    (and (listp standard)
         (if standard (algebra-real-point-count basis standard) 0))))

(defun algebra-with-polynomials (polynomials names function)
  "FUNCTION of the terms of POLYNOMIALS, of whether all coefficients are numbers, and of the kernels
of NAMES; nil where it does not apply, a sentence where it gives up."
  (with-algebra-ring
    (let* ((*algebra-may-give-up* t)
           (*algebra-work-left* (core-sized *algebra-basis-work*))
           (skeletons (mapcar #'algebra-scan (cdr polynomials)))
           (kernels (mapcar #'algebra-scan (cdr names)))
           (answer (catch 'algebra-too-large
                     (algebra-order-kernels)
                     (if (algebra-polynomial-kernels-p kernels)
                         (let ((terms (algebra-monomials-of-all skeletons kernels)))
                           (algebra-require-exponents terms)
                           (funcall function terms (algebra-number-terms-p terms) kernels))))))
      (if (eq answer 'too-large) (algebra-basis-given-up) answer))))

(defun algebra-basis-given-up ()
  "What stopped the basis and lifts the limit; nil where there was none to begin with."
  (let ((most *algebra-basis-work*))
    (if (minusp *algebra-work-left*)
        (format nil "a Groebner basis was given up after ~D coefficients, the limit being ~D; ~A"
                (- (core-sized most) *algebra-work-left*) (core-sized most)
                (core-size-advice nil most)))))

(defun algebra-polynomial-kernels-p (kernels)
  "Whether the others are parameters, free of the names and of each other."
  (and (every #'algebra-kernel-p kernels)
       (let ((names (mapcar #'algebra-kernel-expression kernels)))
         (every (lambda (kernel)
                  (or (member kernel kernels)
                      (and (algebra-kernel-sure kernel)
                           (notany (lambda (name) (among name (algebra-kernel-expression kernel)))
                                   names))))
                (algebra-ring-kernels *algebra-ring*)))
       (null (algebra-ring-units *algebra-ring*))))

(defun algebra-require-exponents (polynomials)
  (dolist (p polynomials)
    (loop for (exponents . nil) in p
          when (some (lambda (n) (> n *algebra-most-exponent*)) exponents)
            do (throw 'algebra-too-large 'too-large))))

(defun algebra-monomials-of-all (skeletons kernels)
  (loop for skeleton in skeletons
        for (n . d) = (algebra-evaluate skeleton)
        when (some (lambda (kernel) (algebra-occurs-p (algebra-kernel-variable kernel) d)) kernels)
          do (throw 'algebra-too-large 'too-large)
        unless (pzerop n)
          collect (algebra-monomial-terms n (mapcar #'algebra-kernel-variable kernels))))

(defun algebra-monomial-terms (p variables)
  "((exponents . coefficient) ..) of the polynomial P."
  (if (null variables)
      (if (pzerop p) nil (list (cons nil p)))
      (loop for (exponent coefficient) in (algebra-powers p (first variables))
            append (loop for (exponents . a)
                           in (algebra-monomial-terms coefficient (rest variables))
                         collect (cons (cons exponent exponents) a)))))

(defun algebra-number-terms-p (polynomials)
  (every (lambda (p) (every (lambda (term) (integerp (cdr term))) p)) polynomials))

(defun algebra-sorted-polynomials (polynomials)
  "Terms and polynomials in the order at hand, short ones first."
  (sort (loop for p in polynomials
              collect (algebra-without-content
                       (sort (copy-list p) #'algebra-greater-monomial-p :key #'car)))
        #'< :key #'length))

(defun algebra-expression-of (p kernels)
  ($expand (addn (loop for (exponents . a) in p
                       collect (muln (cons (algebra-general a)
                                           (loop for kernel in kernels
                                                 for exponent in exponents
                                                 collect (power (algebra-kernel-expression kernel)
                                                                exponent)))
                                     nil))
                 nil)))

(defun algebra-lexicographic-basis (terms numbers)
  (if numbers
      (let* ((*algebra-degree-order* t)
             (basis (algebra-basis-of (algebra-sorted-polynomials terms)))
             (standard (algebra-standard-monomials basis)))
        (cond ((null standard) basis)
              ((listp standard) (algebra-lexicographic-from basis standard))
              (t (algebra-lexicographic-straight basis))))
      (algebra-lexicographic-straight terms)))

(defun algebra-lexicographic-straight (terms)
  (let ((*algebra-degree-order* nil))
    (algebra-basis-of (algebra-sorted-polynomials terms))))

;;; The quotient ring

(defun algebra-standard-monomials (basis)
  "Monomials that no first term of the BASIS divides, 1 first; `infinite' where there are too many."
  (let ((leads (mapcar #'algebra-lead basis)))
    (if (some (lambda (lead) (every #'zerop lead)) leads)
        nil
        (algebra-standard-below leads (length (first leads))))))

(defun algebra-standard-below (leads n)
  (if (loop for k below n
            thereis (notany (lambda (lead) (= (nth k lead) (reduce #'+ lead))) leads))
      'infinite
      (let ((standard (list (make-list n :initial-element 0))))
        (loop for tail on standard
              do (dotimes (k n)
                   (let ((next (algebra-raised (car tail) k)))
                     (unless (or (member next standard :test #'equal)
                                 (some (lambda (lead) (algebra-monomial-divides-p lead next))
                                       leads))
                       (setf (cdr (last tail)) (list next)))))
              when (> (length standard) (core-sized *algebra-most-points*)) return 'infinite
              finally (return standard)))))

(defun algebra-raised (monomial k)
  (let ((next (copy-list monomial)))
    (incf (nth k next))
    next))

(defun algebra-coordinates (monomial basis standard)
  "The coordinates of MONOMIAL in the quotient ring."
  (multiple-value-bind (rest factor) (algebra-divided-rest (list (cons monomial 1)) basis)
    (let ((vector (make-array (length standard) :initial-element 0)))
      (loop for (m . a) in rest
            do (setf (aref vector (position m standard :test #'equal)) (/ a factor)))
      vector)))

(defun algebra-multiplications (basis standard)
  "For each unknown the coordinates of its products with the STANDARD monomials."
  (loop for k below (length (first standard))
        collect (map 'vector (lambda (b) (algebra-coordinates (algebra-raised b k) basis standard))
                     standard)))

(defun algebra-multiplied (rows vector)
  "The sum of the ROWS times the entries of VECTOR."
  (let ((sum (make-array (length vector) :initial-element 0)))
    (loop for a across vector
          for row across rows
          unless (zerop a)
            do (algebra-count-work `((nil . ,(numerator a))))
               (dotimes (j (length sum))
                 (incf (aref sum j) (* a (aref row j)))))
    sum))

;;; The lexicographic basis

(defun algebra-lexicographic-from (basis standard)
  "Monomials from below: one that depends on those before it gives a polynomial."
  (let ((multiplications (algebra-multiplications basis standard))
        (waiting (list (cons (first standard) (algebra-coordinates (first standard) basis
                                                                   standard))))
        (echelon nil)
        (found nil))
    (loop while waiting
          do (destructuring-bind (monomial . vector) (pop waiting)
               (unless (some (lambda (g) (algebra-monomial-divides-p (algebra-lead g) monomial))
                             found)
                 (multiple-value-bind (rest combination)
                     (algebra-reduced-row vector (list (cons monomial 1)) echelon)
                   (cond ((every #'zerop rest) (push (algebra-integral combination) found))
                         (t (push (cons rest combination) echelon)
                            (setq waiting (algebra-more-waiting monomial vector multiplications
                                                                waiting))))))))
    found))

(defun algebra-more-waiting (monomial vector multiplications waiting)
  (let ((*algebra-degree-order* nil))
    (loop for rows in multiplications
          for k from 0
          for next = (algebra-raised monomial k)
          unless (assoc next waiting :test #'equal)
            do (setq waiting (merge 'list waiting
                                    (list (cons next (algebra-multiplied rows vector)))
                                    (lambda (a b) (algebra-greater-monomial-p b a)) :key #'car)))
    waiting))

(defun algebra-reduced-row (vector combination echelon)
  "VECTOR less multiples of the rows of ECHELON, and the COMBINATION of monomials that it is."
  (let ((rest (copy-seq vector)))
    (loop for (row . of-row) in (reverse echelon)
          for place = (position 0 row :test-not #'eql)
          for factor = (/ (aref rest place) (aref row place))
          unless (zerop factor)
            do (algebra-count-work `((nil . ,(numerator factor))))
               (dotimes (j (length rest))
                 (decf (aref rest j) (* factor (aref row j))))
               (setq combination (algebra-rational-sum combination (- factor) of-row)))
    (values rest combination)))

(defun algebra-rational-sum (combination factor other)
  (let ((sum (copy-alist combination)))
    (loop for (monomial . a) in other
          for here = (assoc monomial sum :test #'equal)
          do (if here
                 (incf (cdr here) (* factor a))
                 (push (cons monomial (* factor a)) sum)))
    sum))

(defun algebra-integral (combination)
  "The polynomial of a COMBINATION with rational coefficients, without fractions."
  (let ((common (reduce #'lcm (mapcar (lambda (term) (denominator (cdr term))) combination)))
        (*algebra-degree-order* nil))
    (algebra-without-content
     (sort (loop for (monomial . a) in combination
                 unless (zerop a) collect (cons monomial (* a common)))
           #'algebra-greater-monomial-p :key #'car))))

;;; Hermite's form

(defun algebra-real-point-count (basis standard)
  (let* ((multiplications (algebra-multiplications basis standard))
         (products (algebra-products standard multiplications))
         (traces (algebra-traces products))
         (form (algebra-trace-form products traces)))
    (algebra-signature-of form)))

(defun algebra-products (standard multiplications)
  "For each standard monomial the coordinates of its products with all of them."
  (let ((products nil)
        (n (length standard)))
    (dolist (b standard)
      (push (cons b (if (every #'zerop b)
                        (algebra-unit-rows n)
                        (let* ((k (position-if #'plusp b))
                               (lower (cdr (assoc (algebra-lowered b k) products :test #'equal))))
                          (map 'vector (lambda (row)
                                         (algebra-multiplied (nth k multiplications) row))
                               lower))))
            products))
    (mapcar #'cdr (reverse products))))

(defun algebra-lowered (monomial k)
  (let ((lower (copy-list monomial)))
    (decf (nth k lower))
    lower))

(defun algebra-unit-rows (n)
  (let ((rows (make-array n)))
    (dotimes (i n rows)
      (setf (aref rows i) (make-array n :initial-element 0)
            (aref (aref rows i) i) 1))))

(defun algebra-traces (products)
  (map 'vector (lambda (rows) (loop for row across rows for i from 0 sum (aref row i))) products))

(defun algebra-trace-form (products traces)
  "Rows of tr(b_i*b_j)."
  (map 'vector (lambda (rows)
                 (map 'vector (lambda (row) (loop for a across row
                                                  for trace across traces
                                                  sum (* a trace)))
                      rows))
       products))

(defun algebra-signature-of (rows)
  "Positive less negative squares of a symmetric form of rational numbers, ROWS, which is changed."
  (destructuring-bind (positive negative zero)
      (algebra-signature (algebra-rational-form
                          rows (lambda (a b)
                                 (let ((factor (/ a b)))
                                   (unless (zerop factor)
                                     (algebra-count-work `((nil . ,(numerator factor)))))
                                   factor))))
    (declare (ignore zero))
    (- positive negative)))
