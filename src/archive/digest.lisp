;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; SHA-256 of a text's UTF-8 bytes (FIPS 180-4), in portable Lisp.
;;; The digest tells a result that fits its archive from one that does not, or was edited by hand.
;;; Words are 32 bits wide; every sum is cut to 32 bits where it is made: all are fixnums.
;;; Look first at archive-sha-256-block!: one block of 64 bytes into the eight words of the state.

(in-package :maxima)

(deftype archive-word () '(unsigned-byte 32))
(deftype archive-words () '(simple-array (unsigned-byte 32) (*)))
(deftype archive-octets () '(simple-array (unsigned-byte 8) (*)))

;; Bytes of a text

(defun archive-utf8 (text)
  "The UTF-8 bytes of TEXT. Where a Lisp's characters are bytes they are taken as they stand."
  (let ((bytes (make-array (* 4 (length text)) :element-type '(unsigned-byte 8)))
        (n 0))
    (declare (type fixnum n) (type archive-octets bytes))
    (flet ((put (b) (setf (aref bytes n) b) (incf n)))
      (loop for c across (the string text)
            for code fixnum = (char-code c)
            do (if (or (< code 128) (<= char-code-limit 256))
                   (put code)
                   (dolist (b (archive-utf8-octets code)) (put b)))))
    (subseq bytes 0 n)))

(defun archive-utf8-octets (code)
  "The two to four bytes of a code point beyond ASCII, as a list."
  (flet ((tail (shift) (logior #x80 (logand #x3F (ash code (- shift))))))
    (cond ((< code #x800) (list (logior #xC0 (ash code -6)) (tail 0)))
          ((< code #x10000) (list (logior #xE0 (ash code -12)) (tail 6) (tail 0)))
          (t (list (logior #xF0 (ash code -18)) (tail 12) (tail 6) (tail 0))))))

;; Constants: fractional parts of cube and square roots of the first primes, computed exactly

(defun archive-primes (count)
  "The first COUNT primes."
  (loop with primes = '()
        for n from 2
        until (= (length primes) count)
        do (when (notany (lambda (p) (zerop (mod n p))) primes)
             (setf primes (append primes (list n))))
        finally (return primes)))

(defun archive-integer-root (n degree)
  "The largest integer whose DEGREE-th power does not exceed N."
  (let ((low 0) (high (ash 1 (1+ (ceiling (integer-length n) degree)))))
    (loop while (> (- high low) 1)
          do (let ((middle (ash (+ low high) -1)))
               (if (<= (expt middle degree) n) (setf low middle) (setf high middle))))
    low))

(defun archive-root-words (count degree)
  "32 bits after the point of the DEGREE-th roots of the first COUNT primes."
  (let ((words (mapcar (lambda (p)
                         (logand #xFFFFFFFF (archive-integer-root (ash p (* 32 degree)) degree)))
                       (archive-primes count))))
    (make-array count :element-type '(unsigned-byte 32) :initial-contents words)))

(defvar *archive-sha-256-constants* (archive-root-words 64 3))
(defvar *archive-sha-256-start* (archive-root-words 8 2))

;; The compression function

(defmacro archive-word+ (&rest terms)
  "Sum of words, cut to 32 bits."
  `(logand #xFFFFFFFF (the (unsigned-byte 40) (+ ,@terms))))

(defmacro archive-rotate (word bits)
  "WORD turned right by BITS."
  `(logior (ash (the archive-word ,word) ,(- bits))
           (ash (logand (the archive-word ,word) ,(1- (ash 1 bits))) ,(- 32 bits))))

(defun archive-sha-256-schedule! (schedule bytes start)
  "Fill the 64 words of SCHEDULE from the block of BYTES that begins at START."
  (declare (type archive-words schedule) (type archive-octets bytes) (type fixnum start)
           (optimize (speed 3) (safety 1)))
  (loop for k of-type fixnum below 16
        for j of-type fixnum = (+ start (* 4 k))
        do (setf (aref schedule k)
                 (logior (ash (aref bytes j) 24) (ash (aref bytes (+ j 1)) 16)
                         (ash (aref bytes (+ j 2)) 8) (aref bytes (+ j 3)))))
  (loop for k of-type fixnum from 16 below 64
        do (let ((w15 (aref schedule (- k 15))) (w2 (aref schedule (- k 2))))
             (declare (type archive-word w15 w2))
             (setf (aref schedule k)
                   (archive-word+
                    (aref schedule (- k 16))
                    (logxor (archive-rotate w15 7) (archive-rotate w15 18) (ash w15 -3))
                    (aref schedule (- k 7))
                    (logxor (archive-rotate w2 17) (archive-rotate w2 19) (ash w2 -10)))))))

(defun archive-sha-256-block! (state schedule constants)
  "Sixty-four rounds over one block's SCHEDULE, added to STATE."
  (declare (type archive-words state schedule constants) (optimize (speed 3) (safety 1)))
  (let ((a (aref state 0)) (b (aref state 1)) (c (aref state 2)) (d (aref state 3))
        (e (aref state 4)) (f (aref state 5)) (g (aref state 6)) (h (aref state 7)))
    (declare (type archive-word a b c d e f g h))
    (dotimes (k 64)
      (let* ((choice (logxor (logand e f) (logand (logxor e #xFFFFFFFF) g)))
             (majority (logxor (logand a b) (logand a c) (logand b c)))
             (t1 (archive-word+ h choice (aref constants k) (aref schedule k)
                                (logxor (archive-rotate e 6) (archive-rotate e 11)
                                        (archive-rotate e 25))))
             (t2 (archive-word+ majority
                                (logxor (archive-rotate a 2) (archive-rotate a 13)
                                        (archive-rotate a 22)))))
        (declare (type archive-word choice majority t1 t2))
        (setf h g  g f  f e  e (archive-word+ d t1)
              d c  c b  b a  a (archive-word+ t1 t2))))
    (loop for x of-type archive-word in (list a b c d e f g h)
          for k of-type fixnum from 0
          do (setf (aref state k) (archive-word+ (aref state k) x)))))

;; The digest

(defun archive-sha-256-padded (bytes)
  "BYTES, a bit 1, zeros, and the length in bits, to a multiple of 64 bytes."
  (let* ((n (length bytes))
         (padded (make-array (* 64 (ceiling (+ n 9) 64))
                             :element-type '(unsigned-byte 8) :initial-element 0)))
    (replace padded bytes)
    (setf (aref padded n) #x80)
    (dotimes (k 8 padded)
      (setf (aref padded (- (length padded) 1 k)) (logand #xFF (ash (* 8 n) (* -8 k)))))))

(defun archive-sha-256 (bytes)
  "The digest of a vector of bytes: 64 hexadecimal digits."
  (let ((state (copy-seq *archive-sha-256-start*))
        (schedule (make-array 64 :element-type '(unsigned-byte 32)))
        (padded (archive-sha-256-padded bytes)))
    (loop for start from 0 below (length padded) by 64
          do (archive-sha-256-schedule! schedule padded start)
             (archive-sha-256-block! state schedule *archive-sha-256-constants*))
    (string-downcase (format nil "~{~8,'0X~}" (coerce state 'list)))))

(defun archive-digest (text)
  "`sha256:` and the digest of a text, as it stands in an archive."
  (concatenate 'string "sha256:" (archive-sha-256 (archive-utf8 text))))
