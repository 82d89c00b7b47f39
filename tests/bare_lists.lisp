;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A file of a given text, for rtest_circuits_lists.mac.

(in-package :maxima)

(defvar *bare-file* (format nil "~a/bare-list-~d.txt" $maxima_tempdir (core-process-id)))

(defun $bare_file (text)
  (with-open-file (stream *bare-file* :direction :output :if-exists :supersede)
    (write-string text stream))
  *bare-file*)

(defun $bare_content ()
  (with-open-file (stream *bare-file*)
    (let* ((text (make-string (file-length stream))) (n (read-sequence text stream)))
      (subseq text 0 n))))
