"""The metrics that graphs can be built with, by name.

- ``uniform``: all joints alike (conventions.md 1).
- ``dynamics``: what is heavy, or stands, must not move far; weights of each pair (conventions.md 8).
- ``torso``: all joints alike but for extra weight on the torso, set by hand (weights/torso.toml).
- ``joints``: thighs, shanks, upper arms and forearms by fitted weights (weights/joints.toml).

All are on one scale (conventions.md 2), so that thresholds can be compared.
"""

from collections.abc import Sequence

import numpy as np

from footwork.errors import InputError
from footwork.motion.clip import Clip
from footwork.motion.dynamics_metric import DynamicsMetric
from footwork.motion.kinematics import clip_places
from footwork.motion.metric import Metric, PointCloudMetric
from footwork.motion.metric_names import NAMES
from footwork.motion.pair_weights import dynamics_weights
from footwork.motion.point_cloud import PointCloud, joint_cloud
from footwork.motion.skeleton import Skeleton
from footwork.motion.weight_table import built_in_weights


def metric_of(name: str, clips: Sequence[Clip]) -> Metric:
    """The metric called ``name`` over the frames of clips laid end to end.

    Raises:
        InputError: for an unknown name, no clips, clips of different bodies, or a body that lacks what the metric
            needs: masses for ``dynamics``, the common body's joints for ``torso`` and ``joints``.
    """
    require_metric(name)
    skeleton = _shared_skeleton(clips)
    places = [clip_places(clip)[0] for clip in clips]
    if name == "dynamics":
        return DynamicsMetric(places, [clip.contacts for clip in clips], dynamics_weights(skeleton))
    if name == "uniform":
        return PointCloudMetric(places)
    cloud = fixed_cloud(name, skeleton)
    return PointCloudMetric([cloud.points(clip) for clip in places], cloud.weights)


def fixed_cloud(name: str, skeleton: Skeleton) -> PointCloud:
    """The points of a body and their weights, where these are the same for all pairs of frames.

    For ``dynamics`` they are those of its mass part, under which s is never more than under the whole.

    Raises:
        InputError: for an unknown name, or a body that lacks what the metric needs.
    """
    require_metric(name)
    if name == "uniform":
        return joint_cloud(np.ones(skeleton.joint_count))
    if name == "dynamics":
        return joint_cloud(dynamics_weights(skeleton).mass)
    return built_in_weights(name).cloud(skeleton)


def require_metric(name: str, where: str = "metric") -> None:
    """Raise InputError unless there is a metric of that name."""
    if name not in NAMES:
        raise InputError(f"no metric {name!r}, expected one of {', '.join(NAMES)}", where)


def _shared_skeleton(clips: Sequence[Clip]) -> Skeleton:
    if not clips:
        raise InputError("no clips, expected at least one", "metric")
    body = clips[0].skeleton
    for clip in clips:
        other = clip.skeleton
        same = all(np.array_equal(getattr(other, part), getattr(body, part)) for part in ("parents", "masses", "feet"))
        if other.names != body.names or not same:
            raise InputError(f"another body than that of {clips[0].name}, expected one for all clips", clip.name)
    return body
