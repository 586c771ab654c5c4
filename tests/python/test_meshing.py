"""lamina.mesh(): the meshes of the program, from every form of input."""

import gc
import json
import os
import pickle
import signal
import subprocess
import threading
import time
import warnings

import numpy as np
import pytest

import lamina


def arguments_as_options(arguments):
    """Returns the inputs and the options that arguments of the program stand for."""
    inputs, options, words = [], {}, list(arguments)
    while words:
        word = words.pop(0)
        if not word.startswith("--"):
            inputs.append(word)
            continue
        key = word[2:].replace("-", "_")
        flag = not words or words[0].startswith("--")
        text = True if flag else words.pop(0)
        for convert in (int, float):
            try:
                text = text if text is True else convert(text)
                break
            except ValueError:
                continue
        options[key] = text
    return inputs, options


def test_golden_meshes(repository, monkeypatch):
    monkeypatch.chdir(repository)
    cases = json.loads((repository / "tests/golden/hashes.json").read_text())
    assert len(cases) >= 6
    for case in cases:
        inputs, options = arguments_as_options(case["arguments"])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", lamina.MeshWarning)
            mesh = lamina.mesh(inputs, **options)
        assert mesh.hash == case["hash"], case["name"]
        assert lamina.check(mesh).valid


def test_threads_at_once_make_the_mesh_of_the_program(program, tmp_path):
    report = tmp_path / "report.json"
    subprocess.run([program, "mesh", "naca:2412", "--reynolds", "1e6", "-o", str(tmp_path / "m.vtu"), "--quiet",
                    "--report", str(report)], check=True)
    expected = json.loads(report.read_text())["hash"]
    hashes = [None] * 8

    def work(i):
        hashes[i] = lamina.mesh("naca:2412", reynolds=1e6, threads=1 + i % 3).hash

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(hashes))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert hashes == [expected] * len(hashes)


def test_arrays_equal_files(tmp_path):
    points = lamina.naca("4415", 90)
    file = tmp_path / "section.dat"
    file.write_text("section\n" + "".join(f"{x!r} {y!r}\n" for x, y in points.tolist()))
    of_file = lamina.mesh(file, first_height=1e-4)
    assert of_file == lamina.mesh(points, first_height=1e-4)
    assert of_file == lamina.mesh(points.tolist(), first_height=1e-4)
    assert of_file == lamina.mesh([file], first_height=1e-4)
    # Lists, other types and strides, clockwise order and an outline that is not closed are no other section.
    assert of_file == lamina.mesh(np.asfortranarray(points), first_height=1e-4)
    assert of_file == lamina.mesh(np.repeat(points, 2, axis=0)[::2], first_height=1e-4)
    assert of_file == lamina.mesh(points[::-1], first_height=1e-4)
    assert of_file == lamina.mesh(points[:-1], first_height=1e-4)


def test_surfaces_one_behind_the_other():
    points = lamina.naca("0012", 90)
    nose = int(np.argmin(points[:, 0]))
    both = np.concatenate([points[nose::-1], points[nose:]])
    assert lamina.mesh(both, first_height=1e-4) == lamina.mesh(points, first_height=1e-4)


def test_names_of_markers():
    flap = 0.3 * lamina.naca("0012", 60) + [1.05, -0.05]
    mesh = lamina.mesh({"main": "naca:4412", "flap": flap}, first_height=1e-4)
    assert list(mesh.markers) == ["main", "flap", "farfield"]
    assert [element["name"] for element in mesh.facts["elements"]] == ["main", "flap"]
    assert mesh == lamina.mesh(["naca:4412", flap], names=["main", "flap"], first_height=1e-4)
    with pytest.raises(lamina.UsageError, match="names"):
        lamina.mesh({"main": "naca:4412"}, names=["other"])


def test_values_of_options():
    expected = lamina.mesh("naca:0012", layers=10, first_height=1e-4)
    assert expected == lamina.mesh("naca:0012", layers=np.int64(10), first_height=np.float64(1e-4), growth=None)
    assert len(lamina.mesh("naca:0012", no_layers=np.True_).quads) == 0
    assert lamina.mesh("naca:0012", reynolds=1e6, use_flow=False) == lamina.mesh("naca:0012", reynolds=1e6,
                                                                                use_flow="no")
    box = lamina.mesh("naca:0012", preset="euler", refine=["box:0,-0.2,1,0.2,0.01", "circle:2,0,0.1,0.02"])
    assert len(box) > len(lamina.mesh("naca:0012", preset="euler", refine="box:0,-0.2,1,0.2,0.01"))
    outline = [-3, -3, 4, -3, 4, 3, -3, 3]
    assert lamina.mesh("naca:0012", preset="euler", far_field_outline=outline) == lamina.mesh(
        "naca:0012", preset="euler", far_field_outline=[str(x) for x in outline])


def test_background_of_arrays(tmp_path):
    x, y = np.meshgrid(np.linspace(-1, 2, 16), np.linspace(-1, 1, 11))
    points = np.column_stack([x.ravel(), y.ravel()])
    triangles = lamina.delaunay(points).triangles
    fine = lamina.mesh("naca:0012", preset="euler", background=(points, triangles, np.full(len(points), 0.01)))
    coarse = lamina.mesh("naca:0012", preset="euler", background=(points, triangles, np.full(len(points), 0.05)))
    assert len(fine) > 4 * len(coarse)
    with pytest.raises(lamina.Error):
        lamina.mesh("naca:0012", background=(points, triangles, np.full(len(points) - 1, 0.01)))


@pytest.mark.parametrize("options, error, attributes", [
    ({"growth": 0.5}, lamina.OptionError, {"option": "growth", "exit_code": 2}),
    ({"growht": 1.2}, lamina.OptionError, {"option": "growht"}),
    ({"layers": 2.5}, lamina.OptionError, {"option": "layers"}),
    ({"layers": {}}, lamina.OptionError, {}),
    ({"first_height": 1e-5, "y_plus": 1, "reynolds": 1e6}, lamina.UsageError, {}),
    ({"y_plus": 1}, lamina.OptionError, {"option": "y_plus"}),
    ({"far_size": 1e-6}, lamina.LimitError, {"option": "far_size"}),
    ({"max_triangles": 10}, lamina.LimitError, {}),
])
def test_wrong_options(options, error, attributes):
    with pytest.raises(error) as caught:
        lamina.mesh("naca:0012", **options)
    for name, value in attributes.items():
        assert getattr(caught.value, name) == value
    if error is lamina.LimitError:
        assert caught.value.estimate.triangles > 10
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is type(caught.value) and vars(again) == vars(caught.value) and str(again) == str(caught.value)


def test_wrong_sections(tmp_path):
    with pytest.raises(lamina.IoError) as caught:
        lamina.mesh(tmp_path / "none.dat")
    assert caught.value.file == str(tmp_path / "none.dat") and isinstance(caught.value, OSError)
    file = tmp_path / "bad.dat"
    file.write_text("title\n1 0\n0.5 nan\n0 0\n")
    with pytest.raises(lamina.InputError) as caught:
        lamina.mesh(file)
    assert caught.value.line == 3 and caught.value.file == str(file)
    for bad, line in (([[0, 0], [1, 0], [np.nan, 1]], 3), ([[0, 0], [1, 0]], 1), (np.zeros((0, 2)), 0)):
        with pytest.raises(lamina.InputError) as caught:
            lamina.mesh({"wing": np.array(bad)})
        assert caught.value.file == "wing" and caught.value.line == line
    for bad in (np.zeros((3, 3)), np.zeros(4), 5, b"naca:0012", None, []):
        with pytest.raises((lamina.UsageError, lamina.InputError)):
            lamina.mesh(bad)


def test_warnings_are_data():
    sharp = np.array([[0, 0], [1, 0], [1, 1e-3], [0, 1]])
    with pytest.warns(lamina.MeshWarning) as caught:
        mesh = lamina.mesh(sharp, first_height=0.3, layers=3, growth=3, allow_defects=True)
    assert [str(w.message) for w in caught] == [w.message for w in mesh.warnings]
    assert all(w.code and w.message for w in mesh.warnings)


def test_promised_angles_or_no_mesh(repository):
    """The program and the package refuse the same meshes."""
    options = {"min_angle": 33, "gradation": 1.0}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        made = lamina.mesh(lamina.naca("0030", 12), surface="keep", allow_defects=True, **options)
        check = lamina.check(made, min_angle=33)
        unexcused = check.isotropic.angles_below_bound - check.isotropic.exempt
        if unexcused == 0:
            pytest.skip("this section has no such angle any more: the test needs another one")
        with pytest.raises(lamina.MeshError, match="allow_defects"):
            lamina.mesh(lamina.naca("0030", 12), surface="keep", **options)


@pytest.mark.parametrize("key, advice", [
    ("flip", r'write transform = \["all:rotate:180", "all:mirror"\]: they exchange left and right'),
    ("fan_rays", "write exact_points = N: "), ("base_edges", "write exact_points = N: "),
    ("surface_points_exact", "write exact_points = N: "), ("pieces_target", "delete it: "),
    ("separators", "delete it: "), ("decomposition_depth", "delete it: "), ("leaf_vertices", "delete it: ")])
def test_former_options_name_what_serves_in_their_place(key, advice):
    with pytest.raises(lamina.OptionError, match=f"{key}: no such option: {advice}") as caught:
        lamina.mesh("naca:0012", **{key: 5})
    assert caught.value.option == key


@pytest.mark.parametrize("word, key", [("re", "reynolds"), ("aoa", "alpha"), ("firstLayerHeight", "first_height"),
                                       ("groth", "growth")])
def test_unknown_options_name_the_one_that_was_meant(word, key):
    with pytest.raises(lamina.OptionError, match=f"{word}: no such option: did you mean '{key}'"):
        lamina.mesh("naca:0012", **{word: 1})


def test_progress_and_what_it_raises():
    stages = []
    lamina.mesh("naca:0012", progress=lambda stage, estimate: stages.append((stage, estimate)))
    names = [stage for stage, _ in stages]
    assert names.index("layers") < names.index("decoupling") < names.index("check")
    estimates = [estimate for _, estimate in stages if estimate is not None]
    assert len(estimates) == 1 and estimates[0].triangles > 1000

    class Enough(Exception):
        pass

    def stop(stage, _):
        if stage == "assembly":
            raise Enough

    for _ in range(3):
        with pytest.raises(Enough):
            lamina.mesh("naca:0012", progress=stop)


def test_interrupt():
    # A process in the background of a shell ignores the signal; then Python does not turn it into an exception.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        interrupted()
    finally:
        signal.signal(signal.SIGINT, before)


def interrupted():
    with pytest.raises(KeyboardInterrupt):
        lamina.mesh("naca:0012", progress=lambda stage, _: os.kill(os.getpid(), signal.SIGINT))


def square():
    return lamina.constrained_delaunay([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1], [1, 2], [2, 3], [3, 0]])


LONG_CALLS = {
    "mesh": lambda: lamina.mesh("naca:0012", preset="euler", wall_size=1e-4, gradation=0.003, threads=2),
    "mesh on one thread": lambda: lamina.mesh("naca:0012", preset="euler", wall_size=1e-4, gradation=0.003, threads=1),
    "refinement": lambda: lamina.refine(square(), 3e-4),
    "refinement to an angle": lambda: lamina.refine(
        lamina.constrained_delaunay(np.random.default_rng(1).random((400_000, 2)), np.zeros((0, 2), int)), 10.0,
        min_angle=30),
    "constrained triangulation": lambda: lamina.constrained_delaunay(
        np.random.default_rng(1).random((6_000_000, 2)), np.zeros((0, 2), int)),
}


@pytest.mark.parametrize("name", LONG_CALLS)
def test_interrupt_ends_a_call_of_seconds_at_once(name):
    """Ctrl-C need not wait for the end of a stage."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    at = [0.0]

    def interrupt():
        at[0] = time.process_time()
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(1.0, interrupt)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            LONG_CALLS[name]()
        # Processor time, since others may use the machine: half a second alone, and the calls take up to five.
        assert time.process_time() - at[0] < 2
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_memory_returns():
    def run():
        mesh = lamina.mesh("naca:0012", reynolds=1e6)
        mesh.points, mesh.wall, mesh.wall_distance, mesh.markers, mesh.quality()
        with pytest.raises(lamina.OptionError):
            lamina.mesh("naca:0012", growth=0)

    for _ in range(5):
        run()
    gc.collect()
    before = resident_bytes()
    for _ in range(40):  # each holds about 5 MB of arrays
        run()
    gc.collect()
    assert resident_bytes() - before < 10e6


def test_other_threads_of_python_run_meanwhile():
    """The lock of the interpreter is free while a mesh is made."""
    done, counts = threading.Event(), [0]

    def count():
        while not done.is_set():
            counts[0] += 1
            done.wait(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    lamina.mesh("naca:0012", preset="euler", wall_size=0.005, gradation=0.02, threads=1)
    done.set()
    thread.join()
    assert counts[0] > 20
