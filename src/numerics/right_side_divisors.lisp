;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a right-hand side divides by, as far as it may change its sign: the factors of its
;;; denominators without those that are sums of squares and the like. See numerics-divisors first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"))

(defun numerics-divisors (elements positive)
  "What ELEMENTS divide by and what may change its sign; POSITIVE, elements, does not."
  (let ((nodes (algebra-live-nodes elements)) (table (make-hash-table)) (found '()))
    (dolist (node nodes)
      (setf (gethash (algebra-node-index node) table)
            (or (and (member node positive :test #'eq) t)
                (numerics-never-negative-node-p node table))))
    (dolist (node nodes (nreverse found))
      (when (eq (algebra-node-operation node) :divide)
        (dolist (factor (numerics-factors (algebra-node-right node)))
          (unless (numerics-never-negative-p factor table) (pushnew factor found)))))))

(defun numerics-never-negative-p (element table)
  (if (numberp element) (>= element 0) (gethash (algebra-node-index element) table)))

(defun numerics-never-negative-node-p (node table)
  "Whether NODE is seen to be no negative number, TABLE telling it of its parts."
  (let ((x (algebra-node-left node)) (y (algebra-node-right node)))
    (flet ((both () (and (numerics-never-negative-p x table) (numerics-never-negative-p y table))))
      (case (algebra-node-operation node)
        ((:root :absolute :exponential :hyperbolic-cosine :arccosine :power) t)
        (:multiply (or (eq x y) (both)))
        ((:add :divide) (both))))))

(defun numerics-factors (element)
  "What vanishes where ELEMENT does, as far as it may change its sign there: (1 - t) of (1 - t)^2."
  (let ((waiting (list element)) (found '()))
    (loop while waiting
          do (let ((e (pop waiting)))
               (when (algebra-node-p e)
                 (case (algebra-node-operation e)
                   (:multiply (push (algebra-node-left e) waiting)
                              (push (algebra-node-right e) waiting))
                   ((:negate :absolute :divide) (push (algebra-node-left e) waiting))
                   ((:root :power :exponential :hyperbolic-cosine))
                   (t (pushnew e found))))))
    found))
