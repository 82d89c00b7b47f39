;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Opening: a file, a text or a list becomes a checked archive; one answer of the dialog is checked
;;; by the same table. Look first at archive-open and archive-open-list.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/argument_checks" "archive/bare_graph" "archive/bytes"
                "archive/description" "archive/groups"
                "archive/keys" "archive/names" "archive/parser" "archive/plain_simplifier"
                "archive/sections" "archive/types"))

(defun archive-of-groups (path text parts groups)
  "The archive made of GROUPS, with a warning on names that nothing declares."
  (archive-with-places
   path groups
   (lambda ()
     (let* ((description (archive-with-plain-simplifier (archive-checked groups)))
            (kind (core-spelling ($core_get description '$kind))))
       (archive-check-description-spellings description)
       (archive-check-agreement kind description)
       (archive-warn-free-symbols kind description)
       (make-archive :path path :text text :parts parts :groups groups :kind kind
                     :description description)))))

(defun archive-of-text (path text)
  "The checked archive of TEXT, the content of the file PATH."
  (let ((sheet (archive-split text path)))
    (archive-check-calls sheet)
    (archive-of-groups path text sheet (archive-groups-of-sheet sheet))))

(defun archive-open (path)
  "The checked archive in the file PATH; the list of a graph alone has no file to write in."
  (let ((text (archive-read-file path)))
    (if (archive-bare-graph-p text)
        (archive-open-list (archive-bare-graph-description path text))
        (archive-of-text path text))))

(defun archive-open-list (list)
  "The checked archive that a description list is; it has no file."
  (archive-of-groups nil nil nil (archive-groups-of-list list)))

;;; One answer

(defun archive-trouble (function)
  "The text of the error in which FUNCTION ends, or nil."
  (let ((*core-function* nil))
    (nth-value 1 (core-caught function))))

(defun archive-check-value (key text)
  "The checked value of KEY that TEXT spells; an error otherwise."
  (let ((answer (archive-parse-value text)))
    (multiple-value-bind (value trouble) (archive-typed (archive-key-type key) answer)
      (when trouble (core-error "~a" (archive-mismatch key answer trouble)))
      value)))

(defun archive-value-trouble (key text)
  "What is wrong with TEXT as a value of KEY, or nil."
  (archive-trouble (lambda () (archive-check-value key text))))

(defun archive-row-trouble (section text)
  "What is wrong with TEXT as a row of SECTION, or nil."
  (archive-trouble (lambda () (archive-split (format nil "[~a]~%~a~%" section text) nil))))

(defun archive-text-trouble (text)
  "What is wrong with TEXT as an archive, or nil."
  (archive-trouble (lambda () (archive-of-text "the description" text))))
