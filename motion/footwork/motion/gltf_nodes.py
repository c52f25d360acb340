"""The tree of a glTF file's nodes, and the bodies in it: the joints of skins, or what animations move."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile

from msgspec import UNSET

from footwork.errors import InputError
from footwork.motion import gltf_document as g
from footwork.motion.textfile import MAX_JOINTS

MOVES = ("translation", "rotation", "scale")
"""What channels may move of a node."""
MAX_DEPTH = 256


@dataclass(frozen=True)
class Body:
    """Nodes that move as one skeleton.

    Args:
        name: of its skin, or of its first node.
        nodes: parents before their children, so the first is the root.
        above: the nodes over the root, from the top down.
    """

    name: str
    nodes: tuple[int, ...]
    above: tuple[int, ...]

    @property
    def root(self) -> int:
        """The first of them."""
        return self.nodes[0]


class NodeTree:
    """Who stands under whom.

    Args:
        nodes: of the file.
        where: the file, for messages.

    Attributes:
        parent: of each node, -1 for none.

    Raises:
        InputError: for children that are not there, two parents of one node, or a cycle.
    """

    def __init__(self, nodes: list[g.Node], where: str) -> None:
        self.nodes, self.where = nodes, where
        self.parent = [-1] * len(nodes)
        for number, node in enumerate(nodes):
            for child in node.children:
                self._adopt(number, child)
        self._require_no_cycle()

    def _adopt(self, number: int, child: int) -> None:
        if child >= len(self.nodes):
            raise InputError(f"node {number} has child {child}, there are {len(self.nodes)} nodes", self.where)
        if self.parent[child] >= 0:
            raise InputError(f"node {child} has two parents, expected a tree", self.where)
        self.parent[child] = number

    def _require_no_cycle(self) -> None:
        """From the nodes without a parent all others must be reached."""
        reached = 0
        pending = [node for node, parent in enumerate(self.parent) if parent < 0]
        while pending:
            reached += 1
            pending += self.nodes[pending.pop()].children
        if reached < len(self.nodes):
            raise InputError("its nodes lie on a cycle, expected a tree", self.where)

    def above(self, node: int) -> list[int]:
        """The nodes over a node, from the top down.

        Raises:
            InputError: for more than ``MAX_DEPTH``.
        """
        way = []
        while (node := self.parent[node]) >= 0:
            way.append(node)
            if len(way) > MAX_DEPTH:
                raise InputError(f"more than {MAX_DEPTH} nodes above one another", self.where)
        return way[::-1]

    def body(self, joints: Sequence[int], name: str) -> Body:
        """The least tree that holds some nodes.

        Raises:
            InputError: for nodes that are not there or have nothing in common, and for more than ``MAX_JOINTS``.
        """
        if not joints or max(joints) >= len(self.nodes):
            raise InputError(f"a body {name!r} has no joints, or some that are not there", self.where)
        if len(joints) > MAX_JOINTS:
            raise InputError(f"{len(joints)} joints in one body, expected at most {MAX_JOINTS}", self.where)
        ways = [[*self.above(joint), joint] for joint in joints]
        shared = ways[0]
        for way in ways[1:]:
            shared = [a for a, _ in takewhile(lambda pair: pair[0] == pair[1], zip(shared, way, strict=False))]
        if not shared:
            raise InputError(f"the joints of body {name!r} stand under no common node", self.where)
        members = {node for way in ways for node in way[len(shared) - 1 :]}
        if len(members) > MAX_JOINTS:
            raise InputError(f"{len(members)} joints in one body, expected at most {MAX_JOINTS}", self.where)
        return Body(name, tuple(self._downward(shared[-1], members)), tuple(shared[:-1]))

    def _downward(self, root: int, members: set[int]) -> Iterator[int]:
        pending = [root]
        while pending:
            node = pending.pop()
            yield node
            pending += [child for child in reversed(self.nodes[node].children) if child in members]


def bodies_of(document: g.Document, tree: NodeTree) -> list[Body]:
    """The bodies of a file: those that skins move, or without skins, what animations move.

    Skins whose joints stand within one another's trees belong to one body: clothes and hair have skins of their own.

    Raises:
        InputError: as ``NodeTree.body``.
    """
    if not document.skins:
        return [tree.body(_moved(document), "")]
    bodies: list[Body] = []
    for skin in document.skins:
        body = tree.body(skin.joints, skin.name)
        kin = [other for other in bodies if body.root in (*other.above, *other.nodes) or other.root in body.above]
        joints = [node for other in (*kin, body) for node in other.nodes]
        bodies = [other for other in bodies if other not in kin]
        bodies.append(tree.body(joints, kin[0].name if kin else body.name))
    return bodies


def _moved(document: g.Document) -> list[int]:
    """The nodes that animations move."""
    targets = [channel.target for animation in document.animations for channel in animation.channels]
    moved = dict.fromkeys(target.node for target in targets if target.node is not UNSET and target.path in MOVES)
    return list(moved)
