;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Elements of programs in messages, as a person writes them. See numerics-element-words first.

(in-package :maxima)

(eval-when (:compile-toplevel :load-toplevel :execute)
  (core-require "algebra/program_from_expressions" "algebra/program_nodes"
                "algebra/program_record" "algebra/size"))

(defparameter *numerics-longest-written-element* 12 "Operations.")

(defun numerics-element-words (element)
  "ELEMENT as a person writes it; nil where that is long."
  (when (<= (count-if-not #'algebra-input-p (algebra-live-nodes (list element)))
            *numerics-longest-written-element*)
    (labels ((written (e)
               (cond ((not (algebra-node-p e)) (if (numberp e) (algebra-maxima-rational e) e))
                     ((algebra-input-p e) (algebra-node-left e))
                     (t (algebra-written-node e #'written)))))
      (core-words (list (written element))))))

(defun numerics-value-text (element)
  (or (numerics-element-words element) "its value"))
