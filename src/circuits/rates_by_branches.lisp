;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rates of a circuit for a run, branch by branch: currents of inductors and voltages of capacitors
;;; are known, those of the other branches follow over the loops and cuts of the tree, and what is
;;; left of Kirchhoff's laws are the equations
;;;     B^T L B i' = K u - B^T L b',   B^T C B u' = -K^T i - B^T C b',
;;; all inductor currents being B i + b. No potential is formed, nothing is differentiated but the
;;; sources. Voltages have the direction of the states. See circuits-rates first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"
                "algebra/program_record" "circuits/element_laws" "circuits/elements"
                "forms/sparse_elimination"))

(defstruct circuits-run
  network sign branches ; the branches as a vector, that of number k at k - 1
  loops cuts            ; vectors of rows ((number . element) ..)
  (known (make-hash-table :test #'eq)) ; name of a dependent state -> its element
  currents voltages)    ; vectors of elements, nil while they are not known

(defun circuits-new-run (network)
  (let* ((branches (coerce (cdr (circuits-network-branches network)) 'vector))
         (count (length branches)))
    (make-circuits-run
     :network network :sign (circuits-network-sign network) :branches branches
     :loops (circuits-element-rows (circuits-network-loops network))
     :cuts (circuits-element-rows (circuits-network-cuts network))
     :currents (make-array count :initial-element nil)
     :voltages (make-array count :initial-element nil))))

(defun circuits-element-rows (rows)
  "Sparse ROWS with elements, in the order in which most of their sums begin alike."
  (let ((rows (loop for row in (cdr rows)
                    collect (sort (loop for (nil number value) in (cdr row)
                                        collect (cons number (algebra-program-element value)))
                                  #'< :key #'car))))
    (coerce (if (<= (circuits-beginnings rows) (circuits-beginnings (mapcar #'reverse rows)))
                rows
                (mapcar #'reverse rows))
            'vector)))

(defun circuits-beginnings (rows)
  "How many different beginnings ROWS have: so many sums there are."
  (let ((table (make-hash-table :test #'equal)))
    (dolist (row rows (hash-table-count table))
      (let ((place 0))
        (loop for (number . value) in row
              for key = (list place number (algebra-part-key value))
              do (setq place (or (gethash key table)
                                 (setf (gethash key table) (1+ (hash-table-count table))))))))))

(defmacro circuits-numbers (run field)
  "The list under FIELD of the network of RUN."
  `(cdr (,(intern (format nil "CIRCUITS-NETWORK-~a" field) :maxima) (circuits-run-network ,run))))
(defun circuits-run-branch (run number) (aref (circuits-run-branches run) (1- number)))
(defun circuits-loop-row (run number) (aref (circuits-run-loops run) (1- number)))
(defun circuits-cut-row (run number) (aref (circuits-run-cuts run) (1- number)))
(defun circuits-current (run number) (aref (circuits-run-currents run) (1- number)))
(defun circuits-voltage (run number) (aref (circuits-run-voltages run) (1- number)))

(defun circuits-set-current (run number element)
  (setf (aref (circuits-run-currents run) (1- number)) element))

(defun circuits-set-voltage (run number element)
  (setf (aref (circuits-run-voltages run) (1- number)) element))

(defun circuits-element (run e)
  "The element of E, a value: dependent states in it are expressed by the others."
  (algebra-read-element e (circuits-run-known run)))

(defun circuits-value (run branch) (circuits-element run (circuits-branch-value branch)))

;;; Sums over what is known of a loop or a cut.

(defun circuits-row-sum (row quantity &optional (sign 1))
  "SIGN times the sum of ROW, values times what QUANTITY gives for their branches; nil is left out."
  (let ((sum 0))
    (loop for (number . value) in row
          for x = (funcall quantity number)
          do (when x
               (setq sum (algebra-program-add
                          sum (algebra-program-multiply (algebra-program-multiply sign value) x)))))
    sum))

(defun circuits-along-loop (run number &optional (sign 1))
  (circuits-row-sum (circuits-loop-row run number) (lambda (k) (circuits-voltage run k)) sign))

(defun circuits-through-cut (run number &optional (sign 1))
  (circuits-row-sum (circuits-cut-row run number) (lambda (k) (circuits-current run k)) (- sign)))

;;; From the states outwards.

(defun circuits-set-states (run)
  "What the states and sources give at once, and the states that depend on them."
  (flet ((state (number)
           (algebra-program-input (circuits-branch-state (circuits-run-branch run number))))
         (value (number) (circuits-value run (circuits-run-branch run number))))
    (dolist (k (circuits-numbers run inductors)) (circuits-set-current run k (state k)))
    (dolist (k (circuits-numbers run current_sources)) (circuits-set-current run k (value k)))
    (dolist (k (circuits-numbers run capacitors)) (circuits-set-voltage run k (state k)))
    (dolist (k (circuits-numbers run voltage_sources))
      (circuits-set-voltage run k (algebra-program-multiply (circuits-run-sign run) (value k)))))
  (dolist (k (circuits-numbers run dependent_inductors))
    (circuits-set-current run k (circuits-set-known run k (circuits-through-cut run k))))
  (dolist (k (circuits-numbers run dependent_capacitors))
    (circuits-set-voltage run k (circuits-set-known run k (circuits-along-loop run k)))))

(defun circuits-set-known (run number element)
  (setf (gethash (circuits-branch-state (circuits-run-branch run number))
                 (circuits-run-known run))
        element))

(defun circuits-law-element (run branch argument)
  "The law of BRANCH, a function's name, at the element ARGUMENT."
  (let* ((laws (circuits-network-laws (circuits-run-network run)))
         (x (mfuncall '$circuits_dummy laws))
         (known (make-hash-table :test #'eq)))
    (setf (gethash x known) argument)
    (algebra-read-element (mfuncall '$circuits_law (circuits-branch-value branch) x laws) known)))

(defun circuits-linear-p (branch) (eq (circuits-branch-type branch) '|$r|))

(defun circuits-set-resistors (run)
  "Resistors of the tree by their currents, linear ones in meshes, the others by their voltages."
  (dolist (k (circuits-numbers run tree_resistors))
    (let ((branch (circuits-run-branch run k))
          (current (circuits-set-current run k (circuits-through-cut run k))))
      (circuits-set-voltage run k
                            (if (circuits-linear-p branch)
                                (algebra-program-multiply (circuits-value run branch) current)
                                (circuits-law-element run branch current)))))
  (circuits-set-meshes run)
  (dolist (k (append (circuits-numbers run link_resistors) (circuits-numbers run mesh_links)))
    (let ((branch (circuits-run-branch run k))
          (voltage (circuits-set-voltage run k (circuits-along-loop run k))))
      (circuits-set-current run k
                            (if (circuits-linear-p branch)
                                (algebra-program-divide voltage (circuits-value run branch))
                                (circuits-law-element run branch voltage))))))

;;; Meshes of linear resistors: the voltages w of those in the tree from the cuts,
;;;     w_t/R_t + sum over the links of its cut of K_lt (K w)_l/R_l = what is known.

(defun circuits-set-meshes (run)
  (let ((numbers (circuits-numbers run mesh_tree)))
    (when numbers
      (loop for k in numbers
            for voltage in (circuits-mesh-voltages run numbers)
            for resistance = (circuits-value run (circuits-run-branch run k))
            do (circuits-set-voltage run k voltage)
               (circuits-set-current run k (algebra-program-divide voltage resistance))))))

(defun circuits-mesh-voltages (run numbers)
  (let ((places (make-hash-table)))
    (loop for k in numbers for place from 0 do (setf (gethash k places) place))
    (forms-sparse-solution
     (forms-sparse-factors
      (mapcar (lambda (k) (circuits-mesh-row run k places)) numbers)
      (lambda (place)
        (declare (ignore place))
        (core-error "the currents in the meshes of resistors are not determined")))
     (mapcar (lambda (k) (circuits-mesh-right run k places)) numbers))))

(defun circuits-mesh-links (run number)
  "((link K conductance) ..) of the linear resistors in the cut of the branch NUMBER."
  (loop for (link . value) in (circuits-cut-row run number)
        for branch = (circuits-run-branch run link)
        when (member (circuits-branch-type branch) '(|$r| |$ru| |$ri|))
          collect (list link value (algebra-program-divide 1 (circuits-value run branch)))))

(defun circuits-mesh-row (run number places)
  (let ((row (list (cons (gethash number places)
                         (algebra-program-divide
                          1 (circuits-value run (circuits-run-branch run number)))))))
    (loop for (link value conductance) in (circuits-mesh-links run number)
          for weight = (algebra-program-multiply value conductance)
          do (loop for (other . other-value) in (circuits-loop-row run link)
                   for place = (gethash other places)
                   do (when place
                        (setq row (circuits-entry-added
                                   row place (algebra-program-multiply weight other-value))))))
    row))

(defun circuits-mesh-right (run number places)
  (let ((right (circuits-through-cut run number)))
    (loop for (link value conductance) in (circuits-mesh-links run number)
          for voltage = (circuits-row-sum
                         (circuits-loop-row run link)
                         (lambda (k) (and (not (gethash k places)) (circuits-voltage run k))))
          do (setq right (algebra-program-subtract
                          right (algebra-program-multiply
                                 value (algebra-program-multiply conductance voltage)))))
    right))

(defun circuits-entry-added (row place element)
  "ROW, a list ((j . element) ..), with ELEMENT added at PLACE."
  (let ((entry (assoc place row)))
    (if entry
        (progn (setf (cdr entry) (algebra-program-add (cdr entry) element)) row)
        (append row (list (cons place element))))))
