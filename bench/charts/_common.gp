# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# What all charts share. `./run charts` runs every script here without a leading underscore, in this folder.
if (!exists("results")) results = "../results"
if (!exists("out")) out = "."
set datafile separator ","
set datafile missing NaN
set termoption noenhanced
set grid xtics ytics lc rgb "#dddddd"
set border 3
set tics nomirror
set tmargin 4
set logscale y
set format y "%g"
set ylabel "ns per query"

# Three panels beside each other, the key right of the last.
shapes = "fat plate long"
panel_left(i) = sprintf("set lmargin at screen %g; set rmargin at screen %g", 0.05 + 0.27 * (i - 1), 0.28 + 0.27 * (i - 1))
key_at(i) = i == 3 ? "set key at screen 0.825, graph 1 left Left reverse top samplen 2 spacing 0.95 font ',10' noenhanced" : "unset key"

# A series has its place's colour and mark; swiftlet and V-Clip are the same everywhere.
colours = "#4477aa #ee6677 #228833 #ccbb44 #66ccee #aa3377 #999933 #882255 #44aa99 #997700 #6699cc #ee99aa"
colour(series, i) = series eq "swiftlet" ? "#d40000" : series eq "vclip" ? "#000000" : word(colours, (i - 1) % words(colours) + 1)
width(series) = series eq "swiftlet" ? 3 : series eq "vclip" ? 2.5 : 1
mark(series, i) = series eq "swiftlet" ? 7 : series eq "vclip" ? 9 : (i - 1) % 13 + 1

# The values of a column where another holds a word (where "": everywhere), each once and quoted, in the order of the file.
values(file, column, where, word) = system(sprintf( \
  "awk -F, -v column='%s' -v where='%s' -v word='%s' 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }  where == \"\" || $(at[where]) == word { v = $(at[column]); if (!seen[v]++) printf \"\\\"%%s\\\" \", v }' %s", column, where, word, file))
# The first value of a column for a series.
first(file, column, series) = system(sprintf( \
  "awk -F, -v column='%s' -v series='%s' 'NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }  $(at[\"series\"]) == series { print $(at[column]); exit }' %s", column, series, file))
kept(condition, number) = condition ? number : NaN

motion_axis = "set logscale x; set xrange [0.4:500]; set xlabel 'degrees per query'; set xtics (0.5, 1, 2, 5, 10, 20, 45, 90, 180, 'random' 400) rotate by -45"
