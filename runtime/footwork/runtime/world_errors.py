"""What a world refuses."""

from footwork.errors import FootworkError


class WorldError(FootworkError):
    """The world was asked for something that it cannot do."""


class WorldFull(WorldError):  # noqa: N818  (it reads as what happened)
    """A character was spawned where there is no room for another."""


class NoSuchCharacter(WorldError):  # noqa: N818
    """A slot was named that holds no character."""


class WrongMove(WorldError):  # noqa: N818
    """A character was told to take an edge that does not leave from its node, or to move where nothing is."""
