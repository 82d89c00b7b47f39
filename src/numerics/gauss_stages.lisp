;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; One step of Gauss-Legendre collocation: the increments L_i = b_i h X(t + c_i h, Y_i) with
;;;     Y_i = x + sum_j (a_ij/b_j) L_j,     x_next = x + sum_i L_i,
;;; by iteration to the last place (Hairer, Lubich, Wanner, Geometric Numerical Integration, VIII.6:
;;; until there is no further improvement), from a first guess by the stages of the steps before.
;;; Where x = (q, v) and q' = v, each sweep takes the new v for q, which halves the sweeps. What a
;;; sum of the state cannot hold is kept in a low part. Nothing is allocated in a step.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/step_control" "numerics/gauss_coefficients"))

(defstruct numerics-gauss-run
  table problem counts
  (stages 0 :type fixnum)
  (size 0 :type fixnum)
  (split 0 :type fixnum)       ; q stands before this place, 0 where there is no q' = v
  (step 0d0 :type double-float)
  (change 0d0 :type double-float) ; the largest of the last sweep, in the weights
  (finite t)
  (parts (numerics-zeros 0) :type (simple-array double-float (*)))      ; b_i h
  (increments (numerics-zeros 0) :type (simple-array double-float (*))) ; L_i, one after the other
  (memory #() :type simple-vector) ; increments of the steps before, the oldest first
  (known 0 :type fixnum)           ; how many of these there are
  (low (numerics-zeros 0) :type (simple-array double-float (*)))
  (scales (numerics-zeros 0) :type (simple-array double-float (*)))
  (weights (numerics-zeros 0) :type (simple-array double-float (*)))
  (out (numerics-zeros 0) :type (simple-array double-float (*)))
  (states #() :type simple-vector)  ; Y_i
  (moments #() :type simple-vector))

(defun numerics-new-gauss-run (problem stages controls)
  (let ((n (numerics-problem-size problem)))
    (flet ((several (count length)
             (coerce (loop repeat count collect (numerics-zeros length)) 'simple-vector)))
      (make-numerics-gauss-run
       :table (numerics-gauss-table stages) :problem problem
       :counts (numerics-controls-counts controls) :scales (numerics-full-scales controls n)
       :stages stages :size n :split (or (numerics-problem-split problem) 0)
       :parts (numerics-zeros stages) :increments (numerics-zeros (* stages n))
       :memory (several 2 (* stages n))
       :low (numerics-zeros n) :weights (numerics-zeros n) :out (numerics-zeros n)
       :states (several stages n) :moments (several stages 2)))))

(defun numerics-gauss-set-step (run step)
  "The parts b_i h of STEP, whose sum is STEP; stages of steps of other length are forgotten."
  (let* ((stages (numerics-gauss-run-stages run)) (parts (numerics-gauss-run-parts run))
         (weights (numerics-gauss-table-weights (numerics-gauss-run-table run)))
         (old (numerics-gauss-run-step run)))
    (map-into parts (lambda (b) (* b step)) weights)
    (let ((inner (reduce #'+ parts :start 1 :end (max 1 (1- stages)) :initial-value 0d0)))
      (if (= stages 1)
          (setf (aref parts 0) step)
          (setf (aref parts 0) (/ (- step inner) 2)
                (aref parts (1- stages)) (aref parts 0))))
    (unless (<= (abs (- step old)) (* 1d-6 (abs old)))
      (setf (numerics-gauss-run-known run) 0))
    (setf (numerics-gauss-run-step run) step)))

;;; First guesses.

(defmacro numerics-by-stages (stages loop-of)
  "The loop that the macro LOOP-OF makes for a known number of STAGES, of which there are 1 to 6."
  `(case ,stages
     ,@(loop for known from 1 to 6 collect `(,known (,loop-of ,known)))))

(defmacro numerics-unrolled-mix (stages)
  "The loop of numerics-gauss-mix for a known number of STAGES: three times as fast."
  (let ((gains (loop for j below stages collect (intern (format nil "GAIN~d" j)))))
    `(loop for k of-type numerics-index from split below n
           do (let ,(loop for gain in gains for j from 0
                          collect `(,gain (aref from (+ k (* ,j n)))))
                (loop for row of-type numerics-index from column below (length matrix) by columns
                      for at of-type numerics-index from k by n
                      do (incf (aref into at)
                               (+ ,@(loop for gain in gains for j from 0
                                          collect `(* ,gain (aref matrix (+ row ,j)))))))))))

(defun numerics-gauss-mix (run matrix column from)
  "Adds to the increments those FROM, times the columns of MATRIX from COLUMN on."
  (declare (type numerics-vector matrix from) (type numerics-index column) (optimize speed))
  (let* ((into (numerics-gauss-run-increments run)) (n (numerics-gauss-run-size run))
         (split (numerics-gauss-run-split run)) (stages (numerics-gauss-run-stages run))
         (columns (floor (length matrix) stages)))
    (declare (type numerics-index stages n columns split))
    (numerics-by-stages stages numerics-unrolled-mix)))

(defun numerics-gauss-foretell (run matrix memory known)
  "The increments by MATRIX from the last KNOWN of MEMORY; a sweep does not need those of q."
  (fill (numerics-gauss-run-increments run) 0d0)
  (dotimes (k known)
    (numerics-gauss-mix run matrix (* k (numerics-gauss-run-stages run))
                        (svref memory (+ (- (length memory) known) k)))))

(defun numerics-gauss-begin (run moment state)
  "The increments as if the rates were constant."
  (let ((out (numerics-gauss-run-out run)) (n (numerics-gauss-run-size run))
        (parts (numerics-gauss-run-parts run)) (increments (numerics-gauss-run-increments run)))
    (funcall (numerics-problem-rates (numerics-gauss-run-problem run)) moment state out)
    (incf (numerics-counts-rates (numerics-gauss-run-counts run)))
    (dotimes (i (numerics-gauss-run-stages run))
      (dotimes (k n)
        (setf (aref increments (+ (* i n) k)) (* (aref parts i) (aref out k)))))))

;;; Sweeps.

(defun numerics-gauss-set-moments (run moment)
  (declare (type numerics-vector moment) (optimize speed))
  (let ((moments (numerics-gauss-run-moments run)) (step (numerics-gauss-run-step run))
        (nodes (numerics-gauss-table-nodes (numerics-gauss-run-table run))))
    (dotimes (i (numerics-gauss-run-stages run))
      (let ((stage (svref moments i)))
        (declare (type numerics-vector stage))
        (setf (aref stage 0) (aref moment 0)
              (aref stage 1) (aref moment 1))
        (numerics-advance stage (* (aref nodes i) step))))))

(defun numerics-gauss-set-weights (run state)
  "What a change is multiplied with: 1/(|x_k| + |increments| + s_k); 0 for what is and stays 0."
  (declare (type numerics-vector state) (optimize speed))
  (let ((weights (numerics-gauss-run-weights run)) (scales (numerics-gauss-run-scales run))
        (increments (numerics-gauss-run-increments run)) (n (numerics-gauss-run-size run)))
    (declare (type numerics-index n))
    (dotimes (k n)
      (let ((extent (+ (abs (aref state k)) (aref scales k))))
        (declare (double-float extent))
        (loop for at of-type numerics-index from k below (length increments) by n
              do (incf extent (abs (aref increments at))))
        (setf (aref weights k) (if (> extent 0d0) (/ extent) 0d0))))))

(defmacro numerics-unrolled-states (stages)
  "The loop of numerics-gauss-set-states for a known number of STAGES: twice as fast."
  (flet ((names (letter) (loop for i below stages collect (intern (format nil "~a~d" letter i)))))
    (let ((stage-states (names "STATE")) (gains (names "GAIN")))
      (flet ((row-times-gains (row)
               (loop for gain in gains for j from row collect `(* ,gain (aref quotients ,j)))))
        `(let ,(loop for name in stage-states for i from 0 collect `(,name (svref states ,i)))
           (declare (type numerics-vector ,@stage-states))
           (loop for k of-type numerics-index from from below to
                 do (let ((x (aref state k)) (kept (aref low k))
                          ,@(loop for name in gains for j from 0
                                  collect `(,name (aref increments (+ k (* ,j n))))))
                      ,@(loop for name in stage-states
                              for row from 0 by stages
                              collect `(setf (aref ,name k)
                                             (+ x (+ kept ,@(row-times-gains row))))))))))))

(defun numerics-gauss-set-states (run state from to)
  "The places FROM to TO of all Y_i."
  (declare (type numerics-vector state) (type numerics-index from to) (optimize speed))
  (let ((states (numerics-gauss-run-states run)) (low (numerics-gauss-run-low run))
        (increments (numerics-gauss-run-increments run))
        (quotients (numerics-gauss-table-quotients (numerics-gauss-run-table run)))
        (stages (numerics-gauss-run-stages run)) (n (numerics-gauss-run-size run)))
    (declare (type numerics-vector quotients) (type numerics-index stages n))
    (numerics-by-stages stages numerics-unrolled-states)))

(defmacro numerics-with-gauss-increments ((run from) &body body)
  "BODY, in which (take i) makes the increments of stage i from place FROM on from the slopes in
OUT; at its end RUN knows how much they changed, and whether all are finite."
  `(let ((increments (numerics-gauss-run-increments ,run)) (parts (numerics-gauss-run-parts ,run))
         (weights (numerics-gauss-run-weights ,run)) (out (numerics-gauss-run-out ,run))
         (n (numerics-gauss-run-size ,run)) (change 0d0) (sum 0d0))
     (declare (type numerics-index n) (double-float change sum))
     (macrolet ((take (i)
                  `(locally (declare (optimize speed (safety 0)))
                     (let ((part (aref parts ,i)))
                       (loop for k of-type numerics-index from ,',from below n
                             for at of-type numerics-index from (+ (* ,i n) ,',from)
                             do (let* ((new (* part (aref out k)))
                                       (changed (* (aref weights k)
                                                   (abs (- new (aref increments at))))))
                                  (when (> changed change) (setq change changed))
                                  (incf sum new)
                                  (setf (aref increments at) new)))))))
       ,@body)
     (setf (numerics-gauss-run-change ,run) change
           (numerics-gauss-run-finite ,run) (numerics-finite-p sum))))

(defun numerics-gauss-take-velocities (run)
  "The increments of q from v in the stages."
  (declare (optimize speed))
  (let ((increments (numerics-gauss-run-increments run)) (parts (numerics-gauss-run-parts run))
        (states (numerics-gauss-run-states run)) (split (numerics-gauss-run-split run))
        (n (numerics-gauss-run-size run)))
    (declare (type numerics-index split n))
    (dotimes (i (numerics-gauss-run-stages run))
      (let ((stage (svref states i)) (part (aref parts i)))
        (declare (type numerics-vector stage))
        (loop for k of-type numerics-index below split
              for at of-type numerics-index from (the numerics-index (* i n))
              do (setf (aref increments at) (* part (aref stage (+ k split)))))))))

(defun numerics-gauss-take-rates (run split)
  "The increments from place SPLIT on from the rates in the stages."
  (declare (type numerics-index split) (optimize speed))
  (let ((rates (numerics-problem-rates (numerics-gauss-run-problem run)))
        (moments (numerics-gauss-run-moments run)) (states (numerics-gauss-run-states run)))
    (declare (type function rates))
    (numerics-with-gauss-increments (run split)
      (dotimes (i (length states))
        (funcall rates (svref moments i) (svref states i) out)
        (take i)))))

(defun numerics-gauss-sweep (run state)
  "New increments from the old ones."
  (let ((split (numerics-gauss-run-split run)))
    (numerics-gauss-set-states run state split (numerics-gauss-run-size run))
    (when (plusp split)
      (numerics-gauss-take-velocities run)
      (numerics-gauss-set-states run state 0 split))
    (numerics-gauss-take-rates run split)
    (incf (numerics-counts-rates (numerics-gauss-run-counts run)) (numerics-gauss-run-stages run))))

(defun numerics-gauss-iterate (run state)
  "Sweeps until there is no further improvement, or the next would bring less than 3 thousandths of
a last place, going by the slower of the last two; nil, or what went wrong. Changes may shrink in
every second sweep only: one without improvement ends it at the last place, two elsewhere."
  (let ((best 0d0) (worse 0) (last 0d0) (rate 0d0) (slower 1d0))
    (declare (double-float best last rate slower) (fixnum worse) (optimize speed))
    (numerics-gauss-set-weights run state)
    (dotimes (sweep 60 :no-convergence)
      (numerics-gauss-sweep run state)
      (let ((change (numerics-gauss-run-change run)))
        (when (> sweep 0) (setq slower (max rate (/ change last)) rate (/ change last)))
        (cond ((not (numerics-gauss-run-finite run)) (return :not-finite))
              ((or (= change 0d0) (< (* slower change) 3d-19)) (return nil))
              ((or (= sweep 0) (< change best)) (setq best change worse 0))
              ((or (< change 1d-15) (and (< best 1d-9) (= worse 1))) (return nil))
              (t (incf worse)))
        (setq last change)))))

(defun numerics-gauss-settle (run moment state guessed)
  "The increments from a guess, where there is one that leads to them; nil, or what went wrong."
  (when (numerics-problem-timed (numerics-gauss-run-problem run))
    (numerics-gauss-set-moments run moment))
  (let ((fault (or (not guessed) (numerics-gauss-iterate run state))))
    (when (and fault guessed)
      (incf (numerics-counts-rejected (numerics-gauss-run-counts run))))
    (when fault
      (numerics-gauss-begin run moment state)
      (setq fault (numerics-gauss-iterate run state)))
    fault))

(defun numerics-gauss-solve (run moment state)
  "The increments of the step from MOMENT and STATE; nil, or what went wrong."
  (let ((known (numerics-gauss-run-known run)))
    (when (plusp known)
      (numerics-gauss-foretell
       run (svref (numerics-gauss-table-memories (numerics-gauss-run-table run)) known)
       (numerics-gauss-run-memory run) known))
    (numerics-gauss-settle run moment state (plusp known))))

;;; The end of a step.

(defun numerics-gauss-advance (run state)
  "STATE and its low part with the increments, which go to the memory."
  (declare (type numerics-vector state) (optimize speed))
  (let ((increments (numerics-gauss-run-increments run)) (low (numerics-gauss-run-low run))
        (n (numerics-gauss-run-size run)))
    (declare (type numerics-index n))
    (dotimes (k n)
      (let ((gain (aref low k)) (old (aref state k)))
        (declare (double-float gain))
        (loop for at of-type numerics-index from k below (length increments) by n
              do (incf gain (aref increments at)))
        (let* ((new (+ old gain)) (kept (- new old)))
          (setf (aref state k) new
                (aref low k) (+ (- old (- new kept)) (- gain kept))))))
    (numerics-gauss-remember run)))

(defun numerics-gauss-remember (run)
  (let* ((memory (numerics-gauss-run-memory run)) (oldest (svref memory 0)))
    (replace memory memory :start2 1)
    (setf (svref memory (1- (length memory))) (numerics-gauss-run-increments run)
          (numerics-gauss-run-increments run) oldest)
    (when (< (numerics-gauss-run-known run) (length memory))
      (incf (numerics-gauss-run-known run)))))
