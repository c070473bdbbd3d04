# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "fig5"; picture = "fig5"; asked = "distance"; only = ""; always = ""
title_text = "Figure 5: marching within level 0, R = 2 r; first against most violated plane"
load "_orbit_figure.gp"
