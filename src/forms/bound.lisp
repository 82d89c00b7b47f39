;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Exchange in nouns with variables of their own. The variable s of 'integrate(f(s),s,0,u) stays,
;;; and gets another name where a value put in contains s. A derivative d/dx f(x,y) at x = a is no
;;; derivative of f(a,y): it becomes 'at('diff(f(x,y),x), x = a), as at() makes it; if a is a new
;;; name, x is simply renamed.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "forms/exchange" "forms/kinks"))

(defun forms-bound-exchange (e pairs)
  (cond ((eq (caar e) '%at) (forms-exchange-at e pairs))
        ((eq (caar e) '%derivative) (forms-exchange-slope e (forms-slope-variables e) pairs))
        ((not (symbolp (third e))) (forms-exchange-parts e pairs))
        ((and (eq (caar e) '%integrate) (null (cdddr e)))
         (forms-exchange-slope e (list (third e)) pairs))
        (t (forms-exchange-bound e pairs))))

(setq *forms-bound-exchange* #'forms-bound-exchange)

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
        (loop for k from 1
              for name = ($concat variable '_ k)
              unless (or (among name body) (among name values)) return name))))

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
  (or (and (consp e) (forms-kinked-slope e (forms-read-pairs equations)))
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
