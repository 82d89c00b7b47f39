;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For rtest_numerics_radau.mac.

(in-package :maxima)

(defun $test_radau (problem span start tolerance &rest settings)
  (test-run 'numerics-radau problem span start tolerance settings))
