;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The state inside a step of Radau IIA. The collocation polynomial p is of degree 3, and of a
;;; stiff state, whose error is damped at the end of the step, it may be thousands of tolerances off
;;; between: nothing in the estimate of the step sees it. What p lacks is seen where it is continued
;;; to the second stage of the step before, at the share r < 0 of this one: with w(s) = s (s - c1)
;;; (s - c2) (s - 1) the error is about w(s)/w(r) times the one there. Where that is more than the
;;; tolerance a step of 4/5 of the length gives three states more, and the polynomial through all
;;; seven is taken. See numerics-radau-dense-function first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "numerics/problem" "numerics/radau_coefficients"
                "numerics/radau_newton" "numerics/radau_run"))

(defparameter *numerics-radau-inner-share* 0.8d0)

(defstruct numerics-radau-dense
  run
  (step-number 0)       ; of the step that the rest belongs to
  fine                  ; whether the polynomial through seven states is taken
  (nodes (numerics-zeros 7) :type numerics-vector)
  (factors (numerics-zeros 7) :type numerics-vector)
  states)               ; seven vectors: the states at NODES less that at the beginning

(defun numerics-radau-dense-function (run)
  "The function (share out) for the step of RUN that has just been made."
  (let ((dense (make-numerics-radau-dense
                :run run
                :states (coerce (loop repeat 7
                                      collect (numerics-zeros (length (numerics-radau-run-z1 run))))
                                'vector))))
    (lambda (share out)
      (let ((number (+ (numerics-counts-steps (numerics-radau-run-counts run))
                       (numerics-counts-rejected (numerics-radau-run-counts run)))))
        (unless (= number (numerics-radau-dense-step-number dense))
          (setf (numerics-radau-dense-step-number dense) number
                (numerics-radau-dense-fine dense) (numerics-radau-refine dense))))
      (if (numerics-radau-dense-fine dense)
          (numerics-radau-fine-state dense share out)
          (numerics-radau-between run share out)))))

(defun numerics-radau-between (run share out)
  "The state SHARE of the step after its beginning, by the collocation polynomial, into OUT."
  (declare (double-float share) (type numerics-vector out) (optimize speed))
  (numerics-with-radau (run before z3 p1 p2 p3)
    (numerics-with-radau-numbers (c1 c2)
      (let ((later (- share 1d0)))
        (dotimes (i (length out) out)
          (setf (aref out i)
                (+ (aref before i)
                   (+ (aref z3 i) (numerics-collocation later p1 p2 p3 i)))))))))

;;; What it lacks

(defun numerics-radau-remember (run)
  "The second stage of the step that ends is where the next one looks."
  (numerics-with-radau (run before z2 older step)
    (numerics-add before z2 older)
    (setf (numerics-radau-run-older-step run) step)
    nil))

(defun numerics-radau-lack (run)
  "The largest error of the collocation polynomial within the step, over the tolerance; a large
number in a first step."
  (numerics-with-radau (run older older-step step point weights)
    (if (= older-step 0d0)
        1d9
        (numerics-with-radau-numbers (c2)
          (let ((r (* (- c2 1d0) (/ older-step step))))
            (numerics-radau-between run r point)
            (map-into point #'- older point)
            (* (numerics-weighted-size weights point)
               (/ (numerics-radau-largest-product) (abs (numerics-radau-product r)))))))))

(defun numerics-radau-product (s)
  (numerics-with-radau-numbers (c1 c2) (* s (- s c1) (- s c2) (- s 1d0))))

(defun numerics-radau-largest-product ()
  (loop for k from 1 below 64 maximize (abs (numerics-radau-product (/ k 64d0)))))

;;; Three states more

(defun numerics-radau-refine (dense)
  "Whether the polynomial through seven states is needed, and can be had."
  (let ((run (numerics-radau-dense-run dense)))
    (and (> (numerics-radau-lack run) 1d0)
         (numerics-radau-inner-step run)
         (progn (numerics-radau-set-nodes dense) t))))

(defun numerics-radau-make-inner (run)
  (setf (numerics-radau-run-inner run)
        (numerics-new-radau (numerics-radau-run-problem run) (numerics-radau-run-controls run)
                            (numerics-radau-run-moment run) (numerics-radau-run-before run))))

(defun numerics-radau-inner-step (run)
  "Whether the stages of a step that is shorter are found."
  (let ((inner (or (numerics-radau-run-inner run) (numerics-radau-make-inner run))))
    (replace (numerics-radau-run-moment inner) (numerics-step-from (numerics-radau-run-seen run)))
    (replace (numerics-radau-run-before inner) (numerics-radau-run-before run))
    (replace (numerics-radau-run-entries inner) (numerics-radau-run-entries run))
    (setf (numerics-radau-run-trust inner) 0
          (numerics-radau-run-step inner)
          (* *numerics-radau-inner-share* (numerics-radau-run-step run)))
    (numerics-radau-weigh inner nil)
    (numerics-radau-guess-stages inner)
    (and (not (numerics-radau-set-factors inner))
         (not (numerics-radau-find-stages inner)))))

(defun numerics-radau-set-nodes (dense)
  (let* ((run (numerics-radau-dense-run dense)) (inner (numerics-radau-run-inner run))
         (nodes (numerics-radau-dense-nodes dense)) (share *numerics-radau-inner-share*))
    (numerics-with-radau-numbers (c1 c2)
      (loop for node in (list 0d0 (* share c1) (* share c2) share c1 c2 1d0)
            for stage in (list nil (numerics-radau-run-z1 inner) (numerics-radau-run-z2 inner)
                               (numerics-radau-run-z3 inner) (numerics-radau-run-z1 run)
                               (numerics-radau-run-z2 run) (numerics-radau-run-z3 run))
            for k from 0
            do (setf (aref nodes k) node)
               (when stage (replace (aref (numerics-radau-dense-states dense) k) stage))))
    (dotimes (k 7)
      (setf (aref (numerics-radau-dense-factors dense) k)
            (/ (loop with product = 1d0
                     for j below 7
                     do (unless (= j k)
                          (setq product (* product (- (aref nodes k) (aref nodes j)))))
                     finally (return product)))))))

(defun numerics-radau-fine-state (dense share out)
  "By Lagrange's polynomials; what is 0 at the beginning is not added."
  (declare (double-float share) (type numerics-vector out))
  (let ((nodes (numerics-radau-dense-nodes dense)) (factors (numerics-radau-dense-factors dense)))
    (replace out (numerics-radau-run-before (numerics-radau-dense-run dense)))
    (loop for k from 1 below 7
          do (let ((factor (aref factors k)) (state (aref (numerics-radau-dense-states dense) k)))
               (declare (double-float factor) (type numerics-vector state))
               (dotimes (j 7)
                 (unless (= j k) (setq factor (* factor (- share (aref nodes j))))))
               (dotimes (i (length out)) (incf (aref out i) (* factor (aref state i))))))
    out))
