;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A plan on a register machine, which needs no compiler: for short runs, and for Lisps whose
;;; compiler is slow. All numbers lie in one vector: the time, states, seeds, constants, then the
;;; values of nodes. Nodes that are ready at once and have the same operation follow each other, so
;;; that one instruction is a loop over many of them. The arithmetic is that of compiled code in the
;;; same order, so that the values are equal to the last bit. See numerics-machine first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes" "numerics/linear_rows"
                "numerics/native" "numerics/plan" "numerics/problem" "numerics/routine_entry"))

;;; Runs. In a turn the cosine comes with the sine, two places further on for the next one.

(defun numerics-unit (plan node)
  "The node that NODE is computed with."
  (let ((turn (numerics-turn plan node)))
    (if turn (find :sine turn :key #'algebra-node-operation) node)))

(defun numerics-unit-operation (plan node)
  (if (numerics-turn plan node) :turn (algebra-node-operation node)))

(defun numerics-schedule (plan nodes)
  "NODES as ((operation node ..) ..), each list ready after those before it, the longest first."
  (let ((waiting (make-hash-table)) (users (make-hash-table)) (ready (make-hash-table))
        (here (make-hash-table)) (runs '()))
    (dolist (node nodes) (setf (gethash (algebra-node-index node) here) t))
    (labels ((unit-index (node) (algebra-node-index (numerics-unit plan node)))
             (open-unit (unit) (push unit (gethash (numerics-unit-operation plan unit) ready))))
      (dolist (node nodes)
        (when (eq node (numerics-unit plan node))
          (let ((parts (remove-if-not (lambda (part) (gethash (algebra-node-index part) here))
                                      (algebra-node-parts node))))
            (setf (gethash (algebra-node-index node) waiting) (length parts))
            (dolist (part parts) (push node (gethash (unit-index part) users)))
            (unless parts (open-unit node)))))
      (loop for operation = (numerics-most-ready ready)
            while operation
            do (let ((units (nreverse (gethash operation ready))))
                 (setf (gethash operation ready) '())
                 (push (cons operation units) runs)
                 (dolist (unit units)
                   (dolist (user (gethash (algebra-node-index unit) users))
                     (when (zerop (decf (gethash (algebra-node-index user) waiting)))
                       (open-unit user)))))))
    (nreverse runs)))

(defun numerics-most-ready (ready)
  "The operation of which most nodes are READY, nil for none."
  (let ((best nil) (most 0))
    (loop for operation being the hash-keys of ready using (hash-value nodes)
          do (let ((count (length nodes)))
               (when (> count most) (setq best operation most count))))
    best))

;;; Places: those of inputs are known, constants and nodes get theirs.

(defstruct numerics-layout
  plan
  (slots (make-hash-table))                 ; index of a node -> its place
  (constants (make-hash-table :test #'eql)) ; double-float number -> its place
  (instructions '())                        ; of the first, then of the second stage
  (length 0))

(defun numerics-layout-take (layout count)
  (prog1 (numerics-layout-length layout) (incf (numerics-layout-length layout) count)))

(defun numerics-layout-slot (layout node)
  (gethash (algebra-node-index node) (numerics-layout-slots layout)))

(defun numerics-layout-place (layout element)
  (let ((value (numerics-constant (numerics-layout-plan layout) element)))
    (if value
        (let ((value (numerics-constant-double value))
              (constants (numerics-layout-constants layout)))
          (or (gethash value constants)
              (setf (gethash value constants) (numerics-layout-take layout 1))))
        (numerics-layout-slot layout element))))

(defun numerics-new-layout (plan)
  (let* ((layout (make-numerics-layout :plan plan)) (states (numerics-plan-states plan)))
    (numerics-layout-take layout (+ 1 (* 2 states)))
    (loop for index being the hash-keys of (numerics-plan-inputs plan) using (hash-value place)
          do (setf (gethash index (numerics-layout-slots layout))
                   (ecase (car place)
                     (:time 0)
                     (:state (+ 1 (cdr place)))
                     (:seed (+ 1 states (cdr place))))))
    (setf (numerics-layout-instructions layout)
          (loop for nodes in (list (numerics-plan-nodes plan) (numerics-plan-late plan))
                collect (loop for (operation . units) in (numerics-schedule plan nodes)
                              collect (list* operation (numerics-place-run layout operation units)
                                             units))))
    layout))

(defun numerics-place-run (layout operation units)
  "The place of the first of UNITS, the others follow."
  (let ((first (numerics-layout-length layout)))
    (dolist (unit units first)
      (if (eq operation :turn)
          (destructuring-bind (one other) (numerics-turn (numerics-layout-plan layout) unit)
            (let ((place (numerics-layout-take layout 2)))
              (flet ((put (node place)
                       (setf (gethash (algebra-node-index node) (numerics-layout-slots layout))
                             place)))
                (put unit place)
                (put (if (eq one unit) other one) (1+ place)))))
          (setf (gethash (algebra-node-index unit) (numerics-layout-slots layout))
                (numerics-layout-take layout 1))))))

;;; Instructions: operation, first place, number of values; the places of the parts of each value
;;; stand in two vectors at its own place.

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defparameter *numerics-machine-operations*
    `((:add (+ (a) (b))) (:subtract (- (a) (b))) (:multiply (* (a) (b)))
      (:divide (numerics-quotient (a) (b))) (:negate (- (a))) (:root (numerics-square-root (a)))
      (:absolute (abs (a))) (:sign (numerics-sign (a))) (:turn nil)
      ,@(loop for (operation) in *numerics-c-names*
              collect (list operation
                            (if (member operation '(:power :polar-angle))
                                `(numerics-elementary ,operation (a) (b))
                                `(numerics-elementary ,operation (a))))))))

(defmacro numerics-case-of-operations (operation)
  "A loop for each operation, in the names of numerics-run-instructions."
  `(case ,operation
     ,@(loop for (name form) in *numerics-machine-operations*
             for k from 0
             collect (if (eq name :turn)
                         `(,k (loop for i of-type numerics-index from first below end by 2
                                    do (numerics-set-turn w i (a))))
                         `(,k (loop for i of-type numerics-index from first below end
                                    do (setf (aref w i) ,form)))))))

(defun numerics-run-instructions (instructions lefts rights w)
  (declare (type numerics-indices instructions lefts rights) (type numerics-vector w)
           (optimize speed (safety 0)))
  (macrolet ((a () `(aref w (aref lefts i))) (b () `(aref w (aref rights i))))
    (loop for k of-type fixnum from 0 below (length instructions) by 3
          do (let ((first (aref instructions (+ k 1))) (end (aref instructions (+ k 2))))
               (numerics-case-of-operations (aref instructions k))))))

(defun numerics-instruction-vector (layout instructions)
  (numerics-index-vector
   (loop for (operation first . units) in instructions
         append (list (position operation *numerics-machine-operations* :key #'car) first
                      (+ first (* (if (eq operation :turn) 2 1) (length units)))))))

(defun numerics-part-places (layout)
  "The vectors of the places of left and of right parts."
  (let* ((runs (apply #'append (numerics-layout-instructions layout)))
         (pairs (loop for (operation first . units) in runs
                      append (loop for unit in units
                                   for place from first by (if (eq operation :turn) 2 1)
                                   collect (list place (numerics-part-place layout unit :left)
                                                 (numerics-part-place layout unit :right)))))
         (lefts (numerics-zero-indices (numerics-layout-length layout)))
         (rights (numerics-zero-indices (numerics-layout-length layout))))
    (loop for (place left right) in pairs
          do (setf (aref lefts place) left (aref rights place) right))
    (values lefts rights)))

(defun numerics-part-place (layout node side)
  (if (and (eq side :right)
           (not (member (algebra-node-operation node)
                        '(:add :subtract :multiply :divide :power :polar-angle))))
      0
      (numerics-layout-place layout (if (eq side :left)
                                        (algebra-node-left node)
                                        (algebra-node-right node)))))

(defun numerics-zero-indices (n)
  (make-array n :element-type '(unsigned-byte 32) :initial-element 0))

;;; The machine.

(defun numerics-machine (plan)
  "Two functions: (time x out), and (seed out) for the second stage."
  (let* ((layout (numerics-new-layout plan)) (states (numerics-plan-states plan)))
    (multiple-value-bind (lefts rights) (numerics-part-places layout)
      (let ((work (numerics-zeros (numerics-layout-length layout))))
        (loop for value being the hash-keys of (numerics-layout-constants layout)
                using (hash-value place)
              do (setf (aref work place) value))
        (flet ((stage (number at)
                 (numerics-machine-stage
                  (numerics-instruction-vector layout
                                               (nth number (numerics-layout-instructions layout)))
                  lefts rights at))
               (gather (function) (numerics-gatherer function layout plan)))
          (let ((first (stage 0 1)) (second (stage 1 (1+ states))))
            (numerics-entries plan work (lambda (node) (numerics-layout-slot layout node))
                              (if (numerics-plan-seeded plan) first (gather first))
                              (gather second))))))))

(defun numerics-machine-stage (instructions lefts rights at)
  "The function (x work out) that puts X into WORK from AT on and runs INSTRUCTIONS."
  (declare (fixnum at) (type numerics-indices instructions lefts rights))
  (lambda (x work out)
    (declare (ignore out) (type numerics-vector x work) (optimize speed))
    (replace work x :start1 at)
    (numerics-run-instructions instructions lefts rights work)))

(defun numerics-gatherer (run layout plan)
  "The function (x work out) that calls RUN and then gives out what is in WORK."
  (declare (type function run))
  (let ((places (numerics-index-vector (mapcar #'car (numerics-plan-outputs plan))))
        (slots (numerics-index-vector
                (loop for (nil . node) in (numerics-plan-outputs plan)
                      collect (numerics-layout-slot layout node)))))
    (declare (type numerics-indices places slots))
    (lambda (x work out)
      (declare (type numerics-vector x work out) (optimize speed (safety 0)))
      (funcall run x work out)
      (dotimes (k (length places))
        (setf (aref out (aref places k)) (aref work (aref slots k)))))))
