// Reads the solutions of flow solvers, and writes sizes.
#include <lamina/solution.hpp>

#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "core/atomic_file.hpp"
#include "core/file_name.hpp"
#include "io/field_request.hpp"
#include "io/formats.hpp"
#include "io/su2_restart.hpp"

namespace lamina::io {

FieldRequest parse_field(const std::string& name) {
    FieldRequest field{name, name};
    constexpr std::string_view magnitude = "mag(";
    if (name.starts_with(magnitude) && name.ends_with(")")) {
        field.array = name.substr(magnitude.size(), name.size() - magnitude.size() - 1);
        field.part = FieldPart::magnitude;
    } else if (const std::size_t colon = name.rfind(':'); colon != std::string::npos) {
        const std::string_view axis = std::string_view(name).substr(colon + 1);
        const std::size_t component = std::string_view("xyz").find(axis);
        if (axis.size() == 1 && component != std::string_view::npos) {
            field.array = name.substr(0, colon);
            field.part = FieldPart::component;
            field.component = component;
        }
    }
    if (field.array.empty()) throw UsageError(fmt::format("'{}' names no field", name));
    return field;
}

std::vector<double> part_of(const FieldRequest& field, std::span<const double> values, std::size_t components) {
    if (field.part == FieldPart::scalar && components != 1)
        throw UsageError(fmt::format("field '{0}' has {1} components: give {0}:x or mag({0})", field.name, components));
    if (field.part == FieldPart::component && field.component >= components)
        throw UsageError(fmt::format("field '{}': the array has {} components", field.name, components));
    std::vector<double> part;
    part.reserve(values.size() / components);
    for (std::size_t first = 0; first + components <= values.size(); first += components) {
        double value = values[first + field.component];
        if (field.part == FieldPart::magnitude) {
            double squared = 0;
            for (std::size_t i = 0; i < components; ++i) squared += values[first + i] * values[first + i];
            value = std::sqrt(squared);
        }
        if (!std::isfinite(value))
            throw UsageError(
                fmt::format("field '{}': value {} is not a finite number", field.name, first / components));
        part.push_back(value);
    }
    return part;
}

namespace {

/// Puts the mesh of another file, which may know of regions, in place of that of the solution.
void replace_mesh(Mesh mesh, const std::filesystem::path& file, Solution& solution) {
    const Mesh& old = solution.mesh;
    if (mesh.points.size() != old.points.size() || mesh.triangles.size() != old.triangles.size() ||
        mesh.quads.size() != old.quads.size())
        throw InputError({file.string(), 0, {}},
                         fmt::format("{} vertices, {} triangles and {} quads, where the solution has {}, {} and {}",
                                     mesh.points.size(), mesh.triangles.size(), mesh.quads.size(), old.points.size(),
                                     old.triangles.size(), old.quads.size()));
    Box box;
    for (const Point p : mesh.points) box.include(p);
    const double rounding = 1e-5 * box.width();  // many solvers write coordinates in single precision
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        if (distance(mesh.points[i], old.points[i]) > rounding)
            throw InputError({file.string(), 0, {}}, fmt::format("vertex {} lies elsewhere in the solution", i));
    solution.mesh = std::move(mesh);
}

#ifdef LAMINA_WITH_CGNS
Solution read_cgns_fields(const std::filesystem::path& file, std::span<const FieldRequest> fields) {
    return read_cgns_solution(file, fields);
}
std::vector<std::string> cgns_names(const std::filesystem::path& file) { return cgns_fields(file); }
#else
Solution read_cgns_fields(const std::filesystem::path& file, std::span<const FieldRequest>) {
    read_mesh(file);  // says that there is no CGNS
    return {};
}
std::vector<std::string> cgns_names(const std::filesystem::path& file) {
    read_mesh(file);
    return {};
}
#endif

}  // namespace

}  // namespace lamina::io

namespace lamina {

using namespace io;

Solution read_solution(const std::filesystem::path& solution, const std::vector<std::string>& fields,
                       const std::filesystem::path& mesh) {
    std::vector<FieldRequest> requests;
    requests.reserve(fields.size());
    for (const std::string& name : fields) requests.push_back(parse_field(name));
    std::error_code ignored;
    if (std::filesystem::is_directory(solution, ignored)) return read_openfoam_solution(solution, requests, mesh);
    const std::string extension = core::extension_of(solution);
    if (extension == ".dat" || extension == ".csv") return read_su2_solution(solution, requests, mesh);
    const bool is_cgns = extension == ".cgns";
    if (!is_cgns && find_format(solution).name != find_format("solution.vtu").name)
        throw UsageError(fmt::format(
            "{}: solutions are VTU and CGNS files, restart files of SU2 (.dat, .csv) or time folders of OpenFOAM",
            solution.string()));
    Solution result = is_cgns ? read_cgns_fields(solution, requests)
                              : read_vtu_solution(read_file(solution), input_name(solution), requests);
    if (!mesh.empty()) replace_mesh(read_mesh(mesh), mesh, result);
    return result;
}

std::vector<std::string> solution_fields(const std::filesystem::path& file) {
    if (core::extension_of(file) == ".cgns") return cgns_names(file);
    return vtu_fields(read_file(file), input_name(file));
}

void write_solution(const Solution& solution, const std::filesystem::path& file) {
    core::write_stream_atomically(file, [&](std::ostream& out) { write_vtu_solution(solution, out); });
}

void write_sizes(const SizedMesh& sizes, const std::filesystem::path& file) {
    core::write_stream_atomically(file, [&](std::ostream& out) { write_vtu_sizes(sizes, out); });
}

}  // namespace lamina
