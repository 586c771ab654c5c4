// The parts of the module. Each function adds its part.
#pragma once

#include <nanobind/nanobind.h>

namespace lamina::python {

/// Makes the errors of the library those of lamina._errors.
void translate_errors();

/// Adds the table of the options of mesh().
void add_options(nanobind::module_& module);

/// Adds sections: NACA sections and files of coordinates.
void add_sections(nanobind::module_& module);

/// Adds runs that make meshes, and cases of flow solvers.
void add_runs(nanobind::module_& module);

/// Adds what the commands of the program do beside that: the program itself, facts about bodies, pages, sizes.
void add_commands(nanobind::module_& module);

/// Adds the flow before the mesh.
void add_flows(nanobind::module_& module);

/// Adds meshes: how they are read, checked and written.
void add_meshes(nanobind::module_& module);

/// Adds meshes that are moved to other shapes.
void add_morphing(nanobind::module_& module);

/// Adds triangulations and their refinement.
void add_triangulations(nanobind::module_& module);

/// Adds what triangulations are asked: connectivity, queries, Voronoi diagrams; and triangulations that change.
void add_triangulation_queries(nanobind::module_& module);

}  // namespace lamina::python
