;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_dlsode.mac, with numerics_problems.lisp.

(in-package :maxima)

(defun test-dlsode-with (flag)
  (lambda (problem controls moment state observer)
    (numerics-dlsode problem controls moment state observer :method-flag flag)))

(defun $test_dlsode (flag problem span start tolerance &rest settings)
  "FLAG false is that of the method's own choice."
  (test-run (test-dlsode-with flag) problem span start tolerance settings))

(defun $test_dlsode_between (flag problem span start tolerance exact)
  "The largest distances of the first state to EXACT, a function of the time: between the ends of
steps, and there."
  (let ((between 0d0) (at-ends 0d0) (out (numerics-zeros (length (cdr start)))))
    (test-run (test-dlsode-with flag) problem span start tolerance '()
              (lambda (step)
                (loop with from = (aref (numerics-step-from step) 0)
                      for share from 0d0 to 1d0 by 0.125d0
                      for time = (+ from (* share (- (aref (numerics-step-to step) 0) from)))
                      for right = ($float (mfuncall exact time))
                      do (funcall (numerics-step-interpolate step) share out)
                         (setq between (max between (abs (- (aref out 0) right))))
                         (when (= share 1)
                           (let ((x (aref (numerics-step-after step) 0)))
                             (setq at-ends (max at-ends (abs (- x right)))))))
                nil))
    (test-list between at-ends)))

(defun $test_dlsode_observed (problem span start tolerance number answer)
  "The run whose observer doubles the states after the step NUMBER and says ANSWER."
  (let ((seen 0))
    (test-run #'numerics-dlsode problem span start tolerance '()
              (lambda (step)
                (when (= (incf seen) number)
                  (map-into (numerics-step-after step) (lambda (x) (* 2 x))
                            (numerics-step-after step))
                  (if (eq answer '$stop) :stop :changed))))))

(defun $test_dlsode_printed (flag problem span start tolerance)
  "What such a run writes on the terminal."
  (let ((stream (make-string-output-stream)))
    #+sbcl
    (let ((sb-sys:*stdout* stream) (*standard-output* stream))
      ($test_dlsode flag problem span start tolerance))
    #-sbcl
    (let ((*standard-output* stream)) ($test_dlsode flag problem span start tolerance))
    (get-output-stream-string stream)))

(defun $test_dlsode_switch ()
  "Whether dlsode writes messages for others."
  (funcall (numerics-odepack "IXSAV") 2 0 nil))
