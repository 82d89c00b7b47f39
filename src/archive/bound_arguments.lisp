;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What the session assumes has been put to use before a call: with s > 0 Maxima takes the argument
;;; 'integrate(max(s, 0), s, 0, x) for 'integrate(s, s, 0, x). Where it is not known that what is
;;; assumed of a bound name holds wherever the name goes, as between 0 and 1, the call is refused;
;;; so it is where a bound name is declared an integer: cos(2*%pi*n) has become 1. Of s = 2 only a
;;; warning is given. See archive-check-bound first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/bound_names" "core/facts"))

(defun archive-check-bound (arguments)
  "An error where ARGUMENTS bind a name of which the session assumes what may not hold there."
  (let ((facts (and (not *core-guarded*)
                    (append (core-session-facts) (core-session-declarations)))))
    (when facts
      (dolist (argument arguments)
        (archive-check-bound-in argument facts nil)))))

(defun archive-check-bound-in (e facts laws)
  "LAWS: equations f(s) = .. in E are laws."
  (when (and (consp e) (consp (car e)))
    (when laws
      (dolist (name (core-law-arguments e))
        (archive-refuse-bound name e (archive-fact-on name facts))))
    (when (member 'simp (car e))
      (dolist (name (core-bound-names e))
        (archive-refuse-bound name e (archive-fact-broken name e facts))))
    (let ((laws (or laws (and (mequalp e) (eq (cadr e) '$laws)))))
      (dolist (part (cdr e)) (archive-check-bound-in part facts laws)))))

(defun archive-refuse-bound (name noun fact)
  "An error, whether NAME still stands in NOUN or not: abs(s)/s became 1."
  (when (and fact (not (archive-open-jet-p (cadr noun))))
    (let ((names (core-words (list name)))
          (bound (core-cut (core-words (list noun))))
          (known (core-words (list fact))))
      (cond ((eq (caar fact) '$kind)
             (core-error "~a is bound in ~a, and is declared ~a in the session, which Maxima may ~
                          have used in it before the call; give it another name there, or ~
                          remove(~a, ~a), and type it again"
                         names bound (core-words (cddr fact)) names (core-words (cddr fact))))
            ((archive-equality-p fact)
             (core-warn "~a is bound in ~a, and if abs(~a), max(~a, 1) or the like was typed in ~
                         it, Maxima has used ~a, which the session assumes; give it another name ~
                         there, or forget(~a), and type it again"
                        names bound names names known known))
            (t (core-error "~a is bound in ~a, and Maxima may have used ~a, which the session ~
                            assumes, in it before the call; give it another name there, or ~
                            forget(~a), and type it again" names bound known known))))))

(defun archive-equality-p (fact)
  (and (member (caar fact) '($equal mequal)) t))

(defun archive-open-jet-p (e)
  "Whether E is a derivative of q or f(x, y), in which there is nothing to simplify."
  (and (consp e)
       (eq (caar e) '%derivative)
       (or (symbolp (cadr e))
           (and (core-name-p (caar (cadr e))) (every #'symbolp (cdr (cadr e)))))))

(defun archive-fact-on (name facts)
  (archive-worst (remove-if-not (lambda (fact) (core-occurs-p name fact)) facts)))

(defun archive-worst (facts)
  "The first of FACTS, no equality where there is another."
  (or (find-if-not #'archive-equality-p facts) (car facts)))

;;; Where a name goes

(defun archive-fact-broken (name noun facts)
  "One of FACTS on NAME that is not known to hold wherever NOUN binds it."
  (archive-worst (remove-if (lambda (fact)
                              (or (not (core-occurs-p name fact))
                                  (archive-fact-kept-p fact name noun facts)))
                            facts)))

(defun archive-fact-kept-p (fact name noun facts)
  "Whether FACT is known to hold where NOUN binds NAME, single points of an integral left out."
  (if (eq (caar fact) '$kind)
      (and (eq (caddr fact) '$integer)
           (member (caar noun) '(%sum %product))
           (integerp (cadddr noun)))
      (or (and (eq (caar noun) '%integrate) (archive-almost-always-p fact name))
          (let ((ends (archive-ends-of noun name)))
            (and ends
                 (every (lambda (end) (archive-fact-holds-p fact name end facts)) ends))))))

(defun archive-almost-always-p (fact name)
  "Whether FACT, linear in NAME, excludes single values."
  (multiple-value-bind (e sign) (core-fact-difference fact)
    (and (eq sign '$pn)
         (let ((slope (archive-slope e name)))
           (and (mnump slope) (not (zerop1 slope)))))))

(defun archive-slope (e name)
  "de/dNAME; Maxima's diff by a name that is assumed to be 2 is an error."
  (let ((own (gensym "$S")))
    (sdiff (maxima-substitute own name e) own)))

(defun archive-ends-of (noun name)
  "Values of NAME between which all lie that it takes in NOUN, where these are known."
  (case (caar noun)
    ((%integrate %sum %product) (cdddr noun))
    (%at (loop for (nil old new) in (core-equations-of-point (caddr noun))
               when (eq old name) collect new))))

(defun archive-fact-holds-p (fact name end facts)
  "Whether FACT, linear in NAME, is known to hold, or nearly so, where NAME is END."
  (multiple-value-bind (e sign) (core-fact-difference fact)
    (let ((slope (archive-slope e name)))
      (cond ((eq sign '$zero) (and (not (member end '($inf $minf)))
                                   (zerop1 (maxima-substitute end name e))))
            ((not (and (member sign '($pos $pz)) (mnump slope))) nil)
            ((eq end '$inf) (not (mnegp slope)))
            ((eq end '$minf) (mnegp slope))
            (t (archive-never-negative-p (maxima-substitute end name e) facts))))))

(defun archive-never-negative-p (e facts)
  (if (mnump e)
      (not (mnegp e))
      (eq (core-judged (cons (list '(mlessp simp) e 0) facts)) :contradiction)))
