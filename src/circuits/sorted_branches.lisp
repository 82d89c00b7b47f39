;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Branches by what they are in the tree, meshes of resistors, states that others determine: each
;;; branch and each loop is looked at once, so that large circuits cost no more than their loops.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/sign" "circuits/elements" "circuits/graph" "circuits/numbers"
                "circuits/sparse_rows"))

(defun circuits-branch-vector (circuit)
  (coerce (cdr (circuits-circuit-branches circuit)) 'simple-vector))

(defun circuits-type-of (branches number) (circuits-branch-type (svref branches (1- number))))

(defun circuits-numbers-of-type (branches numbers types)
  "Those of the list NUMBERS whose branches, a vector, are of one of TYPES."
  (remove-if-not (lambda (number) (member (circuits-type-of branches number) types)) numbers))

;; The order in which branches are offered to the tree: those of CHOSEN first among their like, and
;; the latest inductors first, so that of several equal ones the earlier keep their states

(defun circuits-rank (branch chosen)
  (let ((type (circuits-branch-type branch)) (number (circuits-branch-number branch)))
    (list (or (cdr (assoc type '((|$e| . 0) (|$c| . 1) (|$ri| . 2) (|$r| . 3) (|$ru| . 4)
                                 (|$l| . 5) (|$i| . 6))))
              3)
          (if (member (circuits-branch-label branch) chosen) 0 1)
          (if (eq type '|$l|) (- number) number))))

(defun circuits-rank-before-p (rank other)
  (loop for x in rank for y in other
        do (cond ((< x y) (return t)) ((> x y) (return nil)))))

(defun $circuits_tree_order (branches chosen)
  "Numbers of BRANCHES in that order."
  (cons '(mlist simp)
        (mapcar #'cdr
                (sort (loop for branch in (cdr branches)
                            collect (cons (circuits-rank branch (cdr chosen))
                                          (circuits-branch-number branch)))
                      #'circuits-rank-before-p :key #'car))))

;; Circuits in which the graph has nothing to refuse, as most are

(defun $circuits_plainly_lawful (circuit)
  "Whether CIRCUIT consists of R, L, C and sources, no loop of voltage sources among them and no cut
of current sources, without transformers and without a chosen tree."
  (let ((tree (circuits-circuit-chosen_tree circuit)) (branches (circuits-branch-vector circuit)))
    (and (null (cdr (circuits-circuit-transformers circuit)))
         (null (cdr (circuits-circuit-windings circuit)))
         (or (eq tree '$cyclic) (null (cdr tree)))
         (every (lambda (branch)
                  (member (circuits-branch-type branch) '(|$r| |$l| |$c| |$e| |$i|)))
                branches)
         (circuits-sources-apart-p branches))))

(defun circuits-sources-apart-p (branches)
  "Whether a tree holds all voltage sources of the vector BRANCHES and no current source."
  (let* ((count (length branches)) (numbers (loop for number from 1 to count collect number))
         (voltages (circuits-numbers-of-type branches numbers '(|$e|)))
         (currents (circuits-numbers-of-type branches numbers '(|$i|)))
         (others (circuits-numbers-of-type branches numbers '(|$r| |$l| |$c|)))
         (tree ($circuits_tree (cons '(mlist) (map 'list #'$circuits_ends branches))
                               (cons '(mlist) (append voltages others currents))))
         (marks (circuits-marks tree count)))
    (flet ((in-tree-p (number) (svref marks (1- number))))
      (and (every #'in-tree-p voltages) (notany #'in-tree-p currents)))))

;; What is known at once; without MOVING all states are zero

(defun circuits-known-at-once (structure numbers known)
  "For each branch KNOWN(branch) where it is among NUMBERS, else 0."
  (let ((marks (circuits-marks numbers
                               (length (cdr (circuits-structure-branches structure))))))
    (cons '(mlist simp)
          (loop for branch in (cdr (circuits-structure-branches structure))
                for mark across marks
                collect (if mark (funcall known branch) 0)))))

(defun $circuits_link_currents (structure moving)
  "Current of each link."
  (circuits-known-at-once structure (circuits-structure-links structure)
                          (lambda (branch)
                            (case (circuits-branch-type branch)
                              (|$l| (if moving (circuits-branch-state branch) 0))
                              (|$i| (circuits-branch-value branch))
                              (t 0)))))

(defun $circuits_tree_voltages (structure moving)
  "Voltage of each tree branch in the direction of the states."
  (circuits-known-at-once structure (circuits-structure-tree structure)
                          (lambda (branch)
                            (case (circuits-branch-type branch)
                              (|$c| (if moving (circuits-branch-state branch) 0))
                              (|$e| (mul (circuits-structure-sign structure)
                                         (circuits-branch-value branch)))
                              (t 0)))))

(defparameter *circuits-resistors* '(|$r| |$ru| |$ri|))

(defun circuits-resistors-in-loop (branches row)
  "The resistors among the places of the loop ROW."
  (circuits-numbers-of-type branches (mapcar #'circuits-entry-place (cdr row))
                            *circuits-resistors*))

(defun circuits-vector-of-rows (rows) (coerce (cdr rows) 'simple-vector))

;; Resistors in meshes are those that share a loop with resistors of the tree

(defun circuits-meshed-links (branches loops links)
  "((link . resistors of the tree in its loop) ..)"
  (loop for link in (circuits-numbers-of-type branches links *circuits-resistors*)
        for others = (circuits-resistors-in-loop branches (svref loops (1- link)))
        when others collect (cons link others)))

(defun circuits-states-in-order (structure numbers)
  (cons (car numbers) (circuits-in-named-order structure (cdr numbers))))

(defun $circuits_sort_branches (structure)
  "A network of STRUCTURE, its branches sorted."
  (let* ((branches (circuits-branch-vector structure))
         (tree (cdr (circuits-structure-tree structure)))
         (links (cdr (circuits-structure-links structure)))
         (meshes (circuits-meshed-links
                  branches (circuits-vector-of-rows (circuits-structure-loops structure)) links))
         (in-mesh (make-hash-table)))
    (loop for mesh in meshes do (dolist (number mesh) (setf (gethash number in-mesh) t)))
    (flet ((of (numbers &rest types)
             (cons '(mlist simp) (circuits-numbers-of-type branches numbers types)))
           (resistors (numbers meshed)
             (cons '(mlist simp)
                   (remove-if (lambda (number) (not (eq meshed (gethash number in-mesh))))
                              (circuits-numbers-of-type branches numbers
                                                        *circuits-resistors*)))))
      (let ((network ($circuits_network structure)))
        (setf (circuits-network-inductors network)
              (circuits-states-in-order structure (of links '|$l|))
              (circuits-network-dependent_inductors network) (of tree '|$l|)
              (circuits-network-capacitors network)
              (circuits-states-in-order structure (of tree '|$c|))
              (circuits-network-dependent_capacitors network) (of links '|$c|)
              (circuits-network-tree_resistors network) (resistors tree nil)
              (circuits-network-link_resistors network) (resistors links nil)
              (circuits-network-mesh_tree network) (resistors tree t)
              (circuits-network-mesh_links network) (resistors links t)
              (circuits-network-voltage_sources network) (of tree '|$e|)
              (circuits-network-current_sources network) (of links '|$i|))
        network))))

(defun $circuits_meshes (network)
  "Loops of resistors, each once, as lists of branches."
  (cons '(mlist simp)
        (loop for mesh in (circuits-meshed-links
                           (circuits-branch-vector network)
                           (circuits-vector-of-rows (circuits-network-loops network))
                           (cdr (circuits-network-mesh_links network)))
              collect (cons '(mlist simp) (sort mesh #'<)))))

;; Where all resistors in meshes take energy, or one has a law, the graph tells the order

(defun $circuits_meshes_surely_solved (network)
  (let* ((branches (circuits-branch-vector network))
         (meshed (loop for number in (append (cdr (circuits-network-mesh_tree network))
                                             (cdr (circuits-network-mesh_links network)))
                       collect (svref branches (1- number)))))
    (or (some (lambda (branch) (not (eq (circuits-branch-type branch) '|$r|))) meshed)
        (every (lambda (branch) (eq ($algebra_sign (circuits-branch-value branch)) '$pos))
               meshed))))

;; Labels

(defun circuits-labels-at (branches numbers)
  (cons '(mlist simp)
        (loop for number in (sort (copy-list numbers) #'<)
              collect (circuits-branch-label (svref branches (1- number))))))

(defun $circuits_labels (branches numbers)
  "The labels of NUMBERS, in the order of the branches."
  (circuits-labels-at (coerce (cdr branches) 'simple-vector) (cdr numbers)))

(defun $circuits_mesh_faults (network)
  "[words, labels] of each mesh."
  (let ((branches (circuits-branch-vector network)))
    (cons '(mlist simp)
          (loop for (nil . mesh) in (cdr ($circuits_meshes network))
                collect (list '(mlist simp) "mesh of resistors"
                              (circuits-labels-at branches mesh))))))

(defun $circuits_closed_faults (words branches rows numbers)
  "[words, labels of the loop or cut] of each of the branches NUMBERS."
  (let ((branches (coerce (cdr branches) 'simple-vector))
        (rows (circuits-vector-of-rows rows)))
    (cons '(mlist simp)
          (loop for number in (cdr numbers)
                collect (list '(mlist simp) words
                              (circuits-labels-at
                               branches
                               (cons number (mapcar #'circuits-entry-place
                                                    (cdr (svref rows (1- number)))))))))))

;; States

(defun $circuits_states_of (branches numbers)
  "Names of the states of NUMBERS."
  (let ((branches (coerce (cdr branches) 'simple-vector)))
    (cons '(mlist simp)
          (loop for number in (cdr numbers)
                collect (circuits-branch-state (svref branches (1- number)))))))

(defun $circuits_determined (network numbers rows quantities sign)
  "[state = SIGN times the sum of its row with QUANTITIES, ..] of the branches NUMBERS."
  (let ((branches (circuits-branch-vector network)) (rows (circuits-vector-of-rows rows))
        (quantities (coerce (cdr quantities) 'simple-vector)))
    (cons '(mlist simp)
          (loop for number in (cdr numbers)
                collect (list '(mequal simp)
                              (circuits-branch-state (svref branches (1- number)))
                              (circuits-sum-of-row (svref rows (1- number)) sign quantities))))))

(defun circuits-sum-of-row (row sign quantities)
  "SIGN times the sum of ROW with QUANTITIES. Maxima puts each term of a sum into its place from the
front; as the last come first here, that is no walk along a long sum."
  (addn (loop for (x value) in (sort (loop for (nil place value) in (cdr row)
                                           collect (list (svref quantities (1- place)) value))
                                     #'string>
                                     :key (lambda (term)
                                            (if (symbolp (first term)) (first term) "")))
              collect (mul sign value x))
        nil))
