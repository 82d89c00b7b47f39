;;; SPDX-License-Identifier: GPL-2.0-or-later
;;; Records of plane_cells.mac and stability_map.mac.

(in-package :maxima)

(core-record analysis-column
  "A strip of a window between LEFT and RIGHT, rational, with x = PLACE in it; CELLS are those over
PLACE from below: a number in each, [about where, k] for the curve between two."
  left right place cells)

(core-record analysis-map
  "A WINDOW [[x, a, b], [y, c, d]], CURVES that are boundaries in it, the COLUMNS into which they
cut it, for each of these lists of NUMBERS of regions and VERDICTS of cells."
  window curves columns numbers verdicts)
