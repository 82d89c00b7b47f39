;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Derivatives of programs, on programs. Backward: the gradient of one element in all inputs, for a
;;; few times its own operations. Forward: the rate of elements for given rates of the inputs.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_record" "algebra/program_from_expressions"
                "algebra/program_nodes"))

(defun algebra-partial-derivatives (node)
  "List of (part . derivative of NODE by that part), parts that are nodes."
  (let ((x (algebra-node-left node)) (y (algebra-node-right node)))
    (remove-if-not
     #'algebra-node-p
     (case (algebra-node-operation node)
       (:input '())
       (:add (list (cons x 1) (cons y 1)))
       (:subtract (list (cons x 1) (cons y -1)))
       (:negate (list (cons x -1)))
       (:multiply (list (cons x y) (cons y x)))
       (:divide (list (cons x (algebra-program-divide 1 y))
                      (cons y (algebra-program-negate (algebra-program-divide node y)))))
       (:sine (list (cons x (algebra-program-cosine x))))
       (:cosine (list (cons x (algebra-program-negate (algebra-program-sine x)))))
       (:root (list (cons x (algebra-program-divide 1 (algebra-program-multiply 2 node)))))
       (t (algebra-function-slopes-of node x y)))
     :key #'car)))

(defun algebra-function-slopes-of (node x y)
  (let ((row (algebra-function-of (algebra-node-operation node))))
    (mapcar #'cons (list x y) (funcall (algebra-function-slopes row) node x y))))

(defun algebra-program-gradient (element inputs)
  "The derivatives of ELEMENT by INPUTS, which are nodes."
  (let ((adjoints (make-hash-table)))
    (flet ((adjoint (node) (gethash (algebra-node-index node) adjoints 0)))
      (when (algebra-node-p element)
        (setf (gethash (algebra-node-index element) adjoints) 1)
        (dolist (node (reverse (algebra-live-nodes (list element))))
          (loop for (part . derivative) in (algebra-partial-derivatives node)
                do (setf (gethash (algebra-node-index part) adjoints)
                         (algebra-program-add
                          (adjoint part)
                          (algebra-program-multiply (adjoint node) derivative))))))
      (mapcar #'adjoint inputs))))

(defun algebra-program-rates (elements rates)
  "The rates of ELEMENTS; RATES are (input node . its rate), the others do not change."
  (let ((known (make-hash-table)))
    (loop for (input . rate) in rates
          do (setf (gethash (algebra-node-index input) known) rate))
    (flet ((rate (element)
             (if (algebra-node-p element) (gethash (algebra-node-index element) known 0) 0)))
      (dolist (node (algebra-live-nodes elements))
        (unless (algebra-input-p node)
          (setf (gethash (algebra-node-index node) known)
                (let ((sum 0))
                  (loop for (part . derivative) in (algebra-partial-derivatives node)
                        unless (eql (rate part) 0)
                          do (setq sum (algebra-program-add
                                        sum (algebra-program-multiply derivative (rate part)))))
                  sum))))
      (mapcar #'rate elements))))

;;; For Maxima.

(defun $algebra_program_gradient (e inputs)
  "The program of the derivatives of E by INPUTS."
  (with-algebra-program
    (let ((element (algebra-program-element e)))
      (algebra-program-record
       (cdr inputs)
       (list (cons '$gradient
                   (cons :list (algebra-program-gradient
                                element (mapcar #'algebra-program-input (cdr inputs))))))))))
