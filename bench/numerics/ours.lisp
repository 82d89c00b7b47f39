;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For ours.mac: lines of the standard input, and what answers them:
;;;     open SCENE SIZE                         the names of the states, the start, and the span
;;;     SCENE METHOD TOLERANCE SCALE REPEATS    seconds of a run, evaluations, the state at its end
;;;     export SCENE FILE                       the rates in C
;;;     operations SCENE                        of the rates
;;; METHOD is one of Simulate; made-METHOD makes the program in the time, too, whole-METHOD does all
;;; that Simulate does, nothing kept from the call before; drift-METHOD gives the largest drift of
;;; the energy of the double pendulum in the place of the state; `rates' and `made' evaluate and make
;;; the program alone. Seconds are those of this process. Answers begin with the word bench.

(in-package :maxima)

(core-require "algebra/program_record" "numerics/native" "numerics/problem"
              "numerics/rates_problem" "numerics/dormand_prince" "numerics/radau" "numerics/gauss"
              "numerics/jacobian" "numerics/program" "archive/derived")

(defvar *bench-scenes* (make-hash-table :test #'equal))

(defstruct bench-scene system record names start span state times problem)

(defun bench-doubles (list)
  (map 'numerics-vector (lambda (e) (coerce ($float e) 'double-float)) (cdr list)))

(defun bench-answer (format &rest arguments)
  (format t "~&bench ~?~%" format arguments)
  (finish-output))

(defun bench-words (line)
  (loop with start = 0
        for end = (position #\Space line :start start)
        for word = (subseq line start end)
        when (plusp (length word)) collect word
        while end
        do (setq start (1+ end))))

(defun bench-number (word) (with-standard-io-syntax
                             (let ((*read-default-float-format* 'double-float))
                               (coerce (read-from-string word) 'double-float))))

;;; Scenes

(defun bench-open (name size)
  (destructuring-bind (system start span)
      (cdr (mfuncall '$bench_scene name
                     (if (find #\. size) (bench-number size) (parse-integer size))))
    (let* ((record (mfuncall '$bench_program_of system))
           (scene (make-bench-scene :system system :record record :start start :span span
                                    :state (bench-doubles start)
                                    :times (bench-doubles (cdr span))
                                    :names (algebra-record-part record '$states))))
      (setf (gethash name *bench-scenes*) scene
            (bench-scene-problem scene) (bench-problem scene t))
      (bench-answer "~{~a ~}; ~{~a ~}; ~{~a ~}" 
                    (mapcar (lambda (e) (remove #\Space (core-words (list e))))
                            (cdr (bench-scene-names scene)))
                    (coerce (bench-scene-state scene) 'list)
                    (coerce (bench-scene-times scene) 'list)))))

(defun bench-problem (scene jacobian)
  (numerics-problem-of-program (bench-scene-record scene) nil :jacobian jacobian :how :compiled))

;;; Runs

(defparameter *bench-methods*
  '(("dop853" . numerics-dopri) ("radau" . numerics-radau) ("gauss" . numerics-gauss)))

(defun bench-time (scene place)
  "The begin of its span, place 0, or the end, 1."
  (aref (bench-scene-times scene) place))

(defun bench-moment (scene) (numerics-moment (bench-time scene 0)))

(defun bench-method-run (scene problem method tolerance scale &optional (observer (constantly nil)))
  "The outcome and the counts."
  (let* ((start (bench-scene-state scene))
         (controls (make-numerics-controls
                    :end (bench-time scene 1)
                    :relative tolerance
                    :scales (make-array (length start) :element-type 'double-float
                                                       :initial-element scale))))
    (values (numerics-with-masked-traps
              (funcall (cdr (assoc method *bench-methods* :test #'string=)) problem controls
                       (bench-moment scene) start observer))
            (numerics-controls-counts controls))))

(defun bench-prefix (prefix word)
  "What stands after PREFIX in WORD, or nil."
  (and (> (length word) (length prefix)) (string= prefix word :end2 (length prefix))
       (subseq word (length prefix))))

(defun bench-whole (scene method tolerance)
  (setq *archive-kept* '())
  (cons 0 (cddar (last (mfuncall '$bench_whole (bench-scene-system scene) (bench-scene-names scene)
                                 (bench-scene-start scene) (bench-scene-span scene) method
                                 tolerance)))))

(defun bench-run (scene method tolerance scale)
  "Evaluations and the state at the end; nil where the run does not come there."
  (let ((whole (bench-prefix "whole-" method)) (made (bench-prefix "made-" method)))
    (if whole
        (bench-whole scene (intern (string-upcase (format nil "$~a" whole)) :maxima) tolerance)
        (multiple-value-bind (outcome counts)
            (bench-method-run scene (if made
                                        (bench-problem scene (string= made "radau"))
                                        (bench-scene-problem scene))
                              (or made method) tolerance scale)
          (and (eq (numerics-outcome-status outcome) :end)
               (cons (numerics-counts-rates counts)
                     (coerce (numerics-outcome-state outcome) 'list)))))))

(defun bench-repeat (repeats function)
  "Answers with the seconds of each of REPEATS calls of FUNCTION, and with what it gives."
  (let* ((begin (bench-now)) (values nil))
    (loop repeat repeats do (setq values (funcall function)))
    (let ((seconds (/ (- (bench-now) begin) repeats)))
      (bench-answer "~,,,,,,'eE ~{~a ~}" (if values seconds -1d0) values))))

(defun bench-now ()
  "Seconds of this process."
  (/ (get-internal-run-time) (float internal-time-units-per-second 1d0)))

(defun bench-call-rates (scene calls)
  (let* ((state (bench-scene-state scene)) (out (numerics-zeros (length state)))
         (moment (bench-moment scene)) (begin (bench-now)))
    (numerics-with-masked-traps
      (bench-call-lisp (numerics-problem-rates (bench-scene-problem scene)) moment state out calls))
    (bench-answer "~,,,,,,'eE ~d ~{~a ~}" (/ (- (bench-now) begin) calls) calls
                  (coerce out 'list))))

;;; The energy of the double pendulum

(defun bench-energy (x)
  "T + U, and T + |U|."
  (let ((kinetic (+ (expt (aref x 2) 2) (/ (expt (aref x 3) 2) 2)
                    (* (aref x 2) (aref x 3) (cos (- (aref x 0) (aref x 1))))))
        (potential (* -9.81d0 (+ (* 2 (cos (aref x 0))) (cos (aref x 1))))))
    (values (+ kinetic potential) (+ kinetic (abs potential)))))

(defun bench-drift (scene method tolerance scale)
  "max |E - E0|/max(|E0|, T + |U|)"
  (let* ((first (bench-energy (bench-scene-state scene))) (drift 0d0)
         (size (abs first)))
    (bench-method-run scene (bench-scene-problem scene) method tolerance scale
                      (lambda (step)
                        (multiple-value-bind (energy magnitude)
                            (bench-energy (numerics-step-after step))
                          (setq drift (max drift (abs (- energy first)))
                                size (max size magnitude))
                          nil)))
    (bench-answer "0 0 ~,,,,,,'eE" (/ drift size))))

;;; Lines

(defun bench-obey (words)
  (destructuring-bind (first second &optional third fourth fifth) words
    (let ((scene (gethash (if (member first '("export" "operations") :test #'string=) second first)
                          *bench-scenes*)))
      (cond ((string= first "open") (bench-open second third))
            ((string= first "export")
             ($algebra_export (bench-rates-alone (bench-scene-record scene)) third '$c t)
             (bench-answer "done"))
            ((string= first "operations")
             (bench-answer "~d" (numerics-count-operations
                                 (numerics-program-rates
                                  (numerics-problem-program (bench-scene-problem scene))))))
            ((string= second "rates") (bench-call-rates scene (parse-integer fifth)))
            ((string= second "made")
             (bench-repeat (parse-integer fifth)
                           (lambda () (bench-problem scene nil) (list 0))))
            ((bench-prefix "drift-" second)
             (bench-drift scene (bench-prefix "drift-" second) (bench-number third)
                          (bench-number fourth)))
            (t (bench-repeat (parse-integer fifth)
                             (lambda ()
                               (bench-run scene second (bench-number third)
                                          (bench-number fourth)))))))))

(defun $bench_serve ()
  (loop for line = (read-line *standard-input* nil)
        while line
        do (bench-obey (bench-words line)))
  '$done)
