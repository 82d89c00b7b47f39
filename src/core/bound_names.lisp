;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Names that are bound: s in 'integrate(f(s), s, a, b), in sums, products, limits and values at a
;;; point, in the argument of a law f(s) = .. What is assumed of a name says nothing of a bound one,
;;; but Maxima's simplifier and all that asks for signs see the name alone: with s > 0 they take
;;; max(s, 0) for s. So bound names of which something is assumed get others, s_1, and so do those
;;; that are bound around already. See core-unassumed first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "core/facts" "core/messages"))

(defun core-name-p (e) (and e (symbolp e) (char= (char (symbol-name e) 0) #\$)))

(defun core-bound-names (e)
  "The names that E, a call, binds in its first part."
  (case (caar e)
    ((%integrate %sum %product) (and (cdddr e) (core-name-p (caddr e)) (list (caddr e))))
    ((%limit %laplace) (and (core-name-p (caddr e)) (list (caddr e))))
    (%at (loop for equation in (core-equations-of-point (caddr e))
               when (core-name-p (cadr equation)) collect (cadr equation)))))

(defun core-equations-of-point (where)
  (remove-if-not #'mequalp (if (mbagp where) (if (mequalp where) (list where) (cdr where)))))

(defun core-law-arguments (e)
  "The arguments of the function that E, f(s, ..) = .., states, names."
  (let ((head (and (mequalp e) (cadr e))))
    (and (consp head)
         (core-name-p (caar head))
         (every #'core-name-p (cdr head))
         (cdr head))))

(defun core-occurs-p (name e)
  (if (atom e) (eq name e) (some (lambda (part) (core-occurs-p name part)) (cdr e))))

;;; What is assumed

(defvar *core-assumed* (cons nil nil) "A list of facts, and the names in them: the last asked for.")

(defun core-assumed-names ()
  "The names of which something is assumed here, a table."
  (let ((facts (core-facts)))
    (unless (and (cdr *core-assumed*) (eq facts (car *core-assumed*)))
      (let ((names (make-hash-table :test #'eq)))
        (labels ((note (e)
                   (cond ((core-name-p e) (setf (gethash e names) t))
                         ((consp e) (mapc #'note (cdr e))))))
          (mapc #'note facts))
        (setq *core-assumed* (cons facts names))))
    (cdr *core-assumed*)))

(defun $core_assumed (name)
  "Whether something is assumed of NAME."
  (values (gethash name (core-assumed-names))))

(defun $core_unused_name (stem e)
  "stem_1, stem_2, ..: the first that stands neither in E nor in the call, of which nothing is
assumed."
  (core-unused-name stem e '()))

(defun core-unused-name (stem e others)
  (loop for k from 1
        for name = ($concat stem '_ k)
        unless (or (core-occurs-p name e) (member name others) (member name *core-names*)
                   ($core_assumed name))
          return name))

;;; Other names. Nothing is simplified before all of them are there.

(defun core-unassumed (e &optional laws)
  "E, in which nothing is assumed of bound names, and none is bound within what binds it; LAWS: of
arguments of laws neither."
  (let ((renamed (core-renamed e '() laws)))
    (if (eq renamed e) e (simplifya renamed nil))))

(defun core-renamed (e around laws)
  "AROUND: what is bound around E."
  (cond ((or (atom e) (atom (car e))) e)
        ((and laws (core-law-arguments e)) (core-law-renamed e))
        (t (let* ((e (core-noun-renamed e around))
                  (inside (append (core-bound-names e) around)))
             (core-raw e (cons (core-renamed (cadr e) inside laws)
                               (mapcar (lambda (part) (core-renamed part around laws))
                                       (cddr e))))))))

(defun core-raw (e parts)
  "E with other PARTS, to be simplified."
  (if (every #'eq parts (cdr e)) e (cons (remove 'simp (car e)) parts)))

(defun core-put (new name e)
  "E with the name NEW for NAME, wherever it stands."
  (cond ((eq e name) new)
        ((atom e) e)
        (t (core-raw e (mapcar (lambda (part) (core-put new name part)) (cdr e))))))

(defun core-noun-renamed (e around)
  (dolist (name (core-bound-names e) e)
    (when (or (member name around) ($core_assumed name))
      (setq e (core-bound-to e name (core-unused-name name e around))))))

(defun core-bound-to (e name new)
  "E with NEW for the NAME that it binds: in its first part, and where it is bound."
  (destructuring-bind (body where . more) (cdr e)
    (core-raw e (list* (core-put new name body)
                       (if (eq (caar e) '%at) (core-point-named where name new) new)
                       more))))

(defun core-point-named (where name new)
  (flet ((named (equation)
           (if (and (mequalp equation) (eq (cadr equation) name))
               (list (car equation) new (caddr equation))
               equation)))
    (if (mequalp where) (named where) (cons (car where) (mapcar #'named (cdr where))))))

(defun core-law-renamed (law)
  (destructuring-bind (head formula) (cdr law)
    (dolist (name (remove-if-not #'$core_assumed (cdr head)))
      (let ((new ($core_unused_name name law)))
        (setq head (core-put new name head)
              formula (core-put new name formula))))
    (core-raw law (list head (core-renamed formula '() nil)))))
