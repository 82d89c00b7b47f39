;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Laws of a netlist's branches B: a source whose current is a formula of its own voltage, whose
;;; voltage is one of its own current, or either one of the time. A power of what may be negative is
;;; refused, unless its exponent is an even number: programs differ on it.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/netlist_lines" "archive/netlist_parts" "archive/netlist_values"
                "archive/tokens"))

(defun archive-net-behaviour-law (element node)
  "Three values: the branch's type, the formula, and whether it is a law of the branch's own voltage
u or current i; NODE gives the whole name of a node."
  (multiple-value-bind (kind text) (archive-net-behaviour-text element)
    (let* ((met '())
           (*archive-net-even-powers* t)
           (formula (archive-net-expression
                     text (lambda (name)
                            (multiple-value-bind (piece what)
                                (archive-net-behaviour-name element name node)
                              (pushnew what met)
                              piece))))
           (value (archive-net-parsed formula)))
      (setq met (remove nil met))
      (when (rest met)
        (archive-net-fault "~a depends on the time and on the circuit at once"
                           (net-element-name element)))
      (values (archive-net-behaviour-type element kind (first met))
              (archive-net-spelled value)
              (and (member (first met) '(:voltage :current)) t)))))

(defun archive-net-behaviour-type (element kind met)
  (cond ((member met '(nil :time)) (if (char= kind #\i) "I" "E"))
        ((and (char= kind #\i) (eq met :voltage)) "RU")
        ((and (char= kind #\v) (eq met :current)) "RI")
        (t (archive-net-fault "~a: a current by its own voltage, or a voltage by its own current, ~
                               is read" (net-element-name element)))))

(defun archive-net-behaviour-text (element)
  "Two values: the letter i or v, and the expression behind =."
  (let* ((text (net-element-text element))
         (sign (position #\= text))
         (before (and sign (archive-net-trimmed (subseq text 0 sign))))
         (letter (and before (plusp (length before))
                      (char-downcase (char before (1- (length before))))))
         (after (and sign (archive-net-trimmed (subseq text (1+ sign))))))
    (unless (and letter (find letter "iv") (plusp (length after)))
      (archive-net-fault "~a: expected I = expression or V = expression"
                         (net-element-name element)))
    (values letter (substitute-if #\Space (lambda (c) (find c "{}'")) after))))

(defun archive-net-behaviour-name (element name node)
  "Two values: the text of NAME in a formula of ELEMENT, and what it is: :voltage, :current, :time,
or nil for a parameter."
  (cond ((equal name "time") (values "t" :time))
        ((stringp name)
         (values (archive-net-parameter name (net-place-scope (net-element-place element))) nil))
        ((string= (first name) "v")
         (values (archive-net-own-voltage element (second name) node) :voltage))
        ((string= (first name) "i")
         (unless (string-equal (archive-net-trimmed (second name))
                               (first (archive-net-fields (net-element-text element))))
           (archive-net-fault "~a depends on the current of ~a, another branch"
                              (net-element-name element) (archive-shown (second name))))
         (values "i" :current))
        (t (archive-net-fault "the function ~a is not read" (archive-shown (first name))))))

(defun archive-net-own-voltage (element inside node)
  "u or -u for v(a,b) or v(b,a), v(a) where b is 0."
  (let ((named (mapcar node (archive-net-fields inside)))
        (own (mapcar node (subseq (net-element-fields element) 0 2))))
    (when (= (length named) 1) (setq named (append named '("0"))))
    (cond ((equal named own) "u")
          ((equal named (reverse own)) "(-u)")
          (t (archive-net-fault "~a depends on v(~a), which is not its own voltage"
                                (net-element-name element) (archive-shown inside))))))
