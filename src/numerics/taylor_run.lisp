;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Integration by Taylor series in fixed-point numbers to a given accuracy: the order and the step
;;; of A. Jorba and M. Zou (A software package for the numerical integration of ODEs by means of
;;; high-order Taylor methods, 2005, section 3). For steps exact to a share d the order is
;;; 1 - log(d)/2, and the step exp(-2), or 1/8, of the radius of convergence as the last half of the
;;; coefficients show it. A run does not know what its rounding costs: see taylor.lisp.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/decimals" "numerics/taylor_numbers" "numerics/taylor_expansion"))

(defconstant numerics-taylor-guard-bits 32)

(defstruct numerics-taylor-run
  digits expansion scales
  moment states  ; where it is, in fixed-point numbers
  end span       ; |end - begin|
  left           ; times of rows that are still to come
  (rows '())     ; lists of states, the last one first
  (steps 0)
  status about)

(defun numerics-taylor-order (digits) (max 8 (1+ (ceiling (* digits (log 10d0) 1/2)))))

(defun numerics-taylor-more-bits (times scales)
  "For a span far from 1, in which times, or else rates, would have no digits, and for states that
count where they are far smaller than 1."
  (flet ((exponent (e) (- (integer-length (abs (numerics-fixed e 1200))) 1200)))
    (max 0
         (- (abs (exponent (sub (car (last times)) (first times)))) 40)
         (- (- (reduce #'min (mapcar #'exponent scales))) 40))))

(defun numerics-expansion-with-constants (program bits order)
  "The expansion of PROGRAM with so many BITS or more that no constant is lost."
  (loop for enough = bits then (* 2 enough)
        for expansion = (numerics-expansion-of program enough order)
        while (numerics-expansion-lost expansion)
        do (when (> enough 10000)
             (core-error "a number of the equations is too small for series; take other units"))
        finally (return expansion)))

(defun numerics-new-taylor-run (program start times scales digits)
  (let* ((expansion (numerics-expansion-with-constants
                     program
                     (+ (ceiling (* digits (log 10d0 2))) numerics-taylor-guard-bits
                        (numerics-taylor-more-bits times scales))
                     (numerics-taylor-order digits)))
         (bits (numerics-expansion-bits expansion)))
    (flet ((fixed (numbers) (mapcar (lambda (e) (numerics-fixed e bits)) numbers)))
      (let ((times (fixed times)))
        (make-numerics-taylor-run
         :digits digits :scales (fixed scales) :expansion expansion
         :moment (first times) :states (fixed start) :end (car (last times)) :left times
         :span (abs (- (car (last times)) (first times))))))))

(defun numerics-taylor-run (program start times scales digits most-steps)
  "The run of PROGRAM from START through TIMES whose steps are exact to DIGITS digits."
  (let* ((run (numerics-new-taylor-run program start times scales digits))
         (scale (round (- (numerics-taylor-run-end run) (numerics-taylor-run-moment run)) 100))
         (fault (catch 'numerics-series-fault
                  (numerics-taylor-take-rows run 0 1)
                  (loop while (numerics-taylor-run-left run)
                        do (when (>= (numerics-taylor-run-steps run) most-steps)
                             (return (numerics-taylor-ended run :most-steps nil)))
                           (incf (numerics-taylor-run-steps run))
                           (numerics-taylor-progress run)
                           (setq scale (numerics-taylor-step run scale))))))
    (when fault (numerics-taylor-ended run :not-finite (format nil "there is ~a" fault)))
    run))

(defun numerics-taylor-progress (run)
  (core-progress "~d digits, t = ~a" (numerics-taylor-run-digits run)
                 (numerics-short-number (numerics-double-of-fixed (numerics-taylor-run-moment run)
                                                                  (numerics-taylor-bits run)))))

(defun numerics-taylor-ended (run status about)
  (setf (numerics-taylor-run-status run) status
        (numerics-taylor-run-about run) about
        (numerics-taylor-run-left run) '())
  nil)

(defun numerics-taylor-bits (run) (numerics-expansion-bits (numerics-taylor-run-expansion run)))

;;; A step.

(defun numerics-taylor-step (run scale)
  "One step of RUN, whose series have the SCALE; the length of the step."
  (let ((expansion (numerics-taylor-run-expansion run)) (bits (numerics-taylor-bits run))
        (left (numerics-taylor-left run)))
    (multiple-value-bind (step scale) (numerics-taylor-fitting-step run scale)
      (cond ((numerics-taylor-too-short-p run step)
             (numerics-taylor-ended
              run :smallest-step
              "the series reach less and less far: the solution does not seem to go on"))
            (t (when (>= (abs step) (abs left)) (setq step left))
               (numerics-taylor-take-rows run step scale)
               (setf (numerics-taylor-run-states run)
                     (numerics-expansion-states-at expansion (floor (ash step bits) scale)))
               (incf (numerics-taylor-run-moment run) step)))
      step)))

(defun numerics-taylor-left (run)
  (- (numerics-taylor-run-end run) (numerics-taylor-run-moment run)))

(defun numerics-taylor-fitting-step (run scale)
  "Two values: the longest step, with its sign, that the series allow, and their scale: SCALE or a
shorter one where the step is far shorter, a longer one where the coefficients are lost in
rounding."
  (let ((may-grow t) (left (numerics-taylor-left run)))
    (loop
      (multiple-value-bind (step vague) (numerics-taylor-step-of-scale run scale)
        (cond ((< (* 32 (abs step)) (abs scale))
               (setq scale step may-grow nil))
              ((and vague may-grow (< (abs scale) (abs left)))
               (setq scale (* (signum left) (min (abs left) (* 8 (abs scale))))))
              (t (return (values step scale))))))))

(defconstant numerics-taylor-share (/ 2 (log 2d0))
  "Binary logarithm of e^2.")

(defun numerics-taylor-step-of-scale (run scale)
  "Expands with SCALE. Two values: the longest step that the series allow, and whether these are too
small to tell."
  (numerics-expand (numerics-taylor-run-expansion run) (numerics-taylor-run-moment run)
                   (numerics-taylor-run-states run) scale)
  (multiple-value-bind (radius size) (numerics-taylor-radius run)
    (values (numerics-before-corners
             run (round (* scale (rational (expt 2d0 (- radius numerics-taylor-share))))))
            (< size 12))))

(defun numerics-taylor-radius (run)
  "The binary logarithm of the radius of convergence in units of the scale: the least of
(|x_i| + s_i)/|c_k| to the power 1/k for the last half of the coefficients c_k of each state.
Second, how many binary digits that coefficient has."
  (let* ((expansion (numerics-taylor-run-expansion run)) (least nil) (digits 0)
         (order (numerics-expansion-order expansion)))
    (loop for series in (numerics-expansion-states expansion)
          for scale in (numerics-taylor-run-scales run)
          for length = (integer-length (+ (abs (svref series 0)) scale))
          do (loop for k from (floor order 2) to order
                   for size = (integer-length (svref series k))
                   for radius = (/ (- length size) (float k 1d0))
                   do (when (or (null least) (< radius least)) (setq least radius digits size))))
    (values least digits)))

(defun numerics-before-corners (run step)
  "STEP, or what of it is free of corners."
  (let* ((expansion (numerics-taylor-run-expansion run)) (bits (numerics-expansion-bits expansion))
         (scale (numerics-expansion-scale expansion)))
    (flet ((free-p (series)
             (> (abs (svref series 0))
                (loop with share = (abs (floor (ash step bits) scale))
                      for power = share then (ash (* power share) (- bits))
                      for k from 1 below (numerics-expansion-order expansion)
                      sum (ash (* power (abs (svref series k))) (- bits))))))
      (loop for (text y . x) in (numerics-expansion-corners expansion)
            do (loop until (or (free-p y) (and x (plusp (svref x 0)) (free-p x)))
                     do (setq step (round step 2))
                        (when (numerics-taylor-too-short-p run step)
                          (numerics-series-fault text))))
      step)))

(defun numerics-taylor-too-short-p (run step)
  (< (abs step) (ash (numerics-taylor-run-span run) -40)))

(defun numerics-taylor-take-rows (run step scale)
  "The rows at the times that STEP passes."
  (let ((bits (numerics-taylor-bits run)) (moment (numerics-taylor-run-moment run)))
    (loop while (and (numerics-taylor-run-left run)
                     (<= (abs (- (first (numerics-taylor-run-left run)) moment)) (abs step)))
          do (let ((way (- (pop (numerics-taylor-run-left run)) moment)))
               (push (if (zerop way)
                         (numerics-taylor-run-states run)
                         (numerics-expansion-states-at (numerics-taylor-run-expansion run)
                                                       (floor (ash way bits) scale)))
                     (numerics-taylor-run-rows run))))))
