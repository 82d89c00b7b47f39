;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Facts: what is known of names while we compute. They are data of our own, bound for a call:
;;; the relations of the archive's parameters and what the session assumes in its context, in
;;; those that this one includes and in the active ones. Maxima's data base holds meanwhile only
;;; what follows for the sign of single names: more of it makes its `sign' wrong on sums.

(in-package :maxima)

(defvar *core-facts* :session
  "The relations that hold, a list; :session outside of a call: whatever is assumed there.")
(defvar *core-answers* nil
  "What is kept until a public call ends: a table, nil outside of one.")
(defvar *core-fact-judge* nil
  "Part and function that find the signs of single names from relations.")

(defun core-fact-judge (part function)
  "States what finds (name . sign), .. from a list of relations, or :contradiction."
  (setq *core-fact-judge* (cons part function)))

(defvar *core-divisor-judge* nil
  "Part and function that refuse a divisor that is assumed to be 0.")

(defun core-divisor-judge (part function)
  "States what looks at divisors where an equality is assumed."
  (setq *core-divisor-judge* (cons part function)))

(defvar *core-root-judge* nil
  "Part and function that refuse a root that a polynomial does not have.")

(defun core-root-judge (part function)
  "States what looks at RealRoot(polynomial, k) in an archive."
  (setq *core-root-judge* (cons part function)))

(defun core-judge-root (polynomial k)
  "An error where POLYNOMIAL, whole numbers, has no K-th real root."
  (when *core-root-judge*
    (core-require (car *core-root-judge*))
    (funcall (cdr *core-root-judge*) polynomial k)))

(defun core-facts ()
  "The relations that hold here."
  (if (eq *core-facts* :session) (core-session-facts) *core-facts*))

(defun core-judged (facts)
  "The signs ((name . sign) ..) of single names that follow from FACTS, or :contradiction."
  (when facts
    (core-require (car *core-fact-judge*))
    (funcall (cdr *core-fact-judge*) facts)))

(defun core-zeros ()
  "The expressions that are assumed to be 0."
  (loop for fact in (core-facts)
        append (multiple-value-bind (e sign) (core-fact-difference fact)
                 (and (eq sign '$zero) (list e)))))

(defun core-judge-divisors (e)
  "An error where in E, which a derivation takes or gives, a divisor is assumed to be 0."
  (when (core-zeros)
    (core-require (car *core-divisor-judge*))
    (funcall (cdr *core-divisor-judge*) e)))

(defun core-relation-p (fact)
  "Whether FACT, as Maxima's data base gives it, compares two expressions."
  (case (caar fact)
    ((mgreaterp mgeqp $equal) t)
    (mnot (eq (caar (cadr fact)) '$equal))))

(defun core-fact-difference (fact)
  "Two values: the expression of which FACT tells the sign, and that sign."
  (destructuring-bind (a &optional (b 0)) (cdr fact)
    (ecase (caar fact)
      (mgreaterp (values (sub a b) '$pos))
      (mgeqp (values (sub a b) '$pz))
      (mlessp (values (sub b a) '$pos))
      (mleqp (values (sub b a) '$pz))
      ((mequal $equal) (values (sub a b) '$zero))
      ((mnotequal $notequal) (values (sub a b) '$pn))
      (mnot (values (sub (cadr a) (caddr a)) '$pn)))))

;;; Facts of a case

(defun core-plain-relations (conditions)
  "Those of CONDITIONS that are relations, `and' taken apart, without the lines they came from."
  (loop for condition in conditions
        when (and (consp condition) (consp (car condition)))
          append (case (caar condition)
                   ((mgreaterp mgeqp mlessp mleqp $equal mequal $notequal mnotequal)
                    (list (cons (list (caar condition) 'simp) (cdr condition))))
                   (mnot (and (core-relation-p condition) (list condition)))
                   (mand (core-plain-relations (cdr condition))))))

(defmspec $core_given (form)
  ;; core_given(conditions, e): the value of e where the conditions hold too.
  (let* ((conditions (meval (second form)))
         (*core-facts* (append (core-plain-relations (cdr conditions)) (core-facts))))
    (meval (third form))))

;;; What the session assumes

(defun core-visible-contexts ()
  "The current context, the active ones, and those that they include. (Maxima 5.47 has what is no
context in its list of active ones.)"
  (let ((seen '()))
    (labels ((visit (place)
               (unless (member place seen)
                 (push place seen)
                 (mapc #'visit (zl-get place 'subc)))))
      (mapc #'visit (cons $context (remove-if-not #'symbolp (cdr $activecontexts)))))
    (nreverse seen)))

(defun core-users-name-p (e)
  "Whether E is a name that means nothing to Maxima itself, as inf and beta do."
  (and (symbolp e)
       (let ((name (symbol-name e)))
         (and (char= (char name 0) #\$)
              (char/= (char name (min 1 (1- (length name)))) #\%)))
       (not (get e 'sysconst))
       (not (get e 'operators))))

(defun core-users-fact-p (fact)
  "Whether FACT is one that the user stated: Maxima's own are about constants and functions; what
is declared of a name, constant, real, is a name of Maxima's."
  (labels ((own (e) (cond ((symbolp e) (core-users-name-p e))
                          ((consp e) (or (and (consp (car e)) (own (caar e)))
                                         (some #'own (cdr e)))))))
    (if (eq (caar fact) '$kind) (own (cadr fact)) (some #'own (cdr fact)))))

(defun core-session-facts ()
  "The relations that the session assumes."
  (loop for place in (core-visible-contexts)
        append (remove-if-not (lambda (fact)
                                (and (core-relation-p fact) (core-users-fact-p fact)
                                     (not (core-rounded-p fact))))
                              (cdr (facts1 place)))))

(defparameter *core-telling-kinds*
  '($integer $even $odd $noninteger $rational $irrational $constant $imaginary)
  "Declarations that hold of some numbers only.")

(defun core-session-declarations ()
  "What the session declares of names that changes formulas: kind(n, integer), .."
  (loop for place in (core-visible-contexts)
        append (remove-if-not (lambda (fact)
                                (and (eq (caar fact) '$kind)
                                     (core-users-name-p (cadr fact))
                                     (member (caddr fact) *core-telling-kinds*)))
                              (cdr (facts1 place)))))

(defun core-rounded-p (e)
  "Whether E holds a decimal of more than 15 digits: beside a < %pi/2 Maxima notes a < 1.57079632..,
which is more than was said."
  (cond ((floatp e)
         (let ((digits (string-left-trim "0" (remove-if-not #'digit-char-p
                                                            (core-mantissa-text e)))))
           (> (length digits) 15)))
        ((consp e) (some #'core-rounded-p (cdr e)))))

(defun core-mantissa-text (x)
  (let* ((text (let ((*read-default-float-format* 'double-float)) (prin1-to-string x)))
         (end (position-if #'alpha-char-p text)))
    (subseq text 0 end)))

;;; Maxima's data base while we compute

(defun core-learn-signs (signs)
  "Tells Maxima the SIGNS of single names."
  (loop for (item . sign) in signs
        for relation = (case sign
                         ($pos (list '(mgreaterp) item 0)) ($neg (list '(mgreaterp) 0 item))
                         ($pz (list '(mgeqp) item 0)) ($nz (list '(mgeqp) 0 item))
                         ($pn (list '($notequal) item 0)))
        do (when (and relation (symbolp item)) (learn relation t))))

(defun core-change-global (facts flag)
  "Puts FACTS into Maxima's global context, or takes them out where FLAG is nil."
  (when facts
    (let ((context '$global) ($context '$global))
      (dolist (fact facts)
        (cond ((not (eq (caar fact) '$kind)) (learn fact flag))
              (flag (kind (cadr fact) (caddr fact)))
              (t (unkind (cadr fact) (caddr fact)))))))
  (contextmark))

(defun core-context-marks ()
  "((context . mark) ..) of the visible contexts: how often each is seen."
  (contextmark)
  (mapcar (lambda (place) (cons place (zl-get place 'cmark))) (core-visible-contexts)))

(defun core-enter-context (place marks)
  "PLACE becomes the current context, above the global one, and the only visible one."
  (loop for (other) in marks do (putprop other 0 'cmark))
  (setq $context place context place current place)
  (cmark place))

(defun core-leave-context (place users marks)
  "The USERS context is the current one again, the others are as visible as MARKS say."
  (mapc #'remov (zl-get place 'data))
  (dolist (key '(data cmark subc)) (zl-remprop place key))
  (setq $context users context users current users)
  (loop for (other . mark) in marks do (putprop other mark 'cmark)))

(defun core-call-in-context (place function)
  "Calls FUNCTION in the empty context PLACE, no other one being active."
  (let ((users $context) (marks (core-context-marks)))
    (putprop place '($global) 'subc)
    (unwind-protect
         (let (($contexts (list* (car $contexts) place (cdr $contexts)))
               ($activecontexts (list '(mlist))))
           (core-enter-context place marks)
           (funcall function))
      (core-leave-context place users marks))))

(defun core-without-session-facts (function)
  "Calls FUNCTION while Maxima's data base knows nothing that the user told it."
  (let ((globals (remove-if-not #'core-users-fact-p (cdr (facts1 '$global)))))
    (unwind-protect
         (progn (core-change-global globals nil)
                (core-call-in-context (gensym "$CONTEXT") function))
      (core-change-global (reverse globals) t))))

(defun core-contradicted (facts session)
  "The first of the archive's FACTS that contradicts what the SESSION assumes, or nil."
  (when (and facts session (eq (core-judged (append facts session)) :contradiction))
    (or (find-if (lambda (fact) (eq (core-judged (cons fact session)) :contradiction)) facts)
        (car facts))))

(defun core-usable-facts (facts)
  "FACTS, the archive's, with those of the session unless these contradict them."
  (let* ((session (core-session-facts))
         (contradicted (core-contradicted facts session)))
    (when (eq (core-judged facts) :contradiction)
      (core-error "what is assumed of the parameters contradicts itself: ~{~a~^, ~}"
                  (mapcar (lambda (fact) (core-words (list fact))) facts)))
    (when contradicted
      (core-warn "the archive says ~a; what you assumed in the session contradicts it and ~
                  is not used here"
                 (core-words (list contradicted))))
    (if contradicted facts (append facts session))))

(defun core-with-facts (facts function)
  "Calls FUNCTION while FACTS and the session's facts hold, and only their signs of single names
stand in Maxima's data base."
  (let* ((*core-facts* (core-usable-facts facts))
         (signs (core-judged *core-facts*))
         (*core-answers* (make-hash-table :test 'equal)))
    (core-without-session-facts
     (lambda ()
       (if (eq signs :contradiction)
           (core-error "what is assumed contradicts itself: ~a"
                       (core-words (list (cons '(mlist) *core-facts*))))
           (core-learn-signs signs))
       (funcall function)))))
