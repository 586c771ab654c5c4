// Small values of the library as values of Python.
#pragma once

#include <optional>

#include <nanobind/nanobind.h>

#include <lamina/limits.hpp>
#include <lamina/point.hpp>

namespace lamina::python {

/// Returns (x, y).
inline nanobind::object to_python(Point p) { return nanobind::make_tuple(p.x, p.y); }

/// Returns (x, y), or None.
inline nanobind::object to_python(const std::optional<Point>& p) { return p ? to_python(*p) : nanobind::none(); }

/// Returns (triangles, memory in bytes, seconds), the fields of lamina.RunEstimate.
inline nanobind::object to_python(const RunEstimate& estimate) {
    return nanobind::module_::import_("lamina._errors")
        .attr("RunEstimate")(estimate.triangles, estimate.memory_bytes, estimate.seconds);
}

}  // namespace lamina::python
