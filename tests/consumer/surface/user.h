/* SPDX-FileCopyrightText: 2026 the swiftlet authors */
/* SPDX-License-Identifier: BSD-3-Clause */
/* A program in C that uses swiftlet_c.h. */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

/* How many claims are wrong. */
int surface_c_user(void);

#ifdef __cplusplus
}
#endif
