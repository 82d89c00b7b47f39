;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; An expression evaluated while conditions are taken as facts; they are forgotten on every exit.

(in-package :maxima)

(defmspec $analysis_given (form)
  ;; analysis_given(conditions, e): the value of e where the conditions hold.
  (destructuring-bind (conditions e) (cdr form)
    (let ((assumed (mfuncall '$analysis_assume (meval conditions))))
      (unwind-protect (meval e) (mfuncall '$analysis_forget assumed)))))
