;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The clock of SBCL: a timer that interrupts the call twenty times a second, without a thread of
;;; its own. It says what is being done every two seconds and stops what is late, or what has filled
;;; the memory. An interrupt may come anywhere: it looks at the frames of the stack first and waits
;;; while one of them cleans up or changes Maxima's lists. Look first at core-tick.

(in-package :maxima)

(defparameter *core-period* 1/20 "Seconds between two looks at the clock.")
(defparameter *core-patience* 10
  "Seconds that a stop waits for cleaning up to end, before it comes all the same.")

;;; What the interrupted function was at

(defparameter *core-undivided*
  '(mbind-doit munbind munlocal errlfun1 mset kill1 addf remf1 cntxt kcntxt contextmark
    $killcontext $supcontext $newcontext $activate $deactivate add2lnc mputprop mremprop
    core-restore core-free-memory core-change-global)
  "Functions that change lists of Maxima in several steps.")

(defparameter *core-undivided-lisp*
  '("PUTHASH" "REHASH" "REMHASH" "CLRHASH" "INTERN" "COMPILE" "OPEN" "CLOSE")
  "Parts of the names of functions of the Lisp that must not be left halfway: a file that was just
opened would stay so.")

(defparameter *core-writing* '("OUTPUT" "FD-SOUT" "WRITE-" "FRESH-LINE" "TERPRI" "BUFFER")
  "Parts of the names of functions that write to a stream.")

(defun core-frame-names ()
  "The names of the functions that run, the innermost first."
  (let ((names '()))
    (sb-debug::map-backtrace
     (lambda (frame) (push (sb-di:debug-fun-name (sb-di:frame-debug-fun frame)) names)))
    (nreverse names)))

(defun core-lisp-name-p (name parts)
  "Whether NAME is a symbol of the Lisp, not of Maxima, with one of PARTS in it."
  (and (symbolp name)
       (not (eq (symbol-package name) (find-package :maxima)))
       (some (lambda (part) (search part (symbol-name name))) parts)))

(defun core-cleanup-frame-p (name)
  "(flet \"CLEANUP-FUN-0\" :in ..), the cleanup of unwind-protect."
  (and (consp name)
       (member (car name) '(flet labels))
       (search "CLEANUP-FUN" (string (cadr name)))))

(defun core-undivided-frame-p (name)
  (or (member name *core-undivided*)
      (core-cleanup-frame-p name)
      (core-lisp-name-p name *core-undivided-lisp*)))

(defparameter *core-binding* '(mlambda mprog mdo mdoin mbind $ev)
  "Functions that bind Maxima's variables and note it in the step after: not to be stopped by
themselves, but in what they call.")

(defun core-interrupted-name (names)
  "The innermost function of Maxima's of NAMES that is not the clock's."
  (loop for name in names
        for own = (if (consp name) (second (member :in name)) name)
        when (and own (symbolp own) (eq (symbol-package own) (find-package :maxima))
                  (not (eql 0 (search "CORE-" (symbol-name own)))))
          return own))

(defun core-may-stop-p (seconds-late)
  "Whether nothing that runs has to be ended first."
  (or (> seconds-late *core-patience*)
      (let ((names (core-frame-names)))
        (and (notany #'core-undivided-frame-p names)
             (not (member (core-interrupted-name names) *core-binding*))))))

(defun core-may-write-p ()
  "Whether nothing that runs writes to a stream."
  (notany (lambda (name)
            (or (eq name 'core-say) (core-lisp-name-p name *core-writing*)))
          (core-frame-names)))

;;; Memory. SBCL collects by copying: small numbers that fill 47 % of the heap, lists that fill 72 %
;;; were seen to end it. At the first share below everything is collected once, which leaves what
;;; lives in an old generation that is not copied again; at the second share the call is stopped.

(defparameter *core-full-collection-share* 0.40)
(defparameter *core-memory-share* 0.58)
(defvar *core-collected* nil "True once everything was collected, until the share has fallen.")

(defvar *core-epoch* nil "The last collection that was looked at.")

(defun core-heap-share ()
  (/ (sb-kernel:dynamic-usage) (float (sb-ext:dynamic-space-size))))

(defun core-memory-text (share)
  (format nil "stopped~@[ while ~a~]: ~d % of Maxima's memory of ~d MB is in use~a"
          *core-doing* (round (* 100 share)) (round (sb-ext:dynamic-space-size) 1048576)
          (core-advised (core-number-advice) *core-cheaper* "start Maxima with a larger heap")))

(defun core-look-at-memory ()
  "Called after each collection."
  (let ((share (core-heap-share)))
    (cond ((< share *core-full-collection-share*) (setq *core-collected* nil))
          ((null *core-collected*)
           (setq *core-collected* t)
           (sb-ext:gc :full t))
          ((and (> share *core-memory-share*) (not *core-busy*) (core-may-stop-p 0))
           (core-stop (car *core-deadlines*) (core-memory-text share) 'core-full)))))

(defun core-after-collection ()
  "Looks once after each collection: its hook runs in this thread, or else the timer sees it."
  (unless (or (null *core-deadlines*) (eq *core-epoch* sb-kernel::*gc-epoch*))
    (setq *core-epoch* sb-kernel::*gc-epoch*)
    (core-look-at-memory)))

;;; The timer

(defun core-tick ()
  "What the timer does, in the thread of the call."
  (core-after-collection)
  (core-look #'core-may-stop-p #'core-may-write-p))

(defun core-with-alarm (seconds function)
  "Calls FUNCTION, as *core-alarm* says."
  (let ((*core-collected* nil) (*core-epoch* sb-kernel::*gc-epoch*)
        (timer (sb-ext:make-timer #'core-tick :name "dynarch")))
    (unwind-protect
         (progn (pushnew 'core-after-collection sb-ext:*after-gc-hooks*)
                (sb-ext:schedule-timer timer (max 1/1000 (min *core-period* (or seconds 1)))
                                       :repeat-interval *core-period*)
                (funcall function))
      (sb-ext:unschedule-timer timer)
      (setf sb-ext:*after-gc-hooks*
            (remove 'core-after-collection sb-ext:*after-gc-hooks*)))))

(setq *core-alarm* #'core-with-alarm
      *core-collector* (lambda () (sb-ext:gc :full t)))
