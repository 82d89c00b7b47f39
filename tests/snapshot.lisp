;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For tests of cleanliness: a picture of the session, and what differs between two pictures.
;;; snapshot() holds every bound Maxima variable, the information lists, contexts, facts and the properties of the user's symbols.

(in-package :maxima)

(defparameter *snapshot-passing*
  '($% $%% $_ $__ $linenum $labels $load_pathname $error $snapshot $before $f $gensumnum $lasttime $values $functions)
  "Variables that change by themselves from one input line to the next.")

(defun snapshot-user-name-p (symbol)
  "Whether SYMBOL is a Maxima name, no label and no name of this project."
  (let ((name (symbol-name symbol)))
    (and (> (length name) 1)
         (char= (char name 0) #\$)
         (not (char= (char name 1) #\%))
         (notany (lambda (room) (eql 0 (search (string-upcase (format nil "$~a_" room)) name)))
                 '("core" "archive" "algebra" "forms" "linmodel" "circuits" "analysis" "numerics")))))

(defun snapshot-names (test)
  (let ((names '()))
    (do-symbols (symbol :maxima)
      (when (and (snapshot-user-name-p symbol) (not (member symbol *snapshot-passing*)) (funcall test symbol))
        (pushnew symbol names)))
    (sort names #'string< :key #'symbol-name)))

(defun snapshot-copy (value)
  "VALUE to compare with later ones; a stream prints its address, which the collector changes."
  (cond ((consp value) (copy-tree value))
        ((streamp value) 'stream)
        (t value)))

(defun $snapshot ()
  "An opaque picture of the session."
  (list '(mlist simp)
        (list* '(mlist simp) "variables"
               (loop for name in (snapshot-names #'boundp)
                     collect (list '(mlist simp) name (list '(snapshot-value simp) (snapshot-copy (symbol-value name))))))
        (list* '(mlist simp) "values" (set-difference (cdr $values) *snapshot-passing*))
        (list* '(mlist simp) "properties"
               (loop for name in (snapshot-names (lambda (s) (or (cdr (get s 'mprops)) (get s 'data))))
                     collect (list '(mlist simp) name (list '(snapshot-value simp) (snapshot-copy (cdr (get name 'mprops)))
                                                            (length (get name 'data))))))
        (list '(mlist simp) "facts" (mfuncall '$facts) (symbol-value '$context) (copy-list (symbol-value '$contexts)))))

(defun snapshot-entries (picture)
  (loop for (nil title . items) in (cdr picture)
        append (mapcar (lambda (item) (cons title item)) items)))

(defun $snapshot_difference (before after)
  "Names of what is in one picture and not, or otherwise, in the other."
  (let ((a (snapshot-entries before)) (b (snapshot-entries after)) (table (make-hash-table :test #'equal)) (names '()))
    (flet ((mark (entries sign)
             (dolist (entry entries)
               (incf (gethash (prin1-to-string entry) table 0) sign))))
      (mark a 1)
      (mark b -1)
      (dolist (entry (append a b))
        (unless (zerop (gethash (prin1-to-string entry) table))
          (let ((item (cdr entry)))
            (pushnew (if (and (consp item) (consp (cdr item)) (symbolp (cadr item)) (cadr item)) (cadr item) (car entry))
                     names)))))
    (cons '(mlist simp) names)))
