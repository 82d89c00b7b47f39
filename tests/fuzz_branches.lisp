;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The adversary of branches followed over a plane: 0 = h(v) - (A a + B b), h(v) = v^3 + p v + c sin(m v), which often folds, at
;;; times narrowly. Along a line from the start a, b move h alone, so that the truth is read off h: v goes where h grows or falls, until h has
;;; the value wanted, or a slope of 0 comes first, and the branch ends. What is found must be that; what is not followed though it could be
;;; is counted, and may not be more than a twentieth.
;;;   fuzz_branches(count, seed)     list of failures

(in-package :maxima)

(core-require "numerics/followed_branch" "numerics/native")

(defvar *branches-state* nil)

(defun branches-between (low high) (+ low (* (- high low) (random 1d0 *branches-state*))))

(defstruct (branches-case (:conc-name branches-)) p c m a b v0)

(defun branches-random-case ()
  (make-branches-case :p (branches-between -2d0 2d0)
                      :c (if (zerop (random 2 *branches-state*)) 0d0 (branches-between 0d0 0.5d0))
                      :m (branches-between 1d0 9d0)
                      :a (branches-between -2d0 2d0) :b (branches-between -2d0 2d0)
                      :v0 (branches-between -1.5d0 1.5d0)))

(defun branches-h (case v)
  (+ (* v v v) (* (branches-p case) v) (* (branches-c case) (sin (* (branches-m case) v)))))

(defun branches-slope (case v)
  (+ (* 3 v v) (branches-p case)
     (* (branches-c case) (branches-m case) (cos (* (branches-m case) v)))))

;;; By definition

(defun branches-truth (case wanted)
  "The v that is reached, or nil; and the least slope on the way, relative to that at the start."
  (let* ((v (branches-v0 case)) (start (branches-slope case v)) (h (branches-h case v))
         (step (* 1d-4 (signum (- wanted h)) (signum start))) (least 1d0))
    (loop
      (let* ((next (+ v step)) (slope (branches-slope case next)))
        (setq least (min least (/ slope start)))
        (cond ((<= (/ slope start) 0) (return (values nil 0d0)))
              ((<= (* (- (branches-h case next) wanted) (- h wanted)) 0)
               (return (values (branches-halved case v next wanted) least)))
              (t (setq v next)))))))

(defun branches-halved (case a b wanted)
  (loop repeat 80
        do (let ((middle (/ (+ a b) 2)))
             (if (plusp (* (- (branches-h case middle) wanted) (- (branches-h case a) wanted)))
                 (setq a middle)
                 (setq b middle)))
        finally (return a)))

;;; By the branch

(defun branches-branch (case)
  (flet ((numbers (&rest list) (coerce list '(simple-array double-float (*)))))
    (let ((v0 (branches-v0 case)) (a (branches-a case)) (b (branches-b case)))
      ;; the start lies where A a + B b = h(v0), on the line b = 0
      (make-numerics-branch
       :names '($v)
       :known (numbers (/ (branches-h case v0) a) 0d0 v0)
       :newton (lambda (state)
                 (let ((v (aref state 2)))
                   (numbers (/ (- (+ (* a (aref state 0)) (* b (aref state 1)))
                                  (branches-h case v))
                               (branches-slope case v)))))
       :tilts (lambda (state)
                (let ((slope (branches-slope case (aref state 2))))
                  (numbers (/ a slope) (/ b slope))))
       :slopes nil
       :determinant (lambda (state) (numbers (branches-slope case (aref state 2))))))))

(defun branches-failure (case)
  "nil, :lost, or what is wrong."
  (let ((branch (branches-branch case)) (b (branches-between -1.5d0 1.5d0))
        (a (branches-between -1.5d0 1.5d0)))
    (when (numerics-with-masked-traps (numerics-settle-branch branch '(3d0 3d0)))
      (let ((found (numerics-with-masked-traps (numerics-branch-at branch a b)))
            (wanted (+ (* a (branches-a case)) (* b (branches-b case)))))
        (multiple-value-bind (v least) (branches-truth case wanted)
          (cond ((and found (null v)) (list case a b :found (aref found 2) :truth nil))
                ((and found (> (abs (- (aref found 2) v)) 1d-7)) (list case a b :found (aref found 2) :truth v))
                ((and v (null found)) (if (> least 0.05d0) :lost nil))))))))

(defun $fuzz_branches (count seed)
  (let* ((*branches-state* (sb-ext:seed-random-state seed))
         (failures (loop repeat count
                         for failure = (branches-failure (branches-random-case))
                         when failure collect failure))
         (lost (count :lost failures)) (wrong (remove :lost failures)))
    (cons '(mlist simp)
          (mapcar (lambda (failure) (format nil "~s" failure))
                  (if (> lost (/ count 20)) (cons (list lost "are not followed") wrong) wrong)))))
