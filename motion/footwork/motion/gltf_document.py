"""The JSON of a glTF 2.0 file, as far as motion needs it: nodes, skins, animations and where their numbers lie."""

from typing import Annotated, Any

import msgspec
from msgspec import UNSET, Meta, Struct, UnsetType

from footwork.motion.textfile import MAX_NAME

FLOAT, UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT = 5126, 5121, 5123, 5125
VERTICES, INDICES = 34962, 34963
MAX_NODES, MAX_ANIMATIONS = 20_000, 2_000

Index = Annotated[int, Meta(ge=0, lt=2**31)]
Name = Annotated[str, Meta(max_length=MAX_NAME)]
Vector = tuple[float, float, float]
Numbers = Annotated[list[float], Meta(max_length=16)]


class Part(Struct, rename="camel", omit_defaults=True, kw_only=True):
    """An object of the file; what is not named here is passed over."""


class Asset(Part):
    """What wrote the file, and whose it is."""

    version: str
    generator: str = ""
    copyright: str | UnsetType = UNSET


class Node(Part):
    """A place in the tree: a matrix, column by column, or translation, rotation xyzw and scale."""

    name: Name = ""
    children: list[Index] = []
    translation: Vector = (0.0, 0.0, 0.0)
    rotation: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
    scale: Vector = (1.0, 1.0, 1.0)
    matrix: Annotated[list[float], Meta(min_length=16, max_length=16)] | UnsetType = UNSET
    mesh: Index | UnsetType = UNSET
    skin: Index | UnsetType = UNSET


class Skin(Part):
    """Which nodes move a mesh."""

    joints: list[Index]
    name: str = ""
    skeleton: Index | UnsetType = UNSET
    inverse_bind_matrices: Index | UnsetType = UNSET


class Target(Part):
    """What a channel moves; a node that is not given is something that an extension moves."""

    path: str
    node: Index | UnsetType = UNSET


class Channel(Part):
    """A sampler and what it moves."""

    sampler: Index
    target: Target


class Sampler(Part):
    """Accessors of times in seconds and of the values at them."""

    input: Index
    output: Index
    interpolation: str = "LINEAR"


class Animation(Part):
    """Channels that are played together."""

    channels: list[Channel]
    samplers: list[Sampler]
    name: Name = ""


class Accessor(Part):
    """An array: so many elements of a type, within a view."""

    component_type: int
    count: Index
    type: str
    buffer_view: Index | UnsetType = UNSET
    byte_offset: Index = 0
    normalized: bool = False
    min: Numbers | UnsetType = UNSET
    max: Numbers | UnsetType = UNSET
    sparse: Any = UNSET


class BufferView(Part):
    """A stretch of a buffer."""

    buffer: Index
    byte_length: Index
    byte_offset: Index = 0
    byte_stride: Annotated[int, Meta(ge=4, le=252)] | UnsetType = UNSET
    target: int | UnsetType = UNSET


class Buffer(Part):
    """A run of bytes: the file's own second chunk, where no address is given."""

    byte_length: Index
    uri: str | UnsetType = UNSET


class Scene(Part):
    """The nodes at the top."""

    nodes: list[Index] = []


class Document(Part):
    """The whole. Meshes and materials stay as they are: motion does not read them."""

    asset: Asset
    scene: Index | UnsetType = UNSET
    scenes: list[Scene] = []
    nodes: Annotated[list[Node], Meta(max_length=MAX_NODES)] = []
    skins: Annotated[list[Skin], Meta(max_length=MAX_NODES)] = []
    meshes: list[Any] = []
    materials: list[Any] = []
    animations: Annotated[list[Animation], Meta(max_length=MAX_ANIMATIONS)] = []
    accessors: list[Accessor] = []
    buffer_views: list[BufferView] = []
    buffers: list[Buffer] = []


encode = msgspec.json.Encoder().encode
decode = msgspec.json.Decoder(Document).decode
