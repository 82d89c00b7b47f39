;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Signs of polynomials by what bounds their names: by Sturm's count of the real roots between the
;;; bounds of the one name; by facts c*x + u > 0 put in as x = (d - u)/c, d > 0,
;;; one after the other, until all terms have one sign; by a proof from the facts.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/known_signs" "algebra/sturm"
                "algebra/packed_polynomials" "algebra/sign_by_parts" "algebra/sign_by_proof"))

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

(defun algebra-numbers-of (e x)
  "The rational coefficients of E, highest power first."
  (reverse (mapcar #'algebra-rational-number (algebra-powers-in e x))))

(defun algebra-range (x)
  "Four values: the largest known lower bound of X and whether it is left out, and the same above;
nil where there is none. Facts of degree 8 at most are asked, which takes milliseconds."
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
            do (when (and (<= 2 (length powers) 9) (every #'algebra-rational-number powers))
                 (loop for (direction bound open) in (algebra-fact-bounds
                                                      (algebra-numbers-of e x) sign)
                       do (if (plusp direction) (below bound open) (above bound open))))))
    (values low low-open high high-open)))

(defun algebra-fact-bounds (numbers sign)
  "((1 or -1, bound, left out) ..): where the polynomial with the coefficients NUMBERS has not SIGN,
beyond its last or its first real root; a root that is no short fraction is rounded outwards."
  (let* ((p (algebra-primitive numbers))
         (chain (algebra-sturm-chain p))
         (reach (1+ (ceiling (reduce #'max (mapcar #'abs (cdr p))) (abs (car p)))))
         (places (algebra-places-between chain (- reach) reach)))
    (when places
      (loop for direction in '(-1 1)
            for place = (if (plusp direction) (car (last places)) (first places))
            unless (or (eq sign '$unknown)
                       (member (algebra-sign-far-out p direction) (algebra-sign-values sign)))
              collect (let ((root (algebra-outermost-root chain place direction)))
                        (list direction (or root (+ place (* direction 1/10000000)))
                              (and root (not (member 0 (algebra-sign-values sign))))))))))

(defun algebra-outermost-root (chain place direction)
  "The root near PLACE as a fraction of 1000000, none lying beyond it; nil where it is none."
  (let ((root (/ (round (* place 1000000)) 1000000)))
    (and (zerop (algebra-sign-of-value (car chain) root))
         (eql (if (plusp direction) 0 1)
              (if (plusp direction)
                  (algebra-chain-roots chain root nil)
                  (algebra-chain-roots chain nil root)))
         root)))

(defun algebra-sign-between (e x low low-open high high-open)
  "The sign of the polynomial E in X between the bounds, where it has no root there."
  (let ((inner (algebra-real-roots-between (algebra-numbers-of e x) low high))
        (at-low (and low (algebra-number-sign-at e x low)))
        (at-high (and high (algebra-number-sign-at e x high))))
    (when (and high (eq at-high '$zero)) (decf inner))
    (cond ((and low high (>= low high)) '$unknown)
          ((plusp inner) '$unknown)
          (t (let ((sign (algebra-number-sign-at e x (algebra-point-between low high))))
               (if (or (and (not low-open) (eq at-low '$zero))
                       (and (not high-open) (eq at-high '$zero)))
                   (if (eq sign '$pos) '$pz '$nz)
                   sign))))))

(defun algebra-number-sign-at (e x number)
  (algebra-constant-sign (maxima-substitute (algebra-maxima-rational number) x e)))

(defun algebra-point-between (low high)
  (cond ((and low high) (/ (+ low high) 2))
        (low (1+ low))
        (high (1- high))
        (t 0)))

;;; Facts put in

(defstruct (algebra-bounded (:predicate nil) (:copier nil))
  table   ; the polynomial
  gaps    ; the facts as (table . sign)
  signs   ; of all variables, the last of which stand for the differences d
  places) ; of the names that may still be put in

(defparameter *algebra-shift-depth* 5 "How many facts may be put in, one after the other.")
(defvar *algebra-shifts-left* 0 "How many more facts may be put in at all.")

(defun algebra-moderate-p (e degree)
  "Whether the expanded E is of DEGREE at most in each name and kernel."
  (loop for term in (algebra-summands e)
        always (loop for factor in (algebra-factors-of term)
                     always (or (eq (algebra-base-of factor) factor)
                                (<= (caddr factor) degree)))))

(defun algebra-shifted-sign (e)
  (if (algebra-moderate-p e 30) (algebra-sign-by-shifts e) '$unknown))

(defun algebra-sign-by-shifts (e)
  (let* ((gaps (algebra-related-gaps e (algebra-linear-gaps *algebra-knowledge*)))
         (kernels (append (algebra-kernels-of (cons e (mapcar #'car gaps)))
                          (loop repeat *algebra-shift-depth* collect 'difference)))
         (signs (mapcar (lambda (kernel) (if (eq kernel 'difference)
                                             '$unknown
                                             (algebra-part-sign kernel)))
                        kernels))
         (table (algebra-table-of e kernels))
         (problem (make-algebra-bounded
                   :table table :signs signs :places (algebra-shift-places kernels)
                   :gaps (loop for (gap . sign) in gaps
                               collect (cons (algebra-table-of gap kernels) sign))))
         (*algebra-shifts-left* (floor 10000 (+ 100 (* 10 (hash-table-count table))))))
    (loop for depth from 1 to (min *algebra-shift-depth* (length gaps))
          for sign = (algebra-shift problem depth)
          unless (eq sign '$unknown) return sign
          finally (return '$unknown))))

(defun algebra-linear-gaps (knowledge)
  "Sums of known sign, turned so that it is pos, pz or zero."
  (loop for (e . sign) in (knowledge-sums knowledge)
        append (case (and (algebra-moderate-p e 6) sign)
                 (($pos $pz $zero) (list (cons e sign)))
                 (($neg $nz) (list (cons (algebra-turned e) (algebra-opposite-sign sign)))))))

(defun algebra-shift-places (kernels)
  "Places of the names that do not stand inside of other kernels."
  (loop for kernel in kernels for place from 0
        when (and (symbolp kernel) (not (eq kernel 'difference))
                  (every (lambda (other) (or (symbolp other) (free other kernel))) kernels))
          collect place))

(defun algebra-table-sign (table signs)
  "The sign of terms that agree, else unknown."
  (let ((sum '$zero))
    (loop for monomial being the hash-keys of table using (hash-value number)
          do (setq sum (algebra-plus-sign sum (algebra-monomial-sign number monomial signs)))
          until (eq sum '$unknown))
    sum))

(defun algebra-monomial-sign (number monomial signs)
  (let ((product (if (plusp number) '$pos '$neg)))
    (loop for sign in signs for place from 0
          for power = (algebra-exponent monomial place)
          do (setq product
                   (algebra-times-sign product
                                       (cond ((zerop power) '$pos)
                                             ((oddp power) sign)
                                             (t (algebra-even-sign sign))))))
    product))

(defun algebra-even-sign (sign)
  "The sign of the square of what has SIGN; unknown may be no real number."
  (case sign
    (($pos $neg $pn) '$pos)
    (($pz $nz) '$pz)
    (t sign)))

(defun algebra-shift (problem depth)
  "The sign of the polynomial with DEPTH of the facts put in at most."
  (let* ((table (algebra-bounded-table problem))
         (sign (algebra-table-sign table (algebra-bounded-signs problem))))
    (if (or (not (eq sign '$unknown)) (zerop depth) (minusp (decf *algebra-shifts-left*))
            (> (hash-table-count table) 500))
        sign
        (loop for gap in (algebra-bounded-gaps problem)
              do (dolist (place (algebra-bounded-places problem))
                   (let ((sign (algebra-shift-by problem gap place depth)))
                     (unless (eq sign '$unknown) (return-from algebra-shift sign))))
              finally (return '$unknown)))))

(defun algebra-gap-slope (table gap place signs)
  "The coefficient, of known sign, of the variable at PLACE in which GAP is linear and which occurs
in TABLE; else nil."
  (and (eql 1 (algebra-table-degree-in gap place))
       (<= 1 (algebra-table-degree-in table place)
           (/ (- *algebra-table-degree* (algebra-table-degree table))
              (algebra-table-degree gap)))
       (let ((slope (algebra-table-coefficient gap place 1)))
         (and (member (algebra-table-sign slope signs) '($pos $neg)) slope))))

(defun algebra-shift-by (problem gap place depth)
  "The sign with x = (d - u)/c from the GAP c*x + u = d, x the variable at PLACE, where the sign of
c is known."
  (let ((slope (algebra-gap-slope (algebra-bounded-table problem) (car gap) place
                                  (algebra-bounded-signs problem))))
    (if (null slope)
        '$unknown
        (multiple-value-bind (shifted turned)
            (algebra-shifted-problem problem gap place slope depth)
          (let ((sign (algebra-shift shifted (1- depth))))
            (if turned (algebra-opposite-sign sign) sign))))))

(defun algebra-shifted-problem (problem gap place slope depth)
  "What is left with x put in, each table times a power of c = SLOPE; whether the sign has turned."
  (let* ((signs (algebra-bounded-signs problem))
         (slot (- (length signs) depth))
         (value (algebra-table-sum (algebra-difference gap slot)
                                   (algebra-table-coefficient (car gap) place 0) -1))
         (negative (eq (algebra-table-sign slope signs) '$neg)))
    (labels ((turned-p (table)
               (and negative (oddp (algebra-table-degree-in table place))))
             (put-in (table) (algebra-table-put-in table place value slope))
             (put-in-gap (gap)
               (cons (put-in (car gap))
                     (if (turned-p (car gap)) (algebra-opposite-sign (cdr gap)) (cdr gap)))))
      (values (make-algebra-bounded
               :table (put-in (algebra-bounded-table problem))
               :gaps (mapcar #'put-in-gap (remove gap (algebra-bounded-gaps problem) :test #'eq))
               :signs (substitute-if (cdr gap) (constantly t) signs :start slot :end (1+ slot))
               :places (remove place (algebra-bounded-places problem)))
              (turned-p (algebra-bounded-table problem))))))

(defun algebra-difference (gap slot)
  "The new variable d of the GAP as a table, none where the gap is zero."
  (let ((table (algebra-new-table)))
    (unless (eq (cdr gap) '$zero)
      (setf (gethash (algebra-monomial-of slot 1) table) 1))
    table))

;;; A proof from the facts

(defun algebra-proved-sign (e)
  (if (algebra-moderate-p e 8)
      (algebra-certified-sign
       e (append (remove-if-not (lambda (gap) (algebra-moderate-p (car gap) 8))
                                (algebra-gaps *algebra-knowledge*))
                 (algebra-own-gaps e)))
      '$unknown))

(defun algebra-own-gaps (e)
  "What the kernels of E bring with them: signs, |sin x|, |cos x| <= 1, and cosh x >= 1."
  (loop for kernel in (algebra-kernels-of (list e))
        unless (symbolp kernel)
          collect (cons kernel (algebra-part-sign kernel))
          and when (and (consp kernel) (algebra-real-p (cadr kernel)))
                append (case (caar kernel)
                         ((%sin %cos)
                          (list (cons (add 1 kernel) '$pz) (cons (sub 1 kernel) '$pz)))
                         (%cosh (list (cons (sub kernel 1) '$pz))))))
