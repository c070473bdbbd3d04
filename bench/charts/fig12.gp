# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "fig12"; picture = "fig12"; asked = "distance"; only = ""; always = ""
title_text = "Figure 12: best of each, exact distance"
load "_orbit_figure.gp"
