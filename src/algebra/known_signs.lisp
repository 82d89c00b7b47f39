;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; What follows from the facts at once: each relation a > b becomes a sign of the numerator of
;;; a - b, factor by factor; a factor whose companions have known signs gets its own; in a sum of
;;; known sign a term that all others work against has that sign too (A > B, B > 0: A > 0).

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/normal" "algebra/points_of_facts" "algebra/sign_by_parts"
                "algebra/sign_by_proof" "algebra/memory"
                "algebra/factoring" "algebra/evaluate" "algebra/noun_values" "algebra/root_kernels"
                "algebra/scan"))

(defparameter *algebra-kept-knowledge* 1500 "For how many lists of facts knowledge is kept.")
(defvar *algebra-knowledges* (make-hash-table :test 'equal) "Knowledge by lists of facts.")

(defvar *algebra-last-knowledge* '(nil . nil)
  "The table in which knowledge was found last, and that knowledge.")

(defun algebra-what-is-known ()
  "What is known here; kept for the next question under the same facts. Most are asked under the
very list of facts of the last one, which may be thousands."
  (let ((facts (core-facts)) (last (cdr *algebra-last-knowledge*)))
    (if (and last
             (eq (car *algebra-last-knowledge*) *algebra-knowledges*)
             (eq facts (knowledge-facts last)))
        last
        (let ((known (algebra-knowledge-of facts)))
          (setf (knowledge-facts known) facts
                *algebra-last-knowledge* (cons *algebra-knowledges* known))
          known))))

(defun algebra-learned-before-p ()
  "Whether what is known here is kept."
  (and (gethash (algebra-key (core-facts)) *algebra-knowledges*) t))

(defun algebra-knowledge-of (facts)
  (let ((key (algebra-key facts)))
    (when (>= (hash-table-count *algebra-knowledges*) *algebra-kept-knowledge*)
      (clrhash *algebra-knowledges*))
    (or (gethash key *algebra-knowledges*)
        (setf (gethash key *algebra-knowledges*) (algebra-learned facts)))))

(defun algebra-name-signs (facts)
  "((name . sign) ..) that follow from FACTS, or :contradiction."
  (let ((knowledge (algebra-learned facts)))
    (if (knowledge-contradiction knowledge)
        :contradiction
        (remove-if-not #'symbolp (knowledge-items knowledge) :key #'car))))

(defun algebra-learned (facts)
  (let* ((knowledge (make-algebra-knowledge :facts facts))
         (*algebra-knowledge* knowledge)
         (products (algebra-fact-products facts)))
    (algebra-learn-all products)
    (when (algebra-learn-names) (algebra-learn-all products))
    (clrhash (knowledge-memo knowledge))
    (when (algebra-products-contradict-p) (setf (knowledge-contradiction knowledge) t))
    (unless (knowledge-contradiction knowledge)
      (setf (knowledge-contradiction knowledge)
            (and (knowledge-sums knowledge) (null (algebra-search-under facts))
                 (algebra-gaps-contradict-p (algebra-gaps knowledge)))))
    knowledge))

(defun algebra-products-contradict-p ()
  "Whether of known products one has another sign than the others give it."
  (let ((all (knowledge-products *algebra-knowledge*)))
    (loop for row in all
          thereis (progn
                    (setf (knowledge-products *algebra-knowledge*) (remove row all :test #'eq))
                    (let ((sign (algebra-sign-by-products (car row))))
                      (setf (knowledge-products *algebra-knowledge*) all)
                      (algebra-opposed-p sign (cdr row)))))))

(defun algebra-learn-all (products)
  "Looks at all PRODUCTS and sums until nothing more comes."
  (loop repeat (+ 2 (length products))
        for before = (algebra-known-count *algebra-knowledge*)
        do (mapc #'algebra-learn-product products)
           (loop for (sum . sign) in (knowledge-sums *algebra-knowledge*)
                 do (algebra-learn-terms sum sign))
        until (equal before (algebra-known-count *algebra-knowledge*))))

(defun algebra-learn-names ()
  "Signs of names that several sums together give; whether there were any."
  (let* ((sums (mapcar #'car (knowledge-sums *algebra-knowledge*)))
         (names (remove-if-not (lambda (name)
                                 (and (< 1 (count-if (lambda (sum) (among name sum)) sums))
                                      (not (member (algebra-known-item name) '($pos $neg)))))
                               (cdr ($listofvars (cons '(mlist) sums)))))
         (gaps (algebra-gaps *algebra-knowledge*)) (found nil))
    (when (and (<= (length sums) 10) (<= (length names) 8))
      (dolist (name names found)
        (let ((sign (if (algebra-both-signs-seen-p
                         name (knowledge-facts *algebra-knowledge*))
                        '$unknown
                        (algebra-certified-sign name gaps))))
          (unless (eq sign '$unknown)
            (setq found t)
            (algebra-learn name sign)))))))

(defun algebra-known-count (knowledge)
  "Changes whenever something is learned."
  (list (mapcar #'cdr (knowledge-items knowledge)) (mapcar #'cdr (knowledge-sums knowledge))
        (mapcar #'cdr (knowledge-products knowledge))))

;;; The sign of a factor of a radicand, asked while a normal form or a zero test is under way

(defun algebra-sign-in-root (e)
  "By what is known of its parts; while the facts are learned, by what came so far."
  (let ((*algebra-knowledge* (or *algebra-knowledge* (algebra-known-apart))))
    (algebra-part-sign e)))

(defun algebra-known-apart ()
  "What is known, its normal forms not those of the zero test, and none of them given up."
  (let ((*algebra-may-give-up* nil) (*algebra-roots-apart* nil)
        (*algebra-exponential-form* nil) (*algebra-every-multiple* nil)
        (*algebra-nouns-apart* nil))
    (algebra-what-is-known)))

(setq *algebra-sign-judge* 'algebra-sign-in-root)

;;; A relation as a product of factors with a sign

(defun algebra-exact (e)
  "E with its floating numbers as the fractions that they print as."
  (cond ((floatp e) (algebra-maxima-rational (rationalize e)))
        ((atom e) e)
        (t (cons (remove 'simp (car e)) (mapcar #'algebra-exact (cdr e))))))

(defun algebra-fact-products (facts)
  "Those of all FACTS, each learned when it is met: with the signs of names roots get shorter. What
a fact of one name alone says is then known; the others are given back, to be looked at again."
  (loop for fact in (stable-sort (copy-list facts) #'< :key #'algebra-size)
        for product = (algebra-fact-product fact)
        do (mapc #'algebra-learn-product product)
        append (remove-if #'algebra-of-one-name-p product)))

(defun algebra-of-one-name-p (product)
  (destructuring-bind (sign (factor . power) . others) product
    (declare (ignore sign))
    (and (symbolp factor) (= power 1) (null others))))

(defun algebra-fact-product (fact)
  "((sign (factor . power) ..)), or nothing where FACT is no formula."
  (multiple-value-bind (e sign) (core-fact-difference fact)
    (let ((factors (if (core-users-name-p e)
                       (list (cons e 1))
                       (algebra-quietly
                        (lambda () (algebra-ratio-factors (simplify (algebra-exact e))))))))
      (and factors (list (cons sign factors))))))

(defun algebra-ratio-factors (e)
  "((factor . power) ..) of E = numerator/denominator; powers below the line are negative."
  (flet ((factors ()
           (destructuring-bind (n d) (cdr ($algebra_ratio e))
             (append (algebra-factor-powers n)
                     (loop for (factor . power) in (algebra-factor-powers d)
                           collect (cons factor (- power)))))))
    (if (algebra-plain-p e) (algebra-kept 'factors e #'factors) (factors))))

(defun algebra-factor-powers (e)
  "((factor . power) ..) of E; what is too long to be factored in seconds is one factor."
  (let ((product (algebra-in-factors e 1000)))
    (loop for factor in (if (mtimesp product) (cdr product) (list product))
          collect (if (and (mexptp factor) (integerp (caddr factor)))
                      (cons (cadr factor) (caddr factor))
                      (cons factor 1)))))

;;; Learning

(defun algebra-learn-product (product)
  "From the sign of a product what is open of its factors."
  (let ((name (car (second product))))
    (if (and (algebra-of-one-name-p product) (null (algebra-entry-of-item name)))
        (algebra-learn name (first product))
        (algebra-learn-factors product))))

(defun algebra-learn-factors (product)
  (destructuring-bind (sign . factors) product
    (when (member sign '($pos $neg $pn))
      (loop for (factor) in factors do (algebra-learn factor '$pn)))
    (let ((open '()) (others '$pos))
      (loop for (factor . power) in factors
            for known = (algebra-part-sign factor)
            do (cond ((evenp power) (when (member sign '($pz $nz $zero))
                                      (unless (member known '($pos $neg $pn))
                                        (setq others '$unknown))))
                     ((member known '($pos $neg))
                      (setq others (algebra-times-sign others known)))
                     (t (push factor open))))
      (cond ((not (member others '($pos $neg))))
            ((null open) (algebra-agree others sign))
            (t (let ((rest (if (cdr open) (algebra-open-product open) (car open))))
                 (when (cdr open)
                   (algebra-note-product open (algebra-times-sign others sign)))
                 (when rest (algebra-learn rest (algebra-times-sign others sign)))))))))

(defun algebra-note-product (factors sign)
  (let ((entry (assoc factors (knowledge-products *algebra-knowledge*)
                      :test #'algebra-same-factors-p)))
    (if entry
        (setf (cdr entry) (algebra-agree (cdr entry) sign))
        (push (cons factors sign) (knowledge-products *algebra-knowledge*)))))

(defun algebra-open-product (factors)
  "The expanded product of FACTORS, or nil, nothing to learn, where it would be long."
  (when (< (reduce #'* factors :key #'algebra-size) 2000)
    (algebra-kept 'product factors (lambda () ($expand (muln factors nil))))))

(defun algebra-learn (e sign)
  "E, a name, a kernel or a sum, has SIGN."
  (cond (($constantp e) (algebra-agree (algebra-constant-sign e) sign))
        ((mtimesp e))
        ((mplusp e) (algebra-learn-sum e sign))
        (t (algebra-learn-item e sign))))

(defun algebra-agree (known sign)
  "The sign of which both hold; notes where none does."
  (when (algebra-opposed-p known sign)
    (setf (knowledge-contradiction *algebra-knowledge*) t))
  (algebra-both-signs known sign))

(defun algebra-opposed-p (a b)
  (and (not (eq a '$unknown)) (not (eq b '$unknown))
       (null (intersection (algebra-sign-values a) (algebra-sign-values b)))))

(defun algebra-learn-item (item sign)
  (let ((entry (algebra-entry-of-item item)))
    (if entry
        (setf (cdr entry) (algebra-agree (cdr entry) sign))
        (let ((learned (cons item (algebra-agree (algebra-part-sign item) sign))))
          (push learned (knowledge-items *algebra-knowledge*))
          (when (symbolp item)
            (setf (gethash item (knowledge-names *algebra-knowledge*)) learned))))))

(defun algebra-learn-sum (sum sign)
  (destructuring-bind (plain . turned) (algebra-kept 'sides sum (lambda () (algebra-sides sum)))
    (let ((entry (algebra-entry-of-sum plain)))
      (cond (entry (setf (cdr entry) (algebra-agree (cdr entry) sign)))
            ((setq entry (algebra-entry-of-sum turned))
             (setf (cdr entry) (algebra-agree (cdr entry) (algebra-opposite-sign sign))))
            (t (algebra-note-sum plain turned
                                 (algebra-agree (algebra-simple-sign plain) sign)))))))

(defun algebra-sides (sum)
  "(SUM . -SUM), expanded."
  (let ((plain ($expand sum)))
    (cons plain ($expand (mul -1 plain)))))

(defun algebra-learn-terms (sum sign)
  "In a SUM of known sign a term that all the others work against."
  (let ((target (case sign (($pos $pz) '$pz) (($neg $nz) '$nz))))
    (when (and target (mplusp sum))
      (dolist (term (cdr sum))
        (let ((others (algebra-common-sign (remove term (cdr sum) :test #'eq)
                                           #'algebra-part-sign)))
          (when (algebra-works-against-p others target)
            (algebra-learn-term term (if (or (member others '($pos $neg))
                                             (member sign '($pos $neg)))
                                         (if (eq target '$pz) '$pos '$neg)
                                         target))))))))

(defun algebra-works-against-p (others target)
  (member others (if (eq target '$pz) '($neg $nz $zero) '($pos $pz $zero))))

(defun algebra-learn-term (term sign)
  "Of TERM = number * a * b .. with SIGN the one factor whose sign is open."
  (algebra-learn-product
   (cons sign (loop for factor in (if (mtimesp term) (cdr term) (list term))
                    collect (if (and (mexptp factor) (integerp (caddr factor)))
                                (cons (cadr factor) (caddr factor))
                                (cons factor 1))))))

;;; What is known, as gaps for a proof

(defun algebra-gaps (knowledge)
  "((e . sign) ..) of names, kernels and sums."
  (append (knowledge-items knowledge) (knowledge-sums knowledge)))
