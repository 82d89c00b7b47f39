;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A SPICE netlist as lines of fields. The first line is the title whatever it looks like; `*'
;;; begins a comment line, `;' and a `$' apart a comment at the end of one, `+' goes on with the
;;; line above, .end ends the text. A field is a word, an expression in { } or ' ', or one of = ( );
;;; blanks and commas part fields. Letters of both cases are the same (ngspice manual, chapter 2).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require))

(defvar *archive-net-file* "the netlist" "The file that is read, for messages.")
(defvar *archive-net-line* 1 "The number of the line that is read, for messages.")

(defstruct (archive-net-line (:conc-name net-line-))
  number text)

(defun archive-net-fault (control &rest arguments)
  "An error at the line that is read."
  (core-error "~a, line ~d: ~?" *archive-net-file* *archive-net-line* control arguments))

(defun archive-net-blank-p (c) (or (char= c #\Space) (char= c #\Tab) (char= c #\Return)))

(defun archive-net-trimmed (text) (string-trim '(#\Space #\Tab #\Return) text))

;;; Lines

(defun archive-net-physical-lines (text)
  "(number . text) of each line of TEXT."
  (loop with start = 0
        for number from 1
        for end = (position #\Newline text :start start)
        collect (cons number (archive-net-trimmed (subseq text start end)))
        while end
        do (setq start (1+ end))))

(defun archive-net-begins-p (line word)
  "Whether the first word of LINE is WORD."
  (let ((n (length word)))
    (and (>= (length line) n) (string-equal word line :end2 n)
         (or (= (length line) n) (archive-net-blank-p (char line n))))))

(defun archive-net-without-comment (line)
  "LINE up to a `;', or a `$' that stands apart, outside of { } and quotes."
  (let ((depth 0) (quoted nil))
    (loop for position from 0 below (length line)
          for c = (char line position)
          do (cond ((char= c #\') (setq quoted (not quoted)))
                   ((char= c #\{) (incf depth))
                   ((char= c #\}) (decf depth))
                   ((and (not quoted) (<= depth 0)
                         (or (char= c #\;) (archive-net-dollar-p line position)))
                    (return (archive-net-trimmed (subseq line 0 position)))))
          finally (return line))))

(defun archive-net-dollar-p (line position)
  (flet ((apart-p (k) (or (not (< -1 k (length line))) (archive-net-blank-p (char line k)))))
    (and (char= (char line position) #\$) (apart-p (1- position)) (apart-p (1+ position)))))

(defun archive-net-split (text)
  "Two values: the title, and the archive-net-lines of the netlist TEXT up to .end."
  (let ((lines (archive-net-physical-lines text)) (found '()))
    (loop for (number . line) in (cdr lines)
          until (archive-net-begins-p line ".end")
          do (let ((*archive-net-line* number) (line (archive-net-bare line)))
               (cond ((string= line ""))
                     ((char= (char line 0) #\+) (archive-net-go-on (first found) (subseq line 1)))
                     (t (push (make-archive-net-line :number number :text (list line)) found)))))
    (dolist (line found)
      (setf (net-line-text line)
            (format nil "~{~a~^ ~}" (reverse (net-line-text line)))))
    (values (cdr (first lines)) (nreverse found))))

(defun archive-net-bare (line)
  (if (and (plusp (length line)) (char= (char line 0) #\*)) "" (archive-net-without-comment line)))

(defun archive-net-go-on (line more)
  (unless line (archive-net-fault "`+' goes on with nothing; the first line is the title"))
  (push more (net-line-text line)))

;;; Fields

(defun archive-net-fields (text)
  "The fields of TEXT, strings; an expression keeps its { }."
  (let ((position 0) (end (length text)) (fields '()))
    (loop
      (setq position (archive-net-skip text position end))
      (when (>= position end) (return (nreverse fields)))
      (multiple-value-bind (field after) (archive-net-field text position end)
        (push field fields)
        (setq position after)))))

(defun archive-net-skip (text position end)
  (or (position-if-not (lambda (c) (or (archive-net-blank-p c) (char= c #\,))) text
                       :start position :end end)
      end))

(defun archive-net-field (text from end)
  "Two values: the field at FROM, and where it ends."
  (let ((c (char text from)))
    (case c
      ((#\= #\( #\)) (values (string c) (1+ from)))
      (#\{ (let ((to (archive-net-brace-end text from end)))
             (values (subseq text from to) to)))
      (#\' (let ((to (or (position #\' text :start (1+ from) :end end)
                         (archive-net-fault "an expression in ' ' without its end"))))
             (values (format nil "{~a}" (subseq text (1+ from) to)) (1+ to))))
      (t (let ((to (or (position-if (lambda (c) (or (archive-net-blank-p c) (find c "=(),{'")))
                                    text :start from :end end)
                       end)))
           (values (subseq text from to) to))))))

(defun archive-net-brace-end (text from end)
  "The place behind the brace that closes the one at FROM."
  (loop with depth = 0
        for position from from below end
        do (case (char text position)
             (#\{ (incf depth))
             (#\} (when (zerop (decf depth)) (return (1+ position)))))
        finally (archive-net-fault "an expression in { } without its end")))
