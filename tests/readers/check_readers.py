#!/usr/bin/python3
"""Opens meshes of lamina with programs that read them, and compares what these programs report.

usage: check_readers.py LAMINA FOLDER

Readers: Gmsh, meshio, VTK, cgnscheck, and OpenFOAM's checkMesh, gmshToFoam and fluentMeshToFoam, as Debian packages them. `./dev
test-readers` installs them and runs this. The reference of every mesh is `lamina check --json` on its SU2 file.
"""

import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

LAMINA = sys.argv[1]
FOLDER = Path(sys.argv[2])
OPENFOAM = {**os.environ, "WM_PROJECT_DIR": os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam")}

SMALL = ["--layers", "20", "--first-height", "1e-4", "--far-field", "10", "--quiet"]
MESHES = {
    "single": ["naca:0012:120"],
    "three": [],  # three files, see three_elements()
    "quads": ["naca:0012:120", "--layer-topology", "quads"],
    "blunt": ["naca:0012:121:blunt", "--base-marker"],
}
FILES = {  # format: file
    "su2": "m.su2",
    "vtu": "m.vtu",
    "vtu-zlib": "z.vtu",
    "msh41": "a41.msh",
    "msh41-binary": "b41.msh",
    "msh22": "a22.msh",
    "msh22-binary": "b22.msh",
    "msh22-extruded": "extruded.msh",
    "cgns": "m.cgns",
    "cgns-3d": "m3.cgns",
    "cgns-adf": "adf.cgns",
    "openfoam": "case",
    "ugrid": "m.ugrid",
    "fun3d": "f.b8.ugrid",
    "fluent": "a.cas",
    "fluent-binary": "b.cas",
}
SPAN = 0.25
CONTROL = """FoamFile {{ version 2.0; format ascii; class dictionary; object {}; }}
application none; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1;
writeControl timeStep; writeInterval 1; writePrecision 17; writeFormat ascii;
ddtSchemes {{}} gradSchemes {{}} divSchemes {{}} laplacianSchemes {{}} interpolationSchemes {{}} snGradSchemes {{}}
"""

# Names that some format, solver or shell does not take, or takes for something else, and others near to them. Each row
# names three elements.
NAMES = [
    ["0012", "63-215", "4412flap"], ["-1", "1e5", ".5"], ["+", "-", "_"], ["nan", "Inf", "NONE"],
    ["frontAndBack", "farfield", "inlet"], ["wall", "empty", "symmetry"], ["default", "FoamFile", "on"],
    ["a b", "a;b", "a_b"], ["a/b", "$x", "#include"], ['"q"', "'", "List<scalar>"], ["fl\u00fcgel", "Flap", "flap"],
    ["y0", "Zone", "layer"], ["isotropic_triangles", "ZoneBC", "defaultFaces"], ["x" * 40, "x" * 41, "x" * 32],
    ["main.flap", "m-1", "all"],
]

failures = 0


def expect(condition, claim, said=""):
    global failures
    print(f"  {'ok    ' if condition else 'FAILED'}  {claim}")
    if not condition:
        failures += 1
        print("          " + str(said).strip()[-2000:].replace("\n", "\n          "))


def run(*command, **options):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          **options)
    return done.returncode, done.stdout


def lamina(*arguments):
    code, said = run(LAMINA, *arguments)
    if code != 0:
        sys.exit(f"lamina {' '.join(map(str, arguments))}: {said}")
    return said


def facts(file):
    return json.loads(lamina("check", file, "--json"))


def edges_of(report):
    return {marker["name"]: marker["edges"] for marker in report["markers"]}


def check_gmsh(folder, reference):
    for name in ["a41.msh", "b41.msh", "a22.msh", "b22.msh"]:
        for version in ["msh41", "msh22"]:
            back = folder / f"gmsh_{version}.msh"
            back.unlink(missing_ok=True)
            code, said = run("gmsh", folder / name, "-0", "-bin", "-format", version, "-o", back)
            clean = code == 0 and "Warning" not in said and "Error" not in said and back.exists()
            same = clean and facts(back)["hash"] == reference["hash"]
            expect(same, f"gmsh reads {name} and gives the same mesh and names back as binary {version}", said)


def check_meshio(folder, reference):
    import meshio

    def counts(mesh):
        found = {}
        for block in mesh.cells:
            found[block.type] = found.get(block.type, 0) + len(block.data)
        return found

    edges = sum(edges_of(reference).values())
    expected = {"triangle": reference["triangles"], "quad": reference["quads"], "line": edges}
    expected = {kind: n for kind, n in expected.items() if n}
    for name in ["m.su2", "m.vtu", "z.vtu", "a41.msh", "b41.msh", "a22.msh", "b22.msh"]:
        mesh = meshio.read(folder / name)
        same = counts(mesh) == expected and len(mesh.points) == reference["vertices"]
        expect(same, f"meshio reads {name}: {len(mesh.points)} points", (counts(mesh), expected))
        if name.endswith(".msh"):
            names = set(edges_of(reference)) | {"layer", "isotropic"}
            expect(set(mesh.field_data) == names, f"meshio finds the physical names of {name}", mesh.field_data)
    mesh = meshio.read(folder / "f.b8.ugrid")
    expected = {"wedge": reference["triangles"], "hexahedron": reference["quads"],
                "triangle": 2 * reference["triangles"], "quad": edges + 2 * reference["quads"]}
    expected = {kind: n for kind, n in expected.items() if n}
    expect(counts(mesh) == expected, "meshio reads f.b8.ugrid", (counts(mesh), expected))

    # Fluent's files hold faces, of which every one between two cells counts once.
    faces = (3 * reference["triangles"] + 4 * reference["quads"] + edges) // 2
    points = meshio.read(folder / "m.vtu").points[:, :2]
    for name in ["a.cas", "b.cas"]:
        mesh = meshio.read(folder / name, file_format="ansys")
        expect(counts(mesh) == {"line": faces} and (mesh.points == points).all(),
               f"meshio reads {name}: {faces} faces, and every point bit for bit", counts(mesh))


def check_exports(folder, reference):
    """Expects that the lines of Python on the page of formats write what they say."""
    import meshio

    page = Path(__file__).resolve().parents[2] / "docs/reference/formats.md"
    block = re.search(r"^```python\n(.*?)^```$", page.read_text(), flags=re.M | re.S).group(1)
    for name, file in {"mesh.msh": "a41.msh", "mesh.vtu": "m.vtu"}.items():
        (folder / name).write_bytes((folder / file).read_bytes())
    code, said = run(sys.executable, "-c", block, cwd=folder)
    expect(code == 0, "meshio writes what the page says", said)
    if code != 0:
        return
    abaqus = (folder / "mesh.inp").read_text()
    sets = set(re.findall(r"^\*ELSET, *ELSET=(\S+)$", abaqus, flags=re.M))
    elements = sum(len(lines.splitlines()) for lines in re.findall(r"^\*ELEMENT.*\n((?:[^*].*\n)*)", abaqus, flags=re.M))
    cells = reference["triangles"] + reference["quads"]
    edges = edges_of(reference)
    expect(elements == cells + sum(edges.values()) and set(edges) < sets, f"Abaqus: all elements, and sets {sets}", elements)
    for name, wanted in {"mesh.vtk": cells + sum(edges.values()), "mesh.dat": cells}.items():
        mesh = meshio.read(folder / name, **({"file_format": "tecplot"} if name.endswith("dat") else {}))
        found = sum(len(block.data) for block in mesh.cells)
        expect(found == wanted and len(mesh.points) == reference["vertices"], f"{name} holds {wanted} cells", found)


def check_vtk(folder, reference):
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    for name in ["m.vtu", "z.vtu"]:
        reader = vtk.vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(folder / name))
        reader.Update()
        grid = reader.GetOutput()
        types = vtk_to_numpy(grid.GetCellTypesArray())
        found = [(types == t).sum() for t in (vtk.VTK_TRIANGLE, vtk.VTK_QUAD, vtk.VTK_LINE)]
        expected = [reference["triangles"], reference["quads"], sum(edges_of(reference).values())]
        expect(found == expected and grid.GetNumberOfPoints() == reference["vertices"], f"VTK reads {name}", found)
        arrays = {grid.GetCellData().GetArrayName(i) for i in range(grid.GetCellData().GetNumberOfArrays())}
        expect({"region", "piece", "layer", "quality", "marker"} <= arrays, f"VTK finds the cell data of {name}", arrays)
        measure = vtk.vtkMeshQuality()
        measure.SetInputData(grid)
        measure.SetTriangleQualityMeasureToShape()
        measure.SetQuadQualityMeasureToShape()
        measure.Update()
        theirs = vtk_to_numpy(measure.GetOutput().GetCellData().GetArray("Quality"))
        ours = vtk_to_numpy(grid.GetCellData().GetArray("quality"))
        cells = types != vtk.VTK_LINE
        difference = abs(theirs - ours)[cells].max()
        expect(difference < 1e-6, f"VTK measures the same quality: they differ by {difference:.1e}")

    vertices = vtk_to_numpy(grid.GetPoints().GetData())
    vtk.vtkObject.GlobalWarningDisplayOff()  # the reader of Fluent's files asks for a solution beside the mesh
    for name in ["a.cas", "b.cas"]:
        reader = vtk.vtkFLUENTReader()
        reader.SetFileName(str(folder / name))
        reader.Update()
        grid = reader.GetOutput().GetBlock(0)
        types = vtk_to_numpy(grid.GetCellTypesArray())
        found = [(types == t).sum() for t in (vtk.VTK_TRIANGLE, vtk.VTK_QUAD)]
        measure.SetInputData(grid)
        measure.SetTriangleQualityMeasureToArea()
        measure.SetQuadQualityMeasureToArea()
        measure.Update()
        smallest = vtk_to_numpy(measure.GetOutput().GetCellData().GetArray("Quality")).min()
        same = (abs(vtk_to_numpy(grid.GetPoints().GetData()) - vertices) <= 1e-6 * (1 + abs(vertices))).all()
        expect(found == expected[:2] and same and smallest > 0, f"VTK reads {name}: all cells, counter-clockwise",
               (found, same, smallest))
    vtk.vtkObject.GlobalWarningDisplayOn()

    reader = vtk.vtkXMLPUnstructuredGridReader()
    reader.SetFileName(str(folder / "m.pvtu"))
    reader.Update()
    grid = reader.GetOutput()
    types = vtk_to_numpy(grid.GetCellTypesArray())
    found = [(types == t).sum() for t in (vtk.VTK_TRIANGLE, vtk.VTK_QUAD, vtk.VTK_LINE)]
    ids = grid.GetPointData().GetGlobalIds()
    vertices = len(set(vtk_to_numpy(ids))) if ids else 0
    expect(found == expected and vertices == reference["vertices"], "VTK reads m.pvtu: the parts have all cells", found)
    expect(all((folder / f"m_{part}.vtu").exists() for part in range(5)), "m.pvtu has 5 parts")

    reader = vtk.vtkCGNSReader()
    reader.SetFileName(str(folder / "m3.cgns"))
    reader.UpdateInformation()
    reader.EnableAllBases()
    reader.Update()
    block = reader.GetOutput()
    while block is not None and block.IsA("vtkMultiBlockDataSet"):
        block = block.GetBlock(0)
    cells = block.GetNumberOfCells() if block is not None else 0
    expect(cells >= reference["triangles"] + reference["quads"], f"VTK reads m3.cgns: {cells} cells")


def with_sizes(folder):
    """Writes the mesh with a size at each vertex in every way that meshio, VTK and Gmsh can; yields the file names."""
    import meshio
    import numpy
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk

    mesh = meshio.read(folder / "m.vtu")
    sizes = 0.02 + 0.1 * numpy.hypot(mesh.points[:, 0] - 0.5, mesh.points[:, 1] - 0.2)
    sized = meshio.Mesh(mesh.points, [c for c in mesh.cells if c.type != "line"], point_data={"size": sizes})
    for name, how in {"meshio.vtu": {}, "meshio_plain.vtu": {"compression": None},
                      "meshio41.msh": {"file_format": "gmsh"}, "meshio22.msh": {"file_format": "gmsh22"}}.items():
        sized.write(folder / name, **how)
        yield name

    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "m.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    for i in reversed(range(grid.GetCellData().GetNumberOfArrays())):
        grid.GetCellData().RemoveArray(i)
    array = numpy_to_vtk(sizes, deep=True)
    array.SetName("size")
    grid.GetPointData().AddArray(array)
    for mode in ["Ascii", "Binary", "Appended"]:
        for compressor in ["None", "ZLib"]:
            for header in ["32", "64"]:
                for encoding in ["Off", "On"] if mode == "Appended" else ["On"]:
                    writer = vtk.vtkXMLUnstructuredGridWriter()
                    getattr(writer, f"SetDataModeTo{mode}")()
                    getattr(writer, f"SetCompressorTypeTo{compressor}")()
                    getattr(writer, f"SetHeaderTypeToUInt{header}")()
                    getattr(writer, f"EncodeAppendedData{encoding}")()
                    name = f"vtk_{mode}_{compressor}_{header}_{encoding}.vtu"
                    writer.SetFileName(str(folder / name))
                    writer.SetInputData(grid)
                    writer.Write()
                    yield name

    script = folder / "view.geo"
    for version in ["2.2", "4.1"]:
        name = f"gmsh_view{version}.msh"
        script.write_text(f'Merge "meshio41.msh"; Mesh.MshFileVersion = {version}; Save View[0] "{name}"; Exit;\n')
        run("gmsh", script.name, "-0", cwd=folder)
        yield name


def check_sizes(folder, arguments):
    """Expects that the files of sizes of all programs give the same mesh."""
    hashes = {}
    for name in with_sizes(folder):
        code, said = run(LAMINA, "mesh", *arguments, *SMALL, "--background", folder / name, "-o", folder / "sized.su2")
        expect(code == 0, f"sizes are read from {name}", said)
        if code == 0:
            hashes.setdefault(facts(folder / "sized.su2")["hash"], []).append(name)
    expect(len(hashes) == 1, "the same mesh is made from all of them", hashes)


def check_cgns(folder, reference):
    for name in ["m.cgns", "adf.cgns", "m3.cgns"]:
        code, said = run("cgnscheck", "-w3", folder / name)
        if name == "m3.cgns":  # cgnscheck warns that z = 0 everywhere, which this format is for
            said = re.sub("WARNING:coordinate range is 0|1 warnings.*", "", said)
        clean = code == 0 and "checking complete" in said and not re.search("error|warning", said, re.I)
        expect(clean, f"cgnscheck -w3 finds no error and no warning in {name}", said)


def check_span(folder, reference):
    """Expects that programs read meshes in space, with their volumes and their ends in order."""
    across = 3
    cells = across * (reference["triangles"] + reference["quads"])
    for ends in ["symmetry", "periodic"]:
        case = folder / f"span_{ends}"
        span = ["--span", SPAN, "--span-cells", across, "--span-ends", ends]
        files = {"m.vtu": "vtu", "m.cgns": "cgns", "m.msh": "msh22-extruded", "m.b8.ugrid": "fun3d"}
        case.mkdir(exist_ok=True)
        lamina("convert", folder / "first.vtu", case, "--format", "openfoam", *span)
        for name, form in files.items():
            lamina("convert", folder / "first.vtu", case / name, "--format", form, *span)
        check_span_files(case, reference, cells, across)
        foam_case(case)
        code, said = run("checkMesh", "-allTopology", "-case", case, env=OPENFOAM)
        topology = said[said.find("Checking topology"):said.find("Checking geometry")]
        expect(code == 0 and "***" not in topology and "Upper triangular ordering OK" in topology and
               "Cell volumes OK" in said and f"cells:            {cells}" in said and
               "Coupled point location match" in said, f"checkMesh: a span with {ends} ends is in order", said)
        other = folder / f"span_{ends}_by_gmshToFoam"
        foam_case(other)
        code, said = run("gmshToFoam", (case / "m.msh").resolve(), "-case", other, env=OPENFOAM)
        code, said = run("checkMesh", "-allTopology", "-case", other, env=OPENFOAM)
        topology = said[said.find("Checking topology"):said.find("Checking geometry")]
        expect(code == 0 and "***" not in topology and re.search(r"\n +z1 ", said) and "Cell volumes OK" in said,
               "gmshToFoam makes a mesh with its ends of it", said)


def check_span_files(case, reference, cells, across):
    import meshio
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    faces = 2 * (reference["triangles"] + reference["quads"]) + across * sum(edges_of(reference).values())
    for name in ["m.vtu", "m.msh", "m.b8.ugrid"]:
        found = {}
        mesh = meshio.read(case / name)
        for block in mesh.cells:
            found[block.type] = found.get(block.type, 0) + len(block.data)
        volumes = found.get("wedge", 0) + found.get("hexahedron", 0)
        expect(volumes == cells and sum(found.values()) == cells + faces and
               len(mesh.points) == (across + 1) * reference["vertices"], f"meshio reads {case.name}/{name}", found)
    code, said = run("cgnscheck", "-w3", case / "m.cgns")
    expect(code == 0 and "checking complete" in said and not re.search("error|warning", said, re.I),
           f"cgnscheck -w3 finds no error and no warning in {case.name}/m.cgns", said)
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(case / "m.vtu"))
    reader.Update()
    sizes = vtk.vtkCellSizeFilter()
    sizes.SetInputData(reader.GetOutput())
    sizes.Update()
    # VTK 9.1 takes wedges the other way round than VTK 9.7 and other programs.
    volume = abs(vtk_to_numpy(sizes.GetOutput().GetCellData().GetArray("Volume"))).sum()
    expect(math.isclose(volume, SPAN * reference["area"], rel_tol=1e-9), f"VTK finds the volume of {case.name}/m.vtu", volume)


def foam_case(case):
    (case / "system").mkdir(parents=True, exist_ok=True)
    for name in ["controlDict", "fvSchemes", "fvSolution"]:
        (case / "system" / name).write_text(CONTROL.format(name))


def check_openfoam(folder, reference):
    case = folder / "case"
    foam_case(case)
    code, said = run("checkMesh", "-allTopology", "-allGeometry", "-case", case, env=OPENFOAM)
    topology = said[said.find("Checking topology"):said.find("Checking geometry")]
    expect(code == 0 and "***" not in topology and "Upper triangular ordering OK" in topology,
           "checkMesh -allTopology: topology all OK", said)
    expect("Mesh has 2 geometric (non-empty/wedge) directions (1 1 0)" in said, "checkMesh sees a plane mesh", said)
    for line in said.splitlines():
        if "non-orthogonality Max" in line or "aspect ratio" in line or "***" in line or "skewness" in line:
            print("            " + line.strip())

    (case / "system" / "decomposeParDict").write_text(
        CONTROL.format("decomposeParDict") +
        'numberOfSubdomains 4; method manual; manualCoeffs { dataFile "cellDecomposition"; }\n')
    code, said = run("decomposePar", "-force", "-case", case, env=OPENFOAM)
    sizes = [int(n) for n in re.findall(r"Number of cells = (\d+)", said)]
    cells = reference["triangles"] + reference["quads"]
    expect(code == 0 and len(sizes) == 4 and sum(sizes) == cells and max(sizes) - min(sizes) <= 1,
           f"decomposePar divides the case by cellDecomposition: {sizes}", said)

    for program, file in {"gmshToFoam": "extruded.msh", "fluentMeshToFoam": "a.cas"}.items():
        case = folder / f"by_{program}"
        foam_case(case)
        code, said = run(program, (folder / file).resolve(), "-case", case, env=OPENFOAM)
        expect(code == 0 and "FATAL" not in said, f"{program} reads {file}", said)
        back = facts(case)
        expected = (reference["triangles"], reference["quads"], edges_of(reference))
        expect((back["triangles"], back["quads"], edges_of(back)) == expected and back["hash"] == reference["hash"],
               f"{program} makes the same mesh and patches of it", back)
        code, said = run("checkMesh", "-allTopology", "-case", case, env=OPENFOAM)
        expect(code == 0 and "***" not in said[said.find("Checking topology"):said.find("Checking geometry")] and
               "Cell volumes OK" in said, "checkMesh finds its topology and its volumes in order", said)


def three_named(folder, names, command, *arguments):
    """Runs a command of lamina on three elements of these names; returns what it says."""
    return lamina(*command, *three_elements(folder), "--names=" + ",".join(names), *arguments)


def check_names(folder, names):
    """Expects that markers get names that are those of every file, and that all programs read."""
    folder.mkdir(parents=True, exist_ok=True)
    said = three_named(folder, names, ["mesh"], *SMALL, "-o", folder / "m.su2", "-o", folder / "m.cgns", "-o",
                       folder / "m.msh", "-o", folder / "case/constant/polyMesh", "-o", folder / "m.b8.ugrid")
    edges = edges_of(facts(folder / "m.su2"))
    made = [name for name in edges if name != "farfield"]
    legal = all(re.fullmatch(r"[A-Za-z][A-Za-z0-9_.-]{0,31}", name) for name in made)
    expect(legal and len({name.lower() for name in edges}) == 4, f"names {names} become {made}")
    told = all(said.count(f"the name '{name}'") == 1 and f"the marker is '{new}'" in said
               for name, new in zip(names, made) if name != new)
    expect(told and said.count("the marker is") == sum(a != b for a, b in zip(names, made)), "each is told once", said)
    for file in ["m.cgns", "m.msh", "case"]:
        expect(edges_of(facts(folder / file)) == edges, f"{file} has the same names", facts(folder / file))
    families = [line.split()[2] for line in (folder / "m.mapbc").read_text().splitlines()[1:]]
    expect(set(edges) < set(families) and len(set(families)) == len(families), "m.mapbc has families of its own", families)

    back = folder / "back.msh"
    code, said = run("gmsh", folder / "m.msh", "-0", "-format", "msh22", "-o", back)
    expect(code == 0 and edges_of(facts(back)) == edges, "gmsh gives the names back", said)
    code, said = run("cgnscheck", "-w3", folder / "m.cgns")
    expect(code == 0 and not re.search("error|warning", said, re.I), "cgnscheck finds no error and no warning", said)
    foam_case(folder / "case")
    code, said = run("checkMesh", "-case", folder / "case", env=OPENFOAM)
    # Behind names of more than 19 letters checkMesh puts no space.
    found = all(re.search(rf"^ +{re.escape(name)} *{faces} ", said, re.M) for name, faces in edges.items())
    expect(code == 0 and found,
           "checkMesh finds all patches with their faces", said)


def check_case(folder, names):
    """Expects that OpenFOAM runs a case with these names, and that its tables have all walls."""
    folder.mkdir(parents=True, exist_ok=True)
    three_named(folder, names, ["case", "openfoam"], "-o", folder / "c", "--overwrite", "--reynolds", "1e5", "--use-flow",
                "no", "--y-plus", "5", "--growth", "1.4", "--gradation", "0.4", "--far-field", "10", "--quiet")
    edges = edges_of(facts(folder / "c"))
    script = folder / "c" / "Allrun"
    script.write_text(re.sub("first=150 block=200", "first=2 block=2", script.read_text()))
    run(folder / "c" / "Allclean", env=OPENFOAM)
    code, said = run(script, env={**OPENFOAM, "ITERATIONS": "4"})
    expect(code in (0, 2) and "CL" in said, f"OpenFOAM runs the case of {[name for name in edges]}", said)
    rows = (folder / "c" / "walls.csv").read_text().splitlines()[1:]
    counts = {}
    for row in rows:
        counts[row.split(",")[0]] = counts.get(row.split(",")[0], 0) + 1
    expect(counts == {name: n for name, n in edges.items() if name != "farfield"}, "walls.csv has all walls", counts)
    forces = next((folder / "c" / "postProcessing" / "forces").rglob("coefficient.dat")).read_text()
    expect("#" in forces, "there are forces", forces)


def main():
    for name, arguments in MESHES.items():
        print(f"\n{name}")
        folder = FOLDER / name
        folder.mkdir(parents=True, exist_ok=True)
        inputs = arguments
        if name == "three":
            inputs = three_elements(folder)
        lamina("mesh", *inputs, *SMALL, "-o", folder / "first.vtu")
        for form, file in FILES.items():
            lamina("convert", folder / "first.vtu", folder / file, "--format", form)
        lamina("convert", folder / "first.vtu", folder / "m.pvtu", "--parts", "5")
        lamina("convert", folder / "first.vtu", folder / "case", "--format", "openfoam", "--parts", "4")
        reference = facts(folder / "m.su2")
        print(f"  {reference['vertices']} vertices, {reference['triangles']} triangles, {reference['quads']} quads, "
              f"{edges_of(reference)}")
        expect(reference["valid"] and (name != "quads" or reference["quads"] > 0) and
               (name != "blunt" or len(reference["markers"]) == 3), "the mesh is valid and has the expected parts", reference)
        check_gmsh(folder, reference)
        check_meshio(folder, reference)
        check_vtk(folder, reference)
        check_cgns(folder, reference)
        check_openfoam(folder, reference)
        if name == "single":
            check_sizes(folder, inputs)
        if name == "quads":
            check_exports(folder, reference)
            check_span(folder, reference)
    print("\nnames")
    for number, names in enumerate(NAMES):
        check_names(FOLDER / f"names_{number}", names)
    check_case(FOLDER / "names_case", ["0012", "wall", "main.flap-2"])
    print(f"\n{failures} failures")
    return 1 if failures else 0


def three_elements(folder):
    """Writes one section three times, each copy behind and below the one before; returns the names of the files."""
    files = []
    for k, (scale, x, y) in enumerate([(0.2, -0.25, -0.05), (1.0, 0.0, 0.0), (0.3, 1.05, -0.08)]):
        points = []
        n = 60
        for i in range(2 * n):
            s = math.cos(math.pi * i / n)
            u = 0.5 * (1 + s)
            t = 0.6 * (0.2969 * math.sqrt(u) - 0.126 * u - 0.3516 * u**2 + 0.2843 * u**3 - 0.1036 * u**4)
            points.append((x + scale * u, y + scale * (t if i <= n else -t)))
        file = folder / f"{['slat', 'main', 'flap'][k]}.dat"
        file.write_text(file.stem + "\n" + "".join(f"{px:.10f} {py:.10f}\n" for px, py in points))
        files.append(file)
    return files


if __name__ == "__main__":
    sys.exit(main())
