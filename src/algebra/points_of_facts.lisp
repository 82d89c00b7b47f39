;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Rational points at which all facts hold, by arithmetic alone. Where there is one the facts do
;;; not contradict each other, and of e that is positive at one of them and negative at another no
;;; sign is to be proved: proofs that would be sought in vain, most of all, are not begun. Points
;;; come from a walk: of a fact that fails a name changes its value (B. Selman, H. Kautz, B. Cohen,
;;; Noise strategies for improving local search, AAAI 1994). It may find none; nothing follows then.
;;; Look first at algebra-seen-signs.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/memory" "algebra/random_numbers" "algebra/sign_by_parts" "algebra/size"))

(defstruct (algebra-search (:conc-name search-) (:predicate nil) (:copier nil))
  (names '())       ; in the order of the coordinates
  (conditions '())  ; ((form sign ..) ..), the signs that are allowed: 1, 0, -1
  (points '())      ; vectors of rational numbers at which all conditions hold
  (seen (make-hash-table :test #'equal)) ; keys of expressions -> the signs they were seen to have
  (state 20011))    ; of the random numbers

;;; Forms: a rational number, (at place), (+ form ..), (* form ..), (^ form power); of polynomials
;;; (whole form form), the first one to be taken at whole numbers, see there.

(defun algebra-read-form (e search)
  "E as a form; throws nil to no-form where it is no rational function of names."
  (let* ((form (algebra-plain-form e search)) (whole (catch 'no-whole (algebra-whole-form form))))
    (if (and whole (consp form)) (list 'whole whole form) form)))

(defun algebra-plain-form (e search)
  (let ((number (algebra-rational-number e)))
    (flet ((forms () (loop for part in (cdr e) collect (algebra-plain-form part search))))
      (cond (number)
            ((core-users-name-p e) (list 'at (algebra-search-place e search)))
            ((floatp e) (rationalize e))
            ((atom e) (throw 'no-form nil))
            ((mplusp e) (cons '+ (forms)))
            ((mtimesp e) (cons '* (forms)))
            ((and (mexptp e) (typep (caddr e) '(integer -20 20)))
             (list '^ (algebra-plain-form (cadr e) search) (caddr e)))
            (t (throw 'no-form nil))))))

(defun algebra-search-place (name search)
  "The place of NAME, which gets a value at each point where it is new."
  (or (position name (search-names search) :test #'eq)
      (progn (setf (search-names search) (append (search-names search) (list name))
                   (search-points search)
                   (loop for point in (search-points search)
                         collect (concatenate 'simple-vector point
                                              (list (algebra-search-number search)))))
             (1- (length (search-names search))))))

(defun algebra-number-at (form point)
  "A rational number; throws nil to no-value where it is divided by 0."
  (if (atom form)
      form
      (ecase (car form)
        (at (svref point (cadr form)))
        (+ (let ((sum 0))
             (dolist (part (cdr form) sum) (setq sum (+ sum (algebra-number-at part point))))))
        (* (let ((product 1))
             (dolist (part (cdr form) product)
               (setq product (* product (algebra-number-at part point))))))
        (^ (let ((base (algebra-number-at (cadr form) point)))
             (if (and (eql base 0) (minusp (caddr form)))
                 (throw 'no-value nil)
                 (expt base (caddr form))))))))

;;; Polynomials at x = X/d, X and d whole: d^n*s times the value is whole, and is found without
;;; fractions. A sum is (+ (factor power . form) ..), of factor*d^power*form.

(defun algebra-whole-form (form)
  "Three values: the form, n and s; throws nil to no-whole where FORM is no polynomial."
  (cond ((rationalp form) (values (numerator form) 0 (denominator form)))
        ((eq (car form) 'at) (values form 1 1))
        ((eq (car form) '+) (algebra-whole-sum (cdr form)))
        ((eq (car form) '*) (algebra-whole-product (cdr form)))
        ((minusp (caddr form)) (throw 'no-whole nil))
        (t (destructuring-bind (base power) (cdr form)
             (multiple-value-bind (whole n s) (algebra-whole-form base)
               (values (list '^ whole power) (* n power) (expt s power)))))))

(defun algebra-whole-sum (parts)
  (let* ((found (loop for part in parts collect (multiple-value-list (algebra-whole-form part))))
         (n (reduce #'max found :key #'second)) (s (reduce #'lcm found :key #'third)))
    (values (cons '+ (loop for (whole k r) in found collect (list* (floor s r) (- n k) whole)))
            n s)))

(defun algebra-whole-product (parts)
  (let ((n 0) (s 1))
    (values (cons '* (loop for part in parts
                           collect (multiple-value-bind (whole k r) (algebra-whole-form part)
                                     (incf n k)
                                     (setq s (* s r))
                                     whole)))
            n s)))

(defun algebra-whole-at (form wholes)
  "The value of FORM at WHOLES, the X and d."
  (declare (type simple-vector wholes))
  (if (atom form)
      form
      (ecase (car form)
        (at (svref wholes (cadr form)))
        (+ (let ((sum 0))
             (loop for (factor power . part) in (cdr form)
                   for value = (algebra-whole-at part wholes)
                   do (unless (eql factor 1) (setq value (* factor value)))
                      (unless (eql power 0)
                        (setq value (* value (expt (svref wholes (1- (length wholes))) power))))
                      (setq sum (+ sum value)))
             sum))
        (* (let ((product 1))
             (dolist (part (cdr form) product)
               (setq product (* product (algebra-whole-at part wholes))))))
        (^ (expt (algebra-whole-at (cadr form) wholes) (caddr form))))))

(defun algebra-wholes-of (point)
  "The X of POINT, and d after them."
  (let ((d (reduce #'lcm point :key #'denominator :initial-value 1)) (n (length point)))
    (let ((wholes (make-array (1+ n) :initial-element d)))
      (dotimes (i n wholes)
        (let ((x (svref point i)))
          (setf (svref wholes i) (* (numerator x) (floor d (denominator x)))))))))

;;; Where a walk is: the point as rational numbers, which it changes, and as whole ones

(defun algebra-place (point) (cons point (algebra-wholes-of point)))

(defun algebra-value-in (form place)
  "A positive multiple of the value of FORM at PLACE, the same at all of one d; nil where there is
none."
  (cond ((atom form) form)
        ((eq (car form) 'whole) (algebra-whole-at (cadr form) (cdr place)))
        (t (catch 'no-value (algebra-number-at form (car place))))))

(defun algebra-sign-at (form place)
  "1, 0, -1, or nil where FORM has no value."
  (let ((value (algebra-value-in form place)))
    (and value (signum value))))

(defun algebra-coordinates-in (form)
  (cond ((atom form) '())
        ((eq (car form) 'at) (copy-list (cdr form)))
        ((eq (car form) 'whole) (algebra-coordinates-in (caddr form)))
        (t (mapcan #'algebra-coordinates-in (cdr form)))))

(defun algebra-condition-holds-p (condition place)
  (member (algebra-sign-at (car condition) place) (cdr condition)))

;;; The walk

(defparameter *algebra-kept-points* 12)
(defparameter *algebra-walks* 4 "How often a point of facts is sought.")
(defparameter *algebra-walk-steps* 60 "How many names of one may change.")

(defun algebra-search-below (n search)
  (let ((state (algebra-next-state (search-state search) 0)))
    (setf (search-state search) state)
    (values (algebra-random-below n state))))

(defun algebra-search-choice (list search)
  (and list (nth (algebra-search-below (length list) search) list)))

(defparameter *algebra-search-numbers*
  #(1 -1 2 -2 1/2 -1/2 3 -3 5 -5 1/3 -1/3 7 -7 10 -10 1/5 -1/5 0 20 -20 1/10 3/2 -3/2))

(defun algebra-search-number (search)
  (svref *algebra-search-numbers*
         (algebra-search-below (length *algebra-search-numbers*) search)))

(defun algebra-new-value (form place point search)
  "Another number for PLACE: any, one beside that there was, or one beside a root of FORM."
  (let ((value (svref point place)))
    (case (algebra-search-below 6 search)
      (0 (- value))
      (1 (* value (1+ (algebra-search-below 3 search))))
      (2 (+ value (algebra-search-number search)))
      ((3 4) (algebra-beside-root form place point search))
      (t (algebra-search-number search)))))

(defun algebra-beside-root (form place point search)
  "The root, or a number beside it, of what goes through the values of FORM at 0 and 1."
  (flet ((at (value)
           (let ((other (copy-seq point)))
             (setf (svref other place) value)
             (algebra-value-in form (algebra-place other)))))
    (let ((start (at 0)) (end (at 1)) (number (algebra-search-number search)))
      (cond ((or (null start) (null end) (= start end)) number)
            ((zerop (algebra-search-below 3 search)) (/ start (- start end)))
            (t (+ (/ start (- start end)) number))))))

(defstruct (algebra-judged (:conc-name judged-) (:predicate nil) (:copier nil))
  "A condition, the places of the names in it, and whether it holds where the walk is."
  condition places holds)

(defun algebra-walk (conditions point search)
  "A point near POINT at which all CONDITIONS hold, or nil; POINT is changed."
  (let* ((judged (algebra-judged-at point conditions)) (open (algebra-failing judged)))
    (loop repeat *algebra-walk-steps* while open
          do (let* ((failing (algebra-search-choice open search))
                    (form (car (judged-condition failing)))
                    (place (algebra-search-choice (judged-places failing) search))
                    (value (and place (algebra-new-value form place point search))))
               (when (and value (< (integer-length (numerator value)) 20)
                          (< (integer-length (denominator value)) 20))
                 (setq open (algebra-changed-place place value point judged open search)))))
    (and (null open) point)))

(defun algebra-judged-at (point conditions)
  (loop with here = (algebra-place point)
        for condition in conditions
        collect (make-algebra-judged :condition condition
                                     :places (algebra-coordinates-in (car condition))
                                     :holds (algebra-condition-holds-p condition here))))

(defun algebra-failing (judged)
  (remove-if #'judged-holds judged))

(defun algebra-changed-place (place value point judged open search)
  "The conditions that fail with VALUE at PLACE, which stays so where they are no more than OPEN, or
now and then; else OPEN."
  (let* ((before (svref point place))
         (touched (remove-if-not (lambda (j) (member place (judged-places j))) judged))
         (held (mapcar #'judged-holds touched)))
    (setf (svref point place) value)
    (loop with here = (algebra-place point)
          for j in touched
          do (setf (judged-holds j) (algebra-condition-holds-p (judged-condition j) here)))
    (let ((now (algebra-failing judged)))
      (cond ((or (<= (length now) (length open)) (zerop (algebra-search-below 12 search))) now)
            (t (setf (svref point place) before)
               (loop for j in touched for holds in held do (setf (judged-holds j) holds))
               open)))))

;;; The points of facts

(defun algebra-keep-point (point search)
  (let ((others (search-points search)))
    (setf (search-points search)
          (cons point (subseq others 0 (min (length others) (1- *algebra-kept-points*)))))))

(defvar *algebra-last-search* '(nil nil . nil) "The table, the facts and the search of last time.")

(defun algebra-search-of (facts)
  "A search with points at which FACTS hold, or nil."
  (let ((search (make-algebra-search)))
    (when (catch 'no-form
            (setf (search-conditions search) (algebra-read-conditions facts search))
            (<= (length (search-names search)) 20))
      (loop with starts = (algebra-points-of-last-time search)
            repeat *algebra-walks*
            do (let ((point (algebra-walk (search-conditions search)
                                          (or (pop starts) (algebra-random-point search)) search)))
                 (when point (algebra-keep-point point search))))
      (and (search-points search) search))))

(defun algebra-points-of-last-time (search)
  "Half of the walks may start at points of the facts of last time, which are often much the same."
  (let ((last (cddr *algebra-last-search*)))
    (when last
      (loop for point in (search-points last)
            repeat (floor *algebra-walks* 2)
            collect (map 'simple-vector
                         (lambda (name)
                           (let ((place (position name (search-names last) :test #'eq)))
                             (if place (svref point place) (algebra-search-number search))))
                         (search-names search))))))

(defun algebra-read-conditions (facts search)
  (loop for fact in facts
        collect (multiple-value-bind (e sign) (core-fact-difference fact)
                  (cons (algebra-read-form e search) (algebra-sign-values sign)))))

(defun algebra-random-point (search)
  (coerce (loop repeat (length (search-names search)) collect (algebra-search-number search))
          'simple-vector))

(defparameter *algebra-kept-searches* 1500 "For how many lists of facts searches are kept.")
(defvar *algebra-searches* (make-hash-table :test 'equal) "Searches by lists of facts.")

(defun algebra-search-under (facts)
  "The search for FACTS, nil where it has no points."
  (destructuring-bind (table last . search) *algebra-last-search*
    (if (and (eq table *algebra-searches*) (eq facts last))
        search
        (let ((found (algebra-kept-search facts)))
          (setq *algebra-last-search* (list* *algebra-searches* facts found))
          found))))

(defun algebra-kept-search (facts)
  (let ((key (algebra-key facts)))
    (multiple-value-bind (search known) (gethash key *algebra-searches*)
      (cond (known search)
            (t (when (>= (hash-table-count *algebra-searches*) *algebra-kept-searches*)
                 (clrhash *algebra-searches*))
               (setf (gethash key *algebra-searches*) (algebra-search-of facts)))))))

(defun algebra-seen-signs (e facts)
  "Those of 1, 0, -1 that E was seen to have where FACTS hold."
  (let ((search (algebra-search-under facts)))
    (when (and search (< (algebra-size e) 1000))
      (let ((key (algebra-key e)))
        (multiple-value-bind (signs known) (gethash key (search-seen search))
          (if known
              signs
              (setf (gethash key (search-seen search)) (algebra-signs-at-points e search))))))))

(defun algebra-signs-at-points (e search)
  (let ((form (catch 'no-form (algebra-read-form e search))))
    (when form
      (let ((seen (delete nil (remove-duplicates
                               (loop for point in (search-points search)
                                     collect (algebra-sign-at form (algebra-place point)))))))
        (if (subsetp '(1 -1) seen) seen (algebra-more-signs form seen search))))))

(defun algebra-more-signs (form seen search)
  "SEEN and a sign that a walk from one of the points finds."
  (let ((found (algebra-walk (acons form (set-difference '(1 -1) seen)
                                    (search-conditions search))
                             (copy-seq (algebra-search-choice (search-points search) search))
                             search)))
    (cond (found (algebra-keep-point found search)
                 (adjoin (algebra-sign-at form (algebra-place found)) seen))
          (t seen))))

(defun algebra-both-signs-seen-p (e facts)
  "Whether E is positive here and negative there, so that no sign of it can be proved."
  (and (subsetp '(1 -1) (algebra-seen-signs e facts)) t))

(defun algebra-point-outside-p (facts others)
  "Whether a point was seen at which FACTS hold, and of each of OTHERS, lists of facts, one fails."
  (let* ((search (algebra-search-under facts))
         (others (and search (catch 'no-form
                               (loop for other in others
                                     collect (algebra-read-conditions other search))))))
    (and others
         (some (lambda (point)
                 (let ((place (algebra-place point)))
                   (every (lambda (other)
                            (notevery (lambda (c) (algebra-condition-holds-p c place)) other))
                          others)))
               (search-points search)))))
