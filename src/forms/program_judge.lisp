;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Programs of equations tried at a random point, to 512 binary digits. For a random displacement c
;;; the virtual work c.(M q'' - f) that the program gives is compared with that of judge.lisp, which
;;; knows of no program; along the same motion the second derivatives of the constraints are
;;;     f_j'' = A q'' - b,   their change with the displacement A c,
;;; and where the program gives q'' and lambda, c.(M q'' - f) = lambda.A c and f_j'' = 0.
;;; See forms-check-program first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes" "algebra/program_record"
                "forms/actions" "forms/agreement" "forms/fixed" "forms/judge" "forms/value"))

;;; What a program is to give.

(core-record forms-task
  "The result wanted (mass, solved, inverse), the names inside of coordinates, velocities,
accelerations and multipliers, the names outside as pairs v = 'diff(q,t), and the left sides of the
constraints in names inside."
  result q
  (v *forms-none*) (a *forms-none*) (multipliers *forms-none*) (pairs *forms-none*)
  (holonomic *forms-none*) (nonholonomic *forms-none*))

(defun forms-read-task (task)
  "The TASK that Maxima made, with lists of Lisp."
  (make-forms-task :result (forms-task-result task) :q (cdr (forms-task-q task))
                   :v (cdr (forms-task-v task)) :a (cdr (forms-task-a task))
                   :multipliers (cdr (forms-task-multipliers task))
                   :pairs (cdr (forms-task-pairs task))
                   :holonomic (cdr (forms-task-holonomic task))
                   :nonholonomic (cdr (forms-task-nonholonomic task))))

(defstruct forms-program-judge
  function            ; of a point: L as a function of points near by
  dissipation forces  ; R and [Q_1, ..] as expressions
  how)                        ; in words

(defun forms-judge-of-expressions (system)
  (make-forms-program-judge
   :function (lambda (base)
               (declare (ignore base))
               (forms-values-of (forms-system-function system)))
   :dissipation (forms-system-dissipation system) :forces (cdr (forms-system-forces system))
   :how *forms-judged-how*))

(defparameter *forms-singular-mass*
  "the mass matrix is singular: the accelerations do not follow from the equations")

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
    (forms-verdict-of how
                      (or (catch 'forms-no-value
                            (forms-program-pairs task trial point values judge))
                          '((nil)))
                      point)))

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

(defstruct forms-trial-motion work changes accelerations) ; c.(M q'' - f), A c, f_j'' and g_j''

(defun forms-judged-motion (task trial point judge)
  (make-forms-trial-motion
   :work (forms-judged-sum trial (funcall (forms-program-judge-function judge) point)
                           (forms-program-judge-dissipation judge)
                           (forms-program-judge-forces judge) point)
   :changes (forms-constraint-changes task trial point)
   :accelerations (forms-constraint-accelerations task trial point)))

(defun forms-program-pairs (task trial point values judge)
  (when values
    (let ((motion (forms-judged-motion task trial point judge)))
      (ecase (forms-task-result task)
        ($mass (forms-mass-pairs (forms-places-of (forms-task-a task) point)
                                 (forms-trial-weights trial) values motion))
        ($solved (forms-solved-pairs values motion))
        ($inverse (forms-inverse-pairs task trial point values motion))))))

(defun forms-places-of (names point)
  (mapcar (lambda (name) (forms-variable-value name point)) names))

(defun forms-mass-pairs (a c values motion)
  "A are the accelerations, C the displacement."
  (flet ((rows (name) (forms-rows-of (forms-output name values) (length a)))
         (less (row right) (- (forms-fixed-dot row a) right)))
    (cons (cons (forms-fixed-dot c (mapcar #'less (rows '|$m|) (forms-output '$f values)))
                (forms-trial-motion-work motion))
          (loop for row in (rows '|$a|)
                for right in (forms-output '$b values)
                for change in (forms-trial-motion-changes motion)
                for acceleration in (forms-trial-motion-accelerations motion)
                collect (cons (forms-fixed-dot row c) change)
                collect (cons (less row right) acceleration)))))

(defun forms-solved-pairs (values motion)
  (cons (cons (forms-trial-motion-work motion)
              (forms-fixed-dot (forms-output '$multipliers values)
                               (forms-trial-motion-changes motion)))
        (mapcar (lambda (x) (cons x 0)) (forms-trial-motion-accelerations motion))))

(defun forms-rows-of (numbers n)
  (loop while numbers collect (loop repeat n collect (pop numbers))))

(defun forms-inverse-pairs (task trial point values motion)
  (let ((multipliers (forms-places-of (forms-task-multipliers task) point)))
    (cons (cons (forms-fixed-dot (forms-trial-weights trial) (forms-output '$forces values))
                (- (forms-trial-motion-work motion)
                   (forms-fixed-dot multipliers (forms-trial-motion-changes motion))))
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

(defun forms-constraint-accelerations (task trial point)
  "f_j'' and g_j' along the motion."
  (let* ((step (forms-step forms-step-digits))
         (before (forms-moved trial point (- step)))
         (after (forms-moved trial point step)))
    (append
     (loop for f in (forms-task-holonomic task)
           collect (ash (- (+ (forms-fixed-value f after) (forms-fixed-value f before))
                           (* 2 (forms-fixed-value f point)))
                        (* 2 forms-step-digits)))
     (loop for g in (forms-task-nonholonomic task)
           collect (forms-quotient-of-differences (forms-fixed-value g after)
                                                  (forms-fixed-value g before)
                                                  forms-step-digits)))))

;;; Values of programs, each node once.

(defun forms-program-values (elements point)
  "The values of ELEMENTS; where one is divided by nothing, forms-no-value is thrown."
  (let ((values (make-hash-table)))
    (flet ((value (element)
             (if (algebra-node-p element)
                 (gethash (algebra-node-index element) values)
                 (forms-fixed element))))
      (dolist (node (algebra-live-nodes elements))
        (setf (gethash (algebra-node-index node) values) (forms-node-value node #'value point)))
      (mapcar #'value elements))))

;;; What vanishes at a random point vanishes everywhere, but for jumps and corners: a force that
;;; acts from t = 5 on is 0 at most points. So the sign of u is any number s there, and |u| is s u.

(defvar *forms-signs-are-open* nil)

(defun forms-program-values-on-all-sides (elements point)
  "Values of ELEMENTS that vanish only where these do on all sides of jumps and corners; nil where
there are none."
  (let ((*forms-signs-are-open* t))
    (catch 'forms-no-value (forms-program-values elements point))))

(defun forms-sign-value (argument x)
  "The sign of ARGUMENT, whose value is X."
  (if (and *forms-signs-are-open* (algebra-node-p argument))
      (forms-open-side "sign" argument)
      (ash (signum x) forms-digits)))

(defun forms-open-side (word argument)
  "The number that the function WORD of ARGUMENT, a node, has while signs are open."
  (forms-random-value (intern (format nil "~a~d" word (algebra-node-index argument)) :maxima)))

(defun forms-nought-p (elements point)
  "Whether all ELEMENTS vanish."
  (or (every (lambda (element) (eql element 0)) elements)
      (let ((values (forms-program-values-on-all-sides elements point)))
        (and values (every #'forms-negligible-p values)))))

(defun forms-node-value (node value point)
  (let ((left (algebra-node-left node)) (right (algebra-node-right node)))
    (flet ((x () (funcall value left)) (y () (funcall value right)))
      (case (algebra-node-operation node)
        (:input (forms-fixed-value left point))
        (:add (+ (x) (y)))
        (:subtract (- (x) (y)))
        (:negate (- (x)))
        (:multiply (if (integerp left) (* left (y)) (forms-fixed-times (x) (y))))
        (:divide (forms-fixed-quotient (x) (y)))
        (:sine (forms-function-value '((%sin)) (list (x)) point))
        (:cosine (forms-function-value '((%cos)) (list (x)) point))
        (:root (forms-fixed-root (x)))
        (t (forms-node-function node #'x #'y point))))))

(defun forms-node-function (node x y point)
  (let ((operation (algebra-node-operation node)))
    (flet ((value (operator &rest arguments)
             (forms-function-value (list (list operator)) arguments point)))
      (case operation
        (:exponential (value 'mexpt (forms-symbol-value '$%e point) (funcall x)))
        (:power (value 'mexpt (funcall x) (funcall y)))
        (:polar-angle (value '$atan2 (funcall x) (funcall y)))
        (:absolute (forms-fixed-times (forms-sign-value (algebra-node-left node) (funcall x))
                                      (funcall x)))
        (:sign (forms-sign-value (algebra-node-left node) (funcall x)))
        (:impulse (if *forms-signs-are-open*
                      (forms-open-side "impulse" (algebra-node-left node))
                      0))
        (t (value (algebra-function-operator (algebra-function-of operation)) (funcall x)))))))
