;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Program form of M q'' = f from Lagrange's function, by derivatives on programs:
;;;     p_i = dL/dq_i',   M_ij = dp_i/dq_j',
;;;     f_i = dL/dq_i - (sum dp_i/dq_j q_j' + dp_i/dt) - dR/dq_i' + Q_i,
;;; the left sides e_i = M q'' - f in one run forward, with q_j'' as the rate of q_j', and the
;;; accelerations by M = L D L^T; with constraints M q'' = f + A^T lambda, A q'' = b. See
;;; forms-program-mass-form first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_derivative" "algebra/program_from_expressions"
                "algebra/program_nodes" "algebra/program_record" "forms/actions" "forms/agreement"
                "forms/fixed" "forms/judge" "forms/program_judge" "forms/value"))

(defstruct forms-program-terms
  function                      ; L
  momenta slopes damping forces ; p_i, dL/dq_i, dR/dq_i', Q_i: lists of elements
  places velocities)            ; nodes

(defun forms-read-program-terms (system q v)
  "SYSTEM, the names Q and V read as elements."
  (let ((places (mapcar #'algebra-program-input q))
        (velocities (mapcar #'algebra-program-input v))
        (function (algebra-program-element (forms-system-function system))))
    (make-forms-program-terms
     :function function :places places :velocities velocities
     :momenta (algebra-program-gradient function velocities)
     :slopes (algebra-program-gradient function places)
     :damping (algebra-program-gradient
               (algebra-program-element (forms-system-dissipation system)) velocities)
     :forces (mapcar #'algebra-program-element (cdr (forms-system-forces system))))))

(defun forms-program-left-sides (terms accelerations)
  "The list of e_i for ACCELERATIONS, elements."
  (let* ((velocities (forms-program-terms-velocities terms))
         (rates (append (mapcar #'cons (forms-program-terms-places terms) velocities)
                        (mapcar #'cons velocities accelerations)
                        (list (cons (algebra-program-input '$t) 1)))))
    (mapcar (lambda (rate slope damping force)
              (algebra-program-subtract
               (algebra-program-add (algebra-program-subtract rate slope) damping) force))
            (algebra-program-rates (forms-program-terms-momenta terms) rates)
            (forms-program-terms-slopes terms)
            (forms-program-terms-damping terms)
            (forms-program-terms-forces terms))))

(defun forms-program-mass-form (terms)
  "(M f): rows and list of elements."
  (let ((velocities (forms-program-terms-velocities terms)))
    (list (mapcar (lambda (momentum) (algebra-program-gradient momentum velocities))
                  (forms-program-terms-momenta terms))
          (mapcar #'algebra-program-negate
                  (forms-program-left-sides terms (mapcar (constantly 0) velocities))))))

;;; Symmetric linear equations on programs, by L D L^T. An element of the matrix that is 0 costs
;;; nothing.

(defun forms-program-factors (rows fault)
  "The array with L below the diagonal and D on it, ROWS = L D L^T; FAULT: what a zero in D means."
  (let* ((n (length rows)) (a (make-array (list n n) :initial-contents rows)))
    (dotimes (k n (forms-judge-pivots a n))
      (when (eql (aref a k k) 0) (core-error "~a" fault))
      (loop for i from (1+ k) below n
            do (if (eql (aref a k i) 0)
                   (setf (aref a i k) 0)
                   (forms-take-row a i k n))))))

(defun forms-judge-pivots (a n)
  "A, where none of its N pivots is assumed to be 0."
  (when (core-zeros)
    (let ((inverses (loop for k below n collect (algebra-program-divide 1 (aref a k k)))))
      (core-judge-divisors
       (algebra-program-record nil (list (list* '$pivots :list inverses))))))
  a)

(defun forms-take-row (a i k n)
  "Takes row K out of row I from the diagonal on; the factor of L goes to A[i,k]."
  (let ((factor (algebra-program-divide (aref a k i) (aref a k k))))
    (loop for j from i below n
          do (setf (aref a i j)
                   (algebra-program-subtract (aref a i j)
                                             (algebra-program-multiply factor (aref a k j)))))
    (setf (aref a i k) factor)))

(defun forms-program-solution-by (a right)
  "x of L D L^T x = RIGHT, A as of forms-program-factors."
  (let ((n (length right)) (x (coerce right 'vector)))
    (flet ((take (i factor j)
             (setf (aref x i)
                   (algebra-program-subtract (aref x i)
                                             (algebra-program-multiply factor (aref x j))))))
      (dotimes (i n) (dotimes (j i) (take i (aref a i j) j)))
      (dotimes (i n) (setf (aref x i) (algebra-program-divide (aref x i) (aref a i i))))
      (loop for i from (1- n) downto 0
            do (loop for j from (1+ i) below n do (take i (aref a j i) j))))
    (coerce x 'list)))

(defun forms-program-solution (rows right &optional (fault *forms-singular-mass*))
  "x of ROWS x = RIGHT, the rows symmetric."
  (forms-program-solution-by (forms-program-factors rows fault) right))

;;; Constraints f_j(q,t) = 0 or g_j = sum a_ji q_i' + a_j = 0. The rate of f_j is such a g_j; the
;;; rate of g_j must vanish, too: b_j = -(rate of g_j at q'' = 0).

(defstruct forms-bond row right value rate) ; the elements a_ji, b_j, f_j or g_j, and g_j

(defun forms-program-bonds (holonomic nonholonomic places velocities)
  "The bonds of elements f_j and g_j; PLACES and VELOCITIES are nodes."
  (let ((rates (acons (algebra-program-input '$t) 1 (mapcar #'cons places velocities))))
    (append
     (loop for f in holonomic
           for g in (algebra-program-rates holonomic rates)
           collect (forms-program-bond f g (algebra-program-gradient f places) rates))
     (loop for g in nonholonomic
           collect (forms-program-bond g g (algebra-program-gradient g velocities) rates)))))

(defun forms-program-bond (value g row rates)
  (make-forms-bond :value value :rate g :row row
                   :right (algebra-program-negate (first (algebra-program-rates (list g) rates)))))

(defun forms-program-product (u v)
  (algebra-program-sum (mapcar #'algebra-program-multiply u v)))

(defun forms-task-bonds (task)
  (flet ((elements (expressions) (mapcar #'algebra-program-element expressions))
         (inputs (names) (mapcar #'algebra-program-input names)))
    (forms-program-bonds (elements (forms-task-holonomic task))
                         (elements (forms-task-nonholonomic task))
                         (inputs (forms-task-q task)) (inputs (forms-task-v task)))))

;;; What the three kinds of programs give out. Where the accelerations are wanted,
;;; q'' = x + Y lambda with M x = f, M Y = A^T, and A Y lambda = b - A x.

(defun forms-mass-outputs (rows right bonds)
  (list* (cons '|$m| (cons :matrix rows))
         (cons '$f (cons :list right))
         (and bonds
              (list (cons '|$a| (cons :matrix (mapcar #'forms-bond-row bonds)))
                    (cons '$b (cons :list (mapcar #'forms-bond-right bonds)))))))

(defun forms-solved-outputs (free solve bonds)
  "FREE are the accelerations without bonds, SOLVE gives those of given forces alone."
  (if (null bonds)
      (list (cons '$accelerations (cons :list free)))
      (let* ((columns (mapcar solve (mapcar #'forms-bond-row bonds)))
             (multipliers (forms-program-multipliers free columns bonds)))
        (loop for column in columns
              for multiplier in multipliers
              do (setq free (forms-program-moved free multiplier column)))
        (list (cons '$accelerations (cons :list free))
              (cons '$multipliers (cons :list multipliers))))))

(defun forms-program-moved (vector factor direction)
  (mapcar (lambda (x y) (algebra-program-add x (algebra-program-multiply factor y)))
          vector direction))

(defparameter *forms-dependent-constraints*
  "the constraints depend on each other: their multipliers do not follow from the equations")

(defun forms-bond-matrix (columns bonds)
  "A Y, by rows."
  (loop for bond in bonds
        collect (loop for column in columns
                      collect (forms-program-product (forms-bond-row bond) column))))

(defun forms-program-multipliers (free columns bonds)
  (forms-program-solution
   (forms-bond-matrix columns bonds)
   (loop for bond in bonds
         collect (algebra-program-subtract
                  (forms-bond-right bond) (forms-program-product (forms-bond-row bond) free)))
   *forms-dependent-constraints*))

(defun forms-inverse-outputs (forces bonds multipliers)
  "FORCES less the reactions, MULTIPLIERS being elements, and the constraints themselves."
  (loop for bond in bonds
        for multiplier in multipliers
        do (setq forces (forms-program-moved forces (algebra-program-negate multiplier)
                                             (forms-bond-row bond))))
  (cons (cons '$forces (cons :list forces))
        (and bonds
             (list (cons '$constraints (cons :list (mapcar #'forms-bond-value bonds)))))))

(defun forms-program-outputs (result terms bonds accelerations multipliers)
  (if (eq result '$inverse)
      (forms-inverse-outputs (forms-program-left-sides terms accelerations) bonds multipliers)
      (destructuring-bind (rows right) (forms-program-mass-form terms)
        (if (eq result '$solved)
            (let ((factors (forms-program-factors rows *forms-singular-mass*)))
              (flet ((solve (forces) (forms-program-solution-by factors forces)))
                (forms-solved-outputs (solve right) #'solve bonds)))
            (forms-mass-outputs rows right bonds)))))

;;; Records of programs, shown to be right at a random point.

(defun forms-checked-program (task outputs judge)
  "The record of OUTPUTS, shown to be right at a random point by the JUDGE."
  (forms-check-program task outputs judge)
  (forms-program-record task outputs))

(defun forms-program-record (task outputs)
  (algebra-rename-inputs (cons '(mlist) (forms-task-pairs task)))
  (algebra-program-record
   (append (forms-task-q task)
           (mapcar #'third (forms-task-pairs task))
           (and (eq (forms-task-result task) '$inverse) (forms-task-multipliers task)))
   outputs))

(defun forms-function-program (task name element expected how)
  "The record of one output, ELEMENT; EXPECTED, a function of points, is its value found otherwise."
  (let ((point (forms-new-point t)))
    (forms-verdict how
                   (catch 'forms-no-value (first (forms-program-values (list element) point)))
                   (catch 'forms-no-value (funcall expected point))
                   point))
  (forms-program-record task (list (cons name element))))

;;; For Maxima.

(defun $forms_program_of (system task)
  "The record of the program of the TASK for the SYSTEM in plain symbols."
  (let ((task (forms-read-task task)))
    (with-algebra-program
      (let ((terms (forms-read-program-terms system (forms-task-q task) (forms-task-v task))))
        (flet ((inputs (names) (mapcar #'algebra-program-input names)))
          (forms-checked-program
           task
           (forms-program-outputs (forms-task-result task) terms (forms-task-bonds task)
                                  (inputs (forms-task-a task))
                                  (inputs (forms-task-multipliers task)))
           (forms-judge-of-expressions system)))))))

(defun $forms_function_program (e name task)
  "The record of NAME = E, an expression in names inside."
  (with-algebra-program
    (forms-function-program (forms-read-task task) name (algebra-program-element e)
                            (forms-values-of e)
                            "value of the program against that of the expression")))
