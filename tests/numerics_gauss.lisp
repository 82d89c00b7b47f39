;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_gauss.mac: problems written by hand, runs of Gauss' method, its coefficients.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/native" "numerics/gauss"))

(defun gauss-list (numbers) (cons '(mlist simp) (coerce numbers 'list)))

(defun gauss-vector (list)
  (map 'numerics-vector (lambda (x) (coerce ($float x) 'double-float)) (cdr list)))

;;; Problems: name -> (split rates).

(defvar *gauss-problems* (make-hash-table))

(defmacro define-gauss-problem (name split (&rest states) &rest slopes)
  "The rates SLOPES of STATES, which may use the time as time."
  `(setf (gethash ',name *gauss-problems*)
         (list ,split
               (compile nil
                        '(lambda (moment x out)
                          (declare (type (simple-array double-float (*)) moment x out)
                           (ignorable moment)
                           #+sbcl (sb-ext:muffle-conditions sb-ext:compiler-note))
                          (let ((time (aref moment 0))
                                ,@(loop for state in states for i from 0
                                        collect `(,state (aref x ,i))))
                            (declare (ignorable time ,@states))
                            (setf ,@(loop for slope in slopes for i from 0
                                          append `((aref out ,i) ,slope)))
                            nil))))))

(declaim (inline gauss-cube))
(defun gauss-cube (x y)
  (declare (double-float x y))
  (let ((square (+ (* x x) (* y y)))) (* square (sqrt (the (double-float 0d0) square)))))

(define-gauss-problem $growth nil (x) (* x (cos time)))
(define-gauss-problem $blow_up nil (x) (+ 1d0 (* x x)))
(define-gauss-problem $harmonic 1 (x v) v (- x))
(define-gauss-problem $driven 1 (x v) v (- (sin (* 3d0 time)) (* 4d0 x)))
(define-gauss-problem $still 1 (x v) v 0d0)
(define-gauss-problem $stiff 1 (x v) v (* -1d12 x))
(define-gauss-problem $kepler 2 (x y u v)
  u v (- (/ x (gauss-cube x y))) (- (/ y (gauss-cube x y))))

(defmacro define-gauss-pendulum (name split)
  "Two equal masses and lengths, g = 9.81."
  `(define-gauss-problem ,name ,split (a b p q)
     p q
     (let* ((s (sin (- a b))) (c (cos (- a b))))
       (/ (- (- (* s q q)) (* 19.62d0 (sin a)) (* c (- (* s p p) (* 9.81d0 (sin b)))))
          (- 2d0 (* c c))))
     (let* ((s (sin (- a b))) (c (cos (- a b))))
       (/ (- (* 2d0 (- (* s p p) (* 9.81d0 (sin b)))) (* c (- (- (* s q q)) (* 19.62d0 (sin a)))))
          (- 2d0 (* c c))))))

(define-gauss-pendulum $pendulum 2)
(define-gauss-pendulum $pendulum_whole nil)

(defun gauss-problem (name size)
  (destructuring-bind (split rates) (gethash name *gauss-problems*)
    (make-numerics-problem :size size :split split :rates rates)))

;;; Runs.

(defun gauss-run (name span start order step observer &key (tolerance 1d-13) most-steps)
  "The outcome and the counts; STEP false is one that the tolerance chooses."
  (let* ((state (gauss-vector start)) (counts (make-numerics-counts))
         (end (coerce ($float (third span)) 'double-float))
         (controls (make-numerics-controls :end end :relative tolerance :counts counts
                                           :most-steps most-steps
                                           :first-step (and step (coerce ($float step)
                                                                         'double-float))))
         (moment (numerics-moment (coerce ($float (second span)) 'double-float))))
    (values (numerics-with-masked-traps
              (numerics-gauss (gauss-problem name (length state)) controls moment state observer
                              :order order))
            counts)))

(defun gauss-answer (outcome counts &rest more)
  "[status, time, states, steps, rates, ..]"
  (list* '(mlist simp)
         (intern (substitute #\_ #\- (format nil "$~a" (numerics-outcome-status outcome))) :maxima)
         (aref (numerics-outcome-moment outcome) 0)
         (gauss-list (numerics-outcome-state outcome))
         (numerics-counts-steps counts) (numerics-counts-rates counts) more))

(defun $test_gauss (name span start order step &optional (tolerance 1d-13) most)
  (multiple-value-call #'gauss-answer
    (gauss-run name span start order step nil :tolerance tolerance :most-steps most)))

(defun gauss-pendulum-energy (x)
  "The energy of the double pendulum, and T + |U|."
  (let ((kinetic (+ (* (aref x 2) (aref x 2)) (* 1/2 (aref x 3) (aref x 3))
                    (* (aref x 2) (aref x 3) (cos (- (aref x 0) (aref x 1))))))
        (potential (* -9.81d0 (+ (* 2 (cos (aref x 0))) (cos (aref x 1))))))
    (values (+ kinetic potential) (+ kinetic (abs potential)))))

(defun $test_gauss_drift (span start order step &optional (tolerance 1d-13))
  "[status, steps, max |E - E0|/max(|E0|, T + |U|)] of the double pendulum."
  (let* ((first (gauss-pendulum-energy (gauss-vector start))) (drift 0d0) (largest (abs first)))
    (multiple-value-bind (outcome counts)
        (gauss-run '$pendulum span start order step
                   (lambda (seen)
                     (multiple-value-bind (energy magnitude)
                         (gauss-pendulum-energy (numerics-step-after seen))
                       (setq drift (max drift (abs (- energy first)))
                             largest (max largest magnitude))
                       nil))
                   :tolerance tolerance)
      (gauss-list (list (second (gauss-answer outcome counts)) (numerics-counts-steps counts)
                        (/ drift largest))))))

(defun $test_gauss_between (name span start order step exact)
  "The largest distances to the list that EXACT gives at a time: at 0.1, .., 0.9 of each step, and
at its end."
  (let ((distances (list 0d0 0d0)) (out (numerics-zeros (length (cdr start)))))
    (gauss-run name span start order step
               (lambda (seen)
                 (loop with from = (aref (numerics-step-from seen) 0)
                       with to = (aref (numerics-step-to seen) 0)
                       for k from 1 to 10
                       for share = (/ k 10d0)
                       do (funcall (numerics-step-interpolate seen) share out)
                          (loop for x across (if (= k 10) (numerics-step-after seen) out)
                                for y in (cdr (mfuncall exact (+ from (* share (- to from)))))
                                do (setf #1=(nth (floor k 10) distances) (max #1# (abs (- x y))))))
                 nil))
    (gauss-list distances)))

(defun $test_gauss_stopped (name span start order step number answer)
  "As test_gauss, where the observer doubles the state after the step NUMBER and says ANSWER."
  (let ((seen-steps 0))
    (multiple-value-call #'gauss-answer
      (gauss-run name span start order step
                 (lambda (seen)
                   (when (= (incf seen-steps) number)
                     (let ((after (numerics-step-after seen)))
                       (map-into after (lambda (x) (* 2 x)) after))
                     (if (eq answer '$stop) :stop :changed)))))))

#+sbcl
(defun $test_gauss_bytes (name start order step steps)
  "The memory that STEPS steps take."
  (flet ((bytes (count)
           (let ((before (sb-ext:get-bytes-consed)))
             (gauss-run name (gauss-list (list 0 (* count step))) start order step (constantly nil))
             (- (sb-ext:get-bytes-consed) before))))
    (bytes steps)
    (- (bytes (* 3 steps)) (bytes steps))))

;;; Coefficients.

(defun $test_gauss_hermite (share k last)
  "[H_k, G_k], the exact factors of Hermite's polynomial on 0, 1/LAST, .., 1 at the rational SHARE."
  (let* ((share (/ (second share) (third share))) (node (/ k last))
         (others (loop for m to last unless (= m k) collect (/ m last)))
         (lagrange (reduce #'* (mapcar (lambda (x) (/ (- share x) (- node x))) others)))
         (slope (reduce #'+ (mapcar (lambda (x) (/ (- node x))) others)))
         (g (* (- share node) lagrange lagrange)))
    (gauss-list (mapcar #'gauss-rational (list (- (* lagrange lagrange) (* 2 slope g)) g)))))

(defun $test_gauss_polynomial (last share degree)
  "What the factors of a run miss at SHARE of x^DEGREE."
  (flet ((power (x n) (if (< n 0) 0d0 (expt x n))))
    (- (loop for k to last
             for x = (/ (float k 1d0) last)
             sum (multiple-value-bind (h g) (numerics-hermite-factors share k last)
                   (+ (* h (power x degree)) (* g degree (power x (1- degree))))))
       (power share degree))))

(defun $test_gauss_foresight (stages)
  "The largest errors of foresight from two steps, made rational again: of t^k, k up to 2s - 3, and of
the pattern that the errors of stages make, constant and linear in time."
  (let* ((nodes (numerics-gauss-nodes stages 160)) (weights (numerics-gauss-weights nodes))
         (errors (numerics-stage-errors nodes)) (rows (numerics-gauss-memory-of-two nodes weights)))
    (flet ((worst (old last next)
             (loop for row in rows
                   for weight in weights
                   for exact in next
                   maximize (abs (- (* weight exact)
                                    (reduce #'+ (mapcar #'* row (append weights weights)
                                                        (append old last)))))))
           (power (k begin) (mapcar (lambda (c) (expt (+ c begin) k)) nodes))
           (times (factor) (mapcar (lambda (e) (* factor e)) errors)))
      (gauss-list
       (mapcar #'gauss-rational
               (list (loop for k from 0 to (- (* 2 stages) 3)
                           maximize (worst (power k -1) (power k 0) (power k 1)))
                     (worst errors errors errors) (worst (times -1) (times 0) errors)))))))

(defun gauss-rational (x) (if (integerp x) x (list '(rat simp) (numerator x) (denominator x))))

(defun $test_gauss_tableau (stages bits)
  "[c, b, A], rational numbers."
  (let ((nodes (numerics-gauss-nodes stages bits)))
    (flet ((numbers (list) (gauss-list (mapcar #'gauss-rational list))))
      (gauss-list (list (numbers nodes) (numbers (numerics-gauss-weights nodes))
                        (cons '($matrix simp)
                              (mapcar #'numbers (numerics-collocation-integrals nodes nodes))))))))

(defun $test_gauss_table (stages)
  "[c, b, quotients], the numbers that a step takes, exactly."
  (let ((table (numerics-gauss-table stages)))
    (gauss-list (loop for vector in (list (numerics-gauss-table-nodes table)
                                          (numerics-gauss-table-weights table)
                                          (numerics-gauss-table-quotients table))
                      collect (gauss-list (map 'list (lambda (x) (gauss-rational (rational x)))
                                               vector))))))
