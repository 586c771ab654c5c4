"""Meshes round sections. Generated from the option tables: `python -m lamina._stubs` prints this file."""

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypedDict

from numpy import ndarray
from typing_extensions import Unpack

from . import _lamina
from ._mesh import Mesh
from ._progress import Callback, Progress
from ._sections import Sections

class MeshOptions(TypedDict, total=False):
    """The options of mesh(). None stands for the default."""

    # options to begin with, which all others override; auto: rans where a Reynolds number is given, else none
    # [auto]
    preset: Literal["auto", "none", "rans", "wall-function", "euler", "les2d", "thesis"] | None
    # what becomes of the given points: they are kept, replaced by new ones on a spline through them, or
    # replaced where they are coarse [auto]
    surface: Literal["auto", "keep", "resample"] | None
    # wall vertices per element, about; else as many as the ray angle requires; >= 3 and <= 1e+07
    surface_points: int | None
    # for sections whose meshes are to have the same walls and layers by number: exactly N wall vertices on each
    # element, or there is no mesh; BASE edges on the base of a blunt trailing edge (N / 50); one ray at each
    # vertex, but at sharp corners a fan with the rays of half a turn, max-ray-angle apart; >= 3 and <= 1e+07
    exact_points: str | float | Sequence[float] | None
    # exactly so many wall edges on both sides of each element, or of one, or there is no mesh; BASE edges on
    # the base of a blunt trailing edge (one for 50 of the others); may be given several times; >= 1 and <=
    # 1e+06
    points: str | float | Sequence[str | float] | None
    # wall spacing at the leading edge at most, in lengths of the element; makes auto resample. Where the
    # curvature asks for less, it gets less; > 0
    spacing_le: float | None
    # wall spacing at the trailing edge, in lengths of the element; makes auto resample; else as the layer asks,
    # about 0.001; > 0
    spacing_te: float | None
    # wall spacing at a station of an element, or of all, at most: X from 0 at the leading to 1 at the trailing
    # edge, SHARE in lengths of the element; ELEMENT:upper:X=SHARE (lower) on one side; makes auto resample; may
    # be given several times
    spacing_at: str | float | Sequence[str | float] | None
    # with surface keep and curved cells (order), walls follow the spline through their points between corners;
    # else they are straight from point to point
    curve_kept: bool | None
    # largest wall spacing, in lengths of the element; > 0 [0.02]
    spacing_max: float | None
    # smooth the points first; none moves by more than this; > 0
    smooth: float | str | None
    # marker names, one per element; else the stems of the files, or 'airfoil' for a single element; names that
    # not every format takes are changed
    names: str | Sequence[str | float] | None
    # close outlines whose ends lie apart by a straight edge, however long it is
    close: bool | None
    # complete symmetric sections of which the files hold one half, from nose to tail: the other half is its
    # mirror image
    mirror_half: bool | None
    # join bodies that overlap or touch, after all transformations: the outline is the outer border of their
    # union, and each part of the wall keeps the marker of its body
    union: bool | None
    # make blunt trailing edges sharp: extend both sides straight, or blend them together; before transform
    sharpen_te: Literal["extend", "blend"] | None
    # gap of all trailing edges, in chords of their elements: the sides move apart, which fades over DISTANCE
    # chords as with XFOIL's TGAP; 1, the default: in proportion to the distance from the nose
    open_te: str | float | Sequence[float] | None
    # change of an element, given by its name, or of all: scale:S[:X,Y], rotate:DEG[:X,Y] (counter-clockwise,
    # about the origin or X,Y), shift:DX,DY, mirror[:Y] (in a horizontal line), flap:DEG:X,Y (a plain flap with
    # its hinge at X,Y, downwards); may be given several times, in order
    transform: str | float | Sequence[str | float] | None
    # a body without thickness with the marker NAME, as a sail, a splitter plate or a Gurney strip: a wall with
    # layers on both sides along the points of PLACE, X0,Y0,X1,Y1[,...] or a file of them, in units of the
    # input; an end at a wall stands on that; may be given several times, without INPUT too
    sheet: str | float | Sequence[str | float] | None
    # reference chord, in units of the input: what lengths in chords count; the name of an element: its extent
    # in x; else the extent in x of the configuration; both before --transform turns them; > 0
    chord: float | str | None
    # angle of attack, in degrees: the flow comes from the left and rises at this angle; nothing is turned; a
    # range: the mesh serves all angles from A to B, by the flow at each step (1); >= -90 and <= 90 [0]
    alpha: float | str | None
    # Reynolds number of the free stream, based on the chord; > 0
    reynolds: float | None
    # velocity of the free stream, in units of the input per second; with the viscosity it gives the Reynolds
    # number; > 0
    velocity: float | None
    # kinematic viscosity, in squared units of the input per second; > 0
    viscosity: float | None
    # Mach number of the free stream; makes a case of OpenFOAM one of compressible flow and, with the flow's
    # help, the mesh finer at shocks; > 0
    mach: float | None
    # height of the first layer above the wall; > 0 [1e-05]
    first_height: float | str | None
    # instead: y+ of the top of the first layer, on a flat plate or, with use-flow, where friction is largest;
    # needs reynolds, or velocity and viscosity; > 0
    y_plus: float | None
    # ratio of the heights of successive layers, or power of the polynomial law; > 1 [1.2]
    growth: float | None
    # height of the top of layer n, where H is the first height: geometric, H (R^n - 1) / (R - 1); polynomial, H
    # n^R; exponential, T (e^(a n/N) - 1) / (e^a - 1), where a makes the first layer H high; adaptive,
    # geometric, where a ratio of 1.05 to 1.5 makes the last layer as high as the rays stand apart; aflr, 5
    # layers of H, then each 1.05, 1.05^2, ... 1.5, 1.5 ... times as high as the one below [geometric]
    growth_law: Literal["geometric", "polynomial", "exponential", "adaptive", "aflr"] | None
    # number of layers; auto: on each ray up to cells as high as wide; >= 1 and <= 65535 [auto]
    layers: int | Literal["auto"] | None
    # total height beyond which no layer goes; > 0
    thickness: float | str | None
    # isotropic triangles up to the wall
    no_layers: bool | None
    # largest angle by which neighbouring rays diverge, in degrees; >= 0.01 and <= 90 [5]
    max_ray_angle: float | None
    # at sharp convex corners: a fan of rays, or refining rays beside the vertex [fan]
    corners: Literal["fan", "refine"] | None
    # cells of the layer: Delaunay triangles, or the grid of rays and layers, cut or left whole [layered]
    layer_topology: Literal["delaunay", "layered", "quads"] | None
    # whether layers up to isotropy go on behind trailing edges, along the wakes that the flow finds; needs
    # use-flow and layers auto; behind blunt bases cell-centred solvers may diverge on it [no]
    wake_layers: bool | None
    # half-width of the far-field box or radius of the circle; > 0 [100]
    far_field: float | str | None
    # shape of the far field round the middle of the configuration [box]
    far_field_shape: Literal["box", "circle"] | None
    # instead: corners of a convex far field, counter-clockwise, in units of the input
    far_field_outline: str | float | Sequence[float] | None
    # height of a wind tunnel with the configuration or the line of symmetry in its middle, or on its ground,
    # and how far it goes on ahead of the configuration and behind it; else 10 and 15 chords, or 3 and 4
    # heights, the larger of both, unless far-field says it
    tunnel: str | float | Sequence[float] | None
    # floor and ceiling of the tunnel [slip]
    tunnel_walls: Literal["slip", "no-slip"] | None
    # height of the first layer on floor and ceiling without slip, or y+Y: that with this y+ on a flat plate;
    # else as on the configuration
    tunnel_layers: str | float | Sequence[float] | None
    # distance of flat ground below the lowest point of the configuration; > 0
    ground: float | str | None
    # the ground: with slip, without, or without and moving with the free stream [slip]
    ground_wall: Literal["slip", "no-slip", "moving"] | None
    # the same on ground without slip, as tunnel-layers
    ground_layers: str | float | Sequence[float] | None
    # line of symmetry y = Y, in units of the input, that cuts bodies and domain: what is above is kept; >=
    # -1e+06 and <= 1e+06
    symmetry: float | None
    # the line of symmetry, y = 0, is the axis of bodies of revolution
    axisymmetric: bool | None
    # the configuration is a blade of an endless row along y, at this distance from the next; STAGGER turns it
    # counter-clockwise from the axial direction x, in degrees, and alpha is the angle of the inlet flow
    periodic: str | float | Sequence[float] | None
    # the same as periodic
    cascade: str | float | Sequence[float] | None
    # growth of the edge length per unit of distance; > 0 and <= 1 [0.1]
    gradation: float | None
    # largest edge length at the outer border of the layer; else the edges of the border decide; > 0
    wall_size: float | str | None
    # largest edge length; else unbounded; > 0
    far_size: float | str | None
    # small triangles along a line from each trailing edge: ANGLE in degrees to the x axis, or auto for that of
    # the flow (alpha); LENGTH of the line (2 chords); SIZE at the trailing edge (else the size there without a
    # wake); may be given several times
    wake: str | float | Sequence[str | float] | None
    # edge length H in and round a shape, box:X0,Y0,X1,Y1,H, circle:X,Y,R,H or line:X0,Y0,X1,Y1,H, in units of
    # the input; may be given several times
    refine: str | float | Sequence[str | float] | None
    # smallest angle of isotropic triangles, in degrees; > 0 and <= 33 [20.7]
    min_angle: float | None
    # how often all vertices of isotropic triangles move to the means of their neighbours; those of ill-shaped
    # ones then move a few times more; 0: none moves; >= 0 and <= 100 [2]
    smoothing: int | None
    # merge, split and join otherwise the vertices near those without six neighbours, where that makes isotropic
    # triangles more regular; takes some fifty times as long as refinement
    regularize: bool | None
    # whether a panel method and boundary layers decide first heights for y+, the least thickness of --layers
    # auto, and wakes; needs a Reynolds number [no]
    use_flow: bool | None
    # a line of edges with a marker NAME, through the points of PLACE, X0,Y0,X1,Y1[,...] or a file of them:
    # edges between cells, or, two-sided, a wall without thickness; H is the edge length along it; units of the
    # input; may be given several times
    line: str | float | Sequence[str | float] | None
    # number of vertices, within 3 %, on a mesh of the same first heights: with a scale s that is found by
    # trial, all other lengths, angles between rays and gradations are divided by s, and the growth r of layers
    # up to isotropy becomes r^(1/s); >= 100 and <= 4e+09
    vertices: int | None
    # number of cells, likewise; >= 100 and <= 4e+09
    cells: int | None
    # the base of a blunt trailing edge is a marker of its own, NAME_base
    base_marker: bool | None
    # the far field is two markers: inlet, where a uniform flow at the angle of attack enters, and outlet
    inlet_outlet: bool | None
    # order of the cells: 1 for straight ones, 2 to 4 for curved ones that follow the walls, each proved valid;
    # MSH, VTU, CGNS, MFEM and Nektar++ alone; >= 1 and <= 4 [1]
    order: int | None
    # where the nodes of curved cells are on straight ones: evenly spaced, or at the points of Gauss and
    # Lobatto's quadrature, which MFEM and Nektar++ alone take [equidistant]
    node_distribution: Literal["equidistant", "gauss-lobatto"] | None
    # number of threads; 0: one per core; never changes the mesh; >= 0 and <= 1024 [0]
    threads: int | None
    # largest number of triangles; a run that needs more, by estimate, is refused before the work; >= 1 and <=
    # 1e+15
    max_triangles: int | None
    # largest memory of the process, such as 500M or 2G; a run that needs more, by estimate, is refused before
    # the work; the program's default is 80 % of what is free
    max_memory: str | float | Sequence[float] | None
    # VTU or MSH mesh to read with an edge length at each vertex, in units of the input, or the arrays (points,
    # triangles, sizes); linear in its triangles
    background: str | PathLike[str] | tuple[Any, Any, Any] | None
    # return the mesh even where isotropic triangles have an angle below min_angle that no sharp corner excuses;
    # otherwise such a run raises MeshError
    allow_defects: bool | None

class RunArguments:
    sections: list[Any]
    values: list[tuple[str, Any]]
    sizes: tuple[ndarray, ndarray, ndarray] | None

def mesh(sections: Sections, *, progress: Progress = None, **options: Unpack[MeshOptions]) -> Mesh: ...
def run_arguments(sections: Sections, options: Mapping[str, Any], source: str = ...) -> RunArguments: ...
def made_mesh(
    result: tuple[_lamina.Mesh, list[dict[str, Any]], dict[str, Any], tuple[ndarray, ndarray]],
) -> Mesh: ...
def make_mesh(
    sections: Sections,
    progress: Callback | None,
    options: Mapping[str, Any],
    source: str = ...,
    stop: Callable[[], None] | None = None,
) -> Mesh: ...
