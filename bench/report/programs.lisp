;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For the report: descriptions of archives, digests of programs, and what of the matrix dX_i/dx_j of a
;;; program is constant, moves, or vanishes.

(in-package :maxima)

(core-require "algebra/program_nodes" "algebra/program_record" "archive/digest" "archive/open" "archive/speller"
              "numerics/jacobian" "numerics/program")

(defun $report_description (path) (archive-description (archive-open path)))

(defparameter *report-program-parts* '($states $inputs $assignments $outputs))

(defun $report_digest (record start span)
  "Of the program RECORD with what is run of it."
  (let ((parts (mapcar (lambda (part) (algebra-record-part record part)) *report-program-parts*)))
    (archive-digest (format nil "~{~a~%~}" (mapcar #'archive-spell (append parts (list start span)))))))

(defun report-constant-p (element)
  (notany (lambda (node) (and (algebra-input-p node) (not (algebra-constant-input-p node))))
          (algebra-live-nodes (list element))))

(defun $report_jacobian (record)
  "[constant, moving, zero]: numbers of entries; false where directional derivatives serve."
  (let* ((names (cdr (algebra-record-part record '$states)))
         (program (numerics-read-program record names))
         (entries (reduce #'append (numerics-known-slopes program)))
         (constant (count-if #'report-constant-p entries :key #'cdr)))
    (and entries
         (algebra-list constant (- (length entries) constant)
                       (- (expt (length names) 2) (length entries))))))
