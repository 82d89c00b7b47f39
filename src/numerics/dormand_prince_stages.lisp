;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; One step of the explicit method of order 8 by Dormand and Prince: its slopes, its new state with
;;; the two estimates of the error, and the state between, by a polynomial of degree 7 that takes
;;; three slopes more (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations
;;; I, sections II.5 and II.6; code dop853.f). What a step adds to the state keeps the part that
;;; rounding takes from it, for the next step.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/dormand_prince_coefficients"
                "numerics/problem" "numerics/step_control"))

(defstruct (numerics-dopri-run (:conc-name numerics-dopri-))
  "A run under way."
  problem controls
  (rates #'identity :type function)
  (scales (numerics-zeros 0) :type numerics-vector)
  (relative 0d0 :type double-float)
  (largest-step 0d0 :type double-float)
  (timed t)                                    ; whether the rates depend on the time
  (size 0 :type fixnum)
  (step 0d0 :type double-float)                ; with its sign
  (error 0d0 :type double-float)               ; of the last trial, over the tolerance
  (finite-p t)                                 ; the last trial was finite
  (rejected-p nil)                             ; the last trial was no step
  (last-p nil)                                 ; the step goes to the end
  (full-step 0d0 :type double-float)           ; the step before the end made it shorter
  (stiff 0 :type fixnum) (calm 0 :type fixnum) ; steps that looked stiff; steps since that did not
  (moment (numerics-zeros 2) :type numerics-vector)
  (next-moment (numerics-zeros 2) :type numerics-vector)
  (stage-moment (numerics-zeros 2) :type numerics-vector)
  (state (numerics-zeros 0) :type numerics-vector)
  (next (numerics-zeros 0) :type numerics-vector)
  (low (numerics-zeros 0) :type numerics-vector) ; what rounding took from the state
  (next-low (numerics-zeros 0) :type numerics-vector)
  (stage (numerics-zeros 0) :type numerics-vector)
  (slopes (vector) :type simple-vector)        ; by the numbers of the stages
  (dense (vector) :type simple-vector)         ; coefficients of the polynomial, from the second on
  (dense-p nil)                                ; they are those of this step
  (resumed 0d0 :type double-float)             ; the step before a jump made it shorter, or 0
  (before-jump-p nil)                          ; the step leads to a jump
  (pace nil)
  (about nil)                                  ; a sentence on how the run ended
  (seen (make-numerics-step)))                 ; what the observer sees

(defun numerics-new-dopri-run (problem controls moment state)
  (let ((n (numerics-problem-size problem)))
    (assert (= n (length state)))
    (flet ((vectors (count) (coerce (loop repeat count collect (numerics-zeros n)) 'simple-vector)))
      (make-numerics-dopri-run
       :problem problem :controls controls :rates (numerics-problem-rates problem) :size n
       :scales (numerics-full-scales controls n)
       :relative (numerics-controls-relative controls) :timed (numerics-problem-timed problem)
       :largest-step (numerics-largest-step controls moment)
       :pace (make-numerics-pace :moment (copy-seq moment))
       :moment (copy-seq moment) :state (copy-seq state) :next (numerics-zeros n)
       :low (numerics-zeros n) :next-low (numerics-zeros n) :stage (numerics-zeros n)
       :slopes (vectors 17) :dense (vectors 8)))))

;;; Slopes

(defmacro numerics-for-states ((i n) &body body)
  "BODY for each place I of a state. All vectors of a run itself have the length N, so that nothing
is checked: a sixth of the time."
  `(locally (declare (optimize speed (safety 0))) (dotimes (,i ,n) ,@body)))

(defmacro numerics-with-slopes ((run &rest numbers) &body body)
  "BODY with the size N, the STEP, the STATE, the STAGE and the slopes k1, .. of NUMBERS of RUN."
  `(let* ((n (numerics-dopri-size ,run)) (step (numerics-dopri-step ,run))
          (state (numerics-dopri-state ,run)) (stage (numerics-dopri-stage ,run))
          (slopes (numerics-dopri-slopes ,run))
          ,@(loop for number in numbers
                  collect `(,(numerics-slope-name number)
                            (the numerics-vector (svref slopes ,number)))))
     (declare (fixnum n) (double-float step) (type numerics-vector state stage)
              (ignorable n step state stage slopes))
     ,@body))

(defmacro numerics-dopri-slope (run number)
  "Makes the slope NUMBER of RUN from the stage before it."
  `(numerics-with-slopes (,run ,@(mapcar #'car (numerics-dopri-weights :stage number)))
     (let ((moment (numerics-dopri-moment ,run)) (later (numerics-dopri-stage-moment ,run)))
       (numerics-for-states (i n)
         (setf (aref stage i)
               (+ (aref state i) (* step (numerics-slope-sum :stage ,number i)))))
       (when (numerics-dopri-timed ,run)
         (setf (aref later 0) (aref moment 0) (aref later 1) (aref moment 1))
         (numerics-advance later (* step ,(numerics-dopri-node number))))
       (funcall (numerics-dopri-rates ,run) later stage (svref slopes ,number)))))

(defmacro numerics-dopri-slopes-from (run first last)
  `(progn
     ,@(loop for number from first to last collect `(numerics-dopri-slope ,run ,number))))

(defun numerics-dopri-stages (run)
  "The slopes 2 to 12 of RUN."
  (declare (optimize speed))
  (numerics-dopri-slopes-from run 2 12))

;;; The new state

(declaim (inline numerics-combined-error))
(defun numerics-combined-error (fifth third)
  "The estimate of order 5, made smaller as it is smaller than that of order 3."
  (declare (double-float fifth third))
  (if (> fifth 0d0)
      (/ fifth (sqrt (abs (+ 1d0 (* 0.01d0 (/ third fifth) (/ third fifth))))))
      0d0))

(defun numerics-dopri-sum (run)
  "The new state of RUN, its error, and whether all that they are made of is finite."
  (declare (optimize speed))
  (numerics-with-slopes (run 1 2 3 4 5 6 7 8 9 10 11 12)
    (let ((next (numerics-dopri-next run)) (scales (numerics-dopri-scales run))
          (low (numerics-dopri-low run)) (next-low (numerics-dopri-next-low run))
          (fifth 0d0) (third 0d0) (doubt 0d0))
      (declare (double-float fifth third doubt))
      (numerics-for-states (i n)
        (let* ((slope (numerics-slope-sum :stage 13 i)) (error (numerics-slope-sum :error 0 i))
               (old (aref state i)) (rise (+ (* step slope) (aref low i)))
               (new (+ old rise)) (risen (- new old))
               (weight (/ (numerics-scale old new (aref scales i)))))
          (setf (aref next i) new
                (aref next-low i) (+ (- old (- new risen)) (- rise risen))
                fifth (max fifth (* (abs error) weight))
                third (max third (* (abs (- slope (numerics-slope-sum :error 1 i))) weight)))
          (incf doubt (* 0d0 (+ (+ new error)
                                (+ (+ (aref k2 i) (aref k3 i)) (+ (aref k4 i) (aref k5 i))))))))
      (setf (numerics-dopri-error run)
            (/ (* (abs step) (numerics-combined-error fifth third)) (numerics-dopri-relative run))
            (numerics-dopri-finite-p run) (= doubt 0d0)))))

(defun numerics-dopri-unstable-p (run)
  "Whether the step of RUN is at the bound of stability: it times the size of the Jacobian along the
way from the last stage to the new state is more than 6.1."
  (declare (optimize speed))
  (numerics-with-slopes (run 12 13)
    (let ((next (numerics-dopri-next run)) (scales (numerics-dopri-scales run))
          (slope 0d0) (way 0d0))
      (declare (double-float slope way))
      (numerics-for-states (i n)
        (let ((scale (numerics-scale (aref state i) (aref next i) (aref scales i))))
          (setf slope (max slope (/ (abs (- (aref k13 i) (aref k12 i))) scale))
                way (max way (/ (abs (- (aref next i) (aref stage i))) scale)))))
      (> (* (abs step) slope) (* 6.1d0 way)))))

;;; The state between. With y = 1 - s, at the share s of the step it is
;;;     x + s (d1 + y (d2 + s (d3 + y (d4 + s (d5 + y (d6 + s d7))))))

(eval-when (:compile-toplevel :load-toplevel :execute)
  (defun numerics-dense-name (k) (intern (format nil "D~d" k) :maxima)))

(defmacro numerics-with-dense ((run) &body body)
  "BODY with the coefficients d1 to d7 of RUN."
  `(let* ((dense (numerics-dopri-dense ,run))
          ,@(loop for k from 1 to 7
                  collect `(,(numerics-dense-name k) (the numerics-vector (svref dense ,k)))))
     ,@body))

(defmacro numerics-dense-sum (k i)
  "d_k + y (d_(k+1) + s (d_(k+2) + ..)) at the place I, for odd K; s and y changed for even K."
  (let ((first `(aref ,(numerics-dense-name k) ,i)))
    (if (= k 7)
        first
        `(+ ,first (* ,(if (oddp k) 'y 's) (numerics-dense-sum ,(1+ k) ,i))))))

(defun numerics-dopri-make-dense (run)
  "Three slopes more, and the coefficients d1 to d7 of this step of RUN."
  (declare (optimize speed))
  (numerics-dopri-slopes-from run 14 16)
  (numerics-with-slopes (run 1 6 7 8 9 10 11 12 13 14 15 16)
    (numerics-with-dense (run)
      (let ((next (numerics-dopri-next run)))
        (numerics-for-states (i n)
          (let* ((way (- (aref next i) (aref state i))) (bend (- (* step (aref k1 i)) way)))
            (setf (aref d1 i) way
                  (aref d2 i) bend
                  (aref d3 i) (- way (* step (aref k13 i)) bend)
                  (aref d4 i) (* step (numerics-slope-sum :dense 0 i))
                  (aref d5 i) (* step (numerics-slope-sum :dense 1 i))
                  (aref d6 i) (* step (numerics-slope-sum :dense 2 i))
                  (aref d7 i) (* step (numerics-slope-sum :dense 3 i)))))))))

(defun numerics-dopri-between (run s out)
  "The state of RUN at the share S of its step, into OUT."
  (declare (double-float s) (type numerics-vector out) (optimize speed))
  (unless (numerics-dopri-dense-p run)
    (numerics-dopri-make-dense run)
    (setf (numerics-dopri-dense-p run) t)
    (incf (numerics-counts-rates (numerics-controls-counts (numerics-dopri-controls run))) 3))
  (numerics-with-slopes (run)
    (numerics-with-dense (run)
      (let ((y (- 1d0 s)))
        (dotimes (i n)
          (setf (aref out i) (+ (aref state i) (* s (numerics-dense-sum 1 i)))))
        out))))
