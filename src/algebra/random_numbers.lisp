;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Random numbers for checks and trials, the same on every machine and in every call: they are
;;; decided by the spelling of what they stand for, so that a failure is found again. One sequence,
;;; x -> 7141 x + 54773 modulo 259200, begins at the spelling; its members are the trials.

(in-package :maxima)

(defconstant algebra-random-states 259200)

(defun algebra-next-state (state more)
  (mod (+ (* 7141 state) 54773 more) algebra-random-states))

(defun algebra-random-spelling (e)
  (cond ((stringp e) e)
        ((symbolp e) (symbol-name e))
        (t (coerce (mstring e) 'string))))

(defun algebra-random-state (e trial)
  "One of algebra-random-states whole numbers from 0, for E, a text, name or form, in this TRIAL."
  (let ((state 20011))
    (loop for character across (algebra-random-spelling e)
          do (setq state (algebra-next-state state (* 331 (char-code character)))))
    (loop repeat trial do (setq state (algebra-next-state state 0)))
    state))

(defun algebra-random-number (e)
  "A rational number between 1/4 and 3/4 for E."
  (+ 1/4 (/ (algebra-random-state e 0) 524288)))

(defun algebra-random-below (n state)
  "A whole number from 0 below N, and a state that tells little of it."
  (multiple-value-bind (number rest) (floor (* n state) algebra-random-states)
    (values number rest)))

(defun $algebra_random_fraction (e trial numerators denominators)
  "For E in this TRIAL a positive fraction, whose parts are at most NUMERATORS and DENOMINATORS."
  (multiple-value-bind (above rest)
      (algebra-random-below numerators (algebra-random-state e trial))
    (div (1+ above) (1+ (algebra-random-below denominators rest)))))
