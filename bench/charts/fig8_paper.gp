# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "fig8"; picture = "fig8_paper"; asked = "distance"; only = "paper"; always = "|swiftlet|vclip|"
title_text = "Figure 8: Dobkin-Kirkpatrick cutoffs x refinements, exact distance; start as in the paper"
load "_orbit_figure.gp"
