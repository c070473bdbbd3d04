# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# The claim of the paper's section 6.5: does the approximate distance lie between intersection and exact distance?
load "_common.gp"
file = results . "/orbit.csv"
set terminal svg size 1600,470 dynamic background "white" font "sans-serif,11"
set output out . "/approximate.svg"
eval motion_axis
series(i) = word("swiftlet swiftlet swiftlet#~0.01 swiftlet#~0.1", i)
asked(i) = word("intersects distance distance distance", i)
name(i) = word("intersection exact error#<=#0.01#r error#<=#0.1#r", i)
spaced(s) = strstrt(s, "#") > 0 ? spaced(s[1:strstrt(s, "#") - 1] . " " . s[strstrt(s, "#") + 1:]) : s
set multiplot title "Section 6.5: intersection, approximate and exact distance, swiftlet, 2000 triangles, R = 2 r"
do for [k = 1:3] {
  shape = word(shapes, k)
  eval panel_left(k)
  eval key_at(k)
  set title shape
  plot for [i = 1:4] file using (kept(strcol("shape") eq shape && strcol("question") eq asked(i) && \
      strcol("series") eq spaced(series(i)), column("step"))):(column("ns")) \
    with linespoints lc rgb word(colours, i) lw 2 pt i ps 0.6 title spaced(name(i))
  unset ylabel
}
unset multiplot
