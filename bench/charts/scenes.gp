# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# The scenes that are no plain orbit, a tick each; a mark per pair of bodies.
load "_common.gp"
file = results . "/scenes.csv"
set terminal svg size 1400,950 dynamic background "white" font "sans-serif,11"
set output out . "/scenes.svg"
set key outside right top samplen 1 spacing 0.95 font ',10' noenhanced
scenes = values(file, "shape", "", "")
set xrange [0.5:words(scenes) + 0.5]
set xtics ()
do for [i = 1:words(scenes)] { set xtics add (word(scenes, i) i) }
place(shape) = sum [i = 1:words(scenes)] (word(scenes, i) eq shape ? i : 0)
set multiplot layout 2,1 title "Other scenes, 10.4 degrees per query"
do for [asked in "distance intersects"] {
  list = values(file, "series", "question", asked)
  set title asked
  plot for [i = 1:words(list)] file using (kept(strcol("question") eq asked && strcol("series") eq word(list, i), \
      place(strcol("shape")) + 0.03 * (i - words(list) / 2.))):(column("ns")) \
    with points lc rgb colour(word(list, i), i) pt mark(word(list, i), i) ps 0.8 title word(list, i)
}
unset multiplot
