;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; States w that equations 0 = g determine over a plane of states a, b, followed from a point that
;;; is known: along a line, by short steps with Newton's corrections, as long as the determinant of
;;; g_w keeps its sign. Where it vanishes the branch ends, and beyond w has no value. Inside masked
;;; traps. Look first at numerics-branch-at.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem"))

(defstruct numerics-branch
  names                 ; w
  known                 ; the vector (a b w ..) from which w is followed
  scales                ; of w, a list
  newton tilts slopes determinant ; functions of the state, vectors: see numerics-branch-elements
  side)                 ; the sign of the determinant

(defun numerics-branch-side-at (branch state)
  "The sign of the determinant at STATE, 0 where it has no value."
  (let ((value (aref (funcall (numerics-branch-determinant branch) state) 0)))
    (if (numerics-finite-p value) (signum value) 0d0)))

(defun numerics-on-branch-p (branch state)
  (let ((side (numerics-branch-side-at branch state)))
    (and (/= side 0d0) (= side (numerics-branch-side branch)))))

;;; Newton's method

(defparameter *numerics-newton-steps* 12)
(defparameter *numerics-branch-digits* 1d-11 "A correction that small ends Newton's method.")

(defun numerics-correct (branch state)
  "A step of Newton's on w in STATE; how large it was in units of the scales."
  (let ((steps (funcall (numerics-branch-newton branch) state)))
    (loop for scale in (numerics-branch-scales branch)
          for k from 0
          do (incf (aref state (+ 2 k)) (aref steps k))
          sum (/ (abs (aref steps k)) (+ scale (abs (aref state (+ 2 k))))))))

(defun numerics-corrected-p (branch state allowed)
  "Changes w in STATE so that 0 = g; true where the steps are at most ALLOWED and shrink."
  (loop repeat *numerics-newton-steps*
        for size = (numerics-correct branch state)
        do (cond ((not (and (numerics-finite-p size) (<= size allowed))) (return nil))
                 ((< size *numerics-branch-digits*)
                  (return (numerics-on-branch-p branch state))))
           (setq allowed (* 0.5d0 size))))

;;; Along a line

(defparameter *numerics-largest-share* 0.0625d0 "A step in parts of the way.")
(defparameter *numerics-least-share* 1d-4)

(defun numerics-allowed-correction (branch change)
  "What Newton's steps may add to CHANGE of w; more would be another branch behind a narrow fold."
  (+ 2d-3 (* 0.2d0 (loop for scale in (numerics-branch-scales branch)
                         for dw in change sum (/ (abs dw) scale)))))

(defun numerics-tilt (branch state da db)
  "By how much w changes from STATE with DA and DB, a list."
  (let* ((tilts (funcall (numerics-branch-tilts branch) state))
         (count (length (numerics-branch-names branch))))
    (loop for k below count
          collect (+ (* da (aref tilts k)) (* db (aref tilts (+ count k)))))))

(defun numerics-moved (state shift share)
  "STATE and SHARE of SHIFT."
  (let ((moved (copy-seq state)))
    (loop for d in shift
          for k from 0
          do (incf (aref moved k) (* share d)))
    moved))

(defun numerics-steady-p (branch state shift)
  "Whether the determinant stays within half and twice what it is at STATE along SHIFT, so that no
fold lies between."
  (flet ((determinant (state) (aref (funcall (numerics-branch-determinant branch) state) 0)))
    (let ((here (determinant state)))
      (loop for share in '(0.25d0 0.5d0 0.75d0 1d0)
            for ratio = (/ (determinant (numerics-moved state shift share)) here)
            always (and (numerics-finite-p ratio) (< 0.5d0 ratio 2d0))))))

(defun numerics-next-on-branch (branch state da db)
  "STATE moved on by DA and DB; nil where w cannot be followed so far."
  (let* ((change (numerics-tilt branch state da db)) (shift (list* da db change)))
    (when (numerics-steady-p branch state shift)
      (let ((next (numerics-moved state shift 1d0)))
        (and (numerics-corrected-p branch next (numerics-allowed-correction branch change))
             (numerics-steady-p branch state (map 'list #'- next state))
             next)))))

(defun numerics-branch-at (branch a b)
  "The vector (A B w ..) on BRANCH; nil where it does not reach so far along a line."
  (let* ((known (numerics-branch-known branch)) (state known)
         (da (- a (aref known 0))) (db (- b (aref known 1))))
    (loop with way = 0d0 and share = *numerics-largest-share*
          while (< way 1d0)
          do (let* ((part (min share (- 1d0 way)))
                    (next (numerics-next-on-branch branch state (* part da) (* part db))))
               (cond (next (setq state next share (min *numerics-largest-share* (* 2 share)))
                           (incf way part)
                           (when (> way (- 1d0 1d-12)) (setq way 1d0)))
                     (t (setq share (/ part 2))))
               (when (< share *numerics-least-share*) (return-from numerics-branch-at nil))))
    (let ((there (copy-seq state)))
      (setf (aref there 0) a (aref there 1) b)
      there)))

;;; The point from which w is followed

(defun numerics-signs-differ-p (x y)
  (and (numerics-finite-p x) (numerics-finite-p y) (<= (* (signum x) (signum y)) 0d0)))

(defun numerics-halved-zero (value a b)
  "Where the function VALUE changes its sign from A to B."
  (let ((sign (signum (funcall value a))))
    (loop for middle = (/ (+ a b) 2)
          until (or (= middle a) (= middle b))
          do (if (= (signum (funcall value middle)) sign) (setq a middle) (setq b middle))
          finally (return (if (< (abs (funcall value a)) (abs (funcall value b))) a b)))))

(defun numerics-zero-near-0 (value)
  "The zero of the function VALUE that lies nearest to 0, by a change of its sign; nil for none."
  (when (eql 0d0 (abs (funcall value 0d0))) (return-from numerics-zero-near-0 0d0))
  (loop for bound = 1d-6 then (* 2 bound)
        while (< bound 1d12)
        do (loop for end in (list bound (- bound))
                 for begin = (if (= bound 1d-6) 0d0 (/ end 2))
                 do (when (numerics-signs-differ-p (funcall value begin) (funcall value end))
                      (return-from numerics-zero-near-0
                        (numerics-halved-zero value begin end))))))

(defun numerics-scale-branch (branch widths)
  "Sets the scales of BRANCH, by how far w goes over WIDTHS of the plane, and its side."
  (let ((known (numerics-branch-known branch)))
    (setf (numerics-branch-side branch) (numerics-branch-side-at branch known)
          (numerics-branch-scales branch)
          (loop for change in (apply #'numerics-tilt branch known widths)
                for k from 2
                for scale = (max (abs (aref known k)) (abs change))
                collect (if (and (numerics-finite-p scale) (plusp scale)) scale 1d0)))))

(defun numerics-settle-branch (branch widths)
  "True where BRANCH goes through a point next to the one that is known, which is corrected."
  (numerics-scale-branch branch widths)
  (let ((corrected (copy-seq (numerics-branch-known branch))))
    (when (numerics-corrected-p branch corrected 1d0)
      (setf (numerics-branch-known branch) corrected)
      (numerics-scale-branch branch widths)
      t)))
