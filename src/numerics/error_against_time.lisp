;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; ErrorAgainstTime: for a system of one's own what each method reaches at each tolerance, and what
;;; it costs; errors are those that were made, by a reference, never the tolerance (diagrams of work
;;; and precision: E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I,
;;; II.10). Look first at $numerics_error_against_time.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_record" "core/nearest" "forms/rates" "numerics/decimals"
                "numerics/problem" "numerics/reference" "numerics/run" "numerics/run_course"
                "numerics/run_options" "numerics/run_report" "numerics/trial"
                "numerics/trial_attempts" "numerics/trial_reference"))

(defparameter *numerics-row-columns*
  '($method $tolerance $error $largest $digits $drifts $rhs $jacobians $factorisations $steps
    $rejected $seconds $derivation_seconds $compile_seconds $status $quartiles))

;;; What is asked for

(defun numerics-read-methods (methods)
  "The list of symbols in the option METHODS."
  (let ((words (mapcar #'car *numerics-methods*)) (items (numerics-items methods)))
    (unless items
      (core-error "methods is a list such as [dop853, radau], found ~a"
                  (core-words (list methods))))
    (dolist (item items (remove-duplicates items :from-end t))
      (unless (member item words)
        (let ((spellings (mapcar #'core-spelling words)) (found (core-words (list item))))
          (core-error "a method is ~a, found ~:[~a~;\"~a\"~]~@[; did you mean ~a?~]"
                      (core-choice spellings) (stringp item) found
                      (core-nearest found spellings)))))))

(defun numerics-read-tolerances (tolerances trial)
  "The list TOLERANCES from the loosest to the tightest."
  (let ((items (numerics-items tolerances))
        (names (forms-rates-states (numerics-simulation-rates (numerics-trial-run trial)))))
    (unless items
      (core-error "tolerances is a list such as [1e-4, 1e-8], found ~a"
                  (core-words (list tolerances))))
    (flet ((relative (item)
             (numerics-refuse-tight-tolerance item)
             (values (numerics-read-tolerance item names))))
      (remove-duplicates
       (mapcar (lambda (pair) (numerics-tolerance-as-told (rest pair)))
               (stable-sort (mapcar (lambda (item) (cons (relative item) item)) items) #'>
                            :key #'first))
       :test #'equal :from-end t))))

(defun numerics-refuse-tight-tolerance (tolerance)
  "Here there are no digits to advise, as numerics-check-tolerance does."
  (let ((relative (if (numerics-items tolerance) (second tolerance) tolerance)))
    (when (and (mnump relative)
               (< (numerics-double relative "tolerance") *numerics-least-tolerance*))
      (core-error "a tolerance of ~a is below 1e-13, what double-float numbers can keep"
                  (numerics-short-number (numerics-double relative "tolerance"))))))

(defun numerics-read-cell (seconds)
  (let ((number (numerics-double seconds "cell")))
    (unless (> number 0d0)
      (core-error "cell is the number of seconds that a method may take at a tolerance, found ~a"
                  (core-words (list seconds))))
    number))

;;; The attempts

(defun numerics-tolerance-as-told (tolerance)
  "TOLERANCE with double-float numbers."
  (if (mnump tolerance)
      (numerics-double tolerance "tolerance")
      (cons '(mlist simp) (mapcar #'numerics-tolerance-as-told (cdr tolerance)))))

(defun numerics-tolerance-text (tolerance)
  "TOLERANCE as a person writes it."
  (if (numberp tolerance)
      (numerics-short-number tolerance)
      (format nil "[~{~a~^, ~}]" (mapcar #'numerics-tolerance-text (cdr tolerance)))))

(defun numerics-skipped-attempt (method tolerance failed)
  "The attempt after FAILED, one of the same method at a looser tolerance."
  (make-numerics-attempt
   :method method :tolerance tolerance
   :status (format nil "skipped: it failed at ~a"
                   (numerics-tolerance-text (numerics-attempt-tolerance failed)))))

(defun numerics-attempts-by (contest method note)
  "Measures METHOD at all tolerances, and calls NOTE with each attempt; what is tighter than a
tolerance at which it failed is skipped."
  (let ((failed nil))
    (dolist (tolerance (numerics-contest-tolerances contest))
      (core-progress "~a at ~a" (core-spelling method) (numerics-tolerance-text tolerance))
      (let ((attempt (if failed
                         (numerics-skipped-attempt method tolerance failed)
                         (numerics-measured-attempt contest method tolerance))))
        (unless (or failed (numerics-attempt-reached attempt)) (setq failed attempt))
        (funcall note attempt)
        (when (numerics-attempt-interrupted attempt) (throw 'numerics-interrupted nil))))))

(defun numerics-all-attempts (contest)
  "Two values: the attempts, and the sentence of the stop where the time was up or the person
interrupted."
  (let ((attempts '()) (stop nil))
    (multiple-value-bind (value late)
        (numerics-within-share
         (lambda ()
           (catch 'numerics-interrupted
             (dolist (method (numerics-contest-methods contest) t)
               (numerics-attempts-by contest method
                                     (lambda (attempt) (push attempt attempts)))))))
      (setq stop (or late (and (null value) "interrupted"))))
    (values (reverse attempts) stop)))

;;; The record

(defun numerics-attempt-counts (attempt)
  "rhs, jacobians, factorisations, steps, rejected"
  (let ((run (numerics-attempt-run attempt)))
    (if run
        (let ((counts (numerics-controls-counts (numerics-simulation-controls run))))
          (list (numerics-counts-rates counts) (numerics-counts-jacobians counts)
                (numerics-counts-factorisations counts) (numerics-counts-steps counts)
                (+ (numerics-counts-rejected counts) (numerics-counts-not-finite counts))))
        (list nil nil nil nil nil))))

(defun numerics-digits-of-error (error)
  (and error (/ (round (* -10 (log (max error 1d-17) 10))) 10d0)))

(defun numerics-attempt-row (contest attempt)
  "The row of ATTEMPT, in the order of the columns."
  (let* ((trial (numerics-contest-trial contest)) (error (numerics-attempt-error attempt))
         (seconds (numerics-attempt-seconds attempt)))
    (flet ((few (x) (and x (numerics-few-digits x)))
           (quartile (share) (and seconds (numerics-few-digits
                                           (max 0d0 (numerics-quantile seconds share))))))
      (apply #'algebra-list
             (append (list (numerics-attempt-method attempt)
                           (numerics-attempt-tolerance attempt) (few error)
                           (few (numerics-attempt-largest attempt)) (numerics-digits-of-error error)
                           (cons '(mlist simp)
                                 (loop for (name . drift) in (numerics-attempt-drifts attempt)
                                       collect (algebra-field name (few drift)))))
                     (numerics-attempt-counts attempt)
                     (list (quartile 1/2)
                           (numerics-rounded-seconds (numerics-trial-derivation-seconds trial))
                           (numerics-rounded-seconds (numerics-trial-compile-seconds trial))
                           (numerics-attempt-words attempt (numerics-contest-floor contest))
                           (algebra-list (quartile 1/4) (quartile 3/4))))))))

(defun numerics-attempt-words (attempt floor)
  "How ATTEMPT ended, and whether its error says more than the FLOOR of the reference."
  (let ((error (numerics-attempt-error attempt)))
    (cond ((null (numerics-attempt-reached attempt)) (numerics-attempt-status attempt))
          ((null error) "reached the end; no reference")
          ((<= error floor) "reached the end; below the floor of the reference")
          ((null (numerics-attempt-largest attempt))
           "reached the end; the 100 points were not looked at")
          (t "reached the end"))))

(defun numerics-machine-text ()
  "Where seconds were measured."
  (format nil "~a ~a~@[, ~a~]" (lisp-implementation-type) (lisp-implementation-version)
          (machine-version)))

(defun numerics-told-reference (contest)
  (let ((reference (numerics-contest-reference contest)) (floor (numerics-contest-floor contest)))
    (algebra-list (algebra-field '$method (numerics-reference-method reference))
                  (algebra-field '$digits (numerics-reference-digits reference))
                  (algebra-field '$floor (and floor (numerics-few-digits floor))))))

(defun numerics-untold-texts (attempts)
  "Which integrals have no drift by which method, and why."
  (remove-duplicates
   (loop for attempt in attempts
         for method = (core-spelling (numerics-attempt-method attempt))
         append (loop for text in (numerics-attempt-untold attempt)
                      collect (format nil "~a, ~a" method text)))
   :test #'string= :from-end t))

(defun numerics-told-run (contest attempts left-out)
  "What an archive says beside the record: where seconds were measured, and why drifts and, in
LEFT-OUT, the conditioning are not there."
  (let ((untold (numerics-untold-texts attempts)))
    (apply #'algebra-list
           (append (list (algebra-field '$machine (numerics-machine-text))
                         (algebra-field '$cell (numerics-contest-seconds contest)))
                   (and untold (list (algebra-field '$untold (cons '(mlist simp) untold))))
                   (and left-out (list (algebra-field '$conditioning left-out)))))))

(defun numerics-told-contest (contest)
  "The record of CONTEST, all attempts made; that of those so far where it is stopped."
  (let ((began (core-clock)))
    (multiple-value-bind (attempts stop) (numerics-all-attempts contest)
      (when stop (core-partial "~a; the rows so far are kept as a part" stop))
      (multiple-value-bind (conditioning left-out)
          (numerics-conditioning-within (- (core-clock) began) (numerics-contest-trial contest))
        (core-report "run" (numerics-told-run contest attempts left-out))
        (algebra-list
         (algebra-field '$reference (numerics-told-reference contest))
         (algebra-field '$conditioning (and conditioning (numerics-few-digits conditioning)))
         (algebra-field '$columns (cons '(mlist simp) *numerics-row-columns*))
         (algebra-field '$rows
                        (cons '(mlist simp)
                              (mapcar (lambda (attempt) (numerics-attempt-row contest attempt))
                                      attempts))))))))

;;; For Maxima

(defun $numerics_contest (trial methods tolerances seconds)
  "What METHODS and TOLERANCES are tried on TRIAL, each for so many SECONDS."
  (let ((tolerances (numerics-read-tolerances tolerances trial)))
    (make-numerics-contest :trial trial :methods (numerics-read-methods methods)
                           :tolerances tolerances :seconds (numerics-read-cell seconds)
                           :scales (numerics-trial-scales trial (first tolerances)))))

(defun $numerics_error_against_time (contest reference)
  "The record of CONTEST against REFERENCE, as $numerics_reference_solution makes it."
  (let ((copy (copy-numerics-contest contest)) (reference (numerics-read-reference reference)))
    (setf (numerics-contest-reference copy) reference
          (numerics-contest-floor copy)
          (and (numerics-reference-rows reference)
               (numerics-reference-floor reference (numerics-contest-scales contest))))
    (numerics-told-contest copy)))
