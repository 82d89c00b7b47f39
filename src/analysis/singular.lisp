;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; The program Singular, where it is installed (Decker, Greuel, Pfister, Schoenemann): the primes
;;; of which the union of the zeros of several ideals is made, over the field of the parameters
;;; (Gianni, Trager, Zacharias; its library primdec).  The unknowns are called x1, x2, .., the
;;; parameters p1, p2, ..

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "analysis/programs_asked"))

(defparameter *analysis-singular-seconds* 20 "What the program may take.")

(defun $analysis_singular_primes (ideals unknowns parameters)
  "[[[e, ..], ..]], the primes of the union of IDEALS, lists of polynomials; [] where the program is
not there or does not say."
  (let* ((names (append (analysis-numbered-names (cdr unknowns) "x")
                        (analysis-numbered-names (cdr parameters) "p")))
         (answer (analysis-program-answer "Singular" '("-q" "--no-rc" "--no-warn")
                                          (analysis-singular-input (cdr ideals) names)
                                          *analysis-singular-seconds*))
         (primes (and answer (analysis-singular-read answer names))))
    (if primes (list '(mlist simp) primes) '((mlist simp)))))

(defun analysis-singular-input (ideals names)
  (flet ((called (letter)
           (loop for (nil . text) in names when (char= (char text 0) letter) collect text)))
    (format nil "LIB \"primdec.lib\"; ring r = (0~{, ~a~}), (~{~a~^, ~}), dp; short = 0;~%~
                 ideal all = 1;~%~{all = intersect(all, ideal(~a));~%~}~
                 list found = minAssGTZ (all); int k; int j;~%~
                 for (k = 1; k <= size(found); k++) { print(\"prime\");~%~
                 for (j = 1; j <= size(found[k]); j++) { print(string(found[k][j])); } }~%~
                 print(\"end\"); quit;~%"
            (called #\p) (called #\x)
            (loop for ideal in ideals
                  collect (format nil "~{~a~^, ~}"
                                  (loop for e in (cdr ideal)
                                        collect (analysis-plain-text e names)))))))

(defun analysis-singular-read (answer names)
  "The list of primes between the first line `prime' and the line `end'; nil where errors are told."
  (let ((lines (analysis-lines (remove #\Return answer)))
        (read-names (loop for (name . text) in names collect (cons text name))))
    (when (and (member "end" lines :test #'equal) (not (find #\? answer)))
      (catch 'analysis-unreadable
        (cons '(mlist simp)
              (loop for ideal in (analysis-singular-ideals lines)
                    collect (cons '(mlist simp)
                                  (loop for line in ideal
                                        collect (analysis-read-polynomial line read-names)))))))))

(defun analysis-singular-ideals (lines)
  "Lists of lines, what follows each `prime'; nothing but polynomials stands there."
  (let ((ideals '()))
    (loop for line in (member "prime" lines :test #'equal)
          until (equal line "end")
          do (if (equal line "prime") (push '() ideals) (push line (first ideals))))
    (reverse (mapcar #'reverse ideals))))
