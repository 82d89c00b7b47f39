;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Netlists that are not whole, for rtest_circuits_netlists.mac: whatever stands in a file, reading
;;; it ends in an archive or in a sentence, never in a fault of the Lisp beneath.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "archive/call" "archive/read_netlist"))

(defun $netlist_archive (lines)
  "The archive, as text, of the netlist of LINES, or the sentence in which reading it ends."
  (netlist-answer (format nil "~{~a~%~}" (cdr lines))))

(defun netlist-answer (text)
  (multiple-value-bind (archive trouble)
      (let ((*core-function* nil) (*core-warnings* '()) (*standard-output* (make-broadcast-stream)))
        (core-caught (lambda () (archive-net-archive-text "test.cir" (archive-simple-text text)))))
    (or trouble archive)))

(defun $netlist_said (lines)
  "The warnings with which the netlist of LINES is read, one after the other."
  (let ((*core-function* nil) (*core-warnings* '()) (*standard-output* (make-broadcast-stream)))
    (core-caught (lambda () (archive-net-archive-text
                             "test.cir" (archive-simple-text (format nil "~{~a~%~}" (cdr lines))))))
    (format nil "~{~a~^; ~}" (reverse *core-warnings*))))

(defun $netlist_foreign_words ()
  "Three letters beyond ASCII, the first of a title too."
  (archive-text-of-bytes
   (coerce '(195 150 108 32 71 114 195 182 195 159 101 32 226 132 166) 'archive-bytes) "test"))

(defun netlist-fault-p (answer)
  "Whether ANSWER is neither an archive nor a sentence with its line or file."
  (not (or (eql 0 (search "dynarch = 1" answer))
           (eql 0 (search "test.cir" answer)))))

(defun $netlist_faults_of_cuts (lines)
  "Faults of the netlist LINES cut behind each of its characters."
  (let ((text (format nil "~{~a~%~}" (cdr lines))))
    (cons '(mlist) (loop for end from 1 to (length text)
                         for answer = (netlist-answer (subseq text 0 end))
                         when (netlist-fault-p answer) collect answer))))

(defun $netlist_faults_of_changes (lines count seed)
  "Faults of the netlist LINES, COUNT times with some of its characters exchanged or doubled."
  (let ((text (format nil "~{~a~%~}" (cdr lines)))
        (letters "rlcvixkdbefgh019.+-*/^(){}=,'<>?: 	;$uinmeg
%\"#")
        (state seed))
    (flet ((next (n) (mod (ash (setq state (mod (+ (* 1103515245 state) 12345) (ash 1 31))) -12)
                          n)))
      (cons '(mlist)
            (loop repeat count
                  for changed = (copy-seq text)
                  do (loop repeat (1+ (next 4))
                           do (setf (char changed (next (length changed)))
                                    (char letters (next (length letters)))))
                  when (netlist-fault-p (netlist-answer changed))
                    collect (list '(mlist) (netlist-answer changed) changed))))))

;;; As an adversary

(defparameter *netlist-whole*
  '((mlist) "a title" ".param R0=1k C0={2*1u}" "V1 in 0 DC 1 AC 1 SIN(0 {R0/1k} 1k 1m 2 30)"
    "R1 IN a/b {R0*2}" "C1 a/b 0 'C0' IC=0.5" "L1 a/b" "+ 0_1 10mH ; comment" "* a comment"
    "r2 0_1 gnd 4.7MEGohm $ another" "D1 a/b 0 DM 2" ".model dm D(IS=1e-14 N=1.5)"
    "Xa in out divider params: ra=5k" "B1 out 0 I={V(out)*V(out)*V(out)/1MEG + pow(v(out),2)}"
    "B2 out 0 I={time<1m ? 0 : (time<=2m ? u(time) : 1)}" "Cx out 0 1n" "L2 out 0 1m" "K1 L1 L2 0.9" "E1 p 0 in out 2" "Rp p 0 1" "F1 q 0 V1 2" "Rq q 0 1"
    "I1 q 0 PULSE(0 1 1m 1u 1u 2m)" "I2 q 0 PWL(0 0 1m {R0/1k})" "I3 q 0 EXP(0 1 0 1m 2m 1m)"
    ".subckt divider p q params: ra=1k rb={2*ra}" "Rtop p q {ra}" "Rbot q 0 rb" ".ends"
    ".ic v(q)=1" ".tran 1u 1m uic" ".print tran v(out)" ".end"))

(defun $fuzz_netlists (count seed) ($netlist_faults_of_changes *netlist-whole* count seed))

;;; Files and runs

(defun $netlist_description (lines)
  "The description that the netlist of LINES becomes."
  (archive-description (archive-of-text "test" ($netlist_archive lines))))

(defvar *netlist-number* (core-process-id) "What tells this run's files from those of others.")

(defun $netlist_file (type)
  (format nil "~a/netlist-test-~d.~a" $maxima_tempdir *netlist-number* type))

(defun $netlist_read (file)
  "The description in the archive FILE, of a description list too."
  (archive-description (if (stringp file) (archive-open-system file) (archive-open-list file))))

(defun $netlist_values (file) ($core_get ($netlist_read file) '$values '((mlist))))

(defun netlist-shell (control &rest arguments)
  (netlist-status (apply #'format nil control arguments)))

(defun $netlist_ngspice (cir vectors)
  "The rows [t, v, t, v, ..] of 101 points of the run that the netlist CIR states, with a relative
tolerance of 1e-7 and a tenth of its largest step; false where ngspice is not installed."
  (when (zerop (netlist-shell "command -v ngspice >/dev/null 2>&1"))
    (let ((run ($netlist_file "run.cir")) (out ($netlist_file "out")) (names (cdr vectors)))
      (netlist-shell "sed -e '/^.tran/!d' -e 's/^.tran \\([^ ]*\\) \\([^ ]*\\).*/\\1 \\2/' ~a > ~a"
                     cir out)
      (with-open-file (from out)
        (let* ((*read-default-float-format* 'double-float)
               (step (* 1d0 (read from))) (stop (* 1d0 (read from))))
          (netlist-shell "grep -v '^.tran\\|^.end' ~a > ~a" cir run)
          (with-open-file (to run :direction :output :if-exists :append)
            (format to ".tran ~a ~a 0 ~a uic~%.options reltol=1e-7 abstol=1e-14 vntol=1e-10~%~
                        .control~%run~%linearize~{ ~a~}~%wrdata ~a~{ ~a~}~%quit~%.endc~%.end~%"
                    (netlist-plain step) (netlist-plain stop) (netlist-plain (/ step 10)) names
                    out names))))
      (netlist-shell "timeout 200 ngspice -b ~a >/dev/null 2>&1 </dev/null" run)
      (with-open-file (from out)
        (let ((*read-default-float-format* 'double-float) (width (* 2 (length names))))
          (cons '(mlist)
                (loop for row from 0 to 1000
                      for numbers = (loop repeat width collect (* 1d0 (read from)))
                      when (zerop (mod row 10)) collect (cons '(mlist) numbers))))))))

(defun netlist-plain (x) (substitute #\e #\d (format nil "~,,,,,,'ee" x)))

(defun netlist-status (command)
  "The status in which the shell leaves COMMAND."
  #+sbcl (sb-ext:process-exit-code (sb-ext:run-program "/bin/sh" (list "-c" command)))
  #-sbcl (core-shell-status command))
