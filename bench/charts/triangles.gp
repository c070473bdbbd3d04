# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
file = results . "/triangles.csv"
set terminal svg size 1600,900 dynamic background "white" font "sans-serif,11"
set output out . "/triangles.svg"
set logscale x
set xlabel "triangles"
set xrange [150:300000]
set multiplot title "Cost against size, exact distance"
do for [row = 1:2] {
  at = row == 1 ? 10.4 : 400
  set tmargin at screen (row == 1 ? 0.92 : 0.45)
  set bmargin at screen (row == 1 ? 0.56 : 0.09)
  do for [k = 1:3] {
    shape = word(shapes, k)
    eval panel_left(k)
    eval key_at(k)
    list = values(file, "series", "question", "distance")
    set title sprintf("%s, %s", shape, row == 1 ? "10.4 degrees per query" : "random poses")
    plot for [i = 1:words(list)] file using (kept(strcol("shape") eq shape && strcol("question") eq "distance" && column("step") == at && \
        strcol("series") eq word(list, i), column("triangles"))):(column("ns")) \
      with linespoints lc rgb colour(word(list, i), i) lw width(word(list, i)) pt mark(word(list, i), i) ps 0.7 title word(list, i)
  }
}
unset multiplot
