;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The chapter of doc/numbers.md on long runs, judged by what is constant, and on runs that have no end.

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
                    (if told (part '$status) (report-one-line (or text ""))))))))

(defun report-one-line (text) (substitute #\Space #\Newline text))

(defun report-long-runs (out results)
  (format out "~%## Long runs, and one without an end~%~%No reference follows these: what is constant judges, relative to its ~
               size, at all steps.~%")
  (dolist (result results)
    (format out "~%### ~a, span ~a~%" ($core_get result '$title) (report-word ($core_get result '$span)))
    (report-table out '("method" " tolerance" "drift" " f" " steps" " rejected" " ms" "how it ended")
                  (mapcar #'report-long-row (report-rows result)))))
