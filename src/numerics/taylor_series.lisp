;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Taylor series of the operations of a program in fixed-point numbers (A. Griewank, A. Walther,
;;; Evaluating Derivatives, section 13.2; A. Jorba, M. Zou, A software package for the numerical
;;; integration of ODEs by means of high-order Taylor methods, 2005). A series is a vector of its
;;; coefficients. A rule is a function of k: it sets the k-th coefficient of its operation where
;;; those of its arguments up to k and its own before k are there. With u' v = w' and the like:
;;;     k w_k = sum_j j u_j v_(k-j).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/taylor_numbers"))

(defun numerics-convolution (x y k from to)
  "The sum of x_j y_(k-j) for j from FROM to TO, with twice the bits."
  (declare (simple-vector x y) (fixnum k from to) (optimize speed))
  (let ((sum 0))
    (declare (integer sum))
    (loop for j of-type fixnum from from to to
          do (let ((a (svref x j)) (b (svref y (- k j))))
               (declare (integer a b))
               (unless (or (eql a 0) (eql b 0)) (setq sum (+ sum (* a b))))))
    sum))

(defun numerics-square-sum (x k from)
  "The sum of x_j x_(k-j) for j from FROM to k - FROM."
  (declare (simple-vector x) (fixnum k from))
  (let ((half (svref x (floor k 2))))
    (declare (integer half))
    (+ (* 2 (the integer (numerics-convolution x x k from (1- (ceiling k 2)))))
       (if (and (evenp k) (>= (floor k 2) from)) (* half half) 0))))

(defmacro numerics-rule ((k) first &body next)
  "The rule whose 0-th coefficient has the value FIRST, and the K-th that of NEXT."
  `(lambda (,k)
     (declare (fixnum ,k))
     (setf (svref out ,k) (if (= ,k 0) ,first (progn ,@next)))))

(defun numerics-divided (x y)
  "X/Y, rounded: rounding down would leave -1 in all places of a series that ends."
  (values (round x y)))

;;; Arithmetic.

(defun numerics-sum-rule (out x y)
  (lambda (k) (setf (svref out k) (+ (svref x k) (svref y k)))))

(defun numerics-difference-rule (out x y)
  (lambda (k) (setf (svref out k) (- (svref x k) (svref y k)))))

(defun numerics-multiple-rule (out number x bits)
  "NUMBER times X: a rational number, to as many bits as X has."
  (let* ((shift (if (integerp number)
                    0
                    (+ bits 8 (integer-length (denominator number))
                       (- (integer-length (numerator number))))))
         (factor (round (* number (expt 2 shift)))))
    (lambda (k) (setf (svref out k) (numerics-shifted (* factor (svref x k)) (- shift))))))

(defun numerics-product-rule (out x y bits)
  (let ((shift (- bits)))
    (if (eq x y)
        (lambda (k) (setf (svref out k) (numerics-shifted (numerics-square-sum x k 0) shift)))
        (lambda (k)
          (setf (svref out k) (numerics-shifted (numerics-convolution x y k 0 k) shift))))))

(defun numerics-quotient-rule (out x y bits)
  (lambda (k)
    (when (zerop (svref y 0)) (numerics-series-fault "a division by zero"))
    (setf (svref out k)
          (numerics-divided (- (ash (svref x k) bits) (numerics-convolution y out k 1 k))
                            (svref y 0)))))

(defun numerics-root-rule (out x bits)
  (numerics-rule (k)
      (if (plusp (svref x 0))
          (isqrt (ash (svref x 0) bits))
          (numerics-series-fault "the square root of a number that is not positive"))
    (numerics-divided (- (ash (svref x k) bits) (numerics-square-sum out k 1))
                      (* 2 (svref out 0)))))

(defun numerics-constant-term-rule (out constant)
  "Adds CONSTANT to the 0-th coefficient."
  (lambda (k) (when (= k 0) (incf (svref out 0) constant))))

;;; Functions that satisfy a linear equation in the argument: DERIVATIVE has j x_j.

(defun numerics-derivative-rule (derivative x)
  (lambda (k) (setf (svref derivative k) (* k (svref x k)))))

(defun numerics-integral-term (derivative factor k bits)
  "The sum of j x_j factor_(k-j), by K."
  (numerics-divided (numerics-shifted (numerics-convolution derivative factor k 1 k) (- bits)) k))

(defun numerics-integral-rule (out derivative factor bits first)
  "out' = x' factor; FIRST gives the 0-th coefficient."
  (numerics-rule (k) (funcall first)
    (numerics-integral-term derivative factor k bits)))

(defun numerics-pair-rule (operation out derivative other direction bits)
  "out' = DIRECTION x' other: sine and cosine, also hyperbolic; OPERATION is (name . argument)."
  (numerics-rule (k)
      (numerics-fixed-function (car operation) bits (svref (cdr operation) 0))
    (* direction (numerics-integral-term derivative other k bits))))

(defun numerics-inverse-rule (out numerator factor bits first)
  "out' factor = x', NUMERATOR having k x_k."
  (numerics-rule (k) (funcall first)
    (when (zerop (svref factor 0)) (numerics-series-fault "an end of an arc"))
    (let ((sum 0))
      (loop for j from 1 below k
            do (incf sum (* j (svref out j) (svref factor (- k j)))))
      (numerics-divided (- (ash (svref numerator k) bits) sum) (* k (svref factor 0))))))

(defun numerics-logarithm-rule (out derivative x bits)
  (numerics-inverse-rule out derivative x bits
                         (lambda ()
                           (unless (plusp (svref x 0))
                             (numerics-series-fault
                              "the logarithm of a number that is not positive"))
                           (numerics-fixed-function :logarithm bits (svref x 0)))))

(defun numerics-power-rule (out x exponent bits)
  "The rational power EXPONENT = m/n of X: n k x_0 out_k = sum_j (m (k - j) - n j) x_(k-j) out_j."
  (let ((m (numerator exponent)) (n (denominator exponent)))
    (numerics-rule (k)
        (if (plusp (svref x 0))
            (numerics-fixed-function :power bits (svref x 0) (numerics-fixed exponent bits))
            (numerics-series-fault "a broken power of a number that is not positive"))
      (let ((sum 0))
        (dotimes (j k)
          (incf sum (* (- (* m (- k j)) (* n j)) (svref x (- k j)) (svref out j))))
        (numerics-divided sum (* n k (svref x 0)))))))

(defun numerics-turning-rule (out y x bits)
  "The k-th coefficient is k times that of the series whose derivative is x y' - y x'."
  (lambda (k)
    (let ((sum 0))
      (dotimes (j (1+ k))
        (incf sum (* (- (* 2 j) k) (svref y j) (svref x (- k j)))))
      (setf (svref out k) (numerics-shifted sum (- bits))))))
