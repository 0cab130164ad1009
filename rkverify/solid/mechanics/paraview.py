"""Bodies for ParaView: nodes as vertices and cells as polygons in .vtu files, a series in time as an index .pvd of them.

Every file is whole as soon as it has its name; the index is written last. VTK knows three dimensions: what is missing is 0.
"""

import os
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

import meshio
import numpy as np

from rkverify.errors import BadInput
from rkverify.solid.cell_rings import all_rings
from rkverify.solid.cells import Cells
from rkverify.solid.kernel_values import Array
from rkverify.solid.materials.kinematics import determinant
from rkverify.solid.mechanics.body import Body
from rkverify.solid.mechanics.moving import Motion


@dataclass(frozen=True)
class Frame:
    """What is seen at one time: positions (N, d), values by name (N,), (N, d) or (N, d, d), and perhaps the nodes' cells in the plane."""

    time: float
    positions: Array
    values: Mapping[str, Array] = field(default_factory=dict)
    cells: Cells | None = None


def frame_of_body(
    body: Body, displacements: Array, velocities: Array | None = None, cells: Cells | None = None, time: float = 0.0
) -> Frame:
    """A body in its reference configuration with coefficients d, v (N, d): displacement and velocity are the fields sum_I Psi_I d_I.

    Positions are those in X (in ParaView "Warp By Vector" shows the deformed body), cells as well; stress: Cauchy, whole (3, 3).
    """
    state = body.advanced(displacements).state
    values = {
        "displacement": body.values @ displacements,
        "velocity": body.values @ (np.zeros_like(displacements) if velocities is None else velocities),
        "stress": state.sigma,
        "plastic strain": state.alpha,
        "det F": determinant(state.F),
        "measure": body.operator.measures,
    }
    return Frame(time, body.cloud.positions, values, cells)


def frame_of_motion(start: Array, motion: Motion, cells: Cells | None = None) -> Frame:
    """A body in its current configuration: displacement of the nodes from `start` (N, d), velocity coefficients, Cauchy stress, measures."""
    values = {
        "displacement": motion.x - start,
        "velocity": motion.v,
        "stress": motion.state.sigma,
        "plastic strain": motion.state.alpha,
        "measure": motion.measures,
    }
    return Frame(motion.time, motion.x, values, cells)


def write_series(folder: Path, name: str, frames: Sequence[Frame]) -> Path:
    """Write `name`-nodes-0000.vtu, `name`-cells-0000.vtu where there are cells, …, and the index `name`.pvd, whose path is returned.

    Raises BadInput for no frames, values or cells of another number than the nodes, values that are not finite numbers, cells that are not in the
    plane or have holes, a name with a separator, and a folder that cannot be written.
    """
    if not frames:
        raise BadInput("there is no frame to write: give at least one")
    if not name or Path(name).name != name:
        raise BadInput(f"the name {name!r} of a series: leave out folders")
    collection = ElementTree.Element("VTKFile", type="Collection", version="0.1", byte_order="LittleEndian")
    entries = ElementTree.SubElement(collection, "Collection")
    for number, frame in enumerate(frames):
        meshes = [("nodes", _nodes(frame))] + (
            [("cells", _polygons(frame, frame.cells))] if frame.cells is not None else []
        )
        for part, (what, mesh) in enumerate(meshes):
            file = f"{name}-{what}-{number:04d}.vtu"
            _atomically(folder / file, lambda path, mesh=mesh: meshio.write(path, mesh, file_format="vtu"))  # type: ignore[misc]
            ElementTree.SubElement(entries, "DataSet", timestep=repr(float(frame.time)), part=str(part), file=file)
    ElementTree.indent(collection)
    index = folder / f"{name}.pvd"
    text = ElementTree.tostring(collection, encoding="unicode", xml_declaration=True) + "\n"
    _atomically(index, lambda path: path.write_text(text, encoding="utf-8"))
    return index


def _nodes(frame: Frame) -> meshio.Mesh:
    values = _checked(frame)
    vertices = np.arange(len(frame.positions))[:, None]
    return meshio.Mesh(_in_space(frame.positions, 3), [("vertex", vertices)], point_data=values)


def _polygons(frame: Frame, cells: Cells) -> meshio.Mesh:
    """Each piece of a cell as a polygon with its node's values; pieces in the order of their numbers of corners, as VTU keeps them."""
    if cells.dimension != 2:
        raise BadInput(f"cells in {cells.dimension} dimensions are no polygons: leave them out")
    if len(cells) != len(frame.positions):
        raise BadInput(f"{len(cells)} cells for {len(frame.positions)} nodes: give one for each node")
    pieces = [(L, ring) for L, rings in enumerate(all_rings(cells)) for ring in rings]
    for L, ring in pieces:
        x, y = ring.T
        if (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() < 0:
            raise BadInput(f"cell {L} has a hole, which a polygon cannot have: leave the cells out")
    pieces.sort(key=lambda piece: len(piece[1]))
    counts = np.array([len(ring) for _, ring in pieces])
    corners = np.split(np.arange(counts.sum()), np.cumsum(counts)[:-1])
    sizes = np.unique(counts)
    blocks = [("polygon", np.array([c for c in corners if len(c) == size])) for size in sizes]
    owner = np.array([L for L, _ in pieces])
    values = {"node": owner, **{key: value[owner] for key, value in _checked(frame).items()}}
    data = {key: [value[counts == size] for size in sizes] for key, value in values.items()}
    return meshio.Mesh(_in_space(np.concatenate([ring for _, ring in pieces]), 3), blocks, cell_data=data)


def _checked(frame: Frame) -> dict[str, Array]:
    """Values as VTK takes them: numbers, vectors of 3, tensors of 9 components row by row."""
    found = {}
    for key, given in frame.values.items():
        value = np.asarray(given, dtype=float)
        if value.ndim not in (1, 2, 3) or len(value) != len(frame.positions):
            raise BadInput(f"{key!r} has shape {value.shape} for {len(frame.positions)} nodes: give one value for each")
        bad = np.flatnonzero(~np.isfinite(value.reshape(len(value), -1)).all(axis=1))
        if len(bad):
            raise BadInput(f"{key!r} of node {bad[0]} is not finite: look at the step before, or leave it out")
        found[key] = value if value.ndim == 1 else _in_space(value, 3).reshape(len(value), -1)
    return found


def _in_space(value: Array, size: int) -> Array:
    """(N, d) as (N, 3), (N, d, d) as (N, 3, 3), with zeros."""
    missing = [(0, 0)] + [(0, size - value.shape[axis]) for axis in range(1, value.ndim)]
    return np.pad(value, missing)


def _atomically(path: Path, write: Callable[[Path], object]) -> None:
    """Write under a name that begins with a dot, in the same folder, and rename."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=".part-", suffix=path.suffix, dir=path.parent)
        os.close(handle)
        part = Path(name)
        try:
            write(part)
            part.chmod(0o644)
            part.replace(path)
        except BaseException:
            part.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise BadInput(f"cannot write {path}: {error.strerror}; make the folder writable or choose another") from None
