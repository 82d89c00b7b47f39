;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The first integrals of a run, as the rates have them, looked at after each step: what has a
;;; value at its start. A power is integrated only where the states between two steps cost little.
;;; See numerics-watch-integrals first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_nodes" "forms/program_judge" "forms/rates" "forms/value"
                "numerics/drifts" "numerics/native" "numerics/problem" "numerics/program"
                "numerics/routine" "numerics/run" "numerics/run_options"))

(defparameter *numerics-states-of-balances* 40
  "Explicit methods with more states would take as long for the states between their steps as for
these.")

(defun numerics-watch-integrals (run)
  "RUN looks at the drifts of those integrals that it can tell."
  (let ((integrals (numerics-told-integrals run)))
    (when integrals
      (setf (numerics-simulation-drifting run) (mapcar #'forms-first-integral-name integrals)
            (numerics-simulation-drifts run)
            (numerics-drifts-of-integrals run integrals)))))

(defun numerics-drifts-of-integrals (run integrals)
  (let ((powers (mapcar #'forms-first-integral-power integrals))
        (values (numerics-integral-routine
                 run (append (mapcar #'forms-first-integral-value integrals)
                             (mapcar #'forms-first-integral-size integrals)))))
    (numerics-with-masked-traps
      (numerics-new-drifts values
                           (unless (every (lambda (power) (eql power 0)) powers)
                             (numerics-integral-routine run powers))
                           (length integrals) (numerics-simulation-moment run)
                           (numerics-simulation-state run)))))

(defun numerics-told-integrals (run)
  "Those of the rates of RUN that it can tell."
  (let ((rates (numerics-simulation-rates run)))
    (setf (numerics-simulation-untold run) (forms-rates-untold rates))
    (remove-if-not (lambda (integral) (numerics-told-p run integral))
                   (mapcar #'numerics-settled-integral (forms-rates-integrals rates)))))

(defun numerics-settled-integral (integral)
  "INTEGRAL without a power that vanishes, or under the name of a balance."
  (destructuring-bind (name value size power) integral
    (if (forms-nought-p (list power) (forms-new-point t))
        (forms-first-integral name value size)
        (forms-first-integral (core-symbol (format nil "~a_balance" (core-spelling name)))
                              value size power))))

(defun numerics-integral-routine (run elements)
  (let ((program (numerics-simulation-program run)))
    (with-numerics-program program (numerics-routine program elements))))

(defun numerics-told-p (run integral)
  "Whether RUN tells the drift of INTEGRAL; why not is noted."
  (let ((why (numerics-why-untold run integral)))
    (when why
      (setf (numerics-simulation-untold run)
            (append (numerics-simulation-untold run)
                    (list (format nil "~a: ~a"
                                  (numerics-name-text (forms-first-integral-name integral)) why)))))
    (null why)))

(defun numerics-why-untold (run integral)
  (destructuring-bind (value size power) (cdr integral)
    (let ((open (numerics-open-names (numerics-simulation-rates run) (list value size power))))
      (cond (open (format nil "~{~a~^, ~} ha~:[s~;ve~] no value" open (cdr open)))
            ((not (numerics-finite-start-p run (list value size power)))
             "no finite value at the start")
            ((eql power 0) nil)
            (t (numerics-why-unbalanced run))))))

(defun numerics-why-unbalanced (run)
  (let ((method (numerics-wishes-method (numerics-simulation-wishes run)))
        (n (length (numerics-simulation-state run))))
    (cond ((plusp (numerics-wishes-digits (numerics-simulation-wishes run)))
           "not integrated along with Taylor series")
          ((eq method '$gauss) "not integrated along with this method")
          ((and (member method '($auto $dop853)) (> n *numerics-states-of-balances*)
                (null (numerics-problem-mass (numerics-simulation-problem run))))
           (format nil "with ~d states it would take as long as the run" n)))))

(defun numerics-finite-start-p (run elements)
  (let ((values (numerics-zeros (length elements))) (program (numerics-simulation-program run)))
    (numerics-with-masked-traps
      (funcall (with-numerics-program program
                 (numerics-routine program elements :how :machine))
               (numerics-simulation-moment run) (numerics-simulation-state run) values))
    (every #'numerics-finite-p values)))
