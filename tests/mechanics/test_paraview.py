"""What ParaView is given is read back with meshio and is what the body has: a file that opens and holds other numbers is worse than none."""

import os
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest

from rkverify.errors import BadInput
from rkverify.solid.cells import Cells
from rkverify.solid.domain import polygon_domain
from rkverify.solid.materials.truesdell import Truesdell
from rkverify.solid.mechanics.moving import Motion
from rkverify.solid.mechanics.paraview import Frame, frame_of_body, frame_of_motion, write_series
from rkverify.solid.voronoi import voronoi


def area(polygon):
    x, y = polygon.T
    return (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2


@pytest.mark.parametrize("dimension", [2, 3])
def test_nodes_are_read_back(block, tmp_path, dimension):
    """Every number in the file is the double that was given, vectors and tensors filled up with zeros."""
    made = block(dimension, 4 if dimension == 2 else 3)
    b, d = made.body(), made.small()
    write_series(tmp_path, "run", [frame_of_body(b, d, velocities=2 * d, time=0.1)])
    mesh = meshio.read(tmp_path / "run-nodes-0000.vtu")
    assert (mesh.points[:, :dimension] == made.positions).all()
    assert (mesh.points[:, dimension:] == 0).all()
    assert [cells.type for cells in mesh.cells] == ["vertex"]
    state = b.advanced(d).state
    assert (mesh.point_data["displacement"][:, :dimension] == b.values @ d).all()
    assert (mesh.point_data["velocity"][:, :dimension] == b.values @ (2 * d)).all()
    assert (mesh.point_data["stress"].reshape(-1, 3, 3) == state.sigma).all()
    assert (mesh.point_data["measure"] == b.operator.measures).all()
    assert not (mesh.point_data["displacement"][:, :dimension] == d).all()  # coefficients are no values


def test_cells_are_polygons_with_their_nodes_values(block, tmp_path):
    """Areas of the polygons are the measures of the nodes they name: corners, order and values belong together."""
    made = block(2, 6)
    b = made.body()
    write_series(tmp_path, "run", [frame_of_body(b, made.small(), cells=made.cells)])
    mesh = meshio.read(tmp_path / "run-cells-0000.vtu")
    assert mesh.points.shape[1] == 3
    assert (mesh.points[:, 2] == 0).all()
    seen = []
    for number, cells in enumerate(mesh.cells):
        assert cells.type == "polygon"
        for row, corners in enumerate(cells.data):
            node = int(mesh.cell_data["node"][number][row])
            seen.append(node)
            measure = mesh.cell_data["measure"][number][row]
            assert measure == b.operator.measures[node]
            assert abs(area(mesh.points[corners, :2]) - measure) <= 1e-15  # areas below 0.1 from coordinates below 1
    assert sorted(seen) == list(range(len(made.positions)))


def test_a_series_has_an_index_in_time(block, tmp_path):
    """The index names every file once with its time; a series written again replaces the one before and leaves nothing behind."""
    made = block()
    law, n = Truesdell(made.body().law.moduli), len(made.positions)
    frames = []
    for time in (0.0, 0.25, 0.5):
        x = made.positions * (1 + time)
        cells = voronoi(x, polygon_domain([np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * (1 + time)]))
        motion = Motion(x, x, law.start(n, 2), cells.measures, time=time)
        frames.append(frame_of_motion(made.positions, motion, cells if time else None))
    for _ in range(2):
        index = write_series(tmp_path / "new" / "folder", "run", frames)
    sets = [e.attrib for e in ElementTree.parse(index).getroot().iter("DataSet")]
    assert [(float(s["timestep"]), s["part"]) for s in sets] == [
        (0.0, "0"), (0.25, "0"), (0.25, "1"), (0.5, "0"), (0.5, "1"),
    ]  # fmt: skip
    assert {s["file"] for s in sets} | {"run.pvd"} == {p.name for p in index.parent.iterdir()}
    for s, x in zip([s for s in sets if s["part"] == "0"], (1.0, 1.25, 1.5), strict=True):
        moved = meshio.read(index.parent / s["file"])
        assert (moved.points[:, :2] == made.positions * x).all()
        assert (moved.point_data["displacement"][:, :2] == made.positions * x - made.positions).all()


@pytest.mark.parametrize(
    ("frames", "name", "told"),
    [
        ([], "run", "^there is no frame"),
        ([Frame(0.0, np.zeros((2, 2)))], "a/b", "^the name 'a/b' of a series: leave out folders$"),
        ([Frame(0.0, np.zeros((2, 2)), {"v": np.zeros(3)})], "run", r"^'v' has shape \(3,\) for 2 nodes"),
        ([Frame(0.0, np.zeros((2, 2)), {"v": np.array([0, np.nan])})], "run", "^'v' of node 1 is not finite"),
    ],
)
def test_what_cannot_be_shown_is_refused(tmp_path, frames, name, told):
    with pytest.raises(BadInput, match=told):
        write_series(tmp_path, name, frames)
    assert not list(tmp_path.iterdir())


def test_cells_that_are_no_polygons_are_refused(block, tmp_path):
    made, space = block(), block(3, 3)
    with pytest.raises(BadInput, match="cells in 3 dimensions are no polygons"):
        write_series(tmp_path, "run", [Frame(0.0, space.positions, {}, space.cells)])
    with pytest.raises(BadInput, match="25 cells for 3 nodes"):
        write_series(tmp_path, "run", [Frame(0.0, made.positions[:3], {}, made.cells)])
    square = np.array([[0.0, 0], [3, 0], [3, 3], [0, 3], [1, 1], [1, 2], [2, 2], [2, 1]])
    ring = np.concatenate([np.stack([np.arange(4), np.roll(np.arange(4), -1)], 1) + first for first in (0, 4)])
    holed = Cells(square, np.arange(0, 18, 2), ring.ravel(), np.array([[0, -1]] * 8), np.zeros((8, 2)), np.array([8.0]))
    with pytest.raises(BadInput, match="cell 0 has a hole"):
        write_series(tmp_path, "run", [Frame(0.0, np.zeros((1, 2)), {}, holed)])


def test_a_folder_that_cannot_be_written_is_named(block, tmp_path):
    """A file stands where the folder should be; a process that is stopped while writing leaves the old file."""
    (tmp_path / "taken").write_text("")
    frame = Frame(0.0, block().positions)
    with pytest.raises(BadInput, match=r"^cannot write .*taken.*; make the folder writable or choose another$"):
        write_series(tmp_path / "taken", "run", [frame])
    if os.getuid() == 0:
        return  # to whom every folder is writable
    locked = tmp_path / "locked"
    locked.mkdir(mode=0o500)
    with pytest.raises(BadInput, match="cannot write"):
        write_series(locked, "run", [frame])


def test_a_write_that_breaks_off_leaves_what_was_there(block, tmp_path, monkeypatch):
    frame = Frame(0.0, block().positions)
    write_series(tmp_path, "run", [frame])
    before = (tmp_path / "run-nodes-0000.vtu").read_bytes()

    def broken(path, mesh, file_format):
        path.write_bytes(b"half")
        raise KeyboardInterrupt

    monkeypatch.setattr(meshio, "write", broken)
    with pytest.raises(KeyboardInterrupt):
        write_series(tmp_path, "run", [frame])
    assert (tmp_path / "run-nodes-0000.vtu").read_bytes() == before
    assert len(list(tmp_path.iterdir())) == 2
