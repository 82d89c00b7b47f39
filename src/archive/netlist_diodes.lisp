;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Diodes of a netlist at 27 degrees: the junction's law i = IS*(exp(u/(N*Vt)) - 1), the resistance
;;; RS of its leads, its capacitance C(u) = CJO*(1 - u/VJ)^-M, above u = FC*VJ on its tangent, and
;;; TT*di/du (Massobrio, Antognetti, Semiconductor Device Modeling with SPICE, chapter 1); each is
;;; that of an area 1.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/netlist_lines" "archive/netlist_parts" "archive/netlist_values"
                "archive/tokens"))

(defparameter *archive-net-thermal*
  (/ (* 138064852/100000000 30015/100) (* 16021766208/10000000000 10000))
  "k*T/q in volts at T = 300.15 K, with ngspice's constants.")

(defparameter *archive-net-diode-parameters*
  '(("is" . "(1/100000000000000)") ("n" . "1") ("rs" . "0") ("cjo" . "0") ("vj" . "1")
    ("m" . "(1/2)") ("fc" . "(1/2)") ("tt" . "0"))
  "Parameters that are read, with their defaults.")

(defparameter *archive-net-diode-idle* '("eg" "xti" "kf" "af")
  "Parameters that say nothing at this temperature and without noise.")

(defun archive-net-diode-model (element model)
  "((parameter . text) ..) of the MODEL of ELEMENT, all of those that are read."
  (let ((found (copy-alist *archive-net-diode-parameters*)))
    (multiple-value-bind (described at) (archive-net-model model (net-element-place element))
      (unless (string= (first described) "d")
        (archive-net-fault "~a is no model of a diode" (archive-shown model)))
      (loop for (name field) in (rest described)
            for value = (archive-net-value field (net-place-scope at))
            for known = (assoc (archive-net-diode-name name) found :test #'string-equal)
            do (if known
                   (setf (cdr known) value)
                   (archive-net-check-idle name value))))
    found))

(defun archive-net-diode-name (name)
  (if (member name '("cj0" "cj") :test #'string-equal) "cjo" name))

(defun archive-net-check-idle (name value)
  (unless (or (member name *archive-net-diode-idle* :test #'string-equal)
              (and (member name '("bv" "ibv") :test #'string-equal) (string= value "0"))
              (and (string-equal name "level") (string= value "1"))
              (and (string-equal name "tnom") (string= value "27")))
    (archive-net-fault "the parameter ~a = ~a of a diode is not read; IS, N, RS, CJO, VJ, M, FC ~
                        and TT are" name value)))

(defun archive-net-diode-text (model area control)
  "The text of the formula CONTROL, which may name the parameters of MODEL by their words, as in
~(is), AREA by ~(area), and N*Vt by ~(thermal)."
  (let ((words (list* (cons "area" area)
                      (cons "thermal" (format nil "(~a*~d/~d)"
                                              (cdr (assoc "n" model :test #'string=))
                                              (numerator *archive-net-thermal*)
                                              (denominator *archive-net-thermal*)))
                      model)))
    (archive-net-spelled
     (archive-net-parsed
      (with-output-to-string (out)
        (loop with from = 0
              for open = (search "~(" control :start2 from)
              do (write-string control out :start from :end (or open (length control)))
                 (unless open (return))
                 (let ((close (position #\) control :start open)))
                   (format out "(~a)" (cdr (assoc (subseq control (+ open 2) close) words
                                                  :test #'string=)))
                   (setq from (1+ close)))))))))

(defun archive-net-diode-given-p (model name)
  (string/= (cdr (assoc name model :test #'string=)) "0"))

(defun archive-net-diode-law (model area)
  (archive-net-diode-text model area "~(area)*~(is)*(exp(u/~(thermal)) - 1)"))

(defun archive-net-diode-resistance (model area)
  "RS, or nil where it is 0."
  (when (archive-net-diode-given-p model "rs")
    (archive-net-diode-text model area "~(rs)/~(area)")))

(defun archive-net-diode-capacitance (model area)
  "The text of C(u), or nil where it is 0."
  (flet ((formula (control) (archive-net-diode-text model area control)))
    (let ((moved (and (archive-net-diode-given-p model "tt")
                      (formula "~(area)*~(tt)*~(is)/~(thermal)*exp(u/~(thermal))")))
          (bound (and (archive-net-diode-given-p model "cjo")
                      (formula (format nil "~~(area)*~~(cjo)*(1 - ~a/~~(vj))^(-~~(m))*~
                                            (1 + ~~(m)*(u - ~:*~a)/(~~(vj)*(1 - ~~(fc))))"
                                       "min(u, ~(fc)*~(vj))")))))
      (if (and moved bound) (format nil "~a + ~a" bound moved) (or bound moved)))))
