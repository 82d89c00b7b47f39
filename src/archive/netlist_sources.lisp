;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Independent sources of a netlist as functions of the time t: DC, SIN, EXP, PWL, one PULSE
;;; (ngspice manual, 4.1). Each segment is a case of piecewise; a jump takes its new value at once.
;;; A periodic PULSE is refused: it has no end. Fields are texts of the archive's grammar.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/netlist_lines" "archive/netlist_values" "archive/tokens"))

(defparameter *archive-net-waves*
  '(("sin" . archive-net-sine) ("exp" . archive-net-exponential) ("pwl" . archive-net-lines-of-time)
    ("pulse" . archive-net-pulse)))

(defun archive-net-source-value (fields scope span)
  "The text of the value of a source with FIELDS after its nodes; SPAN the texts of .tran."
  (let ((dc "0") (wave nil))
    (loop while fields
          do (let* ((field (pop fields)) (word (string-downcase field)))
               (when (and (member word '("dc" "ac") :test #'string=)
                          (equal (first fields) "="))
                 (pop fields))
               (cond ((string= word "dc")
                      (setq dc (archive-net-value (archive-net-next field fields) scope))
                      (pop fields))
                     ((string= word "ac") (setq fields (archive-net-after-ac fields)))
                     ((assoc word *archive-net-waves* :test #'string=)
                      (multiple-value-bind (numbers rest) (archive-net-wave-numbers fields scope)
                        (setq wave (funcall (cdr (assoc word *archive-net-waves* :test #'string=))
                                            numbers span)
                              fields rest)))
                     ((archive-net-like-value-p field) (setq dc (archive-net-value field scope)))
                     (t (archive-net-fault "found `~a' in a source; a value, DC, SIN, EXP, PWL and ~
                                            PULSE are read" (archive-shown field))))))
    (if wave (archive-net-spelled (archive-net-parsed wave)) dc)))

(defun archive-net-next (field fields)
  (or (first fields) (archive-net-fault "a value is missing after ~a" field)))

(defun archive-net-like-value-p (field)
  (and (plusp (length field)) (or (find (char field 0) "{+-.") (digit-char-p (char field 0)))
       t))

(defun archive-net-after-ac (fields)
  "FIELDS behind AC [magnitude [phase]]."
  (loop repeat 2
        while (and fields (archive-net-like-value-p (first fields)))
        do (pop fields))
  fields)

(defun archive-net-wave-numbers (fields scope)
  "Two values: the texts of the numbers of a function of time, in ( ) or without, and what follows."
  (let* ((open (equal (first fields) "(")) (fields (if open (rest fields) fields))
         (end (if open
                  (or (position ")" fields :test #'string=)
                      (archive-net-fault "a parenthesis without its end"))
                  (or (position-if-not #'archive-net-like-value-p fields) (length fields)))))
    (values (mapcar (lambda (field) (format nil "(~a)" (archive-net-value field scope)))
                    (subseq fields 0 end))
            (nthcdr (if open (1+ end) end) fields))))

;;; Numbers that must be known

(defun archive-net-rational (text)
  "The rational number that TEXT spells, or nil."
  (let ((value (archive-net-parsed text)))
    (cond ((integerp value) value)
          ((ratnump value) (/ (cadr value) (caddr value))))))

(defun archive-net-known (text)
  (or (archive-net-rational text)
      (archive-net-fault "the time ~a must be a rational number" text)))

(defun archive-net-written (number)
  (if (integerp number) (format nil "~d" number)
      (format nil "(~d/~d)" (numerator number) (denominator number))))

(defun archive-net-cases (cases)
  "piecewise of ((end value) ..), each up to its end, the last one without."
  (if (rest cases)
      (format nil "piecewise(~{~a~^, ~})"
              (loop for (end value) in cases
                    collect (if end
                                (format nil "[t < ~a, ~a]" (archive-net-written end) value)
                                (format nil "[true, ~a]" value))))
      (second (first cases))))

;;; Functions of the time

(defun archive-net-sine (numbers span)
  "SIN(offset amplitude frequency [delay [damping [phase in degrees]]])"
  (declare (ignore span))
  (unless (<= 3 (length numbers) 6)
    (archive-net-fault "SIN needs offset, amplitude and frequency, then perhaps delay, damping, ~
                        phase"))
  (destructuring-bind (offset amplitude frequency &optional (delay "0") (damping "0") (phase "0"))
      numbers
    (let* ((later (archive-net-known delay))
           (since (if (plusp later) (archive-net-since later)
                      (format nil "(t - ~a)" (archive-net-written later)))))
      (format nil "~a + ~a*sin(2*%pi*~a*~a + %pi*~a/180)*exp(-~a*~a)"
              offset amplitude frequency since phase since damping))))

(defun archive-net-since (time)
  "The time that has passed since TIME, 0 before: exponentials of it are finite at all times."
  (format nil "max(0, t - ~a)" (archive-net-written time)))

(defun archive-net-exponential (numbers span)
  "EXP(v1 v2 rise delay, rise constant, fall delay, fall constant)"
  (declare (ignore span))
  (unless (= 6 (length numbers))
    (archive-net-fault "EXP needs all of its six numbers: v1 v2 td1 tau1 td2 tau2"))
  (destructuring-bind (v1 v2 rise rise-constant fall fall-constant) numbers
    (let* ((from (archive-net-known rise)) (to (archive-net-known fall))
           (slope "(~a - ~a)*(1 - exp(-~a/~a))"))
      (unless (< from to) (archive-net-fault "EXP falls before it rises"))
      (format nil "~a + ~? + ~?" v1
              slope (list v2 v1 (archive-net-since from) rise-constant)
              slope (list v1 v2 (archive-net-since to) fall-constant)))))

(defun archive-net-lines-of-time (numbers span)
  "PWL(t1 v1 t2 v2 ..): straight lines between points, constant outside. Points at one time are a
jump from the first of them to the last."
  (declare (ignore span))
  (unless (and numbers (evenp (length numbers)))
    (archive-net-fault "PWL needs pairs of a time and a value"))
  (let ((points (loop for (time value) on numbers by #'cddr
                      collect (list (archive-net-known time) value))))
    (archive-net-check-times (mapcar #'first points))
    (archive-net-cases
     (append (list (first points))
             (loop for (one other) on points
                   when (and other (< (first one) (first other)))
                     collect (list (first other) (archive-net-line-between one other)))
             (list (list nil (second (first (last points)))))))))

(defun archive-net-check-times (times)
  (loop for (a b c) on times
        do (when (and b (> a b))
             (archive-net-fault "the times of PWL must rise; ~a stands behind ~a" b a))
           (when (and b (= a b) (not (eql b c)))
             (core-warn "~a, line ~d: PWL jumps at t = ~a, where it has two points; programs ~
                         other than ngspice may make a slope of it, or refuse it"
                        *archive-net-file* *archive-net-line* a))))

(defun archive-net-line-between (one other)
  (destructuring-bind ((a v) (b w)) (list one other)
    (format nil "~a + (~a - ~a)*(t - ~a)/~a" v w v (archive-net-written a)
            (archive-net-written (- b a)))))

(defun archive-net-pulse (numbers span)
  "PULSE(v1 v2 delay rise fall width period), once."
  (unless (<= 2 (length numbers) 7) (archive-net-fault "PULSE needs from two to seven numbers"))
  (archive-net-refuse-pulse numbers)
  (destructuring-bind (v1 v2 &optional (delay "0") rise fall width period) numbers
    (let* ((step (and span (archive-net-rational (first span))))
           (stop (and span (archive-net-rational (second span))))
           (a (archive-net-known delay))
           (b (+ a (archive-net-slope-time rise step)))
           (c (+ b (if width (archive-net-known width)
                       (or stop (archive-net-fault "PULSE without its width needs .tran")))))
           (d (+ c (archive-net-slope-time fall step))))
      (when (and period (plusp (archive-net-known period))
                 (not (and stop (<= stop (+ a (archive-net-known period))))))
        (archive-net-fault "a periodic PULSE is not read; leave its period out, or end .tran ~
                            within it"))
      (archive-net-cases
       (list (list a v1)
             (list b (archive-net-line-between (list a v1) (list b v2)))
             (list c v2)
             (list d (archive-net-line-between (list c v2) (list d v1)))
             (list nil v1))))))

(defun archive-net-refuse-pulse (numbers)
  "SPICE takes a width 0 for one that is not given; what began before 0 comes again with the period,
which unless given is the time of the run."
  (destructuring-bind (&optional (delay "0") rise fall (width "1") period) (cddr numbers)
    (declare (ignore rise fall period))
    (when (minusp (archive-net-known delay))
      (archive-net-fault "a PULSE that begins before 0 is not read"))
    (unless (plusp (archive-net-known width))
      (archive-net-fault "PULSE of the width 0: programs differ on it; give its width, or leave it ~
                          and what follows out"))))

(defun archive-net-slope-time (text step)
  "The time of a rise or a fall; the step of .tran where it is 0 or not given, as in SPICE."
  (let ((time (if text (archive-net-known text) 0)))
    (cond ((plusp time) time)
          (step step)
          (t (archive-net-fault "PULSE needs its rise and fall times")))))
