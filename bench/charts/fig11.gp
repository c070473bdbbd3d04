# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "fig11"; picture = "fig11"; asked = "intersects"; only = ""; always = ""
title_text = "Figure 11: best of each, intersection"
load "_orbit_figure.gp"
