;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_radau.mac and rtest_numerics_stiff.mac.

(in-package :maxima)

(defun $test_radau (problem span start tolerance &rest settings)
  (test-run 'numerics-radau problem span start tolerance settings))

(defun $test_radau_number (name)
  "The coefficient NAME as its decimals write it."
  (let* ((text (second (assoc name *numerics-radau-decimals*
                              :test (lambda (a b) (string-equal (string-left-trim "$" a) b)))))
         (digits (remove #\. text)) (point (position #\. text)))
    (div (parse-integer digits) (expt 10 (- (length text) point 1)))))

;;; What an observer sees.

(defun test-value (function &rest arguments)
  (coerce ($float (apply #'mfuncall function arguments)) 'double-float))

(defun test-moment (moment) (+ (aref moment 0) (aref moment 1)))

(defun test-share-of (step share)
  (let ((from (test-moment (numerics-step-from step))) (to (test-moment (numerics-step-to step))))
    (+ from (* share (- to from)))))

(defun $test_radau_between (problem span start tolerance exact &rest settings)
  "[largest error of the dense output, that at the ends of steps, largest misfit of the dense
output at both ends of a step]: EXACT is the first state as a function of the time."
  (let ((between 0) (at-ends 0) (misfit 0) (out (numerics-zeros (length (cdr start)))))
    (flet ((error-at (step share value)
             (abs (- value (test-value exact (test-share-of step share))))))
      (test-run 'numerics-radau problem span start tolerance settings
                (lambda (step)
                  (setq at-ends (max at-ends
                                     (error-at step 1d0 (aref (numerics-step-after step) 0))))
                  (loop for share from 0d0 to 1d0 by 0.125d0
                        do (funcall (numerics-step-interpolate step) share out)
                           (setq between (max between (error-at step share (aref out 0)))))
                  (loop for (share state) in (list (list 0d0 (numerics-step-before step))
                                                   (list 1d0 (numerics-step-after step)))
                        do (funcall (numerics-step-interpolate step) share out)
                           (map nil (lambda (x y) (setq misfit (max misfit (abs (- x y)))))
                                out state))
                  nil))
      (test-list between at-ends misfit))))

(defun $test_radau_local_error (problem span start tolerance flow)
  "The largest error of a step from where it begins, over the tolerance; FLOW(t, h, x) is exact."
  (let ((largest 0))
    (test-run 'numerics-radau problem span start tolerance '()
              (lambda (step)
                (let* ((time (test-moment (numerics-step-from step)))
                       (exact (mfuncall flow time (- (test-moment (numerics-step-to step)) time)
                                        (cons '(mlist simp)
                                              (coerce (numerics-step-before step) 'list)))))
                  (loop for x across (numerics-step-after step)
                        for e in (cdr ($float exact))
                        do (setq largest (max largest (/ (abs (- x e)) (1+ (abs e))))))
                  nil)))
    (/ largest tolerance)))

(defun $test_radau_stopped (problem span start tolerance place)
  "The run, where the first state stops it above PLACE."
  (test-run 'numerics-radau problem span start tolerance '()
            (lambda (step) (if (> (aref (numerics-step-after step) 0) place) :stop nil))))

(defun $test_radau_changed (problem span start tolerance radius)
  "The run, where each state is put back to RADIUS, and its largest radius before."
  (let ((largest 0))
    (test-list
     (test-run 'numerics-radau problem span start tolerance '()
               (lambda (step)
                 (let* ((after (numerics-step-after step))
                        (now (sqrt (reduce #'+ (map 'list (lambda (x) (* x x)) after)))))
                   (setq largest (max largest (abs (- now radius))))
                   (map-into after (lambda (x) (* x (/ radius now))) after)
                   :changed)))
     largest)))

(defun $test_radau_consed (problem span start tolerance)
  "Bytes for each step of a long run, where Lisp counts them."
  #-sbcl (progn problem span start tolerance 0)
  #+sbcl
  (let* ((controls (test-controls (car (last span)) tolerance '()))
         (moment (numerics-moment 0d0)) (state (test-vector start))
         (before (sb-ext:get-bytes-consed)))
    (numerics-with-masked-traps
      (numerics-radau problem controls moment state (constantly nil)))
    (/ (- (sb-ext:get-bytes-consed) before)
       (coerce (numerics-counts-steps (numerics-controls-counts controls)) 'double-float))))

;;; A line of N resistors, with capacitors of three sizes, that a step of voltage meets.

(defun test-line-pattern (n)
  (let ((columns (make-array n)))
    (dotimes (j n (numerics-pattern-of-columns columns))
      (setf (aref columns j) (loop for i from (max 0 (1- j)) to (min (1- n) (1+ j)) collect i)))))

(defun test-line-rates (n)
  (lambda (time x out)
    (declare (ignore time) (type (simple-array double-float (*)) x out))
    (dotimes (i n out)
      (setf (aref out i)
            (- (if (= i (1- n)) 0d0 (aref x (1+ i)))
               (* (if (= i (1- n)) 1d0 2d0) (aref x i))
               (if (= i 0) -1d0 (- (aref x (1- i)))))))))

(defun test-line-jacobian (pattern)
  (let ((values (numerics-zeros (length (numerics-pattern-rows pattern))))
        (last (1- (numerics-pattern-size pattern))))
    (loop for i across (numerics-pattern-rows pattern)
          for j across (numerics-column-numbers pattern)
          for k from 0
          do (setf (aref values k) (cond ((/= i j) 1d0) ((= i last) -1d0) (t -2d0))))
    (lambda (time x entries) (declare (ignore time x)) (replace entries values))))

(defun test-line-mass (n)
  (let ((mass (numerics-identity n)))
    (dotimes (i n mass)
      (setf (aref (numerics-matrix-values mass) i) (aref #(1d0 1d-3 1d-6) (mod i 3))))))

(defun $test_line (n end tolerance without)
  "The run of a line, WITHOUT KLU or with it where it is there."
  (let ((pattern (test-line-pattern n)) (*numerics-klu* (if without nil (numerics-find-klu))))
    (test-run 'numerics-radau
              (make-numerics-problem :size n :rates (test-line-rates n) :pattern pattern
                                     :jacobian (test-line-jacobian pattern)
                                     :mass (test-line-mass n))
              (test-list 0 end) (cons '(mlist simp) (make-list n :initial-element 0))
              tolerance '())))
