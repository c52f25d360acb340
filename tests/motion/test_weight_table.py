import numpy as np
import pytest

from footwork.errors import InputError
from footwork.motion.body import NAMES, default_body
from footwork.motion.weight_table import built_in_weights, read_weight_table

WRITTEN = 'source = "me"\non = "joints"\nothers = 0.5\n[weights]\nhand = 2.0\n'


def written(tmp_path, text):
    path = tmp_path / "mine.toml"
    path.write_text(text)
    return path


def test_half_of_the_heuristic_is_on_the_torso():
    cloud = built_in_weights("torso").cloud(default_body())
    weights = dict(zip(NAMES, cloud.weights, strict=True))
    assert sum(weights[name] for name in ("hips", "spine", "chest")) == pytest.approx(0.5)
    assert weights["left_hand"] == weights["head"] == pytest.approx(1 / 36)
    np.testing.assert_array_equal(cloud.shares, np.eye(21))


def test_fitted_weights_lie_on_four_points_of_each_of_eight_segments():
    cloud, body = built_in_weights("joints").cloud(default_body()), default_body()
    assert len(cloud.weights) == 32
    inner = [int(np.flatnonzero(share > 0)[0]) for share in cloud.shares[::4]]
    names = ("left_upper_arm", "left_forearm", "left_thigh", "left_shank")
    assert [NAMES[joint] for joint in inner] == [*names, *(name.replace("left", "right") for name in names)]
    printed = np.array([0.7884, 0.0247, 1.0, 0.0901] * 2)
    sums = cloud.weights.reshape(8, 4).sum(axis=1)
    np.testing.assert_allclose(sums, printed / printed.sum())
    places = np.random.default_rng(0).random((5, 21, 3))
    thigh, knee = (places[:, body.index(name)] for name in ("left_thigh", "left_shank"))
    points = cloud.points(places)[:, 8:12]
    for number, along in enumerate((0.25, 0.5, 0.75, 1.0)):
        np.testing.assert_allclose(points[:, number], thigh + along * (knee - thigh), atol=1e-12)


def test_a_table_of_ones_own_is_read(tmp_path):
    cloud = read_weight_table(written(tmp_path, WRITTEN)).cloud(default_body())
    assert cloud.weights[NAMES.index("left_hand")] == pytest.approx(4.0 * cloud.weights[0])
    unnamed = WRITTEN.replace("0.5", "0.0")
    assert len(read_weight_table(written(tmp_path, unnamed)).cloud(default_body()).weights) == 2


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("on = ", "is not TOML"),
        (WRITTEN.replace("source", "sauce"), "unknown key 'sauce'"),
        (WRITTEN.replace('"joints"', '"bones"'), "on is 'bones', expected joints or segments"),
        (WRITTEN.replace('source = "me"', ""), "source is missing"),
        (WRITTEN.replace("2.0", "-1"), r"weights\.hand is -1"),
        (WRITTEN.replace("2.0", "nan"), r"weights\.hand is nan"),
        (WRITTEN.replace("2.0", "1e999"), r"weights\.hand is inf"),
        (WRITTEN.replace("2.0", "true"), r"weights\.hand is True"),
        (WRITTEN.replace("others = 0.5", ""), "others is missing"),
        (WRITTEN.replace("[weights]\nhand = 2.0", "weights = 3"), "weights is 3"),
    ],
)
def test_a_malformed_table_is_named(tmp_path, text, says):
    with pytest.raises(InputError, match=rf"mine\.toml.*{says}"):
        read_weight_table(written(tmp_path, text))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (WRITTEN.replace("hand", "tail"), "no joint 'tail', expected some of hips, spine"),
        (WRITTEN.replace("0.5", "0").replace("2.0", "0"), "weights are all zero"),
        (WRITTEN.replace('"joints"', '"segments"').replace("0.5", "0"), "'left_hand' has 0 outer joints"),
        (WRITTEN.replace('"joints"', '"segments"').replace("hand", "chest").replace("0.5", "0"), "'chest' has 3 outer"),
    ],
)
def test_weights_that_do_not_fit_the_body_are_refused(tmp_path, text, says):
    with pytest.raises(InputError, match=says):
        read_weight_table(written(tmp_path, text)).cloud(default_body())


def test_a_table_that_is_not_there_is_named(tmp_path):
    with pytest.raises(InputError, match="expected a weight table"):
        read_weight_table(tmp_path / "none.toml")
