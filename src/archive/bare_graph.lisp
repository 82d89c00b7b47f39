;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A circuit as the paper prints it, the list of its graph alone: a file that holds nothing else,
;;;   {{{1, 2}, L1}, {{2, 3}, f1}, .. }.
;;; its lines as they come, perhaps with a full stop behind; or that list in a call. It becomes the
;;; description [kind = circuit, graph = ..]; nothing is written into such a file.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/parser" "archive/tokens" "archive/types"))

(defun archive-bare-graph-p (text)
  "Whether TEXT, but for comments, begins as the list of a graph: no archive does."
  (let* ((text (archive-simple-text text)) (end (length text))
         (start (archive-skip-blanks text 0 end))
         (next (and (< start end) (archive-skip-blanks text (1+ start) end))))
    (and next (< next end) (find (char text start) "{[") (find (char text next) "{[") t)))

(defun archive-without-stop (text)
  "TEXT without the full stop, or the semicolon, that ends it."
  (let ((bare (string-right-trim '(#\Space #\Tab #\Return #\Newline) text)))
    (if (and (plusp (length bare)) (find (char bare (1- (length bare))) ".;"))
        (subseq bare 0 (1- (length bare)))
        bare)))

(defun archive-bare-graph-description (file text)
  "The description list of the circuit whose graph is all that TEXT, the content of FILE, has."
  (archive-graph-description
   (archive-parse-value (make-archive-stretch :text (archive-without-stop text) :file file))))

(defun archive-graph-description (graph)
  "[kind = circuit, graph = GRAPH], its laws left open."
  (let ((laws (archive-graph-laws graph)))
    (archive-list (list* (archive-equation '$kind '$circuit)
                         (archive-equation '$graph graph)
                         (and laws (list (archive-equation '$functions (archive-list laws))))))))

(defun archive-graph-laws (graph)
  "The names of GRAPH that begin with f, g or h: laws of resistors."
  (remove-duplicates
   (loop for item in (cdr graph)
         for name = (and (archive-list-p item) (third item))
         when (and (archive-symbol-p name) (find (char (core-spelling name) 0) "fgh"))
           collect name)
   :from-end t))

(defun archive-graph-list-p (argument)
  "Whether ARGUMENT is the list of a graph, [[[1, 2], L1], ..]."
  (and (archive-list-p argument) (cdr argument)
       (every (lambda (item)
                (and (archive-list-p item) (<= 2 (length (cdr item)) 3)
                     (archive-list-p (second item)) (= 2 (length (cdr (second item))))
                     (archive-symbol-p (third item))))
              (cdr argument))))
