"""The two forms of motion matching, by name, on clips of one's choice."""

from collections.abc import Sequence

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.study.motion_matching.chains import graph_of_all_frames
from footwork.study.motion_matching.controller import MotionMatchingController
from footwork.study.motion_matching.options import REFERENCE, STRONG

FORMS = {"reference": REFERENCE, "strong": STRONG}


def motion_matching(clips: Sequence[Clip], form: str) -> MotionMatchingController:
    """The controller of a form on all frames of some clips; the strong one has their mirror images too.

    Raises:
        InputError: for a form that is none, and for clips that cannot be matched.
    """
    if form not in FORMS:
        raise InputError(f"no form {form!r} of motion matching, there are {', '.join(FORMS)}", "form")
    return MotionMatchingController(graph_of_all_frames(clips, mirror=form == "strong"), FORMS[form])
