# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "fig9"; picture = "fig9"; asked = "intersects"; only = ""; always = ""
title_text = "Figure 9: quadric rates at cutoff 50, intersection; start as in the paper and ours"
load "_orbit_figure.gp"
