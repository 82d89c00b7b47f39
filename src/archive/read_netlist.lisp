;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; ReadNetlist: a SPICE netlist becomes an archive of kind circuit. Nothing of it is evaluated: its
;;; lines are taken apart here, its expressions go through the archive's parser, and the text that
;;; comes of it is checked as any archive. What is not understood is an error with its line.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/bytes" "archive/disk" "archive/groups" "archive/netlist_elements"
                "archive/netlist_lines" "archive/netlist_parts" "archive/netlist_values"
                "archive/open" "archive/store" "archive/tokens"))

(defun $archive_read_netlist (netlist archive replace)
  "Reads the file NETLIST and writes ARCHIVE, whose name is returned."
  (dolist (name (list netlist archive))
    (unless (stringp name)
      (core-error "the arguments are the names of two files, a netlist and an archive; found ~a"
                  (core-words (list name)))))
  (when (and (not replace) (archive-exists-p archive))
    (core-error "~a exists already; give replace = true to write over it" archive))
  (archive-write-new archive (archive-net-archive-text netlist (archive-net-file-text netlist))))

(defun archive-net-archive-text (file netlist)
  "The text of the archive that NETLIST, the text of FILE, becomes."
  (let* ((*archive-net-file* (archive-file-name file)) (*archive-net-line* 1)
         (sheet (archive-net-sheet (archive-net-read netlist)))
         (text (archive-net-sheet-text sheet)))
    (multiple-value-bind (archive trouble)
        (let ((*core-function* nil) (*core-warnings* (list "")))
          (core-caught (lambda () (archive-of-text "the archive" text))))
      (declare (ignore archive))
      (when trouble (core-error "~a gives no archive: ~a" file trouble)))
    (archive-net-say-title netlist)
    (archive-net-say-ignored (netlist-ignored (net-sheet-netlist sheet)))
    text))

(defun archive-net-say-title (text)
  "A warning where the first line of TEXT looks like one that is to be obeyed."
  (let ((line (cdr (first (archive-net-physical-lines text)))))
    (when (or (archive-net-obeyed-title-p line) (archive-net-element-title-p line))
      (core-warn "the first line, ~a, is the title, as SPICE has it, and is not obeyed~:[~;, ~
                  though ngspice does~]; if it is part of the circuit, put a title above it"
                 (archive-shown line) (archive-net-obeyed-title-p line)))))

(defun archive-net-obeyed-title-p (line)
  "Whether ngspice takes LINE for more than a title: two backslashes at its end join the next one."
  (or (loop for word in '("." "*#" "*ng_script")
            thereis (eql 0 (search word line :test #'char-equal)))
      (and (string/= line "") (char/= (char line 0) #\*)
           (eql (search "\\\\" line :from-end t) (- (length line) 2)))))

(defun archive-net-element-title-p (line)
  "Whether LINE reads as an element: a letter of one, two nodes, and what begins like a number."
  (let ((fields (loop for start = 0 then (1+ end)
                      for end = (position-if #'archive-net-blank-p line :start start)
                      for field = (subseq line start end)
                      unless (string= field "") collect field
                      while end)))
    (and (fourth fields) (find (char (first fields) 0) "rlcviegfhkdb" :test #'char-equal)
         (or (digit-char-p (char (fourth fields) 0)) (find (char (fourth fields) 0) "{"))
         t)))

(defun archive-net-file-text (file)
  (let ((bytes (archive-file-bytes file)))
    (when (zerop (length bytes)) (core-error "~a is empty" file))
    (archive-text-of-bytes bytes file)))

(defun archive-net-say-ignored (commands)
  (when commands
    (core-warn "left aside: ~{~a~^, ~}; they say nothing of the circuit itself"
               (reverse commands))))

;;; The text

(defun archive-net-sheet-text (sheet)
  (unless (net-sheet-branches sheet) (core-error "~a has no elements" *archive-net-file*))
  (let ((starts (archive-net-starts sheet)) (laws (reverse (net-sheet-laws sheet))))
    (format nil "dynarch = 1~%kind = circuit~%title = ~s~%~%[system]~%~@[~a~]~@[~a~]~@[~a~]~@[~a~]~
                 ~@[~a~]~@[~a~]~%[branches]~%~{~a~%~}~@[~a~]"
            (archive-net-title sheet)
            (and (gethash "0" (net-sheet-nodes sheet)) (format nil "datum = 0~%"))
            (archive-net-key "functions" (mapcar (lambda (law)
                                                   (subseq law 0 (position #\( law))) laws))
            (archive-net-key "laws" laws)
            (archive-net-key "nodes" (loop for (node . whole) in (reverse (net-sheet-renamed sheet))
                                           collect (format nil "~a = ~s" node whole)))
            (archive-net-key "start" (loop for (state . value) in starts
                                           collect (format nil "~a = ~a" state value)))
            (let ((span (netlist-span (net-sheet-netlist sheet))))
              (and span (format nil "time = [0, ~a]~%" (second span))))
            (reverse (net-sheet-branches sheet))
            (let ((rows (reverse (net-sheet-couplings sheet))))
              (and rows (format nil "~%[couplings]~%~{~a~%~}" rows))))))

(defun archive-net-title (sheet)
  "The title in one line."
  (substitute-if #\Space (lambda (c) (< (char-code c) 32))
                 (or (netlist-title (net-sheet-netlist sheet)) "")))

(defun archive-net-key (key items)
  "key = [item,~%  item, ..], or nil where there is none."
  (and items (format nil "~a = [~{~a~^,~%  ~}]~%" key items)))

;;; The start

(defun archive-net-starts (sheet)
  "(state . value) ..: from IC, then from .ic; with uic 0 for the other states."
  (let* ((netlist (net-sheet-netlist sheet)) (given (reverse (net-sheet-starts sheet))))
    (when (and given (not (netlist-from-zero netlist)))
      (core-warn "IC counts from uic in .tran on; the start is taken as it is given"))
    (loop for (type state tail head) in (reverse (net-sheet-stores sheet))
          for value = (or (cdr (assoc state given :test #'string=))
                          (and (string= type "C") (archive-net-initial-voltage netlist tail head))
                          (and (netlist-from-zero netlist) "0"))
          when value collect (cons state value))))

(defun archive-net-initial-voltage (netlist tail head)
  "The text of v(tail) - v(head) where .ic gives both, or one is node 0; with uic the others are 0."
  (flet ((potential (node)
           (if (string= node "0") "0"
               (or (third (find node (netlist-initial netlist) :key #'second :test #'string=))
                   (and (netlist-from-zero netlist) "0")))))
    (let ((a (potential tail)) (b (potential head)))
      (and a b (or (string/= a "0") (string/= b "0"))
           (archive-net-spelled (archive-net-parsed (format nil "~a - (~a)" a b)))))))
