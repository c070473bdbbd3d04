# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "fig7"; picture = "fig7_paper"; asked = "intersects"; only = "paper"; always = "|swiftlet|vclip|"
title_text = "Figure 7: Dobkin-Kirkpatrick cutoffs x refinements, intersection; start as in the paper"
load "_orbit_figure.gp"
