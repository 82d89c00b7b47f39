;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; A program as source text in C, Fortran, Python or Lisp: a routine NAME(x, y), x the inputs, y
;;; the outputs one after the other, matrices row by row, and z the work array; the head of the text
;;; lists them. The assignments go into functions of a few hundred each, since compilers take far
;;; more than linear time for one long function. See export-program first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/new_files" "algebra/program_record" "algebra/program_languages"
                "algebra/program_from_expressions" "algebra/program_nodes"))

(defvar *algebra-part-length* 300 "Assignments in one function.")

;;; Text.

(defun algebra-exported-text (language element places)
  (if (algebra-node-p element)
      (gethash (algebra-node-index element) places)
      (funcall (algebra-language-number language) element)))

(defun algebra-exported-operation (language node places)
  (flet ((text (element)
           (let ((text (algebra-exported-text language element places)))
             (if (and (realp element) (minusp element)
                      (not (string= (algebra-language-name language) "lisp")))
                 (format nil "(~a)" text)
                 text))))
    (format nil (cdr (assoc (algebra-node-operation node) (algebra-language-formats language)))
            (text (algebra-node-left node)) (text (algebra-node-right node)))))

(defun algebra-exported-places (language inputs nodes computed)
  (let ((places (make-hash-table)))
    (dolist (node (remove-if-not #'algebra-input-p nodes))
      (setf (gethash (algebra-node-index node) places)
            (algebra-exported-input language node inputs)))
    (loop for node in computed
          for k from 1
          do (setf (gethash (algebra-node-index node) places)
                   (funcall (algebra-language-place language) "z" k)))
    places))

(defun algebra-exported-input (language node inputs)
  (let ((place (position (algebra-node-left node) inputs :test #'alike1)))
    (cond (place (funcall (algebra-language-place language) "x" (1+ place)))
          ((algebra-constant-input-p node)
           (funcall (algebra-language-number language)
                    (rational (algebra-input-value (algebra-node-left node) '() nil))))
          (t (core-error "~a is not among the inputs of the program"
                         (core-words (list (algebra-node-left node))))))))

(defun algebra-exported-assignments (language computed elements places)
  "The lines of all assignments, those of the outputs last."
  (append
   (loop for node in computed
         collect (cons (gethash (algebra-node-index node) places)
                       (algebra-exported-operation language node places)))
   (loop for element in elements
         for k from 1
         collect (cons (funcall (algebra-language-place language) "y" k)
                       (algebra-exported-text language element places)))))

(defun algebra-output-names (outputs)
  (flet ((indexed (name &rest indices) (format nil "~a[~{~d~^,~}]" (core-spelling name) indices)))
    (loop for (name . value) in outputs
          append (cond ((or (numberp value) (algebra-node-p value)) (list (core-spelling name)))
                       ((eq (car value) :list)
                        (loop for nil in (cdr value) for k from 1 collect (indexed name k)))
                       (t (loop for row in (cdr value) for i from 1
                                append (loop for nil in row for j from 1
                                             collect (indexed name i j))))))))

(defun algebra-plain-text (e)
  (remove #\' (substitute #\Space #\Newline (coerce (mstring e) 'string))))

(defun algebra-write-head (stream language name inputs outputs operations)
  (flet ((line (format &rest arguments)
           (format stream "~a ~?~%" (algebra-language-comment language) format arguments)))
    (line "dynarch: program ~a, ~d operations; made by ExportProgram, replaced when it is made ~
           anew."
          name operations)
    (line "Inputs:")
    (loop for input in inputs
          for k from 1
          do (line "  x~d = ~a" k (algebra-plain-text input)))
    (line "Outputs:")
    (loop for output in (algebra-output-names outputs)
          for k from 1
          do (line "  y~d = ~a" k output))
    (format stream "~%")))

(defun algebra-write-program (stream language name inputs outputs)
  (let* ((elements (algebra-all-outputs outputs))
         (nodes (algebra-live-nodes elements))
         (computed (remove-if #'algebra-input-p nodes))
         (places (algebra-exported-places language inputs nodes computed))
         (lines (algebra-exported-assignments language computed elements places))
         (lengths (list (length inputs) (length elements) (max 1 (length computed))))
         (parts (ceiling (length lines) *algebra-part-length*)))
    (algebra-write-head stream language name inputs outputs (length computed))
    (flet ((write-lines (function &rest more)
             (write-string (apply function name (append lengths more)) stream)))
      (write-lines (algebra-language-first-lines language) parts)
      (dolist (k (algebra-part-numbers parts))
        (write-lines (algebra-language-begin language) k)
        (loop repeat *algebra-part-length*
              while lines
              do (destructuring-bind (place . text) (pop lines)
                   (format stream (algebra-language-assignment language) place text)))
        (write-string (funcall (algebra-language-end language) name k) stream))
      (write-lines (algebra-language-last-lines language) parts))))

;;; Files.

(defun algebra-routine-character (c)
  (if (or (char<= #\a c #\z) (char<= #\A c #\Z) (digit-char-p c)) (char-downcase c) #\_))

(defun algebra-routine-name (file language)
  "The name of FILE without folder and type, as a routine may be called in LANGUAGE."
  (let* ((start (algebra-folder-length file))
         (end (position #\. file :start start))
         (name (map 'string #'algebra-routine-character (subseq file start end))))
    (if (and (plusp (length name)) (alpha-char-p (char name 0))
             (not (algebra-reserved-name-p name (algebra-language-name language))))
        (subseq name 0 (min 50 (length name)))
        (concatenate 'string "program_" (subseq name 0 (min 40 (length name)))))))

(defun $algebra_export (record file language replace)
  "Writes RECORD to FILE and returns the name of the file."
  (unless (stringp file)
    (core-error "the second argument is the name of a file, found ~a" (core-words (list file))))
  (algebra-check-new-file file replace)
  (let ((language (algebra-language-named language)))
    (with-algebra-program
      (destructuring-bind (inputs outputs) (algebra-read-program record)
        (algebra-write-file
         file
         (lambda (stream)
           (algebra-write-program stream language (algebra-routine-name file language) inputs
                                  outputs))))))
  file)
