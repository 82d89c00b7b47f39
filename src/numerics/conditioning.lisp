;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; How well double-float numbers can know the end of a run: u times the largest growth of what is
;;; put in at the start or at eight later times, never below u. Growth is that of the variational
;;; equations M w' = J(t, x) w along the solution (Hairer, Norsett, Wanner, Solving Ordinary
;;; Differential Equations I, I.14), from w_i = +-(|x_i| + s_i) with signs that are tried in two
;;; ways, to max |w_i|/(|x_i| + s_i). No run of any accuracy on such numbers has a smaller error but
;;; by luck.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/linear_solver_matrix" "numerics/observers" "numerics/problem"
                "numerics/sparse" "numerics/step_control"))

(defconstant numerics-unit-roundoff 1.1102230246251565d-16
  "Half of the distance from 1 to the next number.")

(defun numerics-conditioning (method problem controls moment state)
  "Two values: u times the growth over the span of CONTROLS, and the time since when that is; nil
where METHOD, a function such as numerics-dopri, does not reach the end."
  (let* ((n (numerics-problem-size problem)) (both (numerics-variational-problem problem))
         (scales (numerics-full-scales controls n)) (largest 1d0) (since (aref moment 0)))
    (loop for (time . x) in (numerics-states-on-the-way method problem controls moment state)
          do (dotimes (k 2)
               (let ((growth (numerics-growth method both controls
                                              (numerics-moment time)
                                              (numerics-perturbed x scales k))))
                 (unless growth (return-from numerics-conditioning nil))
                 (when (> growth largest) (setq largest growth since time)))))
    (values (* numerics-unit-roundoff largest) since)))

(defun numerics-states-on-the-way (method problem controls moment state)
  "List of (time . state): the start and eight later times."
  (let* ((start (aref moment 0)) (end (numerics-controls-end controls))
         (rows (numerics-new-rows (numerics-uniform-times start end 10) moment state nil))
         (length (numerics-rows-width rows)))
    (funcall method problem (numerics-copied-controls controls 1d-8 end) moment state
             (lambda (step) (numerics-see-rows rows step)))
    (loop for k below (min 9 (numerics-rows-count rows))
          for place = (* k length)
          collect (cons (aref (numerics-rows-numbers rows) place)
                        (subseq (numerics-rows-numbers rows) (1+ place) (+ place length))))))

(defun numerics-perturbed (x scales k)
  "X, and behind it a perturbation of its size, whose signs are all + for K = 0, else mixed."
  (let* ((n (length x)) (both (numerics-zeros (* 2 n))))
    (replace both x)
    (dotimes (i n both)
      (setf (aref both (+ n i))
            (* (if (and (= k 1) (logtest 2 (* i (1+ i)))) -1 1)
               (+ (abs (aref x i)) (aref scales i)))))))

(defun numerics-growth (method both controls moment state)
  (let* ((n (floor (length state) 2)) (scales (numerics-full-scales controls n))
         (copy (numerics-copied-controls controls 1d-6 (numerics-controls-end controls))))
    (setf (numerics-controls-scales copy) (concatenate 'numerics-vector scales scales)
          (numerics-controls-inspect copy) nil)
    (let* ((outcome (funcall method both copy moment state (constantly nil)))
           (end (numerics-outcome-state outcome)))
      (when (eq (numerics-outcome-status outcome) :end)
        (loop for i below n
              maximize (/ (abs (aref end (+ n i)))
                          (numerics-scale (aref end i) 0d0 (aref scales i))))))))

;;; The equations with their variational ones, of the states (x, w).

(defun numerics-variational-problem (problem)
  (let ((n (numerics-problem-size problem)) (mass (numerics-problem-mass problem))
        (pattern (numerics-problem-pattern problem)))
    (make-numerics-problem
     :size (* 2 n) :rates (numerics-variational-rates problem)
     :timed (numerics-problem-timed problem)
     :jacobian (and pattern (numerics-doubled-jacobian problem))
     :pattern (and pattern (numerics-doubled-pattern pattern))
     :mass (and mass (make-numerics-matrix
                      :pattern (numerics-doubled-pattern (numerics-matrix-pattern mass))
                      :values (concatenate 'numerics-vector (numerics-matrix-values mass)
                                           (numerics-matrix-values mass)))))))

(defun numerics-doubled-pattern (pattern)
  "The pattern of two such blocks in the diagonal."
  (let* ((n (numerics-pattern-size pattern)) (columns (make-array (* 2 n))))
    (dotimes (j n (numerics-pattern-of-columns columns))
      (let ((rows (numerics-column-rows pattern j)))
        (setf (aref columns j) rows
              (aref columns (+ n j)) (mapcar (lambda (row) (+ n row)) rows))))))

(defun numerics-doubled-jacobian (problem)
  "The second derivatives below the diagonal are left out: Newton's method can do without."
  (let* ((n (numerics-problem-size problem)) (x (numerics-zeros n))
         (entries (length (numerics-pattern-rows (numerics-problem-pattern problem))))
         (values (numerics-zeros entries)))
    (lambda (moment both out)
      (replace x both)
      (funcall (numerics-problem-jacobian problem) moment x values)
      (replace out values)
      (replace out values :start1 entries))))

(defun numerics-variational-rates (problem)
  (let* ((n (numerics-problem-size problem)) (x (numerics-zeros n)) (w (numerics-zeros n))
         (out (numerics-zeros n)) (slope (numerics-slope-routine problem))
         (rates (numerics-problem-rates problem)))
    (lambda (moment both both-out)
      (replace x both)
      (replace w both :start2 n)
      (funcall rates moment x out)
      (replace both-out out)
      (funcall slope moment x w out)
      (replace both-out out :start1 n))))

(defun numerics-slope-routine (problem)
  "The function (moment x w out): J w into OUT, by the jacobian or by a difference on both sides."
  (let* ((pattern (numerics-problem-pattern problem)) (n (numerics-problem-size problem))
         (values (and pattern (numerics-zeros (length (numerics-pattern-rows pattern)))))
         (place (numerics-zeros n)) (other (numerics-zeros n))
         (rates (numerics-problem-rates problem)))
    (if pattern
        (lambda (moment x w out)
          (funcall (numerics-problem-jacobian problem) moment x values)
          (numerics-multiply pattern values w out))
        (lambda (moment x w out)
          (let ((share (numerics-difference-share x w)))
            (map-into place (lambda (a b) (+ a (* share b))) x w)
            (funcall rates moment place out)
            (map-into place (lambda (a b) (- a (* share b))) x w)
            (funcall rates moment place other)
            (map-into out (lambda (a b) (/ (- a b) (* 2 share))) out other))))))

(defun numerics-difference-share (x w)
  "A share of W that moves X by 10^-5 of 1 + |x_i| at most."
  (/ 1d-5 (loop for a across x
                for b across w
                maximize (/ (abs b) (+ 1d0 (abs a))) into largest
                finally (return (max largest 1d-300)))))
