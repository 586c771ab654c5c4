"""What the other commands of the program do: flow, polar, forecast, info, case, family, sizes, convert, view."""

from __future__ import annotations

import json
import math
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _lamina
from ._arrays import Values, doubles, signed, unsigned
from ._errors import InputError, MeshWarning, OptionError, RunEstimate, UsageError
from ._mesh import Mesh, read
from ._meshing import made_mesh, run_arguments
from ._options import with_options
from ._progress import Progress, callback_of
from ._sections import Sections

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ._meshing import MeshOptions

#: A Reynolds number chooses a preset for meshes, and changes no wall where there is none.
_NO_PRESET = {"preset": "none"}

#: The names of the numbers in FlowSide.state.
BOUNDARY_LAYER_STATES = ("laminar", "turbulent", "separated")

#: As of `lamina family`.
_MOST_LEVELS = 12


@dataclass(frozen=True, eq=False, repr=False)
class FlowSide(Values):
    """The flow along one side of a body, from the stagnation point to the trailing edge. Thicknesses and friction are 0
    without a Reynolds number; None is what this kind of flow does not have.

    Examples
    --------
    >>> side = lamina.flow("naca:0012").elements["airfoil"].lower
    >>> round(float(side.cp.max()), 2)
    1.0
    """

    points: np.ndarray  #: (n, 2) on the wall
    cp: np.ndarray  #: (n,) pressure coefficient
    momentum: np.ndarray  #: (n,) momentum thickness
    displacement: np.ndarray  #: (n,) displacement thickness
    skin_friction: np.ndarray  #: (n,) wall shear stress over the dynamic pressure of the free stream
    arc_length: np.ndarray | None = None  #: (n,) from the stagnation point
    speed: np.ndarray | None = None  #: (n,) as a multiple of the free stream's
    thickness: np.ndarray | None = None  #: (n,) of the boundary layer
    shape: np.ndarray | None = None  #: (n,) displacement over momentum thickness
    state: np.ndarray | None = None  #: (n,) indices into BOUNDARY_LAYER_STATES
    mach: np.ndarray | None = None  #: (n,) where the flow is faster than sound
    shocks: Sequence[Mapping[str, Any]] = ()  #: each with `at`, `position`, `mach_ahead` and `mach_behind`

    def __len__(self) -> int:
        return len(self.points)


@dataclass(frozen=True, eq=False, repr=False)
class ElementFlow(Values):
    """The flow along both sides of a body.

    Examples
    --------
    >>> flow = lamina.flow("naca:0012", alpha=4)
    >>> side = flow.elements["airfoil"].upper
    >>> bool(side.cp.min() < -1)
    True
    """

    upper: FlowSide  #: the side that follows the outline clockwise
    lower: FlowSide  #: the side that follows the outline counter-clockwise


@dataclass(frozen=True, eq=False, repr=False)
class Flow(Values):
    """The flow before a mesh. Where it is nowhere faster than sound, the mesh is None, and so are drags without layers.

    Examples
    --------
    >>> flow = lamina.flow("naca:0012", alpha=4)
    >>> round(flow.lift, 2)
    0.48
    >>> flow.triangles is None
    True
    """

    alpha: float  #: direction of the free stream, in degrees
    chord: float  #: reference length of the coefficients
    lift: float  #: lift coefficient
    elements: Mapping[str, ElementFlow]  #: by the names of the bodies
    mach: float | None = None  #: of the free stream
    has_layers: bool = False  #: whether there are boundary layers
    warnings: Sequence[MeshWarning] = ()  #: where the flow separates, or could not be found
    drag: float | None = None  #: drag coefficient; of attached layers by Squire and Young
    moment: float | None = None  #: of the pressures, nose up, about a quarter chord; None with shocks
    transition_upper: float | None = None  #: share of the extent in x where the layer is turbulent; None for several bodies
    transition_lower: float | None = None  #: the same on the lower side; None where layers do not displace the flow
    viscous_drag: float | None = None  #: of boundary layers and wakes
    wave_drag: float | None = None  #: of shocks
    converged: bool = True  #: whether the flow is steady, and agrees with layers that displace it
    points: np.ndarray | None = None  #: (p, 2) of the mesh that the compressible flow was found on
    triangles: np.ndarray | None = None  #: (t, 3) of that mesh
    mach_numbers: np.ndarray | None = None  #: (p,) at its points


def transition_values(ncrit: float | None, trip: float | None, trip_lower: float | None) -> list[tuple[str, float]]:
    """Returns the options of transition that are given, as the C++ part takes them."""
    given = {"ncrit": ncrit, "trip": trip, "trip-lower": trip_lower}
    return [(name, float(value)) for name, value in given.items() if value is not None]


@with_options
def flow(sections: Sections, *, ncrit: float | None = None, trip: float | None = None,
         trip_lower: float | None = None, **options: Unpack[MeshOptions]) -> Flow:
    """Computes the flow round sections without a mesh, as `lamina flow` does: incompressible flow, which boundary layers
    displace outside of rows of blades, or the Euler equations where `mach` makes it faster than sound.

    ncrit: the exponent of waves at which layers become turbulent (9). trip: the share of the extent in x where they are so
    at the latest, and trip_lower on the lower side.

    Of the options of `lamina.mesh()` those of the flow count (`alpha`, `mach`, `reynolds`, `chord`, ...), of the geometry,
    and of walls outside (`ground`, `tunnel`, `periodic`). Raises OptionError, InputError and IoError.

    Examples
    --------
    >>> flow = lamina.flow("naca:2412", alpha=-2.1, reynolds=1e6, trip=0.1)
    >>> flow.lift < 0.1, round(flow.transition_upper, 4)
    (True, 0.1)
    """
    arguments = run_arguments(sections, {**_NO_PRESET, **options})
    facts = _lamina.flow(arguments.sections, arguments.values, transition_values(ncrit, trip, trip_lower))
    facts["elements"] = {name: ElementFlow(FlowSide(**upper), FlowSide(**lower))
                         for name, upper, lower in facts["elements"]}
    facts["warnings"] = [MeshWarning._from(warning) for warning in facts.get("warnings", ())]
    if "triangles" in facts:
        facts["triangles"] = signed(facts["triangles"])
    for warning in facts["warnings"]:
        warnings.warn(warning, stacklevel=2)
    return Flow(**facts)


@dataclass(frozen=True, eq=False, repr=False)
class Polar(Values):
    """The forces at many angles of attack, as columns. Numbers that nobody has found are NaN.

    Examples
    --------
    >>> polar = lamina.polar("naca:0012", alpha="0:8:4", reynolds=1e6)
    >>> len(polar), bool((polar.cl[1:] > polar.cl[:-1]).all())
    (3, True)
    """

    name: str  #: of the configuration
    reynolds: float | None  #: Reynolds number
    mach: float | None  #: Mach number
    alpha: np.ndarray  #: (n,) angles of attack in degrees
    cl: np.ndarray  #: (n,) lift coefficients
    cd: np.ndarray  #: (n,) drag coefficients
    cdp: np.ndarray  #: (n,) the part of the pressure in them
    cm: np.ndarray  #: (n,) moments about the quarter chord, nose up
    top_xtr: np.ndarray  #: (n,) share of the extent in x where the upper layer becomes turbulent
    bottom_xtr: np.ndarray  #: (n,) the same on the lower side
    y_plus: np.ndarray  #: (n,) the largest y+ on the mesh of a solver
    state: Sequence[str]  #: whether each row can be trusted: "attached", "separated", "stalled", "steady", ...
    steady: np.ndarray  #: (n,) whether the state is one of a steady flow that the method is for
    note: Sequence[str]  #: more about the states
    undisplaced: bool = False  #: whether the lift of a row is too high, since layers do not displace its flow

    def __len__(self) -> int:
        return len(self.alpha)

    def table(self) -> Any:
        """Returns the columns as a DataFrame of pandas, or as a dictionary where pandas is not installed.

        Examples
        --------
        >>> table = lamina.polar("naca:0012", alpha="0:2:2", reynolds=1e6).table()
        >>> list(table)[:3]
        ['alpha', 'cl', 'cd']
        """
        of_all = ("name", "reynolds", "mach", "undisplaced")
        columns = {f.name: getattr(self, f.name) for f in fields(self) if f.name not in of_all}
        try:
            import pandas  # type: ignore[import-not-found, import-untyped, unused-ignore]
        except ImportError:
            return columns
        return pandas.DataFrame(columns)


def _polar_of(text: str) -> Polar:
    facts = json.loads(text)
    rows = facts["rows"]
    keys = {"cl": "CL", "cd": "CD", "cdp": "CDp", "cm": "CM"}

    def column(name: str) -> np.ndarray:
        key = keys.get(name, name)
        return np.array([math.nan if row.get(key) is None else row[key] for row in rows], dtype=float)

    numbers = {name: column(name) for name in ("alpha", *keys, "top_xtr", "bottom_xtr", "y_plus")}
    return Polar(name=facts["name"], reynolds=facts["reynolds"], mach=facts["mach"], **numbers,
                 state=[row["state"] for row in rows], steady=np.array([row["steady"] for row in rows], dtype=bool),
                 note=[row["note"] for row in rows], undisplaced=facts.get("undisplaced", False))


@with_options
def polar(sections: Sections, *, ncrit: float | None = None, trip: float | None = None,
          trip_lower: float | None = None, **options: Unpack[MeshOptions]) -> Polar:
    """Computes the polar of sections without a mesh, as `lamina flow` does for a range of angles: `alpha="-4:18:1"`.

    The other arguments are those of `flow()`. read_polar() reads those that `lamina polar` finds by solvers.

    Examples
    --------
    >>> polar = lamina.polar("naca:2412", alpha="-2:6:2", reynolds=3e6)
    >>> polar.state
    ['attached', 'attached', 'attached', 'attached', 'attached']
    """
    if not isinstance(options.get("alpha"), str):
        raise UsageError("alpha: a polar needs a range, such as '-4:18:1'")
    arguments = run_arguments(sections, {**_NO_PRESET, **options})
    return _polar_of(_lamina.polar(arguments.sections, arguments.values, transition_values(ncrit, trip, trip_lower)))


def read_polar(file: str | os.PathLike[str]) -> Polar:
    """Reads `polar.json`, which `lamina polar` writes, or the one in a folder.

    Examples
    --------
    >>> import json, pathlib
    >>> row = {"alpha": 4, "CL": 0.44, "CD": 0.009, "state": "steady", "steady": True, "note": ""}
    >>> _ = pathlib.Path("polar.json").write_text(json.dumps({"name": "a", "reynolds": 1e6, "mach": None, "rows": [row]}))
    >>> lamina.read_polar("polar.json").cl
    array([0.44])
    """
    path = os.fspath(file)
    if os.path.isdir(path):
        path = os.path.join(path, "polar.json")
    with open(path, encoding="utf-8") as stream:
        text = stream.read()
    try:
        return _polar_of(text)
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"{path}: is no polar.json of lamina: {error}") from error


@dataclass(frozen=True, eq=False, repr=False)
class WallForecast(Values):
    """The layer on the wall of one element, before there is a mesh.

    Examples
    --------
    >>> forecast = lamina.forecast("naca:0012", reynolds=1e6)
    >>> forecast.walls[0].element
    'airfoil'
    """

    element: str  #: its name
    first_height: float  #: in units of the input
    thickness: float  #: of the highest column, in units of the input
    y_plus: tuple[float, float, float] | None = None  #: smallest, median and largest y+; None without a Reynolds number


@dataclass(frozen=True, eq=False, repr=False)
class Forecast(Values):
    """A mesh before it is made.

    Examples
    --------
    >>> forecast = lamina.forecast("naca:0012", reynolds=1e6)
    >>> 0 < forecast.layer_cells < forecast.cells
    True
    """

    vertices: float  #: number of vertices, by estimate
    layer_cells: float  #: number of cells in the layer
    cells_beyond: float  #: number of triangles beyond it, by estimate
    chord: float  #: in units of the input
    estimate: RunEstimate  #: memory and time of the run
    walls: Sequence[WallForecast]  #: one for each element; empty without layers
    warnings: Sequence[MeshWarning] = ()  #: what is unusual

    @property
    def cells(self) -> float:
        """Number of all cells.

        Examples
        --------
        >>> forecast = lamina.forecast("naca:0012", cells=20000, reynolds=1e6)
        >>> abs(forecast.cells - 20000) < 600
        True
        """
        return self.layer_cells + self.cells_beyond


@with_options
def forecast(sections: Sections, **options: Unpack[MeshOptions]) -> Forecast:
    """Says what `mesh()` would make, in some hundredths of a second, as `lamina mesh --dry-run` does. Arguments and errors
    are those of `mesh()`.

    Examples
    --------
    >>> forecast = lamina.forecast("naca:0012", reynolds=1e6)
    >>> mesh = lamina.mesh("naca:0012", reynolds=1e6)
    >>> abs(forecast.cells / (len(mesh.triangles) + len(mesh.quads)) - 1) < 0.1
    True
    """
    arguments = run_arguments(sections, options)
    facts = _lamina.forecast(arguments.sections, arguments.values, arguments.sizes)
    facts["walls"] = [WallForecast(**wall) for wall in facts["walls"]]
    facts["warnings"] = [MeshWarning._from(warning) for warning in facts["warnings"]]
    for warning in facts["warnings"]:
        warnings.warn(warning, stacklevel=2)
    return Forecast(**facts)


@dataclass(frozen=True, eq=False, repr=False)
class Info(Values):
    """What is known of sections. print() shows what `lamina info` does.

    Examples
    --------
    >>> lamina.info("naca:0012").elements[0]["name"]
    'airfoil'
    """

    elements: Sequence[Mapping[str, Any]]  #: per body: name, source, format, repairs, wall_vertices and so on
    text: str  #: the same as text

    def __str__(self) -> str:
        return self.text


@with_options
def info(sections: Sections, **options: Unpack[MeshOptions]) -> Info:
    """Describes sections as they were read, repaired and prepared, as `lamina info` does.

    Examples
    --------
    >>> print(lamina.info("naca:0012").text.splitlines()[0])
    airfoil
    """
    arguments = run_arguments(sections, {**_NO_PRESET, **options})
    return Info(*_lamina.describe(arguments.sections, arguments.values))


@with_options
def case(solver: Literal["openfoam", "su2", "pyfr"], folder: str | os.PathLike[str], sections: Sections, *,
         turbulence: Literal["sa", "komega-sst", "laminar"] | None = None, unsteady: bool = False,
         overwrite: bool = False, progress: Progress = None,
         **options: Unpack[MeshOptions]) -> Mesh:
    """Makes a mesh and writes it into a folder with all that a flow solver needs beside it, as `lamina case` does.

    turbulence: the model; None: none below a Reynolds number of 1e4 and for PyFR, Spalart-Allmaras above. unsteady: the
    case is solved in time. overwrite: files of the folder are replaced. Returns the mesh. Raises what `lamina.mesh()`
    raises, and UsageError where files are there already.

    Examples
    --------
    >>> mesh = lamina.case("su2", "case", "naca:0012", reynolds=1e6, layers=10)
    >>> import os
    >>> "mesh.su2" in os.listdir("case")
    True
    """
    arguments = run_arguments(sections, options)
    with callback_of(progress) as callback:
        mesh = made_mesh(_lamina.write_case(
            solver, os.fspath(folder), turbulence or "", unsteady, overwrite, arguments.sections, arguments.values,
            arguments.sizes, callback))
    for warning in mesh.warnings:
        warnings.warn(warning, stacklevel=2)
    return mesh


@dataclass(frozen=True, eq=False, repr=False)
class FamilyMember(Values):
    """One mesh of a family.

    Examples
    --------
    >>> coarse, fine = lamina.family("naca:0012", levels=2, ratio=2, first_height=1e-3)
    >>> coarse.divisor, fine.divisor
    (0.5, 1)
    """

    level: int  #: 0 is the coarsest
    divisor: float  #: lengths are those of the options divided by this
    mesh: Mesh
    h: float  #: the root of the mean area of the cells: the length of Richardson extrapolation
    path: str | None = None  #: the file that was written


@with_options
def family(sections: Sections, *, levels: int = 4, ratio: float = math.sqrt(2), base_level: int | None = None,
           write: str | None = None, progress: Progress = None,
           **options: Unpack[MeshOptions]) -> list[FamilyMember]:
    """Makes similar meshes, each finer than the one before, as `lamina family` does.

    levels: their number, up to 12. ratio: of all lengths from one to the next. base_level: the level with the lengths of the
    options; None: the middle one. write: path of the mesh files, with {level} in it. The finest mesh is made first.

    Examples
    --------
    >>> members = lamina.family("naca:0012", levels=2, ratio=2, first_height=1e-3)
    >>> [member.level for member in members]
    [0, 1]
    """
    if not 1 <= levels <= _MOST_LEVELS:
        raise OptionError(f"levels: must be from 1 to {_MOST_LEVELS}, not {levels}")
    base = levels // 2 if base_level is None else base_level
    if not 0 <= base < levels:
        raise OptionError(f"base_level: must be from 0 to {levels - 1}, not {base}")
    if not 1 < ratio <= 10:
        raise OptionError(f"ratio: must be above 1 and at most 10, not {ratio}")
    if write is not None and "{level}" not in write:
        raise UsageError(f"write: '{write}' must hold {{level}}, which stands for the number of the level")
    arguments = run_arguments(sections, options)
    members = []
    for level in reversed(range(levels)):
        divisor = math.prod([ratio] * abs(level - base))
        divisor = divisor if level >= base else 1 / divisor
        with callback_of(progress) as callback:
            mesh = made_mesh(_lamina.generate(arguments.sections, arguments.values, arguments.sizes, callback, None,
                                              divisor))
        for warning in mesh.warnings:
            warnings.warn(warning, stacklevel=2)
        path = None if write is None else write.replace("{level}", str(level))
        if path is not None:
            mesh.write(path)
        members.append(FamilyMember(level, divisor, mesh, math.sqrt(float(mesh.areas.mean())), path))
    return members[::-1]


@dataclass(frozen=True, eq=False, repr=False)
class SolutionSizes(Values):
    """Edge lengths that a solution asks for.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> found = lamina.sizes(mesh, {"p": mesh.points[:, 0] ** 2}, vertices=5000)
    >>> found.points.shape[1], bool(found.sizes.min() > 0)
    (2, True)
    """

    points: np.ndarray  #: (n, 2)
    triangles: np.ndarray  #: (m, 3)
    sizes: np.ndarray  #: (n,) at the points
    gradation: float | None  #: growth per unit of distance
    vertices: int  #: that the next mesh will have
    errors: Sequence[float]  #: per field: an estimate of its error of interpolation before

    @property
    def background(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """What `background` of `lamina.mesh()` takes."""
        return self.points, self.triangles, self.sizes

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes a VTU file for `lamina mesh --background`."""
        _lamina.write_sizes(self.points, unsigned(self.triangles), self.sizes, self.gradation, os.fspath(path))


def sizes(solution: str | os.PathLike[str] | Mesh, fields: str | Sequence[str] | Mapping[str, ArrayLike], *,
          vertices: float, mesh: str | os.PathLike[str] | None = None, norm: float | None = None,
          gradation: float | None = None, max_change: float | None = None) -> SolutionSizes:
    """Returns the edge lengths with which a mesh of so many vertices interpolates a solution best, as `lamina sizes` does.

    solution: a file or folder of a solver, `fields` being names ("p", "U:x", "mag(U)") and `mesh` the file of its mesh
    where the solution does not hold it; or a Mesh, `fields` being arrays by their names, with a number for each point or
    for each cell. norm: large ones see large errors above all. max_change: largest factor by which sizes change.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> found = lamina.sizes(mesh, {"p": mesh.points[:, 0] ** 2}, vertices=5000)
    >>> len(found.sizes) == len(found.points)
    True
    """
    if isinstance(solution, Mesh):
        if not isinstance(fields, Mapping):
            raise UsageError("fields: give arrays by their names for a mesh")
        if mesh is not None:
            raise UsageError("mesh: the solution is a mesh itself")
        data = solution._data
        arrays = [_field(solution, str(name), values) for name, values in fields.items()]
    else:
        names = [fields] if isinstance(fields, str) else [str(name) for name in fields]
        data, arrays = _lamina.read_solution(os.fspath(solution), names, "" if mesh is None else os.fspath(mesh))
    count = float(doubles(vertices, "vertices"))
    found = SolutionSizes(*_lamina.sizes_of_fields(data, arrays, count, norm, gradation, max_change))
    return replace(found, triangles=signed(found.triangles))


def _field(mesh: Mesh, name: str, values: ArrayLike) -> tuple[str, bool, np.ndarray]:
    array = doubles(values, name)
    if array.shape not in ((len(mesh.points),), (len(mesh),)):
        raise InputError(f"{name}: must have one number for each of {len(mesh.points)} points or {len(mesh)} cells, not "
                         f"the shape {array.shape}")
    return name, array.shape != (len(mesh.points),), array


def convert(source: str | os.PathLike[str], target: str | os.PathLike[str], *, input_format: str = "",
            **options: Any) -> Mesh:
    """Reads a mesh and writes it in another format, as `lamina convert` does. options: those of `Mesh.write()`. Returns
    the mesh.

    Examples
    --------
    >>> lamina.mesh("naca:0012", first_height=1e-3).write("naca.vtu")
    >>> mesh = lamina.convert("naca.vtu", "naca.su2")
    >>> lamina.read("naca.su2") == mesh
    True
    """
    mesh = read(source, format=input_format)
    mesh.write(target, **options)
    return mesh


class Page:
    """A page with an interactive view of a mesh: one HTML file. Notebooks show it in a frame.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> lamina.view(mesh).html[:15]
    '<!DOCTYPE html>'
    """

    def __init__(self, html: str, height: int) -> None:
        self.html = html  #: the page
        self.height = height  #: of the frame in notebooks, in pixels

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the page to a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.html)

    def open(self) -> str:
        """Writes the page to a temporary file, opens that in a browser, and returns its path."""
        import tempfile
        import webbrowser

        with tempfile.NamedTemporaryFile("w", suffix=".html", encoding="utf-8", delete=False) as file:
            file.write(self.html)
        webbrowser.open("file://" + file.name)
        return file.name

    def __len__(self) -> int:
        return len(self.html)

    def __repr__(self) -> str:
        return f"<lamina.Page of {len(self.html):,} characters: show it in a notebook, or save() or open() it>"

    def _repr_html_(self) -> str:
        from html import escape

        return (f'<iframe srcdoc="{escape(self.html)}" width="100%" height="{self.height}" '
                'style="border:0" allowfullscreen></iframe>')


def view(mesh: Mesh | str | os.PathLike[str], *, title: str = "mesh", height: int = 600) -> Page:
    """Returns the page that `lamina view` writes, to zoom into a mesh: in a notebook it appears in a frame.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> "<html" in lamina.view(mesh, title="NACA 0012").html
    True
    """
    return Page(_lamina.page((mesh if isinstance(mesh, Mesh) else read(mesh))._data, title), height)
