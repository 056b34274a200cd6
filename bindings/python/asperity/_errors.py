# SPDX-License-Identifier: Apache-2.0
"""The one exception of the package, and its warnings."""

from __future__ import annotations

import enum


class ErrorCode(enum.IntEnum):
    """What kind of mistake or mishap an `Error` reports; the values are the program's exit codes."""

    USAGE = 2
    """A setting outside its range, an unknown keyword, settings that contradict each other."""
    INVALID_INPUT = 3
    """A file or an array whose content is not what it claims to be."""
    INPUT_OUTPUT = 4
    """The operating system refused to open, read, write or rename."""
    OUT_OF_MEMORY = 5
    """More memory needed than there is."""
    ACCOUNT = 6
    """Energy is not accounted for: a fault of the program or the machine."""
    STOPPED = 130
    """Stopped before anything was complete."""


class Error(Exception):
    """What the library refuses, in one line.

    `message` says what is wrong, `place` where: a file, a line of it, or the name of a setting or keyword;
    empty where there is none. `code` is an `ErrorCode`. `str(error)` is "place: message".
    """

    message: str
    code: ErrorCode
    place: str

    def __init__(self, message: str, code: int = ErrorCode.USAGE, place: str = "") -> None:
        super().__init__(message, int(code), place)
        self.message, self.code, self.place = message, ErrorCode(code), place

    def __str__(self) -> str:
        return f"{self.place}: {self.message}" if self.place else self.message


class StoppedWarning(UserWarning):
    """A run was stopped by Ctrl-C; the result holds what was complete."""
