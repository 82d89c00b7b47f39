;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Programs of equations tried at a random point, to 512 binary digits. For a random displacement c
;;; the virtual work c.(M q'' - f) that the program gives is compared with that of judge.lisp, which
;;; knows of no program; along the same motion the second derivatives of the constraints are
;;;     f_j'' = A q'' - b,   their change with the displacement A c,
;;; and where the program gives q'' and lambda, c.(M q'' - f) = lambda.A c and f_j'' = 0.
;;; See forms-check-program first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/judge" "forms/program_value" "algebra/program_record"))

(defstruct forms-program-judge
  function            ; of a point: L as a function of points near by
  dissipation forces  ; R and [Q_1, ..] as expressions
  how)                        ; in words

(defun forms-judge-of-expressions (function dissipation forces)
  (make-forms-program-judge
   :function (lambda (base)
               (declare (ignore base))
               (forms-values-of function))
   :dissipation dissipation :forces forces :how *forms-judged-how*))

;;; A task as the Maxima side gives it: what is wanted (mass, solved, inverse), the names of
;;; coordinates, velocities, accelerations and multipliers, the names outside as v = 'diff(q,t), and
;;; the constraints, in names inside.

(defstruct (forms-task (:type list))
  result q v a multipliers pairs holonomic nonholonomic)

(defun forms-read-task (task)
  (mapcar (lambda (part) (if (atom part) part (cdr part))) (cdr task)))

(defun forms-check-program (task outputs judge)
  (let* ((trial (forms-new-trial (forms-task-q task) (forms-task-v task) (forms-task-a task)))
         (point (forms-trial-point trial))
         (values (catch 'forms-no-value (forms-output-values outputs point)))
         (how (concatenate 'string "virtual work of the program against "
                           (forms-program-judge-how judge))))
    (when (eq (forms-task-result task) '$solved)
      (if values
          (forms-set-places (forms-task-a task) (forms-output '$accelerations values) point)
          (forms-refuse-solution task)))
    (loop for (found . expected) in (catch 'forms-no-value
                                      (or (forms-program-pairs task trial point values judge)
                                          '((nil))))
          do (forms-verdict how found expected point))))

(defun forms-refuse-solution (task)
  (core-error "the program divides by zero at a random point: ~a"
              (if (or (forms-task-holonomic task) (forms-task-nonholonomic task))
                  "the constraints depend on each other, or the mass matrix is singular"
                  *forms-singular-mass*)))

(defun forms-set-places (names values point)
  (mapc (lambda (name value) (forms-set-place name value point)) names values))

(defun forms-output-values (outputs point)
  "OUTPUTS with lists of numbers in place of their elements."
  (let ((values (forms-program-values (algebra-all-outputs outputs) point)))
    (loop for (name . value) in outputs
          collect (cons name (loop for nil in (algebra-output-elements value)
                                   collect (pop values))))))

(defun forms-output (name values) (cdr (assoc name values)))

;;; What must agree: pairs of numbers.

(defun forms-program-pairs (task trial point values judge)
  (and values
       (let ((changes (forms-constraint-changes task trial point))
             (second (forms-constraint-accelerations task trial point))
             (work (forms-judged-sum trial (funcall (forms-program-judge-function judge) point)
                                     (forms-program-judge-dissipation judge)
                                     (forms-program-judge-forces judge) point)))
         (ecase (forms-task-result task)
           ($mass (forms-mass-pairs task trial point values work changes second))
           ($solved (cons (cons work (forms-fixed-dot (forms-output '$multipliers values) changes))
                          (mapcar (lambda (x) (cons x 0)) second)))
           ($inverse (forms-inverse-pairs task trial point values work changes))))))

(defun forms-places-of (names point)
  (mapcar (lambda (name) (forms-variable-value name point)) names))

(defun forms-mass-pairs (task trial point values work changes second)
  (let ((a (forms-places-of (forms-task-a task) point)) (c (forms-trial-weights trial)))
    (flet ((rows (name) (forms-rows-of (forms-output name values) (length a))))
      (cons (cons (forms-fixed-dot c (mapcar (lambda (row right) (- (forms-fixed-dot row a) right))
                                             (rows '|$m|) (forms-output '$f values)))
                  work)
            (loop for row in (rows '|$a|)
                  for right in (forms-output '$b values)
                  for change in changes
                  for acceleration in second
                  collect (cons (forms-fixed-dot row c) change)
                  collect (cons (- (forms-fixed-dot row a) right) acceleration))))))

(defun forms-rows-of (numbers n)
  (loop while numbers collect (loop repeat n collect (pop numbers))))

(defun forms-inverse-pairs (task trial point values work changes)
  (let ((multipliers (forms-places-of (forms-task-multipliers task) point)))
    (cons (cons (forms-fixed-dot (forms-trial-weights trial) (forms-output '$forces values))
                (- work (forms-fixed-dot multipliers changes)))
          (loop for value in (forms-output '$constraints values)
                for e in (append (forms-task-holonomic task) (forms-task-nonholonomic task))
                collect (cons value (forms-fixed-value e point))))))

;;; The constraints as quotients of differences.

(defun forms-constraint-changes (task trial point)
  "A c: of f_j with the coordinates, of g_j with the velocities."
  (flet ((slopes (expressions names)
           (loop for e in expressions
                 collect (forms-slope trial (forms-values-of e) point names))))
    (append (slopes (forms-task-holonomic task) (forms-task-q task))
            (slopes (forms-task-nonholonomic task) (forms-task-v task)))))

(defun forms-values-of (e) (lambda (point) (forms-fixed-value e point)))

(defun forms-constraint-accelerations (task trial point)
  "f_j'' and g_j' along the motion."
  (let ((before (forms-moved trial point (- (forms-step))))
        (after (forms-moved trial point (forms-step))))
    (append
     (loop for f in (forms-task-holonomic task)
           collect (ash (- (+ (forms-fixed-value f after) (forms-fixed-value f before))
                           (* 2 (forms-fixed-value f point)))
                        (* 2 forms-step-digits)))
     (loop for g in (forms-task-nonholonomic task)
           collect (forms-quotient-of-differences (forms-fixed-value g after)
                                                  (forms-fixed-value g before))))))
