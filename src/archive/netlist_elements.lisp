;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The elements of a netlist as rows of an archive: R L C, sources V I (E I of the archive),
;;; controlled ones E G F H (EV G F H), K (couplings), diodes D of the exponential law, and B, a
;;; source by its own voltage, its own current, or the time. A branch runs from the first node to
;;; the second, as in SPICE, with the sign convention passive. Nodes and labels that are no names
;;; here are renamed.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/netlist_diodes" "archive/netlist_laws" "archive/netlist_lines"
                "archive/netlist_parts" "archive/netlist_sources" "archive/netlist_values"
                "archive/parser" "archive/tokens"))

(defstruct (archive-net-sheet (:conc-name net-sheet-))
  "What becomes of a netlist: texts of rows, newest first."
  netlist
  (branches '()) (couplings '()) (laws '()) (starts '())
  (nodes (make-hash-table :test #'equal))    ; whole small name -> node
  (labels (make-hash-table :test #'equal))   ; whole small name -> label
  (used (make-hash-table :test #'equal))     ; nodes and labels taken
  (renamed '())                              ; (node . whole name), newest first
  (stores '()))                              ; (type label tail head) of L and C, newest first

(defparameter *archive-net-makers*
  '((#\r . archive-net-resistor) (#\c . archive-net-store) (#\l . archive-net-store)
    (#\v . archive-net-source) (#\i . archive-net-source)
    (#\e . archive-net-by-nodes) (#\g . archive-net-by-nodes)
    (#\f . archive-net-by-current) (#\h . archive-net-by-current)
    (#\k . archive-net-coupling) (#\d . archive-net-diode) (#\b . archive-net-behaviour)))

(defun archive-net-sheet (netlist)
  "The archive-net-sheet of NETLIST."
  (let ((sheet (make-archive-net-sheet :netlist netlist)))
    (dolist (element (netlist-elements netlist))
      (let ((*archive-net-line* (net-element-line element)))
        (archive-net-note-label sheet element)))
    (dolist (element (netlist-elements netlist))
      (let* ((*archive-net-line* (net-element-line element))
             (letter (archive-net-letter element))
             (maker (cdr (assoc letter *archive-net-makers*))))
        (unless maker
          (archive-net-fault "the element ~a is of a type that is not read; R C L V I E F G H K ~
                              D B X are" (archive-shown (net-element-name element))))
        (funcall maker sheet element)))
    sheet))

(defun archive-net-letter (element)
  "The first letter of the element's own name, behind those of the calls."
  (let ((name (net-element-name element)))
    (char-downcase (char name (length (net-place-prefix (net-element-place element)))))))

;;; Names

(defun archive-net-plain (name)
  "NAME with _ for what stands in no name."
  (substitute-if-not #\_ #'archive-word-p name))

(defun archive-net-free-name (sheet name)
  "NAME, or NAME with a number behind it, that nothing is called yet."
  (loop for k from 1
        for candidate = name then (format nil "~a_~d" name k)
        unless (gethash (string-downcase candidate) (net-sheet-used sheet))
          do (setf (gethash (string-downcase candidate) (net-sheet-used sheet)) t)
             (return candidate)))

(defun archive-net-usable-p (name)
  (and (archive-name-p name)
       (not (member name *archive-keywords* :test #'string-equal))
       (not (string-equal name "t"))))

(defun archive-net-note-label (sheet element)
  (let* ((name (net-element-name element)) (small (string-downcase name)))
    (when (gethash small (net-sheet-labels sheet))
      (archive-net-fault "the element ~a is there already" (archive-shown name)))
    (let ((plain (archive-net-plain name)))
      (setf (gethash small (net-sheet-labels sheet))
            (archive-net-free-name sheet (if (archive-net-usable-p plain) plain
                                             (format nil "~a_" plain)))))))

(defun archive-net-label (sheet element)
  (gethash (string-downcase (net-element-name element)) (net-sheet-labels sheet)))

(defun archive-net-node-name (sheet element name)
  "What the node NAME of ELEMENT is called in the archive."
  (unless (and name (string/= name "(") (string/= name ")") (string/= name "="))
    (archive-net-fault "~a: a node is missing" (net-element-name element)))
  (archive-net-whole-node sheet (archive-net-node name (net-element-place element))))

(defun archive-net-whole-node (sheet whole)
  (let ((nodes (net-sheet-nodes sheet)))
    (or (gethash whole nodes)
        (setf (gethash whole nodes)
              (if (archive-net-number-p whole) whole (archive-net-new-node sheet whole))))))

(defun archive-net-number-p (name)
  "Whether NAME is an integer as it is written."
  (and (every #'digit-char-p name)
       (or (= (length name) 1) (and (char/= (char name 0) #\0) (< (length name) 10)))))

(defun archive-net-new-node (sheet whole)
  (let* ((usable (archive-net-usable-p whole))
         (name (archive-net-free-name sheet (if usable whole
                                                (format nil "n_~a" (archive-net-plain whole))))))
    (unless (string= name whole) (push (cons name whole) (net-sheet-renamed sheet)))
    name))

;;; Rows

(defun archive-net-ends (sheet element)
  "Two nodes of ELEMENT."
  (let ((fields (net-element-fields element)))
    (list (archive-net-node-name sheet element (first fields))
          (archive-net-node-name sheet element (second fields)))))

(defun archive-net-put-branch (sheet element type &rest fields)
  (destructuring-bind (tail head) (archive-net-ends sheet element)
    (push (format nil "~a: ~a -> ~a   ~a  ~{~a~^ ~}" (archive-net-label sheet element) tail head
                  type fields)
          (net-sheet-branches sheet))))

(defun archive-net-element-value (element field)
  (unless field
    (archive-net-fault "~a has no value" (net-element-name element)))
  (archive-net-value field (net-place-scope (net-element-place element))))

(defun archive-net-none-left (element fields)
  (when fields
    (archive-net-fault "~a: found `~a' behind the value, which is not read"
                       (net-element-name element) (archive-shown (first fields)))))

(defun archive-net-value-and-rest (element letter)
  "Two values: the field of the value of ELEMENT, 1k or R = 1k, and what follows."
  (let ((fields (cddr (net-element-fields element))))
    (if (and (string-equal (first fields) letter) (equal (second fields) "="))
        (values (third fields) (nthcdr 3 fields))
        (values (first fields) (rest fields)))))

(defun archive-net-resistor (sheet element)
  (multiple-value-bind (field more) (archive-net-value-and-rest element "r")
    (archive-net-none-left element more)
    (let ((value (archive-net-element-value element field)))
      (when (string= value "0")
        (archive-net-fault "~a is 0; a short circuit is a source of 0 volts"
                           (net-element-name element)))
      (archive-net-put-branch sheet element "R" value))))

(defun archive-net-store (sheet element)
  "C and L, perhaps with IC = .."
  (let ((type (string (char-upcase (archive-net-letter element)))))
    (multiple-value-bind (field more) (archive-net-value-and-rest element type)
      (let ((value (archive-net-element-value element field)))
        (when (and more (string-equal (first more) "ic") (equal (second more) "="))
          (push (cons (archive-net-state sheet element type)
                      (archive-net-element-value element (third more)))
                (net-sheet-starts sheet))
          (setq more (nthcdr 3 more)))
        (archive-net-none-left element more)
        (push (list* type (archive-net-state sheet element type)
                     (mapcar (lambda (name) (archive-net-node name (net-element-place element)))
                             (subseq (net-element-fields element) 0 2)))
              (net-sheet-stores sheet))
        (archive-net-put-branch sheet element type value)))))

(defun archive-net-state (sheet element type)
  (format nil "~a_~a" (if (string= type "L") "i" "u") (archive-net-label sheet element)))

(defun archive-net-source (sheet element)
  (archive-net-put-branch
   sheet element (if (char= (archive-net-letter element) #\v) "E" "I")
   (archive-net-source-value (cddr (net-element-fields element))
                             (net-place-scope (net-element-place element))
                             (netlist-span (net-sheet-netlist sheet)))))

(defun archive-net-by-nodes (sheet element)
  "E, G: two nodes, two that control, the gain."
  (destructuring-bind (&optional tail head a b gain &rest more) (net-element-fields element)
    (declare (ignore tail head))
    (archive-net-refuse-formula element a)
    (archive-net-none-left element more)
    (let ((value (archive-net-element-value element gain)))
      (archive-net-put-branch sheet element
                              (if (char= (archive-net-letter element) #\e) "EV" "G") value
                              (archive-net-node-name sheet element a)
                              (archive-net-node-name sheet element b)))))

(defun archive-net-by-current (sheet element)
  "F, H: two nodes, the source of voltage whose current controls, the gain."
  (destructuring-bind (&optional tail head source gain &rest more) (net-element-fields element)
    (declare (ignore tail head))
    (archive-net-refuse-formula element source)
    (archive-net-none-left element more)
    (archive-net-put-branch sheet element (string (char-upcase (archive-net-letter element)))
                            (archive-net-element-value element gain)
                            (archive-net-other-label sheet element source #\v
                                                     "a source of voltage"))))

(defun archive-net-refuse-formula (element field)
  (when (member field '("poly" "value" "vol" "cur" "table" "laplace") :test #'equalp)
    (archive-net-fault "~a: ~a is not read, a constant gain is; a formula of the branch's own ~
                        voltage, of its own current, or of the time, stands in a source B"
                       (net-element-name element) field)))

(defun archive-net-other-label (sheet element name letter what)
  (or (and name (plusp (length name)) (char-equal (char name 0) letter)
           (gethash (string-downcase (concatenate 'string
                                                  (net-place-prefix (net-element-place element))
                                                  name))
                    (net-sheet-labels sheet)))
      (archive-net-fault "~a names ~a, and there is no ~a of that name" (net-element-name element)
                         (archive-shown (or name "nothing")) what)))

(defun archive-net-coupling (sheet element)
  (destructuring-bind (&optional one other k &rest more) (net-element-fields element)
    (archive-net-none-left element more)
    (push (format nil "~a ~a  k = ~a"
                  (archive-net-other-label sheet element one #\l "inductor")
                  (archive-net-other-label sheet element other #\l "inductor")
                  (archive-net-element-value element k))
          (net-sheet-couplings sheet))))

(defun archive-net-put-law (sheet element type variable formula)
  "A branch of TYPE, RU or RI, with the law FORMULA of VARIABLE."
  (archive-net-put-branch sheet element type
                          (archive-net-new-law sheet (archive-net-label sheet element) variable
                                               formula)))

(defun archive-net-new-law (sheet label variable formula)
  "The name of a law of the branch LABEL."
  (let ((law (format nil "f_~a" label)))
    (push (format nil "~a(~a) = ~a" law variable formula) (net-sheet-laws sheet))
    law))

(defun archive-net-diode (sheet element)
  "D1 a k model [area], or area = 2"
  (destructuring-bind (&optional anode cathode model area &rest more)
      (archive-net-without-word (net-element-fields element) "area" 3)
    (unless model (archive-net-fault "~a has no model" (net-element-name element)))
    (archive-net-none-left element more)
    (archive-net-put-diode sheet element (list anode cathode)
                           (archive-net-diode-model element model)
                           (if area (archive-net-element-value element area) "1"))))

(defun archive-net-without-word (fields word place)
  "FIELDS without WORD = at their PLACE."
  (if (and (string-equal (nth place fields) word) (equal (nth (1+ place) fields) "="))
      (append (subseq fields 0 place) (nthcdr (+ 2 place) fields))
      fields))

(defun archive-net-put-diode (sheet element nodes model area)
  "The junction of the diode between NODES, behind the resistance of its leads at a node of its own,
and its capacitance."
  (let* ((label (archive-net-label sheet element))
         (resistance (archive-net-diode-resistance model area))
         (capacitance (archive-net-diode-capacitance model area))
         (ends (archive-net-ends sheet element)) (inner (first ends)))
    (flet ((put (word tail head type value)
             (push (format nil "~a: ~a -> ~a   ~a  ~a" word tail head type value)
                   (net-sheet-branches sheet)))
           (named (ending) (archive-net-free-name sheet (format nil "~a_~a" label ending))))
      (when resistance
        (setq inner (named "j"))
        (put (named "RS") (first ends) inner "R" resistance))
      (put label inner (second ends) "RU"
           (archive-net-new-law sheet label "u" (archive-net-diode-law model area)))
      (when capacitance
        (let ((word (named "CJ")))
          (push (list "C" (format nil "u_~a" word)
                      (if resistance inner (archive-net-node (first nodes)
                                                             (net-element-place element)))
                      (archive-net-node (second nodes) (net-element-place element)))
                (net-sheet-stores sheet))
          (put word inner (second ends) "C"
               (archive-net-new-law sheet word "u" capacitance)))))))

(defun archive-net-behaviour (sheet element)
  "B1 a b I = expression, V = expression"
  (multiple-value-bind (type formula law)
      (archive-net-behaviour-law
       element (lambda (name) (archive-net-node name (net-element-place element))))
    (if law
        (archive-net-put-law sheet element type (if (string= type "RU") "u" "i") formula)
        (archive-net-put-branch sheet element type formula))))
