;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The one judge of signs. algebra_sign(e): what the facts prove, else unknown; no question is
;;; asked and Maxima's `sign' has no voice. After the sign of e as it stands: of numerator and
;;; denominator factor by factor, each by the facts, by its real roots, by a discriminant, by the
;;; squares of a root and of what stands beside it, by bounds put in, and by a proof as a sum of
;;; products of facts.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/size" "algebra/memory" "algebra/nouns" "algebra/zero" "algebra/known_signs"
                "algebra/points_of_facts" "algebra/sign_by_proof"
                "algebra/sign_by_bounds" "algebra/packed_polynomials" "algebra/sign_by_parts"))

(defvar *algebra-discriminants-left* 2 "How deep discriminants of discriminants may be asked.")

(defun $algebra_sign (e)
  "pos, neg, zero, pz (>= 0), nz (<= 0), pn (not zero) or unknown."
  (let ((*algebra-knowledge* (algebra-what-is-known)))
    (algebra-sign e)))

(defun $algebra_positive (e)
  "true, false or unknown"
  (case (algebra-sign-among e '($pos $neg $zero $nz))
    ($pos t)
    ((nil) '$unknown)
    (t nil)))

(defun $algebra_sign_among (e signs)
  "Whether the sign of E is proved to be one of SIGNS."
  (and (algebra-sign-among e (cdr signs)) t))

(defun algebra-sign-among (e signs)
  "The sign of E where it is proved to be one of SIGNS, else nil; where points show another no proof
is sought, nor is anything learned of facts that are new."
  (when (or (algebra-constant-p e) (algebra-learned-before-p) (algebra-seen-among-p e signs))
    (let* ((*algebra-knowledge* (algebra-what-is-known))
           (sign (or (algebra-sign-at-sight e)
                     (if (algebra-seen-among-p e signs) (algebra-sign e) '$unknown))))
      (car (member sign signs)))))

(defun algebra-sign-at-sight (e)
  "pos, neg or zero, where it costs no more than a look at E, or was found before."
  (if (algebra-constant-p e)
      (algebra-exact-sign (algebra-constant-sign e))
      (kept-exact (algebra-signs-of e))))

(defun algebra-seen-among-p (e signs)
  "Whether one of SIGNS agrees with all that E was seen to have where the facts hold."
  (let ((seen (algebra-seen-signs e (core-facts))))
    (some (lambda (sign) (subsetp seen (algebra-sign-values sign))) signs)))

(defun $algebra_nonzero (e)
  "Whether E cannot vanish under the facts: true; false where it vanishes identically; or unknown."
  (case ($algebra_sign e)
    (($pos $neg $pn) t)
    ($zero nil)
    (t '$unknown)))

(defvar *algebra-short-knowledges* (make-hash-table :test 'equal)
  "Knowledge by lists of facts, where proofs stay short.")

(defmspec $algebra_by_short_proofs (form)
  ;; algebra_by_short_proofs(e): the value of e, where proofs as sums of products stay short; what
  ;; has no such one is unknown. What is found so is kept for questions of this sort alone.
  (let ((*algebra-certificate-size* 200)
        (*algebra-knowledges* *algebra-short-knowledges*)
        (*algebra-discriminants-left* 1))
    (meval (second form))))

(defun $algebra_contradictory (conditions)
  "Whether CONDITIONS, a list, are proved to contradict the facts or each other."
  (let* ((relations (core-plain-relations (cdr conditions)))
         (*core-facts* (append relations (core-facts))))
    (and (null (algebra-search-under *core-facts*))
         (or (knowledge-contradiction (algebra-what-is-known))
             (some (lambda (relation)
                     (algebra-refuted-p relation (remove relation *core-facts*)))
                   relations))
         t)))

(defun algebra-refuted-p (relation facts)
  "Whether RELATION is proved to fail where FACTS hold."
  (multiple-value-bind (e sign) (core-fact-difference relation)
    (let ((*core-facts* facts))
      (algebra-opposed-p sign ($algebra_sign e)))))

(defun algebra-sign (e)
  (if (algebra-constant-p e)
      (algebra-constant-sign e)
      (let ((signs (algebra-signs-of e)))
        (or (kept-exact signs)
            (cdr (assoc *algebra-discriminants-left* (kept-open signs)))
            (algebra-new-sign e signs)))))

(defstruct (algebra-signs (:conc-name kept-) (:predicate nil) (:copier nil))
  "What is kept of the sign of an expression under the same facts."
  (plain nil) ; as it stands
  (exact nil) ; pos, neg or zero, where that is proved
  (open '())) ; else what was found, by how deep it was sought

(defun algebra-signs-of (e)
  "What is kept of the sign of E, its plain sign at least."
  (let ((memo (knowledge-memo *algebra-knowledge*)) (key (algebra-key e)))
    (or (gethash key memo)
        (let ((plain (algebra-simple-sign e)))
          (setf (gethash key memo)
                (make-algebra-signs :plain plain :exact (algebra-exact-sign plain)))))))

(defun algebra-exact-sign (sign)
  (car (member sign '($pos $neg $zero))))

(defun algebra-new-sign (e signs)
  "What is not decided is kept for questions of the same depth alone."
  (let ((sign (algebra-both-signs (kept-plain signs) (algebra-quotient-sign e))))
    (if (algebra-exact-sign sign)
        (setf (kept-exact signs) sign)
        (push (cons *algebra-discriminants-left* sign) (kept-open signs)))
    sign))

(defun algebra-quotient-sign (e)
  "By numerator and denominator in normal form."
  (let* ((factors (algebra-ratio-factors e))
         (sign (algebra-factors-sign factors)))
    (if (and (not (member sign '($pos $neg $zero))) (eq t (algebra-zero-test e)))
        '$zero
        sign)))

(defun algebra-factors-sign (factors)
  "Of ((factor . power) ..); factors of open sign by themselves and all together."
  (let ((known '$pos) (half '$pos) (open '()) (odd '()) (squares '$pos))
    (loop for (factor . power) in factors
          for sign = (algebra-odd-root-sign (if ($constantp factor)
                                                (algebra-constant-sign factor)
                                                (algebra-factor-sign factor))
                                            power factor)
          do (cond ((member sign '($pos $neg $zero))
                    (setq known (algebra-times-sign known sign)))
                   (t (setq half (algebra-times-sign half sign))
                      (push (if (oddp power) factor (power factor 2)) open)
                      (if (oddp power)
                          (push factor odd)
                          (setq squares (algebra-times-sign squares sign))))))
    (algebra-times-sign known
                        (algebra-both-signs
                         (if odd
                             (algebra-times-sign squares (algebra-sign-by-products odd))
                             '$unknown)
                         (if (cdr open)
                             (algebra-both-signs half (algebra-together-sign open))
                             half)))))

(defun algebra-together-sign (factors)
  (let ((product (algebra-open-product factors)))
    (if (mplusp product) (algebra-factor-sign product) '$unknown)))

(defun algebra-factor-sign (factor)
  "The sign of a FACTOR that does not come apart; the dearer the method, the shorter what it takes."
  (let ((size (algebra-size factor)))
    (if (and (mplusp factor) (< size 1000))
        (let* ((e ($expand factor)) (plain (algebra-simple-sign e)))
          (if (or (algebra-exact-sign plain)
                  (algebra-both-signs-seen-p factor (knowledge-facts *algebra-knowledge*)))
              plain
              (algebra-first-answer (list* #'algebra-root-free-sign #'algebra-sign-by-one-fact
                                           #'algebra-shifted-sign
                                           (and (< size 250)
                                                (list #'algebra-discriminant-sign
                                                      #'algebra-root-balance-sign
                                                      #'algebra-proved-sign)))
                                    e plain)))
        (algebra-simple-sign factor))))

(defun algebra-first-answer (methods e answer)
  "The first exact sign, else the strongest half answer, ANSWER being one."
  (dolist (method methods answer)
    (setq answer (algebra-both-signs answer (funcall method e)))
    (when (algebra-exact-sign answer) (return answer))))

;;; A square and what it lacks

(defun algebra-discriminant-sign (e)
  "Of a*y^2 + b*y + c with b^2 - 4*a*c < 0 or <= 0, y a power of a name or kernel."
  (let ((*algebra-discriminants-left* (1- *algebra-discriminants-left*)))
    (if (minusp *algebra-discriminants-left*)
        '$unknown
        (loop for x in (algebra-kernels-of (list e))
              for sign = (algebra-discriminant-sign-in e x)
              unless (eq sign '$unknown) return sign
              finally (return '$unknown)))))

(defun algebra-discriminant-sign-in (e x)
  (let* ((powers (and (not ($constantp x)) (algebra-real-p x) (algebra-powers-in e x)))
         (half (/ (1- (length powers)) 2)))
    (if (and (integerp half) (plusp half)
             (loop for c in powers for k from 0
                   always (or (zerop (mod k half)) (eql c 0))))
        (destructuring-bind (c b a) (loop for k from 0 to 2 collect (nth (* k half) powers))
          (let ((leading (algebra-sign a)))
            (if (and (member leading '($pos $neg)) (algebra-real-p b) (algebra-real-p c))
                (case (algebra-sign ($expand (sub (power b 2) (mul 4 a c))))
                  ($neg leading)
                  (($nz $zero) (if (eq leading '$pos) '$pz '$nz))
                  (t '$unknown))
                '$unknown)))
        '$unknown)))

;;; A square root and what stands beside it: |c*sqrt(p)| and |b| compare as their squares do.

(defun algebra-root-balance-sign (e)
  "Of c*sqrt(p) + b."
  (let ((*algebra-discriminants-left* (1- *algebra-discriminants-left*)))
    (loop for root in (and (not (minusp *algebra-discriminants-left*))
                           (remove-if-not #'algebra-square-root-p (algebra-kernels-of (list e))))
          for (b c . more) = (algebra-powers-in e root)
          for sign = (if (and c (null more) (algebra-real-p b) (algebra-real-p c))
                         (algebra-balance-sign b c (cadr root))
                         '$unknown)
          unless (eq sign '$unknown) return sign
          finally (return '$unknown))))

(defun algebra-square-root-p (e)
  (and (mexptp e) (eql (algebra-rational-number (caddr e)) 1/2)))

(defun algebra-balance-sign (b c p)
  "Of B + C*sqrt(P), B and C real."
  (let ((side (algebra-sign c)))
    (case (algebra-sign ($expand (sub (mul (power c 2) p) (power b 2))))
      ($pos (if (member side '($pos $neg)) side '$unknown))
      (($pz $zero) (case side ($pos '$pz) ($neg '$nz) (t '$unknown)))
      ($neg (if (member (algebra-sign p) '($pos $pz $zero)) (algebra-sign b) '$unknown))
      (t '$unknown))))
