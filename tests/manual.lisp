;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Read by rtest_manual.mac: the entries of doc/dynarch.info, and their worked examples run and compared with the printed answers.
;;; An example is a run of lines as Maxima shows them, `(%i1) input;' and `(%o1) answer', each over one line or several.

(in-package :maxima)

(core-require "algebra/zero")

;;; The manual as text

(defun manual-lines (name)
  (with-open-file (in (core-pathname (concatenate 'string *core-root* name)))
    (loop for line = (read-line in nil) while line collect line)))

(defun manual-begins-p (prefix line)
  (and (<= (length prefix) (length line)) (string= prefix line :end2 (length prefix))))

(defun manual-heading (line)
  "The name of the function whose entry begins with LINE, or nil."
  (let ((heading " -- Function: "))
    (when (manual-begins-p heading line)
      (subseq line (length heading) (position #\Space line :start (length heading))))))

(defun manual-lines-before-index ()
  (let ((lines (manual-lines "doc/dynarch.info")))
    (subseq lines 0 (position-if (lambda (line) (manual-begins-p "Appendix A" line)) lines))))

(defun manual-entries ()
  "((name line ..) ..): the names in the order of the manual, with the lines of their examples, from first to last."
  (let ((entries '()))
    (dolist (line (manual-lines-before-index))
      (let ((name (manual-heading line)))
        (cond ((and name (not (equal name (caar entries)))) (push (list name) entries))
              ((and entries (manual-begins-p "          " line))
               (push (subseq line 10) (cdar entries))))))
    (loop for (name . lines) in (nreverse entries) collect (cons name (reverse lines)))))

(defun manual-cells (lines)
  "((kind . text) ..) of the LINES of an example; kind is #\\i for an input, #\\o for an answer. A heading may go on in the
lines before."
  (let ((cells '()))
    (dolist (line lines (nreverse cells))
      (cond ((manual-begins-p "(%" line) (push (cons (char line 2) (subseq line (1+ (position #\) line)))) cells))
            (cells (setf (cdar cells) (format nil "~a~%~a" (cdar cells) line)))))))

;;; Examples

(defun manual-read (text)
  (with-input-from-string (in text) (third (mread in))))

(defun manual-run (input)
  "The value of INPUT as a list, or the text of the error that it ends in."
  (let (($errormsg nil))
    (or (errcatch (meval (manual-read input)))
        (format nil "error: ~{~a~^ ~}" (cddr $error)))))

(defun manual-squeezed (text)
  (remove-if (lambda (c) (member c '(#\Space #\Newline))) text))

(defun manual-printed (value)
  "VALUE in Maxima's linear form, in a list."
  (let (($stringdisp t)) (mfuncall '$string (list '(mlist simp) value))))

(defun manual-compound-p (e)
  (and (consp e) (member (caar e) '(mlist mequal mgreaterp mgeqp mlessp mleqp mnotequal $matrix))))

(defun manual-same-p (a b)
  "Whether A and B are the same expression up to the order in which terms and factors are written, and
to the places where the manual breaks a text into lines."
  (cond ((alike1 a b) t)
        ((and (stringp a) (stringp b)) (string= (manual-squeezed a) (manual-squeezed b)))
        ((or (manual-compound-p a) (manual-compound-p b))
         (and (manual-compound-p a) (manual-compound-p b)
              (eq (caar a) (caar b)) (= (length a) (length b))
              (every #'manual-same-p (cdr a) (cdr b))))
        ((or (stringp a) (stringp b) (symbolp a) (symbolp b)) nil)
        (t (eq (mfuncall '$algebra_zerop (sub a b)) t))))

(defun manual-answers-p (value answer)
  (or (string= (manual-squeezed (manual-printed value)) (manual-squeezed (format nil "[~a]" answer)))
      (let ((read (manual-run (concatenate 'string answer ";"))))
        (and (consp read) (manual-same-p value (car read))))))

(defun manual-without-traces (function)
  "Calls FUNCTION in a context of its own; the variables that it binds are removed at the end."
  (let ((before (copy-list (cdr $values))) (context $context))
    (mfuncall '$supcontext)
    (unwind-protect (funcall function)
      (mfuncall '$killcontext $context)
      (setq $context context)
      (dolist (name (set-difference (cdr $values) before)) (mfuncall '$remvalue name)))))

(defun manual-wrong-cells (cells)
  "Input, answer and what came instead, of the CELLS whose answer is not the one printed."
  (let ((results '()))
    (manual-without-traces
     (lambda ()
       (loop for ((kind . input) next) on cells
             when (char= kind #\i)
               do (push (list input (and next (char= (car next) #\o) (cdr next)) (manual-run input)) results))))
    (loop for (input answer value) in (nreverse results)
          when (or (stringp value) (and answer (not (manual-answers-p (car value) answer))))
            collect (list '(mlist simp) input (or answer "") (if (stringp value) value (manual-printed (car value)))))))

(defun $manual_wrong_examples (name)
  "The inputs in the entry of NAME that do not give the printed answer, each with both answers."
  (cons '(mlist simp) (manual-wrong-cells (manual-cells (cdr (assoc name (manual-entries) :test #'equal))))))

(defun $manual_names ()
  (cons '(mlist simp) (mapcar #'car (manual-entries))))

(defun $manual_without_example ()
  "Names of the entries that show no answer."
  (cons '(mlist simp)
        (loop for (name . lines) in (manual-entries)
              unless (assoc #\o (manual-cells lines)) collect name)))

;;; What the manual must agree with

(defun manual-quoted-words (line)
  (loop for start = (position #\" line) then (position #\" line :start (1+ end))
        for end = (and start (position #\" line :start (1+ start)))
        while end collect (subseq line (1+ start) end)))

(defun $manual_public_names ()
  "The functions that the three packages list: CamelCase names in quotes."
  (let ((words (loop for face in '("linmodel.mac" "circuits.mac" "analysis.mac")
                     append (mapcan #'manual-quoted-words (manual-lines face)))))
    (cons '(mlist simp)
          (remove-duplicates (remove-if-not (lambda (word) (upper-case-p (char word 0))) words) :test #'equal))))

(defun manual-help-text (name)
  "What `? name' prints."
  (let ((found (make-string-output-stream)))
    (let ((*standard-output* found)) (cl-info::info-exact name))
    (get-output-stream-string found)))

(defun $manual_wrong_help ()
  "Names for which `?' does not print the entry from its first line to the last line of its example."
  (cons '(mlist simp)
        (loop for (name . lines) in (manual-entries)
              for text = (manual-help-text name)
              unless (and (search (format nil "~% -- Function: ~a (" name) text)
                          (search (format nil "~a~%" (car (last lines))) text))
                collect name)))
