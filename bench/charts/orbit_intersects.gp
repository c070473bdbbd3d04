# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "orbit"; picture = "orbit_intersects"; asked = "intersects"; only = ""; always = ""
title_text = "Intersection, 2000 triangles, R = 2 r"
load "_orbit_figure.gp"
