"""Embedded motions: whole-body clips from a parametric generator, so that nothing here needs motion capture."""

from footwork.training.embedded.fighting import fighting_clips
from footwork.training.embedded.locomotion import embedded_clips

__all__ = ["embedded_clips", "fighting_clips"]
