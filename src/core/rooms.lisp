;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The rooms of the house in their order, and what each may use. A room uses also what those use,
;;; and nothing that comes later: the arrows run one way. Keys of compiled files and the registers
;;; follow this table; a part of a room may be compiled from constants, structures and macros of any
;;; room that it may use.

(in-package :maxima)

(defparameter *core-rooms*
  '(("core")
    ("archive" "core")
    ("algebra" "core")
    ("forms" "algebra")
    ("linmodel" "forms")
    ("circuits" "forms")
    ("analysis" "forms")
    ("numerics" "forms"))
  "Each row: a room, and the rooms it may use.")

(defun core-rooms-used (room)
  "ROOM and all rooms that it may use, in the order of the table."
  (let ((used (list room)))
    (dolist (row (reverse *core-rooms*))
      (when (member (car row) used :test #'equal)
        (setq used (union (cdr row) used :test #'equal))))
    (loop for (name) in *core-rooms* when (member name used :test #'equal) collect name)))
