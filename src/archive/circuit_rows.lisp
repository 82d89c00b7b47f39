;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The rows of a circuit's sections: fields apart by blanks, where a blank inside brackets or a
;;; string parts nothing. What parses a row takes a reader on its first token and gives a Maxima
;;; list, or label = list.
;;;   branches      [label:] node -> node  type  value  [state]
;;;                 behind the type  EV, G  value node node   F, H  value label   O  node node
;;;   couplings     label label  M  or  label label  k = number
;;;   transformers  node -> node : node -> node  ratio value

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/compounds" "archive/keys" "archive/parser"
                "archive/plain_simplifier" "archive/tokens"))

(defun archive-row-parser (section)
  "What parses the rows of SECTION, of whatever kind; nil where its entries are keys."
  (let ((sort (archive-find-sort nil section)))
    (and sort (eq (archive-sort-form sort) :rows) (second (archive-sort-detail sort)))))

;; Fields

(defun archive-fields (reader)
  "Ranges (from . to) of the fields from the reader's token on; blanks inside brackets and
strings do not part fields."
  (let* ((text (reader-text reader)) (end (reader-end reader)) (fields '())
         (position (archive-skip-blanks text (reader-from reader) end)))
    (loop while (< position end)
          do (let ((to (archive-field-end reader position)))
               (push (cons position to) fields)
               (setq position (archive-skip-blanks text to end))))
    (nreverse fields)))

(defun archive-field-end (reader from)
  (let ((text (reader-text reader)) (end (reader-end reader)) (depth 0) (position from))
    (loop while (< position end)
          do (let ((c (char text position)))
               (cond ((char= c #\") (setq position (archive-string-end text position end)))
                     ((find c "([{") (incf depth))
                     ((find c ")]}") (decf depth))
                     ((char= c #\#)
                      (if (<= depth 0)
                          (return)
                          (setq position (or (position #\Newline text :start position :end end)
                                             (1- end)))))
                     ((and (<= depth 0) (find c '(#\Space #\Tab #\Newline #\Return))) (return))))
             (incf position))
    (min position end)))

(defun archive-string-end (text from end)
  "The place of the quotation mark that closes the string at FROM, or the last place before END."
  (loop for position from (1+ from) below end
        do (case (char text position)
             (#\\ (incf position))
             ((#\" #\Newline) (return position)))
        finally (return (1- end))))

(defun archive-field-value (reader field &key relations)
  "The value of FIELD, a range of characters."
  (multiple-value-bind (line column) (archive-reader-place reader (car field))
    (let ((part (archive-open-text
                 (make-archive-stretch :text (reader-text reader) :file (reader-file reader)
                                       :start (car field) :end (cdr field)
                                       :line line :column column))))
      (let ((value (archive-parse-reader! part :relations relations)))
        (unless (and relations (eq (archive-form-kind value) :relation))
          (archive-expect-scalar part (car field) value))
        (setf (reader-calls reader) (append (reader-calls part) (reader-calls reader)))
        value))))

;; Nodes and labels

(defun archive-parse-node! (reader)
  "A node: an integer or a name."
  (unless (or (and (eq (reader-kind reader) :number) (integerp (reader-value reader)))
              (and (eq (reader-kind reader) :name) (zerop (reader-primes reader))))
    (archive-fault reader (reader-from reader) "found ~a, expected a node (an integer or a name)"
                   (archive-token-shown reader)))
  (archive-parse-plain! reader))

(defun archive-parse-plain! (reader)
  "The integer or name the reader stands on."
  (let ((value (reader-value reader)))
    (when (member value *archive-keywords* :test #'equal)
      (archive-fault reader (reader-from reader)
                     "found `~a': the word is reserved and cannot be a name" value))
    (archive-next-token! reader)
    (if (stringp value) (core-symbol value) value)))

(defun archive-parse-arrow! (reader)
  "node -> node, as a list of two."
  (let ((first (archive-parse-node! reader)))
    (archive-expect! reader :arrow "->")
    (list first (archive-parse-node! reader))))

(defun archive-label-ahead-p (reader)
  "True when the reader stands on a label: a name with a colon after it."
  (let ((next (archive-skip-blanks (reader-text reader) (reader-to reader) (reader-end reader))))
    (and (eq (reader-kind reader) :name)
         (zerop (reader-primes reader))
         (< next (reader-end reader))
         (char= (char (reader-text reader) next) #\:))))

;; The three kinds of row

(defun archive-parse-branch (reader)
  "[label:] node -> node  type  value  [state]"
  (let* ((label (and (archive-label-ahead-p reader)
                     (prog1 (archive-parse-plain! reader) (archive-next-token! reader))))
         (nodes (archive-parse-nodes-before-fields! reader))
         (fields (archive-fields reader)))
    (unless (cdr fields)
      (archive-fault reader (reader-from reader)
                     "found ~:[a type without value~;no type~], expected: node -> node  type  ~
                      value  [state]"
                     (null fields)))
    (let ((row (archive-inert 'mlist
                              (append nodes
                                      (mapcar (lambda (field) (archive-field-value reader field))
                                              fields)))))
      (if label (archive-inert 'mequal (list label row)) row))))

(defun archive-parse-nodes-before-fields! (reader)
  "node -> node; the token after them may be the beginning of any field and is not looked at yet."
  (let ((first (archive-parse-node! reader)))
    (archive-expect! reader :arrow "->")
    (let ((second (reader-value reader)) (to (reader-to reader)))
      (archive-parse-node! (copy-archive-reader reader))
      (setf (reader-from reader) to)
      (list first (if (stringp second) (core-symbol second) second)))))

(defun archive-parse-coupling (reader)
  "label label  M, or label label  k = number"
  (let ((fields (archive-fields reader)))
    (unless (cddr fields)
      (archive-fault reader (reader-from reader)
                     "expected two labels and a value: L1 L2  M, or L1 L2  k = 0.9"))
    (destructuring-bind (first second third &rest more) fields
      (archive-inert 'mlist
                     (list (archive-field-name reader first "the label of a branch")
                           (archive-field-name reader second "the label of a branch")
                           (archive-coupling-value reader third
                                                   (if more (cdr (car (last more)))
                                                       (cdr third))))))))

(defun archive-field-name (reader field what)
  (archive-expect-name reader (car field) (archive-field-value reader field) what))

(defun archive-coupling-value (reader field to)
  "The mutual inductance, or k = coefficient, that stands from FIELD to TO."
  (let ((value (archive-field-value reader (cons (car field) to) :relations t)))
    (when (and (eq (archive-form-kind value) :relation)
               (not (and (eq (caar value) 'mequal) (eq (cadr value) '$k)
                         (eq (archive-form-kind (caddr value)) :scalar))))
      (archive-fault reader (car field) "expected a mutual inductance, or k = coefficient"))
    value))

(defun archive-parse-transformer (reader)
  "node -> node : node -> node  ratio value"
  (let ((first (archive-parse-arrow! reader)))
    (archive-expect! reader :colon ":")
    (let* ((second (archive-parse-nodes-before-fields! reader)) (fields (archive-fields reader)))
      (unless (and (cdr fields)
                   (string= "ratio"
                            (subseq (reader-text reader) (car (first fields))
                                    (cdr (first fields)))))
        (archive-fault reader (reader-from reader)
                       "expected: node -> node : node -> node  ratio value"))
      (when (cddr fields)
        (archive-fault reader (car (third fields))
                       "found a second value after ratio; a value with blanks stands in ( )"))
      (archive-inert 'mlist
                     (append first second (list (archive-field-value reader (second fields))))))))
