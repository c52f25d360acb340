import numpy as np

from footwork.motion.kinematics import clip_places
from footwork.training.chains import CONTEXT, NO_CHAIN, NO_SEGMENT, Chains, chains_of_clips
from footwork.training.nodes import nodes_of
from motion_samples import sample_clip

BEHAVIOURS = ("stop", "walk", "run", "jump")


def chains_of(pairs, weights, lengths, clip_of):
    """Chains without places for the given (first, second) segments; ``clip_of`` tells a segment's clip."""
    originals, interpolated = lengths[:2], lengths[2:]
    length = np.array([*originals, *interpolated])
    clip = np.repeat([0, 1] + [clip_of[first] for first, _ in pairs], length)
    other = np.repeat([0, 1] + [clip_of[second] for _, second in pairs], length)
    nothing = np.zeros(length.sum(), np.int16)
    context = np.array([0, 0] + [CONTEXT] * len(pairs))
    return Chains(
        skeleton=sample_clip(0, 5).skeleton,
        clips=("a", "b"),
        labels=("walk",),
        behaviours=BEHAVIOURS,
        length=length,
        context=context,
        places=np.zeros(((length + 2 * context).sum(), 1, 3)),
        first=np.array([NO_SEGMENT] * 2 + [first for first, _ in pairs]),
        second=np.array([NO_SEGMENT] * 2 + [second for _, second in pairs]),
        chain_weight=np.array([1.0, 1.0, *weights]),
        clip=clip,
        frame=nothing.astype(np.int32),
        other_clip=other,
        other_frame=nothing.astype(np.int32),
        label=nothing,
        behaviour=nothing,
        contacts=np.zeros((length.sum(), 2), np.bool_),
    )


def test_clips_alone_are_chains_without_context():
    clips = [sample_clip(0, 12), sample_clip(1, 20)]
    chains, nodes = chains_of_clips(clips, BEHAVIOURS), nodes_of(clips, BEHAVIOURS)
    assert (chains.chain_count, chains.node_count, chains.row_count, chains.original_count) == (2, 32, 32, 32)
    np.testing.assert_array_equal(chains.row_of_node, np.arange(32))
    np.testing.assert_array_equal(chains.places, np.concatenate([clip_places(clip)[0] for clip in clips]))
    np.testing.assert_array_equal(chains.frame, nodes.arrays["frame"])
    np.testing.assert_array_equal(chains.other_clip, nodes.arrays["clip"])
    assert (chains.weight == 1.0).all()
    assert (chains.followers == NO_CHAIN).all()
    assert not chains.places.flags.writeable


def test_nodes_know_their_chain_and_row():
    chains = chains_of([(0, 1)], [0.5], [3, 2, 4], {0: 0, 1: 1})
    np.testing.assert_array_equal(chains.first_node, [0, 3, 5])
    np.testing.assert_array_equal(chains.last_node, [2, 4, 8])
    np.testing.assert_array_equal(chains.first_row, [0, 3, 5])
    np.testing.assert_array_equal(chains.chain_of_node, [0] * 3 + [1] * 2 + [2] * 4)
    np.testing.assert_array_equal(chains.row_of_node, [0, 1, 2, 3, 4, 11, 12, 13, 14])
    np.testing.assert_array_equal(chains.weight, [1.0] * 5 + [0.5] * 4)
    assert chains.original_count == 5
    assert chains.row_count == 5 + 4 + 2 * CONTEXT


def test_a_chain_is_followed_by_that_of_the_next_segments_at_the_same_weight():
    clip_of = {0: 0, 1: 0, 2: 0, 3: 1, 4: 1}
    pairs = [(0, 3), (0, 3), (1, 4), (1, 4), (2, 3), (0, 2), (1, 3)]
    weights = [0.25, 0.75, 0.75, 0.25, 0.5, 0.25, 0.25]
    chains = chains_of(pairs, weights, [3, 2] + [2] * 7, clip_of)
    np.testing.assert_array_equal(chains.followers[2:4], [5, 4])
    # the segments after 0 and 2 are 1 and 3, but 3 begins another clip
    assert (np.delete(chains.followers, [2, 3]) == NO_CHAIN).all()
