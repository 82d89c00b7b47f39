;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Rows of many digits by Taylor series. No bound of the error is computed: a result stands only
;;; where a second run, with other order, other steps and more bits, agrees with it to the digits
;;; that are wanted. The first run's steps are exact to 4 digits more, those of the next to 5 digits
;;; more again; where instability or cancellation costs more, runs with as many more follow.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem"
                "numerics/taylor_numbers" "numerics/taylor_expansion" "numerics/taylor_run"))

(defstruct (numerics-taylor-outcome (:include numerics-outcome))
  rows       ; lists (time . states) of bigfloats
  agreement) ; the digits to which two runs agree

(defun numerics-taylor (program start times digits &key scales (most-steps 1000000))
  "The states of PROGRAM, a numerics-program, at TIMES to DIGITS digits of |x_i| + s_i, SCALES being
the s_i or 1. START are the states at the first of TIMES; these and TIMES are exact numbers or
constants such as %pi/2. An outcome with rows."
  (let ((scales (or scales (mapcar (constantly 1) start))) (extra 4) (older nil))
    (loop repeat 6
          do (let* ((newer (numerics-taylor-run program start times scales (+ digits extra)
                                                most-steps))
                    (agreement (and older (numerics-taylor-agreement older newer))))
               (when (numerics-taylor-settled-p older newer agreement digits)
                 (return (numerics-taylor-accepted older newer agreement times digits)))
               (incf extra (numerics-taylor-more-digits newer agreement digits))
               (setq older newer))
          finally (return (numerics-taylor-refused older (first times) digits)))))

(defun numerics-taylor-more-digits (run agreement digits)
  "For the next run: far more where small numbers may have become 0."
  (cond ((numerics-taylor-run-status run) 40)
        (agreement (max 5 (ceiling (+ 5 (- digits agreement)))))
        (t 5)))

(defun numerics-taylor-agreement (older newer)
  "The least of the digits to which the rows of both agree, at most those of NEWER; nil where they
ended differently."
  (let ((shift (- (numerics-taylor-bits newer) (numerics-taylor-bits older)))
        (least (numerics-taylor-run-digits newer)))
    (and (= (length (numerics-taylor-run-rows older)) (length (numerics-taylor-run-rows newer)))
         (loop for a in (numerics-taylor-run-rows older)
               for b in (numerics-taylor-run-rows newer)
               do (loop for x in a
                        for y in b
                        for scale in (numerics-taylor-run-scales newer)
                        for difference = (abs (- (ash x shift) y))
                        unless (zerop difference)
                          do (setq least (min least (numerics-digits-of difference
                                                                        (+ (abs y) scale)))))
               finally (return least)))))

(defun numerics-digits-of (error whole)
  "-log10(error/whole) of whole numbers"
  (* (log 2d0 10) (- (numerics-binary-logarithm whole) (numerics-binary-logarithm error))))

(defun numerics-binary-logarithm (x)
  (let ((shift (max 0 (- (integer-length x) 53))))
    (+ shift (log (float (ash x (- shift)) 1d0) 2))))

(defun numerics-taylor-settled-p (older newer agreement digits)
  (let ((status (numerics-taylor-run-status newer)))
    (or (eq status :most-steps)
        (and older
             (eq status (numerics-taylor-run-status older))
             (if status
                 (numerics-taylor-same-end-p older newer)
                 (and agreement (>= agreement digits)))))))

(defun numerics-taylor-same-end-p (older newer)
  (let ((shift (- (numerics-taylor-bits newer) (numerics-taylor-bits older))))
    (< (abs (- (numerics-taylor-run-moment newer) (ash (numerics-taylor-run-moment older) shift)))
       (ash (numerics-taylor-run-span newer) -30))))

(defun numerics-taylor-accepted (older newer agreement times digits)
  (let ((status (numerics-taylor-run-status newer)) (agreed (and agreement (>= agreement digits))))
    (make-numerics-taylor-outcome
     :status (or status :end)
     :moment (numerics-moment (numerics-double-of-fixed (numerics-taylor-run-moment newer)
                                                        (numerics-taylor-bits newer)))
     :state (map 'numerics-vector
                 (lambda (x) (numerics-double-of-fixed x (numerics-taylor-bits newer)))
                 (numerics-taylor-run-states newer))
     :rows (and agreed (numerics-taylor-bigfloat-rows newer times digits agreement))
     :agreement agreement
     :about (if status
                (numerics-taylor-run-about newer)
                (numerics-taylor-words older newer agreement)))))

(defun numerics-taylor-refused (run start digits)
  (make-numerics-taylor-outcome
   :status :no-convergence
   :moment (let ((bits (numerics-taylor-bits run)))
             (numerics-moment (numerics-double-of-fixed (numerics-fixed start bits) bits)))
   :about (format nil "no two runs agree to ~d digits, the last one of order ~d" digits
                  (numerics-expansion-order (numerics-taylor-run-expansion run)))))

(defun numerics-taylor-words (older newer agreement)
  (flet ((order (run) (numerics-expansion-order (numerics-taylor-run-expansion run))))
    (format nil "Taylor series of order ~d in ~d steps and of order ~d in ~d steps agree to ~,1f ~
                 digits"
            (order older) (numerics-taylor-run-steps older)
            (order newer) (numerics-taylor-run-steps newer) agreement)))

(defun numerics-taylor-bigfloat-rows (run times digits agreement)
  "What lies beyond the AGREEMENT is no part of a number."
  (let* ((bits (numerics-taylor-bits run)) (share (expt 10 (floor agreement)))
         (units (mapcar (lambda (scale) (max 1 (round scale share)))
                        (numerics-taylor-run-scales run))))
    (loop for row in (reverse (numerics-taylor-run-rows run))
          for time in times
          collect (loop for x in (cons (numerics-fixed time bits) row)
                        for unit in (cons 1 units)
                        collect (numerics-bigfloat-of-fixed (* unit (round x unit)) bits digits)))))
