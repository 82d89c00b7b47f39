;;; SPDX-License-Identifier: GPL-2.0-or-later
;;;
;;; Programs of the distribution that answer questions on polynomials, qepcad and Singular: started
;;; by SBCL alone in an empty folder, with a limit of time; what they print is read by a grammar of
;;; its own: + - * / ^ and brackets, integers, the names that were given, and a product may be
;;; written without its sign.  What cannot be read is no answer.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/normal"))

(defun analysis-program-answer (name arguments input seconds)
  "What the program NAME prints, or nil where it is not there; it has SECONDS at most, and no more
than the call has left: it is ended by the program timeout, as the clock waits while one runs."
  #+sbcl
  (let ((process nil)
        (folder (analysis-empty-folder))
        (seconds (ceiling (min seconds (or (core-seconds-left) seconds)))))
    (unwind-protect
         (ignore-errors
          (with-output-to-string (out)
            (with-input-from-string (in input)
              (setq process (sb-ext:run-program
                             "timeout" (list* "-k" "1" (princ-to-string seconds) name arguments)
                             :search t :directory folder :input in :output out :error nil)))))
      (when (and process (sb-ext:process-alive-p process))
        (sb-ext:process-kill process 15))
      (ignore-errors (sb-ext:delete-directory folder :recursive t))))
  #-sbcl (progn name arguments input seconds nil))

#+sbcl
(defun analysis-empty-folder ()
  "A new one among the temporary ones; the session's own random numbers stay as they are."
  (loop with state = (make-random-state t)
        for folder = (format nil "~a/dynarch-~36r/" $maxima_tempdir (random (expt 36 10) state))
        unless (probe-file folder)
          do (return (ensure-directories-exist folder :mode #o700))))

;;; What they are told

(defun analysis-plain-text (polynomial names)
  "POLYNOMIAL in texts for names, ((name . text) ..)."
  (coerce (mstring (resimplify (sublis (loop for (name . text) in names
                                             collect (cons name (make-symbol
                                                                 (format nil "$~:@(~a~)" text))))
                                       ($expand polynomial))))
          'string))

(defun analysis-numbered-names (names letter)
  (loop for name in names for k from 1 collect (cons name (format nil "~a~d" letter k))))

;;; What they say

(defvar *analysis-tokens* '() "What is left to be read.")

(defun analysis-lines (text)
  (loop for start = 0 then (1+ end)
        for end = (position #\Newline text :start start)
        collect (subseq text start end)
        while end))

(defun analysis-read-polynomial (text names)
  "NAMES are ((text . name) ..)."
  (let* ((*analysis-tokens* (analysis-tokens-of text)) (value (analysis-read-sum names)))
    (if *analysis-tokens* (throw 'analysis-unreadable nil) value)))

(defun analysis-tokens-of (text)
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

(defun analysis-token (&rest expected)
  "The next token where it is one of those EXPECTED, which is taken."
  (and (member (car *analysis-tokens*) expected :test #'equal)
       (pop *analysis-tokens*)))

(defun analysis-read-sum (names)
  (let ((value (if (analysis-token "-")
                   (mul -1 (analysis-read-product names))
                   (analysis-read-product names))))
    (loop for sign = (analysis-token "+" "-")
          while sign
          do (let ((term (analysis-read-product names)))
               (setq value (add value (if (equal sign "-") (mul -1 term) term)))))
    ($expand value)))

(defun analysis-read-product (names)
  (let ((value (analysis-read-power names)))
    (loop while (and *analysis-tokens*
                     (or (alphanumericp (char (car *analysis-tokens*) 0))
                         (member (car *analysis-tokens*) '("(" "*" "/") :test #'equal)))
          do (setq value (if (analysis-token "/")
                             (div value (analysis-read-power names))
                             (progn (analysis-token "*")
                                    (mul value (analysis-read-power names))))))
    value))

(defun analysis-read-power (names)
  (let ((base (analysis-read-item names)))
    (if (analysis-token "^")
        (power base (parse-integer (pop *analysis-tokens*)))
        base)))

(defun analysis-read-item (names)
  (let* ((token (pop *analysis-tokens*)) (entry (assoc token names :test #'equal)))
    (cond (entry (cdr entry))
          ((equal token "(")
           (prog1 (analysis-read-sum names)
             (unless (analysis-token ")") (throw 'analysis-unreadable nil))))
          ((and token (every #'digit-char-p token)) (parse-integer token))
          (t (throw 'analysis-unreadable nil)))))
