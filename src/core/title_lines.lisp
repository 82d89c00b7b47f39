;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; First lines of SPICE netlists. SPICE takes the first line for the title whatever it looks like;
;;; programs do not: ngspice obeys one that begins with a dot, *# or *ng_script, and two backslashes
;;; at the end of one take the next line away. Such titles are written behind a star and a blank, as
;;; a comment is, and read without them.

(in-package :maxima)

(defun core-plain-title-p (line)
  "Whether LINE is a title to all readers, and none that stands behind a star for another."
  (flet ((begins-p (word) (eql 0 (search word line :test #'char-equal))))
    (cond ((or (string= line "") (char= (char line (1- (length line))) #\\)) nil)
          ((or (begins-p "*#") (begins-p "*ng_script")) nil)
          ((begins-p "* ") (core-plain-title-p (subseq line 2)))
          (t (core-title-letter-p (char line 0))))))

(defun core-title-letter-p (c)
  (or (alphanumericp c) (> (char-code c) 127) (and (find c "*_/#<-'") t)))

(defun core-title-line (title)
  "The first line under which TITLE, without blanks at its ends, is written."
  (if (core-plain-title-p title) title (concatenate 'string "* " title)))

(defun core-title-of-line (line)
  "The title that core-title-line wrote as LINE."
  (let ((rest (and (eql 0 (search "* " line)) (subseq line 2))))
    (if (and rest (plusp (length rest)) (string= line (core-title-line rest))) rest line)))
