;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Random linear circuits of all elements against a tableau written out here over the rational
;;; numbers: Kirchhoff's laws for all nodes and the laws of all branches at one s, solved with all
;;; pivots sought in full. fuzz_tableau(count, seed): the failures, each [number, what, description].
;;; All sources are U*exp(s*t) at a random rational s, or constants at s = 0. Then with the states as
;;; the solution has them
;;;   the equations s*x = A*x + B*U + B1*s*U hold, and all voltages, currents and potentials are those
;;;   of BranchQuantities, dependent states those of CheckCircuit;
;;;   the order is the degree of the determinant as a polynomial in s; what is refused for want of a
;;;   solution has the determinant 0 for every s;
;;;   transfer functions, impedances, and the derivatives of P where there is one, are what they
;;;   should be;
;;; the same where rows change places, branches are reversed and nodes have other names.

(in-package :maxima)

(core-require "circuits/branch_quantities" "circuits/check" "circuits/circuit" "circuits/order"
              "circuits/solved_tableau" "circuits/symmetric_potential" "circuits/tableau_matrices"
              "circuits/transfer")

(defvar *fuzz-state* 1)

(defun fuzz-below (n)
  (setq *fuzz-state* (mod (+ (* 1103515245 *fuzz-state*) 12345) (expt 2 31)))
  (mod (floor *fuzz-state* 4096) n))

(defun fuzz-choice (&rest items) (nth (fuzz-below (length items)) items))
(defun fuzz-positive () (/ (1+ (fuzz-below 9)) (1+ (fuzz-below 3))))
(defun fuzz-any () (* (fuzz-choice 1 1 -1) (fuzz-positive)))

;;; Circuits: rows (label tail head type value . control), [couplings], [transformers]

(defstruct fuzz-circuit sign rows couplings transformers)

(defun fuzz-label (k) (intern (format nil "$B~d" k) :maxima))
(defun fuzz-row-label (row) (first row))
(defun fuzz-row-type (row) (fourth row))
(defun fuzz-row-value (row) (fifth row))
(defun fuzz-row-control (row) (nthcdr 5 row))

(defun fuzz-node (base nodes) (+ base (fuzz-below nodes)))

(defun fuzz-element (base nodes labels tail head)
  "A row without label, of nodes from BASE on, controlled by nodes there or by one of LABELS."
  (let ((type (fuzz-choice :l :l :c :c :r :r :r :e :i :ev :g :f :h :o)))
    (case type
      ((:l :c) (list tail head type (fuzz-positive)))
      (:r (list tail head type (fuzz-any)))
      ((:e :i) (list tail head type (fuzz-any)))
      ((:ev :g) (list tail head type (fuzz-any) (fuzz-node base nodes) (fuzz-node base nodes)))
      ((:f :h) (list tail head type (fuzz-any) (apply #'fuzz-choice labels)))
      (:o (let ((a (fuzz-node base nodes)))
            (list tail head type 0 a
                  (+ base (mod (+ (- a base) 1 (fuzz-below (1- nodes))) nodes))))))))

(defun fuzz-part (base nodes branches labels)
  (append
   (loop for k from 1 below nodes
         collect (fuzz-element base nodes labels (+ base (fuzz-below k)) (+ base k)))
   (loop repeat (- branches nodes -1)
         collect (let ((tail (fuzz-below nodes)))
                   (fuzz-element base nodes labels (+ base tail)
                                 (+ base (mod (+ tail 1 (fuzz-below (1- nodes))) nodes)))))))

(defun fuzz-motif (base nodes)
  "Now and then what is rare by chance: a gyrator, an inverting amplifier, a follower onto a
capacitor, a loop of source and capacitor, a cut of source and inductor."
  (flet ((at (k) (+ base (mod k nodes))) (new (k) (+ base 20 k)))
    (case (fuzz-below 8)
      (0 (let ((g (fuzz-any)))
           `((,(at 0) ,(at 1) :g ,g ,(at 2) ,(at 1)) (,(at 2) ,(at 1) :g ,(- g) ,(at 0) ,(at 1)))))
      (1 `((,(at 0) ,(new 0) ,(fuzz-choice :r :c) ,(fuzz-positive))
           (,(new 0) ,(new 1) ,(fuzz-choice :r :c) ,(fuzz-positive))
           (,(new 1) ,(at 1) :o 0 ,(new 0) ,(at 1))))
      (2 `((,(new 0) ,(at 0) :o 0 ,(new 0) ,(at 1)) (,(new 0) ,(at 0) :c ,(fuzz-positive))))
      (3 `((,(at 0) ,(at 1) :e ,(fuzz-any)) (,(at 0) ,(at 1) :c ,(fuzz-positive))))
      (4 `((,(at 0) ,(new 0) :i ,(fuzz-any)) (,(new 0) ,(at 1) :l ,(fuzz-positive))
           (,(at 1) ,(new 0) :l ,(fuzz-positive))))
      (t '()))))

(defun fuzz-new-circuit ()
  (let* ((parts (1+ (fuzz-below 2))) (labels (list (fuzz-label 1) (fuzz-label 2)))
         (n (+ 2 (fuzz-below 3)))
         (rows (append (fuzz-part 1 n (+ n (fuzz-below 4)) labels) (fuzz-motif 1 n)
                       (when (= parts 2)
                         (let ((m (+ 2 (fuzz-below 2))))
                           (fuzz-part 11 m (+ m (fuzz-below 2)) labels)))))
         (labelled (loop for row in rows for k from 1 collect (cons (fuzz-label k) row))))
    (fuzz-with-couplings
     (make-fuzz-circuit
      :sign (fuzz-choice 1 -1)
      :rows (mapcar #'fuzz-without-itself labelled)
      :transformers (when (or (= parts 2) (zerop (fuzz-below 5)))
                      (list (list 1 2 (if (= parts 2) 11 2) (if (= parts 2) 12 1)
                                  (fuzz-any))))))))

(defun fuzz-without-itself (row)
  "ROW, a resistor where it would be controlled by its own current."
  (if (member (fuzz-row-label row) (fuzz-row-control row))
      (append (subseq row 0 3) (list :r (fuzz-row-value row)))
      row))

(defun fuzz-with-couplings (circuit)
  "The first two inductors coupled in one of three: M = k*sqrt(L1*L2), k = 1/2, -1, 1."
  (let ((coils (remove :l (fuzz-circuit-rows circuit) :key #'fuzz-row-type :test-not #'eq)))
    (when (and (cdr coils) (zerop (fuzz-below 3)))
      (destructuring-bind (one other &rest more) coils
        (declare (ignore more))
        (let ((n (fuzz-positive)))
          (setf (fifth other) (* (fuzz-row-value one) n n)
                (fuzz-circuit-couplings circuit)
                (list (list (fuzz-row-label one) (fuzz-row-label other)
                            (* (fuzz-choice 1/2 -1 1) n (fuzz-row-value one))))))))
    circuit))

;;; As a description

(defun fuzz-name (keyword) (core-symbol (symbol-name keyword)))
(defun fuzz-maxima-list (items) (cons '(mlist simp) items))
(defun fuzz-number (x) (algebra-maxima-rational x))

(defun fuzz-source (row)
  "The function that its value is."
  (list (list (intern (format nil "$SOURCE_~a" (subseq (symbol-name (fuzz-row-label row)) 1))
                      :maxima)
              'simp)
        '$t))

(defun fuzz-described-row (row moving)
  (destructuring-bind (label tail head type value &rest control) row
    (list '(mequal simp) label
          (fuzz-maxima-list
           (append (list tail head (fuzz-name type))
                   (cond ((eq type :o) '())
                         ((and moving (member type '(:e :i))) (list (fuzz-source row)))
                         (t (list (if (numberp value) (fuzz-number value) value))))
                   control)))))

(defun fuzz-description (circuit moving)
  (flet ((entry (key value) (list '(mequal simp) key value))
         (rows (lists)
           (fuzz-maxima-list
            (loop for list in lists
                  collect (fuzz-maxima-list
                           (mapcar (lambda (x) (if (numberp x) (fuzz-number x) x)) list))))))
    (fuzz-maxima-list
     (list (entry '$kind '$circuit)
           (entry '$sign (if (= 1 (fuzz-circuit-sign circuit)) '$passive '$generator))
           (entry '$branches
                  (fuzz-maxima-list (loop for row in (fuzz-circuit-rows circuit)
                                          collect (fuzz-described-row row moving))))
           (entry '$couplings (rows (fuzz-circuit-couplings circuit)))
           (entry '$transformers (rows (fuzz-circuit-transformers circuit)))))))

;;; The tableau at one s. Unknowns: (:v node), (:j label), (:w k).

(defun fuzz-nodes (circuit)
  (remove-duplicates
   (append (loop for (nil tail head) in (fuzz-circuit-rows circuit) collect tail collect head)
           (loop for (a b c d) in (fuzz-circuit-transformers circuit)
                 append (list a b c d)))
   :from-end t))

(defun fuzz-grounds (circuit)
  "The first node of each part that branches and windings join."
  (let ((parent (make-hash-table)))
    (labels ((root (x) (let ((up (gethash x parent x))) (if (eql up x) x (root up))))
             (join (a b) (let ((ra (root a)) (rb (root b))) (setf (gethash rb parent) ra))))
      (loop for (nil tail head) in (fuzz-circuit-rows circuit) do (join tail head))
      (loop for (a b c d) in (fuzz-circuit-transformers circuit) do (join a b) (join c d))
      (remove-duplicates (fuzz-nodes circuit) :key #'root :from-end t))))

(defun fuzz-unknowns (circuit)
  (append (loop for node in (fuzz-nodes circuit) collect (list :v node))
          (loop for row in (fuzz-circuit-rows circuit) collect (list :j (fuzz-row-label row)))
          (loop for nil in (fuzz-circuit-transformers circuit) for k from 0
                collect (list :w k))))

(defun fuzz-equations (circuit s inputs)
  "Lists of (unknown . coefficient) with (nil . constant); INPUTS are ((label . value) ..)."
  (append (fuzz-node-equations circuit)
          (loop for row in (fuzz-circuit-rows circuit)
                collect (fuzz-law-equation circuit row s inputs))
          (loop for (a b c d n) in (fuzz-circuit-transformers circuit)
                collect `(((:v ,a) . 1) ((:v ,b) . -1) ((:v ,c) . ,(- n)) ((:v ,d) . ,n)))))

(defun fuzz-node-equations (circuit)
  (let ((grounds (fuzz-grounds circuit)))
    (loop for node in (fuzz-nodes circuit)
          collect (if (member node grounds)
                      `(((:v ,node) . 1))
                      (append
                       (loop for (label tail head) in (fuzz-circuit-rows circuit)
                             when (eql node tail) collect `((:j ,label) . 1)
                               when (eql node head) collect `((:j ,label) . -1))
                       (loop for (a b c d n) in (fuzz-circuit-transformers circuit)
                             for k from 0
                             when (eql node a) collect `((:w ,k) . 1)
                               when (eql node b) collect `((:w ,k) . -1)
                                 when (eql node c) collect `((:w ,k) . ,(- n))
                                   when (eql node d) collect `((:w ,k) . ,n)))))))

(defun fuzz-law-equation (circuit row s inputs)
  (destructuring-bind (label tail head type value &optional a b) row
    (flet ((drop (x) `(((:v ,tail) . ,x) ((:v ,head) . ,(- x))))
           (flow (x) `(((:j ,label) . ,x)))
           (input () (- (or (cdr (assoc label inputs)) 0))))
      (ecase type
        (:l (append (drop -1) (flow (* s value))
                    (loop for (one other m) in (fuzz-circuit-couplings circuit)
                          when (eq one label) collect `((:j ,other) . ,(* s m))
                            when (eq other label) collect `((:j ,one) . ,(* s m)))))
        (:c (append (drop (* s value)) (flow -1)))
        (:r (append (drop (fuzz-circuit-sign circuit)) (flow (- value))))
        (:e (append (drop 1) `((nil . ,(input)))))
        (:i (append (flow 1) `((nil . ,(input)))))
        (:ev (append (drop 1) `(((:v ,a) . ,(- value)) ((:v ,b) . ,value))))
        (:g (append (flow 1) `(((:v ,a) . ,(- value)) ((:v ,b) . ,value))))
        (:f (append (flow 1) `(((:j ,a) . ,(- value)))))
        (:h (append (drop 1) `(((:j ,a) . ,(- value)))))
        (:o `(((:v ,a) . 1) ((:v ,b) . -1)))))))

(defun fuzz-matrix (circuit s inputs)
  "Rows of numbers, the last the right side."
  (let* ((unknowns (fuzz-unknowns circuit)) (n (length unknowns)))
    (loop for equation in (fuzz-equations circuit s inputs)
          collect (let ((row (make-array (1+ n) :initial-element 0)))
                    (loop for (unknown . x) in equation
                          do (if unknown
                                 (incf (aref row (position unknown unknowns :test #'equal)) x)
                                 (decf (aref row n) x)))
                    row))))

(defun fuzz-gauss (rows)
  "Two values: the determinant, and the solution as a vector, nil where the determinant is 0."
  (let* ((a (coerce rows 'vector)) (n (length a)) (determinant 1))
    (dotimes (k n (values determinant (map 'vector (lambda (row) (aref row n)) a)))
      (let ((place (loop for i from k below n
                         unless (zerop (aref (aref a i) k)) return i)))
        (unless place (return (values 0 nil)))
        (unless (= place k)
          (rotatef (aref a place) (aref a k))
          (setq determinant (- determinant)))
        (let* ((row (aref a k)) (pivot (aref row k)))
          (setq determinant (* determinant pivot))
          (loop for j from k to n do (setf (aref row j) (/ (aref row j) pivot)))
          (dotimes (i n)
            (let ((factor (aref (aref a i) k)))
              (unless (or (= i k) (zerop factor))
                (loop for j from k to n
                      do (decf (aref (aref a i) j) (* factor (aref row j))))))))))))

(defun fuzz-degree (circuit)
  "The degree of the determinant in s by its differences at s = 0, 1, 2, ..; -1 where it is 0."
  (let* ((most (count-if (lambda (row) (member (fuzz-row-type row) '(:l :c)))
                         (fuzz-circuit-rows circuit)))
         (values (loop for s from 0 to most
                       collect (fuzz-gauss (fuzz-matrix circuit s '()))))
         (degree -1))
    (loop for k from 0
          while values
          do (unless (zerop (car values)) (setq degree k))
             (setq values (mapcar #'- (cdr values) values)))
    degree))

;;; A solution: values by unknown, by state, by source

(defstruct fuzz-solution s table inputs circuit)

(defun fuzz-solve (circuit s inputs)
  (let ((x (nth-value 1 (fuzz-gauss (fuzz-matrix circuit s inputs))))
        (table (make-hash-table :test #'equal)))
    (when x
      (loop for unknown in (fuzz-unknowns circuit) for value across x
            do (setf (gethash unknown table) value))
      (make-fuzz-solution :s s :table table :inputs inputs :circuit circuit))))

(defun fuzz-of (solution unknown) (gethash unknown (fuzz-solution-table solution)))

(defun fuzz-voltage (solution row)
  (* (if (member (fuzz-row-type row) '(:l :c :r))
         (fuzz-circuit-sign (fuzz-solution-circuit solution))
         1)
     (- (fuzz-of solution (list :v (second row))) (fuzz-of solution (list :v (third row))))))

(defun fuzz-current (solution row) (fuzz-of solution (list :j (fuzz-row-label row))))

(defun fuzz-state-name (row)
  (core-symbol (format nil "~(~a~)_~a" (if (eq (fuzz-row-type row) :l) :i :u)
                       (core-spelling (fuzz-row-label row)))))

(defun fuzz-states (solution)
  "((name . value) ..) of all inductors and capacitors."
  (loop for row in (fuzz-circuit-rows (fuzz-solution-circuit solution))
        when (eq (fuzz-row-type row) :l)
          collect (cons (fuzz-state-name row) (fuzz-current solution row))
        when (eq (fuzz-row-type row) :c)
          collect (cons (fuzz-state-name row) (fuzz-voltage solution row))))

(defun fuzz-value (e solution names)
  "The number that the expression E is, states by NAMES, sources and their rates by SOLUTION."
  (labels ((value (e)
             (cond ((algebra-rational-number e))
                   ((symbolp e) (or (cdr (assoc e names)) (error "no value of ~a" e)))
                   (t (ecase (caar e)
                        (mplus (reduce #'+ (mapcar #'value (cdr e))))
                        (mtimes (reduce #'* (mapcar #'value (cdr e))))
                        (mexpt (expt (value (cadr e)) (caddr e)))
                        (%derivative (* (expt (fuzz-solution-s solution) (cadddr e))
                                        (value (cadr e))))))))
           (source (e)
             (loop for (label . x) in (fuzz-solution-inputs solution)
                   when (alike1 e (fuzz-source (list label))) return x)))
    (labels ((put (e)
               (cond ((atom e) e)
                     ((source e))
                     ((eq (caar e) '%derivative)
                      (mul (fuzz-number (expt (fuzz-solution-s solution) (cadddr e)))
                           (fuzz-number (source (cadr e)))))
                     (t (cons (car e) (mapcar (lambda (x) (let ((y (put x)))
                                                            (if (rationalp y) (fuzz-number y) y)))
                                              (cdr e)))))))
      (let ((e (put e))) (value (if (rationalp e) (fuzz-number e) e))))))

;;; What we say

(defun fuzz-tried (function)
  "Two values: what it gives, and nil; or nil and the text of the error."
  (let* ((text nil)
         (found (let (($errormsg nil) ($error $error) (*core-checks* nil) (*core-left-out* nil)
                      (*core-warnings-now* nil))
                  (or (errcatch (funcall function))
                      (progn (setq text (core-words (cdr $error))) nil)))))
    (if found (values (car found) nil) (values nil text))))

(defun fuzz-get (record key) ($core_get record key))

(defun fuzz-with-magnetizing (names dependent solution)
  "NAMES with i_m = i - (rhs at i_m = 0) of i = i_m - sum w*i_j."
  (loop for (nil left right) in (cdr dependent)
        for new = (core-symbol (format nil "~a_m" (core-spelling left)))
        do (unless (freeof new right)
             (push (cons new
                         (- (cdr (assoc left names))
                            (fuzz-value (maxima-substitute 0 new right) solution names)))
                   names)))
  names)

(defun fuzz-pairs-of-quantities (record solution names)
  "((what found expected) ..)"
  (flet ((pairs (key expected)
           (loop for (nil name e) in (cdr (fuzz-get record key))
                 collect (list (list key name) (fuzz-value e solution names)
                               (funcall expected name))))
         (row (label) (assoc label (fuzz-circuit-rows (fuzz-solution-circuit solution)))))
    (append (pairs '$voltages (lambda (label) (fuzz-voltage solution (row label))))
            (pairs '$currents (lambda (label) (fuzz-current solution (row label))))
            (pairs '$potentials (lambda (node) (fuzz-of solution (list :v node)))))))

(defun fuzz-pairs-of-dependence (dependent solution names)
  (loop for (nil left right) in (cdr dependent)
        collect (list left (fuzz-value right solution names) (cdr (assoc left names)))))

(defun fuzz-pairs-of-rates (equations solution names)
  (loop for (nil left right) in (cdr equations)
        collect (list left (fuzz-value right solution names)
                      (* (fuzz-solution-s solution) (cdr (assoc (cadr left) names))))))

(defun fuzz-pairs-of-matrices (record states solution names)
  "A x + B U + B1 s U"
  (flet ((dot (matrix k vector)
           (if (cdr (fuzz-get record matrix))
               (reduce #'+ (mapcar (lambda (x y) (* (algebra-rational-number x) y))
                                   (cdr (nth (1+ k) (fuzz-get record matrix))) vector))
               0)))
    (let ((x (mapcar (lambda (name) (cdr (assoc name names))) states))
          (u (mapcar (lambda (e) (fuzz-value e solution names)) (cdr (fuzz-get record '$inputs))))
          (s (fuzz-solution-s solution)))
      (loop for name in states for k from 0
            collect (list (list 'matrices name)
                          (+ (dot '|$a| k x) (dot '|$b| k u) (* s (dot '|$b1| k u)))
                          (* s (cdr (assoc name names))))))))

(defun fuzz-differing (pairs)
  (loop for (what found expected) in pairs
        unless (eql found expected)
          return (fuzz-maxima-list (list (format nil "~a: ~a, not ~a" what found expected)))))

;;; One circuit

(defun fuzz-inputs (circuit)
  (loop for row in (fuzz-circuit-rows circuit)
        when (member (fuzz-row-type row) '(:e :i))
          collect (cons (fuzz-row-label row) (fuzz-row-value row))))

(defun fuzz-served-fault (solution tableau model)
  "nil, or what is wrong with what is said of a served circuit."
  (let* ((check (mfuncall '$circuits_check model))
         (dependent (fuzz-get check '$dependent))
         (names (fuzz-with-magnetizing (fuzz-states solution) dependent solution))
         (states (cdr ($circuits_tableau_states tableau))))
    (multiple-value-bind (rates untold) (fuzz-tried (lambda () ($circuits_tableau_rates tableau)))
      (let ((matrices (unless untold (fuzz-tried (lambda ()
                                                   ($circuits_tableau_matrices tableau))))))
        (or (unless (eql (length states) (fuzz-get check '$order))
              (list '(mlist simp) "order" (fuzz-get check '$order)))
            (unless (<= (length states) (fuzz-get check '$bound))
              (list '(mlist simp) "bound" (fuzz-get check '$bound)))
            (fuzz-differing
             (append (fuzz-pairs-of-dependence dependent solution names)
                     (fuzz-pairs-of-quantities
                      ($circuits_branch_quantities model tableau) solution names)
                     (when rates (fuzz-pairs-of-rates rates solution names))
                     (when matrices
                       (fuzz-pairs-of-matrices matrices states solution names)))))))))

(defparameter *fuzz-refusals*
  '("pieces" "joined to nothing" "loop of voltage sources" "cut of current sources"
    "windings form a loop" "lie in parts" "in a ratio"))

(defparameter *fuzz-singular* '("are not determined" "is not determined" "contradict each other"))

(defun fuzz-any-in-p (words text) (some (lambda (word) (search word text)) words))

(defvar *fuzz-served* 0)

(defun fuzz-circuit-read (description)
  (mfuncall '$circuits_closed_circuit (mfuncall '$circuits_read_open_circuit description)))

(defun fuzz-fault (circuit moving)
  "nil, or what is wrong with what is said of CIRCUIT."
  (let* ((description (fuzz-description circuit moving)) (degree (fuzz-degree circuit))
         (s (if moving (fuzz-any) 0)) (model nil))
    (multiple-value-bind (tableau text)
        (fuzz-tried (lambda ()
                      (setq model (fuzz-circuit-read description))
                      (mfuncall '$circuits_solved_tableau model)))
      (cond ((and text (fuzz-any-in-p *fuzz-refusals* text)) nil)
            ((and text (fuzz-any-in-p *fuzz-singular* text))
             (unless (= degree -1) (format nil "refused at degree ~d: ~a" degree text)))
            (text text)
            ((/= degree (length (cdr ($circuits_tableau_states tableau))))
             (format nil "degree ~d, but ~d states" degree
                     (length (cdr ($circuits_tableau_states tableau)))))
            (t (incf *fuzz-served*)
               (let ((solution (fuzz-solve circuit s (fuzz-inputs circuit))))
                 (and solution
                      (or (fuzz-served-fault solution tableau model)
                          (fuzz-response-fault circuit model s)
                          (fuzz-potential-fault tableau solution)))))))))

(defun fuzz-response-fault (circuit model s)
  "Transfer functions from the first source to some quantity, and an impedance."
  (let* ((sources (fuzz-inputs circuit)) (row (car (last (fuzz-circuit-rows circuit))))
         (nodes (fuzz-nodes circuit)) (label (fuzz-row-label row)))
    (fuzz-differing
     (append
      (when sources
        (let ((solution (fuzz-solve circuit s (list (cons (caar sources) 1)))))
          (loop for (form . expected) in
                (list (cons (list '($u simp) label) (fuzz-voltage solution row))
                      (cons (list '($i simp) label) (fuzz-current solution row))
                      (cons (list '($v simp) (car (last nodes)))
                            (fuzz-of solution (list :v (car (last nodes))))))
                collect (list form
                              (fuzz-at-s ($circuits_transfer_function model form (caar sources)) s)
                              expected))))
      (let* ((a (second row)) (b (third row))
             (probed (make-fuzz-circuit
                      :sign (fuzz-circuit-sign circuit)
                      :rows (append (fuzz-circuit-rows circuit) (list (list '$probe b a :i 1)))
                      :couplings (fuzz-circuit-couplings circuit)
                      :transformers (fuzz-circuit-transformers circuit)))
             (solution (fuzz-solve probed s '(($probe . 1)))))
        (list (list 'impedance (fuzz-at-s ($circuits_impedance model a b) s)
                    (- (fuzz-of solution (list :v a)) (fuzz-of solution (list :v b))))))))))

(defun fuzz-at-s (e s)
  (algebra-rational-number (maxima-substitute (fuzz-number s) '|$S| e)))

(defun fuzz-potential-fault (tableau solution)
  "Where there is a potential and all states are independent: its derivatives are the voltages of
inductors and minus the currents of capacitors."
  (multiple-value-bind (potential text)
      (fuzz-tried (lambda () ($circuits_symmetric_potential tableau)))
    (unless (or text (circuits-solution-dependents tableau)
                (fuzz-circuit-couplings (fuzz-solution-circuit solution)))
      (let ((names (fuzz-states solution)) (circuit (fuzz-solution-circuit solution)))
        (fuzz-differing
         (loop for row in (fuzz-circuit-rows circuit)
               when (member (fuzz-row-type row) '(:l :c))
                 collect (list (list 'potential (fuzz-row-label row))
                               (fuzz-value ($diff potential (fuzz-state-name row)) solution names)
                               (* (fuzz-circuit-sign circuit)
                                  (if (eq (fuzz-row-type row) :l)
                                      (fuzz-voltage solution row)
                                      (- (fuzz-current solution row)))))))))))

;;; One value is a letter: the order is lower, or nothing is determined, exactly where the factors
;;; that CheckCircuit names vanish

(defun fuzz-with-value (circuit label value)
  (let ((copy (copy-fuzz-circuit circuit)))
    (setf (fuzz-circuit-rows copy)
          (loop for row in (fuzz-circuit-rows circuit)
                collect (if (eq (fuzz-row-label row) label)
                            (append (subseq row 0 4) (list value) (fuzz-row-control row))
                            row)))
    copy))

(defun fuzz-drop-fault (circuit)
  (let ((row (find-if (lambda (row) (member (fuzz-row-type row) '(:ev :g :f :h :r)))
                      (fuzz-shuffled (fuzz-circuit-rows circuit)))))
    (when row
      (multiple-value-bind (tableau text)
          (fuzz-tried (lambda ()
                        (mfuncall '$circuits_solved_tableau
                                  (fuzz-circuit-read
                                   (fuzz-description
                                    (fuzz-with-value circuit (fuzz-row-label row) '$letter)
                                    t)))))
        (unless text
          (let ((order (length (cdr ($circuits_tableau_states tableau))))
                (factors (cdr ($circuits_order_drops tableau))))
            (loop for x in (append '(1 -1 2 -2 1/2 -1/2 3 -3) (fuzz-roots factors))
                  for lower = (< (fuzz-degree (fuzz-with-value circuit (fuzz-row-label row) x))
                                 order)
                  for named = (some (lambda (e)
                                      (eql 0 (maxima-substitute (fuzz-number x) '$letter e)))
                                    factors)
                  unless (or (zerop x) (eq (and lower t) (and named t)))
                    return (format nil "order ~d, ~a = ~a: lower ~a, named ~a by ~a" order
                                   (fuzz-row-label row) x lower named factors))))))))

(defun fuzz-roots (factors)
  "The roots of those that are linear."
  (loop for e in factors
        when (eql 1 ($hipow ($expand e) '$letter))
          collect (- (/ (algebra-rational-number (maxima-substitute 0 '$letter e))
                        (algebra-rational-number
                         (sub (maxima-substitute 1 '$letter e)
                              (maxima-substitute 0 '$letter e)))))))

;;; The same circuit told otherwise

(defun fuzz-shuffled (items)
  (let ((items (copy-list items)))
    (loop while items
          collect (let ((item (nth (fuzz-below (length items)) items)))
                    (setq items (remove item items :test #'eq :count 1))
                    item))))

(defun fuzz-told-otherwise (circuit)
  "Rows in another order, other names of nodes, some branches reversed: those that control nothing,
their sources and the mutual inductances with the other sign."
  (let ((reversed '()))
    (flet ((node (n) (if (integerp n) (- 100 (* 3 n)) n)))
      (let ((rows (loop for (label tail head type value . control)
                          in (fuzz-shuffled (fuzz-circuit-rows circuit))
                        for turn = (and (zerop (fuzz-below 3))
                                        (notany (lambda (row)
                                                  (member label (fuzz-row-control row)))
                                                (fuzz-circuit-rows circuit)))
                        do (when turn (push label reversed))
                        collect (list* label (node (if turn head tail)) (node (if turn tail head))
                                       type
                                       (if (and turn (member type '(:e :i :ev :g :f :h)))
                                           (- value)
                                           value)
                                       (mapcar #'node control)))))
        (make-fuzz-circuit
         :sign (fuzz-circuit-sign circuit) :rows rows
         :couplings (loop for (one other m) in (fuzz-circuit-couplings circuit)
                          collect (list other one
                                        (* m (if (member one reversed) -1 1)
                                           (if (member other reversed) -1 1))))
         :transformers (loop for (a b c d n) in (fuzz-circuit-transformers circuit)
                             collect (list (node a) (node b) (node c) (node d) n)))))))

(defun fuzz-circuit-fault (circuit)
  (or (fuzz-fault circuit t)
      (fuzz-fault circuit nil)
      (fuzz-drop-fault circuit)
      (let ((other (fuzz-told-otherwise circuit)))
        (cond ((/= (fuzz-degree circuit) (fuzz-degree other)) "the adversary itself is wrong")
              (t (let ((fault (fuzz-fault other t)))
                   (and fault (fuzz-maxima-list
                               (list "told otherwise" fault (fuzz-description other t))))))))))

(defun $fuzz_tableau (count seed)
  (setq *fuzz-state* seed *fuzz-served* 0)
  (let ((failures
          (loop for number from 1 to count
                for circuit = (fuzz-new-circuit)
                for fault = (fuzz-circuit-fault circuit)
                when fault collect (fuzz-maxima-list
                                    (list number fault (fuzz-description circuit t))))))
    (fuzz-maxima-list
     (if (and (>= count 50) (< *fuzz-served* count))
         (append failures (list (fuzz-maxima-list (list count "served" *fuzz-served*))))
         failures))))
