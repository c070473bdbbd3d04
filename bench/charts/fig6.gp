# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "fig6"; picture = "fig6"; asked = "distance"; only = ""; always = ""
title_text = "Figure 6: start tables, radius factor x resolution, no hierarchy, exact distance"
load "_orbit_figure.gp"
