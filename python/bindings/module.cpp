// lamina._lamina, the part of the Python package that is C++. The package wraps it: nobody else should import it.
#include <nanobind/nanobind.h>

#include <lamina/version.hpp>

#include "bindings.hpp"

NB_MODULE(_lamina, module) {
    module.attr("version") = LAMINA_VERSION;
    lamina::python::translate_errors();
    lamina::python::add_options(module);
    lamina::python::add_sections(module);
    lamina::python::add_meshes(module);
    lamina::python::add_runs(module);
    lamina::python::add_commands(module);
    lamina::python::add_flows(module);
    lamina::python::add_morphing(module);
    lamina::python::add_triangulations(module);
    lamina::python::add_triangulation_queries(module);
}
