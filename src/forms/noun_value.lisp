;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Values of nouns at a point. A derivative that Maxima carries out is a formula; else, as of
;;; max(x,0), it is a quotient of differences. An integral is never carried out: its value is
;;; sum w_k f(s_k) with Takahasi and Mori's nodes (double exponential formulas, 1974),
;;;     s = (a+b)/2 + (b-a)/2 tanh(pi/2 sinh(k h)),
;;; which serve integrands that are singular at the ends, too. Where half the step gives another
;;; value there is none.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/value"))

(defun forms-noun-value (e point)
  (case (caar e)
    (%integrate (forms-integral-value e point))
    (t (let ((closed ($forms_closed e)))
         (cond ((or (atom closed) (not (eq (caar closed) (caar e))))
                (forms-fixed-value closed point))
               ((eq (caar e) '%derivative) (forms-difference-value closed point))
               (t (forms-no-value e)))))))

(setq *forms-noun-value* #'forms-noun-value)

;;; Derivatives: once, or twice, with respect to one name

(defun forms-difference-value (e point)
  (destructuring-bind (body x &optional (order 1) &rest more) (cdr e)
    (unless (and (symbolp x) (member order '(1 2)) (null more)) (forms-no-value e))
    (let ((here (forms-fixed-value x point)) (step 100))
      (flet ((value (k)
               (let ((moved (forms-moved-point point)))
                 (forms-set-place x (+ here (* k (ash 1 (- forms-digits step)))) moved)
                 (forms-fixed-value body moved))))
        (if (= order 1)
            (ash (- (value 1) (value -1)) (1- step))
            (ash (+ (value 1) (value -1) (* -2 (value 0))) (* 2 step)))))))

;;; Integrals

(defparameter *forms-node-step* 31/512
  "About 1/16; no multiple of its half is 1, at which Maxima's long exponential is off by 2^-53.")
(defparameter *forms-node-count* 84
  "Nodes on each side at this step: the last ones are 10^-110 from the ends.")
(defconstant forms-tail-digits 160 "Binary digits behind which the last terms have to lie.")
(defconstant forms-integral-digits 75
  "Binary digits to which both sums have to agree: the finer one then has twice as many.")
(defvar *forms-nodes* nil "Nodes and weights in turn at half the step, ((1 - tanh) . weight), ..")

(defun forms-bigfloat-fixed (e)
  "A constant expression in units of 2^-512."
  (forms-fixed (forms-long-float-ratio ($bfloat e))))

(defun forms-node (u)
  "(1 - tanh(v) . weight), v = pi/2 sinh(u): 1 - tanh(v) = 2/(1 + exp(2v))."
  (let* ((v (mul '((rat simp) 1 2) '$%pi (take '(%sinh) ($bfloat u))))
         (cosh (take '(%cosh) ($bfloat v))))
    (cons (forms-bigfloat-fixed (div 2 (add 1 (power '$%e ($bfloat (mul 2 v))))))
          (forms-bigfloat-fixed (div (mul '((rat simp) 1 2) '$%pi (take '(%cosh) ($bfloat u)))
                                     (mul cosh cosh))))))

(defun forms-nodes ()
  "The nodes for k = 0, 1, .. at half the step."
  (or *forms-nodes*
      (setq *forms-nodes*
            (let* (($fpprec 160) (fpprec (+ 2 (integer-length (expt 10 160)))))
              (loop for k from 0 to (* 2 *forms-node-count*)
                    collect (forms-node (forms-maxima-ratio (* k (/ *forms-node-step* 2)))))))))

(defun forms-maxima-ratio (x)
  (div (numerator x) (denominator x)))

(defun forms-integral-value (e point)
  (destructuring-bind (body variable &rest limits) (cdr ($forms_closed e))
    (unless (and (symbolp variable) (= (length limits) 2)) (forms-no-value e))
    (forms-definite-value body variable
                          (forms-fixed-value (first limits) point)
                          (forms-fixed-value (second limits) point)
                          point)))

(defun forms-definite-value (body variable a b point)
  (let ((half (ash (- b a) -1)) (whole 0) (fine 0) (last 0))
    (flet ((value (s)
             (let ((moved (forms-moved-point point)))
               (forms-set-place variable s moved)
               (forms-fixed-value body moved))))
      (loop for (near . weight) in (forms-nodes)
            for k from 0
            for offset = (forms-fixed-times half near)
            for term = (forms-fixed-times
                        weight (if (zerop k)
                                   (value (+ a half))
                                   (+ (value (+ a offset)) (value (- b offset)))))
            do (incf fine term)
               (setq last term)
               (when (evenp k) (incf whole term))))
    (when (> (integer-length last) (- forms-digits forms-tail-digits)) (forms-no-value last))
    (forms-agreed (forms-fixed-times half (forms-times-step whole *forms-node-step*))
                  (forms-fixed-times half (forms-times-step fine (/ *forms-node-step* 2))))))

(defun forms-times-step (sum step)
  (round (* sum step)))

(defun forms-agreed (whole fine)
  (if (< (abs (- whole fine)) (ash (+ (ash 1 forms-digits) (abs fine))
                                   (- forms-integral-digits)))
      fine
      (forms-no-value fine)))
