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
  (core-require "algebra/size" "algebra/random_numbers" "algebra/sign_by_parts"))

(defstruct (algebra-search (:conc-name search-) (:predicate nil) (:copier nil))
  (names '())       ; in the order of the coordinates
  (conditions '())  ; ((form sign ..) ..), the signs that are allowed: 1, 0, -1
  (points '())      ; vectors of rational numbers at which all conditions hold
  (state 20011))    ; of the random numbers

;;; Forms: a rational number, (at place), (+ form ..), (* form ..), (^ form power)

(defun algebra-read-form (e search)
  "E as a form; throws nil to no-form where it is no rational function of names."
  (let ((number (algebra-rational-number e)))
    (flet ((forms () (loop for part in (cdr e) collect (algebra-read-form part search))))
      (cond (number)
            ((core-users-name-p e) (list 'at (algebra-search-place e search)))
            ((floatp e) (rationalize e))
            ((atom e) (throw 'no-form nil))
            ((mplusp e) (cons '+ (forms)))
            ((mtimesp e) (cons '* (forms)))
            ((and (mexptp e) (typep (caddr e) '(integer -20 20)))
             (list '^ (algebra-read-form (cadr e) search) (caddr e)))
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

(defun algebra-sign-at (form point)
  "1, 0, -1, or nil where FORM has no value."
  (let ((value (catch 'no-value (algebra-number-at form point))))
    (and value (signum value))))

(defun algebra-coordinates-in (form)
  (cond ((atom form) '())
        ((eq (car form) 'at) (copy-list (cdr form)))
        (t (mapcan #'algebra-coordinates-in (cdr form)))))

(defun algebra-condition-holds-p (condition point)
  (member (algebra-sign-at (car condition) point) (cdr condition)))

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
             (catch 'no-value (algebra-number-at form other)))))
    (let ((start (at 0)) (end (at 1)) (number (algebra-search-number search)))
      (cond ((or (null start) (null end) (= start end)) number)
            ((zerop (algebra-search-below 3 search)) (/ start (- start end)))
            (t (+ (/ start (- start end)) number))))))

(defun algebra-walk (conditions point search)
  "A point near POINT at which all CONDITIONS hold, or nil; POINT is changed."
  (labels ((failing () (remove-if (lambda (c) (algebra-condition-holds-p c point)) conditions)))
    (let ((open (failing)))
      (loop repeat *algebra-walk-steps* while open
            do (let* ((form (car (algebra-search-choice open search)))
                      (place (algebra-search-choice (algebra-coordinates-in form) search))
                      (value (and place (algebra-new-value form place point search))))
                 (when (and value (< (integer-length (numerator value)) 20)
                            (< (integer-length (denominator value)) 20))
                   (let ((before (svref point place)) (now nil))
                     (setf (svref point place) value
                           now (failing))
                     (if (or (<= (length now) (length open))
                             (zerop (algebra-search-below 12 search)))
                         (setq open now)
                         (setf (svref point place) before))))))
      (and (null open) point))))

;;; The points of facts

(defun algebra-keep-point (point search)
  (let ((others (search-points search)))
    (setf (search-points search)
          (cons point (subseq others 0 (min (length others) (1- *algebra-kept-points*)))))))

(defun algebra-search-of (facts)
  "A search with points at which FACTS hold, or nil."
  (let ((search (make-algebra-search)))
    (when (catch 'no-form
            (setf (search-conditions search)
                  (loop for fact in facts
                        collect (multiple-value-bind (e sign) (core-fact-difference fact)
                                  (cons (algebra-read-form e search)
                                        (algebra-sign-values sign)))))
            (<= (length (search-names search)) 20))
      (loop repeat *algebra-walks*
            do (let ((point (algebra-walk (search-conditions search)
                                          (algebra-random-point search) search)))
                 (when point (algebra-keep-point point search))))
      (and (search-points search) search))))

(defun algebra-random-point (search)
  (coerce (loop repeat (length (search-names search)) collect (algebra-search-number search))
          'simple-vector))

(defparameter *algebra-kept-searches* 500 "For how many lists of facts searches are kept.")
(defvar *algebra-searches* (make-hash-table :test 'equal) "Searches by lists of facts.")

(defun algebra-search-under (facts)
  "The search for FACTS, nil where it has no points."
  (multiple-value-bind (search known) (gethash facts *algebra-searches*)
    (cond (known search)
          (t (when (>= (hash-table-count *algebra-searches*) *algebra-kept-searches*)
               (clrhash *algebra-searches*))
             (setf (gethash facts *algebra-searches*) (algebra-search-of facts))))))

(defun algebra-seen-signs (e facts)
  "Those of 1, 0, -1 that E was seen to have where FACTS hold."
  (let* ((search (algebra-search-under facts))
         (form (and search (< (algebra-size e) 1000)
                    (catch 'no-form (algebra-read-form e search)))))
    (when form
      (let ((seen (delete nil (remove-duplicates
                               (loop for point in (search-points search)
                                     collect (algebra-sign-at form point))))))
        (if (subsetp '(1 -1) seen) seen (algebra-more-signs form seen search))))))

(defun algebra-more-signs (form seen search)
  "SEEN and a sign that a walk from one of the points finds."
  (let ((found (algebra-walk (acons form (set-difference '(1 -1) seen)
                                    (search-conditions search))
                             (copy-seq (algebra-search-choice (search-points search) search))
                             search)))
    (cond (found (algebra-keep-point found search)
                 (adjoin (algebra-sign-at form found) seen))
          (t seen))))

(defun algebra-both-signs-seen-p (e facts)
  "Whether E is positive here and negative there, so that no sign of it can be proved."
  (and (subsetp '(1 -1) (algebra-seen-signs e facts)) t))
