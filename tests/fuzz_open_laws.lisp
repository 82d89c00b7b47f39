;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Random circuits of all elements with nonlinear resistors, among them blocks that the states do
;;; not determine beside controlled sources, against the tableau of fuzz_tableau.lisp.
;;; fuzz_open_laws(count, seed): the failures, each [number, what, description].
;;; A linear circuit is solved there with all quantities a multiple of exp(s*t). At t = 0 some of its
;;; resistors are exchanged for cubic laws through the point that they are at, v0 and j0: then all
;;; quantities, and the rates of the states, are what they were, and the unknowns y are v0 or j0.
;;; The order is the degree in s of the determinant with the slopes of the laws there as conductances
;;; or resistances, for which a coincidence is not to be expected; what is refused since a state would
;;; depend on a law has fewer independent states than inductors and capacitors.

(in-package :maxima)

(core-require "circuits/open_laws")
(load (merge-pathnames "fuzz_tableau.lisp" *load-truename*))

(defvar *fuzz-opened* 0 "Circuits with unknowns that were served.")
(defvar *fuzz-unserved* 0 "Circuits refused since a state depends on a law.")

(defun fuzz-slope () (/ (+ 1009 (* 2 (fuzz-below 500))) (+ 211 (fuzz-below 97))))

(defun fuzz-some-laws (circuit)
  "((label type . slope) ..) for one to three resistors of CIRCUIT, or nil."
  (loop for row in (fuzz-shuffled (remove :r (fuzz-circuit-rows circuit) :key #'fuzz-row-type
                                                                         :test-not #'eq))
        repeat (1+ (fuzz-below 3))
        collect (list* (fuzz-row-label row) (fuzz-choice :ru :ri) (fuzz-slope))))

(defun fuzz-with-rows (circuit function)
  (let ((copy (copy-fuzz-circuit circuit)))
    (setf (fuzz-circuit-rows copy) (mapcar function (fuzz-circuit-rows circuit)))
    copy))

(defun fuzz-law-name (label) (core-symbol (format nil "law_~a" (core-spelling label))))

(defun fuzz-at-slopes (circuit laws)
  "CIRCUIT with the resistances that LAWS have at the point."
  (fuzz-with-rows circuit
                  (lambda (row)
                    (destructuring-bind (&optional type . slope) (cdr (assoc (first row) laws))
                      (if type
                          (append (subseq row 0 4) (list (if (eq type :ru) (/ slope) slope)))
                          row)))))

(defun fuzz-law-of (solution label type slope)
  "law(x) = y0 + slope*(x - x0) + (x - x0)^3"
  (destructuring-bind (x0 . y0) (fuzz-place solution label type)
    (let ((apart (sub '$x (fuzz-number x0))))
      (list '(mequal simp) (list (list (fuzz-law-name label) 'simp) '$x)
            (add (fuzz-number y0) (mul (fuzz-number slope) apart) (power apart 3))))))

(defun fuzz-place (solution label type)
  "The argument of the law and its value in SOLUTION."
  (let* ((row (assoc label (fuzz-circuit-rows (fuzz-solution-circuit solution))))
         (v (fuzz-voltage solution row)) (j (fuzz-current solution row)))
    (if (eq type :ru) (cons v j) (cons j v))))

(defun fuzz-open-description (circuit laws solution)
  (let ((shown (fuzz-with-rows circuit
                               (lambda (row)
                                 (let ((law (assoc (first row) laws)))
                                   (if law
                                       (append (subseq row 0 3)
                                               (list (cadr law) (fuzz-law-name (first row))))
                                       row))))))
    (append (fuzz-description shown t)
            (list (list '(mequal simp) '$functions
                        (fuzz-maxima-list (mapcar (lambda (law) (fuzz-law-name (car law))) laws)))
                  (list '(mequal simp) '$laws
                        (fuzz-maxima-list (loop for (label type . slope) in laws
                                                collect (fuzz-law-of solution label type
                                                                     slope))))))))

(defun fuzz-unknown-values (solution laws)
  "((u_LABEL . v0) ..), ((i_LABEL . j0) ..)"
  (loop for (label type) in laws
        collect (cons (core-symbol (format nil "~(~a~)_~a" (if (eq type :ru) :u :i)
                                           (core-spelling label)))
                      (car (fuzz-place solution label type)))))

(defparameter *fuzz-unserved-words* '("would need its rate" "not complete" "nonlinear branches"))

(defun fuzz-open-fault (circuit laws solution)
  (let* ((degree (fuzz-degree (fuzz-at-slopes circuit laws))) (model nil)
         (description (fuzz-open-description circuit laws solution)))
    (multiple-value-bind (opened text)
        (fuzz-tried (lambda ()
                      (setq model (fuzz-circuit-read description))
                      (mfuncall '$circuits_opened_tableau model)))
      (cond ((and text (fuzz-any-in-p *fuzz-refusals* text)) nil)
            ((and text (fuzz-any-in-p *fuzz-unserved-words* text))
             (incf *fuzz-unserved*)
             (when (= degree (count-if (lambda (row) (member (fuzz-row-type row) '(:l :c)))
                                       (fuzz-circuit-rows circuit)))
               (format nil "refused, though all states are independent: ~a" text)))
            ((and text (fuzz-any-in-p *fuzz-singular* text))
             (unless (= degree -1) (format nil "refused at degree ~d: ~a" degree text)))
            (text text)
            (t (incf *fuzz-served*)
               (when (cdr (fourth opened)) (incf *fuzz-opened*))
               (fuzz-opened-fault opened model degree solution
                                  (fuzz-unknown-values solution laws)))))))

(defun fuzz-opened-fault (opened model degree solution unknowns)
  (let* ((check (mfuncall '$circuits_check model)) (dependent (fuzz-get check '$dependent))
         (names (append unknowns
                        (fuzz-with-magnetizing (fuzz-states solution) dependent solution)))
         (states (cdr ($circuits_tableau_states (second opened)))))
    (flet ((closings (equations) (remove 0 (cdr equations) :key #'cadr :test-not #'eql))
           (rates (equations) (remove 0 (cdr equations) :key #'cadr)))
      (multiple-value-bind (equations untold)
          (if states
              (fuzz-tried (lambda () (mfuncall '$circuits_opened_equations opened t nil)))
              (values (fourth opened) nil))
        (let ((quantities (mfuncall '$circuits_opened_quantities model opened)))
          (cond ((/= degree (length states))
                 (format nil "degree ~d, but ~d states" degree (length states)))
                ((not (eql degree (fuzz-get check '$order))) "order")
                ((and untold (not (search "differentiated more than once" untold))) untold)
                (t (fuzz-differing
                    (append
                     (fuzz-pairs-of-dependence dependent solution names)
                     (fuzz-pairs-of-quantities quantities solution names)
                     (loop for e in (append (cdr (fourth opened)) (closings equations))
                           collect (list "closing" (fuzz-value (caddr e) solution names) 0))
                     (fuzz-pairs-of-rates (cons '(mlist) (rates equations)) solution
                                          names))))))))))

(defun $fuzz_open_laws (count seed)
  (setq *fuzz-state* seed *fuzz-served* 0 *fuzz-opened* 0 *fuzz-unserved* 0)
  (let ((failures
          (loop for number from 1 to count
                for circuit = (fuzz-new-circuit)
                for laws = (fuzz-some-laws circuit)
                for solution = (and laws (fuzz-solve circuit (fuzz-any) (fuzz-inputs circuit)))
                for fault = (and solution (fuzz-open-fault circuit laws solution))
                when fault
                  collect (fuzz-maxima-list
                           (list number fault
                                 (fuzz-open-description circuit laws solution))))))
    (fuzz-maxima-list
     (if (and (>= count 50) (< (* 8 *fuzz-opened*) count))
         (append failures (list (fuzz-maxima-list (list count "served" *fuzz-opened*))))
         failures))))

(defun $fuzz_open_laws_served ()
  "[circuits served, those with unknowns, those refused since a state depends on a law]."
  (fuzz-maxima-list (list *fuzz-served* *fuzz-opened* *fuzz-unserved*)))
