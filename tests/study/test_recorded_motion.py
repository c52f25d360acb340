"""A recorded match as motion for other tools: both fighters, as they were shown."""

from pathlib import Path

import numpy as np

from fighting_bundle import fighting_bundle, fighting_ground
from footwork.controllers.fighting_style import STYLES
from footwork.runtime.fight_recording import record_fight
from footwork.runtime.match import Match
from footwork.runtime.recording import read_recording
from footwork.study.recorded_motion import recorded_motion

TICKS = 90


def test_both_fighters_of_a_match_do_what_they_were_shown_doing(tmp_path: Path):
    def match() -> Match:
        return Match(fighting_ground(), [STYLES["aggressive"], STYLES["patient"]], 5)

    record_fight(match(), TICKS, tmp_path / "match.footrec")
    parts = recorded_motion(read_recording(tmp_path / "match.footrec"), fighting_bundle())
    shown = match().play(TICKS, shown=True)
    assert [(part.body, part.start) for part in parts] == [("character 0", 0.0), ("character 1", 0.0)]
    for part, poses in zip(parts, np.moveaxis(shown, 1, 0), strict=True):
        np.testing.assert_array_equal(part.clip.root_position, poses[:, :3])
        np.testing.assert_array_equal(part.clip.rotations.reshape(TICKS, -1), poses[:, 3:])
