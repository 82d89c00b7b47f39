;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A file as bytes, and bytes as text. Only regular files are opened (a pipe would wait for
;;; ever), links are followed, the size is limited, and the bytes must be UTF-8 without control
;;; characters: each fault is told with its place. Decoding and encoding are inverse to each
;;; other, so that what is not touched is written back byte for byte. Look first at
;;; archive-read-file.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/tokens"))

(defvar *archive-file-size* (* 8 1024 1024) "The largest file that is read, in bytes.")

;; What a name leads to

(defun archive-native-path (name)
  "A pathname for NAME, in which no character is a wild card."
  #+sbcl (sb-ext:parse-native-namestring name)
  #-sbcl (pathname name))

(defun archive-file-kind (name)
  "What NAME leads to, links followed: :regular, :folder, :pipe, :device, :socket, :missing or
:unreachable."
  #+sbcl
  (multiple-value-bind (found error inode mode) (sb-unix:unix-stat name)
    (declare (ignore inode))
    (cond (found (archive-mode-kind mode))
          ((member error '(2 20)) :missing)
          (t :unreachable)))
  #-sbcl
  (archive-file-kind-by-test name))

(defun archive-mode-kind (mode)
  "The kind that the bits of a Unix mode tell."
  (case (ash (logand mode #o170000) -12)
    (8 :regular)
    (4 :folder)
    (1 :pipe)
    ((2 6) :device)
    (12 :socket)
    (t :unreachable)))

#-sbcl
(defun archive-file-kind-by-test (name)
  "As archive-file-kind, by the shell's test: GCL's own stat cannot tell a pipe from a file."
  (flet ((holds (flag)
                (zerop (core-shell-status (format nil "test ~a ~a" flag
                                                     (core-shell-quoted name))))))
    (cond ((holds "-f") :regular)
          ((holds "-d") :folder)
          ((holds "-p") :pipe)
          ((holds "-S") :socket)
          ((holds "-e") :device)
          (t :missing))))

(defun archive-refuse-kind (name kind)
  "An error that says why the file NAME of KIND is not read."
  (core-error "~a ~a" name
              (ecase kind
                (:missing "is not there; check the name and the working folder")
                (:folder "is a folder; give the name of an archive")
                (:pipe "is a pipe; an archive is a regular file")
                (:device "is a device; an archive is a regular file")
                (:socket "is a socket; an archive is a regular file")
                (:unreachable "cannot be reached; check the permissions of its folder"))))

;; Bytes

(deftype archive-bytes () '(simple-array (unsigned-byte 8) (*)))

(defun archive-file-bytes (name)
  "The bytes of the regular file NAME."
  (let ((kind (archive-file-kind name)))
    (unless (eq kind :regular) (archive-refuse-kind name kind)))
  (multiple-value-bind (stream size) (archive-open-bytes name)
    (unwind-protect (archive-stream-bytes stream size name)
      (close stream))))

(defun archive-open-bytes (name)
  "Two values: a stream of bytes from the file NAME, and its size. The kind is looked at again once
it is open; opening never waits."
  #+sbcl
  (multiple-value-bind (descriptor error)
    (sb-unix:unix-open name (logior sb-unix:o_rdonly #o4000) 0)
    (unless descriptor
      (core-error "~a cannot be read: ~a" name (sb-int:strerror error)))
    (multiple-value-bind (found device inode mode links user group special size)
      (sb-unix:unix-fstat descriptor)
      (declare (ignore device inode links user group special))
      (unless (and found (eq (archive-mode-kind mode) :regular))
        (sb-unix:unix-close descriptor)
        (core-error "~a is not a regular file any more" name))
      (values (sb-sys:make-fd-stream descriptor :input t :buffering :full :element-type
                                     '(unsigned-byte 8))
              size)))
  #-sbcl
  (archive-open-any-name name))

#-sbcl
(defun archive-open-any-name (name)
  "Two values: a stream of bytes from the file NAME, and its size. GCL takes [, * and ? in names for
wild cards: a file so named is read from a copy, which has no name any more once it is open."
  (let* ((plain (notany (lambda (c) (find c "[]*?\\")) name))
         (copy (if plain name
                   (format nil "~a/dynarch-~d-~d" $maxima_tempdir (get-internal-real-time)
                           (random 1000000)))))
    (unless plain
      (core-shell-status (format nil "umask 077; head -c ~d -- ~a > ~a" (1+ *archive-file-size*)
                                    (core-shell-quoted name) (core-shell-quoted copy))))
    (let ((stream (ignore-errors (open (archive-native-path copy) :element-type
                                       '(unsigned-byte 8)))))
      (unless plain (ignore-errors (delete-file copy)))
      (if stream
          (values stream (file-length stream))
          (core-error "~a cannot be read: check its permissions" name)))))

(defun archive-stream-bytes (stream size name)
  "The SIZE bytes of STREAM, or an error if they are more than the limit."
  (when (> size *archive-file-size*)
    (core-error "~a has ~d bytes; archives of at most ~d bytes are read" name size
                *archive-file-size*))
  (let* ((bytes (make-array size :element-type '(unsigned-byte 8)))
         (read (handler-case (read-sequence bytes stream)
                 (error () (core-error "~a cannot be read to its end" name)))))
    (if (= read size) bytes (subseq bytes 0 read))))

;; UTF-8

(defun archive-sequence-length (bytes position end)
  "The length of the UTF-8 sequence that begins at POSITION, or nil if there is none: no overlong
form, no surrogate."
  (declare (type archive-bytes bytes) (type fixnum position end))
  (let ((first (aref bytes position)))
    (flet ((byte-at (k) (if (< (+ position k) end) (aref bytes (+ position k)) 0)))
      (flet ((continued (n) (loop for k from 1 to n always (= 2 (ash (byte-at k) -6)))))
        (cond ((< first #x80) 1)
              ((<= #xC2 first #xDF) (and (continued 1) 2))
              ((<= #xE0 first #xEF)
               (and (continued 2)
                    (not (and (= first #xE0) (< (byte-at 1) #xA0)))
                    (not (and (= first #xED) (>= (byte-at 1) #xA0)))
                    3))
              ((<= #xF0 first #xF4)
               (and (continued 3)
                    (not (and (= first #xF0) (< (byte-at 1) #x90)))
                    (not (and (= first #xF4) (>= (byte-at 1) #x90)))
                    4))
              (t nil))))))

(defun archive-control-p (bytes position end)
  "True when the character at POSITION is a control character other than tab and line end."
  (declare (type archive-bytes bytes) (type fixnum position end))
  (let ((first (aref bytes position)))
    (cond ((= first 13) (not (and (< (1+ position) end) (= (aref bytes (1+ position)) 10))))
          ((< first 32) (not (or (= first 9) (= first 10))))
          ((= first 127) t)
          ((= first #xC2) (< (aref bytes (1+ position)) #xA0))
          (t nil))))

(defun archive-check-bytes (bytes file)
  "An error at the first byte that is not UTF-8 or is a control character."
  (declare (type archive-bytes bytes))
  (let ((position 0) (end (length bytes)) (line 1) (column 1))
    (declare (type fixnum position end line column))
    (loop while (< position end)
          do (let ((length (archive-sequence-length bytes position end)))
               (cond ((null length)
                      (archive-fault-at file line column
                                        "found the byte ~2,'0x (hexadecimal), which is not ~
                                         UTF-8; save the file as UTF-8"
                                        (aref bytes position)))
                     ((archive-control-p bytes position end)
                      (archive-fault-at file line column
                                        "found the control character ~d; a text has none but tab ~
                                         and line ends~a"
                                        (archive-code-point bytes position length)
                                        (if (zerop (aref bytes position))
                                            " (is this a binary file?)" "")))
                     ((= (aref bytes position) 10) (incf line) (setq column 0)))
               (incf column)
               (incf position length)))))

(defun archive-code-point (bytes position length)
  "The code of the character whose UTF-8 sequence of LENGTH bytes begins at POSITION."
  (declare (type archive-bytes bytes) (type fixnum position length))
  (if (= length 1)
      (aref bytes position)
      (let ((code (logand (aref bytes position) (1- (ash 1 (- 7 length))))))
        (loop for k from 1 below length
              do (setq code (logior (ash code 6) (logand (aref bytes (+ position k)) #x3F))))
        code)))

(defun archive-decode (bytes)
  "BYTES, which are UTF-8, as a native string."
  (declare (type archive-bytes bytes))
  (let ((text (make-string (length bytes))) (n 0) (position 0) (end (length bytes)))
    (declare (type fixnum n position end))
    (loop while (< position end)
          do (let ((length (if (> char-code-limit 256) (archive-sequence-length bytes position end)
                               1)))
               (setf (char text n)
                     (code-char (if (= length 1) (aref bytes position)
                                    (archive-code-point bytes position length))))
               (incf n)
               (incf position length)))
    (archive-simple-text (subseq text 0 n))))

(defun archive-text-of-bytes (bytes file)
  "BYTES as a native string, or an error with the place in FILE of what is no text."
  (archive-check-bytes bytes file)
  (archive-decode bytes))

(defun archive-read-file (name)
  "The text of the file NAME: a native string. An error if it cannot be read, is empty or is no
text."
  (let ((bytes (archive-file-bytes name)))
    (when (zerop (length bytes))
      (core-error "~a is empty; an archive begins with dynarch = 1" name))
    (archive-text-of-bytes bytes name)))
