;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What every method of integration takes and gives. A problem is M x' = X(t, x) with what a method
;;; may ask of it; a method is a function of a problem, controls, a start and an observer:
;;;     (numerics-dopri problem controls moment state observer) -> numerics-outcome
;;; It steps until the end of the controls, and calls the observer after each accepted step. The
;;; observer reads the step, may change the state (a projection), and says nil to go on, :changed
;;; where it has changed the state, or :stop.

(in-package :maxima)

;;; Vectors are simple arrays of double-float numbers, changed in place: a number that is passed or
;;; returned would be boxed. A moment is such a vector of two numbers, the time and its low part, so
;;; that a sum of many steps keeps what a double-float number cannot hold.

(deftype numerics-vector () '(simple-array double-float (*)))
(deftype numerics-index () '(unsigned-byte 32))
(deftype numerics-indices () '(simple-array (unsigned-byte 32) (*)))

(declaim (inline numerics-zeros))
(defun numerics-zeros (n) (make-array n :element-type 'double-float :initial-element 0d0))

(defun numerics-moment (time)
  (let ((moment (numerics-zeros 2)))
    (setf (aref moment 0) time)
    moment))

(declaim (inline numerics-advance))
(defun numerics-advance (moment step)
  "MOMENT later by STEP, in place; the sum of its parts loses nothing that two numbers can hold."
  (declare (type numerics-vector moment) (double-float step) (optimize speed))
  (let* ((high (aref moment 0)) (low (+ step (aref moment 1)))
         (sum (+ high low)) (kept (- sum high)))
    (declare (double-float high low sum kept))
    (setf (aref moment 0) sum
          (aref moment 1) (+ (- high (- sum kept)) (- low kept)))
    moment))

;;; x - x = 0 would do, but compilers take that for true.
(declaim (inline numerics-finite-p))
(defun numerics-finite-p (x)
  (declare (double-float x))
  (<= (abs x) most-positive-double-float))

;;; Sparse matrices by columns: the entries of column j are values[starts[j]] .. before
;;; values[starts[j+1]], in the rows rows[..], which increase.

(defstruct numerics-pattern
  (size 0 :type fixnum)
  (starts (make-array 1 :element-type '(unsigned-byte 32) :initial-element 0)
   :type (simple-array (unsigned-byte 32) (*)))
  (rows (make-array 0 :element-type '(unsigned-byte 32))
   :type (simple-array (unsigned-byte 32) (*))))

(defstruct numerics-matrix
  pattern (values (numerics-zeros 0) :type (simple-array double-float (*))))

;;; A problem.

(defstruct numerics-problem
  (size 0 :type fixnum)
  rates      ; (time x out): X(t, x) into the vector OUT; TIME is a moment, X a vector. What has no
             ; finite value comes out as infinity or NaN, never as an error
  jacobian   ; nil, or (time x values): the entries dX_i/dx_j of the pattern into VALUES
  pattern    ; numerics-pattern of the jacobian
  time-slope ; nil, or (time x out): dX/dt
  mass       ; nil for the identity, else a constant numerics-matrix
  names      ; Maxima expressions of the states, for messages
  (timed t)  ; whether the rates depend on the time
  split      ; nil, or the number k where x = (q, v), q' = v, and v' depends on q, v and t (k = n/2)
  program)   ; what the rates were made from, for methods in other arithmetics: numerics-program

;;; What a run has cost so far.

(defstruct numerics-counts
  (rates 0 :type fixnum) (jacobians 0 :type fixnum) (factorisations 0 :type fixnum)
  (steps 0 :type fixnum) (rejected 0 :type fixnum) (not-finite 0 :type fixnum))

;;; Controls. The error of a step is max |e_i|/(|x_i| + s_i) against the relative tolerance.

(defstruct numerics-controls
  (end 0d0 :type double-float)
  (relative 1d-8 :type double-float)
  (scales (numerics-zeros 0) :type (simple-array double-float (*))) ; s_i = absolute/relative,
                                                                    ; of angles 1
  (first-step nil)     ; nil: chosen by the method
  (largest-step nil)
  (most-steps nil)     ; nil: no limit
  (mends-start nil)    ; the algebraic part of an inconsistent start is mended, by implicit methods
  (inspect nil)        ; nil, or (step guessed): before a step of chosen length is accepted, or
                       ; where it cannot be made and is GUESSED from the one before, nil, or the
                       ; share of it that may be, and whether that leads over a jump; or a sentence
                       ; that says why the run ends there
  (looks-for nil)      ; :stiffness, or :much-stiffness, of very many steps (explicit methods),
                       ; :end-of-stiffness (implicit ones): see auto
  (counts (make-numerics-counts)))

(defun numerics-copied-controls (controls relative end)
  "CONTROLS with the tolerance RELATIVE, another END and counts of their own."
  (let ((copy (copy-numerics-controls controls)))
    (setf (numerics-controls-relative copy) relative
          (numerics-controls-end copy) end
          (numerics-controls-looks-for copy) nil
          (numerics-controls-counts copy) (make-numerics-counts))
    copy))

;;; A step that was accepted, as the observer sees it; it holds during the call only.

(defstruct numerics-step
  (from (numerics-zeros 2) :type (simple-array double-float (*)))   ; moments
  (to (numerics-zeros 2) :type (simple-array double-float (*)))
  (before (numerics-zeros 0) :type (simple-array double-float (*))) ; states
  (after (numerics-zeros 0) :type (simple-array double-float (*)))
  interpolate  ; (share out): the state at from + share*(to - from), 0 <= share <= 1, into OUT
  nodes)       ; nil, or ((share . weight) ..) at which a function of the state is integrated as
               ; accurately as the method is, by the interpolated states

(declaim (inline numerics-step-length numerics-step-moment))

(defun numerics-step-length (step)
  (let ((from (numerics-step-from step)) (to (numerics-step-to step)))
    (+ (- (aref to 0) (aref from 0)) (- (aref to 1) (aref from 1)))))

(defun numerics-step-moment (step share out)
  "The moment at SHARE of STEP, into OUT."
  (declare (double-float share) (type numerics-vector out))
  (replace out (numerics-step-from step))
  (numerics-advance out (* share (numerics-step-length step))))

(defun numerics-step-state (step share out)
  "The state at SHARE of STEP, into OUT: at its ends what it was and is, a projection included."
  (declare (double-float share))
  (cond ((= share 0d0) (replace out (numerics-step-before step)))
        ((= share 1d0) (replace out (numerics-step-after step)))
        (t (funcall (the function (numerics-step-interpolate step)) share out)
           out)))

(defun numerics-undo-step (step)
  "STEP ends where it begins."
  (let ((before (copy-seq (numerics-step-before step))))
    (setf (numerics-step-interpolate step) (lambda (share out) share (replace out before)))
    (replace (numerics-step-to step) (numerics-step-from step))
    (replace (numerics-step-after step) before)))

;;; How a method ended.

(defstruct numerics-outcome
  status   ; :end, :stopped, :stiff, :not-stiff (of those that look for it), or what went wrong:
           ; :not-finite, :smallest-step, :no-convergence, :most-steps, :too-slow, :singular,
           ; :sliding, :inconsistent (the start, where the mass is singular)
  moment state
  (step 0d0 :type double-float) ; the next step that the method would take
  about)   ; a sentence for a person, or nil
