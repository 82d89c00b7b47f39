;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A plane of two states x, y of a system x' = X(x): the problem of these two alone, forwards and
;;; backwards in time, in a window. What x' and y' depend on beside x and y is held at a given
;;; value; the picture is one of the system where that stays as it is, else of a section, and it is
;;; said which of them move. Look first at $numerics_plane.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_exchange" "algebra/program_nodes" "forms/dynamics"
                "forms/rates" "numerics/algebraic_rates" "numerics/branch_over_axes"
                "numerics/element_words" "numerics/followed_branch" "numerics/lost_impulses"
                "numerics/native" "numerics/plane_axes" "numerics/problem" "numerics/program"
                "numerics/rate_program" "numerics/rates_problem" "numerics/run"
                "numerics/run_options"))

(defstruct numerics-plane
  axes                            ; two
  forwards backwards              ; problems
  alone                           ; whether the system has no other states
  (branch nil)                    ; of the states that equations 0 = .. determine, nil for none
  (unrated '())                   ; those of the axes that are such states
  held                            ; ((name . exact value) ..)
  moving)                         ; those of the names held that would move

;;; What is held

(defun numerics-other-states (rates names elements)
  "The states beside NAMES that ELEMENTS name, directly: (name . whether they depend on it)."
  (let* ((states (forms-rates-states rates)) (routine (numerics-element-routine rates elements))
         (places (numerics-some-places (length states))))
    (loop for input in (algebra-inputs-of elements)
          for place = (position input states :test #'alike1)
          when (and place (not (member input names :test #'alike1)))
            collect (cons input
                          (notevery (lambda (x)
                                      (numerics-same-after-p routine (length elements) x place
                                                             0.3d0))
                                    places)))))

(defparameter *numerics-any-value* '((rat simp) 2 5))

(defun numerics-held-value (name names start values rates)
  "The exact value at which NAME is held beside NAMES."
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

(defun numerics-held-values (rates names elements start values)
  "((name . exact value) ..) of what is held of ELEMENTS beside NAMES; what cancels has some value."
  (numerics-check-held-names rates start)
  (loop for (name . counts) in (numerics-other-states rates names elements)
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
  (let ((elements (forms-right-sides rates)))
    (when (member '$t (algebra-inputs-of elements))
      (core-error "the equations contain the time: through a point goes more than one trajectory"))
    (numerics-check-names rates elements)))

(defun $numerics_plane (rates values window)
  "The plane of WINDOW of RATES with VALUES, equations."
  (with-algebra-program (numerics-new-plane rates values window)))

(defun numerics-new-plane (rates values window)
  (let* ((pairs (numerics-parameter-pairs values rates))
         (rates (numerics-run-rates rates pairs :rated))
         (axes (progn (numerics-refuse-no-plane rates) (numerics-read-axes window rates)))
         (names (mapcar #'numerics-axis-name axes))
         (followed (numerics-followed-states rates names))
         (elements (append (numerics-axis-rates rates names) (numerics-closings rates)))
         (held (numerics-held-values rates (append names followed) elements
                                     (numerics-window-start window) values)))
    (numerics-warn-of-lost-impulses rates axes held)
    (numerics-plane-of axes rates held followed elements (numerics-window-start window))))

(defun numerics-plane-of (axes rates held followed elements start)
  "The plane of AXES: ELEMENTS are their rates, and what determines the states FOLLOWED from START."
  (let ((elements (numerics-elements-held elements held))
        (names (append (mapcar #'numerics-axis-name axes) followed)))
    (destructuring-bind (branch . rest-of-rates)
        (if followed (numerics-branch-of axes followed elements start) '(nil))
      (let ((flow (append (subseq elements 0 2) rest-of-rates)))
        (make-numerics-plane
         :axes axes :branch branch
         :unrated (intersection names (set-difference (numerics-algebraic-states rates) followed
                                                      :test #'alike1)
                                :test #'alike1)
         :alone (= 2 (length (numerics-rated-states rates)))
         :held (remove *numerics-any-value* held :key #'cdr)
         :moving (numerics-moving-names rates held)
         :forwards (numerics-plane-problem names flow)
         :backwards (numerics-plane-problem names (mapcar #'algebra-program-negate flow)))))))

(defun numerics-elements-held (elements held)
  (algebra-exchanged elements (algebra-exchange-by (numerics-held-elements held))))

(defun numerics-moving-names (rates held)
  "Those of the names HELD that would move."
  (let ((names (mapcar #'car held)))
    (loop for (name . value) in held
          for element in (numerics-elements-held (numerics-axis-rates rates names) held)
          unless (or (eql element 0) (eq value *numerics-any-value*)) collect name)))

(defun numerics-state-over (plane x y)
  "The state of the problems at (X, Y); nil where its branch does not reach so far."
  (if (numerics-plane-branch plane)
      (numerics-branch-at (numerics-plane-branch plane) x y)
      (coerce (list x y) 'numerics-vector)))

;;; Impulses

(defun numerics-gaps-in-plane (gaps rates axes exchange)
  "GAPS, (i . gap), of the states of AXES."
  (loop for (i . gap) in gaps
        for place = (position (nth i (forms-rates-states rates)) axes
                              :key #'numerics-axis-name :test #'alike1)
        when place collect (cons place (first (algebra-exchanged (list gap) exchange)))))

(defun numerics-impulses-in-plane (rates axes exchange)
  "The impulses of RATES, (u . gaps), where they are functions of AXES alone."
  (loop with names = (mapcar #'numerics-axis-name axes)
        for (u . gaps) in (forms-rates-impulses rates)
        for there = (cons (first (algebra-exchanged (list u) exchange))
                          (numerics-gaps-in-plane gaps rates axes exchange))
        when (subsetp (algebra-inputs-of (cons (first there) (mapcar #'cdr (rest there)))) names
                      :test #'alike1)
          collect there))

(defun numerics-warn-of-lost-impulses (rates axes held)
  "A warning where trajectories cross a jump of what the equations of RATES are derivatives of."
  (let* ((exchange (algebra-exchange-by (numerics-held-elements held)))
         (program (make-numerics-program :algebra *algebra-program*
                                         :names (mapcar #'numerics-axis-name axes)))
         (impulses (numerics-new-impulses
                    (numerics-impulses-in-plane rates axes exchange)
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
  (let ((state (numerics-state-over plane x y)) (problem (numerics-plane-forwards plane)))
    (if state
        (let ((out (numerics-zeros (numerics-problem-size problem))))
          (funcall (numerics-problem-rates problem) (numerics-moment 0d0) state out)
          (values-list (loop for axis in (numerics-plane-axes plane)
                             for rate across out
                             collect (/ rate (numerics-axis-width axis)))))
        (values (numerics-not-a-number) (numerics-not-a-number)))))

(defun numerics-slopes-at (plane x y)
  "The matrix ((a b) (c d)) of the derivatives of the rates at (X, Y), in units of the window."
  (let ((state (numerics-state-over plane x y))
        (axes (mapcar #'numerics-axis-width (numerics-plane-axes plane))))
    (loop for row in (cond ((null state)
                            (make-list 2 :initial-element
                                       (make-list 2 :initial-element (numerics-not-a-number))))
                           ((numerics-plane-branch plane)
                            (numerics-slopes-on-branch (numerics-plane-branch plane) state))
                           (t (numerics-full-slopes (numerics-plane-forwards plane) state)))
          for height in axes
          collect (loop for e in row for width in axes collect (/ (* e width) height)))))

(defun numerics-slopes-on-branch (branch state)
  (let ((slopes (funcall (numerics-branch-slopes branch) state)))
    (loop for i below 2 collect (list (aref slopes i) (aref slopes (+ 2 i))))))

(defun numerics-full-slopes (problem state)
  "The matrix of the jacobian of PROBLEM, which has two states."
  (let* ((pattern (numerics-problem-pattern problem))
         (starts (numerics-pattern-starts pattern)) (rows (numerics-pattern-rows pattern))
         (values (numerics-zeros (length rows))) (matrix (list (list 0d0 0d0) (list 0d0 0d0))))
    (funcall (numerics-problem-jacobian problem) (numerics-moment 0d0) state values)
    (dotimes (j 2 matrix)
      (loop for k from (aref starts j) below (aref starts (1+ j))
            do (setf (nth j (nth (aref rows k) matrix)) (aref values k))))))
