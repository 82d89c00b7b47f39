;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Every call ends: it has a deadline, and so may have each method inside it. The watch throws to
;;; the call, so that nothing in between (errcatch, errset, core-attempt, ignore-errors) takes the
;;; stop for an ordinary error. Who looks at the clock: alarm.lisp, a timer, on SBCL; on other Lisps
;;; the guards, by core-watch. Look first at core-watched and core-within.

(in-package :maxima)

(defvar *core-deadlines* '()
  "Deadlines of the calls and methods that run, the innermost first.")
(defvar *core-limit* 600 "Seconds that a call may take when it does not say.")
(defvar *core-cheaper* nil "What else would be cheaper than the call, as a phrase; or nil.")
(defvar *core-busy* nil "True while the watch has to wait: parts are loaded, a file is written.")
(defvar *core-stopped* nil "The sentence of the last stop.")
(defvar *core-terminal* nil "The stream on which the outermost call began.")
(defvar *core-call-began* nil "Internal real time at which the outermost call began.")
(defvar *core-next-line* nil "Internal real time of the next line of progress.")

(defstruct core-deadline
  at      ; internal real time, or nil: never
  work    ; the same of the processor: what is found so does not depend on what else runs
  began)

(defun core-work-time ()
  "Internal time of the processor; where the Lisp has none (GCL's stands still), of the wall."
  #+sbcl (get-internal-run-time) #-sbcl (get-internal-real-time))

(defun core-new-deadline (seconds &optional seconds-of-work)
  "A deadline SECONDS from now, or after so many SECONDS-OF-WORK of the processor; nil is none."
  (flet ((after (now seconds)
           (and seconds (+ now (ceiling (* seconds internal-time-units-per-second))))))
    (let ((now (get-internal-real-time)))
      (make-core-deadline :began now :at (after now seconds)
                          :work (after (core-work-time) seconds-of-work)))))

(defun core-seconds-since (time)
  (/ (- (get-internal-real-time) time) internal-time-units-per-second))

(defun core-least (&rest numbers)
  "The least of those that are not nil, or nil."
  (let ((there (remove nil numbers)))
    (and there (reduce #'min there))))

(defun core-seconds-left ()
  "Seconds until the first of the deadlines, on the wall or of work, or nil where there is none."
  (flet ((left (clock now)
           (let ((first (apply #'core-least (mapcar clock *core-deadlines*))))
             (and first (max 0 (/ (- first now) internal-time-units-per-second))))))
    (core-least (left #'core-deadline-at (get-internal-real-time))
                (left #'core-deadline-work (core-work-time)))))

(defun core-passed-deadline ()
  "The outermost deadline that has passed, or nil."
  (find-if (lambda (deadline) (<= 0 (core-seconds-late deadline))) *core-deadlines* :from-end t))

(defun core-seconds-late (deadline)
  "Negative while it has not passed."
  (flet ((late (now time) (if time (/ (- now time) internal-time-units-per-second) -1)))
    (max (late (get-internal-real-time) (core-deadline-at deadline))
         (late (core-work-time) (core-deadline-work deadline)))))

(defun core-postpone (ticks work)
  "All deadlines come TICKS later, or so many of WORK, as if what they are for had begun later."
  (dolist (deadline *core-deadlines*)
    (incf (core-deadline-began deadline) ticks)
    (when (core-deadline-at deadline) (incf (core-deadline-at deadline) ticks))
    (when (core-deadline-work deadline) (incf (core-deadline-work deadline) work))))

(defun core-clock ()
  "Seconds of the clock on the wall, to a microsecond where the Lisp has that; internal real time
may tick in 4 ms, too coarse for sums of what is short."
  #+sbcl (multiple-value-bind (seconds microseconds) (sb-ext:get-time-of-day)
           (+ seconds (* 1d-6 microseconds)))
  #-sbcl (/ (get-internal-real-time) (coerce internal-time-units-per-second 'double-float)))

(defvar *core-uncounted-seconds* 0d0 "Time that was not counted so far.")

(defun core-unhurried (function)
  "Calls FUNCTION, which the watch neither stops nor counts. A part loads others: only the outermost
such call counts, or deadlines would come later by their depth."
  (if *core-busy*
      (funcall function)
      (let ((began (get-internal-real-time)) (work (core-work-time)) (clock (core-clock)))
        (unwind-protect (let ((*core-busy* t)) (funcall function))
          (incf *core-uncounted-seconds* (- (core-clock) clock))
          (core-postpone (- (get-internal-real-time) began) (- (core-work-time) work))))))

(setq *core-loading* #'core-unhurried)

(defun core-next-line-after (now)
  (setq *core-next-line* (+ now (* 2 internal-time-units-per-second))))

(defun core-waiting (function)
  "Calls FUNCTION, which waits for the person: his time is none of the call's, and the two seconds
to the next line of progress begin anew."
  (let ((began (get-internal-real-time)))
    (core-unhurried
     (lambda ()
       (unwind-protect (funcall function)
         (when *core-deadlines*
           (let ((now (get-internal-real-time)))
             (incf *core-call-began* (- now began))
             (core-next-line-after now))))))))

;;; The sentence of a stop

(defun core-rounded (seconds)
  "SECONDS as a person says them."
  (if (< seconds 10) (format nil "~,2f" seconds) (format nil "~d" (round seconds))))

(defun core-late-text ()
  "The time is that since the call began, also where work within it had a share of the limit."
  (format nil "stopped after ~a s, the limit of time~@[, while ~a~]~a"
          (core-rounded (core-seconds-since (core-deadline-began (first (last *core-deadlines*)))))
          *core-doing*
          (core-advised (core-number-advice) *core-cheaper*
                        "give more time by limit = seconds (0: none)")))

(defun core-stop (deadline text &optional (why 'core-late))
  "Ends what DEADLINE is for; WHY is core-late, or core-full where it is for memory."
  (setq *core-stopped* text)
  (throw deadline why))

(defun core-say-progress (now)
  "One line on the stream on which the call began, wherever output goes at the moment."
  (core-next-line-after now)
  (let ((*standard-output* *core-terminal*))
    (core-say (format nil "~@[~a: ~]~@[~a, ~]~d s" *core-function* *core-doing*
                      (round (core-seconds-since *core-call-began*))))))

(defun core-look (may-stop-p may-write-p)
  "Stops what is late, or says what is being done when a line is due: where the functions allow it."
  (when (and *core-deadlines* (not *core-busy*))
    (let ((now (get-internal-real-time)) (late (core-passed-deadline)))
      (cond ((null late)
             (when (and *core-progress* (>= now *core-next-line*) (funcall may-write-p))
               (core-say-progress now)))
            ((funcall may-stop-p (core-seconds-late late))
             (core-stop late (core-late-text)))))))

(defun core-watch ()
  "A look at the clock; called at guards, where the work may stop."
  (core-look (constantly t) (constantly t)))

(defun core-progress (control &rest arguments)
  "Tells the watch what is being done: it stands in the lines of progress, one every two seconds."
  (setq *core-doing* (apply #'format nil control arguments))
  (core-watch))

(defun $core_progress (&rest items)
  (core-progress "~a" (core-words items))
  '$done)

;;; Work with a deadline. What a stop leaves behind is put in order here: Maxima's bindings, and
;;; contexts that were made but not yet guarded.

(defun core-restore (bindings context contexts)
  (errlfun1 bindings)
  (dolist (name (cdr $contexts))
    (unless (member name contexts) (mfuncall '$killcontext name)))
  (unless (eq $context context) (mset '$context context)))

(defun core-until (deadline function)
  "Two values: what FUNCTION returns and nil, or nil and the sentence of the stop."
  (let* ((bindings (cons bindlist loclist)) (context $context) (contexts (cdr $contexts))
         (result (catch deadline
                   (let ((*core-deadlines* (cons deadline *core-deadlines*)))
                     (list (funcall function))))))
    (cond ((consp result) (values (car result) nil))
          (t (core-restore bindings context contexts)
             (when (eq result 'core-full) (core-free-memory))
             (values nil *core-stopped*)))))

(defvar *core-alarm* (lambda (seconds function) (declare (ignore seconds)) (funcall function))
  "Calls a function under a clock that looks at the deadlines by itself, first after SECONDS or
earlier.")
(defvar *core-collector* (lambda ()) "Frees the memory of what was stopped.")

(defun core-free-memory ()
  (setq *core-too-large* t)
  (funcall *core-collector*))

(defun core-call-outermost (seconds function)
  (let* ((*core-terminal* *standard-output*) (*core-doing* nil)
         (*core-call-began* (get-internal-real-time))
         (*core-next-line* (+ *core-call-began* (* 2 internal-time-units-per-second))))
    (funcall *core-alarm* seconds function)))

(defun core-timed (seconds function &optional seconds-of-work)
  "As core-until, SECONDS from now or after so many SECONDS-OF-WORK; nil is no limit. Inside a call
its deadline counts too."
  (let ((deadline (core-new-deadline seconds seconds-of-work)))
    (flet ((timed () (core-until deadline function)))
      (if *core-deadlines* (timed) (core-call-outermost seconds #'timed)))))

(defun core-watched (seconds function)
  "What FUNCTION returns; an error after SECONDS, nil for no limit."
  (multiple-value-bind (value stop) (core-timed seconds function)
    (if stop (core-signal stop) value)))

(defvar *core-shares-ended* 0 "How often a share of the time was not enough.")

(defun $core_shares_ended () *core-shares-ended*)

(defun core-timed-share (seconds function &optional seconds-of-work)
  "As core-timed; it is counted where that was not enough."
  (multiple-value-bind (value stop) (core-timed seconds function seconds-of-work)
    (when stop (incf *core-shares-ended*))
    (values value stop)))

(defparameter *core-busy-factor* 8
  "How many times its share of work what has a share may take on the clock on the wall.")

(defun core-share (time left)
  "Seconds: TIME, or from 1 down that share of the time LEFT, which is not less than two seconds
where these are no more than half; nil where there is no limit."
  (cond ((> time 1) time)
        (left (max (* time left) (min 2 (/ left 2))))))

(defun core-within-at-most (seconds time function)
  "As core-timed: FUNCTION has TIME seconds, or from 1 down that share of the time left, and never
more than SECONDS, nil for as many as it likes. These are seconds of the processor, for what is
found must not depend on what else runs; on the wall they may be more, but leave half of what
others have."
  (let* ((left (core-seconds-left)) (share (core-share time left)))
    (core-timed-share (core-least (and share (* *core-busy-factor* share))
                                  (and share left (/ (+ share left) 2)))
                      function
                      (core-least seconds share))))

(defun core-within-on-the-wall (time function)
  "As core-within, TIME being one of the clock on the wall: for what must be kept in time."
  (core-timed-share (core-share time (core-seconds-left)) function))

(defun core-within (time function)
  (core-within-at-most nil time function))

(defun core-time (e)
  "E as a positive number."
  (cond ((and (realp e) (plusp e)) e)
        ((and (ratnump e) (plusp (cadr e))) (/ (cadr e) (caddr e)))
        (t (core-error "a time or a share of it was expected, found ~a" (core-words (list e))))))

(defmspec $core_within (form)
  ;; core_within(time, e): [value of e], or [] when the time of work is up. From 1 down it is a
  ;; share of the time that the call has left. Errors are not caught.
  (destructuring-bind (time e) (cdr form)
    (core-in-time #'core-within (core-time (meval time)) (lambda () (meval e)))))

(defmspec $core_within_work (form)
  ;; core_within_work(seconds, e): the same, a tenth of the time left at most.
  (destructuring-bind (seconds e) (cdr form)
    (core-in-time #'core-within-at-most (core-time (meval seconds)) 1/10 (lambda () (meval e)))))

(defun core-in-time (within &rest arguments)
  (multiple-value-bind (value stop) (apply within arguments)
    (if stop '((mlist simp)) (list '(mlist simp) value))))
