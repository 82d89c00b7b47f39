;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_dop853.mac: order conditions of a Runge-Kutta method in exact arithmetic, by
;;; rooted trees (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I,
;;; section II.2), and its steps in the arithmetic of Maxima. A tree is the list of its branches.

(in-package :maxima)

(defun orders-forests (nodes largest)
  "Lists of trees with NODES nodes in all, none with more than LARGEST."
  (if (zerop nodes)
      '(())
      (loop for size from (min nodes largest) downto 1
            append (loop for tree in (orders-trees size)
                         append (loop for rest in (orders-forests (- nodes size) size)
                                      when (orders-not-after-p tree (car rest))
                                        collect (cons tree rest))))))

(defun orders-not-after-p (tree other)
  "In a forest trees of one size stand in the order of their list."
  (or (null other)
      (/= (orders-size tree) (orders-size other))
      (let ((trees (orders-trees (orders-size tree))))
        (<= (position tree trees) (position other trees)))))

(defvar *orders-trees* (make-hash-table))

(defun orders-trees (nodes)
  (or (gethash nodes *orders-trees*)
      (setf (gethash nodes *orders-trees*) (orders-forests (1- nodes) (1- nodes)))))

(defun orders-size (tree) (1+ (reduce #'+ (mapcar #'orders-size tree))))

(defun orders-density (tree)
  (* (orders-size tree) (reduce #'* (mapcar #'orders-density tree))))

;;; Weights of trees, and of the method

(defvar *orders-elementary* (make-hash-table))

(defun orders-row (stage)
  (if (= stage 1) '() (numerics-dopri-weights :stage stage)))

(defun orders-elementary (tree)
  "For each of the stages 1 to 16 the product over the branches of the sums of a_ij times theirs."
  (or (gethash tree *orders-elementary*)
      (setf (gethash tree *orders-elementary*)
            (coerce (loop for stage from 1 to 16
                          collect (let ((product 1))
                                    (dolist (branch tree product)
                                      (setq product (* product (orders-sum (orders-row stage)
                                                                           branch))))))
                    'vector))))

(defun orders-sum (row tree)
  (loop for (stage . weight) in row sum (* weight (aref (orders-elementary tree) (1- stage)))))

(defun orders-weight (row stage) (or (cdr (assoc stage row)) 0))

(defun orders-dense-row (s)
  "The weights of the state at the share S, as ((stage . weight) ..)."
  (loop with y = (- 1 s)
        for stage from 1 to 16
        collect
        (flet ((d (k) (orders-weight (numerics-dopri-weights :dense k) stage)))
          (let* ((way (orders-weight (orders-row 13) stage))
                 (bend (- (if (= stage 1) 1 0) way))
                 (back (- way (if (= stage 13) 1 0) bend)))
            (cons stage
                  (* s (+ way (* y (+ bend (* s (+ back (* y (+ (d 0) (* s (+ (d 1) (* y (+ (d 2)
                                                                      (* s (d 3)))))))))))))))))))

(defun orders-difference (row other)
  (loop for stage from 1 to 13
        collect (cons stage (- (orders-weight row stage) (orders-weight other stage)))))

(defun orders-largest (row order goal)
  "The largest residual of the conditions of ORDER: the sums should be GOAL over the density."
  (coerce (loop for tree in (orders-trees order)
                maximize (abs (- (orders-sum row tree) (/ goal (orders-density tree)))))
          'double-float))

(defun $orders_state (order) (orders-largest (orders-row 13) order 1))

(defun $orders_fifth (order) (orders-largest (numerics-dopri-weights :error 0) order 0))

(defun $orders_third (order)
  (orders-largest (orders-difference (orders-row 13) (numerics-dopri-weights :error 1)) order 0))

(defun $orders_between (order s)
  (let ((s (if (consp s) (/ (cadr s) (caddr s)) s)))
    (orders-largest (orders-dense-row s) order (expt s order))))

(defun $orders_conditions (order) (length (orders-trees order)))

(defun $orders_nodes ()
  "The largest difference of a node and the sum of its row."
  (coerce (loop for stage from 2 to 16
                maximize (abs (- (aref *numerics-dopri-nodes* (1- stage))
                                 (loop for (nil . weight) in (orders-row stage) sum weight))))
          'double-float))

(defun $orders_rounding ()
  "The largest relative difference of a coefficient and its double-float number, in last places."
  (loop for row in (append (mapcar #'cdr *numerics-dopri-stages*)
                           *numerics-dopri-errors* *numerics-dopri-dense*
                           (list (map 'list (lambda (node) (cons 0 node)) *numerics-dopri-nodes*)))
        maximize (loop for (nil . weight) in row
                       unless (zerop weight)
                         maximize (coerce (/ (abs (- (rational (numerics-rounded weight)) weight))
                                             (abs weight) (expt 2 -53))
                                          'double-float))))

;;; A step in the arithmetic of Maxima

(defun orders-rational (x)
  (if (integerp x) x (list '(rat simp) (numerator x) (denominator x))))

(defun orders-combination (state step row slopes)
  "STATE and STEP times the sum of ROW over SLOPES, lists of numbers of Maxima."
  (loop for x in state
        for i from 0
        collect (add x (mul step (addn (loop for (stage . weight) in row
                                             collect (mul (orders-rational weight)
                                                          (nth i (aref slopes stage))))
                                       t)))))

(defun $orders_step (rates time state step &optional s)
  "[state after STEP, state at the share S of it], by RATES, a Maxima function (t, [x]) -> [x']."
  (let ((slopes (make-array 17)) (state (cdr state)))
    (loop for stage from 1 to (if s 16 12)
          do (setf (aref slopes stage)
                   (cdr (mfuncall rates
                                  (add time (mul step (orders-rational
                                                       (aref *numerics-dopri-nodes* (1- stage)))))
                                  (cons '(mlist simp)
                                        (orders-combination state step (orders-row stage)
                                                            slopes))))))
    (flet ((combined (row) (cons '(mlist simp) (orders-combination state step row slopes))))
      (list '(mlist simp) (combined (orders-row 13))
            (if s (combined (orders-dense-row (if (consp s) (/ (cadr s) (caddr s)) s))) nil)))))
