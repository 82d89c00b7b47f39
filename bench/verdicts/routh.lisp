;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Routh's array by divisions, as a textbook has it, in doubles or in the bigfloats of fpprec:
;;; r_(k+1,j) = r_(k-1,j+1) - r_(k-1,1)*r_(k,j+1)/r_(k,1) (Gantmacher, The Theory of Matrices,
;;; XV, 3).

(in-package :maxima)

(defun bench-routh-column (a times minus over)
  "The first column of the array of the coefficients A, highest power first; it ends at a zero."
  (let ((above (loop for c in a by #'cddr collect c))
        (row (loop for c in (cdr a) by #'cddr collect c))
        (column (list (car a))))
    (loop while row
          do (push (car row) column)
             (when (bench-zero-p (car row)) (return))
             (let ((ratio (funcall over (car above) (car row))))
               (psetq above row
                      row (loop for (b) on (cdr above)
                                for rest = (cdr row) then (cdr rest)
                                collect (if rest
                                            (funcall minus b (funcall times ratio (car rest)))
                                            b)))))
    (nreverse column)))

(defun bench-zero-p (number)
  (if (floatp number) (zerop number) (zerop (cadr number))))

(defun $bench_routh_doubles (a)
  (cons '(mlist simp) (bench-routh-column (cdr a) #'* #'- #'/)))

(defun $bench_routh_bigfloats (a)
  (cons '(mlist simp) (bench-routh-column (cdr a) #'mul #'sub #'div)))
