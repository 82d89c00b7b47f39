;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_programs.mac: random programs, and their values in every arithmetic. A value
;;; of a node is judged against bigfloats at the values of its parts, which are exact as they stand,
;;; so that no cancellation hides or feigns a fault.

(in-package :maxima)

(defvar *test-seed* 1)

(defun test-random (n)
  "A whole number below N, the same on every Lisp."
  (setq *test-seed* (mod (+ (* 1103515245 *test-seed*) 12345) (expt 2 31)))
  (mod (ash *test-seed* -12) n))

(defun test-random-of (list) (nth (test-random (length list)) list))

(defun test-list (&rest items) (cons '(mlist simp) items))

;;; Random programs in the time and n states x1, x2, ..

(defparameter *test-field* '(:add :subtract :multiply :negate :absolute :sign))
(defparameter *test-operations*
  (append *test-field*
          '(:add :subtract :multiply :divide :divide :root :power :polar-angle :sine :cosine :sine
            :cosine :exponential :logarithm :arcsine :arccosine :arctangent :hyperbolic-sine
            :hyperbolic-cosine :hyperbolic-tangent)))

(defun test-names (n)
  (loop for k from 1 to n collect (intern (format nil "$X~d" k) :maxima)))

(defun test-operation (operation x y)
  (case operation
    (:add (algebra-program-add x y))
    (:subtract (algebra-program-subtract x y))
    (:multiply (algebra-program-multiply x y))
    (:negate (algebra-program-negate x))
    (:divide (if (eql y 0) x (algebra-program-divide x y)))
    (:root (algebra-program-root x))
    (:sine (algebra-program-sine x))
    (:cosine (algebra-program-cosine x))
    (:power (algebra-program-general-power x (test-random-of (list y 2/3 -5/4 3))))
    (:polar-angle (algebra-program-polar-angle x y))
    (t (algebra-program-function operation x))))

(defun test-random-element (elements whole)
  (let ((k (test-random 8)))
    (cond ((< k 5) (nth (test-random (min 8 (length elements))) elements))
          ((< k 7) (test-random-of elements))
          (whole (- (test-random 9) 4))
          (t (test-random-of '(1/3 -7/5 2 1/8 3 -1))))))

(defun test-random-program (n size operations)
  "A program of N states and SIZE operations; its rates are among the last of these."
  (let* ((*algebra-program* (make-algebra-program)) (names (test-names n))
         (whole (eq operations *test-field*))
         (elements (cons (algebra-program-input '$t) (mapcar #'algebra-program-input names))))
    (unless whole (push (algebra-program-input '$%pi) elements))
    (loop repeat size
          do (let ((element (test-operation (test-random-of operations)
                                            (test-random-element elements whole)
                                            (test-random-element elements whole))))
               (when (algebra-node-p element) (push element elements))))
    (make-numerics-program :algebra *algebra-program* :names names
                           :rates (loop for k below n collect (nth (* 2 k) elements)))))

(defun test-random-numbers (n)
  "Dyadic numbers, of both signs, now and then 0 or 1."
  (coerce (loop repeat n
                collect (case (test-random 12)
                          (0 0d0) (1 1d0)
                          (t (/ (- (test-random 4001) 2000) 512d0))))
          'numerics-vector))

;;; Values.

(defun test-values (program elements state how)
  "The list of values at time 3/4."
  (let ((out (numerics-zeros (length elements))))
    (numerics-with-masked-traps
      (funcall (numerics-routine program elements :how how) (numerics-moment 0.75d0) state out))
    (coerce out 'list)))

(defun test-not-a-number-p (x) (/= x x))

(defun test-same-p (x y)
  (if (or (test-not-a-number-p x) (test-not-a-number-p y))
      (and (test-not-a-number-p x) (test-not-a-number-p y))
      (= x y)))

(defun test-same-values-p (xs ys) (every #'test-same-p xs ys))

(defun test-moving-nodes (elements)
  "Operations that depend on an input."
  (multiple-value-bind (fixed moving) (numerics-fixed-nodes (algebra-live-nodes elements))
    (declare (ignore fixed))
    (remove-if #'algebra-input-p moving)))

(defun test-finite-p (x) (numerics-finite-p x))

(defun test-node-fault (node value values)
  "Whether VALUE of NODE is wrong at the VALUES, a function, of its parts."
  (let ((parts (loop for part in (list (algebra-node-left node) (algebra-node-right node))
                     collect (if (algebra-node-p part) (funcall values part) part))))
    (if (some (lambda (x) (and (floatp x) (not (test-finite-p x)))) parts)
        nil
        (let ((found (core-attempt (lambda () (test-big-operation node parts)))))
          (if found
              (not (test-near-p value (first found)))
              (test-finite-p value))))))

(defun test-big-operation (node parts)
  "The rational value of the operation of NODE at PARTS."
  (with-algebra-program
    (let* ((names (list '$a '$b))
           (inputs (loop for part in parts
                         for name in names
                         collect (if (floatp part) (algebra-program-input name) part)))
           (element (algebra-new-node (algebra-node-operation node) (first inputs)
                                      (second inputs))))
      (numerics-bigfloat-rational
       (first (funcall (numerics-big-routine (list element) names 40)
                       (loop for part in parts collect (if (floatp part) (rational part) 0))))))))

(defun test-near-p (x exact)
  "Whether the double-float number X is EXACT, to 8 units of its last place."
  (cond ((> (abs exact) (* 99/100 (rational most-positive-double-float))) t)
        ((not (test-finite-p x)) nil)
        (t (<= (abs (- (rational x) exact))
               (max (* (abs exact) 8 (expt 2 -53)) (expt 10 -300))))))

;;; The adversary: faults of a random program, none where all is well.

(defun test-program-faults (size)
  (let* ((n (+ 1 (test-random 4)))
         (program (test-random-program n size *test-operations*))
         (rates (numerics-program-rates program)) (state (test-random-numbers n))
         (nodes (test-moving-nodes rates))
         (all (test-values program nodes state :compiled))
         (machine (test-values program nodes state :machine))
         (table (make-hash-table)))
    (loop for node in nodes
          for value in all do (setf (gethash (algebra-node-index node) table) value))
    (loop for node in (cons (with-numerics-program program (algebra-program-input '$t))
                            (numerics-program-states program))
          for value in (cons 0.75d0 (coerce state 'list))
          do (setf (gethash (algebra-node-index node) table) value))
    (flet ((value (element)
             (if (algebra-node-p element) (gethash (algebra-node-index element) table) element)))
      (let ((moving (remove-if-not #'value rates)))
        (append
         (unless (test-same-values-p all machine) '(machine))
         (unless (and (test-same-values-p (test-values program moving state :compiled)
                                          (mapcar #'value moving))
                      (test-same-values-p (test-values program moving state :machine)
                                          (mapcar #'value moving)))
           '(outputs))
         (loop for node in nodes
               for x in all
               when (test-node-fault node x
                                     (lambda (part)
                                       (or (value part) (test-constant-double part))))
                 collect (algebra-node-operation node)))))))

(defun test-constant-double (node)
  (numerics-constant-double (first (numerics-values-of-constants (list node)))))

(defun $test_program_faults (seed count size)
  "How many of COUNT random programs are faulty, and the first faults."
  (let ((*test-seed* seed) (faulty 0) (first '()))
    (loop repeat count
          do (let ((faults (numerics-with-masked-traps (test-program-faults size))))
               (when faults
                 (incf faulty)
                 (unless first (setq first faults)))))
    (apply #'test-list faulty (mapcar (lambda (x) (intern (format nil "$~a" x) :maxima)) first))))

(defmspec $test_planted (form)
  ;; test_planted(e): the value of e while differences are computed as sums.
  (let ((text (symbol-function 'numerics-operation-text)))
    (setf (symbol-function 'numerics-operation-text)
          (lambda (code node written)
            (let ((form (funcall text code node written)))
              (if (eq (first form) '-) (cons '+ (cdr form)) form))))
    (unwind-protect (meval (second form))
      (setf (symbol-function 'numerics-operation-text) text))))

;;; Where doubles are exact all four arithmetics agree to the last bit.

(defun test-exact-faults (size)
  (let* ((n (+ 1 (test-random 3))) (program (test-random-program n size *test-field*))
         (rates (numerics-program-rates program))
         (state (coerce (loop repeat n collect (float (- (test-random 9) 4) 1d0)) 'numerics-vector))
         (names (cons '$t (numerics-program-names program)))
         (point (cons 3/4 (map 'list #'rational state)))
         (exact (test-exact-values rates names point)))
    (unless (some (lambda (x) (> (integer-length (numerator x)) 50)) exact)
      (append
       (unless (equal exact (mapcar #'rational (test-values program rates state :compiled)))
         '(compiled))
       (unless (equal exact (mapcar #'rational (test-values program rates state :machine)))
         '(machine))
       (unless (equal exact (mapcar #'numerics-bigfloat-rational
                                    (funcall (numerics-big-routine rates names 60) point)))
         '(bigfloat))))))

(defun test-exact-values (elements names point)
  (let ((signed (find-if (lambda (node) (member (algebra-node-operation node) '(:absolute :sign)))
                         (algebra-live-nodes elements))))
    (if signed
        (mapcar #'numerics-bigfloat-rational
                (funcall (numerics-big-routine elements names 80) point))
        (algebra-program-values elements (mapcar #'cons names point) t))))

(defun $test_exact_faults (seed count size)
  (let ((*test-seed* seed))
    (apply #'test-list (loop repeat count append (test-exact-faults size)))))

;;; Jacobian.

(defun test-problem (record names &rest options)
  (apply #'numerics-problem-of-program record (cdr names) options))

(defun test-full-jacobian (problem state)
  "The entries as a hash table (i j) -> value."
  (let* ((pattern (numerics-problem-pattern problem)) (table (make-hash-table :test #'equal))
         (values (numerics-zeros (length (numerics-pattern-rows pattern)))))
    (numerics-with-masked-traps
      (funcall (numerics-problem-jacobian problem) (numerics-moment 0.75d0) state values))
    (dotimes (j (numerics-pattern-size pattern) table)
      (loop for k from (aref (numerics-pattern-starts pattern) j)
              below (aref (numerics-pattern-starts pattern) (1+ j))
            do (setf (gethash (list (aref (numerics-pattern-rows pattern) k) j) table)
                     (aref values k))))))

(defun test-differences (program state i j)
  "dX_i/dx_j by a difference in bigfloats."
  (let* ((step (expt 10 -30)) (names (cons '$t (numerics-program-names program)))
         (rate (nth i (numerics-program-rates program))))
    (if (not (algebra-node-p rate))
        0
        (let ((routine (numerics-big-routine (list rate) names 100)))
          (flet ((value (h)
                   (numerics-bigfloat-rational
                    (first (funcall routine
                                    (cons 3/4 (loop for x across state
                                                    for k from 0
                                                    collect (+ (rational x) (if (= k j) h 0)))))))))
            (/ (- (value step) (value (- step))) (* 2 step)))))))

(defun test-jacobian-faults (problem state)
  "The places (i j) where the Jacobian is not that of differences."
  (let* ((program (numerics-problem-program problem)) (n (numerics-problem-size problem))
         (table (test-full-jacobian problem state)))
    (loop for i below n
          append (loop for j below n
                       unless (let ((exact (core-attempt (lambda ()
                                                           (test-differences program state i j))))
                                    (value (gethash (list i j) table 0d0)))
                                (or (null exact) (not (test-finite-p value))
                                    (< (abs (- (rational value) (first exact)))
                                       (* (rational 1d-9) (+ 1 (abs (first exact)))))))
                         collect (list i j)))))

(defun $test_jacobian_faults (record names state growth)
  "Pairs [i, j]; GROWTH: how many times the nodes an exact Jacobian may have, 0 for directions."
  (let ((*numerics-jacobian-growth* growth)
        (state (coerce (mapcar (lambda (x) (coerce x 'double-float)) (cdr state))
                       'numerics-vector)))
    (apply #'test-list
           (loop for how in '(:compiled :machine)
                 append (loop for (i j) in (test-jacobian-faults
                                            (test-problem record names :how how) state)
                              collect (test-list (1+ i) (1+ j)))))))

(defun $test_random_jacobians (seed count growth)
  "Faults of COUNT random programs of smooth operations."
  (let ((*test-seed* seed) (*numerics-jacobian-growth* growth)
        (operations '(:add :subtract :multiply :multiply :sine :cosine :arctangent :negate
                      :hyperbolic-tangent)))
    (apply #'test-list
           (loop for k below count
                 append (let* ((n (+ 2 (test-random 5)))
                               (program (test-random-program n 25 operations))
                               (problem (numerics-problem-of program :how :machine)))
                          (and (test-jacobian-faults
                                problem (coerce (loop repeat n collect (/ (test-random 64) 64d0))
                                                'numerics-vector))
                               (list k)))))))

(defun $test_kept_entries (record names growth)
  "[i, j, value] of the entries that are constant and not computed."
  (let* ((*numerics-jacobian-growth* growth) (problem (test-problem record names))
         (program (numerics-problem-program problem)))
    (let ((constants (numerics-constant-slopes program)))
      (apply #'test-list
             (sort (loop for (i j) being the hash-keys of constants using (hash-value value)
                         collect (test-list (1+ i) (1+ j) (algebra-maxima-rational value)))
                   (lambda (a b) (great b a)))))))

;;; Colours.

(defun test-colouring-faults (n columns)
  "Whether two columns of one colour share a row, or a column has a colour without need."
  (multiple-value-bind (colours count) (numerics-colours n columns)
    (or (loop for j below n
              thereis (loop for k below j
                            thereis (and (aref colours j) (eql (aref colours j) (aref colours k))
                                         (intersection (aref columns j) (aref columns k)))))
        (loop for j below n thereis (not (eq (null (aref columns j)) (null (aref colours j)))))
        (loop for j below n thereis (and (aref colours j) (>= (aref colours j) count))))))

(defun $test_colours (seed count)
  "Faults of random patterns; then the colours of a band of 3, an arrow, a full one, a diagonal."
  (let ((*test-seed* seed))
    (flet ((columns (n function)
             (let ((columns (make-array n)))
               (dotimes (j n columns)
                 (setf (aref columns j)
                       (loop for i below n when (funcall function i j) collect i)))))
           (number (n columns) (nth-value 1 (numerics-colours n columns))))
      (test-list
       (loop repeat count
             count (let ((n (+ 2 (test-random 12))) (density (1+ (test-random 6))))
                     (test-colouring-faults
                      n (columns n (lambda (i j) (declare (ignore i j))
                                     (zerop (test-random density)))))))
       (number 20 (columns 20 (lambda (i j) (<= (abs (- i j)) 1))))
       (number 20 (columns 20 (lambda (i j) (or (= i j) (= i 0) (= j 0)))))
       (number 20 (columns 20 (lambda (i j) (>= i j -1))))
       (number 20 (columns 20 #'=))))))

;;; What a problem has.

(defun test-floats (vector) (apply #'test-list (coerce vector 'list)))

(defun $test_rates (record names state how)
  "Rates and time-slope."
  (let* ((problem (test-problem record names
                                :how (intern (string-upcase (core-spelling how)) :keyword)))
         (n (numerics-problem-size problem))
         (state (coerce (mapcar (lambda (x) (coerce x 'double-float)) (cdr state))
                        'numerics-vector)))
    (apply #'test-list
           (loop for function in (list (numerics-problem-rates problem)
                                       (numerics-problem-time-slope problem))
                 collect (let ((out (numerics-zeros n)))
                           (numerics-with-masked-traps
                             (funcall function (numerics-moment 0.75d0) state out))
                           (test-floats out))))))

(defun $test_marks (record names state how)
  "Of each rate: finite, inf, minf or nan."
  (let ((rates (cdr (second ($test_rates record names state how)))))
    (numerics-with-masked-traps
      (apply #'test-list
             (loop for x in rates
                   collect (cond ((test-finite-p x) '$finite)
                                 ((test-not-a-number-p x) '$nan)
                                 ((> x 0) '$inf)
                                 (t '$minf)))))))

(defun $test_shape (record names)
  "[size, split, mass by columns or false, starts of the pattern, its rows], counted from 0."
  (let* ((problem (test-problem record names)) (mass (numerics-problem-mass problem)))
    (test-list (numerics-problem-size problem) (numerics-problem-split problem)
               (and mass (test-list (test-floats (numerics-pattern-starts
                                                  (numerics-matrix-pattern mass)))
                                    (test-floats (numerics-pattern-rows
                                                  (numerics-matrix-pattern mass)))
                                    (test-floats (numerics-matrix-values mass))))
               (test-floats (numerics-pattern-starts (numerics-problem-pattern problem)))
               (test-floats (numerics-pattern-rows (numerics-problem-pattern problem))))))

(defmspec $test_product (form)
  ;; test_product(e): the value of e while no rows of a product become code.
  (let ((*numerics-most-row-terms* 0)) (meval (second form))))

(defun $test_rows (record names)
  "How many rates are rows of a product, and how many operations stay."
  (let* ((program (numerics-read-program record (cdr names)))
         (plan (numerics-new-plan program (loop for e in (numerics-program-rates program)
                                                for k from 0 collect (cons k e))
                                  (length (cdr names)))))
    (test-list (length (numerics-plan-rows plan)) (numerics-plan-count plan))))

(defun test-allocated ()
  #+sbcl (sb-ext:get-bytes-consed)
  #-sbcl 0)

(defun test-calls (function time state out)
  (numerics-with-masked-traps
    (loop repeat 1000 do (funcall (the function function) time state out))))

(defun $test_allocation (record names state)
  "Bytes that 1000 calls of rates and Jacobian take, compiled and on the machine, at the least of
three times: what another thread takes is not theirs."
  (let ((state (coerce (mapcar (lambda (x) (coerce x 'double-float)) (cdr state))
                       'numerics-vector))
        (time (numerics-moment 0.75d0)))
    (apply #'test-list
           (loop for how in '(:compiled :machine :auto)
                 append (let* ((problem (test-problem record names :how how))
                               (pattern (numerics-problem-pattern problem)))
                          (loop for (function . n) in
                                (list (cons (numerics-problem-rates problem)
                                            (numerics-problem-size problem))
                                      (cons (numerics-problem-jacobian problem)
                                            (length (numerics-pattern-rows pattern))))
                                collect (let ((out (numerics-zeros n)))
                                          (test-calls function time state out)
                                          (loop repeat 3
                                                minimize (let ((before (test-allocated)))
                                                           (test-calls function time state out)
                                                           (- (test-allocated) before))))))))))

(defun $test_later (record names state)
  "Whether values stay the same, bit for bit, when the machine gives way to compiled code."
  (let* ((*numerics-calls-worth-compiling* 5)
         (problem (test-problem record names))
         (state (coerce (mapcar (lambda (x) (coerce x 'double-float)) (cdr state))
                        'numerics-vector))
         (n (numerics-problem-size problem))
         (values (loop repeat 12
                       collect (let ((out (numerics-zeros n)) (time (numerics-moment 0.75d0)))
                                 (numerics-with-masked-traps
                                   (funcall (numerics-problem-rates problem) time state out))
                                 out))))
    (every (lambda (out) (test-same-values-p out (first values))) values)))

(defun $test_wrong_length (record names n)
  (let ((problem (test-problem record names)))
    (funcall (numerics-problem-rates problem) (numerics-moment 0d0) (numerics-zeros n)
             (numerics-zeros n))))

(defun $test_double (x)
  "The double-float number for the rational number X."
  (numerics-constant-double (algebra-rational-number x)))

(defun $test_bigfloats (record names point digits)
  (let ((program (numerics-read-program record (cdr names))))
    (cons '(mlist simp)
          (funcall (numerics-big-routine (numerics-program-rates program) (cons '$t (cdr names))
                                         digits)
                   (mapcar (lambda (x) (or (algebra-rational-number x) x)) (cdr point))))))

(defun $test_compiles () #+sbcl t #-sbcl nil)

;;; Long programs that repeat themselves.

(defun $test_repetition (record)
  "[whether shared code gives what the machine does, to the bit, the quotient of different parts and
of all]"
  (let* ((*numerics-long-program* 100) (states (cdr (algebra-record-part record '$states)))
         (program (numerics-read-program record states)) (elements (numerics-program-rates program))
         (state (test-random-numbers (length states)))
         (plan (numerics-new-plan program (loop for e in elements
                                                for k from 0 collect (cons k e))
                                  (length elements)))
         (texts (multiple-value-bind (code parts)
                    (multiple-value-call #'numerics-new-code (numerics-rows-apart plan))
                  (loop for part in parts
                        collect (numerics-form-text
                                 (numerics-shared-form (numerics-part-statements code part)))))))
    (test-list (equalp (test-values program elements state :compiled)
                       (test-values program elements state :machine))
               (/ (length (remove-duplicates texts :test #'string=)) (length texts) 1d0))))
