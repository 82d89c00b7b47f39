;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The law of the watch: a call that is stopped at any moment leaves the session as it was, no
;;; timer, and its archive either as it was, byte for byte, or as the whole call leaves it. Called
;;; by tests/rtest_core_watch.mac and, with more cases, by tools/fuzz. Look first at $fuzz_watch.

(in-package :maxima)

(core-require "archive/bytes")
(load (core-pathname ($core_path "tests/fuzz_archive.lisp")))
(load (core-pathname ($core_path "tests/snapshot.lisp")))

(defparameter *fuzz-watch-calls*
  '(("Lagrangian" "gyroscope" "coupled_pendulums" "robot_arm")
    ("LagrangeEquations" "spherical_pendulum" "satellite_rotor" "four_bar_linkage"
     "chaplygin_sleigh")
    ("HamiltonEquations" "spherical_pendulum" "satellite_rotor" "reaction_wheel")
    ("RouthEquations" "spherical_pendulum" "gyroscope" "heavy_gyrostat")
    ("FirstIntegrals" "spherical_pendulum" "coupled_pendulums" "rolling_disk")
    ("EulerPoisson" "heavy_gyrostat" "satellite_gyrodyne")
    ("StateEquations" "nonlinear_circuit" "equilibria")
    ("Equilibria" "equilibria" "heavy_gyrostat" "gyroscope")
    ("Stability" "equilibria" "coupled_pendulums" "zieglers_column"))
  "Functions and the archives of examples on which they are called.")

(defvar *fuzz-watch-whole* (make-hash-table :test #'equal)
  "Function and archive -> the bytes that the whole call leaves.")

(defun fuzz-watch-path ()
  "A file of this process."
  (format nil "~a/dynarch-watch-~d.txt" $maxima_tempdir (core-process-id)))

(defun fuzz-watch-copied (example path)
  "The bytes of EXAMPLE, copied into the file PATH."
  (let ((bytes (archive-file-bytes ($core_path (format nil "examples/~a.txt" example)))))
    (with-open-file (out (core-pathname path) :direction :output
                         :element-type '(unsigned-byte 8) :if-exists :supersede)
      (write-sequence bytes out))
    bytes))

;; Endless(e), a public function for tests, works for ever where every error is caught

(defun $fuzz_watch_endless (e)
  (loop (core-attempt
         (lambda ()
           (ignore-errors (meval (list '($errcatch) (list '($expand) (power e 20)))))
           (merror "nobody sees this")))))

(core-public "Endless" :forms '(("expressions" "body")))
(setf (gethash "core/endless" *core-loaded*) t)
(core-rule "Endless" :any "core/endless" "fuzz_watch_endless" "body")
(core-install "Endless")

(defun fuzz-watch-said (function)
  "What is written to the terminal while the Maxima FUNCTION runs."
  (with-output-to-string (*standard-output*) (mfuncall function)))

(defun fuzz-watch-person (seconds)
  "A person who thinks for SECONDS."
  (core-waiting (lambda () (sleep seconds))))

(defun fuzz-watch-load (depth seconds)
  "What loads a part that loads others, DEPTH of them in each other, the innermost for SECONDS."
  (core-unhurried (lambda ()
                    (if (= depth 1) (sleep seconds) (fuzz-watch-load (1- depth) seconds)))))

(defun fuzz-watch-growth (depth seconds)
  "How many seconds more the call has left after such a load."
  (let ((left (core-seconds-left)))
    (fuzz-watch-load depth seconds)
    (coerce (- (core-seconds-left) left) 'double-float)))

(defun fuzz-watch-call (function &optional limit)
  "Calls FUNCTION on the file of this process; what it says goes nowhere."
  (let ((*standard-output* (make-broadcast-stream)))
    (core-attempt
     (lambda ()
       (apply (core-symbol function) (fuzz-watch-path)
              (when limit (list (list '(mequal) '$limit (fuzz-watch-seconds limit)))))))))

(defun fuzz-watch-seconds (milliseconds)
  (div milliseconds 1000))

(defun fuzz-watch-whole (function example)
  "The bytes that the archive has after a call without a stop."
  (or (gethash (cons function example) *fuzz-watch-whole*)
      (progn
        (fuzz-watch-copied example (fuzz-watch-path))
        (fuzz-watch-call function)
        (setf (gethash (cons function example) *fuzz-watch-whole*)
              (archive-file-bytes (fuzz-watch-path))))))

(defun fuzz-watch-timers ()
  "What is left of the watch."
  #+sbcl (append (sb-ext:list-all-timers)
                 (remove 'core-after-collection sb-ext:*after-gc-hooks* :test-not #'eq))
  #-sbcl '())

(defun fuzz-watch-trouble (function example limit)
  "What a stop after LIMIT milliseconds leaves behind, or nil."
  (let* ((whole (fuzz-watch-whole function example))
         (old (fuzz-watch-copied example (fuzz-watch-path)))
         (before ($snapshot)) (lists (list bindlist mspeclist loclist)))
    (fuzz-watch-call function limit)
    (let ((new (archive-file-bytes (fuzz-watch-path)))
          (left (cdr ($snapshot_difference before ($snapshot)))))
      (cond (left (list "session" left))
            ((notevery #'eq lists (list bindlist mspeclist loclist)) (list "bindings"))
            ((fuzz-watch-timers) (list "timer"))
            ((not (or (equalp new old) (equalp new whole))) (list "archive"))))))

(defun fuzz-watch-case ()
  (let* ((row (fuzz-choice *fuzz-watch-calls*))
         (function (first row)) (example (fuzz-choice (rest row)))
         (limit (1+ (fuzz-random (fuzz-choice '(5 50 250)))))
         (trouble (fuzz-watch-trouble function example limit)))
    (when trouble
      (list (format nil "~a of ~a stopped after ~d ms: ~{~a~^ ~}" function example limit
                    trouble)))))

(defun fuzz-watch-in-a-session (function)
  "Calls FUNCTION while the session has facts in two contexts, a declaration and a dependency."
  (unwind-protect
       (progn
         (meval '(($declare) $fuzz_n $integer))
         (meval '(($depends) $fuzz_y $t))
         (with-new-context ()
           (mfuncall '$assume '((mgreaterp) $fuzz_a 3))
           (with-new-context ()
             (mfuncall '$assume '((mgreaterp) $fuzz_b $fuzz_a) '((mgreaterp) $m 2))
             (funcall function))))
    (meval '(($remove) $fuzz_n $integer))
    (meval '(($remove) $fuzz_y $dependency))))

(defun $fuzz_watch (count seed)
  "COUNT random calls, stopped at random moments; a list of what went wrong."
  (let ((*fuzz-state* seed))
    (unwind-protect
         (cons '(mlist simp)
               (fuzz-watch-in-a-session (lambda () (loop repeat count append (fuzz-watch-case)))))
      (when (core-existing-file (fuzz-watch-path))
        (delete-file (core-pathname (fuzz-watch-path)))))))
