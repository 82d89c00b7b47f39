;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The program qepcad, where it is installed: quantifier elimination by partial cylindrical
;;; algebraic decomposition (Brown, QEPCAD B, ACM SIGSAM Bulletin 37, 2003). It is given a formula
;;; whose names are p1, p2, .. and m1, m2, .. on its input, with what is assumed of the p's, and
;;; its answer is read by a grammar of its own. SBCL alone starts it.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "analysis/programs_asked"))

(defparameter *analysis-qepcad-seconds* 20 "What the program may take, its own clock.")

(defun $analysis_qepcad (cases facts free bound)
  "[and, or of conditions on the names FREE that say that there are BOUND for which one of the CASES
holds where the FACTS do]; false where the program is not there or does not say. All are lists of
conditions e > 0, .. with polynomials e."
  (let ((answer (analysis-program-answer
                 "qepcad" (list "+N8000000" "-noecho" "-t"
                                (princ-to-string *analysis-qepcad-seconds*))
                 (analysis-qepcad-input (cdr cases) (cdr facts) (cdr free) (cdr bound))
                 (* 2 *analysis-qepcad-seconds*))))
    (and answer (analysis-qepcad-read answer (cdr free)))))

;;; What it is told

(defun analysis-qepcad-input (cases facts free bound)
  (let ((names (append (analysis-numbered-names free "p") (analysis-numbered-names bound "m"))))
    (flet ((all (conditions)
             (format nil "[~{~a~^ /\\ ~}]"
                     (loop for c in conditions collect (analysis-qepcad-condition c names)))))
      (format nil "[]~%(~{~a~^,~})~%~d~%~{(E ~a)~}[~{~a~^ \\/ ~}].~%~@[assume ~a~%~]finish~%"
              (mapcar #'cdr names) (length free)
              (loop for name in bound collect (cdr (assoc name names)))
              (mapcar #'all (mapcar #'cdr cases))
              (and facts free (all facts))))))

(defun analysis-qepcad-condition (c names)
  (format nil "~a ~a 0"
          (substitute #\Space #\* (analysis-plain-text (second c) names))
          (ecase (caar c)
            (mgreaterp ">") (mgeqp ">=") (mequal "=") ($notequal "/="))))

;;; What it says: conditions joined by /\ and \/, in brackets

(defparameter *analysis-qepcad-heading* "An equivalent quantifier-free formula:")

(defun analysis-qepcad-read (answer free)
  (let* ((start (search *analysis-qepcad-heading* answer))
         (end (and start (search "=====" answer :start2 start))))
    (when (and end (not (search "WARNING" answer)))
      (let ((names (loop for (name . text) in (analysis-numbered-names free "p")
                         collect (cons text name))))
        (catch 'analysis-unreadable
          (list '(mlist simp)
                (analysis-qepcad-formula
                 (analysis-tokens-of
                  (subseq answer (+ start (length *analysis-qepcad-heading*)) end))
                 names)))))))

(defun analysis-qepcad-formula (tokens names)
  (let* ((*analysis-tokens* tokens) (formula (analysis-qepcad-any names)))
    (if *analysis-tokens* (throw 'analysis-unreadable nil) formula)))

(defun analysis-qepcad-any (names)
  (analysis-logical 'mor (cons (analysis-qepcad-all names)
                               (loop while (analysis-token "\\/")
                                     collect (analysis-qepcad-all names)))))

(defun analysis-qepcad-all (names)
  (analysis-logical 'mand (cons (analysis-qepcad-one names)
                                (loop while (analysis-token "/\\")
                                      collect (analysis-qepcad-one names)))))

(defun analysis-logical (operator items)
  (if (rest items) (cons (list operator 'simp) items) (first items)))

(defun analysis-qepcad-one (names)
  (cond ((analysis-token "TRUE") t)
        ((analysis-token "FALSE") nil)
        ((analysis-token "[")
         (prog1 (analysis-qepcad-any names)
           (unless (analysis-token "]") (throw 'analysis-unreadable nil))))
        (t (let ((e (analysis-read-sum names))
                 (relation (analysis-token ">" "<" ">=" "<=" "=" "/=")))
             (unless (and relation (analysis-token "0")) (throw 'analysis-unreadable nil))
             (analysis-qepcad-comparison relation e)))))

(defun analysis-qepcad-comparison (relation e)
  (flet ((compared (operator e) (list (list operator 'simp) e 0)))
    (cond ((equal relation ">") (compared 'mgreaterp e))
          ((equal relation "<") (compared 'mgreaterp (mul -1 e)))
          ((equal relation ">=") (compared 'mgeqp e))
          ((equal relation "<=") (compared 'mgeqp (mul -1 e)))
          ((equal relation "=") (compared 'mequal e))
          (t (compared '$notequal e)))))

(defun $analysis_facts ()
  "The relations that hold here."
  (cons '(mlist simp) (core-plain-relations (core-facts))))
