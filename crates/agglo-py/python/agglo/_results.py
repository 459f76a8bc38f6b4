"""What stands in the folder of a run."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from agglo import _agglo, _html, _plots
from agglo._agglo import Scenario
from agglo._errors import InputError
from agglo._optional import need
from agglo._recorded import Recorded
from agglo._shapes import Graph, genealogy, sizes, to_ase
from agglo._tables import Table
from agglo._types import Columns


class Run(Recorded):
    """The folder of a run: its scenario, summary, tables over time and frames."""

    _kind = ("run", "run")

    @property
    def scenario(self) -> Scenario:
        """What was run, with all defaults."""
        return Scenario.from_file(self._asked)

    def frames(self, kind: str = "grains") -> list[tuple[float, Path]]:
        """Times [s] and files of the frames of "grains", "bonds" or "rays"."""
        return [(time, Path(file)) for time, file in _agglo.frames(self.folder, kind)]

    def grains(self, frame: int = -1) -> tuple[float, Columns]:
        """The time [s] and the columns of the grains of a frame; of the last one if none is named.

        Raises:
            InputError: There is no such frame.
        """
        time, file = self._frame(frame, "grains")
        return time, _agglo.read_frame(file)

    def bonds(self, frame: int = -1) -> tuple[float, Columns]:
        """The time [s] and the bonds of a frame of soft spheres: `grain_i`, `grain_j` [m] (ids, the lower first) and `stretch` [m].

        `stretch` is the length over the first length, less 1. Besides, `id` [n] and `position_m` [n, 3] are those of all grains.

        Raises:
            InputError: There is no such frame, or the run began without bonds.
        """
        time, file = self._frame(frame, "bonds")
        return time, _agglo.read_frame(file)

    def rays(self, frame: int = -1) -> tuple[float, Columns]:
        """The time [s] and the rays in flight of a frame: `position_m`, `direction` [m, 3] and `power_W` [m].

        Raises:
            InputError: There is no such frame, or the run is without beams.
        """
        time, file = self._frame(frame, "rays")
        return time, _agglo.read_frame(file)

    def events(self) -> Table:
        """What happened, a row for each: bonds that broke or were made; merges and breakages of hard spheres.

        Raises:
            InputError: There is no such table.
        """
        return self.table("events")

    def genealogy(self) -> Graph:
        """Who became part of whom in a run of hard spheres, as a DiGraph of networkx from parents to children.

        A node is a grain for as long as it stays the same: `(id, event)`, with the event that made it, 0 for the start.
        Nodes have `grain` (the id), `born_s`, `ended_s` (not a number while it is there), `primaries` and `mass_kg`; edges
        have `event`, `time_s`, `kind` ("merge" or "break"), and the `primaries` and `mass_kg` that go from one to the other.

        Raises:
            PackageError: networkx is not installed.
            InputError: The run is of soft spheres, or has no first frame.
        """
        return genealogy(self.events(), self.table("genealogy"), self.grains(0)[1])

    def sizes(self, frame: int = -1) -> Table:
        """How many grains of a frame are in each class of size, and their part of the mass.

        Classes are 1, 2 to 3, 4 to 7, ... primaries, or those of the scenario's `output.size_classes`, of which the last has no
        end. Of soft spheres clusters are counted, by the grains in them.

        Raises:
            InputError: There is no such frame.
        """
        classes = self.scenario.to_dict().get("output", {}).get("size_classes")
        return sizes(self.grains(frame)[1], classes)

    def pyvista(self, frame: int = -1, kind: str = "grains") -> Any:
        """The "grains", "bonds" or "rays" of a frame as a mesh of PyVista: points, but lines for bonds.

        The mesh has the columns of the frame as data. Spheres of grains are
        `mesh.glyph(scale="radius_m", geom=pyvista.Sphere(radius=1.0), orient=False)`.

        Raises:
            PackageError: PyVista is not installed.
            InputError: There is no such frame.
        """
        vista = need("pyvista", "Run.pyvista")
        return vista.read(self._frame(frame, kind)[1])

    def ase(self, frame: int = -1, length_unit_m: float = 1.0) -> Any:
        """The grains of a frame as `Atoms` of ASE, with positions in units of `length_unit_m`; see `agglo.to_ase`.

        Raises:
            PackageError: ASE is not installed.
            InputError: There is no such frame.
        """
        time, grains = self.grains(frame)
        return to_ase(grains, length_unit_m, time)

    def plot(self, charts: Sequence[str] | None = None) -> Any:
        """Charts over time as a Figure of matplotlib, which the caller shows or saves.

        Args:
            charts: Which ones, in their order: of soft spheres "dispersion", "clusters", "stores", "flows", "rays", "beam",
                "flying", "power", "speed", "step", and with walls "walls", "wall_work", "passed"; of hard spheres "growth",
                "grains", "sizes", "largest", "impacts", "energy", "heat", "temperature", "speed", "step". If none are named, those that tell most.

        Raises:
            PackageError: matplotlib is not installed.
            InputError: There is no such chart.
        """
        return _plots.run(self, charts)

    def _frame(self, frame: int, kind: str) -> tuple[float, Path]:
        frames = self.frames(kind)
        try:
            return frames[frame]
        except IndexError:
            raise InputError(f"there is no frame {frame} of {kind} in {self.folder}; it has {len(frames)}") from None

    def _repr_html_(self) -> str:
        return _html.run(self)
