;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The adversary of points of facts: random facts, some of which contradict each other, and random
;;; expressions. Points must change no answer, of all that asks for signs; they save time. The facts
;;; must hold at each of them, by the arithmetic of fuzz_signs.lisp.

(in-package :maxima)

(core-require "algebra/sign" "algebra/points_of_facts")
(load (concatenate 'string *core-root* "tests/fuzz_signs.lisp"))

(defun fuzz-points-expression ()
  (or (car (core-attempt (lambda () (signs-wrapped (1+ (signs-random 3)))))) 1))

(defun fuzz-points-answers (e facts)
  "What is answered of E and of FACTS, learned anew."
  (let ((*algebra-knowledges* (make-hash-table :test 'equal))
        (*algebra-searches* (make-hash-table :test 'equal))
        (*core-facts* facts))
    (list ($algebra_sign e) ($algebra_positive e)
          ($algebra_sign_among e '((mlist) $pos)) ($algebra_sign_among e '((mlist) $pz $pos $zero))
          (let ((*core-facts* '())) ($algebra_contradictory (cons '(mlist) facts))))))

(defun fuzz-points-fail-p (facts)
  "Whether one of FACTS fails at a point that is kept for them."
  (let ((search (let ((*algebra-searches* (make-hash-table :test 'equal)))
                  (algebra-search-under facts))))
    (and search
         (loop for point in (search-points search)
               for values = (map 'list #'cons (search-names search) point)
               thereis (some (lambda (fact)
                               (multiple-value-bind (e sign) (core-fact-difference fact)
                                 (let ((value (catch 'no-value (signs-value e values))))
                                   (and value
                                        (not (member (signum value)
                                                     (algebra-sign-values sign)))))))
                             facts)))))

(defun fuzz-points-case ()
  "nil, or facts and an expression of which points change an answer."
  (let* ((points (list (signs-point) (signs-point)))
         (facts (remove nil (loop repeat (1+ (signs-random 4))
                                  collect (catch 'no-value
                                            (signs-fact (signs-choice points))))))
         (e (fuzz-points-expression)))
    (when (or (fuzz-points-fail-p facts)
              (not (equal (fuzz-points-answers e facts)
                          (let ((*algebra-walks* 0)) (fuzz-points-answers e facts)))))
      (list '(mlist simp) e (cons '(mlist simp) facts)))))

(defun $fuzz_points (count seed)
  "The failures among COUNT random cases from SEED."
  (signs-failures count seed #'fuzz-points-case))

(defun $fuzz_points_planted (count seed)
  "The same while any point is taken for one at which the facts hold."
  (let ((judge #'algebra-condition-holds-p))
    (unwind-protect
         (progn (setf (symbol-function 'algebra-condition-holds-p) (constantly t))
                ($fuzz_points count seed))
      (setf (symbol-function 'algebra-condition-holds-p) judge))))
