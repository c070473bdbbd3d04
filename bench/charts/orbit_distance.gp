# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
load "_common.gp"
name = "orbit"; picture = "orbit_distance"; asked = "distance"; only = ""; always = ""
title_text = "Exact distance, 2000 triangles, R = 2 r"
load "_orbit_figure.gp"
