# SPDX-License-Identifier: GPL-2.0-or-later
# CPU seconds over n; called by bench/circuits/run, which sets the folder `results` and the picture `output`.
set terminal svg size 760,480 dynamic background "white"
set output picture
set logscale xy
set format "10^{%T}"
set grid
set key outside below
set xlabel "n: sections of a ladder, branches of a graph"
set ylabel "seconds of CPU"
files = "lcapy.ladder dynarch.ladder dynarch.branches dynarch.graph"
names = "'Lcapy, ladder' 'StateEquations, ladder' 'BranchQuantities, ladder' 'CheckCircuit, graph'"
plot for [i = 1:words(files)] results."/".word(files, i) using 1:2 with linespoints title word(names, i), \
  [10:100000] 1e-4*x with lines dashtype 2 linecolor "gray" title "linear"
