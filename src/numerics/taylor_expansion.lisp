;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The Taylor expansion of the solution of M x' = X(t, x), X a program, about a moment: each node
;;; of the program has a series and rules, which are run for k = 0, 1, ..; then x_(k+1) follows from
;;;     (k + 1) M x_(k+1) = scale X_k.
;;; The variable of the series is (time - moment)/scale. See numerics-expand first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"
                "algebra/program_record" "numerics/big_values" "numerics/program"
                "numerics/taylor_numbers" "numerics/taylor_series" "numerics/taylor_mass"))

(defstruct numerics-expansion
  bits order
  (scale 0)      ; a fixed-point number, as all below
  time states    ; series
  rates          ; series of X
  solve          ; nil, or the function of a list of X_k: that of M^-1 X_k
  rules          ; of the nodes that move, in their order
  (lost nil)     ; whether a constant has no bit of these
  corners        ; (text y . x): nothing is said of what is past y = 0 where x is nil, or negative
  (series (make-hash-table))                 ; index of a node -> its series
  (partners (make-hash-table :test #'equal))) ; (operation part) -> series beside that of a node

(defun numerics-new-series (expansion)
  (make-array (+ 2 (numerics-expansion-order expansion)) :initial-element 0))

(defun numerics-constant-series (e expansion)
  (let ((series (numerics-new-series expansion))
        (value (numerics-fixed e (numerics-expansion-bits expansion))))
    (when (and (eql value 0) (not (and (mnump e) (zerop1 e))))
      (setf (numerics-expansion-lost expansion) t))
    (setf (svref series 0) value)
    series))

(defun numerics-series-of (element expansion)
  (if (algebra-node-p element)
      (gethash (algebra-node-index element) (numerics-expansion-series expansion))
      (numerics-constant-series element expansion)))

(defun numerics-expansion-of (program bits order)
  "The expansion of PROGRAM; what no state and no time moves is computed here."
  (let* ((expansion (make-numerics-expansion :bits bits :order order))
         (elements (numerics-program-rates program))
         (masses (mapcar #'cdr (apply #'append (numerics-program-mass program)))))
    (setf (numerics-expansion-time expansion) (numerics-new-series expansion)
          (numerics-expansion-states expansion)
          (loop for nil in elements collect (numerics-new-series expansion)))
    (multiple-value-bind (fixed moving)
        (numerics-fixed-nodes (algebra-live-nodes (append elements masses)))
      (dolist (node fixed)
        (dolist (rule (numerics-node-rules node program expansion)) (funcall rule 0)))
      (setf (numerics-expansion-rules expansion)
            (loop for node in moving append (numerics-node-rules node program expansion))))
    (setf (numerics-expansion-rates expansion)
          (loop for element in elements collect (numerics-series-of element expansion))
          (numerics-expansion-solve expansion)
          (numerics-mass-solver
           program
           (lambda (element) (svref (numerics-series-of element expansion) 0))
           bits))
    expansion))

;;; Nodes. Each gets its series into the table, and a list of rules.

(defun numerics-note-series (node series expansion)
  (setf (gethash (algebra-node-index node) (numerics-expansion-series expansion)) series))

(defun numerics-node-rules (node program expansion)
  (let* ((part (if (algebra-input-p node) node (algebra-node-left node)))
         (key (list (algebra-node-operation node) (algebra-part-key part)))
         (known (gethash key (numerics-expansion-partners expansion))))
    (cond ((algebra-input-p node)
           (numerics-note-series node (numerics-input-series node program expansion) expansion)
           '())
          (known (numerics-note-series node known expansion)
                 '())
          (t (numerics-operation-rules
              node (numerics-note-series node (numerics-new-series expansion) expansion)
              expansion)))))

(defun numerics-input-series (node program expansion)
  (let* ((input (algebra-node-left node))
         (place (position input (numerics-program-names program) :test #'alike1)))
    (cond (place (nth place (numerics-expansion-states expansion)))
          ((eq input '$t) (numerics-expansion-time expansion))
          ((algebra-constant-input-p node) (numerics-constant-series input expansion))
          (t (core-error "~a has no value" (mfuncall '$string input))))))

(defun numerics-operation-rules (node out expansion)
  (let* ((bits (numerics-expansion-bits expansion)) (operation (algebra-node-operation node))
         (left (algebra-node-left node)) (second (algebra-node-right node))
         (x (numerics-series-of left expansion)) (y (numerics-series-of second expansion)))
    (case operation
      (:add (list (numerics-sum-rule out x y)))
      (:subtract (list (numerics-difference-rule out x y)))
      (:negate (list (numerics-multiple-rule out -1 x bits)))
      (:multiply (list (if (numberp left)
                           (numerics-multiple-rule out left y bits)
                           (numerics-product-rule out x y bits))))
      (:divide (numerics-note-corner expansion "a division by zero" y)
               (list (numerics-quotient-rule out x y bits)))
      (:root (numerics-note-corner expansion "the square root of 0" x)
             (list (numerics-root-rule out x bits)))
      (:power (numerics-general-power-rules out x second y expansion))
      (:polar-angle (numerics-polar-angle-rules out x y expansion))
      ((:absolute :sign) (numerics-corner-rules operation out x expansion))
      ((:sine :cosine :hyperbolic-sine :hyperbolic-cosine)
       (numerics-pair-rules operation out x (algebra-part-key left) expansion))
      (t (numerics-function-rules operation out x expansion)))))

;;; The series of a function may go on smoothly past a place where the function itself does not:
;;; sqrt of a square that passes 0, asin(sin(t)) past %pi/2, exp(-1/t^2), all of whose terms vanish
;;; at 0.

(defun numerics-note-corner (expansion text y &optional x)
  "No step goes past a zero of the series Y where the series X, if there is one, is negative; TEXT
says what is there."
  (unless (find y (numerics-expansion-corners expansion) :key #'second)
    (push (list* text y x) (numerics-expansion-corners expansion))))

;;; Functions of one argument: first the rules of series that they need beside their own.

(defun numerics-pair-rules (operation out x key expansion)
  (destructuring-bind (second direction second-direction)
      (ecase operation
        (:sine '(:cosine 1 -1))
        (:cosine '(:sine -1 1))
        (:hyperbolic-sine '(:hyperbolic-cosine 1 1))
        (:hyperbolic-cosine '(:hyperbolic-sine 1 1)))
    (let ((derivative (numerics-new-series expansion)) (other (numerics-new-series expansion))
          (bits (numerics-expansion-bits expansion)))
      (setf (gethash (list second key) (numerics-expansion-partners expansion)) other)
      (list (numerics-derivative-rule derivative x)
            (numerics-pair-rule (cons operation x) out derivative other direction bits)
            (numerics-pair-rule (cons second x) other derivative out second-direction bits)))))

(defun numerics-function-rules (operation out x expansion)
  (let ((bits (numerics-expansion-bits expansion)) (derivative (numerics-new-series expansion))
        (factor (numerics-new-series expansion)) (inner (numerics-new-series expansion)))
    (flet ((first () (numerics-fixed-function operation bits (svref x 0)))
           (one-less-square (series)
             (list (numerics-product-rule inner series series bits)
                   (numerics-multiple-rule inner -1 inner bits)
                   (numerics-constant-term-rule inner (ash 1 bits)))))
      (cons (if (eq operation :arccosine)
                (lambda (k) (setf (svref derivative k) (- (* k (svref x k)))))
                (numerics-derivative-rule derivative x))
            (ecase operation
              (:exponential (list (numerics-integral-rule out derivative out bits #'first)))
              (:logarithm (numerics-note-corner expansion "the logarithm of 0" x)
                          (list (numerics-logarithm-rule out derivative x bits)))
              (:hyperbolic-tangent (cons (numerics-integral-rule out derivative inner bits #'first)
                                         (one-less-square out)))
              (:arctangent (list (numerics-product-rule factor x x bits)
                                 (numerics-constant-term-rule factor (ash 1 bits))
                                 (numerics-inverse-rule out derivative factor bits #'first)))
              ((:arcsine :arccosine)
               (numerics-note-corner expansion "an end of an arc" inner)
               (append (one-less-square x)
                       (list (numerics-root-rule factor inner bits)
                             (numerics-inverse-rule out derivative factor bits #'first)))))))))

(defun numerics-general-power-rules (out x exponent y expansion)
  "X to a rational power EXPONENT, else exp(y log x)."
  (let ((bits (numerics-expansion-bits expansion)))
    (numerics-note-corner expansion "a broken power of 0" x)
    (if (numberp exponent)
        (list (numerics-power-rule out x exponent bits))
        (let ((logarithm (numerics-new-series expansion))
              (product (numerics-new-series expansion)))
          (append (numerics-function-rules :logarithm logarithm x expansion)
                  (list (numerics-product-rule product y logarithm bits))
                  (numerics-function-rules :exponential out product expansion))))))

(defun numerics-polar-angle-rules (out y x expansion)
  "out' (x^2 + y^2) = x y' - y x'"
  (let ((bits (numerics-expansion-bits expansion)) (square (numerics-new-series expansion))
        (other (numerics-new-series expansion)) (numerator (numerics-new-series expansion)))
    (numerics-note-corner expansion "a jump of an angle" y x)
    (list (numerics-product-rule square x x bits)
          (numerics-product-rule other y y bits)
          (numerics-sum-rule square square other)
          (numerics-turning-rule numerator y x bits)
          (numerics-inverse-rule out numerator square bits
                                 (lambda ()
                                   (numerics-fixed-function :polar-angle bits
                                                            (svref y 0) (svref x 0)))))))

(defun numerics-corner-rules (operation out x expansion)
  "|x| and the sign of x, on one side of x = 0."
  (let ((one (ash 1 (numerics-expansion-bits expansion))))
    (numerics-note-corner expansion "a corner of an absolute value" x)
    (list (lambda (k)
            (when (zerop (svref x 0)) (numerics-series-fault "a corner of an absolute value"))
            (setf (svref out k)
                  (cond ((eq operation :absolute) (* (signum (svref x 0)) (svref x k)))
                        ((= k 0) (* (signum (svref x 0)) one))
                        (t 0)))))))

;;; The expansion.

(defun numerics-expand (expansion moment states scale)
  "The series of EXPANSION about MOMENT and STATES; SCALE is that of their variable."
  (let ((time (numerics-expansion-time expansion)))
    (setf (numerics-expansion-scale expansion) scale
          (svref time 0) moment
          (svref time 1) scale)
    (loop for series in (numerics-expansion-states expansion)
          for x in states
          do (setf (svref series 0) x))
    (dotimes (k (numerics-expansion-order expansion))
      (dolist (rule (numerics-expansion-rules expansion)) (funcall (the function rule) k))
      (numerics-extend expansion k))))

(defun numerics-extend (expansion k)
  "The coefficients k + 1 of the states."
  (let* ((bits (numerics-expansion-bits expansion)) (scale (numerics-expansion-scale expansion))
         (solve (numerics-expansion-solve expansion))
         (rates (loop for series in (numerics-expansion-rates expansion) collect (svref series k))))
    (loop for rate in (if solve (funcall solve rates) rates)
          for series in (numerics-expansion-states expansion)
          do (setf (svref series (1+ k))
                   (numerics-divided (numerics-shifted (* scale rate) (- bits)) (1+ k))))))

(defun numerics-series-value (series share order bits)
  "The polynomial SERIES at SHARE, by Horner's scheme."
  (let ((value (svref series order)))
    (loop for k from (1- order) downto 0
          do (setq value (+ (svref series k) (numerics-shifted (* value share) (- bits)))))
    value))

(defun numerics-expansion-states-at (expansion share)
  (loop for series in (numerics-expansion-states expansion)
        collect (numerics-series-value series share (numerics-expansion-order expansion)
                                       (numerics-expansion-bits expansion))))
