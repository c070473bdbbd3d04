# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
single = results . "/precision.csv"
links = results . "/links.csv"
set terminal svg size 1600,900 dynamic background "white" font "sans-serif,11"
set output out . "/precision.svg"
list = values(single, "shape", "", "")
exact = 3e-4  # where 0 is drawn
set multiplot title "What precision costs: models cut and built for an error of the distance"
set logscale xy
set xrange [2e-4:0.15]
set xtics ("exact" exact, "0.1 %%" 1e-3, "1 %%" 1e-2, "10 %%" 1e-1)
set xlabel "error of a pair's distance, over the radius"
do for [k = 1:3] {
  set lmargin at screen 0.06 + 0.27 * (k - 1)
  set rmargin at screen 0.28 + 0.27 * (k - 1)
  set tmargin at screen 0.92
  set bmargin at screen 0.56
  eval key_at(k)
  set ylabel word("bytes seconds nanoseconds", k)
  set title word("'resident bytes of a model' 'build time of a model' 'exact or approximate distance, 10.4 degrees per query'", k)
  plot for [i = 1:words(list)] single using (kept(strcol("shape") eq word(list, i), column("tolerance") == 0 ? exact : column("tolerance"))):(column(word("bytes build_seconds ns", k))) \
    with linespoints lc rgb word(colours, i) lw (i <= 3 ? 2.5 : 1) pt i ps 0.7 title word(list, i)
}
unset xrange
unset key
set lmargin at screen 0.06
set rmargin at screen 0.82
set tmargin at screen 0.45
set bmargin at screen 0.09
set xtics autofreq
set format x "%g"
set xrange [5e3:5e6]
set yrange [2e2:5e5]
set xlabel "resident bytes per link, were each its own model"
set ylabel "ns per query"
set title "1 000 robot links, each against its neighbours, turning by 2 degrees a frame"
label(method, tolerance) = method eq "swiftlet" ? method . (tolerance == 0 ? ", exact" : sprintf(", %g %%", 100 * tolerance)) : method
plot links using (column("bytes_per_link")):(column("ns")) with points pt 7 ps 1 lc rgb "#4477aa", \
     links using (column("bytes_per_link")):(column("ns")):(label(strcol("method"), column("tolerance"))) with labels left offset 1,0.3
unset multiplot
