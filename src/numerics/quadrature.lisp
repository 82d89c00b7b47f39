;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Gauss' formula of five nodes on [0, 1], of order 10, by which functions of the state are
;;; integrated along a step (M. Abramowitz, I. Stegun, Handbook of mathematical functions, table
;;; 25.4).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/decimals"))

(defparameter *numerics-quadrature*
  (loop for (distance weight) in '(("0" "0.56888888888888888889")
                                   ("0.53846931010568309104" "0.47862867049936646804")
                                   ("0.90617984593866399280" "0.23692688505618908751"))
        for share = (numerics-decimal distance)
        for half = (/ (numerics-decimal weight) 2)
        append (loop for x in (if (zerop share) (list 0) (list (- share) share))
                     collect (cons (numerics-rounded (/ (1+ x) 2)) (numerics-rounded half))))
  "((share . weight) ..)")
