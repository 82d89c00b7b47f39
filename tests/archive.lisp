;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the tests of the archive ask of its Lisp functions, as functions of Maxima: lists come back as Maxima lists,
;;; and test_said is what a call printed.

(in-package :maxima)

(core-require "archive/dispatch" "archive/open" "archive/results")

(defun test-list (items) (cons '(mlist simp) items))

(defun $test_checked (list) (archive-description (archive-open-list (archive-keys-by-name list))))

(defun $test_facts (list) (test-list (archive-facts ($test_checked list))))

(defun $test_free (list)
  "The free symbols of a description list."
  (let ((archive (archive-open-list list)))
    (test-list (archive-free-symbols (archive-kind archive) (archive-description archive)))))

(defun $test_nearest (name known) (core-nearest name (cdr known)))

(defun $test_key (kind section name)
  "The type, the default and whether an option may overrule the key NAME."
  (let ((key (archive-find-key kind section name)))
    (and key (test-list (list (string-downcase (archive-key-type key))
                              (archive-default key)
                              (archive-overrulable-p key))))))

(defun $test_key_names (kind section) (test-list (archive-key-names kind section)))

(defun $test_defaults_fit ()
  "Names of the keys whose default does not pass the check of their own type."
  (test-list (loop for key in (loop for sort in (archive-all-sorts) append (archive-all-keys (archive-sort-name sort)))
                   when (and (archive-default key) (archive-value-trouble key (archive-default key)))
                     collect (archive-key-name key))))

(defun $test_types_known ()
  "Names of the keys whose type has no phrase or no check."
  (test-list (loop for key in (loop for sort in (archive-all-sorts) append (archive-all-keys (archive-sort-name sort)))
                   unless (and (archive-type-phrase (archive-key-type key))
                               (fboundp (archive-type-function (archive-key-type key))))
                     collect (archive-key-name key))))

(defun $test_trouble (kind section name text)
  "What is wrong with TEXT as an answer for a key, or false."
  (archive-value-trouble (archive-find-key kind section name) text))

(defun $test_sha256 (text) (archive-digest text))

(defun $test_sha256_of_a (count) (archive-digest (make-string count :initial-element #\a)))

;; Files

(defun $test_write (path text)
  "Makes PATH a file of TEXT, in which | stands for a line end, ~ for a carriage return, @ for a byte order mark, & for
an e with its accent."
  (with-open-file (out (archive-native-path path) :direction :output :element-type '(unsigned-byte 8)
                                                  :if-exists :supersede)
    (loop for c across text
          do (dolist (byte (case c
                             (#\| '(10))
                             (#\~ '(13))
                             (#\@ '(239 187 191))
                             (#\& '(195 169))
                             (t (list (char-code c)))))
               (write-byte byte out))))
  path)

(defun $test_copy (path other)
  (with-open-file (out (archive-native-path other) :direction :output :element-type '(unsigned-byte 8)
                                                   :if-exists :supersede)
    (write-sequence (archive-file-bytes path) out))
  other)

(defun $test_examples ()
  "Names of the archives in the folder examples."
  (test-list (mapcar (lambda (path) (archive-file-name (namestring path)))
                     (directory (format nil "~aexamples/*.txt" *core-root*)))))

(defun $test_text (path)
  "The content of PATH as $test_write takes it; bytes beyond ASCII are <code>."
  (with-output-to-string (out)
    (loop for byte across (archive-file-bytes path)
          do (case byte
               (10 (write-char #\| out))
               (13 (write-char #\~ out))
               (t (if (< byte 128) (write-char (code-char byte) out) (format out "<~d>" byte)))))))

(defun $test_open (path) (archive-description (archive-open path)))

(defun $test_open_text (text)
  "The description in TEXT, as $test_write takes it."
  (archive-description (archive-of-text "test.txt" (substitute #\Newline #\| text))))

(defun $test_place (text section key)
  (archive-place (archive-of-text "a/test.txt" (substitute #\Newline #\| text)) section key))

(defun test-results (names values from)
  (loop for name in (cdr names) for value in (cdr values)
        collect (make-archive-step :name name :value value :from from :checks '("by \"hand\"" "twice")
                                   :left-out '("nothing"))))

(defun $test_save (path names values from &optional elsewhere)
  "Saves results in the archive PATH, opened anew."
  (archive-save (archive-open path) (test-results names values from) elsewhere))

(defun $test_save_after (path between names values from)
  "Saves results after the Maxima function BETWEEN was called when the archive was open already."
  (let ((archive (archive-open path)))
    (mfuncall between)
    (archive-save archive (test-results names values from))))

(defun $test_result (path name from)
  "The stored result and its state."
  (multiple-value-bind (value state) (archive-result (archive-open path) name from)
    (test-list (list value (string-downcase state)))))

(defun $test_from (path keys extras)
  (archive-from-digest (archive-open path) (cdr keys) (cdr extras)))

(defun $test_said (function)
  "What FUNCTION prints, on one line."
  (let ((*core-warnings* '()))
    (substitute #\Space #\Newline
                (with-output-to-string (*standard-output*) (mfuncall function)))))

(defun $test_delete (path) (archive-unlink path) path)
