;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; dlsode of Maxima's share (ODEPACK by A. C. Hindmarsh, translated from Fortran): Adams' methods
;;; and backward differences. It is loaded when it is first asked for, and compiled when it is first
;;; loaded on a machine. It hands over displaced vectors, which our rates must not see: what it
;;; gives and takes is copied. It makes one step a call, never past the end (itask 5), so that its
;;; limit of 500 steps a call does not bind, and is silent meanwhile. See numerics-dlsode first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/messages" "core/share_packages" "numerics/decimals" "numerics/problem"
                "numerics/step_control"))

(defstruct numerics-dlsode
  problem controls
  method-flag  ; 10 Adams, 21 and 22 backward differences with our jacobian and with its own
  y time real-work whole-work size-vector relative absolute ; its arguments
  (state-flag 1)                                            ; 1 begins, 2 goes on
  (jacobians 0)                                             ; that it has counted already
  moment x out values)                                      ; ours

(defun numerics-dlsode (problem controls moment state observer &key method-flag)
  "Integrates PROBLEM, x' = X(t, x), from STATE at MOMENT; an outcome."
  (when (numerics-problem-mass problem)
    (core-error "dlsode takes x' = .., and here M x' = .. with a matrix M; take method = radau"))
  (let* ((call (numerics-load-dlsode))
         (flag (or method-flag (if (numerics-problem-jacobian problem) 21 22)))
         (run (numerics-new-dlsode problem controls moment state flag))
         (status (numerics-dlsode-silently (lambda () (numerics-dlsode-steps run call observer)))))
    (make-numerics-outcome
     :status (if (consp status) (first status) status)
     :moment (numerics-moment (numerics-dlsode-time run))
     :state (copy-seq (numerics-dlsode-y run))
     :step (aref (numerics-dlsode-real-work run) 11)
     :about (and (consp status) (second status)))))

;;; Its package is there only when it has been loaded.

(defun numerics-odepack (text) (find-symbol text "ODEPACK"))

(defun numerics-load-dlsode ()
  "The function dlsode."
  (flet ((there-p ()
           (and (find-package "ODEPACK") (numerics-odepack "DLSODE")
                (fboundp (numerics-odepack "DLSODE")))))
    (unless (core-load-share "dlsode" #'there-p)
      (core-error "dlsode of Maxima's share cannot be loaded; take method = radau")))
  (symbol-function (numerics-odepack "DLSODE")))

(defun numerics-dlsode-silently (function)
  "Calls FUNCTION while dlsode prints no messages: its switch is the second datum of ixsav."
  (let* ((switch (symbol-function (numerics-odepack "IXSAV"))) (before (funcall switch 2 0 nil)))
    (unwind-protect (progn (funcall switch 2 0 t)
                           (funcall function))
      (funcall switch 2 before t))))

(defun numerics-new-dlsode (problem controls moment state flag)
  (let* ((n (length state)) (relative (numerics-controls-relative controls))
         (whole '(signed-byte 32))
         (run (make-numerics-dlsode
               :problem problem :controls controls :method-flag flag
               :y (copy-seq state) :time (aref moment 0)
               :real-work (numerics-zeros (if (= flag 10) (+ 20 (* 16 n)) (+ 22 (* 9 n) (* n n))))
               :whole-work (make-array (+ 20 n) :element-type whole :initial-element 0)
               :size-vector (make-array 1 :element-type whole :initial-element n)
               :relative (make-array 1 :element-type 'double-float :initial-element relative)
               :absolute (map 'numerics-vector (lambda (scale) (* scale relative))
                              (numerics-full-scales controls n))
               :moment (numerics-moment 0d0) :x (numerics-zeros n) :out (numerics-zeros n)))
         (pattern (numerics-problem-pattern problem)))
    (when pattern
      (setf (numerics-dlsode-values run)
            (numerics-zeros (length (numerics-pattern-rows pattern)))))
    (let ((work (numerics-dlsode-real-work run)))
      (setf (aref work 0) (numerics-controls-end controls)
            (aref work 4) (* (signum (numerics-time-left controls moment))
                             (abs (or (numerics-controls-first-step controls) 0d0)))
            (aref work 5) (or (numerics-controls-largest-step controls) 0d0)))
    run))

;;; What it calls. A value that is returned first would become its time. It has no answer to rates
;;; without a finite value, a shorter step neither.

(defun numerics-dlsode-rates (run)
  (let ((moment (numerics-dlsode-moment run)) (x (numerics-dlsode-x run))
        (out (numerics-dlsode-out run))
        (counts (numerics-controls-counts (numerics-dlsode-controls run)))
        (rates (numerics-problem-rates (numerics-dlsode-problem run))))
    (lambda (size-vector time y slopes)
      (declare (ignore size-vector))
      (setf (aref moment 0) time)
      (replace x y)
      (funcall rates moment x out)
      (incf (numerics-counts-rates counts))
      (unless (numerics-finite-vector-p out)
        (throw 'numerics-no-rates (numerics-dlsode-without-rates run time)))
      (replace slopes out)
      nil)))

(defun numerics-dlsode-without-rates (run time)
  "What is said where the rates have no finite value in a trial at TIME: there, or beyond the state
of RUN."
  (if (= time (numerics-dlsode-time run))
      :not-finite
      (list :no-convergence
            (format nil "dlsode: in a trial step the right-hand side has no finite value at about ~
                         t = ~a, and it takes no shorter one; take method = auto"
                    (numerics-short-number time)))))

(defun numerics-dlsode-jacobian (run)
  "The entries go into a matrix by columns of ROWS rows, which is zero before."
  (let* ((moment (numerics-dlsode-moment run)) (x (numerics-dlsode-x run))
         (values (numerics-dlsode-values run)) (problem (numerics-dlsode-problem run))
         (pattern (numerics-problem-pattern problem)))
    (lambda (size-vector time y lower upper matrix rows)
      (declare (ignore size-vector lower upper))
      (setf (aref moment 0) time)
      (replace x y)
      (funcall (numerics-problem-jacobian problem) moment x values)
      (dotimes (j (numerics-pattern-size pattern))
        (loop for k from (aref (numerics-pattern-starts pattern) j)
                below (aref (numerics-pattern-starts pattern) (1+ j))
              do (setf (aref matrix (+ (* j rows) (aref (numerics-pattern-rows pattern) k)))
                       (aref values k))))
      nil)))

;;; Steps.

(defun numerics-dlsode-steps (run call observer)
  "The status, or that and a sentence."
  (let* ((controls (numerics-dlsode-controls run)) (y (numerics-dlsode-y run))
         (seen (make-numerics-step :before (copy-seq y) :after y))
         (rates (numerics-dlsode-rates run)) (jacobian (numerics-dlsode-jacobian run)))
    (setf (numerics-step-interpolate seen) (numerics-dlsode-between run seen))
    (loop
      (when (= (numerics-dlsode-time run) (numerics-controls-end controls)) (return :end))
      (replace (numerics-step-before seen) y)
      (setf (aref (numerics-step-from seen) 0) (numerics-dlsode-time run))
      (let ((fault (or (numerics-dlsode-limit controls)
                       (catch 'numerics-no-rates
                         (numerics-dlsode-step run call rates jacobian)))))
        (when fault
          (replace y (numerics-step-before seen))
          (setf (numerics-dlsode-time run) (aref (numerics-step-from seen) 0))
          (return fault)))
      (setf (aref (numerics-step-to seen) 0) (numerics-dlsode-time run))
      (case (and observer (funcall observer seen))
        (:stop (setf (numerics-dlsode-time run) (aref (numerics-step-to seen) 0))
               (return :stopped))
        (:changed (setf (numerics-dlsode-state-flag run) 1
                        (numerics-dlsode-jacobians run) 0))))))

(defun numerics-dlsode-limit (controls)
  (let ((most (numerics-controls-most-steps controls)))
    (and most (>= (numerics-counts-steps (numerics-controls-counts controls)) most) :most-steps)))

(defun numerics-dlsode-step (run call rates jacobian)
  "A step; nil, or what went wrong."
  (let* ((whole (numerics-dlsode-whole-work run)) (work (numerics-dlsode-real-work run))
         (from (numerics-dlsode-time run)))
    (multiple-value-bind (f neq y time tout itol rtol atol itask state-flag)
        (funcall call rates (numerics-dlsode-size-vector run) (numerics-dlsode-y run)
                 from (numerics-controls-end (numerics-dlsode-controls run))
                 2 (numerics-dlsode-relative run) (numerics-dlsode-absolute run)
                 5 (numerics-dlsode-state-flag run) 1
                 work (length work) whole (length whole)
                 jacobian (numerics-dlsode-method-flag run))
      (declare (ignore f neq y tout itol rtol atol itask))
      (numerics-dlsode-count run)
      (setf (numerics-dlsode-time run) time
            (numerics-dlsode-state-flag run) state-flag)
      (cond ((minusp state-flag) (numerics-dlsode-fault state-flag))
            ((notevery #'numerics-finite-p (numerics-dlsode-y run)) :not-finite)
            ((= time from) :smallest-step)))))

(defun numerics-dlsode-count (run)
  (let ((counts (numerics-controls-counts (numerics-dlsode-controls run)))
        (jacobians (aref (numerics-dlsode-whole-work run) 12)))
    (incf (numerics-counts-steps counts))
    (incf (numerics-counts-jacobians counts) (- jacobians (numerics-dlsode-jacobians run)))
    (setf (numerics-counts-factorisations counts) (numerics-counts-jacobians counts)
          (numerics-dlsode-jacobians run) jacobians)))

(defun numerics-dlsode-fault (state-flag)
  (ecase state-flag
    (-1 :most-steps)
    (-2 '(:smallest-step "dlsode: the tolerance is finer than the numbers there"))
    (-3 '(:no-convergence "dlsode: the tolerance is finer than the numbers, or there is no state"))
    (-4 '(:smallest-step "dlsode: the test of errors failed again and again"))
    (-5 '(:no-convergence "dlsode: its corrector did not converge"))
    (-6 '(:smallest-step "dlsode: a state of absolute tolerance 0 became 0"))))

(defun numerics-dlsode-between (run seen)
  "The function (share out): the sum of z_j ((t - t_n)/h)^j over the columns z_j of its work array."
  (lambda (share out)
    (let* ((work (numerics-dlsode-real-work run)) (n (length out))
           (order (aref (numerics-dlsode-whole-work run) 14)) (to (numerics-dlsode-time run))
           (place (* (- share 1) (/ (- to (aref (numerics-step-from seen) 0)) (aref work 11)))))
      (dotimes (i n out)
        (let ((sum 0d0))
          (loop for j from order downto 0
                do (setq sum (+ (aref work (+ 20 i (* j n))) (* place sum))))
          (setf (aref out i) sum))))))
