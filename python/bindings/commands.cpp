// What the commands of the program do beside meshes: the program itself, facts about bodies, pages, sizes.
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <nlohmann/json.hpp>

#include <lamina/page.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/solution_sizes.hpp>
#include <lamina/surface.hpp>

#include "app/check_report.hpp"
#include "app/conditions_block.hpp"
#include "app/page_text.hpp"
#include "app/run_program.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "facts.hpp"
#include "interruption.hpp"
#include "request.hpp"
#include "sections.hpp"
#include "shared_mesh.hpp"

namespace lamina::python {

namespace {

/// Runs the program with these arguments, of which the first is its name. Returns its exit code.
int run_program(std::vector<std::string> arguments) {
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    const nb::gil_scoped_release unlocked;
    return app::run_program(static_cast<int>(arguments.size()), pointers.data(), nullptr);
}

/// Returns the facts about each body as it was read, repaired and prepared, and all of them as text.
nb::tuple describe_sections(const nb::list& given, const std::vector<std::pair<std::string, OptionValue>>& values) {
    const CaseOptions options = make_request(values).options;
    const std::vector<Section> sections = sections_of(given);
    Geometry geometry;
    std::string chord;
    run_unlocked([&] {
        geometry = geometry_of(sections, options.geometry);
        chord = app::chord_line(options.conditions, geometry);
        geometry = prepare_geometry(std::move(geometry), options);
    });
    nb::list facts;
    for (const Element& element : geometry.elements) facts.append(facts_of(element));
    return nb::make_tuple(facts, describe(geometry) + chord);
}

/// Returns the page that `lamina view` writes.
std::string page_of(const SharedMesh& mesh, const std::string& title) {
    std::string page;
    run_unlocked([&] {
        Mesh seen = *mesh;
        const app::RegionOrigin regions = app::require_regions(seen);
        const app::Json report = app::check_report(seen, app::check_file_mesh(seen, regions), regions, {});
        page = mesh_page(seen, app::page_of_mesh(title, seen, report));
    });
    return page;
}

/// The options of solution_sizes() as the package hands them over.
struct SizesArguments {
    double vertices;
    std::optional<double> norm, gradation, max_change;
};

/// Returns (points, triangles, sizes, growth per unit of distance, vertices of the next mesh, errors).
nb::tuple sizes_of(const Solution& solution, const SizesArguments& arguments) {
    SolutionSizeOptions options{.vertices = arguments.vertices};
    if (arguments.norm) options.norm = *arguments.norm;
    if (arguments.gradation) options.gradation = *arguments.gradation;
    if (arguments.max_change) options.max_change = *arguments.max_change;
    validate(options);
    SolutionSizes made;
    run_unlocked([&] { made = solution_sizes(solution, options); });
    return nb::make_tuple(owning_array<double>(std::move(made.sizes.points)),
                          owning_array<std::uint32_t>(std::move(made.sizes.triangles)),
                          owning_array<double>(std::move(made.sizes.sizes)), nb::cast(made.sizes.gradation),
                          made.vertices, made.errors);
}

using FieldArrays = std::vector<std::tuple<std::string, bool, ListArgument<double>>>;

/// Returns the solution of these fields, each with its name and whether it has one number per cell.
Solution solution_of(const SharedMesh& mesh, const FieldArrays& fields) {
    Solution solution{*mesh, {}};
    for (const auto& [name, at_cells, values] : fields)
        solution.fields.push_back({name, at_cells, {values.data(), values.data() + values.shape(0)}});
    return solution;
}

}  // namespace

void add_commands(nb::module_& module) {
    module.def("run_program", &run_program);
    module.def("describe", &describe_sections);
    module.def("page", &page_of);
    module.def(
        "sizes_of_fields",
        [](const SharedMesh& mesh, const FieldArrays& fields, double vertices, const std::optional<double>& norm,
           const std::optional<double>& gradation, const std::optional<double>& max_change) {
            return sizes_of(solution_of(mesh, fields), {vertices, norm, gradation, max_change});
        },
        nb::arg("mesh"), nb::arg("fields"), nb::arg("vertices"), nb::arg("norm").none(), nb::arg("gradation").none(),
        nb::arg("max_change").none());
    module.def("read_solution", [](const std::string& file, const std::vector<std::string>& fields,
                                   const std::string& mesh) {
        Solution solution;
        {
            const nb::gil_scoped_release unlocked;
            solution = read_solution(file, fields, mesh);
        }
        nb::list arrays;
        for (SolutionField& field : solution.fields)
            arrays.append(nb::make_tuple(field.name, field.at_cells, owning_array<double>(std::move(field.values))));
        return nb::make_tuple(shared(std::move(solution.mesh)), arrays);
    });
    module.def(
        "write_sizes",
        [](const PointsArgument& points, const RowsArgument<std::uint32_t, 3>& triangles,
           const ListArgument<double>& values, const std::optional<double>& gradation, const std::string& file) {
            SizedMesh sizes;
            sizes.points = points_of(points);
            sizes.triangles = cells_of<Triangle, 3>(triangles);
            sizes.sizes.assign(values.data(), values.data() + values.shape(0));
            sizes.gradation = gradation;
            write_sizes(sizes, file);
        },
        nb::arg("points"), nb::arg("triangles"), nb::arg("sizes"), nb::arg("gradation").none(), nb::arg("file"));
}

}  // namespace lamina::python
