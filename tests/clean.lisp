;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Calls in the clean session, as the dispatcher makes them.

(in-package :maxima)

(defun $clean_value (function &rest arguments)
  (core-clean-call function arguments))
