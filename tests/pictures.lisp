;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; For the tests of pictures: the bytes of files, and what is left in the folder for temporary ones.

(in-package :maxima)

(defun $picture_begin (file count)
  "The first COUNT bytes of FILE as a list."
  (with-open-file (stream (core-pathname file) :element-type '(unsigned-byte 8))
    (cons '(mlist simp) (loop repeat count collect (read-byte stream)))))

(defun $picture_size (file)
  (with-open-file (stream (core-pathname file) :element-type '(unsigned-byte 8))
    (file-length stream)))

(defun $picture_text (file)
  "FILE as one string, byte by byte."
  (with-open-file (stream (core-pathname file) :element-type '(unsigned-byte 8))
    (map 'string #'code-char (loop for byte = (read-byte stream nil) while byte collect byte))))

(defun $picture_there (file) (and (core-existing-file file) t))

(defun $picture_remove (file) (delete-file (core-pathname file)) '$done)

(defun $picture_temporary_files ()
  "Names of ours in the folder for temporary files, of this process."
  (cons '(mlist simp)
        (mapcar #'namestring
                (directory (format nil "~a/dynarch~d_*.*" $maxima_tempdir (core-process-id))))))
