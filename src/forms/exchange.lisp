;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Finding the time derivatives 'diff(q,t,n) in an expression, and exchanging them, all at once,
;;; for other expressions. subst() goes through the expression once for each of them and breaks
;;; 'diff(q,t) when it puts in a value for q.

(in-package :maxima)

(defun forms-derivative-p (e)
  "True for 'diff(q,t,n) where q is a name, possibly with a subscript."
  (and (consp e) (eq (caar e) '%derivative)
       (= (length e) 4) (eq (third e) '$t) (integerp (fourth e))
       (or (symbolp (second e)) (member 'array (car (second e))))))

(defun forms-collect-derivatives (e found)
  (cond ((atom e) found)
        ((forms-derivative-p e) (if (member e found :test #'alike1) found (cons e found)))
        (t (dolist (part (cdr e) found)
             (setq found (forms-collect-derivatives part found))))))

(defun $forms_derivatives (e)
  "The list of all 'diff(q,t,n) in E, in the order in which they occur."
  (cons '(mlist simp) (nreverse (forms-collect-derivatives e '()))))

(defun forms-exchange (e find)
  "E with FIND's answer for every part; FIND returns the part itself where it knows nothing."
  (let ((other (funcall find e)))
    (cond ((not (eq other e)) other)
          ((or (atom e) (forms-derivative-p e)) e)
          (t (forms-exchange-parts e find)))))

(defun forms-exchange-parts (e find)
  (let* ((parts (mapcar (lambda (part) (forms-exchange part find)) (cdr e))))
    (if (every #'eq parts (cdr e))
        e
        (simplifya (cons (remove 'simp (car e)) parts) nil))))

(defun $forms_exchange (e pairs)
  "E with the right sides of PAIRS in place of their left sides (names and 'diff(q,t,n))."
  (let ((names (make-hash-table :test #'eq)) (others '()))
    (dolist (pair (cdr pairs))
      (if (symbolp (second pair))
          (setf (gethash (second pair) names) (third pair))
          (push (cons (second pair) (third pair)) others)))
    (forms-exchange e (lambda (part)
                        (cond ((symbolp part) (values (gethash part names part)))
                              ((and others (consp part)) (forms-exchanged part others))
                              (t part))))))

(defun forms-exchanged (part pairs)
  (let ((pair (assoc part pairs :test #'alike1)))
    (if pair (cdr pair) part)))
