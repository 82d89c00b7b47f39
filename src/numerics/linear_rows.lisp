;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Outputs that are sums with constant coefficients, c + sum c_k a_k, the a_k inputs or nodes of
;;; other operations: all such rows together are one product with a sparse matrix, which needs no
;;; compiler and runs at a nanosecond an entry. Rows are taken where they replace enough nodes.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes" "numerics/problem"))

(defparameter *numerics-longest-row* 500 "A longer sum stays as the program has it.")
(defparameter *numerics-least-rows* 64 "Fewer nodes are not worth a product.")

;;; A form is (c (node . c_k) ..), nodes in the order of birth.

(defun numerics-forms (nodes constant)
  "Index of a node -> its form, for all NODES; CONSTANT gives the rational value of an element or
nil."
  (let ((forms (make-hash-table)))
    (dolist (node nodes forms)
      (setf (gethash (algebra-node-index node) forms)
            (or (numerics-linear-form node forms constant)
                (list 0 (cons node 1)))))))

(defun numerics-element-form (element forms constant)
  (let ((value (funcall constant element)))
    (if value
        (list value)
        (gethash (algebra-node-index element) forms))))

(defun numerics-linear-form (node forms constant)
  "The form of NODE by those of its parts, nil where it is no sum or too long."
  (let ((x (algebra-node-left node)) (y (algebra-node-right node)))
    (flet ((form (element) (numerics-element-form element forms constant))
           (value (element) (funcall constant element)))
      (let ((form (case (algebra-node-operation node)
                    (:add (numerics-form-sum (form x) 1 (form y)))
                    (:subtract (numerics-form-sum (form x) -1 (form y)))
                    (:negate (numerics-form-sum '(0) -1 (form x)))
                    (:multiply (cond ((value x) (numerics-form-sum '(0) (value x) (form y)))
                                     ((value y) (numerics-form-sum '(0) (value y) (form x)))))
                    (:divide (let ((value (value y)))
                               (and value (/= value 0)
                                    (numerics-form-sum '(0) (/ value) (form x))))))))
        (and (<= (length form) *numerics-longest-row*) form)))))

(defun numerics-form-sum (a factor b)
  "The form A + FACTOR*B."
  (let ((sum '()) (p (cdr a)) (q (cdr b)))
    (flet ((note (node coefficient)
             (unless (eql coefficient 0) (push (cons node coefficient) sum))))
      (loop while (or p q)
            do (cond ((or (null q) (and p (algebra-in-order-p (caar p) (caar q))))
                      (push (pop p) sum))
                     ((or (null p) (algebra-in-order-p (caar q) (caar p)))
                      (let ((term (pop q))) (note (car term) (* factor (cdr term)))))
                     (t (let ((term (pop q)))
                          (note (car term) (+ (cdr (pop p)) (* factor (cdr term)))))))))
    (cons (+ (car a) (* factor (car b))) (nreverse sum))))

;;; Which outputs become rows. OUTPUTS are (place . element).

(defun numerics-rows-and-others (outputs nodes constant)
  "Two values: rows (place . form), and the outputs that stay with the program."
  (let ((forms (numerics-forms nodes constant)))
    (flet ((form (output) (gethash (algebra-node-index (cdr output)) forms)))
      (let ((sums (remove-if (lambda (output) (numerics-atom-p (form output))) outputs)))
        (or (numerics-worthy-rows sums #'form outputs 1/4)
            (numerics-worthy-rows (remove-if-not (lambda (output) (numerics-pure-p (form output)))
                                                 sums)
                                  #'form outputs 0)
            (values '() outputs))))))

(defun numerics-atom-p (form)
  "Whether FORM is that of a node that is no sum, and no input."
  (and (eql (first form) 0) (null (cddr form)) (second form)
       (eql (cdr (second form)) 1) (not (algebra-input-p (car (second form))))))

(defun numerics-pure-p (form) (every #'algebra-input-p (mapcar #'car (cdr form))))

(defun numerics-worthy-rows (chosen form outputs share)
  "The rows of CHOSEN and the other OUTPUTS, or nil where they replace too few nodes: less than
SHARE of all, or less than half as many as the product has entries."
  (let* ((others (numerics-outputs-without chosen outputs))
         (rows (loop for output in chosen collect (cons (car output) (funcall form output))))
         (kept (append (mapcar #'cdr others)
                       (loop for (nil nil . terms) in rows append (mapcar #'car terms))))
         (all (numerics-count-operations (mapcar #'cdr outputs)))
         (replaced (- all (numerics-count-operations kept))))
    (and (>= replaced *numerics-least-rows*)
         (>= replaced (* share all))
         (<= (loop for (nil nil . terms) in rows sum (length terms))
             (+ (* 2 replaced) (length rows)))
         (values rows others))))

(defun numerics-outputs-without (chosen outputs)
  "OUTPUTS but those CHOSEN, which stand in the same order."
  (loop for output in outputs
        if (eq output (car chosen)) do (pop chosen)
        else collect output))

(defun numerics-count-operations (elements)
  (count-if-not #'algebra-input-p (algebra-live-nodes elements)))

;;; The product, in two halves: one with the states, for all rows, and one with the work vector of a
;;; program, for those rows that have such terms. A half has rows from starts[i] to before
;;; starts[i+1] at places[i].

(defstruct numerics-half
  (places (make-array 0 :element-type '(unsigned-byte 32)) :type numerics-indices)
  (starts (make-array 0 :element-type '(unsigned-byte 32)) :type numerics-indices)
  (factors (make-array 0 :element-type '(unsigned-byte 32)) :type numerics-indices)
  (values (numerics-zeros 0) :type numerics-vector))

(defstruct numerics-product
  (constants (numerics-zeros 0) :type numerics-vector)
  states work) ; halves

(defun numerics-index-vector (list) (coerce list 'numerics-indices))
(defun numerics-double-vector (list) (coerce list 'numerics-vector))

(defun numerics-new-half (rows)
  "ROWS are (place (factor . double) ..)."
  (flet ((all (key) (loop for (nil . terms) in rows append (mapcar key terms))))
    (make-numerics-half
     :places (numerics-index-vector (mapcar #'car rows))
     :starts (let ((sum 0))
               (numerics-index-vector
                (cons 0 (loop for (nil . terms) in rows collect (incf sum (length terms))))))
     :factors (numerics-index-vector (all #'car))
     :values (numerics-double-vector (all #'cdr)))))

(defun numerics-new-product (rows state-place work-place double)
  "The product of ROWS (place . form). STATE-PLACE gives the place of a node among the states, or
nil, WORK-PLACE that in the work vector; DOUBLE rounds a rational number."
  (flet ((half (state-p)
           (loop for (row nil . terms) in rows
                 collect (cons row
                               (loop for (node . coefficient) in terms
                                     for place = (funcall state-place node)
                                     when (if state-p place (not place))
                                       collect (cons (or place (funcall work-place node))
                                                     (funcall double coefficient)))))))
    (make-numerics-product
     :constants (numerics-double-vector
                 (loop for row in rows collect (funcall double (second row))))
     :states (numerics-new-half (half t))
     :work (numerics-new-half (remove nil (half nil) :key #'cdr)))))

(defun numerics-terms-in-order (terms state-p)
  "TERMS in the order in which a product adds them: those with states first."
  (append (remove-if-not state-p terms :key #'car) (remove-if state-p terms :key #'car)))

(defmacro numerics-half-loop (half vector begin)
  "Sets OUT at each place of HALF to BEGIN, a form in i and place, and the terms with VECTOR."
  `(let ((places (numerics-half-places ,half)) (starts (numerics-half-starts ,half))
         (factors (numerics-half-factors ,half)) (values (numerics-half-values ,half)) (k 0))
     (declare (type (unsigned-byte 61) k))
     (dotimes (i (length places))
       (let* ((place (aref places i)) (sum ,begin) (end (aref starts (1+ i))))
         (declare (double-float sum))
         (loop while (< k end)
               do (incf sum (* (aref values k) (aref ,vector (aref factors k))))
                  (incf k))
         (setf (aref out place) sum)))))

(defun numerics-multiply-rows (product state work out)
  "The rows of PRODUCT for the vectors STATE and WORK into OUT."
  (declare (type numerics-vector state work out) (optimize speed (safety 0)))
  (let ((constants (numerics-product-constants product))
        (states (numerics-product-states product)) (others (numerics-product-work product)))
    (numerics-half-loop states state (aref constants i))
    (numerics-half-loop others work (aref out place))))
