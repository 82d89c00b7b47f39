# SPDX-License-Identifier: GPL-2.0-or-later
# CPU seconds over n; called by bench/peers/run, which sets the folder `results`.
set terminal svg size 1100,480 dynamic background "white"
set output results."/bench.svg"
set logscale y
set format y "10^{%T}"
set grid
set key outside below
set xlabel "n"
set ylabel "seconds of CPU"
peers = "sympy_lagrange sympy_kane symengine_lagrange linmodel_factored linmodel_canonical casadi_program linmodel_program"
names = "LagrangesMethod KanesMethod symengine factored canonical CasADi program"
set multiplot layout 1,2
do for [system in "planar spatial"] {
  set title system." chain"
  set xtics 0, 1 + (system eq "planar")
  plot for [i = 1:words(peers)] results."/".word(peers, i).".".system using 1:2 with linespoints title word(names, i)
}
unset multiplot
