;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What is to be computed for some outputs of a program, the same for compiled code and for the
;;; register machine: constants rounded to double-float numbers once, outputs that are constant,
;;; rows of a sparse product, and the nodes in their order. With seeds, further inputs, there are
;;; two stages: what depends on time and states alone comes first, and needs not be done again for
;;; another seed. See numerics-new-plan first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"
                "algebra/program_record" "numerics/big_values" "numerics/linear_rows"
                "numerics/native" "numerics/program"))

(defstruct numerics-plan
  inputs    ; index of an input -> (kind . place): :time, :state or :seed
  constants ; index of a constant node -> its rational value, :none where it has none
  fixed     ; ((place . double) ..): outputs that are constant
  outputs   ; ((place . node) ..)
  rows      ; ((place . form) ..)
  nodes     ; operations of the first stage
  late      ; operations that depend on a seed
  turns     ; index of an angle -> its sine and cosine, in their order; one where it has but one
  seeded    ; whether there are two stages
  states length) ; the lengths of the vectors of states and outputs

(defun numerics-new-plan (program outputs length &optional seeds)
  "The plan for OUTPUTS ((place . element) ..) into vectors of LENGTH; SEEDS are input nodes."
  (let* ((inputs (numerics-input-places program seeds))
         (nodes (algebra-live-nodes (mapcar #'cdr outputs)))
         (plan (make-numerics-plan :inputs inputs :states (length (numerics-program-names program))
                                   :length length :seeded (and seeds t))))
    (numerics-check-inputs nodes inputs)
    (setf (numerics-plan-constants plan) (numerics-constant-values nodes (mapcar #'cdr outputs)))
    (numerics-settle-outputs plan outputs nodes seeds)
    plan))

(defun numerics-input-places (program seeds)
  (let ((places (make-hash-table)))
    (flet ((note (node kind k) (setf (gethash (algebra-node-index node) places) (cons kind k))))
      (with-numerics-program program (note (algebra-program-input '$t) :time 0))
      (loop for node in (numerics-program-states program) for k from 0 do (note node :state k))
      (loop for node in seeds for k from 0 do (note node :seed k)))
    places))

(defun numerics-check-inputs (nodes inputs)
  (dolist (node nodes)
    (when (and (algebra-input-p node) (not (algebra-constant-input-p node))
               (not (gethash (algebra-node-index node) inputs)))
      (core-error "~a has no value" (mfuncall '$string (algebra-node-left node))))))

;;; Constants.

(defun numerics-constant-values (nodes elements)
  "Index -> rational value for those constant NODES that moving ones need, or ELEMENTS are."
  (multiple-value-bind (fixed moving) (numerics-fixed-nodes nodes)
    (let ((table (make-hash-table)) (wanted '()) (values (make-hash-table)))
      (dolist (node fixed) (setf (gethash (algebra-node-index node) table) :waits))
      (flet ((want (element)
               (when (and (algebra-node-p element)
                          (eq (gethash (algebra-node-index element) table) :waits))
                 (setf (gethash (algebra-node-index element) table) :wanted)
                 (push element wanted))))
        (mapc #'want elements)
        (dolist (node moving)
          (unless (algebra-input-p node) (mapc #'want (algebra-node-parts node)))))
      (loop for node in wanted
            for value in (numerics-values-of-constants wanted)
            do (setf (gethash (algebra-node-index node) values) value))
      values)))

(defparameter *numerics-constant-digits* 40)

(defun numerics-values-of-constants (nodes)
  "The rational values of NODES, :none for those that have none."
  (let ((found (core-attempt (lambda ()
                               (funcall (numerics-big-routine nodes '() *numerics-constant-digits*)
                                        '())))))
    (cond (found (mapcar #'numerics-bigfloat-rational (car found)))
          ((rest nodes) (loop for node in nodes
                              append (numerics-values-of-constants (list node))))
          (t (list :none)))))

(defun numerics-bigfloat-rational (x)
  "X as a rational number; far beyond double-float numbers a number that is so, too."
  ;; ((bigfloat simp precision) mantissa exponent) is mantissa*2^(exponent - precision)
  (cond ((> (abs (third x)) 5000)
         (* (signum (second x)) (expt 2 (if (plusp (third x)) 5000 -5000))))
        (t (* (second x) (expt 2 (- (third x) (car (last (first x)))))))))

(defun numerics-constant (plan element)
  "The rational value of ELEMENT where it is constant, :none, or nil."
  (if (algebra-node-p element)
      (gethash (algebra-node-index element) (numerics-plan-constants plan))
      element))

(defun numerics-constant-double (value)
  "The double-float number for VALUE, a rational number or :none."
  (cond ((eq value :none) (numerics-not-a-number))
        ((zerop value) 0d0)
        (t (numerics-nearest-double (abs value) (if (minusp value) -1d0 1d0)))))

(defun numerics-nearest-double (x sign)
  "The double-float number nearest to SIGN*X, X > 0; infinity and 0 beyond their range."
  (let* ((shift (- 53 (- (integer-length (numerator x)) (integer-length (denominator x)))))
         (shift (if (>= (* x (expt 2 shift)) (expt 2 53)) (1- shift) shift))
         (mantissa (round (* x (expt 2 shift)))))
    (cond ((> shift 1070) 0d0)
          ((> (- (integer-length mantissa) shift) 1024) (* sign (numerics-infinity)))
          (t (* sign (scale-float (coerce mantissa 'double-float) (- shift)))))))

;;; Outputs and nodes.

(defun numerics-settle-outputs (plan outputs nodes seeds)
  (flet ((constant (element) (numerics-constant plan element)))
    (setf (numerics-plan-fixed plan)
          (loop for (place . element) in outputs
                when (constant element)
                  collect (cons place (numerics-constant-double (constant element)))))
    (let ((moving (remove-if #'constant outputs :key #'cdr)))
      (multiple-value-bind (rows others)
          (if seeds
              (values '() moving)
              (numerics-rows-and-others
               moving nodes (lambda (element)
                              (let ((value (constant element))) (and (rationalp value) value)))))
        (setf (numerics-plan-rows plan) rows
              (numerics-plan-outputs plan) others)
        (numerics-settle-nodes plan rows others)))))

(defun numerics-settle-nodes (plan rows others)
  (let ((nodes (remove-if (lambda (node)
                            (or (algebra-input-p node) (numerics-constant plan node)))
                          (numerics-moving-nodes plan rows others)))
        (late (make-hash-table)))
    (flet ((late-p (node)
             (or (gethash (algebra-node-index node) late)
                 (eq (car (numerics-input-place plan node)) :seed))))
      (dolist (node nodes)
        (when (some #'late-p (algebra-node-parts node))
          (setf (gethash (algebra-node-index node) late) t)))
      (setf (numerics-plan-nodes plan) (remove-if #'late-p nodes)
            (numerics-plan-late plan) (remove-if-not #'late-p nodes)
            (numerics-plan-turns plan) (numerics-turns nodes)))))

(defun numerics-turns (nodes)
  (let ((turns (make-hash-table)))
    (dolist (node (reverse nodes) turns)
      (when (member (algebra-node-operation node) '(:sine :cosine))
        (push node (gethash (algebra-node-index (algebra-node-left node)) turns))))))

(defun numerics-turn (plan node)
  "Sine and cosine of the angle of NODE in their order, nil where the other one is not needed."
  (and (member (algebra-node-operation node) '(:sine :cosine))
       (let ((turn (gethash (algebra-node-index (algebra-node-left node))
                            (numerics-plan-turns plan))))
         (and (rest turn) turn))))

(defun numerics-input-place (plan node)
  "(kind . place) of an input, nil of another NODE."
  (gethash (algebra-node-index node) (numerics-plan-inputs plan)))

(defun numerics-moving-nodes (plan rows others)
  "The nodes that ROWS and OTHERS need; constants are not taken apart."
  (let ((alive (make-hash-table)) (found '())
        (waiting (append (mapcar #'cdr others)
                         (loop for (nil nil . terms) in rows append (mapcar #'car terms)))))
    (loop while waiting
          do (let* ((node (pop waiting)) (index (algebra-node-index node)))
               (unless (or (gethash index alive) (numerics-constant plan node))
                 (setf (gethash index alive) t)
                 (push node found)
                 (dolist (part (algebra-node-parts node)) (push part waiting)))))
    (sort found #'algebra-in-order-p)))

(defun numerics-plan-count (plan)
  "How many operations there are."
  (+ (length (numerics-plan-nodes plan)) (length (numerics-plan-late plan))))
