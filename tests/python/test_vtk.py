"""VTK reads what agglo writes.

Needs `vtk`, `numpy` and `pytest` from PyPI, and cargo. The expected numbers are those of
crates/agglo/examples/write_frames.rs.
"""

import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

vtk = pytest.importorskip("vtk")
from vtk.util.numpy_support import vtk_to_numpy  # noqa: E402

@pytest.fixture(scope="module")
def folder(tmp_path_factory, built):
    out = tmp_path_factory.mktemp("frames")
    subprocess.run([built / "examples/write_frames", out], check=True)
    return out


def read(path):
    complaints = []
    reader = vtk.vtkXMLPolyDataReader()
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append("error"))
    reader.AddObserver("WarningEvent", lambda *_: complaints.append("warning"))
    reader.SetFileName(str(path))
    reader.Update()
    assert not complaints
    return reader.GetOutput()


def field(data, name):
    array = data.GetArray(name)
    assert array is not None, name
    return vtk_to_numpy(array)


@pytest.mark.parametrize(("frame", "time"), [(0, 0.0), (1, 0.25)])
def test_grains_stand_in_the_order_of_their_names(folder, frame, time):
    grains = read(folder / f"frames/grains-{frame:05}.vtp")
    k = np.arange(5.0)
    points = vtk_to_numpy(grains.GetPoints().GetData())
    assert points.dtype == np.float64
    assert np.array_equal(points, np.stack([k, 0.5 * k, -k + time], axis=1))
    data = grains.GetPointData()
    assert np.array_equal(field(data, "id"), np.arange(5))
    assert np.array_equal(field(data, "radius_m"), 0.1 + 0.01 * k)
    assert np.array_equal(field(data, "mass_kg"), 1.0 / 3.0 + k)
    assert np.array_equal(field(data, "velocity_m_s"), np.tile([0.0, 0.0, 1.0], (5, 1)))
    assert np.array_equal(field(data, "material"), np.arange(5) % 2)
    assert np.array_equal(field(data, "cluster"), [0, 0, 1, 1, 2])
    assert np.array_equal(field(data, "temperature_K"), np.full(5, 300.0))
    assert data.GetArray("position_m") is None
    assert grains.GetNumberOfVerts() == 5
    assert field(grains.GetFieldData(), "TimeValue")[0] == time


def test_bonds_are_lines_between_grains(folder):
    bonds = read(folder / "frames/bonds-00001.vtp")
    assert bonds.GetNumberOfLines() == 2
    # In memory they join places [4, 3] and [2, 1], and the grain named k is at place 4 - k.
    ends = [[bonds.GetCell(line).GetPointId(end) for end in range(2)] for line in range(2)]
    assert ends == [[0, 1], [2, 3]]
    cells = bonds.GetCellData()
    assert np.array_equal(field(cells, "grain_i"), [0, 2])
    assert np.array_equal(field(cells, "grain_j"), [1, 3])
    assert np.array_equal(field(cells, "strain"), [0.125, -0.25])
    assert bonds.GetCell(0).GetPoints().GetPoint(1) == (1.0, 0.5, -0.75)


def test_points_of_bonds_are_the_grains_of_these_names(folder):
    bonds = read(folder / "frames/bonds-00001.vtp")
    grains = read(folder / "frames/grains-00001.vtp")
    assert np.array_equal(field(bonds.GetPointData(), "id"), field(grains.GetPointData(), "id"))
    places = [vtk_to_numpy(data.GetPoints().GetData()) for data in (bonds, grains)]
    assert np.array_equal(*places)


def test_rays_have_direction_and_power(folder):
    rays = read(folder / "frames/rays-00000.vtp")
    assert rays.GetNumberOfPoints() == 2
    assert np.array_equal(field(rays.GetPointData(), "direction"), [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]])
    assert np.array_equal(field(rays.GetPointData(), "power_W"), [1.5, 0.75])


def test_the_list_leads_to_every_frame(folder):
    frames = ElementTree.parse(folder / "grains.pvd").getroot().find("Collection").findall("DataSet")
    assert [float(frame.get("timestep")) for frame in frames] == [0.0, 0.25]
    for frame in frames:
        assert read(folder / frame.get("file")).GetNumberOfPoints() == 5
