;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; One order of terms and factors before Maxima sees them: its own order is not always one (where
;;; 2^x*y*f(z) has its 2^x depends on what came first), and what is read and written again must come
;;; to rest.

(in-package :maxima)

(defun archive-compared (a b)
  "Negative, 0 or positive: numbers, then names, then forms by operator and parts."
  (cond ((eq a b) 0)
        ((and (realp a) (realp b)) (cond ((< a b) -1) ((> a b) 1) (t 0)))
        ((realp a) -1)
        ((realp b) 1)
        ((and (atom a) (atom b)) (archive-strings-compared (string a) (string b)))
        ((atom a) -1)
        ((atom b) 1)
        (t (let ((operators (archive-strings-compared (string (caar a)) (string (caar b)))))
             (if (zerop operators) (archive-lists-compared (cdr a) (cdr b)) operators)))))

(defun archive-strings-compared (a b)
  (cond ((string< a b) -1) ((string> a b) 1) (t 0)))

(defun archive-lists-compared (a b)
  (loop
    (cond ((null a) (return (if b -1 0)))
          ((null b) (return 1)))
    (let ((parts (archive-compared (pop a) (pop b))))
      (unless (zerop parts) (return parts)))))

(defun archive-ordered (list)
  (sort (copy-list list) (lambda (a b) (minusp (archive-compared a b)))))
