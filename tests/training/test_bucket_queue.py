import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from footwork.training.bucket_queue import NONE, bucket_queue, first, put, remove
from footwork.training.path_cost import UNIT


@given(st.lists(st.integers(0, 6 * UNIT), min_size=1, max_size=40), st.integers(0, 1000))
@settings(max_examples=50, deadline=None)
def test_nodes_come_out_by_whole_frames(labels, seed):
    queue, out = bucket_queue(len(labels), 6 * UNIT), []
    for node, label in enumerate(labels):
        put(*queue, node, label)
    gone = np.random.default_rng(seed).permutation(len(labels))[: len(labels) // 3].tolist()
    for node in gone:
        remove(*queue, node)
    turn = 0
    while len(out) < len(labels) - len(gone):
        node = first(queue.head, turn)
        if node == NONE:
            turn += 1
            continue
        remove(*queue, node)
        out.append(node)
    assert sorted(out) == sorted(set(range(len(labels))) - set(gone))
    frames = [labels[node] // UNIT for node in out]
    assert frames == sorted(frames)
    assert np.all(queue.head == NONE)
