;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For the suites of methods of integration: problems from expressions in Maxima, and runs whose
;;; answer is a list that Maxima reads. Derivatives are Maxima's own.

(in-package :maxima)

;;; Functions of a moment and a state from expressions in t and the variables.

(defun test-code (e variables)
  "Lisp for the Maxima expression E in double-float numbers."
  (flet ((codes (list) (mapcar (lambda (part) (test-code part variables)) list)))
    (cond ((eq e '$t) '(+ (aref time 0) (aref time 1)))
          ((member e variables) `(aref x ,(position e variables)))
          ((eq (ratdisrep e) '$%pi) pi)
          ((numberp e) (coerce e 'double-float))
          ((atom e) (error "no number: ~a" e))
          (t (case (caar e)
               (rat (coerce (/ (second e) (third e)) 'double-float))
               (mplus `(+ ,@(codes (cdr e))))
               (mtimes `(* ,@(codes (cdr e))))
               (mexpt (test-power-code (second e) (third e) variables))
               (%sin `(sin ,@(codes (cdr e))))
               (%cos `(cos ,@(codes (cdr e))))
               (t (error "no code for ~a" (caar e))))))))

(defun test-power-code (base exponent variables)
  (flet ((code (e) (test-code e variables)))
    (cond ((eq base '$%e) `(numerics-elementary :exponential ,(code exponent)))
          ((not (integerp exponent))
           `(numerics-elementary :power ,(code base) ,(code exponent)))
          ((minusp exponent) `(numerics-quotient 1d0 (expt ,(code base) ,(- exponent))))
          (t `(expt ,(code base) ,exponent)))))

(defun test-function (expressions variables)
  "(time x out): the values of EXPRESSIONS into OUT."
  (let ((code `(lambda (time x out)
                 (declare (type (simple-array double-float (*)) time x out) (ignorable time x)
                          #+sbcl (sb-ext:muffle-conditions sb-ext:compiler-note))
                 ,@(loop for e in expressions
                         for i from 0
                         collect `(setf (aref out ,i) ,(test-code e variables)))
                 out)))
    #+sbcl (compile nil code)
    #-sbcl (coerce code 'function)))

(defun test-matrix (rows)
  "The numerics-matrix with the entries of ROWS, a Maxima list of rows, that are not 0."
  (let* ((n (length (cdr rows))) (columns (make-array n :initial-element '())) (values '()))
    (dotimes (j n)
      (loop for row in (cdr rows)
            for i from 0
            do (let ((entry (nth (1+ j) row)))
                 (unless (eql entry 0)
                   (push i (aref columns j))
                   (push (coerce ($float entry) 'double-float) values))))
      (setf (aref columns j) (nreverse (aref columns j))))
    (make-numerics-matrix :pattern (numerics-pattern-of-columns columns)
                          :values (coerce (nreverse values) 'numerics-vector))))

(defun $test_problem (variables rates &optional mass)
  "The problem MASS*variables' = RATES, with the Jacobian that Maxima finds."
  (let* ((variables (cdr variables)) (rates (cdr rates)) (n (length variables))
         (columns (make-array n :initial-element '())) (entries '()))
    (dotimes (j n)
      (loop for rate in rates
            for i from 0
            do (let ((slope ($diff rate (nth j variables))))
                 (unless (eql slope 0)
                   (push i (aref columns j))
                   (push slope entries))))
      (setf (aref columns j) (nreverse (aref columns j))))
    (make-numerics-problem :size n :rates (test-function rates variables)
                           :timed (not (every (lambda (rate) (freeof '$t rate)) rates))
                           :jacobian (test-function (nreverse entries) variables)
                           :pattern (numerics-pattern-of-columns columns)
                           :mass (and mass (test-matrix mass)) :names variables)))

;;; Runs.

(defun test-vector (list)
  (coerce (mapcar (lambda (e) (coerce ($float e) 'double-float)) (cdr list)) 'numerics-vector))

(defun test-list (&rest items) (cons '(mlist simp) items))

(defun test-numbers (vector) (cons '(mlist simp) (coerce vector 'list)))

(defun test-outcome (outcome counts)
  "[status, time, states, [rates, jacobians, factorisations, steps, rejected, not finite], about]"
  (test-list (intern (substitute #\_ #\- (format nil "$~a" (numerics-outcome-status outcome)))
                     :maxima)
             (aref (numerics-outcome-moment outcome) 0)
             (test-numbers (numerics-outcome-state outcome))
             (test-list (numerics-counts-rates counts) (numerics-counts-jacobians counts)
                        (numerics-counts-factorisations counts) (numerics-counts-steps counts)
                        (numerics-counts-rejected counts) (numerics-counts-not-finite counts))
             (or (numerics-outcome-about outcome) "")))

(defun test-controls (end tolerance settings)
  "TOLERANCE: r or [r, [a1, ..]]; SETTINGS: equations of Maxima, such as first_step = 1e-3."
  (let ((relative (if (numberp tolerance) tolerance (second tolerance)))
        (absolute (if (numberp tolerance) nil (third tolerance))))
    (apply #'make-numerics-controls
           :end (coerce ($float end) 'double-float) :relative relative
           :scales (if absolute
                       (map 'numerics-vector (lambda (a) (/ a relative)) (test-vector absolute))
                       (numerics-zeros 0))
           (flet ((word (symbol)
                    (intern (string-left-trim "$" (substitute #\- #\_ (symbol-name symbol)))
                            :keyword)))
             (loop for (nil key value) in settings
                   append (list (word key) (if (symbolp value) (word value) value)))))))

(defun test-run (method problem span start tolerance settings
                 &optional (observer (constantly nil)))
  (let ((controls (test-controls (car (last span)) tolerance settings)))
    (numerics-with-masked-traps
      (test-outcome (funcall method problem controls
                             (numerics-moment (coerce ($float (car (last span 2))) 'double-float))
                             (test-vector start) observer)
                    (numerics-controls-counts controls)))))
