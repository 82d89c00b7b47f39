;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Finding the time derivatives 'diff(q,t,n) in an expression, and exchanging names and these for
;;; other expressions, all at once. subst() goes through the expression once for each of them,
;;; breaks 'diff(q,t) when it puts in a value for q, and takes the variable of an integral for
;;; something of its own. In 'integrate(f(s),s,0,u) that variable stays, and gets another name where
;;; a value put in contains s. A derivative d/dx f(x,y) at x = a is no derivative of f(a,y): it
;;; becomes 'at('diff(f(x,y),x), x = a), as at() makes it; if a is a new name, x is simply renamed.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/bound_names" "forms/piecewise"))

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

(defstruct forms-pairs
  names      ; name -> its value
  others     ; (expression . value), ..
  operators  ; of the others
  hidden)    ; what stays: the variables of the nouns around

(defun forms-read-pairs (pairs)
  (let ((read (make-forms-pairs :names (make-hash-table :test #'eq))))
    (dolist (pair pairs read)
      (destructuring-bind (old new) (cdr pair)
        (cond ((symbolp old) (setf (gethash old (forms-pairs-names read)) new))
              (t (push (cons old new) (forms-pairs-others read))
                 (pushnew (caar old) (forms-pairs-operators read))))))))

(defun forms-value-in (pairs part)
  "What PART is to be exchanged for; PART itself where it is not."
  (cond ((and (forms-pairs-hidden pairs) (member part (forms-pairs-hidden pairs) :test #'alike1))
         part)
        ((symbolp part) (values (gethash part (forms-pairs-names pairs) part)))
        ((and (consp part) (member (caar part) (forms-pairs-operators pairs) :test #'eq))
         (let ((pair (assoc part (forms-pairs-others pairs) :test #'alike1)))
           (if pair (cdr pair) part)))
        (t part)))

(defun forms-exchange (e pairs)
  (let ((other (forms-value-in pairs e)))
    (cond ((not (eq other e)) other)
          ((or (atom e) (forms-derivative-p e)) e)
          ((member (caar e) '(%derivative %integrate %sum %product %limit %laplace %at) :test #'eq)
           (forms-exchange-in-noun e pairs))
          (t (forms-exchange-parts e pairs)))))

(defun forms-exchange-parts (e pairs)
  (forms-with-parts e (mapcar (lambda (part) (forms-exchange part pairs)) (cdr e))))

(defun $forms_exchange (e pairs)
  "E with the right sides of PAIRS in place of their left sides (names and 'diff(q,t,n))."
  (forms-exchange e (forms-read-pairs (cdr pairs))))

(defun forms-putting (equations)
  "The function that exchanges by EQUATIONS."
  (let ((pairs (forms-read-pairs equations)))
    (lambda (e) (forms-exchange e pairs))))

(defun $forms_kink_at (e point)
  "A function in E that has no derivative at POINT, equations; else false."
  (forms-kink-at e (forms-putting (cdr point))))

(defun $forms_kink_derived (e point)
  "A function in E whose derivative stands in E and does not exist at POINT, equations; or false."
  (cond ((atom e) nil)
        ((eq (caar e) '%derivative)
         (and (forms-kinked-p (cadr e))
              (null (core-attempt (lambda ()
                                    (forms-kinked-slope e (forms-putting (cdr point)) point))))
              (cadr e)))
        (t (some (lambda (part) ($forms_kink_derived part point)) (cdr e)))))

(defun $forms_jump_at (e moving point)
  "A function in E, in which the names MOVING move, that may jump at POINT, equations; else false."
  (forms-jump-at e (forms-putting (cdr point)) (cdr moving)))

;;; Nouns with variables of their own.

(defun forms-exchange-in-noun (e pairs)
  (cond ((eq (caar e) '%at) (forms-exchange-at e pairs))
        ((eq (caar e) '%derivative) (forms-exchange-slope e (forms-slope-variables e) pairs))
        ((not (symbolp (third e))) (forms-exchange-parts e pairs))
        ((and (eq (caar e) '%integrate) (null (cdddr e)))
         (forms-exchange-slope e (list (third e)) pairs))
        (t (forms-exchange-bound e pairs))))

(defun forms-hiding (pairs names)
  (let ((copy (copy-forms-pairs pairs)))
    (setf (forms-pairs-hidden copy) (append names (forms-pairs-hidden copy)))
    copy))

(defun forms-occurring (e pairs)
  "The (old . new) of PAIRS whose left side occurs in E."
  (let ((found '()))
    (labels ((walk (part)
               (let ((value (forms-value-in pairs part)))
                 (cond ((not (eq value part))
                        (pushnew (cons part value) found :key #'car :test #'alike1))
                       ((consp part) (mapc #'walk (cdr part)))))))
      (walk e))
    (nreverse found)))

;;; Integrals between limits, sums, products, limits: (body variable . free parts).

(defun forms-exchange-bound (e pairs)
  (destructuring-bind (body variable . free) (cdr e)
    (let* ((inside (forms-hiding pairs (list variable)))
           (occurring (forms-occurring body inside))
           (new (forms-unbound-name variable body occurring))
           (renamed (if (eq new variable) body (maxima-substitute new variable body))))
      (forms-check-variable variable occurring)
      (forms-with-parts e (list* (forms-exchange renamed (forms-hiding inside (list new)))
                                 new
                                 (mapcar (lambda (part) (forms-exchange part pairs)) free))))))

(defun forms-check-variable (variable occurring)
  (when (and occurring (eq variable '$t))
    (core-error "an integral over t of what depends on ~a is not served"
                (core-words (list (caar occurring))))))

(defun forms-unbound-name (variable body occurring)
  "VARIABLE, or another name where a value would be caught."
  (let ((values (cons '(mlist) (mapcar #'cdr occurring))))
    (if (not (among variable values))
        variable
        ($core_unused_name variable (list '(mlist) body values)))))

;;; Derivatives, indefinite integrals: functions of the VARIABLES, at a point.

(defun forms-slope-variables (e)
  (loop for (variable nil) on (cddr e) by #'cddr collect variable))

(defun forms-exchange-slope (e variables pairs)
  (let ((occurring (forms-occurring e pairs)))
    (cond ((null occurring) e)
          ((forms-renaming-p e occurring) (forms-renamed e pairs))
          ((forms-apart-p variables occurring) (forms-exchange-parts e pairs))
          (t (forms-at-point e occurring)))))

(defun forms-renaming-p (e occurring)
  "All values are names, each another, and none of them is left in E."
  (let ((names (mapcar #'cdr occurring)))
    (and (every #'symbolp names)
         (notany #'$constantp names)
         (equal names (remove-duplicates names))
         (notany (lambda (name)
                   (and (among name e) (not (member name occurring :key #'car :test #'eq))))
                 names))))

(defun forms-renamed (e pairs)
  (if (atom e)
      (forms-value-in pairs e)
      (let ((value (forms-value-in pairs e)))
        (if (eq value e)
            (forms-with-parts e (mapcar (lambda (part) (forms-renamed part pairs)) (cdr e)))
            value))))

(defun forms-apart-p (variables occurring)
  "Neither are the VARIABLES exchanged nor do they occur in what is put in."
  (loop for (old . new) in occurring
        never (some (lambda (variable) (or (alike1 old variable) (among variable new)))
                    variables)))

(defun forms-at-point (e occurring)
  (forms-at-noun e (loop for (old . new) in occurring
                         collect (list '(mequal simp) old new))))

(defun forms-at-noun (e equations)
  (or (and (consp e) (forms-kinked-slope e (forms-putting equations)
                                         (cons '(mlist simp) equations)))
      (forms-at-noun-itself e equations)))

(defun forms-at-noun-itself (e equations)
  ($nounify '$at) ; or Maxima prints ?%at
  (simplifya (list '(%at) e (if (cdr equations) (cons '(mlist simp) equations) (car equations)))
             nil))

;;; 'at(body, x = a): x belongs to the noun, a does not.

(defun forms-exchange-at (e pairs)
  (destructuring-bind (body where) (cdr e)
    (let* ((equations (if (eq (caar where) 'mlist) (cdr where) (list where)))
           (inside (forms-hiding pairs (mapcar #'cadr equations)))
           (occurring (forms-occurring body inside))
           (values (cons '(mlist) (mapcar #'cdr occurring)))
           (caught (some (lambda (equation) (among (cadr equation) values)) equations)))
      (forms-at-noun (if caught body (forms-exchange body inside))
                     (append (loop for (nil old new) in equations
                                   collect (list '(mequal simp) old (forms-exchange new pairs)))
                             (and caught
                                  (loop for (old . new) in occurring
                                        collect (list '(mequal simp) old new))))))))

;;; Powers of sines as polynomials in cosines and at most one sine: products of functions of angles
;;; that differ are independent then.

(defun forms-sine-power-p (e)
  (and (mexptp e) (integerp (third e)) (> (third e) 1)
       (consp (second e)) (eq (caar (second e)) '%sin)))

(defun forms-sine-powers (e found)
  "The different sin(u)^k, k > 1, in E and in FOUND."
  (cond ((atom e) found)
        ((forms-sine-power-p e) (if (member e found :test #'alike1) found (cons e found)))
        (t (dolist (part (cdr e) found)
             (setq found (forms-sine-powers part found))))))

(defun forms-in-cosines (power)
  "sin(u)^k = (1 - cos(u)^2)^(k/2), times sin(u) for an odd k."
  (destructuring-bind (sine k) (cdr power)
    (mul (power (sub 1 (power (take '(%cos) (second sine)) 2)) (floor k 2))
         (if (oddp k) sine 1))))

(defun $forms_without_sine_powers (e)
  (let ((powers (forms-sine-powers e '())))
    (if powers
        ($forms_exchange e (cons '(mlist simp)
                                 (loop for power in powers
                                       collect (list '(mequal simp) power
                                                     (forms-in-cosines power)))))
        e)))
