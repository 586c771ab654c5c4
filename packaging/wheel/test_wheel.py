"""What a wheel has beyond the module of the build folder: its own CGNS and HDF5, which meet nobody else's."""

import subprocess
import sys

import pytest

import lamina

READ = """
import numpy
import {0}, {1}
import lamina
mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
mesh.write("mesh.cgns")
assert lamina.read("mesh.cgns") == mesh
import h5py
with h5py.File("mesh.cgns") as file:
    assert "CGNSLibraryVersion" in file
"""


def test_cgns_is_there():
    assert {"cgns", "cgns-adf"} <= set(lamina.formats())


def test_plot_names_what_draws(tmp_path):
    lamina.mesh("naca:0012", preset="euler").write(tmp_path / "a.vtu")
    run = subprocess.run([sys.executable, "-m", "lamina", "plot", "a.vtu", "-o", "a.png"], cwd=tmp_path, text=True,
                         capture_output=True)
    assert run.returncode == 2 and "lamina view" in run.stderr and "Mesh.plot()" in run.stderr


@pytest.mark.parametrize("order", [("lamina", "h5py"), ("h5py", "lamina"), ("lamina", "netCDF4"), ("netCDF4", "lamina")])
def test_beside_other_hdf5(order, tmp_path):
    subprocess.run([sys.executable, "-c", READ.format(*order)], cwd=tmp_path, check=True)
