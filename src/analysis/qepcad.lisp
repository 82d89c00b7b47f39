;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The program qepcad, where it is installed: quantifier elimination by partial cylindrical
;;; algebraic decomposition (Brown, QEPCAD B, ACM SIGSAM Bulletin 37, 2003). It is given a formula
;;; whose names are p1, p2, .. and m1, m2, .. on its input, with what is assumed of the p's, and
;;; its answer is read by a grammar of its own. SBCL alone starts it.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal"))

(defparameter *analysis-qepcad-seconds* 20 "What the program may take, its own clock.")

(defun $analysis_qepcad (cases facts free bound)
  "[and, or of conditions on the names FREE that say that there are BOUND for which one of the CASES
holds where the FACTS do]; false where the program is not there or does not say. All are lists of
conditions e > 0, .. with polynomials e."
  (let ((answer (analysis-qepcad-answer
                 (analysis-qepcad-input (cdr cases) (cdr facts) (cdr free) (cdr bound)))))
    (and answer (analysis-qepcad-read answer (cdr free)))))

;;; What it is told

(defun analysis-qepcad-input (cases facts free bound)
  (let ((names (append (loop for name in free for k from 1 collect (cons name (format nil "p~d" k)))
                       (loop for name in bound for k from 1
                             collect (cons name (format nil "m~d" k))))))
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
          (substitute #\Space #\*
                      (analysis-plain-text
                       (sublis (loop for (name . text) in names
                                     collect (cons name (make-symbol
                                                         (format nil "$~:@(~a~)" text))))
                               ($expand (second c)))))
          (ecase (caar c)
            (mgreaterp ">") (mgeqp ">=") (mequal "=") ($notequal "/="))))

(defun analysis-plain-text (polynomial)
  (coerce (mstring (resimplify polynomial)) 'string))

;;; The program

(defun analysis-qepcad-answer (input)
  "What the program prints, or nil."
  #+sbcl
  (let ((process nil))
    (unwind-protect
         (ignore-errors
          (with-output-to-string (out)
            (with-input-from-string (in input)
              (setq process (sb-ext:run-program
                             "qepcad" (list "+N8000000" "-noecho" "-t"
                                            (princ-to-string *analysis-qepcad-seconds*))
                             :search t :input in :output out :error nil)))))
      (when (and process (sb-ext:process-alive-p process))
        (sb-ext:process-kill process 15))))
  #-sbcl (progn input nil))

;;; What it says: conditions joined by /\ and \/, in brackets

(defparameter *analysis-qepcad-heading* "An equivalent quantifier-free formula:")

(defun analysis-qepcad-read (answer free)
  (let* ((start (search *analysis-qepcad-heading* answer))
         (end (and start (search "=====" answer :start2 start))))
    (when (and end (not (search "WARNING" answer)))
      (let ((names (loop for name in free for k from 1 collect (cons (format nil "p~d" k) name))))
        (catch 'analysis-unreadable
          (list '(mlist simp)
                (analysis-qepcad-formula
                 (analysis-qepcad-tokens
                  (subseq answer (+ start (length *analysis-qepcad-heading*)) end))
                 names)))))))

(defun analysis-qepcad-tokens (text)
  (let ((tokens '()) (k 0))
    (flet ((run (test)
             (let ((end (or (position-if-not test text :start k) (length text))))
               (push (subseq text k end) tokens)
               (setq k end))))
      (loop while (< k (length text))
            do (let ((letter (char text k)))
                 (cond ((member letter '(#\Space #\Newline #\Return #\Tab)) (incf k))
                       ((alphanumericp letter) (run #'alphanumericp))
                       ((find letter "/\\<>=") (run (lambda (c) (find c "/\\<>="))))
                       (t (push (string letter) tokens) (incf k)))))
      (nreverse tokens))))

(defvar *analysis-tokens* '() "What is left to be read.")

(defun analysis-token (&rest expected)
  "The next token where it is one of those EXPECTED, which is taken."
  (and (member (car *analysis-tokens*) expected :test #'equal)
       (pop *analysis-tokens*)))

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
        (t (let ((e (analysis-qepcad-sum names))
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

(defun analysis-qepcad-sum (names)
  (let ((value (if (analysis-token "-")
                   (mul -1 (analysis-qepcad-product names))
                   (analysis-qepcad-product names))))
    (loop for sign = (analysis-token "+" "-")
          while sign
          do (let ((term (analysis-qepcad-product names)))
               (setq value (add value (if (equal sign "-") (mul -1 term) term)))))
    ($expand value)))

(defun analysis-qepcad-product (names)
  (let ((value (analysis-qepcad-power names)))
    (loop while (and *analysis-tokens*
                     (or (alphanumericp (char (car *analysis-tokens*) 0))
                         (equal (car *analysis-tokens*) "(")))
          do (setq value (mul value (analysis-qepcad-power names))))
    value))

(defun analysis-qepcad-power (names)
  (let ((base (analysis-qepcad-item names)))
    (if (analysis-token "^")
        (power base (parse-integer (pop *analysis-tokens*)))
        base)))

(defun analysis-qepcad-item (names)
  (let* ((token (pop *analysis-tokens*)) (entry (assoc token names :test #'equal)))
    (cond (entry (cdr entry))
          ((equal token "(")
           (prog1 (analysis-qepcad-sum names)
             (unless (analysis-token ")") (throw 'analysis-unreadable nil))))
          ((and token (every #'digit-char-p token)) (parse-integer token))
          (t (throw 'analysis-unreadable nil)))))

(defun $analysis_facts ()
  "The relations that hold here."
  (cons '(mlist simp) (core-plain-relations (core-facts))))
