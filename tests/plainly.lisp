;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For tests that compare sessions: plainly(name, e) prints e as a tree of symbols and numbers, and
;;; a line "== name". No option, alias or operator of a session is seen in it; flags that Maxima
;;; leaves in the heads of expressions are left out.

(in-package :maxima)

(defun plain-tree (e)
  (cond ((atom e) e)
        ((atom (car e)) (mapcar #'plain-tree e))
        (t (cons (if (member 'array (car e)) (list (caar e) 'array) (list (caar e)))
                 (mapcar #'plain-tree (cdr e))))))

(defun $plainly (name e)
  (let ((*print-base* 10) (*print-radix* nil) (*print-pretty* nil) (*package* (find-package :maxima)))
    (format t "~&~s~%== ~a~%" (plain-tree e) name)
    '$done))
