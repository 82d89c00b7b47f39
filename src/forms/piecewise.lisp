;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Functions with branches: piecewise([condition, value], ..), of which Maxima knows nothing, after
;;; names in it got values; and derivatives at a point of max, min, abs, signum, unit_step and
;;; piecewise. Near a point where it is decided which branch holds the function is that branch, and
;;; so is its derivative; where branches meet it has a derivative if they all have the same value
;;; and the same gradient there: f(q) - f(p) is f_b(q) - f_b(p) = f'(p)*(q - p) + o(q - p) for one
;;; of them. And functions that jump, such as atan2 on its cut and floor. See forms-piecewise,
;;; forms-branches and forms-jump-at first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/sign" "algebra/size" "algebra/zero"))

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

(defparameter *forms-most-branches* 64 "With more that may meet at a point nothing is decided.")

(defun forms-kinked-p (e)
  "Whether functions with branches stand in E; an integral of one has none of its own."
  (and (consp e)
       (not (member (caar e) '(%integrate %sum %product %limit %at %derivative)))
       (or (and (member (caar e) *forms-kinked*) t) (some #'forms-kinked-p (cdr e)))))

(defun forms-kinked-slope (e at-point place)
  "The derivative noun E at the point PLACE, AT-POINT being the function that puts it in; nil where
it is not decided which branch holds there."
  (when (and (eq (caar e) '%derivative) (forms-kinked-p (cadr e)))
    (let ((branches (forms-branches-or-nil (cadr e) at-point)))
      (cond ((null branches) nil)
            ((null (cdr branches)) (funcall at-point (apply #'$diff (car branches) (cddr e))))
            ((and (eql 1 (fourth e)) (null (cddddr e))
                  (forms-branches-agree-p branches (list (third e)) at-point))
             (funcall at-point ($diff (car branches) (third e))))
            (t (core-error "~a has no derivative at ~a"
                           (core-words (list (cadr e))) (core-words (list place))))))))

(defun forms-branches-or-nil (e at-point)
  (catch 'forms-no-branch (forms-branches e at-point)))

(defun forms-branches (e at-point)
  "What E may be near the point, without functions with branches: one or, where branches meet,
several; leaves forms-no-branch with nil where that is open."
  (cond ((not (forms-kinked-p e)) (list e))
        ((eq (caar e) '$piecewise) (forms-different (forms-pieces-met e at-point)))
        (t (let ((choices (forms-combinations
                           (mapcar (lambda (part) (forms-branches part at-point)) (cdr e)))))
             (forms-different (loop for parts in choices
                                    append (forms-branches-of e parts at-point)))))))

(defun forms-different (branches)
  (remove-duplicates branches :test #'alike1 :from-end t))

(defun forms-combinations (lists)
  (when (> (reduce #'* (mapcar #'length lists)) *forms-most-branches*)
    (throw 'forms-no-branch nil))
  (reduce (lambda (list tails)
            (loop for e in list append (loop for tail in tails collect (cons e tail))))
          lists :initial-value '(nil) :from-end t))

(defun forms-branches-of (e parts at-point)
  "Those of the function E of PARTS, which have no branches."
  (flet ((sides () (forms-sides-of (car parts) at-point)))
    (case (caar e)
      (%signum (if (cdr (sides)) '(1 -1 0) (sides)))
      (mabs (loop for side in (sides) collect (mul side (car parts))))
      ($unit_step (loop for side in (sides) collect (if (eql 1 side) 1 0)))
      ($max (forms-extremes '$neg parts at-point))
      ($min (forms-extremes '$pos parts at-point))
      (t (list (forms-with-parts e parts))))))

(defun forms-sides-of (u at-point)
  "(1) or (-1), the sign of U at the point, both where it is 0."
  (case ($algebra_sign (funcall at-point u))
    ($pos '(1))
    ($neg '(-1))
    ($zero '(1 -1))
    (t (throw 'forms-no-branch nil))))

(defun forms-extremes (worse parts at-point)
  "Those of PARTS that no other surpasses at the point: PART - OTHER has nowhere the sign WORSE."
  (flet ((sign (part other)
           (let ((sign ($algebra_sign (funcall at-point (sub part other)))))
             (if (member sign '($pos $neg $zero)) sign '$unknown))))
    (let ((left (remove-if (lambda (part)
                             (some (lambda (other) (eq (sign part other) worse)) parts))
                           parts)))
      (loop for part in left
            do (dolist (other left)
                 (when (eq (sign part other) '$unknown) (throw 'forms-no-branch nil))))
      left)))

(defun forms-pieces-met (e at-point)
  "The values of piecewise([condition, value], ..) up to the first whose condition surely holds."
  (let ((met '()))
    (loop for (nil condition value) in (cdr e)
          do (let ((truth (forms-condition-near condition at-point)))
               (unless (eq truth 'no)
                 (setq met (append met (forms-branches value at-point))))
               (when (eq truth 'yes) (return met)))
          finally (throw 'forms-no-branch nil))))

(defun forms-condition-near (condition at-point)
  "yes, no, or both where it holds on one side of the point."
  (cond ((member condition '(t $otherwise)) 'yes)
        ((or (atom condition) (not (member (caar condition) '(mgreaterp mgeqp mlessp mleqp))))
         (throw 'forms-no-branch nil))
        (t (let ((sides (forms-sides-of (sub (second condition) (third condition)) at-point))
                 (holding (if (member (caar condition) '(mgreaterp mgeqp)) 1 -1)))
             (cond ((cdr sides) 'both)
                   ((eql (car sides) holding) 'yes)
                   (t 'no))))))

(defun forms-branches-agree-p (branches names at-point)
  "Whether all BRANCHES have one value and one derivative by each of NAMES at the point: then the
function has these too, however the branches meet there."
  (flet ((vanishes-p (e)
           (equal (core-attempt (lambda () ($algebra_zerop (funcall at-point e)))) '(t))))
    (loop for branch in (cdr branches)
          for rise = (sub branch (car branches))
          always (and (vanishes-p rise)
                      (every (lambda (name) (vanishes-p ($diff rise name))) names)))))

(defun forms-meeting-p (e at-point)
  "Whether several branches of E meet at the point."
  (and (cdr (forms-branches-or-nil e at-point)) t))

(defun forms-kink-at (e at-point)
  "A function in E of which several branches meet at the point, or nil."
  (cond ((not (forms-kinked-p e)) nil)
        ((some (lambda (part) (forms-kink-at part at-point)) (cdr e)))
        ((and (member (caar e) *forms-kinked*) (forms-meeting-p e at-point)) e)))

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
