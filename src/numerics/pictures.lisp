;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Pictures by Maxima's share package draw and gnuplot: PNG or SVG in a file, on the screen, or in
;;; the worksheet of wxMaxima. gnuplot writes into a file of a plain name in the folder for
;;; temporary ones, which is then put under the name that was asked for, whatever letters that has.
;;; What draw keeps from one drawing to the next is out of the way meanwhile. Look first at
;;; numerics-draw.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/new_files" "core/share_packages"))

(defstruct numerics-picture
  file   ; its name, nil for the screen
  kind)  ; $png or $svg

(defun numerics-kind-of-file (file)
  (let* ((dot (position #\. file :from-end t)) (type (and dot (subseq file dot))))
    (cond ((equalp type ".png") '$png)
          ((equalp type ".svg") '$svg)
          (t (core-error "a picture is a file .png or .svg, found ~a" file)))))

(defun $numerics_picture (file replace)
  "Where a picture goes; one that could not be written is refused before anything is computed."
  (cond (file (let ((kind (numerics-kind-of-file file)))
                (algebra-check-new-file file replace)
                (algebra-check-writable file)
                (make-numerics-picture :file file :kind kind)))
        (replace (core-error "replace = true is for a file; give file = \"name.png\""))
        (t (make-numerics-picture))))

;;; Items of a drawing, Maxima expressions

(defparameter *numerics-marks*
  '(("asymptotically stable" $filled_circle "#117733")
    ("stable" $filled_diamant "#332288")
    ("unstable" $circle "#cc3311")
    ("not decided" $square "#555555"))
  "Each row: a verdict, its sign and colour.")

(defun numerics-option (name value) (list '(mequal simp) name value))

(defun numerics-points (places)
  "The object of draw for PLACES, lists of two numbers."
  (list '($points simp) (cons '(mlist simp) (mapcar #'first places))
        (cons '(mlist simp) (mapcar #'second places))))

(defparameter *numerics-longest-text* 110 "Letters in a picture.")

(defun numerics-doubled-quotes (text)
  "TEXT as it stands between the quotes of gnuplot, cut where it would not fit."
  (let ((cut (if (> (length text) *numerics-longest-text*)
                 (concatenate 'string (subseq text 0 (- *numerics-longest-text* 3)) "...")
                 text)))
    (with-output-to-string (out)
      (loop for letter across cut
            do (when (char= letter #\') (write-char letter out))
               (when (char>= letter #\Space) (write-char letter out))))))

(defun numerics-gnuplot-text (text)
  "TEXT in the quotes of gnuplot."
  (format nil "'~a'" (numerics-doubled-quotes text)))

(defparameter *numerics-title-letters* 84 "In a line of a title.")
(defparameter *numerics-title-lines* 3)

(defun numerics-filled-lines (items)
  "Texts with as many of ITEMS each, texts, as fit into a line, apart by blanks."
  (let ((lines '()))
    (dolist (item items (reverse lines))
      (if (and lines (<= (+ (length (first lines)) 1 (length item)) *numerics-title-letters*))
          (setf (first lines) (format nil "~a ~a" (first lines) item))
          (push item lines)))))

(defun numerics-title-line (items)
  "The line of gnuplot for a title of ITEMS, texts, on a few lines; what is left is not shown."
  (let ((lines (numerics-filled-lines items)))
    (when (nthcdr *numerics-title-lines* lines)
      (setq lines (append (subseq lines 0 (1- *numerics-title-lines*))
                          (list (format nil "~a .." (nth (1- *numerics-title-lines*) lines))))))
    (format nil "set title ~{~a~^.\"\\n\".~} noenhanced"
            (mapcar #'numerics-gnuplot-text lines))))

(defun numerics-state-text (name)
  "The state NAME as an axis says it, theta' for a velocity."
  (if (and (consp name) (eq (caar name) '%derivative))
      (format nil "~a'" (core-words (list (second name))))
      (core-words (list name))))

(defun numerics-preamble (horizontal vertical &rest more)
  "Lines of gnuplot: the axes, the legend, and MORE of them."
  (format nil "set xlabel ~a noenhanced~%set ylabel ~a noenhanced~%~
               set key outside top center horizontal noenhanced~%~{~a~%~}"
          (numerics-gnuplot-text horizontal) (numerics-gnuplot-text vertical) more))

(defun numerics-small-range-lines (axis low high)
  "A line of gnuplot for an AXIS so short that draw takes its ends for equal and shows 0.01 about
them; none else."
  (when (< 0d0 (- high low) 1d-12)
    (list (substitute #\e #\d (format nil "set ~arange [~,16e:~,16e]" axis low high)))))

;;; draw

(defun numerics-draw-there-p ()
  "Whether draw is there, and whole: another session may have been compiling its second file."
  (and (fboundp '$draw)
       (let ((renderer (find-symbol "DRAW_GNUPLOT" :maxima)))
         (or (null renderer) (fboundp renderer)))))

(defun numerics-load-draw ()
  (unless (numerics-draw-there-p) (core-progress "loading draw"))
  (unless (core-load-share "draw" #'numerics-draw-there-p)
    (core-error "Maxima's package draw, which makes the pictures, cannot be loaded")))

(defun numerics-with-own-draw (function)
  "Calls FUNCTION while draw has none of the user's settings; it is as before afterwards."
  (core-with-values '(*gr-options* *user-gr-default-options* *multiplot-is-active* *allocations*
                      *draw-terminal-number* $draw_renderer $draw_use_pngcairo $gnuplot_command)
                    (list (make-hash-table) nil nil nil "" '$gnuplot nil (numerics-gnuplot))
                    function))

(defun numerics-gnuplot ()
  "The command; what it has to say is said here."
  #+(or win32 windows) $gnuplot_command
  #-(or win32 windows) (format nil "2>/dev/null ~a" $gnuplot_command))

(defvar *numerics-drawings* 0 "Drawings of this session.")
(defvar *numerics-drawing* nil "The name of the files of the one that is made.")

(defun numerics-temporary (type) (concatenate 'string *numerics-drawing* type))

(defun numerics-temporary-path (type)
  (format nil "~a/~a" $maxima_tempdir (numerics-temporary type)))

(defun numerics-filled-p (path)
  (and (core-existing-file path)
       (with-open-file (stream (core-pathname path)) (plusp (file-length stream)))))

(defparameter *numerics-svg-letters* 15 "Their size; gnuplot's own are smaller than in PNG.")

(defun numerics-scene-of-draw (scene terminal)
  "What draw takes for SCENE, (preamble . items)."
  (list '($gr2d) (append (list '(mlist simp) (numerics-option '$user_preamble (first scene)))
                         (when (eq terminal '$svg)
                           (list (numerics-option '$font "sans-serif")
                                 (numerics-option '$font_size *numerics-svg-letters*)))
                         (rest scene))))

(defparameter *numerics-wide-enough* 1000
  "For scenes side by side; a worksheet shrinks what is wider, and its letters with it.")

(defun numerics-size-for (size scenes)
  "The size of a picture of SCENES side by side, where one of them has SIZE."
  (destructuring-bind (width height) size
    (list (if (and (rest scenes) (< width *numerics-wide-enough*)) (round (* 3/2 width)) width)
          height)))

(defun numerics-run-draw (terminal size scenes)
  "Draws SCENES, (preamble . items) each, side by side."
  (numerics-with-own-draw
   (lambda ()
     (core-unhurried
      (lambda ()
        (let ((*standard-output* (make-broadcast-stream)))
          (mfuncall '$draw
                    (cons '(mlist simp) (loop for scene in scenes
                                               collect (numerics-scene-of-draw scene terminal)))
                    (numerics-option '$columns (length scenes))
                    (numerics-option '$terminal terminal)
                    (numerics-option '$dimensions
                                     (cons '(mlist simp) (numerics-size-for size scenes)))
                    (numerics-option '$file_name (numerics-temporary-path ""))
                    (numerics-option '$gnuplot_file_name (numerics-temporary ".gnuplot"))
                    (numerics-option '$data_file_name (numerics-temporary ".data")))))))))

(defun numerics-remove-temporary (types)
  (dolist (type types) (algebra-remove-file (numerics-temporary-path type))))

(defun numerics-draw-into-temporary (kind size scenes)
  "The path of the picture of KIND, which gnuplot made."
  (let ((path (numerics-temporary-path (if (eq kind '$svg) ".svg" ".png"))))
    (dolist (terminal (if (eq kind '$svg) '($svg) '($pngcairo $png)))
      (numerics-run-draw terminal size scenes)
      (when (numerics-filled-p path) (return-from numerics-draw-into-temporary path)))
    (core-error "gnuplot made no picture; is it installed, and `~a' its name? (gnuplot_command ~
                 tells another)" $gnuplot_command)))

(defun numerics-copy-bytes (from stream)
  (with-open-file (source (core-pathname from) :element-type '(unsigned-byte 8))
    (let ((block (make-array 65536 :element-type '(unsigned-byte 8))))
      (loop for count = (read-sequence block source)
            while (plusp count) do (write-sequence block stream :end count)))))

;;; Where it goes

(defparameter *numerics-picture-size* '(900 720))

(defun numerics-draw-file (file kind size scenes)
  (let ((made (numerics-draw-into-temporary kind size scenes)))
    (algebra-write-file file (lambda (stream) (numerics-copy-bytes made stream))
                        '(unsigned-byte 8))))

(defun numerics-worksheet-p () (and (fboundp '$wxdraw2d) (boundp '$wxplot_size)))

(defun numerics-draw-in-worksheet (scenes)
  "In wxMaxima, which takes the file and deletes it."
  (let* ((kind (if (and (boundp '$wxplot_usesvg) (symbol-value '$wxplot_usesvg)) '$svg '$png))
         (shown (numerics-temporary-path (if (eq kind '$svg) "_shown.svg" "_shown.png"))))
    (numerics-draw-file shown kind (cdr (symbol-value '$wxplot_size)) scenes)
    (core-afterwards
     (lambda () (mfuncall '$ldisp (list '(wxxmltag simp) shown "img" "del=\"yes\""))))))

(defun numerics-screen-p ()
  "Whether there may be a screen; gnuplot finds out whether there is."
  #+(or win32 windows darwin) t
  #-(or win32 windows darwin)
  (some (lambda (name) (plusp (length (core-environment name))))
        '("DISPLAY" "WAYLAND_DISPLAY" "GNUTERM")))

(defun numerics-draw-on-screen (scenes)
  "gnuplot leaves the name of its terminal in a file once it has one."
  (let ((mark (numerics-temporary-path ".shown")))
    (when (numerics-screen-p)
      (numerics-run-draw '$screen *numerics-picture-size*
                         (cons (cons (format nil "~aset print ~a~%print GPVAL_TERM~%unset print~%"
                                             (first (first scenes)) (numerics-gnuplot-text mark))
                                     (rest (first scenes)))
                               (rest scenes))))
    (unless (numerics-filled-p mark)
      (core-warn "no picture is shown: gnuplot, by the name `~a' (gnuplot_command), needs a ~
                  screen; give file = \"name.png\"" $gnuplot_command))))

(defun numerics-draw (picture &rest scenes)
  "The picture of SCENES side by side, each (preamble . items), items being options and objects of
draw; the name of its file, or nil."
  (let* ((file (numerics-picture-file picture))
         (*numerics-drawing* (format nil "dynarch~d_~d" (core-process-id)
                                     (incf *numerics-drawings*))))
    (numerics-load-draw)
    (unwind-protect
         (cond (file (numerics-draw-file file (numerics-picture-kind picture)
                                         *numerics-picture-size* scenes))
               ((numerics-worksheet-p) (numerics-draw-in-worksheet scenes))
               (t (numerics-draw-on-screen scenes)))
      (numerics-remove-temporary '(".gnuplot" ".data" ".png" ".svg" ".shown")))
    file))
