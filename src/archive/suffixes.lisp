;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The suffixes of SPICE's numbers, 4.7k, 10MEG. Netlists have them; an archive does not, and says
;;; what to write.

(in-package :maxima)

(defparameter *archive-suffixes*
  '(("meg" . 6) ("t" . 12) ("g" . 9) ("k" . 3) ("m" . -3) ("u" . -6) ("n" . -9) ("p" . -12)
    ("f" . -15))
  "Suffixes and their powers of ten; the longer ones first.")

(defun archive-suffix-advice (digits word value)
  "That 4.7k is written 4700: DIGITS is the number, WORD what follows it; nil where that is no
suffix."
  (let ((power (cdr (assoc word *archive-suffixes* :test #'string-equal))))
    (when power
      (let ((number (* (expt 10 power) (cond ((floatp value) (rational value))
                                             ((consp value) (/ (cadr value) (caddr value)))
                                             (t value)))))
        (format nil "~a~a is written ~d~@[/~d~]" digits word (numerator number)
                (and (not (integerp number)) (denominator number)))))))
