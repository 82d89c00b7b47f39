;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What a circuit consists of, as records: branches, transformers, mutual inductances. A branch is
;;; known by its number, its place in the list of branches.

(in-package :maxima)

(core-record circuits-branch
  "Types L C R RU RI E I EV G F H (ARCHIVE: kind = circuit). `state' is the name of the current of
an L, of the voltage of a C, else false; `control' the nodes or the label of a controlled source."
  label tail head type value number (state nil) (control '((mlist simp))))

(core-record circuits-transformer
  "Of nodes pair = [a, b], driven = [c, d]: u_ab = ratio*u_cd, i_cd = -ratio*i_ab."
  pair driven ratio)

(core-record circuits-coupling
  "Inductors numbered `one' and `other'; mutual inductance M, and k where that was given, else
false."
  one other mutual k)

(defun $circuits_ends (branch)
  "[tail, head]"
  (list '(mlist simp) (circuits-branch-tail branch) (circuits-branch-head branch)))

(defun $circuits_with (changes circuit)
  "CIRCUIT, a list of equations, with the CHANGES, equations too, in place of its own."
  (flet ((changed (equation)
           (or (find (cadr equation) (cdr changes) :key #'cadr) equation)))
    (cons '(mlist simp) (mapcar #'changed (cdr circuit)))))
