# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""How pickles name what makes an object again: the static methods of extension classes have no name that pickle knows."""

from __future__ import annotations

from typing import Any

from . import _runtime


def again(type_name: str, method: str, *arguments: Any) -> Any:
    """Calls a static method of one of the runtime's classes; an empty `method` is the class."""
    made_by = getattr(_runtime, type_name)
    return (getattr(made_by, method) if method else made_by)(*arguments)
