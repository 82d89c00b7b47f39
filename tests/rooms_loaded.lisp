;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For suites that look at which parts are loaded.

(in-package :maxima)

(defun $test_loaded_parts (room)
  "The parts of ROOM, such as numerics/, that are loaded but its register."
  (cons '(mlist simp)
        (sort (loop for part being the hash-keys of *core-loaded*
                    when (and (stringp part) (eql (search room part) 0)
                              (not (search "register" part)))
                      collect part)
              #'string<)))
