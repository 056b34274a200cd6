# SPDX-License-Identifier: Apache-2.0
"""What is made from the library's registries when the package is loaded; the stub beside this file, which the
build writes, says it to editors and type checkers."""

from ._kinds import makers as _makers

_functions = _makers()
globals().update(_functions)
__all__ = list(_functions)
