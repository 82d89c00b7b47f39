;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Lagrange's equations in the ring of kernels: L is read once, every derivative is one of
;;; polynomials, and the velocities get back the name 'diff(q,t) only where the result is written.
;;; d/dt is a derivation of the ring like d/dq: the rate of a kernel k is
;;;     sum dk/dq_j q_j' + dk/dt,  and q_j'' for the velocity of q_j.
;;; Served is an L whose kernels are free of velocities and which has no coordinates below the line;
;;; Maxima's simplifier, quadratic in the length of sums, sees neither L nor the equations (three
;;; bodies, six angles, full tensors: 0.6 s instead of 4 s; seconds grow with the length of the
;;; result, which grows about eightfold with each body).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/derivatives" "algebra/evaluate" "algebra/general_form" "algebra/kernels"
                "algebra/normal" "algebra/quotient" "algebra/relations" "algebra/scan"
                "algebra/shortest_forms" "algebra/size" "forms/actions" "forms/exchange"))

(defstruct forms-derivation
  function dissipation forces ; L, Rayleigh's function, the forces: quotients
  slopes                      ; for each coordinate the rates of the kernels
  drift                       ; the rates of the kernels with time, accelerations left out
  velocities accelerations)   ; variables of the ring

(defun forms-derivation-of (system q v a)
  "SYSTEM, read; nil where it is not served."
  (when (every #'symbolp q)
    (forms-read-derivation (cdr ($forms_system_expressions system)) q v a)))

(defun forms-read-derivation (expressions q v a)
  (destructuring-bind (function dissipation forces) expressions
    (let* ((skeletons (mapcar #'algebra-scan (list* function dissipation (cdr forces))))
           (velocities (mapcar #'algebra-scan v))
           (accelerations (mapcar #'algebra-scan a))
           (rates (progn (algebra-collect-multiples)
                         (mapcar #'algebra-rates-of-kernels (append q '($t))))))
      (when (forms-kernels-free-of v)
        (algebra-order-kernels)
        (let ((quotients (mapcar #'algebra-evaluate skeletons))
              (rates (mapcar #'algebra-evaluated-rates rates)))
          (when (and (forms-kernels-free-of v) ; sines and cosines are among them only now
                     (every (lambda (quotient) (forms-free-below-p quotient (append q v)))
                            quotients))
            (make-forms-derivation
             :function (first quotients) :dissipation (second quotients)
             :forces (cddr quotients)
             :slopes (butlast rates)
             :drift (forms-drift-rates rates velocities)
             :velocities (mapcar #'algebra-kernel-variable velocities)
             :accelerations (mapcar #'algebra-kernel-variable accelerations))))))))

(defun forms-kernels-free-of (names)
  "No function or root has NAMES in it, and there are no roots."
  (loop for kernel in (algebra-ring-kernels *algebra-ring*)
        for e = (algebra-kernel-expression kernel)
        always (and (null (algebra-kernel-degree kernel))
                    (or (atom e) (notany (lambda (name) (among name e)) names)))))

(defun forms-free-below-p (quotient names)
  "Only products of parameters stand below the line."
  (let ((d (cdr quotient)))
    (and (algebra-one-term-p d)
         (loop for variable in (algebra-variables d)
               for e = (get variable 'disrep)
               always (and (symbolp e) (not (member e names)))))))

(defun forms-drift-rates (rates velocities)
  "The RATES with the coordinates times the velocities, and those with t, in one list."
  (append (loop for slope in rates
                for velocity in velocities
                for factor = (cons (algebra-variable velocity) 1)
                append (loop for (variable . rate) in slope
                             collect (cons variable (algebra-times rate factor))))
          (car (last rates))))

(defun forms-by-variable (quotient variable)
  (algebra-derivative quotient (list (cons variable (cons 1 1)))))

(defun forms-minus (quotient)
  (cons (pminus (car quotient)) (cdr quotient)))

(defun forms-momenta (derivation)
  (loop for variable in (forms-derivation-velocities derivation)
        collect (forms-by-variable (forms-derivation-function derivation) variable)))

(defun forms-inertia (momentum derivation)
  "The derivatives of a MOMENTUM with respect to the velocities: a row of the mass matrix."
  (loop for variable in (forms-derivation-velocities derivation)
        collect (forms-by-variable momentum variable)))

(defun forms-ring-right-side (momentum slope velocity force derivation)
  "dL/dq - dp/dt + Q - dR/dq', the accelerations left out."
  (algebra-sum
   (list (algebra-derivative (forms-derivation-function derivation) slope)
         (forms-minus (algebra-derivative momentum (forms-derivation-drift derivation)))
         (forms-minus (forms-by-variable (forms-derivation-dissipation derivation) velocity))
         force)))

(defun forms-ring-right-sides (momenta derivation)
  (loop for momentum in momenta
        for slope in (forms-derivation-slopes derivation)
        for velocity in (forms-derivation-velocities derivation)
        for force in (forms-derivation-forces derivation)
        collect (forms-ring-right-side momentum slope velocity force derivation)))

(defun forms-ring-equations (derivation)
  (let ((momenta (forms-momenta derivation)))
    (loop for momentum in momenta
          for right in (forms-ring-right-sides momenta derivation)
          collect (algebra-sum
                   (cons (forms-minus right)
                         (loop for inertia in (forms-inertia momentum derivation)
                               for acceleration in (forms-derivation-accelerations derivation)
                               collect (algebra-times inertia
                                                      (cons (list acceleration 1 1) 1))))))))

;;; Results as expressions.

(defparameter *forms-ring-limit* 100000
  "An L that would have more terms than this when multiplied out is left as it stands.")

(defun forms-terms (e)
  "How many terms E has at most when it is multiplied out."
  (cond ((atom e) 1)
        ((mbagp e) (reduce #'+ (mapcar #'forms-terms (cdr e))))
        ((eq (caar e) 'mplus) (reduce #'+ (mapcar #'forms-terms (cdr e))))
        ((eq (caar e) 'mtimes) (reduce #'* (mapcar #'forms-terms (cdr e))))
        ((and (mexptp e) (integerp (caddr e)) (< 1 (caddr e) 20))
         (expt (forms-terms (cadr e)) (caddr e)))
        ((and (member (caar e) '(%sin %cos)) (mplusp (cadr e)))
         (expt 2 (- (length (cadr e)) 2))) ; by the theorem of addition
        (t 1)))

(defun forms-in-ring (system q v a back function)
  "FUNCTION of the derivation, BACK's names being written; nil where SYSTEM is not served or too
long."
  (when (<= (forms-terms ($forms_system_expressions system)) *forms-ring-limit*)
    (let ((found (catch 'algebra-too-large
                   (let ((*algebra-may-give-up* t) (*algebra-limit* *forms-ring-limit*))
                     (with-algebra-ring
                       (forms-of-derivation (forms-derivation-of system (cdr q) (cdr v) (cdr a))
                                            (append (cdr v) (cdr a)) back function))))))
      (unless (eq found 'too-large) found))))

(defun forms-of-derivation (derivation velocities back function)
  (when derivation
    (forms-rename-kernels back)
    (let ((*algebra-velocities* velocities)) (funcall function derivation))))

(defun forms-rename-kernels (back)
  "Kernels are written with the right sides of BACK in place of their left sides."
  (dolist (kernel (algebra-ring-kernels *algebra-ring*))
    (putprop (algebra-kernel-variable kernel)
             ($forms_exchange (algebra-kernel-expression kernel) back)
             'disrep)))

(defun forms-written (quotients)
  (cons '(mlist simp)
        (mapcar (lambda (quotient) (algebra-collected-reduced (algebra-cancel quotient)))
                quotients)))

(defun $forms_ring_equations (system q v a back)
  "[e_1, ..]; false where the ring does not serve."
  (forms-in-ring system q v a back
                 (lambda (derivation) (forms-written (forms-ring-equations derivation)))))

(defun $forms_ring_mass_form (system q v a back)
  "[M, f]; false where the ring does not serve."
  (forms-in-ring
   system q v a back
   (lambda (derivation)
     (let ((momenta (forms-momenta derivation)))
       (list '(mlist simp)
             (cons '($matrix simp)
                   (loop for momentum in momenta
                         collect (forms-written (forms-inertia momentum derivation))))
             (forms-written (forms-ring-right-sides momenta derivation)))))))

(defun $forms_ring_quadratics (function q v)
  "[A, a, A0] of FUNCTION = v.A.v/2 + a.v + A0; false where the ring does not serve or it is no such
sum."
  (forms-in-ring (make-forms-system :function function :dissipation 0 :forces *forms-none*)
                 q v *forms-none* *forms-none* #'forms-ring-quadratics))

(defun forms-ring-quadratics (derivation)
  (let* ((momenta (forms-momenta derivation))
         (variables (forms-derivation-velocities derivation))
         (inertia (loop for momentum in momenta
                        collect (forms-inertia momentum derivation))))
    (when (every (lambda (row) (forms-free-of-p row variables)) inertia)
      (list '(mlist simp)
            (cons '($matrix simp) (mapcar #'forms-written inertia))
            (forms-written (forms-without-velocities momenta variables))
            (cadr (forms-written
                   (forms-without-velocities (list (forms-derivation-function derivation))
                                             variables)))))))

(defun forms-free-of-p (quotients variables)
  (notany (lambda (quotient)
            (some (lambda (variable) (algebra-occurs-p variable (car quotient))) variables))
          quotients))

(defun forms-without-velocities (quotients variables)
  (loop for (p . d) in quotients
        do (dolist (variable variables) (setq p (pcsubsty 0 variable p)))
        collect (cons p d)))

(defun $forms_residuals (m a f)
  "The rows of M a - f for numbers to be put in: nothing is multiplied out or collected."
  (cons '(mlist simp)
        (loop for row in (cdr m)
              for right in (cdr f)
              collect (list* '(mplus simp)
                             (list '(mtimes simp) -1 right)
                             (loop for entry in (cdr row)
                                   for x in (cdr a)
                                   collect (list '(mtimes simp) entry x))))))
