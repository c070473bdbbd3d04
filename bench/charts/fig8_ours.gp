# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "fig8"; picture = "fig8_ours"; asked = "distance"; only = "ours"; always = "|swiftlet|vclip|"
title_text = "Figure 8 with our start"
load "_orbit_figure.gp"
