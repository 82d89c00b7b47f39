;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Coordinates that move the bodies in one and the same way, such as q1 and q2 where angles is
;;; [q1 + q2]. The rates of all turns and joints are rows linear in q'; turns of one body that
;;; follow each other about one axis count as one. The coordinates are independent where the rows
;;; have full rank: a coordinate alone in its row is set aside with its column, again and again,
;;; which in ordinary systems leaves nothing; of what is left the rank is found.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/rank"))

(defun $linmodel_dependent_coordinates (q links)
  "A smallest list of dependent coordinates; [] where all are independent."
  (let* ((rows (linmodel-rows-left (mapcan #'linmodel-rate-rows (cdr links)) (length (cdr q))))
         (columns (linmodel-columns-of rows)))
    (cons '(mlist simp)
          (mapcar (lambda (i) (nth i (cdr q)))
                  (and columns (linmodel-dependent-p rows columns)
                       (linmodel-least-dependent rows columns))))))

(defun linmodel-rate-rows (link)
  "Lists ((i . c_i) ..) of what is not zero in the rows of a LINK, i counted from 0."
  (mapcar #'linmodel-sparse-row
          (append (linmodel-joined-turns (cdr (fourth link))) (cdr (sixth link)))))

(defun linmodel-joined-turns (turns)
  (let ((joined '()))
    (loop for (nil axis nil row) in turns
          do (if (and joined (eql axis (car (first joined))))
                 (setf (cdr (first joined)) (add (cdr (first joined)) row))
                 (push (cons axis row) joined)))
    (mapcar #'cdr joined)))

(defun linmodel-sparse-row (row)
  (loop for c in (cddr row)
        for i from 0
        unless (eql c 0) collect (cons i c)))

;;; Columns set aside

(defun linmodel-rows-left (rows n)
  (let* ((aside (make-array n :initial-element nil))
         (found t))
    (loop while found
          do (setq found nil
                   rows (loop for row in rows
                              for left = (remove-if (lambda (term) (aref aside (car term))) row)
                              if (and left (null (cdr left)))
                                do (setf (aref aside (caar left)) t found t)
                              else if left collect left)))
    rows))

(defun linmodel-columns-of (rows)
  (sort (remove-duplicates (mapcan (lambda (row) (mapcar #'car row)) rows)) #'<))

(defun linmodel-dependent-p (rows columns)
  (< ($algebra_rank (linmodel-dense rows columns)) (length columns)))

(defun linmodel-dense (rows columns)
  (cons '($matrix simp)
        (loop for row in rows
              collect (cons '(mlist simp)
                            (loop for i in columns collect (or (cdr (assoc i row)) 0))))))

(defun linmodel-least-dependent (rows columns)
  "COLUMNS without those that the others are dependent without."
  (dolist (i columns columns)
    (let ((others (remove i columns)))
      (when (and others (linmodel-dependent-p rows others))
        (setq columns others)))))
