;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_runs_random.mac: faults that are planted.

(in-package :maxima)

(defmspec $test_without (form)
  ;; test_without("function of Lisp", e): the value of e while that function says nil
  (destructuring-bind (name e) (cdr form)
    (let* ((symbol (intern (string-upcase (meval name)) :maxima)) (own (symbol-function symbol)))
      (setf (symbol-function symbol) (constantly nil))
      (unwind-protect (meval e) (setf (symbol-function symbol) own)))))
