// Functions that describe a mesh, and the run that made it, as dictionaries.
#pragma once

#include <vector>

#include <nanobind/nanobind.h>

#include <lamina/geometry.hpp>
#include <lamina/mesh.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/warning.hpp>

namespace lamina::python {

/// Returns one dictionary for each warning, with the attributes of lamina.MeshWarning.
nanobind::list warnings_of(const std::vector<Warning>& warnings);

/// Returns what is known of a body before there is a mesh round it.
nanobind::dict facts_of(const Element& element);

/// Returns what the run says beside the mesh.
nanobind::dict facts_of(const MeshResult& result);

/// Returns the attributes of lamina.MeshCheck.
nanobind::dict check_of(const MeshCheck& check);

}  // namespace lamina::python
