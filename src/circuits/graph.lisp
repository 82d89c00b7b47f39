;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Graphs: spanning forest, pieces, fundamental loops, Kirchhoff's sums. A branch is here a pair
;;; of nodes [from, to], known by its number in the list; parallel branches stay apart. A loop is a
;;; list of [tree branch, sign], sign 1 where the way from the first node of the link to its second
;;; runs along the arrow. Time: forest n log* n by union-find, loops the sum of their lengths,
;;; Kirchhoff's sums n.

(in-package :maxima)

(defun circuits-node-table (ends)
  "Hash table node -> number from 0, in the order in which the nodes are met."
  (let ((table (make-hash-table :test #'equal)))
    (dolist (pair (cdr ends) table)
      (dolist (node (cdr pair))
        (unless (gethash node table)
          (setf (gethash node table) (hash-table-count table)))))))

(defun circuits-numbered-ends (ends)
  "Two vectors, first and second node numbers of the branches, and the count of nodes."
  (let* ((table (circuits-node-table ends))
         (from (map 'vector (lambda (pair) (gethash (second pair) table)) (cdr ends)))
         (to (map 'vector (lambda (pair) (gethash (third pair) table)) (cdr ends))))
    (values from to (hash-table-count table))))

(defun $circuits_nodes (ends)
  "The nodes, in the order in which they are met."
  (let* ((table (circuits-node-table ends))
         (nodes (make-array (hash-table-count table))))
    (maphash (lambda (node number) (setf (aref nodes number) node)) table)
    (cons '(mlist simp) (coerce nodes 'list))))

(defun $circuits_lonely_nodes (ends)
  "Nodes in which exactly one end lies."
  (let ((counts (make-hash-table :test #'equal)))
    (dolist (pair (cdr ends)) (dolist (node (cdr pair)) (incf (gethash node counts 0))))
    (cons '(mlist simp) (remove 1 (cdr ($circuits_nodes ends)) :test-not #'eql
                                  :key (lambda (node) (gethash node counts))))))

;; Spanning forest by Kruskal's rule: the branches are offered in order, one that closes a loop is
;; refused.

(defun circuits-root (parent node)
  (loop until (= node (aref parent node))
        do (setf (aref parent node) (aref parent (aref parent node))
                 node (aref parent node)))
  node)

(defun circuits-forest (from to count order)
  "Two values: the branches of the list ORDER that are accepted, and for each node one above it."
  (let ((parent (make-array count)) (forest '()))
    (dotimes (node count) (setf (aref parent node) node))
    (dolist (branch order (values (nreverse forest) parent))
      (let ((a (circuits-root parent (aref from (1- branch))))
            (b (circuits-root parent (aref to (1- branch)))))
        (unless (= a b)
          (setf (aref parent a) b)
          (push branch forest))))))

(defun $circuits_tree (ends order)
  "Numbers of the branches of the spanning forest, as accepted from the list ORDER."
  (multiple-value-bind (from to count) (circuits-numbered-ends ends)
    (cons '(mlist simp) (values (circuits-forest from to count (cdr order))))))

(defun $circuits_pieces (ends)
  "The connected pieces, each a list of nodes."
  (multiple-value-bind (from to count) (circuits-numbered-ends ends)
    (let ((parent (nth-value 1 (circuits-forest from to count
                                                (loop for k from 1 to (length from) collect k))))
          (members (make-array count :initial-element '())))
      (loop for member in (cdr ($circuits_nodes ends)) for node from 0
            do (push member (aref members (circuits-root parent node))))
      (cons '(mlist simp)
            (loop for nodes across members
                  when nodes collect (cons '(mlist simp) (reverse nodes)))))))

;; A walk over all nodes, each reached from an earlier one but the first of each piece

(defun circuits-neighbours (from to count marks)
  "For each node a list of (neighbour . mark). MARKS is a list of (branch . mark); from its second
node to its first a branch has the negative mark."
  (let ((near (make-array count :initial-element '())))
    (loop for (branch . mark) in marks
          for a = (aref from (1- branch)) for b = (aref to (1- branch))
          do (push (cons b mark) (aref near a))
             (push (cons a (neg mark)) (aref near b)))
    near))

(defun circuits-walk (near reach)
  "Calls REACH on an earlier node, the new one and the mark between them."
  (let ((seen (make-array (length near) :initial-element nil)))
    (dotimes (root (length near))
      (unless (aref seen root)
        (setf (aref seen root) t)
        (let ((waiting (list root)))
          (loop while waiting
                do (let ((node (pop waiting)))
                     (loop for (other . mark) in (aref near node)
                           unless (aref seen other)
                             do (setf (aref seen other) t)
                                (funcall reach node other mark)
                                (push other waiting)))))))))

;; Fundamental loops: the forest is hung up from one node of each piece; the way between two nodes
;; runs over their meeting point.

(defun circuits-hang (from to count tree)
  "Vectors of parent node, parent branch (plus where its arrow points upward) and level."
  (let ((parent (make-array count :initial-element nil))
        (upward (make-array count :initial-element 0))
        (level (make-array count :initial-element 0)))
    (circuits-walk (circuits-neighbours from to count
                                        (loop for branch in tree collect (cons branch branch)))
                   (lambda (node below branch)
                     (setf (aref level below) (1+ (aref level node))
                           (aref parent below) node
                           (aref upward below) (- branch))))
    (values parent upward level)))

(defun circuits-way (a b parent upward level)
  "The signed branches on the way from node A to node B in the forest."
  (let ((rising nil) (falling nil))
    (loop until (= a b)
          do (if (>= (aref level a) (aref level b))
                 (progn (push (aref upward a) rising) (setq a (aref parent a)))
                 (progn (push (- (aref upward b)) falling) (setq b (aref parent b)))))
    (append (nreverse rising) falling)))

(defun $circuits_loops (ends tree links)
  "For each of LINKS its loop through TREE, in the order in which it is walked."
  (multiple-value-bind (from to count) (circuits-numbered-ends ends)
    (multiple-value-bind (parent upward level) (circuits-hang from to count (cdr tree))
      (flet ((loop-of (link)
               (circuits-way (aref from (1- link)) (aref to (1- link)) parent upward level)))
        (cons '(mlist simp)
              (loop for link in (cdr links)
                    collect (cons '(mlist simp)
                                  (loop for step in (loop-of link)
                                        collect (list '(mlist simp) (abs step)
                                                      (signum step))))))))))

;; Kirchhoff's laws, from the branches themselves and without the tree: the judge of all that is
;; derived.

(defun $circuits_current_sums (ends currents)
  "Sum of the currents that leave each node."
  (multiple-value-bind (from to count) (circuits-numbered-ends ends)
    (let ((totals (make-array count :initial-element '())))
      (loop for flow in (cdr currents) for branch from 0
            do (push flow (aref totals (aref from branch)))
               (push (neg flow) (aref totals (aref to branch))))
      (cons '(mlist simp) (loop for flows across totals collect (addn flows nil))))))

(defun $circuits_voltage_gaps (ends voltages)
  "For each branch its voltage less the difference of node potentials, summed up on the way."
  (multiple-value-bind (from to count) (circuits-numbered-ends ends)
    (let ((potential (make-array count :initial-element 0)))
      (circuits-walk (circuits-neighbours from to count
                                          (loop for voltage in (cdr voltages) for branch from 1
                                                collect (cons branch (neg voltage))))
                     (lambda (node other rise)
                       (setf (aref potential other) (add (aref potential node) rise))))
      (cons '(mlist simp)
            (loop for voltage in (cdr voltages) for a across from for b across to
                  collect (sub voltage (sub (aref potential a) (aref potential b))))))))
