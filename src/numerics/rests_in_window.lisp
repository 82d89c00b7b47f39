;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The equilibria that lie in a window, exact, with their verdicts, from what the analysis says of
;;; the system; angles by whole turns. Where it says nothing they are found by Newton's method, as
;;; numbers, and nothing is decided. From saddles the separatrices begin. Look first at
;;; numerics-rests-in-window.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/decimals" "numerics/followed_branch" "numerics/plane"
                "numerics/plane_axes" "numerics/problem" "numerics/run"
                "numerics/run_options" "numerics/trajectories"))

(defstruct numerics-rest
  place      ; (u v)
  values     ; exact values of the two states
  verdict)

(defstruct numerics-rests
  (found '())  ; numerics-rest records
  (elsewhere 0) ; how many lie on other branches
  (about '())) ; sentences, newest first

(defun numerics-say-about (rests control &rest arguments)
  (pushnew (apply #'format nil control arguments) (numerics-rests-about rests) :test #'string=))

;;; From solutions [x = .., ..]

(defun numerics-rest-value (name solution)
  "The exact value of the state NAME in SOLUTION; nil where it is left open."
  (let ((equation (find name (numerics-items solution) :key #'second :test #'alike1)))
    (cond (equation (third equation))
          ((numerics-velocity-p name) 0))))

(defun numerics-in-section-p (plane solution)
  "Whether what is held has the values of SOLUTION, or any."
  (loop for (name . held) in (numerics-plane-held plane)
        for value = (numerics-rest-value name solution)
        always (or (null value) (not ($constantp value))
                   (let ((there (numerics-number-or-nil value))
                         (here (numerics-number-or-nil held)))
                     (and there (< (abs (- there here)) (* 1d-9 (max 1d0 (abs here)))))))))

(defun numerics-solution-held (plane solution)
  "SOLUTION where those of its free parameters that are what is held have its values."
  (loop for (name . held) in (numerics-plane-held plane)
        for value = (numerics-rest-value name solution)
        do (when (and (symbolp value) value (not ($constantp value)))
             (setq solution ($substitute held value solution))))
  solution)

(defun numerics-whole-turns (axis number)
  "The whole turns by which NUMBER comes into the window of AXIS."
  (let ((place (numerics-place axis number)) (turns (numerics-axis-turns axis)))
    (if turns
        (let ((way (/ (* 2 pi turns) (numerics-axis-width axis))))
          (loop for k from (ceiling (- -1d-9 place) way) to (floor (- 1.000000001d0 place) way)
                collect (* k turns)))
        (and (<= -1d-9 place 1.000000001d0) '(0)))))

(defun numerics-turned (value turns) (add value (mul 2 turns '$%pi)))

(defun numerics-stands-still-p (plane x y)
  "Whether (X, Y) is at rest but for rounding."
  (multiple-value-bind (du dv) (numerics-slope-at plane x y)
    (let ((slopes (numerics-slopes-at plane x y)))
      (<= (max (abs du) (abs dv))
          (* 1d-9 (+ 1d-9 (loop for row in slopes sum (loop for e in row sum (abs e)))))))))

(defun numerics-rests-of-solution (plane solution verdict)
  "The rests that SOLUTION is in the window, by whole turns; :open where it is a family there."
  (let* ((axes (numerics-plane-axes plane))
         (values (loop for axis in axes
                       collect (numerics-rest-value (numerics-axis-name axis) solution)))
         (numbers (mapcar #'numerics-number-or-nil values)))
    (cond ((some #'null values) :open)
          ((some #'null numbers) (if (every #'$constantp values) '() :open))
          (t (loop for k in (numerics-whole-turns (first axes) (first numbers))
                   append (loop for l in (numerics-whole-turns (second axes) (second numbers))
                                collect (numerics-rest-of axes (mapcar #'numerics-turned values
                                                                       (list k l))
                                                          verdict)))))))

(defun numerics-rest-of (axes values verdict)
  (make-numerics-rest :values values :verdict verdict
                      :place (mapcar (lambda (axis value)
                                       (numerics-place axis (numerics-number-or-nil value)))
                                     axes values)))

(defun numerics-add-solutions (rests plane points)
  "Those of POINTS, lists [solution, verdict], that lie in the section and in the window."
  (dolist (point (numerics-items points))
    (destructuring-bind (solution verdict) (numerics-items point)
      (setq solution (numerics-solution-held plane solution))
      (when (numerics-in-section-p plane solution)
        (let ((found (numerics-rests-of-solution plane solution verdict)))
          (if (eq found :open)
              (numerics-say-about rests "the family of equilibria ~a is not marked"
                                  (core-cut (core-words (list solution))))
              (dolist (rest found)
                (if (numerics-rest-on-branch-p plane solution rest)
                    (numerics-add-rest rests rest)
                    (incf (numerics-rests-elsewhere rests))))))))))

(defun numerics-rest-on-branch-p (plane solution rest)
  "Whether REST of SOLUTION has what the branch of PLANE has there."
  (let* ((branch (numerics-plane-branch plane))
         (state (and branch (apply #'numerics-state-over plane
                                   (mapcar #'numerics-number-or-nil (numerics-rest-values rest))))))
    (or (null branch)
        (and state
             (loop for name in (numerics-branch-names branch)
                   for scale in (numerics-branch-scales branch)
                   for k from 2
                   for value = (numerics-number-or-nil (numerics-rest-value name solution))
                   always (and value
                               (< (abs (- value (aref state k)))
                                  (* 1d-7 (+ scale (abs value))))))))))

(defun numerics-add-rest (rests rest)
  "REST among RESTS, true where it is new."
  (unless (find-if (lambda (other)
                     (< (numerics-apart (numerics-rest-place other) (numerics-rest-place rest))
                        1d-7))
                   (numerics-rests-found rests))
    (push rest (numerics-rests-found rests))))

;;; Newton's method, from places all over the window

(defun numerics-newton-step (plane x y)
  "Two values: the point after a step from (X, Y); nil where there is none."
  (destructuring-bind ((a b) (c d)) (numerics-slopes-at plane x y)
    (multiple-value-bind (du dv) (numerics-slope-at plane x y)
      (let* ((axes (numerics-plane-axes plane))
             (determinant (- (* a d) (* b c)))
             (s (/ (- (* b dv) (* d du)) determinant)) (z (/ (- (* c du) (* a dv)) determinant)))
        (when (and (numerics-finite-p s) (numerics-finite-p z) (< (max (abs s) (abs z)) 1d0))
          (values (+ x (* s (numerics-axis-width (first axes))))
                  (+ y (* z (numerics-axis-width (second axes)))) ))))))

(defun numerics-newton (plane x y)
  "The list (x y) to which the steps from (X, Y) lead, or nil."
  (loop repeat 30
        do (multiple-value-setq (x y) (numerics-newton-step plane x y))
           (unless (and x y) (return nil))
        finally (return (and (numerics-stands-still-p plane x y) (list x y)))))

(defparameter *numerics-newton-starts* 12 "Along an axis.")

(defun numerics-newton-places ()
  (loop for i below *numerics-newton-starts*
        append (loop for j below *numerics-newton-starts*
                     collect (list (/ (+ i 0.5d0) *numerics-newton-starts*)
                                   (/ (+ j 0.5d0) *numerics-newton-starts*)))))

(defun numerics-add-zeros (rests plane)
  "Adds the isolated zeros of PLANE that are not among RESTS; their number."
  (loop with axes = (numerics-plane-axes plane)
        for start in (numerics-newton-places)
        for found = (apply #'numerics-newton plane (mapcar #'numerics-at-place axes start))
        for place = (and found (mapcar #'numerics-place axes found))
        when (and place (numerics-inside-p place) (numerics-isolated-p plane found))
          count (numerics-add-rest rests (make-numerics-rest :place place :values found
                                                             :verdict "not decided"))))

(defun numerics-isolated-p (plane point)
  (destructuring-bind ((a b) (c d)) (apply #'numerics-slopes-at plane point)
    (> (abs (- (* a d) (* b c))) (* 1d-6 (expt (max (abs a) (abs b) (abs c) (abs d)) 2)))))

;;; All of them

(defun numerics-say-zeros (rests plane why)
  "Adds zeros of PLANE to RESTS and says so; WHY, or nil, are there none but these."
  (let ((count (numerics-add-zeros rests plane)))
    (cond (why (numerics-say-about
                rests "equilibria are found by Newton's method, and not judged: ~a"
                (core-unnamed why)))
          ((plusp count)
           (numerics-say-about
            rests "the ~[~;point that is~:;points that are~] not decided: the two rates vanish, ~
                   found by Newton's method; what is not drawn may move" count)))))

(defun numerics-rests-in-window (plane said)
  "The equilibria of PLANE; SAID is [points], or the text why there are none."
  (let* ((rests (make-numerics-rests)) (points (numerics-items said)))
    (when points (numerics-add-solutions rests plane (first points)))
    (cond ((numerics-plane-moving plane)
           (unless points
             (numerics-say-about rests "equilibria are not marked: ~a" (core-unnamed said))))
          ((not (or (numerics-rests-about rests) (and points (numerics-plane-alone plane))))
           (numerics-say-zeros rests plane (if points nil said))))
    (setf (numerics-rests-found rests)
          (sort (numerics-rests-found rests) #'numerics-before-p :key #'numerics-rest-place))
    (when (numerics-plane-branch plane) (numerics-say-branch rests plane))
    rests))

(defun numerics-say-branch (rests plane)
  (numerics-say-point rests plane (numerics-plane-branch plane))
  (when (notevery (lambda (place) (numerics-reached-p plane place)) (numerics-newton-places))
    (numerics-say-about rests "curves end where it does"))
  (when (numerics-plane-unrated plane)
    (numerics-say-about rests "where curves end the rate of ~{~a~^, ~} is infinite"
                        (mapcar #'numerics-name-text (numerics-plane-unrated plane))))
  (when (plusp (numerics-rests-elsewhere rests))
    (numerics-say-about rests "~d equilibri~:[um~;a~] off the branch ~:*~:[is~;are~] not marked"
                        (numerics-rests-elsewhere rests) (> (numerics-rests-elsewhere rests) 1))))

(defun numerics-say-point (rests plane branch)
  (let ((names (numerics-branch-names branch))
        (axes (mapcar #'numerics-axis-name (numerics-plane-axes plane))))
    (numerics-say-about
     rests "~{~a~^, ~} ~:[is~;are~] on the branch through ~{~a = ~a~^, ~}"
     (mapcar #'numerics-name-text names) (cdr names)
     (loop for name in (append axes names)
           for x across (numerics-branch-known branch)
           append (list (numerics-name-text name) (numerics-short-number x))))))

(defun numerics-reached-p (plane place)
  (apply #'numerics-state-over plane
         (mapcar #'numerics-at-place (numerics-plane-axes plane) place)))

(defun numerics-before-p (place other)
  (destructuring-bind ((u v) (s z)) (list place other)
    (or (< u (- s 1d-9)) (and (<= u (+ s 1d-9)) (< v z)))))

;;; Separatrices: along the directions of a saddle, those of real roots of both signs

(defun numerics-saddle-directions (slopes)
  "((du dv) .. ), outgoing then ingoing, of the matrix SLOPES; nil where it is no saddle."
  (destructuring-bind ((a b) (c d)) slopes
    (let ((determinant (- (* a d) (* b c))) (half (/ (+ a d) 2)))
      (when (and (numerics-finite-p determinant) (< determinant 0d0))
        (let ((root (sqrt (- (* half half) determinant))))
          (list (numerics-root-direction a b c d (+ half root))
                (numerics-root-direction a b c d (- half root))))))))

(defun numerics-root-direction (a b c d root)
  "The direction of length 1 that ((A B) (C D)) multiplies by ROOT."
  (destructuring-bind (u v) (if (> (+ (abs b) (abs (- a root))) (+ (abs c) (abs (- d root))))
                                (list b (- root a))
                                (list (- root d) c))
    (let ((size (sqrt (+ (* u u) (* v v)))))
      (list (/ u size) (/ v size)))))

(defun numerics-separatrices (plane rests)
  "The curves out of and into the saddles among RESTS."
  (loop with places = (mapcar #'numerics-rest-place rests)
        for place in places
        for directions = (numerics-saddle-directions
                          (apply #'numerics-slopes-at plane
                                 (mapcar #'numerics-at-place (numerics-plane-axes plane) place)))
        append (loop for direction in directions
                     for sense in '(1d0 -1d0)
                     append (loop for size in '(1d-3 -1d-3)
                                  for start = (mapcar (lambda (u du) (+ u (* size du))) place
                                                      direction)
                                  for curve = (numerics-separatrix plane sense place start places)
                                  when curve collect curve))))

(defun numerics-separatrix (plane sense place start places)
  "The curve from the saddle at PLACE through START, backwards in time where SENSE is -1."
  (let ((trace (and (numerics-inside-p start *numerics-curve-margin*)
                    (numerics-trace-from plane sense start places (numerics-new-visits)))))
    (when (and trace (numerics-trace-points trace))
      (let ((points (list* place start (reverse (numerics-trace-points trace)))))
        (make-numerics-curve
         :points (if (plusp sense) points (reverse points))
         :arrows (list (numerics-arrow-at plane (numerics-middle points))))))))

(defun numerics-middle (points)
  "That of POINTS, inside the window, which stands in the middle of those inside."
  (let ((inside (remove-if-not #'numerics-inside-p points)))
    (nth (floor (length inside) 2) inside)))
