;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Limits of size. Some keep the memory or the grammar; the others are a taste: how long a person
;;; is thought to wait or to read. These hold `size' times, an option of every call, 1 unless given
;;; and at most 100; their messages say the number, the place and the option.

(in-package :maxima)

(defvar *core-size* 1 "How many times the limits that are a taste hold.")

(defun core-sized (most)
  "The limit MOST in this call."
  (floor (* most *core-size*)))

(defun core-size-advice (found most)
  "What lifts the limit MOST for what has the size FOUND, a number or nil."
  (cond ((null found) "size = 10 makes this limit ten times as large")
        ((<= found (* 100 most)) (format nil "size = ~D lifts this limit" (ceiling found most)))
        (t "no size up to 100 lifts this limit so far")))

(defun core-within-size (found most what unit)
  "An error where WHAT has FOUND of UNIT, more than MOST times the size."
  (when (> found (core-sized most))
    (core-error "~A: ~D ~A, more than ~D; ~A" what found unit (core-sized most)
                (core-size-advice found most))))

(defun $core_sized (most) (core-sized most))

(defun $core_size_advice (found most)
  (core-size-advice (and (integerp found) found) most))
