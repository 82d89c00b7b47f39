;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The chapters on long runs, judged by what is constant, and on runs that have no end: tables in doc/numbers.md, words in
;;; doc/methods.md.

(in-package :maxima)

(defun report-long-row (row)
  (destructuring-bind (method tolerance told text) (cdr row)
    (flet ((part (key) (and told ($core_get told key))))
      (append (list (report-name method) (report-short tolerance))
              (list (format nil "~{~a~^, ~}"
                            (loop for (nil name drift) in (cdr (part '$drifts))
                                  collect (format nil "~a (~a)" (report-short drift) (report-word name)))))
              (mapcar #'part '($rates $steps $rejected))
              (list (if told (report-milliseconds (part '$seconds)) "")
                    (report-how-it-ended told text))))))

(defun report-how-it-ended (told text)
  "The status; where it was no end, the time before it, from TEXT."
  (let* ((begin (and text (search "t = " text))) (end (and begin (search " (" text :start2 begin))))
    (cond (end (format nil "~a: ~a" (subseq text begin end) (if told ($core_get told '$status) "")))
          (text (substitute #\Space #\Newline text))
          (t ($core_get told '$status)))))

(defun report-long-runs (out results)
  (format out "~%## Long runs, and one without an end~%~%No reference follows these: what is constant judges, relative to its ~
               size, at all steps.~%")
  (dolist (result results)
    (format out "~%### ~a, span ~a~%" ($core_get result '$title) (report-word ($core_get result '$span)))
    (report-table out '("method" " tolerance" "drift" " f" " steps" " rejected" " ms" "how it ended")
                  (mapcar #'report-long-row (report-rows result)))))

;;; In words

(defun report-reached-rows (result)
  (remove-if-not (lambda (row) (and (null (fifth row)) (fourth row))) (report-rows result)))

(defun report-drift-of (row)
  (reduce #'max (mapcar #'third (cdr ($core_get (fourth row) '$drifts))) :initial-value 0d0))

(defun report-long-sentence (result)
  "The rows by their drift, the least first."
  (format nil "**~a**, span ~a: ~{~a~^; ~}."
          ($core_get result '$title) (report-word ($core_get result '$span))
          (loop for row in (sort (report-reached-rows result) #'< :key #'report-drift-of)
                collect (format nil "~a at ~a drifts by ~a in ~a" (report-name (second row))
                                (report-short (third row)) (report-short (report-drift-of row))
                                (report-spoken-time ($core_get (fourth row) '$seconds))))))

(defun report-long-words (out results)
  (format out "~%## Over long spans~%~%How far the energy drifts, the least first.~%~%")
  (dolist (result results)
    (when (report-reached-rows result) (format out "* ~a~%" (report-long-sentence result)))))
