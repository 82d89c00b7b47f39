;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Which part uses which: names that a file under src defines and another one has. What a part uses
;;; it declares (core_require anywhere in its text; the core is always there), and its room may use
;;; the other's by the table of rooms. What nothing uses is dead. Names are compared as Maxima spells
;;; them: $name of Lisp is name of Maxima, name of Lisp is ?name. Look first at $uses_undeclared.

(in-package :maxima)

(defun uses-parts ()
  "The names of all parts, \"room/file\", registers last."
  (loop for (room) in *core-rooms*
        append (loop for type in '("lisp" "mac")
                     append (loop for file in (directory (format nil "~asrc/~a/*.~a" *core-root* room type))
                                  collect (format nil "~a/~a" room (pathname-name file))))))

(defun uses-file (part)
  (flet ((file (type) (core-existing-file (format nil "~asrc/~a.~a" *core-root* part type))))
    (or (file "lisp") (file "mac"))))

(defun uses-text (file)
  (with-open-file (in (core-pathname file))
    (let* ((text (make-string (file-length in))) (end (read-sequence text in)))
      (subseq text 0 end))))

;;; Lisp: read, not evaluated

(defun uses-forms (file)
  (with-open-file (in (core-pathname file))
    (let ((*package* (find-package :maxima)))
      (loop for form = (read in nil in) until (eq form in) collect form))))

(defun uses-map (function form)
  "Calls FUNCTION on all atoms of FORM."
  (loop while (consp form) do (uses-map function (pop form)))
  (cond ((null form))
        #+sbcl ((sb-impl::comma-p form) (uses-map function (sb-impl::comma-expr form)))
        ((and (vectorp form) (not (stringp form))) (map nil (lambda (e) (uses-map function e)) form))
        (t (funcall function form))))

(defun uses-symbol-name (symbol)
  "As Maxima code spells it."
  (let ((name (symbol-name symbol)))
    (if (and (plusp (length name)) (char= (char name 0) #\$))
        (string-downcase (subseq name 1))
        (concatenate 'string "?" (string-downcase name)))))

(defun uses-lisp-definitions (forms)
  (loop for form in forms
        append (when (consp form)
                 (case (car form)
                   ((defvar defparameter defconstant deftype)
                    (list (uses-symbol-name (second form))))
                   (core-record (uses-record-names form))
                   ((eval-when progn let flet labels macrolet) (uses-lisp-definitions (cddr form)))
                   (t (mapcar #'uses-symbol-name (definitions-of form)))))))

(defvar *uses-fields* '() "(record . fields), of the records read so far.")

(defun uses-record-fields (form)
  "The fields of a record, those of the record that it adds to first, which is read before it."
  (destructuring-bind (name-and-parent documentation &rest fields) (cdr form)
    (declare (ignore documentation))
    (destructuring-bind (name &optional parent)
        (if (consp name-and-parent) name-and-parent (list name-and-parent))
      (let ((all (append (cdr (assoc parent *uses-fields*))
                         (mapcar (lambda (field) (if (consp field) (car field) field)) fields))))
        (push (cons name all) *uses-fields*)
        all))))

(defun uses-record-names (form)
  (let* ((fields (uses-record-fields form))
         (name (if (consp (second form)) (car (second form)) (second form)))
         (plain (substitute #\_ #\- (string-downcase name))))
    (append (mapcar #'uses-symbol-name (definitions-of `(defstruct ,name ,@fields)))
            (list plain (format nil "~a_with" plain))
            (loop for field in fields
                  collect (format nil "~a_~a" plain (substitute #\_ #\- (string-downcase field)))))))

(defun uses-lisp-names (forms)
  (let ((names '()))
    (dolist (form forms names)
      (uses-map (lambda (atom)
                  (when (and (symbolp atom) (eq (symbol-package atom) (find-package :maxima)))
                    (push (uses-symbol-name atom) names)))
                form))))

(defun uses-lisp-declared (forms)
  "All texts: the parts in core-require, and those that data name beside a function."
  (let ((texts '()))
    (dolist (form forms texts)
      (uses-map (lambda (atom) (when (stringp atom) (push atom texts))) form))))

;;; Maxima: words, comments and texts left out

(defun uses-plain (text)
  "TEXT of Maxima without comments, and what stands between quotes by itself."
  (let ((i 0) (n (length text)) (quoted '()))
    (values
     (with-output-to-string (out)
       (flet ((comment ()
                (loop with depth = 0
                      do (cond ((>= i n) (return))
                               ((eql i (search "/*" text :start2 i :end2 (min n (+ i 2))))
                                (incf depth) (incf i 2))
                               ((eql i (search "*/" text :start2 i :end2 (min n (+ i 2))))
                                (decf depth) (incf i 2)
                                (when (zerop depth) (return)))
                               (t (when (char= (char text i) #\Newline) (terpri out)) (incf i))))))
         (loop while (< i n)
               do (cond ((eql i (search "/*" text :start2 i :end2 (min n (+ i 2)))) (comment))
                        ((char= (char text i) #\")
                         (let ((end (loop for j from (1+ i)
                                          do (case (char text j) (#\\ (incf j)) (#\" (return j))))))
                           (push (subseq text (1+ i) end) quoted)
                           (write-string "\"\"" out)
                           (setq i (1+ end))))
                        (t (write-char (char text i) out) (incf i))))))
     quoted)))

(defun uses-words (plain)
  (let ((words '()) (i 0) (n (length plain)))
    (flet ((letter-p (c) (or (alphanumericp c) (find c "_%?\\"))))
      (loop while (< i n)
            do (if (letter-p (char plain i))
                   (let ((end (or (position-if-not (lambda (c) (or (letter-p c) (find c "-*")))
                                                   plain :start i)
                                  n)))
                     (unless (char= (char plain i) #\?)
                       (setq end (or (position-if-not #'letter-p plain :start i) n)))
                     (push (remove #\\ (subseq plain i end)) words)
                     (setq i end))
                   (incf i))))
    words))

(defun uses-lines (plain)
  (let ((start 0))
    (loop for end = (position #\Newline plain :start start)
          collect (subseq plain start end)
          while end do (setq start (1+ end)))))

(defun uses-mac-definitions (plain)
  "Names at the beginning of a line before ( [ or :, and a := some time after."
  (loop for line in (uses-lines plain)
        for end = (position-if-not (lambda (c) (or (alphanumericp c) (find c "_%"))) line)
        when (and end (plusp end) (find (char line end) "([:") (alpha-char-p (char line 0))
                  (find #\_ line :end end)
                  (or (search ":=" line) (char= (char line end) #\:)
                      (not (find #\$ line)))
                  (not (search "core_require" line)))
          collect (subseq line 0 end)))

;;; What core_require names, in either language

(defun uses-quoted (text)
  "What stands between quotes in TEXT, which has no comments."
  (loop for begin = (position #\" text) then (position #\" text :start (1+ end))
        while begin
        for end = (position #\" text :start (1+ begin))
        collect (subseq text (1+ begin) end)))

(defun uses-required (text)
  (loop for begin = (search "core_require" text) then (search "core_require" text :start2 end)
        while begin
        for end = (position #\) text :start begin)
        append (uses-quoted (subseq text begin end))))

;;; Who uses what

(defstruct uses-part name defined used declared required acts)

(defun uses-read (part)
  (let ((file (uses-file part)))
    (if (search ".lisp" file)
        (let ((forms (uses-forms file)))
          (make-uses-part :name part :defined (uses-lisp-definitions forms)
                          :used (uses-lisp-names forms) :declared (uses-lisp-declared forms)
                          :required (uses-required (substitute #\_ #\- (uses-text file)))
                          :acts (uses-acts-p forms)))
        (multiple-value-bind (plain quoted) (uses-plain (uses-text file))
          (make-uses-part :name part :defined (uses-mac-definitions plain)
                          :used (uses-words plain) :declared quoted
                          :required (uses-required (uses-text file)))))))

(defvar *uses-known* nil "All parts, read once.")

(defun uses-known ()
  (or *uses-known* (setq *uses-known* (mapcar #'uses-read (uses-parts)))))

(defun uses-room (part) (subseq part 0 (position #\/ part)))

(defun uses-arrows ()
  "(user other (name ..)) for each part that uses names of another."
  (let ((parts (uses-known)) (home (make-hash-table :test #'equal)) (arrows '()))
    (dolist (part parts)
      (dolist (name (uses-part-defined part)) (setf (gethash name home) (uses-part-name part))))
    (dolist (part parts (nreverse arrows))
      (let ((found (make-hash-table :test #'equal)))
        (dolist (name (remove-duplicates (uses-part-used part) :test #'string=))
          (let ((other (gethash name home)))
            (when (and other (string/= other (uses-part-name part)))
              (push name (gethash other found)))))
        (loop for other being the hash-keys of found using (hash-value names)
              do (push (list part other (sort names #'string<)) arrows))))))

(defun uses-list (&rest items) (cons '(mlist simp) items))

(defun $uses_undeclared ()
  "[[part, other, names], ..]: a part uses another and does not declare it."
  (apply #'uses-list
         (loop for (part other names) in (uses-arrows)
               unless (or (string= (uses-room other) "core")
                          (string= (uses-room (uses-part-name part)) "core")
                          (member other (uses-part-declared part) :test #'string=))
                 collect (uses-list (uses-part-name part) other (apply #'uses-list names)))))

(defun uses-acts-p (forms)
  "Whether a part does something by being loaded: gives a judge to another part, fills a register."
  (find-if (lambda (form) (and (consp form) (member (car form) '(setq core-kind core-option)))) forms))

(defun uses-needed-p (part other)
  "Whether PART uses a name that the part called OTHER defines, or OTHER acts."
  (let ((other (find other (uses-known) :key #'uses-part-name :test #'string=)))
    (or (uses-part-acts other)
        (intersection (uses-part-used part) (uses-part-defined other) :test #'string=))))

(defun $uses_needless ()
  "[[part, others], ..]: parts that a part declares by core_require and of which it uses no name.
The core is left out: it reads its chapters for all; so do the registers, which are data."
  (apply #'uses-list
         (loop for part in (uses-known)
               for needless = (unless (or (string= (uses-room (uses-part-name part)) "core")
                                          (search "/register" (uses-part-name part)))
                                (remove-if (lambda (other) (uses-needed-p part other))
                                           (uses-part-required part)))
               when needless
                 collect (uses-list (uses-part-name part) (apply #'uses-list needless)))))

(defun uses-may-p (room other) (member other (core-rooms-used room) :test #'string=))

(defun $uses_closed_rooms ()
  "\"never src/ROOM src/OTHER\" for each room and those of which it may use nothing."
  (apply #'uses-list
         (loop for (room) in *core-rooms*
               append (loop for (other) in *core-rooms*
                            unless (uses-may-p room other)
                              collect (format nil "never src/~a src/~a" room other)))))

(defun $uses_circles ()
  "The parts of analysis, circuits, .. that use each other in a circle. Those that use none that is
left, or that none uses, are taken away; the core reads its chapters together."
  (let ((arrows (loop for (part other) in (uses-arrows)
                      unless (string= (uses-room other) "core")
                        collect (cons (uses-part-name part) other))))
    (loop for users = (mapcar #'car arrows) and used = (mapcar #'cdr arrows)
          for left = (remove-if-not (lambda (arrow)
                                      (and (member (car arrow) used :test #'string=)
                                           (member (cdr arrow) users :test #'string=)))
                                    arrows)
          until (= (length left) (length arrows))
          do (setq arrows left))
    (apply #'uses-list (sort (remove-duplicates (mapcar #'car arrows) :test #'string=) #'string<))))

(defun $uses_forbidden ()
  "[[part, other, names], ..]: a part uses one of a room that its own room may not use."
  (apply #'uses-list
         (loop for (part other names) in (uses-arrows)
               unless (uses-may-p (uses-room (uses-part-name part)) (uses-room other))
                 collect (uses-list (uses-part-name part) other (apply #'uses-list names)))))

(defun $uses_defined_twice ()
  "[[name, part, part], ..]: the later definition would replace the earlier in silence."
  (let ((home (make-hash-table :test #'equal)) (twice '()))
    (dolist (part (uses-known) (apply #'uses-list twice))
      (dolist (name (uses-part-defined part))
        (let ((other (gethash name home)))
          (when (and other (string/= other (uses-part-name part)))
            (push (uses-list name other (uses-part-name part)) twice)))
        (setf (gethash name home) (uses-part-name part))))))

(defun $uses_shared_names ()
  "Names that files of two rooms have; each room has a register."
  (let ((names (loop for part in (uses-parts)
                     collect (subseq part (1+ (position #\/ part))))))
    (apply #'uses-list
           (loop for (name . more) on (remove "register" names :test #'string=)
                 when (member name more :test #'string=) collect name))))

;;; What nothing uses. A piece is a form of Lisp, or the lines from one definition of Maxima to the
;;; next: what a piece defines must stand in another one, as a name or as a text between quotes (so
;;; rules name functions), in a rule, a face or a tool.

(defstruct uses-piece defined used)

(defun uses-texts (form)
  (let ((texts '()))
    (uses-map (lambda (atom) (when (stringp atom) (push atom texts))) form)
    texts))

(defun uses-made-names (form)
  "Names that a structure makes whether they are wanted or not: all of a record of both languages,
the maker, the copier and the test of others."
  (case (car form)
    (core-record (uses-record-names form))
    (defstruct (let ((name (if (consp (second form)) (car (second form)) (second form))))
                 (list (format nil "?make-~(~a~)" name) (format nil "?copy-~(~a~)" name)
                       (format nil "?~(~a~)-p" name))))))

(defun uses-lisp-pieces (file)
  (loop for form in (uses-forms file)
        collect (make-uses-piece
                 :defined (set-difference (uses-lisp-definitions (list form))
                                          (and (consp form) (uses-made-names form)) :test #'string=)
                 :used (append (uses-lisp-names (list form)) (uses-texts form)))))

(defun uses-mac-pieces (file)
  (multiple-value-bind (plain quoted) (uses-plain (uses-text file))
    (let ((pieces (list (make-uses-piece :used quoted))))
      (dolist (line (uses-lines plain) pieces)
        (let ((defined (uses-mac-definitions line)))
          (when defined (push (make-uses-piece :defined defined) pieces))
          (setf (uses-piece-used (car pieces))
                (append (uses-words line) (uses-piece-used (car pieces)))))))))

(defun uses-outside ()
  "What faces and tools name, and the functions of rules, whose names may be made."
  (flet ((words (file)
           (let ((text (uses-text file)) (start 0))
             (loop for end = (position-if-not (lambda (c) (or (alphanumericp c) (find c "_-*$"))) text
                                              :start start)
                   collect (string-left-trim "$" (subseq text start end))
                   while end do (setq start (1+ end))))))
    (append (loop for rules being the hash-values of *core-rules*
                  append (loop for rule in rules
                               when (rule-function rule) collect (core-spelling (rule-function rule))))
            (loop for face in '("linmodel" "circuits" "analysis")
                  append (words (format nil "~a~a.mac" *core-root* face)))
            (loop for tool in (directory (format nil "~atools/*" *core-root*))
                  when (pathname-name tool)
                    append (loop for word in (words tool)
                                 append (list word (format nil "?~a" word)))))))

(defun $uses_dead (&rest doors)
  "[[part, names], ..]: names that a part defines and nothing uses but itself; DOORS are left out."
  (let ((users (make-hash-table :test #'equal)) (homes '()))
    (flet ((note (piece name) (pushnew piece (gethash name users))))
      (dolist (name (append doors (uses-outside))) (note :outside name))
      (dolist (part (uses-parts))
        (let ((file (uses-file part)))
          (dolist (piece (if (search ".lisp" file) (uses-lisp-pieces file) (uses-mac-pieces file)))
            (dolist (name (uses-piece-used piece)) (note piece name))
            (push (cons part piece) homes)))))
    (apply #'uses-list
           (loop for part in (uses-parts)
                 for dead = (loop for (home . piece) in homes
                                  when (string= home part)
                                    append (remove-if (lambda (name)
                                                        (set-difference (gethash name users)
                                                                        (list piece)))
                                                      (uses-piece-defined piece)))
                 when dead collect (uses-list part (apply #'uses-list (sort dead #'string<)))))))
