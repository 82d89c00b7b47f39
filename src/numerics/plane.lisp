;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A plane of two states x, y of a system x' = X(x): the problem of these two alone, forwards and
;;; backwards in time, in a window. What x' and y' depend on beside x and y is held at a given
;;; value; the picture is one of the system where that stays as it is, else of a section, and it is
;;; said which of them move. Look first at $numerics_plane.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_nodes" "forms/dynamics"
                "forms/rates" "numerics/element_words" "numerics/lost_impulses"
                "numerics/native" "numerics/problem" "numerics/program" "numerics/rate_program"
                "numerics/rates_problem" "numerics/routine" "numerics/run"
                "numerics/run_options"))

(defstruct numerics-axis
  name                            ; the state
  (low 0d0 :type double-float) (width 1d0 :type double-float)
  turns)                          ; whole turns after which all rates are the same, nil for none

(defstruct numerics-plane
  axes                            ; two
  forwards backwards              ; problems
  alone                           ; whether the system has no other states
  held                            ; ((name . exact value) ..)
  moving)                         ; those of the names held that would move

(core-record numerics-window
  "HORIZONTAL and VERTICAL are [name, low, high] as typed, START equations for what is held."
  horizontal vertical start)

;;; The window

(defparameter *numerics-largest-end* 1d100)
(defparameter *numerics-narrowest-axis* 1d-9 "In parts of the larger of its ends.")
(defparameter *numerics-longest-angle* (* 200 pi) "A hundred turns.")

(defun numerics-check-axis (axis ends)
  "An error where AXIS with ENDS, numbers as typed, cannot be drawn."
  (let* ((low (numerics-axis-low axis)) (width (numerics-axis-width axis))
         (largest (max (abs low) (abs (+ low width)))))
    (unless (plusp width)
      (core-error "the axis of ~a ends at ~a, not after its start ~a; give the smaller number first"
                  (numerics-name-text (numerics-axis-name axis)) (core-words (list (second ends)))
                  (core-words (list (first ends)))))
    (unless (and (<= largest *numerics-largest-end*)
                 (>= largest (/ *numerics-largest-end*))
                 (> width (* *numerics-narrowest-axis* largest)))
      (core-error "the axis of ~a from ~a to ~a is too ~:[wide~;narrow~] to be drawn"
                  (numerics-name-text (numerics-axis-name axis))
                  (core-cut (core-words (list (first ends))))
                  (core-cut (core-words (list (second ends)))) (<= largest *numerics-largest-end*)))
    (when (and (numerics-axis-turns axis) (> width *numerics-longest-angle*))
      (core-error "the axis of the angle ~a goes through more than 100 turns; take a shorter one"
                  (numerics-name-text (numerics-axis-name axis))))
    axis))

(defun numerics-read-axis (items rates period)
  "PERIOD tells of a state after how many turns all is the same."
  (destructuring-bind (name . ends) (numerics-items items)
    (unless (member name (forms-rates-states rates) :test #'alike1)
      (numerics-refuse-start-name name (forms-rates-states rates)))
    (destructuring-bind (from to)
        (mapcar (lambda (e) (numerics-double e "an end of an axis")) ends)
      (numerics-check-axis
       (make-numerics-axis :name name :low from
                           :width (numerics-with-masked-traps (- to from))
                           :turns (and (member name (forms-rates-angles rates) :test #'alike1)
                                       (funcall period name)))
       ends))))

(defun numerics-read-axes (window rates)
  (let* ((period (numerics-period-of rates))
         (axes (list (numerics-read-axis (numerics-window-horizontal window) rates period)
                     (numerics-read-axis (numerics-window-vertical window) rates period))))
    (when (alike1 (numerics-axis-name (first axes)) (numerics-axis-name (second axes)))
      (core-error "both axes are ~a; take two states"
                  (numerics-name-text (numerics-axis-name (first axes)))))
    axes))

(defun numerics-place (axis number)
  "Where the state NUMBER stands along AXIS: 0 at its low end, 1 at its high one."
  (declare (double-float number))
  (/ (- number (numerics-axis-low axis)) (numerics-axis-width axis)))

(defun numerics-at-place (axis place)
  (declare (double-float place))
  (+ (numerics-axis-low axis) (* place (numerics-axis-width axis))))

;;; What the rates truly depend on, at three places: a program may name a state that cancels

(defun numerics-some-places (n)
  (loop for k from 1 to 3
        collect (map 'numerics-vector (lambda (i) (+ 0.4d0 (* 0.3d0 (sin (* k i)))))
                     (loop for i from 1d0 to n collect i))))

(defun numerics-rates-routine (rates names)
  "The function (moment state out) of the RATES of NAMES."
  (numerics-routine (make-numerics-program :algebra *algebra-program*
                                           :names (forms-rates-states rates))
                    (numerics-rates-of rates names)))

(defun numerics-same-after-p (routine count x place way)
  "Whether the COUNT values of ROUTINE at X are the same where the state at PLACE is moved on by
WAY."
  (let ((later (copy-seq x)) (here (numerics-zeros count)) (there (numerics-zeros count)))
    (incf (aref later place) way)
    (numerics-with-masked-traps
      (funcall routine (numerics-moment 0d0) x here)
      (funcall routine (numerics-moment 0d0) later there)
      (every (lambda (a b) (<= (abs (- a b)) (* 1d-9 (+ 1 (abs a))))) here there))))

;;; Turns: what stands in sin(x/2) is the same after two of them

(defparameter *numerics-most-turns* 12)

(defun numerics-period-of (rates)
  "The function of a state that gives the number of turns after which all RATES are the same; nil
where it is not found."
  (let* ((names (forms-rates-states rates)) (n (length names)) (places (numerics-some-places n))
         (routine (numerics-rates-routine rates names)))
    (lambda (name)
      (let ((place (position name names :test #'alike1)))
        (loop for turns from 1 to *numerics-most-turns*
              when (every (lambda (x) (numerics-same-after-p routine n x place (* 2 pi turns)))
                          places)
                return turns)))))

;;; What is held

(defun numerics-other-states (rates names)
  "The states beside NAMES that their rates name, directly: (name . whether they depend on it)."
  (let* ((states (forms-rates-states rates)) (routine (numerics-rates-routine rates names))
         (places (numerics-some-places (length states))))
    (loop for input in (algebra-inputs-of (numerics-rates-of rates names))
          for place = (position input states :test #'alike1)
          when (and place (not (member input names :test #'alike1)))
            collect (cons input
                          (notevery (lambda (x)
                                      (numerics-same-after-p routine (length names) x place 0.3d0))
                                    places)))))

(defun numerics-rates-of (rates names)
  "The elements of the rates of NAMES."
  (loop for name in names
        collect (nth (position name (forms-rates-states rates) :test #'alike1)
                     (forms-right-sides rates))))

(defparameter *numerics-any-value* '((rat simp) 2 5))

(defun numerics-held-value (name names start values rates)
  "The exact value at which NAME is held beside the axes NAMES."
  (let ((given (find name (numerics-items start) :key #'second :test #'alike1))
        (value (find name (numerics-items values) :key #'second :test #'alike1)))
    (cond (given (third given))
          ((and value (member name (forms-rates-momenta rates) :test #'alike1)) (third value))
          ((and (numerics-items start) (numerics-velocity-p name)) 0)
          (t (core-error "the rates of ~{~a~^, ~} depend on ~a too; give start = [~:*~a = .., ..], ~
                          the values of the section that is drawn"
                         (mapcar #'numerics-name-text names) (numerics-name-text name))))))

(defun numerics-check-held-names (rates start)
  "An error for a name in START that the system does not have. A start for another form of its
equations may name velocities and coordinates that are none of the states here."
  (loop for (nil name) in (numerics-items start)
        do (unless (or (numerics-velocity-p name)
                       (member name (append (forms-rates-states rates) (forms-rates-cyclic rates))
                               :test #'alike1))
             (numerics-refuse-start-name name (forms-rates-states rates)))))

(defun numerics-held-values (rates names start values)
  "((name . exact value) ..) of what is held beside NAMES; what cancels has some value."
  (numerics-check-held-names rates start)
  (loop for (name . counts) in (numerics-other-states rates names)
        collect (cons name (if counts
                               (numerics-held-value name names start values rates)
                               *numerics-any-value*))))

(defun numerics-held-elements (held)
  (loop for (name . value) in held collect (cons name (numerics-value-element name value))))

;;; The problems

(defun numerics-plane-problem (names elements)
  (numerics-problem-of (make-numerics-program :algebra *algebra-program* :names names
                                              :rates elements)))

(defun numerics-refuse-no-plane (rates)
  "An error where there is no picture of RATES as a plane."
  (when (forms-output-list '$velocities (forms-rates-outputs rates))
    (core-error "the system has constraints, which its states are not free of; choose ~
                 coordinates that need none"))
  (let ((elements (numerics-rates-of rates (forms-rates-states rates))))
    (when (member '$t (algebra-inputs-of elements))
      (core-error "the equations contain the time: through a point goes more than one trajectory"))
    (numerics-check-names rates elements)))

(defun $numerics_plane (rates values window)
  "The plane of WINDOW of RATES with VALUES, equations."
  (with-algebra-program (numerics-new-plane rates values window)))

(defun numerics-new-plane (rates values window)
  (let* ((pairs (numerics-parameter-pairs values rates))
         (rates (numerics-run-rates rates pairs t))
         (axes (progn (numerics-refuse-no-plane rates) (numerics-read-axes window rates)))
         (names (mapcar #'numerics-axis-name axes))
         (held (numerics-held-values rates names (numerics-window-start window) values))
         (others (mapcar #'car held))
         (elements (algebra-exchanged (numerics-rates-of rates (append names others))
                                      (algebra-exchange-by (numerics-held-elements held))))
         (plane (subseq elements 0 2)))
    (numerics-warn-of-lost-impulses rates axes held)
    (make-numerics-plane
     :axes axes :alone (null (cddr (forms-rates-states rates)))
     :held (remove *numerics-any-value* held :key #'cdr)
     :moving (loop for (name . value) in held
                   for element in (nthcdr 2 elements)
                   unless (or (eql element 0) (eq value *numerics-any-value*)) collect name)
     :forwards (numerics-plane-problem names plane)
     :backwards (numerics-plane-problem names (mapcar #'algebra-program-negate plane)))))

(defun numerics-gaps-in-plane (gaps rates axes exchange)
  "GAPS, (i . gap), of the states of AXES."
  (loop for (i . gap) in gaps
        for place = (position (nth i (forms-rates-states rates)) axes
                              :key #'numerics-axis-name :test #'alike1)
        when place collect (cons place (first (algebra-exchanged (list gap) exchange)))))

(defun numerics-warn-of-lost-impulses (rates axes held)
  "A warning where trajectories cross a jump of what the equations of RATES are derivatives of."
  (let* ((exchange (algebra-exchange-by (numerics-held-elements held)))
         (program (make-numerics-program :algebra *algebra-program*
                                         :names (mapcar #'numerics-axis-name axes)))
         (impulses (numerics-new-impulses
                    (loop for (u . gaps) in (forms-rates-impulses rates)
                          collect (cons (first (algebra-exchanged (list u) exchange))
                                        (numerics-gaps-in-plane gaps rates axes exchange)))
                    program
                    (lambda (state i)
                      (declare (ignore state))
                      (* 1d-6 (numerics-axis-width (nth i axes))))))
         (u (and impulses
                 (numerics-with-masked-traps
                   (numerics-impulse-in-window
                    impulses (mapcar #'numerics-axis-low axes)
                    (mapcar (lambda (axis) (+ (numerics-axis-low axis) (numerics-axis-width axis)))
                            axes))))))
    (when u
      (core-warn "where ~a = 0 a function that the equations are derivatives of jumps; the curves ~
                  do not show the impulse that a motion gets there"
                 (or (numerics-element-words u) "the argument of a sign")))))

;;; Values; inside masked traps

(defun numerics-slope-at (plane x y)
  "Two values: the rates at (X, Y) in units of the window."
  (let ((state (numerics-zeros 2)) (out (numerics-zeros 2)))
    (setf (aref state 0) x (aref state 1) y)
    (funcall (numerics-problem-rates (numerics-plane-forwards plane)) (numerics-moment 0d0) state
             out)
    (values (/ (aref out 0) (numerics-axis-width (first (numerics-plane-axes plane))))
            (/ (aref out 1) (numerics-axis-width (second (numerics-plane-axes plane)))))))

(defun numerics-slopes-at (plane x y)
  "The matrix ((a b) (c d)) of the derivatives of the rates at (X, Y), in units of the window."
  (let* ((problem (numerics-plane-forwards plane)) (pattern (numerics-problem-pattern problem))
         (starts (numerics-pattern-starts pattern)) (rows (numerics-pattern-rows pattern))
         (values (numerics-zeros (length rows))) (matrix (list (list 0d0 0d0) (list 0d0 0d0)))
         (state (numerics-zeros 2)) (axes (numerics-plane-axes plane)))
    (setf (aref state 0) x (aref state 1) y)
    (funcall (numerics-problem-jacobian problem) (numerics-moment 0d0) state values)
    (dotimes (j 2 matrix)
      (loop for k from (aref starts j) below (aref starts (1+ j))
            for i = (aref rows k)
            do (setf (nth j (nth i matrix))
                     (* (aref values k) (/ (numerics-axis-width (nth j axes))
                                           (numerics-axis-width (nth i axes)))))))))
