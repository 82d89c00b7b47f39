# SPDX-License-Identifier: GPL-2.0-or-later
# Milliseconds over the margin, right or wrong marked; called by bench/verdicts/run, which sets the folder `results` and the
# list `here` of the contenders that took part. Files: PANEL.CONTENDER with place, milliseconds, outcome (1 right, 0 wrong, 2 none).
set terminal svg size 1500,800 dynamic background "white" font "sans,12"
set output results."/verdicts.svg"
set logscale y
set format y "10^{%T}"
set grid ytics lc rgb "#dddddd"
set xrange [-6.8:6.8]
set yrange [0.005:5000]
set xtics ("-1e-6" -6, "-1e-12" -4, "-1e-18" -2, "1e-18" 2, "1e-12" 4, "1e-6" 6) rotate by -35
set arrow 1 from 0, graph 0 to 0, graph 1 nohead dt 3 lc rgb "#888888"
panels = "p6 p10 p20 p30 p40 pair named"
titles = "'degree 6' 'degree 10' 'degree 20' 'degree 30' 'degree 40' 'gyroscopic pair' 'eleven systems with a name'"
colours = "#999999 #d95f02 #e6ab02 #7570b3 #a6761d #1f78b4 #e7298a #1b9e77 #005a32"
names = "'eigenvalues, doubles' 'roots, doubles' 'Routh, doubles' 'roots, 20 digits' 'Routh, 20 digits' 'roots, 40 digits' 'Routh, 40 digits' 'exact, polynomial' 'exact, system'"
file(p, c) = results."/".word(panels, p).".".c
only(x, wanted) = (x == wanted) ? 1 : NaN
set multiplot layout 2,4
do for [p = 1:7] {
  set title word(titles, p)
  if (p == 1 || p == 5) { set ylabel "milliseconds" } else { unset ylabel }
  unset key
  plot for [c in here] file(p, c) using 1:2 with lines lc rgb word(colours, int(c)) lw 1, \
       for [c in here] file(p, c) using 1:($2*only($3, 1)) with points pt 7 ps 0.6 lc rgb word(colours, int(c)), \
       for [c in here] file(p, c) using 1:($2*only($3, 2)) with points pt 6 ps 0.8 lc rgb word(colours, int(c)), \
       for [c in here] file(p, c) using 1:($2*only($3, 0)) with points pt 2 ps 1.1 lw 2.5 lc rgb word(colours, int(c))
}
unset title; unset border; unset tics; unset ylabel; unset arrow 1; unset grid; unset logscale y
set xrange [0:1]; set yrange [0:1]
set key at graph 0.02, graph 0.98 left top reverse Left samplen 2 spacing 1.3
plot for [c in here] NaN with lines lw 3 lc rgb word(colours, int(c)) title word(names, int(c)), \
     NaN with points pt 7 ps 0.8 lc rgb "black" title "right (all of them)", \
     NaN with points pt 6 ps 0.8 lc rgb "black" title "no verdict", \
     NaN with points pt 2 ps 1.1 lw 2.5 lc rgb "black" title "wrong (one at least)"
unset multiplot
