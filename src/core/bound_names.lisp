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

(defun $core_occurs (name e) (core-occurs-p name e))

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

;;; What is free. A free name that is put in beneath one that is bound would be taken for it.

(defun core-free-names (e &optional laws)
  "The names in E that nothing in it binds; LAWS: of what f(s) = .. has its arguments are bound."
  (let ((found '()))
    (labels ((note (e bound)
               (cond ((atom e)
                      (when (and (core-name-p e) (not (member e bound))) (pushnew e found)))
                     ((atom (car e)))
                     ((and laws (core-law-arguments e))
                      (note (caddr e) (append (cdadr e) bound)))
                     (t (note-call e bound (core-bound-names e)))))
             (note-call (e bound own)
               (note (cadr e) (append own bound))
               (dolist (part (if own (core-free-parts e) (cddr e))) (note part bound))))
      (note e '()))
    found))

(defun core-free-parts (e)
  "What E, that binds names, has beside them and what they are bound in."
  (if (eq (caar e) '%at)
      (mapcar #'caddr (core-equations-of-point (caddr e)))
      (cdddr e)))

(defvar *core-free-names* '() "The names that are free in what this call was given.")

;;; Other names. Nothing is simplified before all of them are there.

(defun core-unassumed (e &optional laws)
  "E, in which nothing is assumed of bound names, and none is bound within what binds it; LAWS: of
arguments of laws neither."
  (core-simplified (core-renamed e '() laws) e))

(defun core-simplified (renamed e)
  (if (eq renamed e) e (simplifya renamed nil)))

(defvar *core-clashing-p* nil
  "Whether a name must get another in a noun that binds it; nil: where something is assumed of it.")

(defun core-clashing-p (name noun)
  (if *core-clashing-p* (funcall *core-clashing-p* name noun) ($core_assumed name)))

(defun $core_unbound (e laws)
  "E, in which no name is bound around a call of one of LAWS whose right sides have it free: with
f(u) = s*u the s of 'integrate(f(s), s, 0, 1) is another."
  (let* ((free (loop for law in (cdr laws)
                     collect (cons ($verbify (caar (cadr law))) (core-free-names law t))))
         (*core-names* (append (loop for (nil . names) in free append names) *core-names*))
         (*core-clashing-p* (lambda (name noun)
                              (loop for (head . names) in free
                                    thereis (and (member name names)
                                                 (core-calls-p head (cadr noun)))))))
    (core-simplified (core-renamed e '() nil) e)))

(defun core-calls-p (head e)
  (and (consp e)
       (consp (car e))
       (or (and (symbolp (caar e)) (eq ($verbify (caar e)) head))
           (some (lambda (part) (core-calls-p head part)) (cdr e)))))

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
    (when (or (member name around) (core-clashing-p name e))
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
