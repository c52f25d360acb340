"""Small turns of phrase for the lines that say what was found."""

from collections.abc import Sequence


def numbered(count: int, thing: str) -> str:
    """``1 frame``, ``2,721 frames``."""
    return f"{count:,} {thing}" + ("" if count == 1 else "s")


def joined_words(words: Sequence[str]) -> str:
    """``a``, ``a and b``, ``a, b and c``."""
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} and {words[-1]}"
