# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "fig7"; picture = "fig7_ours"; asked = "intersects"; only = "ours"; always = "|swiftlet|vclip|"
title_text = "Figure 7 with our start"
load "_orbit_figure.gp"
