;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Coefficients of the method Radau IIA with three stages, order 5 (Hairer & Wanner: Solving
;;; Ordinary Differential Equations II, section IV.8; the columns of T as in their code radau5.f).
;;; With the tableau (A, c) the matrix T^-1 A^-1 T has the rows (single-root, 0, 0), (0,
;;; pair-root, -pair-turn), (0, pair-turn, pair-root), so that the three stages of the simplified
;;; Newton method split into a real and a complex system.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/decimals"))

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defparameter *numerics-radau-decimals*
    '(;; Nodes (4 -+ sqrt(6))/10; the third is 1.
      (c1 "0.15505102572168219018027159252941")
      (c2 "0.64494897427831780981972840747059")
      ;; Weights (16 -+ sqrt(6))/36; the third is 1/9.
      (b1 "0.37640306270046727505007544236928")
      (b2 "0.51248582618842161383881344651961")
      ;; Eigenvalues of A^-1: 3 - 3^(1/3) + 9^(1/3), and 3 + (3^(1/3) - 9^(1/3))/2 with the
      ;; imaginary part (3^(7/6) + 3^(5/6))/2.
      (single-root "3.63783425274449573220841851358")
      (pair-root "2.68108287362775213389579074321")
      (pair-turn "3.05043019924741056942637762479")
      ;; T, whose last row is (t31, 1, 0), and its inverse.
      (t11 "0.091232394870892942792") (t12 "-0.14125529502095420843")
      (t13 "-0.030029194105147424492")
      (t21 "0.24171793270710701896") (t22 "0.20412935229379993199")
      (t23 "0.38294211275726193779")
      (t31 "0.96604818261509293619")
      (i11 "4.3255798900631553510") (i12 "0.33919925181580986954") (i13 "0.54177053993587487119")
      (i21 "-4.1787185915519047273") (i22 "-0.32768282076106238708")
      (i23 "0.47662355450055045196")
      (i31 "-0.50287263494578687595") (i32 "2.5719269498556054292")
      (i33 "-0.59603920482822492497")
      ;; The estimate of the error: -(13 + 7*sqrt(6))/3, (7*sqrt(6) - 13)/3, -1/3.
      (e1 "-10.04880939982741556246") (e2 "1.38214273316074889579")
      (e3 "-0.33333333333333333333"))
    "Each row: a name and its decimals."))

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun numerics-radau-number (name)
    (let* ((text (second (assoc name *numerics-radau-decimals*)))
           (size (numerics-rounded (numerics-decimal (string-left-trim "-" text)))))
      (if (char= (char text 0) #\-) (- size) size))))

(defmacro numerics-with-radau-numbers (names &body body)
  "BODY with the double-float numbers called NAMES."
  `(symbol-macrolet
       ,(loop for name in names
              collect (list name (numerics-radau-number name)))
     ,@body))
