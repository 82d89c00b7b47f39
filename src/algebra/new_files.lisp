;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Files that a person asks for: refused over one that exists unless he says so; written beside it,
;;; and put in its place once they are whole.

(in-package :maxima)

(defun algebra-folder-length (file)
  "How many letters of FILE name its folder, the last slash included."
  (1+ (or (position #\/ file :from-end t) -1)))

(defun algebra-check-new-file (file replace)
  (when (and (core-existing-file file) (not replace))
    (core-error "~a exists already; give replace = true to write over it" file)))

(defun algebra-or-unwritable (file function)
  "The value of FUNCTION, or an error that says what hinders."
  (handler-case (funcall function)
    (error ()
      (let ((folder (subseq file 0 (algebra-folder-length file))))
        (core-error "~a cannot be written: ~:[the folder ~a~;the working folder~*~] does not ~
                     exist or cannot be written in, or a folder has this name"
                    file (string= folder "") folder)))))

(defun algebra-open-draft (draft file type)
  (algebra-or-unwritable
   file
   (lambda ()
     (open (core-pathname draft) :direction :output :if-exists :supersede :element-type type))))

(defun algebra-rename-file (draft file)
  "DRAFT, in the same folder, becomes FILE; a relative name is taken from the folder of the draft."
  #+sbcl (rename-file (core-pathname draft)
                      (merge-pathnames (merge-pathnames (core-pathname file))
                                       (make-pathname :type :unspecific)))
  #-sbcl (rename-file draft (merge-pathnames (subseq file (algebra-folder-length file))
                                             (make-pathname :type :unspecific))))

(defun algebra-draft-of (file) (format nil "~a.~a.draft" file (core-process-id)))

(defun algebra-remove-file (name)
  (when (core-existing-file name) (delete-file (core-pathname name))))

(defun algebra-check-writable (file)
  "An error where FILE could not be written; nothing is."
  (let ((draft (algebra-draft-of file)))
    (unwind-protect (close (algebra-open-draft draft file 'character))
      (algebra-remove-file draft))))

(defun algebra-write-file (file function &optional (type 'character))
  "FUNCTION writes, elements of TYPE, to a draft, which then takes the place of FILE."
  (let ((draft (algebra-draft-of file)))
    (unwind-protect
         (progn
           (with-open-stream (stream (algebra-open-draft draft file type))
             (funcall function stream))
           (algebra-or-unwritable file (lambda () (algebra-rename-file draft file))))
      (algebra-remove-file draft))))
