;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; What is seen at sight of two solutions [x = .., ..]: of thousands each is compared with all.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/points_of_facts" "algebra/size"))

(defun $analysis_differ_at_sight (s other)
  "Whether the lists [x = .., ..] give different rational numbers to one of the names."
  (loop for (nil name value) in (cdr s)
        for number = (algebra-rational-number value)
        thereis (and number
                     (let ((there (find name (cdr other) :key #'cadr :test #'eq)))
                       (and there
                            (algebra-rational-number (caddr there))
                            (not (alike1 value (caddr there))))))))

(defun $analysis_left_to_prove (other s)
  "Those equations x = .. of OTHER but such as stand in S, with values of names that S leaves free."
  (let ((given (mapcar #'cadr (cdr s))))
    (remove-if (lambda (equation)
                 (destructuring-bind (name value) (cdr equation)
                   (let ((there (find name (cdr s) :key #'cadr :test #'eq)))
                     (and there (alike1 value (caddr there))
                          (or (atom value) ($lfreeof (cons '(mlist) given) value))
                          (not (member value given :test #'eq))))))
               other :start 1)))

;;; One place of s, at which the free names have numbers of their own: where other gives another
;;; value there s does not lie on it.

(defun $analysis_apart_at_a_place (s other)
  "Whether some x = f of OTHER fails at a place of S; nil where one is no rational function too."
  (let ((numbers (make-hash-table :test #'eq)))
    (catch 'no-form
      (catch 'no-value
        (loop for (nil name value) in (cdr s)
              for number = (analysis-value-at-place value numbers)
              do (setf (gethash name numbers) number))
        (loop for (nil name value) in (cdr other)
                thereis (/= (analysis-value-at-place name numbers)
                            (analysis-value-at-place value numbers)))))))

(defun analysis-value-at-place (e numbers)
  "A rational number; names that have none in NUMBERS get one."
  (let* ((search (make-algebra-search)) (form (algebra-plain-form e search)))
    (algebra-number-at form (map 'vector (lambda (name) (analysis-number-of-name name numbers))
                                 (search-names search)))))

(defun analysis-number-of-name (name numbers)
  (or (gethash name numbers)
      (let ((k (hash-table-count numbers)))
        (setf (gethash name numbers) (/ (+ 1009 (* 211 k k)) (+ 97 (* 13 k)))))))
