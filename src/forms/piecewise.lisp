;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Functions with branches: piecewise([condition, value], ..), of which Maxima knows nothing, after
;;; names in it got values; and derivatives at a point of max, min, abs, signum, unit_step and
;;; piecewise. Near a point where it is decided which branch holds the function is that branch, and
;;; so is its derivative; where two branches meet there is none. And functions that jump, such as
;;; atan2 on its cut and floor. See forms-piecewise, forms-kinked-slope and forms-jump-at first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/sign" "algebra/size"))

(defun forms-piecewise (pieces)
  "The value of PIECES, or piecewise of those whose condition may hold."
  (let ((open '()))
    (dolist (piece pieces (forms-open-pieces open))
      (case (forms-condition-truth (second piece))
        (yes (return (if open
                         (forms-open-pieces (cons (list '(mlist simp) t (third piece)) open))
                         (third piece))))
        (unknown (push piece open))))))

(defun forms-open-pieces (pieces)
  (unless pieces (core-error "piecewise has no value where none of its conditions holds"))
  (cons '($piecewise simp) (reverse pieces)))

(defun forms-condition-truth (condition)
  "yes, no or unknown, under the facts of the call."
  (cond ((member condition '(t $otherwise)) 'yes)
        ((or (atom condition) (not (member (caar condition) '(mgreaterp mgeqp mlessp mleqp))))
         'unknown)
        (t (let ((sign ($algebra_sign (sub (second condition) (third condition)))))
             (ecase (caar condition)
               (mgreaterp (forms-truth sign '($pos) '($neg $zero $nz)))
               (mgeqp (forms-truth sign '($pos $zero $pz) '($neg)))
               (mlessp (forms-truth sign '($neg) '($pos $zero $pz)))
               (mleqp (forms-truth sign '($neg $zero $nz) '($pos))))))))

(defun forms-truth (sign holding failing)
  (cond ((member sign holding) 'yes)
        ((member sign failing) 'no)
        (t 'unknown)))

(defun forms-with-parts (e parts)
  "E with PARTS in place of its own, simplified; powers of numbers are predicted."
  (cond ((every #'eq parts (cdr e)) e)
        ((eq (caar e) '$piecewise) (forms-piecewise parts))
        (t (when (eq (caar e) 'mexpt) (algebra-guard-power-of-number (first parts) (second parts)))
           (simplifya (cons (remove 'simp (car e)) parts) nil))))

;;; At a point.

(defparameter *forms-kinked* '($max $min mabs %signum $unit_step $piecewise))

(defun forms-kinked-p (e)
  (and (consp e)
       (or (member (caar e) *forms-kinked*) (some #'forms-kinked-p (cdr e)))))

(defun forms-kinked-slope (e at-point)
  "The derivative noun E at a point, AT-POINT being the function that puts it in; nil where it is
not decided which branch holds there."
  (when (and (eq (caar e) '%derivative) (forms-kinked-p (cadr e)))
    (let ((branch (catch 'forms-no-branch (forms-branch (cadr e) at-point))))
      (when (and branch (not (forms-kinked-p branch)))
        (funcall at-point (apply #'$diff branch (cddr e)))))))

(defun forms-branch (e at-point)
  "E with the branches that hold at the point; leaves forms-no-branch with nil where that is open."
  (cond ((not (forms-kinked-p e)) e)
        ((not (member (caar e) *forms-kinked*))
         (forms-with-parts e (mapcar (lambda (part) (forms-branch part at-point)) (cdr e))))
        ((eq (caar e) '$piecewise) (forms-piece e at-point))
        (t (let ((parts (mapcar (lambda (part) (forms-branch part at-point)) (cdr e))))
             (ecase (caar e)
               (%signum (forms-side-of e (car parts) at-point))
               (mabs (mul (forms-side-of e (car parts) at-point) (car parts)))
               ($unit_step (if (eql 1 (forms-side-of e (car parts) at-point)) 1 0))
               (($max $min) (forms-extreme e parts at-point)))))))

(defun forms-side-of (e u at-point)
  "1 or -1, the sign of U at the point; E, whose kink it is, has no derivative where U is 0."
  (case ($algebra_sign (funcall at-point u))
    ($pos 1)
    ($neg -1)
    ($zero (forms-no-slope e))
    (t (throw 'forms-no-branch nil))))

(defun forms-no-slope (e)
  (core-error "~a has no derivative where its branches meet" (core-words (list e))))

(defun forms-extreme (e parts at-point)
  "The one of PARTS that is the largest, or smallest, at the point."
  (let ((better (if (eq (caar e) '$max) '$pos '$neg)) (open nil))
    (flet ((wins-p (part)
             (loop for other in (remove part parts :test #'alike1)
                   for sign = ($algebra_sign (funcall at-point (sub part other)))
                   do (unless (member sign '($pos $neg $zero)) (setq open t))
                   always (eq sign better))))
      (cond ((find-if #'wins-p parts))
            (open (throw 'forms-no-branch nil))
            (t (forms-no-slope e))))))

(defun forms-piece (e at-point)
  "The value of piecewise([condition, value], ..) whose condition is the first that holds."
  (loop for (nil condition value) in (cdr e)
        when (forms-condition-holds-p e condition at-point) return (forms-branch value at-point)
        finally (return (throw 'forms-no-branch nil))))

(defun forms-condition-holds-p (e condition at-point)
  (cond ((member condition '(t $otherwise)) t)
        ((atom condition) (throw 'forms-no-branch nil))
        (t (let ((side (forms-side-of e (sub (second condition) (third condition)) at-point)))
             (case (caar condition)
               ((mgreaterp mgeqp) (= side 1))
               ((mlessp mleqp) (= side -1))
               (t (throw 'forms-no-branch nil)))))))

(defun forms-kink-at (e at-point)
  "A function in E that has no derivative at the point, or nil."
  (cond ((atom e) nil)
        ((some (lambda (part) (forms-kink-at part at-point)) (cdr e)))
        ((and (member (caar e) *forms-kinked*)
              (null (core-attempt (lambda ()
                                    (catch 'forms-no-branch (forms-branch e at-point))))))
         e)))

(defun $forms_open_kink (e)
  "A function with branches whose derivative E still has as a noun: which branch holds is open."
  (cond ((atom e) nil)
        ((eq (caar e) '%derivative) (forms-first-kinked (cadr e)))
        (t (some #'$forms_open_kink (cdr e)))))

(defun forms-first-kinked (e)
  (cond ((atom e) nil)
        ((member (caar e) *forms-kinked*) e)
        (t (some #'forms-first-kinked (cdr e)))))

;;; Jumps: a derivative taken by a formula says nothing of a function that jumps at the point.

(defparameter *forms-stepping*
  '($floor $ceiling %round %truncate $mod %kron_delta %hstep $charfun
    $isqrt $inrt $totient $moebius $divsum $next_prime $prev_prime)
  "Functions that have jumps wherever they move.")

(defun forms-smooth-at-p (e at-point)
  "Whether it is known that E, a function of what moves, does not jump at the point."
  (flet ((sign (part) ($algebra_sign (funcall at-point part))))
    (case (caar e)
      ($atan2 (or (member (sign (second e)) '($pos $neg $pn)) (eq (sign (third e)) '$pos)))
      ((%acot %acsch) (member (sign (second e)) '($pos $neg $pn)))
      (t (not (member (caar e) *forms-stepping*))))))

(defun forms-jump-at (e at-point moving)
  "A function in E that may jump at the point, or nil; the names MOVING move."
  (cond ((atom e) nil)
        ((some (lambda (part) (forms-jump-at part at-point moving)) (cdr e)))
        ((and (not (forms-smooth-at-p e at-point))
              (some (lambda (name) (some (lambda (part) (among name part)) (cdr e))) moving))
         e)))
