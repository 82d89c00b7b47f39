;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For the report: descriptions of archives, digests of programs.

(in-package :maxima)

(core-require "algebra/program_record" "archive/digest" "archive/open" "archive/speller")

(defun $report_description (path) (archive-description (archive-open path)))

(defparameter *report-program-parts* '($states $inputs $assignments $outputs))

(defun $report_digest (record start span)
  "Of the program RECORD with what is run of it."
  (let ((parts (mapcar (lambda (part) (algebra-record-part record part)) *report-program-parts*)))
    (archive-digest (format nil "~{~a~%~}" (mapcar #'archive-spell (append parts (list start span)))))))
