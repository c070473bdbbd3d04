# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# Time against motion, a panel per shape: the series of one file whose name holds `only`, and those in `always`; beside each
# the number of levels, where there are several. The figures set `name`, `picture`, `asked`, `only`, `always`, `title_text`.
file = sprintf("%s/%s.csv", results, name)
set terminal svg size 1600,470 dynamic background "white" font "sans-serif,11"
set output sprintf("%s/%s.svg", out, picture)
eval motion_axis
meant(series) = only eq "" || strstrt(series, only) > 0 || strstrt(always, "|" . series . "|") > 0
levels(series) = first(file, "levels", series) + 0
label(series) = levels(series) > 1 ? sprintf("%s (%d levels)", series, levels(series)) : series
set multiplot title title_text
do for [k = 1:3] {
  shape = word(shapes, k)
  eval panel_left(k)
  eval key_at(k)
  all = values(file, "series", "question", asked)
  list = ""
  do for [i = 1:words(all)] { if (meant(word(all, i))) { list = list . " \"" . word(all, i) . "\"" } }
  set title shape
  plot for [i = 1:words(list)] file using \
    (kept(strcol("shape") eq shape && strcol("question") eq asked && strcol("series") eq word(list, i), column("step"))):(column("ns")) \
    with linespoints lc rgb colour(word(list, i), i) lw width(word(list, i)) pt mark(word(list, i), i) ps 0.6 title label(word(list, i)), \
    file using (kept(strcol("shape") eq shape && strcol("question") eq asked && strcol("series") eq word(list, 1), column("step"))):(column("floor_ns")) \
    with lines dt 3 lw 2 lc rgb "gray50" title "verify only"
  unset ylabel
}
unset multiplot
