;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The parts of a netlist: elements, subcircuits put in where X calls them, models, parameters, and
;;; what the dot commands say. What stands in the call X1 is named X1.R1, and its nodes X1.a, unless
;;; they are its ports or 0. Names are compared in small letters.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/netlist_lines" "archive/netlist_values" "archive/tokens" "core/sizes"
                "core/title_lines"))

(defstruct (archive-net-place (:conc-name net-place-))
  "Where lines stand: in the whole netlist or in a call of a subcircuit."
  (prefix "") (ports '()) (scope (make-archive-net-scope)) (above nil)
  (models (make-hash-table :test #'equal)))

(defstruct (archive-net-element (:conc-name net-element-))
  line name fields text place)

(defstruct (archive-net-subcircuit (:conc-name net-subcircuit-))
  line ports defaults lines)

(defstruct (archive-netlist (:conc-name netlist-))
  title (elements '()) (subcircuits (make-hash-table :test #'equal))
  (top (make-archive-net-place))
  (calls 0)           ; of subcircuits
  (initial '())       ; ((line node value) ..) of .ic
  (span nil) (from-zero nil)   ; of .tran: [start, stop] as texts, whether uic is given
  (ignored '()))      ; commands that say nothing about the circuit

(defparameter *archive-net-ignored*
  '(".op" ".dc" ".ac" ".noise" ".tf" ".disto" ".four" ".fourier" ".meas" ".measure" ".print"
    ".plot" ".probe" ".save" ".options" ".option" ".opt" ".width" ".nodeset" ".sens" ".pz"
    ".backanno")
  "Commands that a circuit's equations do not depend on; they are named in a warning.")

(defparameter *archive-net-most* 20000 "The most elements that subcircuits may come to.")

(defun archive-net-read (text)
  "The netlist TEXT as an archive-netlist."
  (multiple-value-bind (title lines) (archive-net-split text)
    (let* ((netlist (make-archive-netlist :title (core-title-of-line title)))
           (own (archive-net-take-subcircuits netlist (archive-net-without-control netlist lines))))
      (archive-net-place-lines netlist own (netlist-top netlist) 0)
      (setf (netlist-elements netlist) (nreverse (netlist-elements netlist)))
      netlist)))

(defun archive-net-command (line)
  "The dot command of LINE in small letters, or nil."
  (let ((text (net-line-text line)))
    (and (char= (char text 0) #\.)
         (string-downcase (subseq text 0 (position-if (lambda (c)
                                                        (or (archive-net-blank-p c) (find c "(=")))
                                                      text))))))

(defun archive-net-ignore (netlist command)
  (pushnew command (netlist-ignored netlist) :test #'string=))

(defun archive-net-without-control (netlist lines)
  "LINES without the scripts from .control to .endc."
  (let ((inside nil) (kept '()))
    (dolist (line lines (nreverse kept))
      (let ((command (archive-net-command line)))
        (cond ((equal command ".control") (setq inside t) (archive-net-ignore netlist command))
              ((equal command ".endc") (setq inside nil))
              ((not inside) (push line kept)))))))

;;; Subcircuits

(defun archive-net-take-subcircuits (netlist lines)
  "LINES outside of subcircuits; these are noted in NETLIST."
  (let ((open nil) (kept '()))
    (dolist (line lines)
      (let* ((*archive-net-line* (net-line-number line)) (command (archive-net-command line)))
        (cond ((equal command ".subckt")
               (when open (archive-net-fault "a subcircuit inside of a subcircuit is not read"))
               (setq open (archive-net-new-subcircuit netlist line)))
              ((equal command ".ends")
               (unless open (archive-net-fault ".ends without .subckt"))
               (setf (net-subcircuit-lines open) (reverse (net-subcircuit-lines open))
                     open nil))
              (open (push line (net-subcircuit-lines open)))
              (t (push line kept)))))
    (when open
      (let ((*archive-net-line* (net-subcircuit-line open)))
        (archive-net-fault ".subckt without .ends")))
    (nreverse kept)))

(defun archive-net-new-subcircuit (netlist line)
  (let* ((fields (remove "params:" (rest (archive-net-fields (net-line-text line)))
                         :test #'string-equal))
         (equal-sign (position "=" fields :test #'string=))
         (cut (if equal-sign (1- equal-sign) (length fields)))
         (name (first fields)))
    (unless (and name (plusp cut)) (archive-net-fault ".subckt needs a name and its nodes"))
    (when (gethash (string-downcase name) (netlist-subcircuits netlist))
      (archive-net-fault "the subcircuit ~a is there already" (archive-shown name)))
    (setf (gethash (string-downcase name) (netlist-subcircuits netlist))
          (make-archive-net-subcircuit
           :line *archive-net-line* :ports (mapcar #'string-downcase (subseq fields 1 cut))
           :defaults (archive-net-pairs (nthcdr cut fields)) :lines '()))))

(defun archive-net-call (netlist line place depth)
  "Puts the subcircuit in that LINE calls, X1 node .. name param = value .."
  (let* ((fields (remove "params:" (archive-net-fields (net-line-text line))
                         :test #'string-equal))
         (equal-sign (position "=" fields :test #'string=))
         (cut (if equal-sign (1- equal-sign) (length fields)))
         (called (and (> cut 1) (nth (1- cut) fields)))
         (subcircuit (and called (gethash (string-downcase called)
                                          (netlist-subcircuits netlist)))))
    (unless subcircuit
      (archive-net-fault "there is no subcircuit ~a" (archive-shown (or called ""))))
    (let ((nodes (subseq fields 1 (1- cut))) (ports (net-subcircuit-ports subcircuit)))
      (unless (= (length nodes) (length ports))
        (archive-net-fault "~a has ~d nodes, the call gives ~d" called (length ports)
                           (length nodes)))
      (when (> depth 20) (archive-net-fault "subcircuits call each other more than 20 deep"))
      (when (> (incf (netlist-calls netlist)) (core-sized *archive-net-most*))
        (archive-net-fault "more than ~d calls of subcircuits" (core-sized *archive-net-most*)))
      (archive-net-place-lines
       netlist (net-subcircuit-lines subcircuit)
       (archive-net-new-place place (first fields)
                              (loop for port in ports
                                    for node in nodes
                                    collect (cons port (archive-net-node node place)))
                              subcircuit (archive-net-pairs (nthcdr cut fields)))
       (1+ depth)))))

(defun archive-net-new-place (place name ports subcircuit pairs)
  (let* ((scope (make-archive-net-scope :above (archive-net-top-scope place)))
         (names (mapcar #'first (net-subcircuit-defaults subcircuit))))
    (loop for (name value) in (net-subcircuit-defaults subcircuit)
          do (archive-net-define scope name value scope))
    (loop for (name value) in pairs
          do (unless (member name names :test #'string-equal)
               (archive-net-fault "the subcircuit has no parameter ~a" name))
             (archive-net-define scope name value (net-place-scope place)))
    (make-archive-net-place :prefix (format nil "~a~a." (net-place-prefix place) name)
                            :ports ports :scope scope :above place)))

(defun archive-net-top-scope (place)
  (loop while (net-place-above place) do (setq place (net-place-above place)))
  (net-place-scope place))

(defun archive-net-node (name place)
  "The whole name of the node NAME of PLACE in small letters."
  (let ((small (string-downcase name)))
    (cond ((member small '("0" "gnd") :test #'string=) "0")
          ((cdr (assoc small (net-place-ports place) :test #'string=)))
          (t (concatenate 'string (string-downcase (net-place-prefix place)) small)))))

;;; Lines of a place

(defun archive-net-place-lines (netlist lines place depth)
  "Notes what LINES say: parameters and models first."
  (flet ((each (function)
           (dolist (line lines)
             (let ((*archive-net-line* (net-line-number line)))
               (funcall function line (archive-net-command line))))))
    (each (lambda (line command)
            (cond ((equal command ".param") (archive-net-take-parameters line place))
                  ((equal command ".model") (archive-net-take-model line place)))))
    (each (lambda (line command)
            (cond ((member command '(".param" ".model") :test #'equal))
                  (command (archive-net-do-command netlist line command depth))
                  ((char-equal (char (net-line-text line) 0) #\x)
                   (archive-net-call netlist line place depth))
                  (t (archive-net-take-element netlist line place)))))))

(defun archive-net-take-parameters (line place)
  (let ((scope (net-place-scope place)))
    (loop for (name value) in (archive-net-pairs (rest (archive-net-fields (net-line-text line))))
          do (archive-net-define scope name value scope))))

(defun archive-net-take-element (netlist line place)
  (let* ((text (net-line-text line)) (fields (archive-net-fields text)))
    (unless fields (archive-net-fault "no element stands here, only commas"))
    (when (> (length (netlist-elements netlist)) (core-sized *archive-net-most*))
      (archive-net-fault "more than ~d elements; option size lifts that"
                         (core-sized *archive-net-most*)))
    (push (make-archive-net-element
           :line *archive-net-line* :fields (rest fields) :text text :place place
           :name (concatenate 'string (net-place-prefix place) (first fields)))
          (netlist-elements netlist))))

;;; Commands

(defun archive-net-do-command (netlist line command depth)
  (let ((fields (rest (archive-net-fields (net-line-text line)))))
    (cond ((plusp depth) (archive-net-fault "~a is not read inside of a subcircuit" command))
          ((string= command ".tran") (archive-net-take-span netlist fields))
          ((string= command ".ic") (archive-net-take-initial netlist fields))
          ((string= command ".title") (archive-net-take-title netlist line))
          ((member command *archive-net-ignored* :test #'string=)
           (archive-net-check-temperature fields)
           (archive-net-ignore netlist command))
          (t (archive-net-fault "~a is not read" (archive-shown command))))))

(defun archive-net-take-title (netlist line)
  "What stands behind .title takes the place of the first line."
  (setf (netlist-title netlist)
        (archive-net-trimmed (subseq (net-line-text line) (length ".title")))))

(defun archive-net-check-temperature (fields)
  (when (intersection fields '("temp" "tnom" "gmin" "scale") :test #'string-equal)
    (archive-net-fault "an option that changes the elements, ~{~a~^ ~}, is not read" fields)))

(defun archive-net-take-span (netlist fields)
  ".tran step stop [start [largest step]] [uic]"
  (let* ((zero (member "uic" fields :test #'string-equal))
         (times (ldiff fields zero))
         (scope (net-place-scope (netlist-top netlist))))
    (when (netlist-span netlist) (archive-net-fault ".tran stands twice"))
    (unless (<= 2 (length times) 4) (archive-net-fault ".tran needs a step and an end"))
    (setf (netlist-span netlist) (mapcar (lambda (field) (archive-net-value field scope)) times)
          (netlist-from-zero netlist) (and zero t))))

(defun archive-net-take-initial (netlist fields)
  ".ic v(node) = value .."
  (let ((scope (net-place-scope (netlist-top netlist))))
    (loop while fields
          do (destructuring-bind (&optional v open node close sign value &rest more) fields
               (unless (and value (string-equal v "v") (string= open "(") (string= close ")")
                            (string= sign "="))
                 (archive-net-fault "expected .ic v(node) = value"))
               (push (list *archive-net-line* (archive-net-node node (netlist-top netlist))
                           (archive-net-value value scope))
                     (netlist-initial netlist))
               (setq fields more)))))

;;; Models

(defun archive-net-take-model (line place)
  ".model name D(IS = .. N = ..)"
  (destructuring-bind (&optional name type &rest fields)
      (rest (archive-net-fields (net-line-text line)))
    (unless type (archive-net-fault ".model needs a name and a type"))
    (setf (gethash (string-downcase name) (net-place-models place))
          (list* (string-downcase type)
                 (archive-net-pairs (remove "(" (remove ")" fields :test #'string=)
                                            :test #'string=))))))

(defun archive-net-model (name place)
  "(type (parameter value) ..) of the model NAME, and the place where it stands."
  (loop for at = place then (net-place-above at)
        while at
        do (let ((model (gethash (string-downcase name) (net-place-models at))))
             (when model (return (values model at))))
        finally (archive-net-fault "there is no model ~a" (archive-shown name))))
