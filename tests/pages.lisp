;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; How a page under src looks: lines of at most 100 columns, files of at most 350 lines, functions of
;;; at most 6 parameters. Makers of records have as many as these have fields. After
;;; definitions.lisp and uses.lisp.

(in-package :maxima)

(defun pages-of (look)
  "[[part, found], ..] of the parts for which LOOK, a function of a file, finds something."
  (apply #'uses-list
         (loop for part in (uses-parts)
               for found = (funcall look (uses-file part))
               when found collect (uses-list part found))))

(defun pages-lines (file) (uses-lines (string-right-trim '(#\Newline) (uses-text file))))

(defun $pages_wide_lines (columns)
  "Numbers of the lines that are wider, those of the faces among them."
  (flet ((wide (file)
           (let ((numbers (loop for line in (pages-lines file)
                                for number from 1
                                when (> (length line) columns) collect number)))
             (and numbers (apply #'uses-list numbers)))))
    (append (pages-of #'wide)
            (loop for face in '("linmodel" "circuits" "analysis")
                  for numbers = (wide (format nil "~a~a.mac" *core-root* face))
                  when numbers collect (uses-list face numbers)))))

(defun $pages_long_files (lines)
  (pages-of (lambda (file)
              (let ((length (length (pages-lines file)))) (and (> length lines) length)))))

;;; Parameters

(defun pages-parameters (lambda-list)
  "How many parameters a LAMBDA-LIST of Lisp has."
  (loop for parameter in lambda-list
        until (eq parameter '&aux)
        count (not (member parameter lambda-list-keywords))))

(defun pages-lisp-functions (form)
  "(name . parameters) of the functions in FORM, local ones too."
  (when (consp form)
    (append (when (and (member (car form) '(defun defmacro)) (listp (third form)))
              (list (cons (second form) (pages-parameters (third form)))))
            (when (and (member (car form) '(flet labels macrolet)) (listp (cadr form)))
              (loop for local in (cadr form)
                    when (and (consp local) (listp (cadr local)))
                      collect (cons (car local) (pages-parameters (cadr local)))))
            (loop for rest = form then (cdr rest)
                  while (consp rest) append (pages-lisp-functions (car rest))))))

(defun pages-mac-functions (plain)
  "(name . parameters) of the functions that begin a line of PLAIN, a text without comments."
  (loop for begin = 0 then (1+ end)
        for end = (position #\Newline plain :start begin)
        for open = (position #\( plain :start begin :end end)
        for close = (and open (position #\) plain :start open))
        for sign = (and close (position-if-not #'pages-blank-p plain :start (1+ close)))
        when (and sign (> open begin) (eql (search ":=" plain :start2 sign) sign)
                  (every (lambda (c) (or (alphanumericp c) (char= c #\_)))
                         (subseq plain begin open)))
          collect (cons (subseq plain begin open)
                        (if (find-if-not #'pages-blank-p plain :start (1+ open) :end close)
                            (1+ (count #\, plain :start open :end close))
                            0))
        while end))

(defun pages-blank-p (c) (member c '(#\Space #\Newline #\Tab)))

(defun $pages_many_parameters (most)
  "Functions that have more."
  (pages-of
   (lambda (file)
     (let ((many (loop for (name . number)
                         in (if (search ".lisp" file)
                                (pages-lisp-functions (uses-forms file))
                                (pages-mac-functions (values (uses-plain (uses-text file)))))
                       when (> number most) collect (string-downcase name))))
       (and many (apply #'uses-list many))))))
