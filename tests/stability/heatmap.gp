# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# Families by methods: the share of cases that a method fails. Reads what `./run stability --all-methods --csv FILE` wrote:
#   gnuplot -e "csv='FILE'" tests/stability/heatmap.gp
if (!exists("csv")) csv = "stability.csv"
if (!exists("out")) out = "tests/stability/heatmap.svg"
set datafile separator ","
set terminal svg size 1100,620 dynamic background "white" font "sans-serif,12"
set output out
set termoption noenhanced

# The values of a column, each once and quoted, in the order of the file.
values(column) = system(sprintf("awk -F, 'NR > 1 && !seen[$%d]++ { printf \"\\\"%%s\\\" \", $%d }' %s", column, column, csv))
methods = values(1)
groups = values(2)
place(list, name) = sum [i = 1:words(list)] (word(list, i) eq name ? i : 0)
n = words(methods)
m = words(groups)
set title "Share of the cases that a method fails; in a cell: failed / cases. White: it takes none of them"
set xrange [0.5:n + 0.5]
set yrange [m + 0.5:0.5]
set cbrange [0:1]
set cblabel "failed"
set format cb "%.1f"
set palette defined (0 "#e8f3e8", 0.001 "#fde0c5", 0.3 "#f29e6e", 1 "#b2182b")
set tics nomirror scale 0
set border 0
set xtics rotate by 30 right offset 0,0
unset key
set rmargin 12
do for [i = 1:n] { set xtics add (word(methods, i) i) }
do for [i = 1:m] { set ytics add (word(groups, i) i) }
kept(cases, value) = cases > 0 ? value : NaN
plot csv every ::1 using (place(methods, strcol(1))):(place(groups, strcol(2))):(0.48):(0.48):(kept($3, $5 / ($3 > 0 ? $3 : 1))) \
       with boxxyerror fillstyle solid 1 noborder linecolor palette, \
     csv every ::1 using (place(methods, strcol(1))):(place(groups, strcol(2))):(sprintf($3 > 0 ? "%d / %d" : "", int($5), int($3))) \
       with labels font ",10"
