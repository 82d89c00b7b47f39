;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Where another package is quicker than this one, first of all in doc/numbers.md: read out of the tables of doc/bench.md, which has
;;; the quickest in the first row of each. See report-peers first.

(in-package :maxima)

(defun report-cells (line)
  "The texts between the bars of LINE, nil where it is no row of a table."
  (when (and (> (length line) 2) (char= (char line 0) #\|))
    (loop for begin = 1 then (1+ end)
          for end = (position #\| line :start begin)
          while end
          collect (string-trim " " (subseq line begin end)))))

(defun report-comparisons (file)
  "((title . rows) ..) of the tables in FILE that have our time over that of others; a row is a list of texts."
  (let ((title "") (tables '()) (open nil))
    (with-open-file (in file :if-does-not-exist nil)
      (when in
        (loop for line = (read-line in nil)
              while line
              do (let ((cells (report-cells line)))
                   (cond ((eql (search "### " line) 0) (setq title (subseq line 4)))
                         ((null cells) (setq open nil))
                         ((eql (search "our time over it" (car (last cells))) 0)
                          (setq open t)
                          (push (list title) tables))
                         ((and open (not (search "---" line))) (push cells (cdr (first tables)))))))))
    (loop for (title . rows) in (reverse tables)
          when rows collect (cons title (reverse rows)))))

(defun report-ours-p (row) (search "this package" (first row)))

(defun report-peers (out file)
  (let* ((comparisons (remove-if-not (lambda (comparison) (some #'report-ours-p (rest comparison)))
                                     (report-comparisons file)))
         (behind (remove-if (lambda (comparison) (report-ours-p (second comparison))) comparisons)))
    (format out "~%## Where another package is quicker~%~%")
    (if comparisons
        (format out "In ~d of the ~d comparisons at equal error in doc/bench.md~:[.~;:~]~%~%" (length behind)
                (length comparisons) behind)
        (format out "doc/bench.md has no comparisons at equal error; `make bench-peers` makes them.~%"))
    (loop for (title first) in behind
          do (format out "* ~a: ~a; our time over it (quartiles): ~a pairs~%" title (first first) (car (last first))))))
