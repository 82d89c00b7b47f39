;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; RealRoot([a0, .., an], k), the k-th real root from below of a0*x^n + .. + an with whole numbers,
;;; an exact constant where no formula gives the root.  It is isolated by Sturm's chain; the
;;; interval is made smaller by quadratic interval refinement (J. Abbott, Quadratic interval
;;; refinement for real roots, 2006) as far as a sign needs it.  float and bfloat give its value.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/sturm"))

(defun algebra-real-root-p (e)
  (and (consp e) (consp (car e)) (eq (caar e) '|$RealRoot|)
       (= (length e) 3)
       ($listp (cadr e))
       (every #'integerp (cdadr e))
       (typep (caddr e) '(integer 1))))

(defun $algebra_real_root_constants (coefficients)
  "The real roots in order of a polynomial with rational COEFFICIENTS, highest first."
  (let ((p (algebra-primitive (mapcar #'algebra-rational-number (cdr coefficients)))))
    (cons '(mlist simp)
          (loop for k from 1 to (algebra-real-roots-between p nil nil)
                collect (simplify `((|$RealRoot|) ((mlist) ,@p) ,k))))))

(defun algebra-with-real-root-p (e)
  (and (consp e)
       (or (algebra-real-root-p e)
           (some #'algebra-with-real-root-p (cdr e)))))

;;; What Maxima's simplifier makes of it: a number where float or bfloat went through.

(defun algebra-simplified-real-root (e ignored simplified)
  (declare (ignore ignored))
  (let* ((parts (mapcar (lambda (part) (simpcheck part simplified)) (cdr e)))
         (root (cons '(|$RealRoot|) parts)))
    (cond ((algebra-real-root-p root)
           (algebra-require-root (cdar parts) (cadr parts))
           (eqtest root e))
          ((and (= (length parts) 2) ($listp (car parts))
                (some #'floatp (cdar parts)) (every #'realp (cons (cadr parts) (cdar parts))))
           (coerce (algebra-root-near (mapcar #'rational (cdar parts)) (round (cadr parts)) 60)
                   'double-float))
          ((and (= (length parts) 2) ($listp (car parts)) (some #'$bfloatp (cdar parts)))
           ($bfloat (algebra-maxima-rational
                     (algebra-root-near (mapcar #'algebra-exact-number (cdar parts))
                                        (round (algebra-exact-number (cadr parts)))
                                        (+ 10 fpprec)))))
          (t (eqtest root e)))))

(setf (get '|$RealRoot| 'operators) 'algebra-simplified-real-root)

(defun algebra-exact-number (x)
  (if ($bfloatp x)
      (* (cadr x) (expt 2 (- (caddr x) (third (car x)))))
      (rational x)))

(defun algebra-require-root (p k)
  (let ((count (if (some #'plusp (mapcar #'abs p)) (algebra-real-roots-between p nil nil) 0)))
    (when (> k count)
      (core-error "RealRoot: the polynomial has ~D real root~:P; there is no root ~D" count k))))

(defun algebra-root-near (p k bits)
  (destructuring-bind (low . high) (algebra-root-enclosure (algebra-primitive p) k bits)
    (/ (+ low high) 2)))

;;; Enclosures

(defvar *algebra-root-enclosures* (make-hash-table :test #'equal)
  "(p . k) -> (p without multiple roots, low, high), the smallest that was asked for")

(defun algebra-root-enclosure (p k bits)
  "(low . high), rational, less than 2^-BITS apart."
  (when (> (hash-table-count *algebra-root-enclosures*) 500)
    (clrhash *algebra-root-enclosures*))
  (let* ((key (cons p k))
         (known (or (gethash key *algebra-root-enclosures*) (algebra-isolated-root p k)))
         (finer (apply #'algebra-refined-root (append known (list bits)))))
    (setf (gethash key *algebra-root-enclosures*) (cons (first known) finer))
    (cons (first finer) (second finer))))

(defun algebra-scaled-root (p k bits)
  "Whole numbers (low . high) with the root between them, in units of 2^-BITS."
  (destructuring-bind (low . high) (algebra-root-enclosure p k (+ 2 bits))
    (cons (- (values (ceiling (- (* low (ash 1 bits))))))
          (values (ceiling (* high (ash 1 bits)))))))

(defun algebra-isolated-root (p k)
  "(square-free p, low, high); P has no root at LOW, and one up to HIGH, the K-th."
  (algebra-require-root p k)
  (let* ((chain (algebra-sturm-chain p))
         (p (first chain))
         (high (1+ (ceiling (reduce #'max (mapcar #'abs (cdr p))) (abs (car p)))))
         (low (- high))
         (before 0))
    (loop until (and (= 1 (algebra-chain-roots chain low high))
                     (/= 0 (algebra-sign-of-value p low)))
          do (let* ((middle (/ (+ low high) 2))
                    (count (algebra-chain-roots chain low middle)))
               (if (>= (+ before count) k)
                   (setq high middle)
                   (setq low middle
                         before (+ before count)))))
    (list p low high)))

(defun algebra-scaled-value (p m s)
  "2^(s*n) times the value at M/2^S of the polynomial P of degree n: whole numbers alone."
  (let ((value 0) (power 0))
    (dolist (c p value)
      (setq value (+ (* value m) (ash c power))
            power (+ power s)))))

(defun algebra-refined-root (p low high bits)
  "(low high): that of 2^j parts of the interval where a straight line ends in zero, j doubled when
it was found, else halved."
  (let* ((s (1- (integer-length (lcm (denominator low) (denominator high)))))
         (low (* low (ash 1 s)))
         (high (* high (ash 1 s)))
         (j 2)
         (n (1- (length p))))
    (loop
      (let ((of-low (algebra-scaled-value p low s))
            (of-high (algebra-scaled-value p high s)))
        (cond ((zerop of-high) (return (list (/ high (ash 1 s)) (/ high (ash 1 s)))))
              ((<= (ash (- high low) bits) (ash 1 s))
               (return (list (/ low (ash 1 s)) (/ high (ash 1 s))))))
        (let* ((parts (ash 1 j))
               (k (max 0 (min (1- parts) (floor (ash of-low j) (- of-low of-high)))))
               (step (- high low))
               (finer (+ s j))
               (found nil))
          (flet ((value (i) (cond ((= i 0) (ash of-low (* n j)))
                                  ((= i parts) (ash of-high (* n j)))
                                  (t (algebra-scaled-value p (+ (ash low j) (* i step)) finer)))))
            (dolist (i (list k (1- k) (1+ k)))
              (when (and (not found) (< -1 i parts))
                (let ((of-a (value i)) (of-b (value (1+ i))))
                  (when (and (/= 0 of-a)
                             (or (zerop of-b) (/= (signum of-a) (signum of-b))))
                    (setq found i))))))
          (if found
              (setq high (+ (ash low j) (* (1+ found) step))
                    low (- high step)
                    s finer
                    j (* 2 j))
              (setq j (max 1 (floor j 2)))))))))
