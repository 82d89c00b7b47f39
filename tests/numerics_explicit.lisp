;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_dop853.mac and rtest_numerics_events.mac: problems written by hand, runs of
;;; them, and the order conditions of a tableau in exact arithmetic.

(in-package :maxima)

(defun numbers-vector (list)
  (map 'numerics-vector (lambda (x) (coerce (if (consp x) ($float x) x) 'double-float))
       (if (and (consp list) (consp (car list))) (cdr list) list)))

(defun numbers-list (numbers) (cons '(mlist simp) (coerce numbers 'list)))

;;; Problems: name -> (moment x out)

(defvar *numbers-problems* (make-hash-table))

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun numbers-stands-in-p (name form)
    (if (consp form)
        (or (numbers-stands-in-p name (car form)) (numbers-stands-in-p name (cdr form)))
        (eq form name))))

(defmacro define-numbers-problem (name (&rest states) &rest slopes)
  "The rates SLOPES of STATES, which may use the time as time; or other functions of them."
  `(setf (get ',name 'timed) ,(numbers-stands-in-p 'time slopes)
         (gethash ',name *numbers-problems*)
         (lambda (moment x out)
           (declare (type numerics-vector moment x out) (ignorable moment))
           (let ((time (aref moment 0))
                 ,@(loop for state in states for i from 0 collect `(,state (aref x ,i))))
             (declare (ignorable time ,@states))
             (setf ,@(loop for slope in slopes for i from 0 append `((aref out ,i) ,slope)))
             out))))

(defun numbers-quotient (x y)
  (declare (double-float x y))
  (if (= y 0d0) (numerics-infinity) (/ x y)))

(define-numbers-problem $harmonic (x v) v (- x))
(define-numbers-problem $growth (x) x)
(define-numbers-problem $blow_up (x) (+ 1d0 (* x x)))
(define-numbers-problem $power (x) (expt time 20))
(define-numbers-problem $pulse (x) (exp (* -25d0 (- time 5d0) (- time 5d0))))
(define-numbers-problem $pendulum (q v) v (- (* 9.81d0 (sin q))))
(define-numbers-problem $fast (x v) v (* -1d12 x))
(define-numbers-problem $fast_clock (x v) (* 1d9 v) (* -1d9 x))
(define-numbers-problem $root (x) (numbers-root (- 1d0 (* x x))))
(define-numbers-problem $pole (x) (numbers-quotient 1d0 (- time 1d0)))
(define-numbers-problem $reciprocal (x) (numbers-quotient -1d0 x))
(define-numbers-problem $van_der_pol (x v) v (- (* 1d3 (- 1d0 (* x x)) v) x))
(define-numbers-problem $prothero (x) (- (cos time) (* 1d4 (- x (sin time)))))
(define-numbers-problem $fall (x v) v -10d0)

(define-numbers-problem $double_pendulum (a b p q)
  p q
  (numbers-double-pendulum a b p q 0)
  (numbers-double-pendulum a b p q 1))

(defun numbers-root (x) (if (< x 0d0) (numerics-not-a-number) (sqrt x)))

(defun numbers-double-pendulum (a b p q which)
  "Two equal masses and lengths, g = 9.81."
  (declare (double-float a b p q))
  (let* ((s (sin (- a b))) (c (cos (- a b))) (g 9.81d0) (d (- 2d0 (* c c)))
         (first (- (- (* s q q)) (* 2d0 g (sin a)))) (second (- (* s p p) (* g (sin b)))))
    (if (= which 0) (/ (- first (* c second)) d) (/ (- (* 2d0 second) (* c first)) d))))

(define-numbers-problem $kepler (x y u v)
  u v
  (- (/ x (expt (sqrt (+ (* x x) (* y y))) 3)))
  (- (/ y (expt (sqrt (+ (* x x) (* y y))) 3))))

(define-numbers-problem $arenstorf (x y u v)
  u v
  (numbers-arenstorf x y (+ x (* 2 v)) (+ x 0.012277471d0) (- x 0.987722529d0))
  (numbers-arenstorf x y (- y (* 2 u)) y y))

(defun numbers-arenstorf (x y rest first second)
  (flet ((cube (z) (expt (sqrt (+ (* z z) (* y y))) 3)))
    (- rest (* 0.987722529d0 (/ first (cube (+ x 0.012277471d0))))
       (* 0.012277471d0 (/ second (cube (- x 0.987722529d0)))))))

;;; Runs

(defun numbers-option (options name &optional default)
  (let ((found (find name options :key #'cadr)))
    (if found (caddr found) default)))

(defun numbers-controls (end tolerance options)
  (flet ((option (name) (let ((value (numbers-option options name)))
                          (and value (coerce ($float value) 'double-float)))))
    (let ((scales (numbers-option options '$scales)))
      (make-numerics-controls
       :end end :relative tolerance :scales (if scales (numbers-vector scales) (numerics-zeros 0))
       :first-step (option '$first_step) :largest-step (option '$largest_step)
       :most-steps (numbers-option options '$most_steps)
       :looks-for (and (numbers-option options '$stiffness) :stiffness)))))

(defun numbers-problem (name)
  (let ((rates (gethash name *numbers-problems*)))
    (lambda (n) (make-numerics-problem :size n :rates rates :timed (get name 'timed)))))

(defun numbers-result (outcome counts &rest more)
  (flet ((field (name value) (list '(mequal simp) name value)))
    (list* '(mlist simp)
           (field '$status (string-downcase (symbol-name (numerics-outcome-status outcome))))
           (field '$time (aref (numerics-outcome-moment outcome) 0))
           (field '$low (aref (numerics-outcome-moment outcome) 1))
           (field '$state (numbers-list (numerics-outcome-state outcome)))
           (field '$next (numerics-outcome-step outcome))
           (field '$rates (numerics-counts-rates counts))
           (field '$steps (numerics-counts-steps counts))
           (field '$rejected (numerics-counts-rejected counts))
           (field '$not_finite (numerics-counts-not-finite counts))
           (loop for (name value) on more by #'cddr collect (field name value)))))

(defun numbers-run (name start span tolerance options parts)
  "The outcome, its counts, the start and the controls; PARTS is called with moment, state, controls
and gives the parts of the observer."
  (let* ((state (numbers-vector start)) (span (numbers-vector span))
         (moment (numerics-moment (aref span 0)))
         (controls (numbers-controls (aref span 1) (coerce tolerance 'double-float) options))
         (problem (funcall (numbers-problem name) (length state)))
         (observer (numerics-observer (funcall parts moment state controls))))
    (values (numerics-with-masked-traps
              (numerics-dopri problem controls moment state observer))
            (numerics-controls-counts controls))))

(defun $numbers_run (name start span tolerance &rest options)
  "The run as a list of equations; with times = [..] or times = all its rows."
  (let ((times (numbers-option options '$times)) (rows nil))
    (multiple-value-bind (outcome counts)
        (numbers-run name start span tolerance options
                     (lambda (moment state controls)
                       (declare (ignore controls))
                       (when times
                         (setq rows (numerics-new-rows (and (consp times) (numbers-vector times))
                                                       moment state nil))
                         (list (lambda (step) (numerics-see-rows rows step))))))
      (when rows (numerics-finish-rows rows outcome))
      (numbers-result outcome counts '$rows (and rows (numbers-rows rows))))))

(defun numbers-rows (rows)
  (let ((width (numerics-rows-width rows)) (numbers (numerics-rows-numbers rows)))
    (cons '(mlist simp)
          (loop for k below (numerics-rows-count rows)
                collect (numbers-list (subseq numbers (* k width) (* (1+ k) width)))))))

(defun $numbers_local_errors (name start span tolerance flow)
  "For each step the error over the tolerance by FLOW, a Maxima function (state, step) -> [state]."
  (let ((errors '()))
    (flet ((see (step)
             (let* ((before (numerics-step-before step)) (after (numerics-step-after step))
                    (length (- (aref (numerics-step-to step) 0) (aref (numerics-step-from step) 0)))
                    (exact (numbers-vector (mfuncall flow (numbers-list before) length))))
               (push (/ (loop for a across after for e across exact for b across before
                              maximize (/ (abs (- a e)) (+ 1 (max (abs a) (abs b)))))
                        tolerance)
                     errors)
               nil)))
      (numbers-run name start span tolerance '()
                   (lambda (&rest ignored) (declare (ignore ignored)) (list #'see))))
    (cons '(mlist simp) (reverse errors))))

(defun $numbers_bytes (name start span tolerance)
  "Bytes that a run takes from the heap, for each of its steps, where the Lisp counts them."
  #-sbcl (progn name start span tolerance 0)
  #+sbcl (let ((began (sb-ext:get-bytes-consed)))
           (multiple-value-bind (outcome counts)
               (numbers-run name start span tolerance '()
                            (lambda (&rest ignored) (declare (ignore ignored)) '()))
             (declare (ignore outcome))
             (float (/ (- (sb-ext:get-bytes-consed) began) (numerics-counts-steps counts))))))

;;; Events: functions of a state, by name

(define-numbers-problem $crossings (x v)
  x (- x 0.99999d0) (- time 5d0) (* x x) (- x 2d0))
(define-numbers-problem $height (x) x)
(define-numbers-problem $heights (x v) x (- x 0.5d0) v)
(define-numbers-problem $clock (x v) (- time 0.125d0) (- time 0.25d0))
(define-numbers-problem $wave (x v) (+ 0.999999d0 (sin (* 40d0 time))))
(define-numbers-problem $still (x v) (* 0d0 x))
(define-numbers-problem $poles (x v) ; tan t; sqrt(x) - 1/2, for x >= 0 only; a switch at t = 3
  (numbers-quotient (sin time) (cos time)) (- (numbers-root x) 0.5d0) (if (< time 3d0) -1d0 1d0))

(defun numbers-event (event)
  (list '(mlist simp) (1+ (numerics-event-place event)) (numerics-event-direction event)
        (aref (numerics-event-moment event) 0) (numbers-list (numerics-event-state event))))

(defun $numbers_events (name start span tolerance functions directions stops &rest options)
  "The run with its events [[place, direction, time, state], ..], and all its rows."
  (let ((events nil) (rows nil) (times (numbers-option options '$times)))
    (multiple-value-bind (outcome counts)
        (numbers-run name start span tolerance options
                     (lambda (moment state controls)
                       (declare (ignore controls))
                       (setq events (numerics-new-events (gethash functions *numbers-problems*)
                                                         (length state) (cdr directions)
                                                         (cdr stops) nil)
                             rows (numerics-new-rows (and times (numbers-vector times))
                                                     moment state nil))
                       (list (lambda (step) (numerics-see-events events step))
                             (lambda (step) (numerics-see-rows rows step)))))
      (numerics-finish-rows rows outcome)
      (numbers-result outcome counts
                      '$rows (numbers-rows rows)
                      '$events (cons '(mlist simp)
                                     (mapcar #'numbers-event
                                             (reverse (numerics-events-found events))))))))

;;; Constraints: a pendulum in the plane, q = (x, y), of length 1, and what else holds of it

(define-numbers-problem $plane_pendulum (x y u v)
  u v
  (- (* x (numbers-pull x y u v)))
  (- (- 10d0) (* y (numbers-pull x y u v))))

(defun numbers-pull (x y u v)
  "The force of the rod over its length; x u + y v does not change."
  (/ (- (+ (* u u) (* v v)) (* 10d0 y)) (+ (* x x) (* y y))))

(define-numbers-problem $length (x y) (- (+ (* x x) (* y y)) 1d0))
(define-numbers-problem $length_rate (x y u v) (* 2 (+ (* x u) (* y v))))
(define-numbers-problem $length_row (x y) (* 2 x) (* 2 y))
(define-numbers-problem $two_lengths (x y)
  (- (+ (* x x) (* y y)) 1d0) (* x (- (+ (* x x) (* y y)) 1d0)))
(define-numbers-problem $two_rates (x y u v)
  (* 2 (+ (* x u) (* y v))) (* 2 x (+ (* x u) (* y v))))
(define-numbers-problem $two_rows (x y) (* 2 x) (* 2 y) (* 2 x x) (* 2 x y))
(define-numbers-problem $length_direction (x y) (* 2 x) (/ y 2)) ; masses 1 and 4
(define-numbers-problem $plane_energy (x y u v)
  (+ (/ (+ (* u u) (* v v)) 2) (* 10d0 y)) (+ (/ (+ (* u u) (* v v)) 2) (abs (* 10d0 y))))

(defun numbers-constraints (names functions masses)
  (flet ((named (name) (gethash name *numbers-problems*)))
    (numerics-new-constraints names (length names) (named (first functions))
                              (named (second functions)) (named (third functions))
                              (and masses (named '$length_direction)))))

(defun $numbers_projected (state masses)
  "[residual, state] of the pendulum brought back to its length."
  (let ((x (numbers-vector state)))
    (list '(mlist simp)
          (numerics-project (numbers-constraints '($l) '($length $length_rate $length_row) masses)
                            (numerics-moment 0d0) x)
          (numbers-list x))))

(defun $numbers_redundant (state)
  "[constraints that follow from others, residual, state] where one of two is the other times x."
  (let* ((x (numbers-vector state))
         (constraints (numbers-constraints '($l $m) '($two_lengths $two_rates $two_rows) nil))
         (named (numerics-redundant-constraints constraints (numerics-moment 0d0) x)))
    (list '(mlist simp) (cons '(mlist simp) named)
          (numerics-project constraints (numerics-moment 0d0) x) (numbers-list x))))

(defun $numbers_pendulum (start span tolerance projected times)
  "The pendulum in the plane: the largest residual, the drift of its energy, rows at TIMES."
  (let ((constraints (numbers-constraints '($l) '($length $length_rate $length_row) nil))
        (drifts nil) (rows nil) (left 0d0))
    (flet ((look (step)
             (let ((x (numerics-step-after step)))
               (setq left (max left (abs (- (+ (expt (aref x 0) 2) (expt (aref x 1) 2)) 1))))
               nil))
           (project (moment x) (numerics-project constraints moment x)))
      (multiple-value-bind (outcome counts)
          (numbers-run '$plane_pendulum start span tolerance '()
                       (lambda (moment state controls)
                         (setq drifts (numerics-new-drifts
                                       (gethash '$plane_energy *numbers-problems*) nil 1 moment state)
                               rows (numerics-new-rows (numbers-vector times) moment state
                                                       (and projected #'project)))
                         (append (and projected (list (numerics-projection-part constraints)))
                                 (list (lambda (step) (numerics-see-rows rows step)) #'look
                                       (lambda (step) (numerics-see-drifts drifts step))
                                       (numerics-progress-part controls)))))
        (numbers-result outcome counts '$residual left
                        '$drift (first (numerics-relative-drifts drifts))
                        '$kept (numerics-constraints-largest constraints)
                        '$rows (numbers-rows rows))))))

;;; The method that chooses

(define-numbers-problem $van_der_pol_slopes (x v)
  0d0 (- (* -2d3 x v) 1d0) 1d0 (* 1d3 (- 1d0 (* x x))))
(define-numbers-problem $stiff_for_a_while (x)
  (- (- (sin time)) (* (numbers-stiffness time) (- x (cos time)))))
(define-numbers-problem $stiff_for_a_while_slopes (x) (- (numbers-stiffness time)))

(defun numbers-stiffness (time) (+ 1d0 (* 1d5 (exp (- (expt (- time 7d0) 4))))))

(defun $numbers_automatic (name slopes start span tolerance)
  "A run by the method that chooses, with the Jacobian SLOPES by columns; false: without one."
  (let* ((state (numbers-vector start)) (span (numbers-vector span))
         (controls (numbers-controls (aref span 1) tolerance '()))
         (problem (funcall (numbers-problem name) (length state))))
    (when slopes (setf (numerics-problem-jacobian problem) (gethash slopes *numbers-problems*)))
    (let ((outcome (numerics-with-masked-traps
                     (numerics-automatic problem controls (numerics-moment (aref span 0)) state
                                         (constantly nil))))
          (counts (numerics-controls-counts controls)))
      (numbers-result outcome counts '$jacobians (numerics-counts-jacobians counts)
                      '$about (numerics-outcome-about outcome)))))
