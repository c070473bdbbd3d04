# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
# The README's chart: exact distance against motion, ours beside the best setting of each other method.
load "_common.gp"
name = "orbit"; picture = "standing"; asked = "distance"; only = "nothing but these"
always = "|swiftlet|swiftlet table|swiftlet ~0.1|vclip|fcl libccd|fcl libccd climb|bullet climb|bullet|"
title_text = "Exact distance (and ours allowed 0.1 r), 2000 triangles, R = 2 r"
load "_orbit_figure.gp"
