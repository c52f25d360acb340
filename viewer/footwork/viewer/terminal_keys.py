"""Keys of a terminal as they are pressed, one by one and without an echo; the terminal is as it was afterwards."""

import os
import select
import sys
from typing import Self

try:
    import termios
    import tty
except ImportError:  # Windows: the text view shows, but takes no keys
    termios = tty = None


class TerminalKeys:
    """A context manager; where standard input is no terminal, no key is ever pressed."""

    def __init__(self) -> None:
        self.is_terminal = termios is not None and sys.stdin.isatty()

    def __enter__(self) -> Self:
        if self.is_terminal:
            self._file = sys.stdin.fileno()
            self._before = termios.tcgetattr(self._file)  # type: ignore[union-attr]
            tty.setcbreak(self._file)  # type: ignore[union-attr]
        return self

    def __exit__(self, *exception: object) -> None:
        if self.is_terminal:
            termios.tcsetattr(self._file, termios.TCSADRAIN, self._before)  # type: ignore[union-attr]

    def pressed(self) -> str:
        """What was typed since the last time."""
        if not self.is_terminal or not select.select([self._file], [], [], 0.0)[0]:
            return ""
        return os.read(self._file, 64).decode(errors="ignore")
