;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; WriteNetlist: a circuit with numbers as a SPICE netlist. R L C V I E G F H K are written as
;;; such, laws and sources that vary as sources B; an ideal transformer as E and F, an ideal
;;; operational amplifier as E of gain 1e9. Where a current controls, a source of 0 volts stands in
;;; its branch.
;;; In the sign convention generator the branch voltage is reversed: then R, and the laws, change
;;; their sign. See circuits-write-netlist first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/new_files" "circuits/element_laws" "circuits/elements" "circuits/graph"
                "circuits/netlist_formulas" "core/title_lines" "forms/exchange" "forms/laws"))

(defstruct circuits-card-file
  circuit branches
  numbers        ; [name = number, ..]
  ground         ; the node that is 0
  names          ; node -> what it was called in a netlist, if SPICE's formulas can name it so
  sensed         ; labels of branches whose current controls others
  starts         ; ((state . number) ..)
  (words (make-hash-table :test #'equal))   ; (sort key) -> name; (sort small name) -> t
  (lines '()))   ; newest first

(defun $circuits_write_netlist (text file replace title)
  "Writes TEXT under TITLE to FILE, whose name is returned."
  (unless (stringp file)
    (core-error "the second argument is the name of a file, found ~a" (core-words (list file))))
  (algebra-check-new-file file replace)
  (algebra-write-file file (lambda (stream)
                              (format stream "~a~%~a" (circuits-title-line title) text)))
  file)

(defun $circuits_netlist_text (circuit values where nodes start time)
  "CIRCUIT with numbers as the text of a netlist, below its title."
  (let ((cards (circuits-new-cards circuit (cons '(mlist) (append (cdr where) (cdr values)))
                                   nodes start)))
    (dolist (branch (circuits-card-file-branches cards)) (circuits-write-branch cards branch))
    (circuits-write-couplings cards)
    (loop for transformer in (cdr ($circuits_circuit_transformers circuit))
          for k from 1
          do (circuits-write-transformer cards transformer k))
    (circuits-tie-pieces cards)
    (format nil "~{~a~%~}~@[~a~%~].end~%" (reverse (circuits-card-file-lines cards))
            (circuits-span-line time))))

(defun circuits-title-line (title)
  "TITLE as the first line; circuit where it is none."
  (let ((line (string-trim " " (substitute-if #\Space (lambda (c) (< (char-code c) 32)) title))))
    (if (string= line "") "circuit" (core-title-line line))))

(defun circuits-new-cards (circuit numbers nodes start)
  (let* ((branches (cdr ($circuits_circuit_branches circuit)))
         (ends (mapcan (lambda (branch) (cdr ($circuits_ends branch))) branches))
         (datum ($circuits_circuit_datum circuit)))
    (make-circuits-card-file
     :circuit circuit :branches branches :numbers numbers
     :ground (cond ((member 0 ends) 0) ((eq datum '$none) (first ends)) (t datum))
     :names (loop for (nil node name) in (cdr nodes)
                  when (every #'alphanumericp (remove #\_ name)) collect (cons node name))
     :sensed (loop for branch in branches
                   when (member (circuits-branch-type branch) '(|$f| |$h|))
                     collect (second (circuits-branch-control branch)))
     :starts (loop for (nil state value) in (cdr start) collect (cons state value)))))

(defun circuits-put-card (cards control &rest arguments)
  (push (apply #'format nil control arguments) (circuits-card-file-lines cards)))

;;; Names and numbers. To SPICE a and A are one, and gnd is 0.

(defun circuits-card-word (cards sort key control &rest arguments)
  "The name of KEY among those of SORT, :node or :element: what CONTROL gives, with a number behind
it where that is taken."
  (let ((words (circuits-card-file-words cards)) (wanted (apply #'format nil control arguments)))
    (or (gethash (list sort :of key) words)
        (loop for k from 1
              for word = wanted then (format nil "~a_~d" wanted k)
              for small = (list sort (string-downcase word))
              do (unless (or (gethash small words) (equal small '(:node "gnd")))
                   (setf (gethash small words) t)
                   (return (setf (gethash (list sort :of key) words) word)))))))

(defun circuits-card-node (cards node)
  (let ((named (cdr (assoc node (circuits-card-file-names cards)))))
    (if (equal node (circuits-card-file-ground cards))
        "0"
        (circuits-card-word cards :node node "~a"
                            (cond ((stringp named) named)
                                  ((integerp node) (format nil "~d" node))
                                  (t (string-downcase (core-spelling node))))))))

(defun circuits-card-name (cards branch letter)
  "The label, with LETTER before it unless it begins so."
  (let ((label (core-spelling (circuits-branch-label branch))))
    (circuits-card-word cards :element (list label letter) "~@[~a_~]~a"
                        (if (char-equal (char label 0) letter) nil letter) label)))

(defun circuits-card-sensor (cards label)
  "The source of 0 volts in the branch LABEL, whose current controls others."
  (circuits-card-word cards :element (list :sensor label) "V_i_~a" (core-spelling label)))

(defun circuits-card-number (cards e what)
  (circuits-number-of (circuits-with-numbers cards e) what))

(defun circuits-with-numbers (cards e)
  (mfuncall '$forms_put_laws ($circuits_circuit_laws (circuits-card-file-circuit cards))
            (loop with pairs = (circuits-card-file-numbers cards)
                  repeat (length pairs)
                  do (setq e ($forms_exchange e pairs))
                  finally (return e))))

(defun circuits-card-value (cards branch)
  (circuits-spice-number
   (circuits-card-number cards (circuits-branch-value branch)
                         (core-spelling (circuits-branch-label branch)))))

;;; Branches

(defun circuits-write-branch (cards branch)
  (let* ((ends (circuits-sensed-ends-of cards branch))
         (a (first ends)) (b (second ends)) (type (circuits-branch-type branch)))
    (flet ((named (letter) (circuits-card-name cards branch letter))
           (value () (circuits-card-value cards branch)))
      (ecase type
        (|$r| (circuits-put-card cards "~a ~a ~a ~a" (named #\R) a b
                                 (circuits-resistance-card cards branch)))
        ((|$l| |$c|) (circuits-write-store cards branch a b))
        ((|$e| |$i|) (circuits-write-source cards branch a b))
        ((|$ru| |$ri|) (circuits-write-law cards branch a b))
        (|$ev| (circuits-put-card cards "~a ~a ~a ~{~a ~}~a" (named #\E) a b
                                  (circuits-control-nodes cards branch) (value)))
        (|$g| (circuits-put-card cards "~a ~a ~a ~{~a ~}~a" (named #\G) a b
                                 (circuits-control-nodes cards branch) (value)))
        (|$o| (circuits-put-card cards "~a ~a ~a ~{~a ~}1e9" (named #\E) a b
                                 (circuits-control-nodes cards branch)))
        ((|$f| |$h|)
         (circuits-put-card cards "~a ~a ~a ~a ~a"
                            (named (if (eq type '|$f|) #\F #\H)) a b
                            (circuits-card-sensor cards (second (circuits-branch-control branch)))
                            (value)))))))

(defun circuits-control-nodes (cards branch)
  (mapcar (lambda (node) (circuits-card-node cards node))
          (last (cdr (circuits-branch-control branch)) 2)))

(defun circuits-sensed-ends-of (cards branch)
  "The nodes of BRANCH, behind a source of 0 volts where its current controls others."
  (destructuring-bind (a b) (mapcar (lambda (node) (circuits-card-node cards node))
                                    (cdr ($circuits_ends branch)))
    (let ((label (circuits-branch-label branch)))
      (cond ((member label (circuits-card-file-sensed cards))
             (let ((behind (circuits-card-word cards :node (list :behind label) "n_i_~a"
                                               (core-spelling label))))
               (circuits-put-card cards "~a ~a ~a 0" (circuits-card-sensor cards label) a behind)
               (list behind b)))
            (t (list a b))))))

(defun circuits-card-sign (cards) ($circuits_circuit_sign (circuits-card-file-circuit cards)))

(defun circuits-resistance-card (cards branch)
  (circuits-spice-number
   (* (circuits-card-sign cards)
      (circuits-card-number cards (circuits-branch-value branch)
                            (core-spelling (circuits-branch-label branch))))))

(defun circuits-write-store (cards branch a b)
  (let* ((inductor (eq (circuits-branch-type branch) '|$l|))
         (start (assoc (circuits-branch-state branch) (circuits-card-file-starts cards)))
         (turned (if inductor 1 (circuits-card-sign cards))))
    (circuits-put-card
     cards "~a ~a ~a ~a~@[ IC=~a~]" (circuits-card-name cards branch (if inductor #\L #\C)) a b
     (circuits-card-value cards branch)
     (and start (circuits-spice-number (* turned (circuits-card-number cards (cdr start)
                                                                       "a start value")))))))

(defun circuits-write-source (cards branch a b)
  (let ((letter (if (eq (circuits-branch-type branch) '|$e|) #\V #\I))
        (value (circuits-with-numbers cards (circuits-branch-value branch))))
    (if ($freeof '$t value)
        (circuits-put-card cards "~a ~a ~a ~a" (circuits-card-name cards branch letter) a b
                           (circuits-card-value cards branch))
        (circuits-put-card cards "~a ~a ~a ~a={~a}" (circuits-card-name cards branch #\B) a b letter
                           (circuits-spice-formula value '(($t . "time")))))))

(defun circuits-write-law (cards branch a b)
  "RU as a current by its own voltage; RI as a voltage by the current of a source of 0 volts."
  (let* ((x '$circuits_law_variable) (sign (circuits-card-sign cards))
         (law (circuits-with-numbers cards (mfuncall '$circuits_law (circuits-branch-value branch) x
                                                     ($circuits_circuit_laws
                                                      (circuits-card-file-circuit cards)))))
         (name (circuits-card-name cards branch #\B))
         (sensor (circuits-card-word cards :element (list :law name) "V_~a" name))
         (between (circuits-card-word cards :node (list :law name) "n_~a" name)))
    (cond ((eq (circuits-branch-type branch) '|$ru|)
           (circuits-put-card cards "~a ~a ~a I={~a}" name a b
                              (circuits-spice-formula
                               law (list (cons x (if (= sign 1) (format nil "V(~a,~a)" a b)
                                                     (format nil "V(~a,~a)" b a)))))))
          (t (circuits-put-card cards "~a ~a ~a 0" sensor a between)
             (circuits-put-card cards "~a ~a ~a V={~:[-~;~]~a}" name between b (= sign 1)
                                (circuits-spice-formula
                                 law (list (cons x (format nil "I(~a)" sensor)))))))))

;;; What joins branches

(defun circuits-write-couplings (cards)
  (let ((branches (coerce (circuits-card-file-branches cards) 'vector)))
    (loop for coupling in (cdr ($circuits_circuit_couplings (circuits-card-file-circuit cards)))
          for number from 1
          for one = (aref branches (1- (circuits-coupling-one coupling)))
          for other = (aref branches (1- (circuits-coupling-other coupling)))
          do (circuits-put-card
              cards "K~d ~a ~a ~a" number (circuits-card-name cards one #\L)
              (circuits-card-name cards other #\L)
              (circuits-spice-number
               (circuits-card-number
                cards (or (circuits-coupling-k coupling)
                          (div (circuits-coupling-mutual coupling)
                               (power (mul (circuits-branch-value one)
                                           (circuits-branch-value other))
                                      '((rat simp) 1 2))))
                "a coupling"))))))

(defun circuits-write-transformer (cards transformer k)
  "u_ab = n*u_cd, i_cd = -n*i_ab"
  (flet ((nodes (pair) (mapcar (lambda (node) (circuits-card-node cards node)) (cdr pair))))
    (destructuring-bind ((a b) (c d)) (list (nodes (circuits-transformer-pair transformer))
                                            (nodes (circuits-transformer-driven transformer)))
      (let ((n (circuits-card-number cards (circuits-transformer-ratio transformer) "a ratio"))
            (between (circuits-card-word cards :node (list :transformer k) "n_t~d" k)))
        (flet ((named (letter)
                 (circuits-card-word cards :element (list :transformer k letter) "~a_t~d" letter
                                     k)))
          (circuits-put-card cards "~a ~a ~a ~a ~a ~a" (named #\E) a between c d
                             (circuits-spice-number n))
          (circuits-put-card cards "~a ~a ~a 0" (named #\V) between b)
          (circuits-put-card cards "~a ~a ~a ~a ~a" (named #\F) c d (named #\V)
                             (circuits-spice-number (- n))))))))

(defun circuits-tie-pieces (cards)
  "A large resistor from node 0 to each part that only couplings or transformers join to it."
  (let ((pieces (cdr ($circuits_pieces (cons '(mlist)
                                             (mapcar #'$circuits_ends
                                                     (circuits-card-file-branches cards)))))))
    (loop for piece in pieces
          for k from 1
          unless (member (circuits-card-file-ground cards) (cdr piece))
            do (circuits-put-card cards "~a 0 ~a 1e12"
                                  (circuits-card-word cards :element (list :tie k) "R_tie_~d" k)
                                  (circuits-card-node cards (second piece))))))

(defun circuits-span-line (time)
  ".tran .., or nil without a span of time."
  (when (cdr time)
    (destructuring-bind (from to) (mapcar (lambda (e) (circuits-number-of e "time")) (cdr time))
      (unless (zerop from) (core-error "a run of SPICE begins at t = 0, time is ~a"
                                       (core-words (list time))))
      (let ((largest (circuits-spice-number (/ to 1000))))
        (format nil ".tran ~a ~a 0 ~a uic" largest (circuits-spice-number to) largest)))))
