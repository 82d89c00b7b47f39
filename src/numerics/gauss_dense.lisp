;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The state inside a step of Gauss-Legendre collocation. The collocation polynomial of s stages is
;;; of order s only there, where the method is of order 2s. So where somebody asks, parts of the
;;; step from its begin to 1/s, 2/s, .. are made by the method itself, with that polynomial as the
;;; first guess; Hermite's polynomial through these states and their rates is of order 2s + 1.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/gauss_coefficients" "numerics/gauss_stages"))

(defstruct numerics-gauss-dense
  run inner          ; the run, and one for parts of its step
  seen
  (step-number 0)    ; that of the step of the states below
  states slopes)     ; s + 1 vectors each: at 0, 1/s, .., 1

(defun numerics-gauss-dense (run seen controls)
  "The function (share out) for the step SEEN."
  (let* ((n (numerics-gauss-run-size run)) (stages (numerics-gauss-run-stages run))
         (dense (flet ((several ()
                         (coerce (loop repeat (1+ stages) collect (numerics-zeros n)) 'vector)))
                  (make-numerics-gauss-dense
                   :run run :seen seen :states (several) :slopes (several)
                   :inner (numerics-new-gauss-run (numerics-gauss-run-problem run) stages
                                                  controls)))))
    (lambda (share out)
      (let ((number (numerics-counts-steps (numerics-gauss-run-counts run))))
        (unless (= number (numerics-gauss-dense-step-number dense))
          (numerics-gauss-set-dense dense)
          (setf (numerics-gauss-dense-step-number dense) number)))
      (numerics-hermite-value dense share out))))

(defun numerics-gauss-set-dense (dense)
  "The states and slopes of the step that has just been made."
  (let* ((seen (numerics-gauss-dense-seen dense)) (states (numerics-gauss-dense-states dense))
         (stages (numerics-gauss-run-stages (numerics-gauss-dense-run dense))))
    (replace (aref states 0) (numerics-step-before seen))
    (replace (aref states stages) (numerics-step-after seen))
    (loop for k from 1 below stages
          do (numerics-gauss-part-of-step dense k))
    (dotimes (k (1+ stages))
      (numerics-gauss-set-slope dense k))))

(defun numerics-gauss-part-of-step (dense k)
  "The state at the share k/s of the step."
  (let* ((run (numerics-gauss-dense-run dense)) (inner (numerics-gauss-dense-inner dense))
         (seen (numerics-gauss-dense-seen dense)) (memory (numerics-gauss-run-memory run))
         (state (aref (numerics-gauss-dense-states dense) k))
         (shares (numerics-gauss-table-shares (numerics-gauss-run-table run))))
    (numerics-gauss-set-step inner (* (/ k (numerics-gauss-run-stages run))
                                      (numerics-gauss-run-step run)))
    (fill (numerics-gauss-run-low inner) 0d0)
    (replace state (numerics-step-before seen))
    (numerics-gauss-foretell inner (svref shares k) memory 1)
    (numerics-gauss-settle inner (numerics-step-from seen) state t)
    (numerics-gauss-advance inner state)))

(defun numerics-gauss-set-slope (dense k)
  "The rates there, times the step."
  (let* ((run (numerics-gauss-dense-run dense)) (step (numerics-gauss-run-step run))
         (moment (copy-seq (numerics-step-from (numerics-gauss-dense-seen dense))))
         (slope (aref (numerics-gauss-dense-slopes dense) k)))
    (numerics-advance moment (* (/ k (numerics-gauss-run-stages run)) step))
    (funcall (numerics-problem-rates (numerics-gauss-run-problem run))
             moment (aref (numerics-gauss-dense-states dense) k) slope)
    (incf (numerics-counts-rates (numerics-gauss-run-counts run)))
    (map-into slope (lambda (x) (* step x)) slope)))

(defun numerics-hermite-value (dense share out)
  "Hermite's polynomial at SHARE: x_0 + sum_k [H_k (x_k - x_0) + G_k h x'_k], with the polynomials
l_k of Lagrange G_k = (share - k/s) l_k^2, H_k = l_k^2 - 2 l_k'(k/s) G_k."
  (declare (double-float share) (type numerics-vector out))
  (let* ((states (numerics-gauss-dense-states dense)) (slopes (numerics-gauss-dense-slopes dense))
         (first (aref states 0)) (last (1- (length states))))
    (declare (type numerics-vector first) (type fixnum last))
    (replace out first)
    (dotimes (k (1+ last) out)
      (multiple-value-bind (h g) (numerics-hermite-factors share k last)
        (declare (double-float h g))
        (let ((state (aref states k)) (slope (aref slopes k)))
          (declare (type numerics-vector state slope) (optimize speed))
          (dotimes (i (length out))
            (incf (aref out i) (+ (* h (- (aref state i) (aref first i)))
                                  (* g (aref slope i))))))))))

(defun numerics-hermite-factors (share k last)
  "H_k and G_k of the nodes 0, 1/LAST, .., 1 at SHARE."
  (declare (double-float share) (type (integer 0 100) k last))
  (let ((lagrange 1d0) (slope 0d0) (distance (- share (/ (float k 1d0) last))))
    (declare (double-float lagrange slope))
    (dotimes (m (1+ last))
      (unless (= m k)
        (let ((inverse (/ (float last 1d0) (- k m))))
          (setq lagrange (* lagrange inverse (- share (/ (float m 1d0) last))))
          (incf slope inverse))))
    (let ((g (* distance lagrange lagrange)))
      (values (- (* lagrange lagrange) (* 2 slope g)) g))))
