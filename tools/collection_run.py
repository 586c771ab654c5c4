"""Meshes and checks one case, for collection.py."""

import dataclasses
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

EXACT_CHECK = pathlib.Path(__file__).resolve().with_name("exact_check.py")

# Options that say how high the first layer is; with one of them the common first height is not given.
HEIGHT_OPTIONS = ("--first-height", "--y-plus", "--no-layers")


@dataclasses.dataclass
class LayerFigures:
    """Figures of the boundary layer, and of the walls below it."""
    elements: int        # outlines
    max_angle: float     # largest angle of a cell, in degrees
    transition: tuple    # 1st percentile, median and 99th percentile of the area ratio to the cells beyond; empty where
                         # the number of layers is given
    first_off: int       # first cells whose height is more than 1 % off
    first_cells: int
    wall_uneven: int     # wall vertices whose edges differ in length by a factor of more than 1.25
    ends_uneven: int     # columns whose ends differ by more than a third of a cell
    columns: int


@dataclasses.dataclass
class CurvedFigures:
    """Figures of cells of an order above 1, each proved valid."""
    cells: int
    least: float       # smallest scaled Jacobian
    straight: float    # that of the straight cells with the same corners
    at: tuple          # where the smallest one is
    wall_edges: int
    reduced: int       # wall edges whose bend is less than the wall's


@dataclasses.dataclass
class Figures:
    """Figures of a valid mesh."""
    triangles: int
    rays: tuple          # share of the rays that carry all requested layers: all rays, rays in the open
    cells: tuple         # share of the requested layer cells that were made: all, in the open
    first_lost: int      # wall edges whose cell is not of the first height
    wall_edges: int
    min_angle: float     # of the isotropic region, in degrees
    below_bound: int     # triangles with an angle below the bound that no sharp corner excuses
    exempt: int          # triangles that a sharp corner excuses
    refused: int         # points not placed, since they would encroach upon a frozen edge
    oversized: int       # triangles larger than the size field asks for
    warnings: list       # codes
    layer: "LayerFigures | None"   # of a mesh with a layer
    curved: "CurvedFigures | None"   # of a mesh with curved cells


@dataclasses.dataclass
class Result:
    """What became of a case."""
    names: tuple
    own_options: tuple
    outcome: str = "failed"    # valid, refused or failed
    reason: str = ""           # of what is not valid
    seconds: float = 0         # of meshing, without the check of the file
    figures: "Figures | None" = None   # of what is valid


def run(command, deadline):
    """Runs a command. Returns its exit code (None: it ran past the deadline; negative: a signal ended it), its standard
    output, and the line of its standard error that tells why it failed."""
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True,
                              timeout=max(0.01, deadline - time.monotonic()))
    except subprocess.TimeoutExpired:
        return None, "", "the time limit was reached"
    lines = done.stderr.decode("utf-8", "backslashreplace").strip().splitlines()
    errors = [line for line in lines if "error:" in line] or lines
    return done.returncode, done.stdout.decode("utf-8", "replace"), errors[-1] if errors else ""


def options_of(case, settings):
    """Returns the options to mesh a case with."""
    if case.options:
        return list(case.options)
    if any(option.split("=")[0] in HEIGHT_OPTIONS for option in settings.options):
        return settings.options
    return ["--first-height", repr(settings.first_height), *settings.options]


def name_of_end(code, reason, limit):
    """Returns in words how a run ended that was neither done nor refused."""
    if code is None:
        return f"no end within {limit:g} s"
    if code < 0:
        return f"ended by {signal.Signals(-code).name if -code in signal.valid_signals() else -code}"
    return f"exit code {code}: {reason}"


def share(part, whole):
    """Returns a part of a whole in per cent; 100 of nothing."""
    return 100 * part / whole if whole else 100.0


def layers_go_up_to_isotropy(options):
    """Returns whether layers end where cells are as high as wide, by the options: as asked for, or with the flow."""
    words = [word for option in options for word in option.split("=")]
    if "--layers" in words:
        return words[words.index("--layers") + 1] == "auto"
    return "--reynolds" in words


def layer_figures(report, options):
    """Returns the figures of the boundary layer of a mesh from its report; None where it has no layer."""
    quality = report["quality"]
    layer, walls, transition = quality["layer"], quality["walls"], quality["transition"]
    if not layer["cells"]:
        return None
    keys = ("p01_area_ratio", "median_area_ratio", "p99_area_ratio")
    return LayerFigures(
        elements=len(report["input"]),
        max_angle=layer["max_angle_deg"],
        transition=tuple(transition[key] for key in keys)
        if transition["edges"] and layers_go_up_to_isotropy(options) else (),
        first_off=round(walls["first_cells"] * (1 - walls["share_of_kept_heights"])),
        first_cells=walls["first_cells"],
        wall_uneven=walls["uneven_vertices"],
        ends_uneven=layer["border"]["uneven_columns"],
        columns=layer["border"]["columns"])


def curved_figures(report):
    """Returns the figures of the curved cells of a mesh from its report; None where cells are straight."""
    curved = report.get("curved")
    if not curved:
        return None
    return CurvedFigures(
        cells=report["triangles"] + report["quads"],
        least=curved["min_scaled_jacobian"],
        straight=curved["straight_min_scaled_jacobian"],
        at=tuple(curved["min_scaled_jacobian_at"]),
        wall_edges=curved["wall_edges"],
        reduced=curved["reduced_wall_edges"])


def figures_of(report, check, options):
    """Returns the figures of a mesh from its report, from what `lamina check` says of the file, and from its options."""
    layer, quality = report["layer_cells"], report["quality"]["isotropic"]
    parts = (layer, layer["open"])
    return Figures(
        triangles=report["triangles"],
        rays=tuple(share(p["rays"] - p["incomplete_rays"], p["rays"]) for p in parts),
        cells=tuple(share(p["made"], p["requested"]) for p in parts),
        first_lost=report["quality"]["layer"]["edges_without_first_layer"] + report["quality"]["walls"]["bare_edges"],
        wall_edges=report["surface_vertices"],   # walls are closed: they have as many edges as vertices
        min_angle=check["quality"]["isotropic"]["min_angle_deg"],
        below_bound=quality["angles_below_bound"] - quality["exempt"],
        exempt=quality["exempt"],
        refused=quality["refused_points"],
        oversized=quality["oversized"],
        warnings=[warning["code"] for warning in report["warnings"]],
        layer=layer_figures(report, options),
        curved=curved_figures(report))


def mesh_and_check(case, settings, scratch, result):
    """Fills in the result of a case; may throw what reading a missing or broken report throws."""
    files = [str(f) for f in case.files]
    deadline = time.monotonic() + settings.limit
    options = options_of(case, settings)
    mesh, report = f"{scratch}/mesh.vtu", pathlib.Path(scratch) / "report.json"
    second = f"{scratch}/mesh.su2"
    outputs = ["-o", mesh, "-o", second] if settings.exact else ["-o", mesh]
    start = time.monotonic()
    code, _, reason = run([settings.program, "mesh", *files, *options, "--threads", "1", "--quiet", *outputs,
                           "--report", str(report)], deadline)
    result.seconds = time.monotonic() - start
    if code == 3:
        result.outcome, result.reason = "refused", reason
    elif code != 0:
        result.reason = name_of_end(code, reason, settings.limit)
    else:
        code, text, reason = run([settings.program, "check", mesh, "--json"], deadline)
        if code != 0:
            result.reason = f"lamina check: {name_of_end(code, reason, settings.limit)}"
            return
        if settings.exact:
            code, said, reason = run([sys.executable, str(EXACT_CHECK), second], deadline)
            if code != 0:
                result.reason = f"exact_check.py: {said.strip() or name_of_end(code, reason, settings.limit)}"
                return
        result.figures = figures_of(json.loads(report.read_text(encoding="utf-8")), json.loads(text), options)
        result.outcome = "valid"


def mesh_case(case, settings):
    """Meshes and checks a case. Returns its result, whatever happens."""
    result = Result(case.names, case.options)
    try:
        with tempfile.TemporaryDirectory() as scratch:
            mesh_and_check(case, settings, scratch, result)
    except (ValueError, KeyError, TypeError) as error:
        result.reason = f"the report or the output of lamina check cannot be read: {type(error).__name__}: {error}"
    except OSError as error:
        result.reason = f"{error.strerror}: {pathlib.Path(error.filename or '').name}"
    for folder in {str(f.parent) for f in case.files}:
        result.reason = result.reason.replace(folder + "/", "")
    result.reason = result.reason.replace("lamina: error: ", "")
    return result
