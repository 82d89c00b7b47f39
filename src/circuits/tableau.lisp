;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The sparse tableau of a circuit (G. Hachtel, R. Brayton, F. Gustavson, IEEE Transactions on
;;; Circuit Theory 18 (1971)): Kirchhoff's law for each node and the law of each branch, in the
;;; potentials of the nodes and the currents of the branches. Given are the states, so a capacitor
;;; stands as a source of voltage, an inductor as one of current; sources; and what a nonlinear
;;; resistor makes of its voltage (RU) or its current (RI). See circuits-tableau-of first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "circuits/coefficients" "circuits/elements" "circuits/graph"
                "circuits/sparse_rows"))

(defstruct circuits-tableau
  circuit              ; as in elements.lisp, coupled windings with k = 1 made ideal
  branches             ; a vector, that of number k at k - 1
  (columns (make-hash-table :test #'equal)) ; descriptor -> column
  (descriptors (make-array 64 :adjustable t :fill-pointer 0)) ; column -> descriptor
  (law-sources (make-hash-table :test #'eq)) ; label of a resistor -> the source of its affine law
  (nodes '())          ; those whose potential is unknown
  (unknowns '())       ; columns
  (rows '()))

;;; Descriptors: (:potential node), (:current k) of a branch, (:winding j) of a transformer; (:state
;;; k), (:rate k) of a branch, (:source k n), the n-th rate of a source, (:law k).

(defun circuits-column (tableau &rest descriptor)
  (or (gethash descriptor (circuits-tableau-columns tableau))
      (setf (gethash descriptor (circuits-tableau-columns tableau))
            (vector-push-extend descriptor (circuits-tableau-descriptors tableau)))))

(defun circuits-descriptor (tableau column) (aref (circuits-tableau-descriptors tableau) column))

(defun circuits-branch-at (tableau k) (aref (circuits-tableau-branches tableau) (1- k)))

(defun circuits-tableau-sign (tableau) (circuits-circuit-sign (circuits-tableau-circuit tableau)))

(defun circuits-tableau-of (circuit)
  (let ((tableau (circuits-empty-tableau circuit)))
    (circuits-name-unknowns tableau)
    (setf (circuits-tableau-rows tableau)
          (append (circuits-node-sums tableau)
                  (loop for branch across (circuits-tableau-branches tableau)
                        for row = (circuits-law-row tableau branch)
                        when row collect row)
                  (loop for transformer in (cdr (circuits-circuit-transformers circuit))
                        collect (circuits-transformer-row tableau transformer))))
    tableau))

(defun circuits-empty-tableau (circuit)
  (let ((tableau (make-circuits-tableau
                  :circuit circuit
                  :branches (coerce (cdr (circuits-circuit-branches circuit)) 'vector))))
    (loop for branch across (circuits-tableau-branches tableau)
          do (when (circuits-of-a-law-p branch)
               (setf (gethash (cadr (circuits-branch-control branch))
                              (circuits-tableau-law-sources tableau))
                     branch)))
    tableau))

(defun circuits-of-a-law-p (branch)
  "Whether BRANCH is the source beside the resistor of an affine law, whose label controls it."
  (and (eq (circuits-branch-type branch) '|$i|) (cdr (circuits-branch-control branch))))

(defun circuits-type-in-p (branch &rest types)
  (member (circuits-branch-type branch) types))

(defun circuits-given-current-p (branch) (circuits-type-in-p branch '|$l| '|$i| '|$ru|))

(defun circuits-name-unknowns (tableau)
  (setf (circuits-tableau-nodes tableau) (circuits-live-nodes tableau)
        (circuits-tableau-unknowns tableau)
        (append (loop for node in (circuits-tableau-nodes tableau)
                      collect (circuits-column tableau :potential node))
                (loop for branch across (circuits-tableau-branches tableau)
                      unless (circuits-given-current-p branch)
                        collect (circuits-column tableau :current (circuits-branch-number branch)))
                (loop for nil in (cdr (circuits-circuit-transformers
                                       (circuits-tableau-circuit tableau)))
                      for j from 1
                      collect (circuits-column tableau :winding j)))))

;;; Nodes. Each part that branches and windings join has a node of zero potential.

(defun circuits-joined-pairs (tableau)
  ($circuits_all_ends (cons '(mlist) (coerce (circuits-tableau-branches tableau) 'list))
                      (circuits-circuit-transformers (circuits-tableau-circuit tableau))))

(defun circuits-parts-of-nodes (tableau)
  "Lists of nodes, that of zero potential first."
  (let ((datum (circuits-circuit-datum (circuits-tableau-circuit tableau))))
    (loop for (nil . nodes) in (cdr ($circuits_pieces (circuits-joined-pairs tableau)))
          collect (if (member datum nodes) (cons datum (remove datum nodes)) nodes))))

(defun circuits-live-nodes (tableau)
  "Nodes whose potential is unknown."
  (loop for nodes in (circuits-parts-of-nodes tableau) append (cdr nodes)))

(defun circuits-add-difference (tableau row pair factor)
  "Adds FACTOR*(v_a - v_b) to ROW, PAIR being [a, b]."
  (loop for node in (cdr pair)
        for x in (list factor (circuits-negative factor))
        for column = (gethash (list :potential node) (circuits-tableau-columns tableau))
        do (when column (circuits-add-entry row column x))))

(defun circuits-current-column (tableau branch)
  (let ((k (circuits-branch-number branch)))
    (ecase (circuits-branch-type branch)
      (|$l| (circuits-column tableau :state k))
      (|$i| (circuits-column tableau :source k 0))
      (|$ru| (circuits-column tableau :law k))
      ((|$c| |$r| |$ri| |$e| |$ev| |$g| |$f| |$h| |$o|) (circuits-column tableau :current k)))))

;;; Kirchhoff's law of currents

(defun circuits-node-sums (tableau)
  (let ((sums (make-hash-table :test #'equal)) (nodes (circuits-tableau-nodes tableau)))
    (dolist (node nodes) (setf (gethash node sums) (circuits-new-row)))
    (flet ((flow (pair column x)
             (loop for node in (cdr pair)
                   for sign in '(1 -1)
                   for row = (gethash node sums)
                   do (when row (circuits-add-entry row column (circuits-times sign x))))))
      (loop for branch across (circuits-tableau-branches tableau)
            do (flow ($circuits_ends branch) (circuits-current-column tableau branch) 1))
      (loop for transformer in (cdr (circuits-circuit-transformers
                                     (circuits-tableau-circuit tableau)))
            for j from 1
            do (flow (circuits-transformer-pair transformer) (circuits-column tableau :winding j) 1)
               (flow (circuits-transformer-driven transformer)
                     (circuits-column tableau :winding j)
                     (circuits-negative
                      (circuits-inside (circuits-transformer-ratio transformer))))))
    (loop for node in nodes collect (gethash node sums))))

;;; Laws of branches, each a row that vanishes

(defun circuits-law-row (tableau branch)
  "nil where the current is given."
  (unless (circuits-given-current-p branch)
    (let ((row (circuits-new-row)) (k (circuits-branch-number branch))
          (sign (circuits-tableau-sign tableau))
          (value (circuits-inside (circuits-branch-value branch))))
      (labels ((less (x &rest descriptor)
                 (circuits-add-entry row (apply #'circuits-column tableau descriptor)
                                     (circuits-negative x)))
               (own (x)
                 (circuits-add-difference tableau row ($circuits_ends branch) x)))
        (ecase (circuits-branch-type branch)
          (|$c| (own sign) (less 1 :state k))
          (|$r| (own sign) (less value :current k))
          (|$ri| (own sign) (less 1 :law k))
          (|$e| (own 1) (less 1 :source k 0))
          ((|$ev| |$g| |$f| |$h| |$o|) (circuits-control-row tableau branch row value)))
        row))))

(defun circuits-control-row (tableau branch row value)
  (let ((control (circuits-branch-control branch)) (minus (circuits-negative value)))
    (flet ((own-current (x)
             (circuits-add-entry row (circuits-current-column tableau branch) x))
           (own-voltage ()
             (circuits-add-difference tableau row ($circuits_ends branch) 1))
           (sensed-voltage (x) (circuits-add-difference tableau row control x))
           (sensed-current (x)
             (circuits-add-current tableau row (circuits-labelled-branch tableau (cadr control))
                                   x)))
      (ecase (circuits-branch-type branch)
        (|$ev| (own-voltage) (sensed-voltage minus))
        (|$g| (own-current 1) (sensed-voltage minus))
        (|$f| (own-current 1) (sensed-current minus))
        (|$h| (own-voltage) (sensed-current minus))
        (|$o| (sensed-voltage 1))))))

(defun circuits-add-current (tableau row branch factor)
  "Adds FACTOR times the current of BRANCH as it is described: with that of the source of an affine
law; i_k = i_km - sum w*i_j where windings j are ideal and the inductor k magnetizes them."
  (circuits-add-entry row (circuits-current-column tableau branch) factor)
  (let ((source (gethash (circuits-branch-label branch) (circuits-tableau-law-sources tableau))))
    (when source (circuits-add-entry row (circuits-current-column tableau source) factor)))
  (loop for winding in (cdr (circuits-circuit-ideal (circuits-tableau-circuit tableau)))
        for weight = ($circuits_entry (circuits-winding-weights winding)
                                      (circuits-branch-number branch))
        do (circuits-add-entry
            row
            (circuits-current-column
             tableau (circuits-branch-at tableau (circuits-winding-number winding)))
            (circuits-times (circuits-negative factor) (circuits-inside weight)))))

(defun circuits-labelled-branch (tableau label)
  (find label (circuits-tableau-branches tableau) :key #'circuits-branch-label))

(defun circuits-transformer-row (tableau transformer)
  "u_ab - n*u_cd"
  (let ((row (circuits-new-row)))
    (circuits-add-difference tableau row (circuits-transformer-pair transformer) 1)
    (circuits-add-difference tableau row (circuits-transformer-driven transformer)
                             (circuits-negative
                              (circuits-inside (circuits-transformer-ratio transformer))))
    row))

;;; Voltages as rows: along the arrow, and in the direction of the branch's law

(defun circuits-voltage-row (tableau pair factor solved)
  "FACTOR*(v_a - v_b) with the potentials as SOLVED has them."
  (let ((row (circuits-new-row)) (result (circuits-new-row)))
    (circuits-add-difference tableau row pair factor)
    (maphash (lambda (column x) (circuits-add-solved result column x solved)) row)
    result))

(defun circuits-add-solved (row column x solved)
  "Adds X times COLUMN, or what SOLVED says that it is."
  (let ((known (gethash column solved)))
    (if known
        (circuits-add-multiple row x known)
        (circuits-add-entry row column x))))
