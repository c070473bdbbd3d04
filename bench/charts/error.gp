# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# Error against time: swiftlet at the error it was allowed, everyone else at the largest error measured. Failures and wrong
# verdicts are in the results only.
load "_common.gp"
file = results . "/error.csv"
set terminal svg size 1600,520 dynamic background "white" font "sans-serif,11"
set output out . "/error.svg"
set logscale x
set xrange [1e-14:2]
set xtics ("exact" 1e-13, "1e-9" 1e-9, "1e-6" 1e-6, "1e-4" 1e-4, "1e-3" 1e-3, "1e-2" 1e-2, "0.1" 1e-1, "1" 1) rotate by -45
set bmargin 6
set xlabel "error in radii: allowed (swiftlet), measured (others)"
tilde(series) = strstrt(series, " ~")
base(series) = tilde(series) > 0 ? series[1:tilde(series) - 1] : series
shown(error) = error < 1e-13 ? 1e-13 : error
is_ours(series) = strstrt(series, "swiftlet") == 1
set multiplot title "Error against time, 2000 triangles, R = 2 r, 10.4 degrees per query"
do for [k = 1:3] {
  shape = word(shapes, k)
  eval panel_left(k)
  eval key_at(k)
  all = values(file, "series", "", "")
  list = ""
  do for [i = 1:words(all)] { if (tilde(word(all, i)) == 0) { list = list . " \"" . word(all, i) . "\"" } }
  set title shape
  plot for [i = 1:words(list)] file using (kept(strcol("shape") eq shape && column("step") < 400 && base(strcol("series")) eq word(list, i), \
      shown(is_ours(word(list, i)) ? column("allowed") : column("error")))):(column("ns")) \
    with points pt mark(word(list, i), i) lc rgb colour(word(list, i), i) ps 0.9 title word(list, i)
  unset ylabel
}
unset multiplot
