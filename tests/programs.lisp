;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_linmodel_program_archives.mac: long expressions at a point, and programs that are wrong by one operation.

(in-package :maxima)

(defun test-at (e places)
  "E with the names and derivatives of PLACES ((name . number) ..) put in at once: one pass, where subst takes one for each name."
  (let ((place (if (or (symbolp e) (and (consp e) (eq (caar e) '%derivative)))
                   (assoc e places :test #'alike1))))
    (cond (place (cdr place))
          ((atom e) e)
          (t (simplifya (cons (list (caar e)) (mapcar (lambda (x) (test-at x places)) (cdr e))) t)))))

(defun $test_at (e point)
  ;; POINT is a list of equations
  (test-at e (mapcar (lambda (equation) (cons (cadr equation) (caddr equation))) (cdr point))))

(defun test-damaged-output (outputs output)
  "OUTPUTS with the last element of OUTPUT times 1 + 10^-20."
  (loop for (other . value) in outputs
        collect (cons other
                      (if (eq other output)
                          (test-damaged-value value)
                          value))))

(defun test-damaged-value (value)
  (flet ((damaged (list)
           (append (butlast list)
                   (list (algebra-program-multiply (1+ (expt 10 -20)) (car (last list)))))))
    (if (eq (car value) :list)
        (cons :list (damaged (cdr value)))
        (cons :matrix (append (butlast (cdr value)) (list (damaged (car (last value)))))))))

(defmspec $test_damaged (form)
  ;; test_damaged(output, e): the value of e while the output called OUTPUT is wrong in every program.
  (destructuring-bind (output e) (cdr form)
    (let ((check (symbol-function 'forms-check-program)))
      (setf (symbol-function 'forms-check-program)
            (lambda (task outputs judge)
              (funcall check task (test-damaged-output outputs output) judge)))
      (unwind-protect (meval e)
        (setf (symbol-function 'forms-check-program) check)))))
