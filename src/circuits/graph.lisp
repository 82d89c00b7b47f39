;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Graphs of branches: spanning forest, fundamental loops, Kirchhoff's sums, and elimination
;;; where transformers join nodes. A branch is a pair of nodes [from, to], known by its number in
;;; the list; parallel branches stay apart. A loop is a list of [tree branch, sign], sign 1 where
;;; the way from the first node of the link to its second runs along the arrow. Time: forest n
;;; log* n by union-find, loops the sum of their lengths, Kirchhoff's sums n; elimination only
;;; with transformers.

(in-package :maxima)

(defun circuits-mlist (items) (cons '(mlist simp) items))

(defun circuits-node-table (ends)
  "Hash table node -> number from 0, in the order in which the nodes are met."
  (let ((table (make-hash-table :test #'equal)))
    (dolist (pair (cdr ends) table)
      (dolist (node (cdr pair))
        (unless (gethash node table)
          (setf (gethash node table) (hash-table-count table)))))))

(defun circuits-ends (ends)
  "Two vectors, first and second node numbers of the branches, and the count of nodes."
  (let* ((table (circuits-node-table ends))
         (from (map 'vector (lambda (pair) (gethash (second pair) table)) (cdr ends)))
         (to (map 'vector (lambda (pair) (gethash (third pair) table)) (cdr ends))))
    (values from to (hash-table-count table))))

(defun $circuits_nodes (ends)
  "The nodes, in the order in which they are met."
  (let ((seen (make-hash-table :test #'equal)) (nodes nil))
    (dolist (pair (cdr ends))
      (dolist (node (cdr pair))
        (unless (gethash node seen)
          (setf (gethash node seen) t)
          (push node nodes))))
    (circuits-mlist (nreverse nodes))))

;; Spanning forest by Kruskal's rule: the branches are offered in ORDER, one that closes a loop is
;; refused.

(defun circuits-root (parent node)
  (loop until (= node (aref parent node))
        do (setf (aref parent node) (aref parent (aref parent node))
                 node (aref parent node)))
  node)

(defun $circuits_tree (ends order)
  "Numbers of the branches of the spanning forest, as accepted from the list ORDER."
  (multiple-value-bind (from to count) (circuits-ends ends)
    (let ((parent (make-array count)) (tree nil))
      (dotimes (node count) (setf (aref parent node) node))
      (dolist (branch (cdr order) (circuits-mlist (nreverse tree)))
        (let ((a (circuits-root parent (aref from (1- branch))))
              (b (circuits-root parent (aref to (1- branch)))))
          (unless (= a b)
            (setf (aref parent a) b)
            (push branch tree)))))))

(defun $circuits_pieces (ends)
  "The connected pieces, each a list of nodes."
  (multiple-value-bind (from to count) (circuits-ends ends)
    (let ((parent (make-array count))
          (members (make-array count :initial-element nil))
          (pieces nil))
      (dotimes (node count) (setf (aref parent node) node))
      (dotimes (branch (length from))
        (setf (aref parent (circuits-root parent (aref from branch)))
              (circuits-root parent (aref to branch))))
      (loop for member in (cdr ($circuits_nodes ends)) for node from 0
            do (push member (aref members (circuits-root parent node))))
      (dotimes (node count)
        (when (aref members node) (push (circuits-mlist (nreverse (aref members node))) pieces)))
      (circuits-mlist (nreverse pieces)))))

;; Fundamental loops: the forest is hung up from one node of each piece; the way between two nodes
;; runs over their meeting point.

(defun circuits-hang (from to count tree)
  "Vectors of parent node, parent branch (plus where its arrow points upward) and level."
  (let ((near (make-array count :initial-element nil))
        (parent (make-array count :initial-element nil))
        (upward (make-array count :initial-element 0))
        (level (make-array count :initial-element nil)))
    (dolist (branch (cdr tree))
      (let ((a (aref from (1- branch))) (b (aref to (1- branch))))
        (push (cons b branch) (aref near a))
        (push (cons a (- branch)) (aref near b))))
    (dotimes (root count)
      (unless (aref level root)
        (setf (aref level root) 0)
        (let ((waiting (list root)))
          (loop while waiting
                do (let ((node (pop waiting)))
                     (dolist (step (aref near node))
                       (unless (aref level (car step))
                         (setf (aref level (car step)) (1+ (aref level node))
                               (aref parent (car step)) node
                               (aref upward (car step)) (- (cdr step)))
                         (push (car step) waiting))))))))
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
  (multiple-value-bind (from to count) (circuits-ends ends)
    (multiple-value-bind (parent upward level) (circuits-hang from to count tree)
      (circuits-mlist
       (mapcar (lambda (link)
                 (circuits-mlist
                  (mapcar (lambda (step) (circuits-mlist (list (abs step) (signum step))))
                          (circuits-way (aref from (1- link)) (aref to (1- link))
                                        parent upward level))))
               (cdr links))))))

;; Kirchhoff's laws, from the branches themselves and without the tree: the judge of all that is
;; derived.

(defun $circuits_current_sums (ends currents)
  "Sum of the currents that leave each node."
  (multiple-value-bind (from to count) (circuits-ends ends)
    (let ((totals (make-array count :initial-element nil)))
      (loop for flow in (cdr currents) for branch from 0
            do (push flow (aref totals (aref from branch)))
               (push (neg flow) (aref totals (aref to branch))))
      (circuits-mlist (map 'list #'addn totals (make-array count :initial-element nil))))))

(defun $circuits_voltage_gaps (ends voltages)
  "For each branch its voltage less the difference of node potentials, summed up on the way."
  (multiple-value-bind (from to count) (circuits-ends ends)
    (let ((near (make-array count :initial-element nil))
          (potential (make-array count :initial-element nil)))
      (loop for voltage in (cdr voltages) for branch from 0
            do (push (cons (aref to branch) (neg voltage)) (aref near (aref from branch)))
               (push (cons (aref from branch) voltage) (aref near (aref to branch))))
      (dotimes (root count)
        (unless (aref potential root)
          (setf (aref potential root) 0)
          (let ((waiting (list root)))
            (loop while waiting
                  do (let ((node (pop waiting)))
                       (dolist (step (aref near node))
                         (unless (aref potential (car step))
                           (setf (aref potential (car step)) (add (aref potential node) (cdr step)))
                           (push (car step) waiting))))))))
      (circuits-mlist
       (loop for voltage in (cdr voltages) for branch from 0
             collect (sub (sub voltage (aref potential (aref from branch)))
                          (neg (aref potential (aref to branch)))))))))

;; Elimination. A row is a list of [column, coefficient]; the pivots are looked for column by
;; column in the given order.

(defun circuits-simpler (e)
  (if (atom e) e ($ratsimp e)))

(defun circuits-row-table (row)
  (let ((table (make-hash-table)))
    (dolist (entry (cdr row) table)
      (let ((value (circuits-simpler (add (gethash (second entry) table 0) (third entry)))))
        (if (zerop1 value)
            (remhash (second entry) table)
            (setf (gethash (second entry) table) value))))))

(defun circuits-row-list (table)
  (let ((entries nil))
    (maphash (lambda (column value) (push (list column value) entries)) table)
    (circuits-mlist (mapcar #'circuits-mlist (sort entries #'< :key #'first)))))

(defun circuits-subtract (row pivot factor)
  "ROW := ROW - FACTOR*PIVOT."
  (maphash (lambda (column value)
             (let ((new (circuits-simpler (sub (gethash column row 0) (mul factor value)))))
               (if (zerop1 new) (remhash column row) (setf (gethash column row) new))))
           pivot))

(defun circuits-scale (row column)
  (let ((pivot (gethash column row)))
    (maphash (lambda (key value)
               (setf (gethash key row) (circuits-simpler (div value pivot))))
             row)))

(defun circuits-pivot-row (rows used column)
  "The shortest unused row with an entry in COLUMN, or nil."
  (let ((best nil))
    (dolist (row rows best)
      (when (and (gethash column row) (not (member row used :test #'eq))
                 (or (null best) (< (hash-table-count row) (hash-table-count best))))
        (setq best row)))))

(defun $circuits_elimination (rows order)
  "[[[column, reduced row], ..] for the columns of ORDER with a pivot, rows left without one]."
  (let ((tables (mapcar #'circuits-row-table (cdr rows))) (used nil) (pivots nil))
    (dolist (column (cdr order))
      (let ((row (circuits-pivot-row tables used column)))
        (when row
          (circuits-scale row column)
          (dolist (other tables)
            (let ((factor (and (not (eq other row)) (gethash column other))))
              (when factor (circuits-subtract other row factor))))
          (push row used)
          (push (cons column row) pivots))))
    (circuits-mlist
     (list (circuits-mlist
            (mapcar (lambda (pair)
                      (circuits-mlist (list (car pair) (circuits-row-list (cdr pair)))))
                    (nreverse pivots)))
           (circuits-mlist
            (mapcar #'circuits-row-list
                    (remove-if (lambda (row) (member row used :test #'eq)) tables)))))))
