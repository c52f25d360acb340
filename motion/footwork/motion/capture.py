"""Reading a motion file of any known format."""

from pathlib import Path

from footwork.errors import InputError
from footwork.motion.asf_amc import read_amc, read_asf
from footwork.motion.bvh import CENTIMETRE, read_bvh
from footwork.motion.clip import Clip
from footwork.motion.glb_reader import SEPARATOR, read_glb

EXTENSIONS = (".bvh", ".amc", ".glb")


def read_motions(path: str | Path, bvh_unit: float = CENTIMETRE) -> list[Clip]:
    """All clips of a file: of a GLB file there may be several, named by ``glb_reader.read_glb``.

    Raises:
        InputError: as ``read_capture``.
    """
    return read_glb(path) if Path(path).suffix.lower() == ".glb" else [read_capture(path, bvh_unit)]


def file_of(name: str) -> str:
    """The name of the file that holds the clip called ``name``."""
    file, mark, _ = name.partition(SEPARATOR)
    return file if mark and file.lower().endswith(".glb") else name


def read_capture(path: str | Path, bvh_unit: float = CENTIMETRE) -> Clip:
    """The motion of a file, by its extension; an AMC file finds its skeleton beside it.

    The skeleton of ``NN_MM.amc`` is ``NN.asf``, as CMU names them, or else ``NN_MM.asf``.

    Args:
        path: a ``.bvh``, ``.amc`` or ``.glb`` file.
        bvh_unit: metres in one unit of length of a BVH file.

    Raises:
        InputError: for another extension, a missing skeleton, a file of several clips, or whatever the format's reader
            refuses.
    """
    path = Path(path)
    match path.suffix.lower():
        case ".bvh":
            return read_bvh(path, bvh_unit)
        case ".amc":
            return read_amc(path, read_asf(skeleton_of(path)))
        case ".glb":
            clip, *others = read_glb(path)
            if others:
                raise InputError(f"holds {1 + len(others)} clips, expected one", path)
            return clip
        case other:
            raise InputError(f"extension {other!r}, expected one of {', '.join(EXTENSIONS)}", path)


def skeleton_of(path: Path) -> Path:
    """The ASF file that belongs to an AMC file.

    Raises:
        InputError: where there is none, naming those looked for.
    """
    names = [f"{path.stem.split('_')[0]}.asf", f"{path.stem}.asf"]
    for name in names:
        if path.with_name(name).is_file():
            return path.with_name(name)
    raise InputError(f"has no skeleton beside it, expected {' or '.join(dict.fromkeys(names))}", path)
