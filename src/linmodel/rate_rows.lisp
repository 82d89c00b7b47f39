;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What depends on coordinates and time alone, and its rate as a row [c_0, c_1, .., c_n]: the rate
;;; is c_0 + sum c_i q_i'. An expression is differentiated by the names that occur in it only, so
;;; that a chain of many bodies costs no more for each. Places of sections and links in their lists.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/branch_slopes" "forms/exchange" "algebra/rank" "linmodel/scene_records"))

(defun $linmodel_check_geometry (section key e)
  (let ((derivatives (forms-collect-derivatives e '())))
    (when derivatives
      ($core_fault section key key " must not contain velocities, found "
                   (car (last derivatives))))))

;;; Names

(defun linmodel-collect-names (e names)
  "Adds the symbols and subscripted names of E to the table NAMES."
  (cond ((symbolp e) (setf (gethash e names) t))
        ((consp e)
         (when (member 'array (car e)) (push e (gethash :subscripted names)))
         (dolist (part (cdr e)) (linmodel-collect-names part names)))))

(defun linmodel-names (e)
  (let ((names (make-hash-table :test #'eq)))
    (linmodel-collect-names e names)
    names))

(defun linmodel-named-p (name names)
  (if (symbolp name)
      (gethash name names)
      (member name (gethash :subscripted names) :test #'alike1)))

(defun $linmodel_first_occurring (list e)
  "The first of LIST that occurs in E, or false."
  (let ((names (linmodel-names e)))
    (find-if (lambda (name) (linmodel-named-p name names)) (cdr list))))

(defun $linmodel_unused_coordinate (q links)
  "The first coordinate that no angle, joint or rate of the LINKS has, or false."
  (let ((names (make-hash-table :test #'eq)))
    (dolist (link (cdr links))
      (linmodel-collect-names (linmodel-link-joint link) names)
      (dolist (row (linmodel-rows-of-link link)) (linmodel-collect-names row names))
      (dolist (turn (cdr (linmodel-link-turns link)))
        (linmodel-collect-names (linmodel-turn-angle turn) names)))
    (loop for x in (cdr q)
          for i from 1
          unless (or (linmodel-named-p x names) (linmodel-moved-p i links)) return x)))

(defun linmodel-rows-of-link (link)
  "The rows of its turns and of its joint."
  (append (mapcar #'linmodel-turn-row (cdr (linmodel-link-turns link)))
          (cdr (linmodel-link-rows link))))

(defun linmodel-moved-p (i links)
  (loop for link in (cdr links)
        thereis (some (lambda (row) (not (eql 0 (nth i (cdr row))))) (linmodel-rows-of-link link))))

;;; Rates

(defun linmodel-slope (e x names)
  (cond ((eq e x) 1)
        ((linmodel-named-p x names) ($algebra_diff e x))
        (t 0)))

(defun $linmodel_rate_row (e q)
  "de/dt as a row."
  (let ((names (linmodel-names e)))
    (cons '(mlist simp) (mapcar (lambda (x) (linmodel-slope e x names)) (cons '$t (cdr q))))))

;;; Places

(defun $linmodel_position (name names)
  (let ((place (position name (cdr names) :test #'core-key-equal)))
    (and place (1+ place))))

(defun $linmodel_last_position (name names)
  (let ((place (position name (cdr names) :test #'core-key-equal :from-end t)))
    (and place (1+ place))))

;;; Coordinates that move the bodies in one and the same way, such as q1 and q2 where angles is
;;; [q1 + q2]. The rates of all turns and joints are rows linear in q'; turns of one body that
;;; follow each other about one axis count as one. The coordinates are independent where the rows
;;; have full rank: a coordinate alone in its row is set aside with its column, again and again,
;;; which in ordinary systems leaves nothing; of what is left the rank is found.

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
          (append (linmodel-joined-turns (cdr (linmodel-link-turns link)))
                  (cdr (linmodel-link-rows link)))))

(defun linmodel-joined-turns (turns)
  (let ((joined '()))
    (loop for turn in turns
          for axis = (linmodel-turn-axis turn)
          for row = (linmodel-turn-row turn)
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
