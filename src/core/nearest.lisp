;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; The known name that a misspelt one is most likely meant to be, by the number of letters put in,
;;; left out, exchanged or swapped (Damerau and Levenshtein's distance).

(in-package :maxima)

(defun core-edit-distance (a b)
  "How many letters must be put in, left out, exchanged or swapped with their neighbour to make B
of A."
  (let* ((m (length a)) (n (length b)) (d (make-array (list (1+ m) (1+ n)) :initial-element 0)))
    (dotimes (i (1+ m)) (setf (aref d i 0) i))
    (dotimes (j (1+ n)) (setf (aref d 0 j) j))
    (loop for i from 1 to m
          do (loop for j from 1 to n
                   do (setf (aref d i j)
                            (min (1+ (aref d (1- i) j))
                                 (1+ (aref d i (1- j)))
                                 (+ (aref d (1- i) (1- j))
                                    (if (char-equal (char a (1- i)) (char b (1- j))) 0 1))
                                 (core-swap-distance a b d i j)))))
    (aref d m n)))

(defun core-swap-distance (a b d i j)
  "The distance by way of two letters that are swapped, or one too large to matter."
  (if (and (> i 1) (> j 1)
           (char-equal (char a (1- i)) (char b (- j 2)))
           (char-equal (char a (- i 2)) (char b (1- j))))
      (1+ (aref d (- i 2) (- j 2)))
      (+ i j)))

(defun core-nearest (name known)
  "The one of the KNOWN names that NAME is most likely meant to be, or nil. Long names only: 200
letters are no misprint."
  (when (<= (length name) 40)
    (let ((best nil) (least (1+ (max 1 (floor (length name) 3)))))
      (dolist (candidate known best)
        (let ((distance (core-edit-distance name candidate)))
          (when (< distance least)
            (setf best candidate least distance)))))))

(defun $core_nearest (name known)
  "The one of the Maxima list KNOWN that the symbol NAME is most likely meant to be, or false. To a
single letter every other one is as near."
  (let* ((word (core-spelling name))
         (near (and (> (length word) 1)
                    (core-nearest word (mapcar #'core-spelling (cdr known))))))
    (and near (find near (cdr known) :key #'core-spelling :test #'string=))))
