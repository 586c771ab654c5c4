# From an array of coordinates to a picture and an SU2 file.
import lamina
import numpy as np

t = np.linspace(0, 2 * np.pi, 120, endpoint=False)
x, thickness = 0.5 + 0.5 * np.cos(t), 0.15 * np.sin(t) * (1 - np.cos(t)) / 2
section = np.column_stack([x, thickness])  # (n, 2), from the trailing edge over the upper surface

mesh = lamina.mesh({"wing": section}, reynolds=3e6)
mesh.write("wing.su2")
mesh.plot(window=(-0.1, 1.2, -0.3, 0.3)).figure.savefig("wing.png", dpi=200)
print(mesh, mesh.quality().isotropic.min_angle)
