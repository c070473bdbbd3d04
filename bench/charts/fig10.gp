# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "fig10"; picture = "fig10"; asked = "distance"; only = ""; always = ""
title_text = "Figure 10: quadric rates at cutoff 50, exact distance; start as in the paper and ours"
load "_orbit_figure.gp"
