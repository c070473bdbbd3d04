# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# Steps and plane tests per query against motion: deterministic, unlike times. Only what counts both.
load "_common.gp"
file = results . "/orbit.csv"
set terminal svg size 1600,900 dynamic background "white" font "sans-serif,11"
set output out . "/work.svg"
eval motion_axis
set multiplot title "Work per query, exact distance, 2000 triangles, R = 2 r"
do for [row = 1:2] {
  what = word("steps plane_tests", row)
  set tmargin at screen (row == 1 ? 0.92 : 0.44)
  set bmargin at screen (row == 1 ? 0.58 : 0.10)
  do for [k = 1:3] {
    shape = word(shapes, k)
    eval panel_left(k)
    eval key_at(k)
    all = values(file, "series", "question", "distance")
    list = ""
    do for [i = 1:words(all)] { s = word(all, i); if (strstrt(s, "swiftlet") == 1 || s eq "vclip" || s eq "plain") { list = list . " \"" . s . "\"" } }
    set title sprintf("%s, %s", shape, row == 1 ? "steps" : "plane tests")
    set ylabel row == 1 ? "steps per query" : "plane tests per query"
    plot for [i = 1:words(list)] file using (kept(strcol("shape") eq shape && strcol("question") eq "distance" && \
        strcol("series") eq word(list, i), column("step"))):(column(what)) \
      with linespoints lc rgb colour(word(list, i), i) lw width(word(list, i)) pt mark(word(list, i), i) ps 0.6 title word(list, i)
  }
}
unset multiplot
