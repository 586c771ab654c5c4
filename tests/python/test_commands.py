"""What the commands of the program do, from Python: the results are those of the program."""

import math
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import lamina

OPTIONS = {"first_height": 1e-3, "layers": 5, "gradation": 0.3}


def run(program, *arguments, **options):
    return subprocess.run([*program, *map(str, arguments)], capture_output=True, text=True, **options)


@pytest.fixture(scope="module")
def as_module():
    return [sys.executable, "-m", "lamina"]


def test_module_is_the_program(as_module, program, tmp_path):
    arguments = ("mesh", "naca:0012", "--preset", "euler", "--quiet", "-o")
    for name, words in (("one", [program]), ("other", as_module)):
        assert run(words, *arguments, tmp_path / f"{name}.su2").returncode == 0
    assert (tmp_path / "one.su2").read_bytes() == (tmp_path / "other.su2").read_bytes()
    version = run(as_module, "--version")
    assert version.stdout == run([program], "--version").stdout and lamina.__version__ in version.stdout


@pytest.mark.parametrize("arguments", [("mesh", "none.dat", "-o", "m.su2"), ("mesh",), ("mesh", "naca:0012", "--growht", "1")])
def test_module_fails_as_the_program(as_module, program, arguments):
    one, other = run([program], *arguments), run(as_module, *arguments)
    assert one.returncode == other.returncode > 0 and one.stderr == other.stderr


@pytest.mark.skipif(os.name != "posix", reason="sends a signal")
def test_control_c_ends_the_module(as_module, tmp_path):
    process = subprocess.Popen([*as_module, "mesh", "naca:0012", "--preset", "euler", "--wall-size", "1e-4", "--gradation",
                                "0.003", "--quiet", "-o", str(tmp_path / "m.su2")], stderr=subprocess.DEVNULL)
    time.sleep(1.0)
    assert process.poll() is None
    # A process in the background of a shell ignores the signal until the module runs, a second or more after its start.
    for _ in range(60):
        process.send_signal(signal.SIGINT)
        try:
            assert process.wait(timeout=1) == -signal.SIGINT
            break
        except subprocess.TimeoutExpired:
            pass
    assert process.poll() is not None
    assert not list(tmp_path.iterdir())


def test_flow_is_that_of_the_program(program, tmp_path):
    flow = lamina.flow("naca:2412", alpha=2, reynolds=1e6)
    assert run([program], "flow", "naca:2412", "--alpha", 2, "--reynolds", 1e6, "-o", tmp_path / "f.csv").returncode == 0
    rows = np.genfromtxt(tmp_path / "f.csv", delimiter=",", names=True, dtype=None, encoding=None)
    for name in ("upper", "lower"):
        side, expected = getattr(flow.elements["airfoil"], name), rows[rows["side"] == name]
        assert len(side) == len(expected)
        for ours, theirs in (("cp", "cp"), ("arc_length", "s"), ("thickness", "thickness"), ("shape", "shape")):
            assert np.allclose(getattr(side, ours), expected[theirs], rtol=1e-12, atol=0)
        assert [lamina.BOUNDARY_LAYER_STATES[i] for i in side.state] == expected["state"].tolist()
    assert 0.4 < flow.lift < 0.6 and flow.has_layers and flow.alpha == 2
    assert 0.005 < flow.drag < 0.02 and -0.08 < flow.moment < -0.03  # -0.05 in tables
    assert not lamina.flow({"wing": "naca:0012"}).has_layers
    tripped = lamina.flow("naca:2412", alpha=2, reynolds=1e6, trip=0.1, trip_lower=0.2, ncrit=4)
    assert np.allclose([tripped.transition_upper, tripped.transition_lower], [0.1, 0.2], rtol=1e-6, atol=0)
    assert tripped.drag > flow.drag and flow.converged and flow.transition_upper > 0.2
    with pytest.raises(lamina.OptionError):
        lamina.flow("naca:2412", ncrit=4)


def test_compressible_flow():
    flow = lamina.flow("naca:0012", alpha=1.25, mach=0.8)
    side = flow.elements["airfoil"].upper
    assert flow.drag > 0 and side.mach.max() > 1.2 and side.shape is None
    assert 0.5 < side.shocks[0]["position"] < 0.75 and side.shocks[0]["mach_ahead"] > side.shocks[0]["mach_behind"]
    assert flow.mach_numbers.shape == (len(flow.points),) and flow.triangles.max() < len(flow.points)
    with pytest.raises(lamina.OptionError):
        lamina.flow("naca:0012", mach=-1)


def test_info(program, repository):
    file = repository / "examples/geometry/rae2822.dat"
    facts = lamina.info(file)
    assert str(facts) == run([program], "info", file).stdout
    assert facts.elements[0]["name"] == "airfoil" and facts.elements[0]["points_read"] > 100


def test_case_is_that_of_the_program(program, tmp_path):
    options = {"reynolds": 1e6, "layers": 8, "first_height": 1e-3}
    mesh = lamina.case("su2", tmp_path / "ours", "naca:0012", turbulence="komega-sst", **options)
    words = [f"--{key.replace('_', '-')}={value}" for key, value in options.items()]
    made = run([program], "case", "su2", "naca:0012", "--turbulence", "komega-sst", *words, "-o", tmp_path / "theirs")
    assert made.returncode == 0, made.stderr
    names = sorted(path.name for path in (tmp_path / "theirs").iterdir())
    assert names == sorted(path.name for path in (tmp_path / "ours").iterdir())
    for name in names:
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes()
    assert len(mesh.quads) > 0
    with pytest.raises(lamina.UsageError):
        lamina.case("su2", tmp_path / "ours", "naca:0012", **options)
    with pytest.raises(lamina.OptionError, match="reynolds"):
        lamina.case("openfoam", tmp_path / "third", "naca:0012", layers=3)
    with pytest.raises(lamina.UsageError, match="fluent"):
        lamina.case("fluent", tmp_path / "third", "naca:0012")


def test_family(program, tmp_path):
    options = {"preset": "euler", "gradation": 0.3, "wall_size": 0.03}
    members = lamina.family("naca:0012", levels=3, write=str(tmp_path / "m{level}.su2"), **options)
    words = [f"--{key.replace('_', '-')}={value}" for key, value in options.items()]
    made = run([program], "family", "naca:0012", *words, "--levels", 3, "--quiet", "-o", tmp_path / "p{level}.su2")
    assert made.returncode == 0, made.stderr
    for member in members:
        assert (tmp_path / f"m{member.level}.su2").read_bytes() == (tmp_path / f"p{member.level}.su2").read_bytes()
    rows = np.genfromtxt(tmp_path / "pfamily.csv", delimiter=",", names=True, dtype=None, encoding=None)
    assert np.allclose([member.h for member in members], rows["h"], rtol=1e-10)
    assert [member.divisor for member in members] == pytest.approx([1 / math.sqrt(2), 1, math.sqrt(2)])
    for wrong in ({"levels": 0}, {"levels": 13}, {"ratio": 1}, {"base_level": 7}, {"write": "m.su2"}):
        with pytest.raises(lamina.UsageError):
            lamina.family("naca:0012", **wrong)


def test_sizes(small, program, tmp_path):
    field = np.tanh(20 * (small.points[:, 0] - 0.5)) * np.exp(-(small.points**2).sum(axis=1))
    asked = lamina.sizes(small, {"bump": field}, vertices=9000)
    assert asked.vertices == pytest.approx(9000, rel=0.02) and (asked.sizes > 0).all() and len(asked.errors) == 1
    asked.write(tmp_path / "sizes.vtu")
    again = lamina.sizes(tmp_path / "sizes.vtu", "size", vertices=8000)
    assert again.vertices == pytest.approx(8000, rel=0.02)
    mesh = lamina.mesh("naca:0012", background=asked.background, **OPTIONS)
    assert mesh.quality().valid
    with pytest.raises(lamina.InputError, match="bump"):
        lamina.sizes(small, {"bump": field[:-1]}, vertices=100)
    with pytest.raises(lamina.UsageError):
        lamina.sizes(small, "bump", vertices=100)
    with pytest.raises(lamina.UsageError, match="solution is a mesh"):
        lamina.sizes(small, {"bump": field}, vertices=100, mesh=tmp_path / "sizes.vtu")
    with pytest.raises(FileNotFoundError):
        lamina.sizes(tmp_path / "none.vtu", "p", vertices=100)


def test_convert_and_write(small, tmp_path):
    lamina.write(small, tmp_path / "m.su2")
    assert lamina.convert(tmp_path / "m.su2", tmp_path / "m.msh") == small == lamina.read(tmp_path / "m.msh")


def test_view(small, tmp_path):
    page = small.view(title="<wing>", height=321)
    assert page.html.startswith("<!DOCTYPE html>") and "<wing>" not in page.html
    page.save(tmp_path / "m.html")
    assert (tmp_path / "m.html").read_text(encoding="utf-8") == page.html
    assert page._repr_html_().startswith("<iframe srcdoc=") and 'height="321"' in page._repr_html_()
    assert "\n" not in repr(page) and len(page) == len(page.html)
    small.write(tmp_path / "m.vtu")
    assert len(lamina.view(tmp_path / "m.vtu")) > 0.9 * len(page)


def test_polar_is_that_of_the_program(program, tmp_path):
    polar = lamina.polar("naca:2412", alpha="-2:6:4", reynolds=3e6, trip=0.1)
    assert run([program], "flow", "naca:2412", "--alpha", "-2:6:4", "--reynolds", 3e6, "--trip", 0.1, "-o",
               tmp_path / "polar.json").returncode == 0
    written = lamina.read_polar(tmp_path)
    assert written == lamina.read_polar(tmp_path / "polar.json")
    assert (polar.name, polar.reynolds, polar.state) == (written.name, written.reynolds, written.state)
    for name in ("cl", "cd", "cdp", "cm", "top_xtr", "bottom_xtr"):
        assert np.allclose(getattr(polar, name), getattr(written, name), rtol=1e-9, atol=0)
    assert polar.alpha.tolist() == [-2, 2, 6] and polar.steady.all() and np.isnan(polar.y_plus).all()
    assert 0.05 < polar.top_xtr.min() and polar.top_xtr.max() < 0.1001
    assert not polar.undisplaced and not written.undisplaced
    two = lamina.polar(["naca:0012"] * 2, names=["a", "b"], transform="b:shift:2,0", alpha="0:2:2", reynolds=3e6)
    assert two.undisplaced
    of_two = '{"name": "a", "reynolds": null, "mach": null, "undisplaced": true, "rows": []}'
    (tmp_path / "polar.json").write_text(of_two)
    assert lamina.read_polar(tmp_path).undisplaced
    # Rows are those of single angles, each found from another one.
    alone = lamina.flow("naca:2412", alpha=6, reynolds=3e6, trip=0.1)
    assert polar.cl[2] == pytest.approx(alone.lift, rel=1e-3) and polar.cd[2] == pytest.approx(alone.drag, rel=1e-3)
    assert list(polar.table()) == ["alpha", "cl", "cd", "cdp", "cm", "top_xtr", "bottom_xtr", "y_plus", "state", "steady",
                                   "note"]
    with pytest.raises(lamina.UsageError, match="a polar needs a range"):
        lamina.polar("naca:0012", alpha=4)
    (tmp_path / "polar.json").write_text("{}")
    with pytest.raises(lamina.InputError, match="is no polar.json"):
        lamina.read_polar(tmp_path)
    with pytest.raises(FileNotFoundError):
        lamina.read_polar(tmp_path / "nowhere.json")


def test_forecast_says_what_the_mesh_will_be():
    options = dict(reynolds=1e6, alpha=2)
    forecast = lamina.forecast("naca:4412", **options)
    mesh = lamina.mesh("naca:4412", **options)
    assert forecast.cells == pytest.approx(len(mesh.triangles) + len(mesh.quads), rel=0.05)
    assert forecast.vertices == pytest.approx(len(mesh.points), rel=0.05)
    assert forecast.chord == pytest.approx(1, rel=1e-2) and forecast.estimate.memory_bytes > 1e6
    [wall] = forecast.walls
    assert wall.element == "airfoil" and 0 < wall.first_height < wall.thickness
    smallest, median, largest = wall.y_plus
    assert 0 <= smallest < median < largest <= 1.05
    assert lamina.forecast("naca:4412", first_height=1e-4, layers=5).walls[0].y_plus is None
    with pytest.raises(lamina.OptionError):
        lamina.forecast("naca:4412", growth=0.5)
