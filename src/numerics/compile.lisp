;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A plan as machine code by the compiler of this Lisp. The nodes go in their order into parts,
;;; each a function (lambda (x w out) ..) of its own, since compilers take far more than linear
;;; time for one long function. A value that is used once stands where it is used, others are bound
;;; by `let'; the work vector w holds what another part needs, the arguments and values of
;;; elementary functions, and the time at 0. Rows of a product become code, too, where they are few:
;;; long ones run faster as a product, and are made in no time. In long programs parts that are
;;; alike share their code. See numerics-compiled first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"
                "numerics/linear_rows" "numerics/native"
                "numerics/plan" "numerics/problem" "numerics/repetition" "numerics/routine_entry"))

(defparameter *numerics-part-length* 250
  "Operations in one function: more are spilled, fewer are stored for other functions.")
(defparameter *numerics-most-row-terms* 2000 "More terms of rows stay a product.")

(defstruct numerics-code
  plan
  (slots (make-hash-table))   ; index of a node -> its place in the work vector
  (turns (make-hash-table))   ; index of an angle -> place of its sine, that of its cosine follows
  (parts (make-hash-table))   ; index of a node -> number of its part
  (uses (make-hash-table))    ; index of a node -> how often its own part uses it
  (outputs (make-hash-table)) ; index of a node -> places of the outputs that it is
  (length 1)                  ; of the work vector
  (presets '()))              ; ((place . double) ..): constants in the work vector

;;; Statements: a node, (:keep . input), which stores an input, (:copy place . node), which gives
;;; out what is not computed in the last stage, or (:row place . form).

(defun numerics-stages (plan rows)
  "The statements of both stages."
  (let* ((early (numerics-plan-nodes plan)) (late (numerics-plan-late plan))
         (seeded (numerics-plan-seeded plan)) (last (if seeded late early))
         (copies (loop for (place . node) in (numerics-plan-outputs plan)
                       unless (member node last :test #'eq) collect (list* :copy place node))))
    (multiple-value-bind (states seeds) (numerics-kept-inputs plan (and seeded copies))
      (flet ((keep (inputs) (loop for input in inputs collect (cons :keep input))))
        (if seeded
            (list (append (keep states) early) (append (keep seeds) late copies))
            (list (append (keep states) early copies
                          (loop for row in rows collect (cons :row row)))
                  '()))))))

(defun numerics-kept-inputs (plan copies)
  "The states, and the seeds, that are needed in the work vector: arguments of functions, states
that the second stage needs, those of its COPIES too."
  (let ((kept '()))
    (flet ((keep (nodes) (dolist (node nodes) (when (algebra-input-p node) (pushnew node kept)))))
      (dolist (node (append (numerics-plan-nodes plan) (numerics-plan-late plan)))
        (when (numerics-elementary-p node) (keep (algebra-node-parts node))))
      (dolist (node (numerics-plan-late plan)) (keep (algebra-node-parts node)))
      (keep (mapcar #'cddr copies)))
    (flet ((those (kind)
             (remove kind kept :test-not #'eq
                               :key (lambda (node) (car (numerics-input-place plan node))))))
      (values (those :state) (those :seed)))))

(defun numerics-elementary-p (node)
  (and (assoc (algebra-node-operation node) *numerics-c-names*) t))

(defun numerics-operands (statement)
  "The nodes that STATEMENT uses."
  (cond ((algebra-node-p statement) (algebra-node-parts statement))
        ((eq (first statement) :copy) (list (cddr statement)))
        ((eq (first statement) :row) (mapcar #'car (cdddr statement)))))

(defun numerics-weight (statement)
  (if (algebra-node-p statement) 1 (max 1 (length (numerics-operands statement)))))

(defparameter *numerics-long-program* 15000
  "Statements whose code, 15 bytes each, begins to crowd all else out of the caches.")

(defun numerics-long-program-p (statements) (>= (length statements) *numerics-long-program*))

(defun numerics-cut (statements)
  "STATEMENTS as a list of parts."
  (if (numerics-long-program-p statements)
      (numerics-repeated-parts statements *numerics-part-length*)
      (numerics-plain-cut statements)))

(defun numerics-plain-cut (statements)
  (loop while statements
        collect (loop with length = 0
                      while (and statements (< length *numerics-part-length*))
                      do (incf length (numerics-weight (first statements)))
                      collect (pop statements))))

;;; Places in the work vector.

(defun numerics-new-slot (code &optional (count 1))
  (prog1 (numerics-code-length code) (incf (numerics-code-length code) count)))

(defun numerics-slot (code node) (gethash (algebra-node-index node) (numerics-code-slots code)))

(defun numerics-give-time-slot (code)
  (loop for index being the hash-keys of (numerics-plan-inputs (numerics-code-plan code))
          using (hash-value place)
        do (when (eq (car place) :time) (setf (gethash index (numerics-code-slots code)) 0))))

(defun numerics-give-slot (code node)
  (unless (numerics-slot code node)
    (setf (gethash (algebra-node-index node) (numerics-code-slots code))
          (case (algebra-node-operation node)
            (:sine (numerics-turn-slot code node))
            (:cosine (1+ (numerics-turn-slot code node)))
            (t (numerics-new-slot code))))))

(defun numerics-turn-slot (code node)
  (let ((angle (algebra-node-index (algebra-node-left node))))
    (or (gethash angle (numerics-code-turns code))
        (setf (gethash angle (numerics-code-turns code)) (numerics-new-slot code 2)))))

(defun numerics-constant-slot (code value)
  "A place that holds VALUE from the beginning."
  (let ((place (numerics-new-slot code)))
    (push (cons place value) (numerics-code-presets code))
    place))

(defun numerics-number-parts (code parts)
  (loop for part in parts
        for number from 0
        do (dolist (statement part)
             (when (algebra-node-p statement)
               (setf (gethash (algebra-node-index statement) (numerics-code-parts code))
                     number)))))

(defun numerics-place-statements (code parts)
  (numerics-number-parts code parts)
  (loop for part in parts
        for number from 0
        do (dolist (statement part)
             (let ((elementary (and (algebra-node-p statement) (numerics-elementary-p statement))))
               (when (or elementary (and (consp statement) (eq (first statement) :keep)))
                 (numerics-give-slot code (if elementary statement (cdr statement))))
               (dolist (node (numerics-operands statement))
                 (numerics-note-use code node number elementary)))))
  (loop for (nil nil . terms) in (numerics-plan-rows (numerics-code-plan code))
        do (loop for (node) in terms
                 unless (eq (car (numerics-input-place (numerics-code-plan code) node)) :state)
                   do (numerics-give-slot code node))))

(defun numerics-note-use (code node number stored)
  "NODE is used in part NUMBER, and has to be STORED for it or not."
  (let ((index (algebra-node-index node)))
    (unless (numerics-constant (numerics-code-plan code) node)
      (if (eql number (gethash index (numerics-code-parts code) number))
          (incf (gethash index (numerics-code-uses code) 0))
          (numerics-give-slot code node))
      (when stored (numerics-give-slot code node)))))

;;; Text. WRITTEN: index of a node of this part -> its variable or form.

(defun numerics-text (code element written)
  (let ((value (numerics-constant (numerics-code-plan code) element)))
    (cond (value (numerics-constant-text code (numerics-constant-double value)))
          ((gethash (algebra-node-index element) written))
          ((numerics-direct-input code element))
          (t `(numerics-element w ,(numerics-slot code element))))))

(defun numerics-constant-text (code value)
  (if (numerics-with-masked-traps (numerics-finite-p value))
      value
      `(numerics-element w ,(numerics-constant-slot code value))))

(defun numerics-direct-input (code node)
  "The place of an input in the vector of its stage; states have none in the second stage, where
they are kept."
  (let ((place (numerics-input-place (numerics-code-plan code) node)))
    (when (and place (not (eq (car place) :time))
               (not (and (eq (car place) :state) (numerics-slot code node)
                         (numerics-plan-seeded (numerics-code-plan code)))))
      `(numerics-element x ,(cdr place)))))

(defun numerics-operation-text (code node written)
  (flet ((text (element) (numerics-text code element written)))
    (let ((x (text (algebra-node-left node))) (y (algebra-node-right node)))
      (ecase (algebra-node-operation node)
        (:add `(+ ,x ,(text y)))
        (:subtract `(- ,x ,(text y)))
        (:multiply `(* ,x ,(text y)))
        (:divide `(numerics-quotient ,x ,(text y)))
        (:negate `(- ,x))
        (:root `(numerics-square-root ,x))
        (:absolute `(abs ,x))
        (:sign `(numerics-sign ,x))))))

(defun numerics-call-text (code node)
  "The call that stores the value of an elementary function; nil where its partner did."
  (let ((turn (numerics-turn (numerics-code-plan code) node))
        (arguments (loop for element in (numerics-arguments node)
                         collect (numerics-argument-slot code element))))
    (cond ((null turn)
           `(,(numerics-put-name (algebra-node-operation node)) w ,(numerics-slot code node)
             ,@arguments))
          ((eq node (first turn))
           `(numerics-put-turn w ,(numerics-turn-slot code node) ,@arguments)))))

(defun numerics-arguments (node)
  (if (member (algebra-node-operation node) '(:power :polar-angle))
      (list (algebra-node-left node) (algebra-node-right node))
      (list (algebra-node-left node))))

(defun numerics-argument-slot (code element)
  (let ((value (numerics-constant (numerics-code-plan code) element)))
    (if value
        (numerics-constant-slot code (numerics-constant-double value))
        (numerics-slot code element))))

;;; A part. Its steps, the last first, are (variable form) or (nil form), which is done for what it
;;; stores.

(defun numerics-part-statements (code part)
  (let ((steps '()) (written (make-hash-table)))
    (flet ((bind (variable form) (push (list variable form) steps))
           (store (vector place form)
             (push (list nil `(numerics-set-element ,vector ,place ,form)) steps)))
      (dolist (statement part)
        (cond ((algebra-node-p statement)
               (numerics-write-node code statement written #'bind #'store))
              ((eq (first statement) :keep)
               (store 'w (numerics-slot code (cdr statement))
                      `(numerics-element x ,(cdr (numerics-input-place (numerics-code-plan code)
                                                                       (cdr statement))))))
              ((eq (first statement) :copy)
               (store 'out (second statement) (numerics-text code (cddr statement) written)))
              (t (store 'out (second statement)
                        (numerics-row-text code (cddr statement) written))))))
    (numerics-part-body steps)))

(defun numerics-row-text (code form written)
  "The sum FORM in the order of a product."
  (let ((sum (and (/= (first form) 0) (numerics-constant-double (first form)))))
    (loop for (node . coefficient) in (numerics-terms-in-order
                                       (rest form)
                                       (lambda (node)
                                         (eq (car (numerics-input-place (numerics-code-plan code)
                                                                        node))
                                             :state)))
          for term = `(* ,(numerics-constant-text code (numerics-constant-double coefficient))
                         ,(numerics-text code node written))
          do (setq sum (if sum `(+ ,sum ,term) term)))
    (or sum 0d0)))

(defun numerics-part-body (steps)
  (let ((body '(nil)))
    (loop for (variable form) in steps
          do (setq body (if variable
                            `((let ((,variable ,form)) ,@body))
                            (cons form body))))
    body))

(defun numerics-part-form (body)
  `(lambda (x w out)
     (declare (type (simple-array double-float (*)) x w out) (ignorable x w out)
              (optimize (speed 1) (safety 0) (debug 0)))
     ,@body))

(defun numerics-write-node (code node written bind store)
  (let* ((index (algebra-node-index node)) (slot (numerics-slot code node))
         (places (gethash index (numerics-code-outputs code)))
         (uses (gethash index (numerics-code-uses code) 0)) (form nil))
    (cond ((numerics-elementary-p node)
           (let ((call (numerics-call-text code node)))
             (when call (funcall bind nil call)))
           (setq form `(numerics-element w ,slot) slot nil))
          (t (setq form (numerics-operation-text code node written))))
    (when (> (+ uses (if slot 1 0) (length places)) 1)
      (let ((variable (make-symbol "N")))
        (funcall bind variable form)
        (setq form variable)))
    (setf (gethash index written) form)
    (when slot (funcall store 'w slot form))
    (dolist (place places) (funcall store 'out place form))))

;;; The whole.

(defun numerics-few-rows-p (plan)
  (<= (loop for (nil nil . terms) in (numerics-plan-rows plan) sum (length terms))
      *numerics-most-row-terms*))

(defun numerics-rows-apart (plan)
  "A plan without rows, and the rows, where they are few."
  (let ((copy (copy-numerics-plan plan)))
    (cond ((numerics-few-rows-p plan)
           (setf (numerics-plan-rows copy) '())
           (values copy (numerics-plan-rows plan)))
          (t (values plan '())))))

(defun numerics-compilable-p (plan)
  "Whether there is more than a product."
  (or (plusp (numerics-plan-count plan))
      (and (numerics-plan-rows plan) (numerics-few-rows-p plan))))

(defun numerics-new-code (plan rows)
  "The code and two lists of parts."
  (let ((code (make-numerics-code :plan plan)) (last (if (numerics-plan-seeded plan)
                                                         (numerics-plan-late plan)
                                                         (numerics-plan-nodes plan))))
    (destructuring-bind (early late) (mapcar #'numerics-cut (numerics-stages plan rows))
      (loop for (place . node) in (numerics-plan-outputs plan)
            when (member node last :test #'eq)
              do (push place (gethash (algebra-node-index node) (numerics-code-outputs code))))
      (numerics-give-time-slot code)
      (numerics-place-statements code (append early late))
      (values code early late))))

(defun numerics-compiled-parts (code parts)
  "The function (x w out) that does PARTS one after the other."
  (let ((bodies (loop for part in parts collect (numerics-part-statements code part))))
    (core-quietly
     (lambda ()
       (or (and (numerics-long-program-p (loop for part in parts append part))
                (numerics-shared-routine bodies))
           (numerics-caller (loop for body in bodies
                                  collect (compile nil (numerics-part-form body)))))))))

(defun numerics-compiled (plan)
  "Two functions: (time x out), and (seed out) for the second stage."
  (multiple-value-bind (code early late) (multiple-value-call #'numerics-new-code
                                           (numerics-rows-apart plan))
    (let* ((plan (numerics-code-plan code))
           (first (numerics-compiled-parts code early))
           (second (numerics-compiled-parts code late))
           (work (numerics-zeros (numerics-code-length code))))
      (loop for (place . value) in (numerics-code-presets code) do (setf (aref work place) value))
      (numerics-entries plan work (lambda (node) (numerics-slot code node)) first second))))

(defun numerics-caller (parts)
  "What calls PARTS, functions (x w out), one after the other."
  (if (and parts (null (rest parts)))
      (first parts)
      (let ((parts (coerce parts 'simple-vector)))
        (lambda (x w out)
          (declare (type simple-vector parts) (optimize speed))
          (loop for part across parts do (funcall (the function part) x w out))))))
