// Runs that make meshes round sections, and cases of flow solvers.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <lamina/forecast.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/solver_case.hpp>
#include <lamina/warning.hpp>

#include "app/solver_case_run.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "facts.hpp"
#include "interruption.hpp"
#include "request.hpp"
#include "sections.hpp"
#include "shared_mesh.hpp"
#include "values.hpp"

namespace lamina::python {

namespace {

using OptionValues = std::vector<std::pair<std::string, OptionValue>>;
using Background = std::tuple<PointsArgument, RowsArgument<std::uint32_t, 3>, ListArgument<double>>;

std::shared_ptr<const SizedMesh> background_of(const Background& arrays) {
    const auto& [points, triangles, sizes] = arrays;
    auto mesh = std::make_shared<SizedMesh>();
    mesh->points = points_of(points);
    mesh->triangles = cells_of<Triangle, 3>(triangles);
    mesh->sizes.assign(sizes.data(), sizes.data() + sizes.shape(0));
    return mesh;
}

/// Throws MeshError where isotropic triangles have angles below the bound that no sharp corner excuses, unless defects
/// are allowed or there are lines inside the domain.
void require_promised_angles(const MeshResult& result, const MeshRequest& request) {
    const std::size_t narrow = result.check.isotropic.unexcused();
    if (request.allow_defects || !request.options.lines.empty() || narrow == 0) return;
    std::optional<Point> at;
    if (!result.check.unexcused_cells.empty() && result.check.unexcused_cells[0] < result.mesh.triangles.size())
        at = result.mesh.points[result.mesh.triangles[result.check.unexcused_cells[0]].v[0].index()];
    throw MeshError(
        fmt::format("{} triangle{} beyond the layer {} an angle below the bound (allow_defects=True returns "
                    "the mesh all the same)",
                    narrow, narrow == 1 ? "" : "s", narrow == 1 ? "has" : "have"),
        at);
}

/// Returns what the options ask for, with the sizes of a background mesh.
MeshRequest request_of(const OptionValues& values, const std::optional<Background>& sizes) {
    MeshRequest request = make_request(values);
    if (sizes) request.options.sizing.background = background_of(*sizes);
    request.options.limits = with_default_limits(request.options.limits);
    return request;
}

/// Returns the options of a mesh that is similar to that of the request, with lengths divided by a number.
CaseOptions divided(const MeshRequest& request, double divisor, const Geometry& geometry) {
    return refined(request.options, divisor, reference_conditions(request.options.conditions, geometry));
}

/// Returns a mesh with its warnings, the facts about the run, and the columns of the layer: of its cells, and the
/// vertices at which they begin.
nb::tuple to_python(MeshResult result) {
    nb::list warnings = warnings_of(result.warnings);
    nb::dict facts = facts_of(result);
    const nb::tuple columns = nb::make_tuple(owning_array<std::uint32_t>(std::move(result.columns)),
                                             owning_array<std::uint32_t>(std::move(result.column_origins)));
    return nb::make_tuple(shared(std::move(result.mesh), std::move(result.curved)), warnings, facts, columns);
}

/// Makes a mesh, whose lengths are divided by `divisor` where there is one. What `stop` raises ends the run; it is
/// called now and then unless it is None.
nb::tuple generate(const nb::list& given_sections, const OptionValues& values, const std::optional<Background>& sizes,
                   const nb::object& callback, const nb::object& stop, const std::optional<double>& divisor) {
    const MeshRequest request = request_of(values, sizes);
    const std::vector<Section> sections = sections_of(given_sections);
    const Progress progress = python_progress(callback);
    MeshResult result;
    run_unlocked(
        [&] {
            const Geometry geometry = geometry_of(sections, request.options.geometry);
            result =
                generate_mesh(geometry, divisor ? divided(request, *divisor, geometry) : request.options, progress);
            require_promised_angles(result, request);
        },
        stop);
    return to_python(std::move(result));
}

/// Returns what generate() would make, by estimate: as `forecast_mesh()` does.
nb::dict forecast(const nb::list& given_sections, const OptionValues& values, const std::optional<Background>& sizes) {
    const MeshRequest request = request_of(values, sizes);
    const std::vector<Section> sections = sections_of(given_sections);
    MeshForecast found;
    run_unlocked([&] { found = forecast_mesh(geometry_of(sections, request.options.geometry), request.options); });
    nb::list walls;
    for (const WallForecast& wall : found.walls) {
        nb::dict facts;
        facts["element"] = wall.element;
        facts["first_height"] = wall.first_height;
        facts["thickness"] = wall.thickness;
        if (const auto& y_plus = wall.y_plus)
            facts["y_plus"] = nb::make_tuple(y_plus->smallest, y_plus->median, y_plus->largest);
        walls.append(facts);
    }
    nb::dict facts;
    facts["vertices"] = found.vertices;
    facts["layer_cells"] = found.layer_cells;
    facts["cells_beyond"] = found.cells_beyond;
    facts["chord"] = found.result.conditions.chord;
    facts["estimate"] = python::to_python(found.result.estimate);
    facts["walls"] = walls;
    facts["warnings"] = warnings_of(found.result.warnings);
    return facts;
}

/// The options of a case as the package hands them over.
struct CaseArguments {
    std::string solver, folder, turbulence;
    bool unsteady, overwrite;
};

/// Makes a mesh and writes it with everything that a flow solver needs beside it, as `lamina case` does.
nb::tuple write_case(const CaseArguments& arguments, const nb::list& given_sections, const OptionValues& values,
                     const std::optional<Background>& sizes, const nb::object& callback) {
    const FlowSolver solver = app::solver_of_name(arguments.solver);
    SolverCaseOptions options;
    if (!arguments.turbulence.empty())
        find_row(option_table<SolverCaseOptions>(), "turbulence").set(options, arguments.turbulence);
    options.unsteady = arguments.unsteady;
    options.overwrite = arguments.overwrite;
    MeshRequest request = request_of(values, sizes);
    app::MeshCase mesh_case;
    mesh_case.options = request.options;
    mesh_case.given = request.given;
    app::prepare_case(solver, options, mesh_case);
    request.options = mesh_case.options;
    check_solver_case_writable(solver, arguments.folder, options);
    const std::vector<Section> sections = sections_of(given_sections);
    const Progress progress = python_progress(callback);
    MeshResult result;
    run_unlocked([&] {
        result = generate_mesh(geometry_of(sections, request.options.geometry), request.options, progress);
        require_promised_angles(result, request);
        for (Warning& warning : app::warnings_of_case(solver, result, options))
            result.warnings.push_back(std::move(warning));
        write_solver_case(solver, result.mesh, app::solver_conditions(result, request.options), arguments.folder,
                          options, result.curved);
    });
    return to_python(std::move(result));
}

}  // namespace

void add_runs(nb::module_& module) {
    module.def("generate", &generate, nb::arg("sections"), nb::arg("values"), nb::arg("sizes").none(),
               nb::arg("progress").none(), nb::arg("stop") = nb::none(), nb::arg("divisor") = nb::none());
    module.def("forecast", &forecast, nb::arg("sections"), nb::arg("values"), nb::arg("sizes").none());
    module.def(
        "write_case",
        [](const std::string& solver, const std::string& folder, const std::string& turbulence, bool unsteady,
           bool overwrite, const nb::list& sections, const OptionValues& values, const std::optional<Background>& sizes,
           const nb::object& progress) {
            return write_case({solver, folder, turbulence, unsteady, overwrite}, sections, values, sizes, progress);
        },
        nb::arg("solver"), nb::arg("folder"), nb::arg("turbulence"), nb::arg("unsteady"), nb::arg("overwrite"),
        nb::arg("sections"), nb::arg("values"), nb::arg("sizes").none(), nb::arg("progress").none());
}

}  // namespace lamina::python
