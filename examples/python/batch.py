# Meshes of many sections at several Reynolds numbers; a section that cannot be meshed does not stop the others.
import csv

import lamina

sections = {f"naca{digits}": f"naca:{digits}" for digits in ("0012", "2412", "4415", "23012")}
sections["fish"] = [[0.0, 0.0], [1.0, 0.1], [1.0, 0.0], [0.0, 0.1]]  # crosses itself

with open("summary.csv", "w", newline="") as file:
    table = csv.writer(file)
    table.writerow(["section", "reynolds", "outcome", "cells", "smallest angle", "seconds"])
    for result in lamina.batch(sections, sweep={"reynolds": [1e6, 6e6]}, write="out/{name}_{reynolds:g}.su2"):
        row = [result.name, result.options["reynolds"]]
        if result.error:
            row += [str(result.error), "", ""]
        else:
            row += ["done", len(result.mesh), round(result.mesh.quality().isotropic.min_angle, 2)]
        table.writerow([*row, round(result.seconds, 3)])
