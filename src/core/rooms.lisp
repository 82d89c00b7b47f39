;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The rooms of the house in their order, and what each may use. A room uses also what those use,
;;; and nothing else: the arrows run one way. Keys of compiled files, the registers and the rules
;;; that tools/house-rules prints follow this table; a part of a room may be compiled from
;;; constants, structures and macros of any room that it may use.

(in-package :maxima)

(defparameter *core-rooms*
  '(("core" () "the core knows nothing above it")
    ("archive" ("core") "the archive room knows files and the register, no mathematics")
    ("algebra" ("core") "algebra knows no systems")
    ("forms" ("algebra") "forms of equations know no bodies, circuits or files")
    ("linmodel" ("forms") "packages meet in the register, not in each other")
    ("circuits" ("forms") "packages meet in the register, not in each other")
    ("analysis" ("forms") "packages meet in the register, not in each other")
    ("numerics" ("forms") "numerics is entered through the register only"))
  "Each row: a room, the rooms it may use, and why it uses no other.")

(defun core-rooms-used (room)
  "ROOM and all rooms that it may use, in the order of the table."
  (let ((used (list room)))
    (loop for (name others) in (reverse *core-rooms*)
          do (when (member name used :test #'equal)
               (setq used (union others used :test #'equal))))
    (loop for (name) in *core-rooms* when (member name used :test #'equal) collect name)))
