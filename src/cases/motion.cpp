// Cases of OpenFOAM whose meshes move.
//
// pimpleFoam of OpenFOAM v1912 takes no points of given times: its motion solvers find the inner points from patches.
// Every point of a mesh that is one cell thick is on its patch `frontAndBack`, though, and such a patch may have
// displacements that are read at given times, uniformInterpolatedDisplacement. So all vertices go where morph() has
// them.
#include <lamina/solver_case.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "cases/case_files.hpp"
#include "cases/templates.hpp"
#include "core/atomic_file.hpp"
#include "io/formats.hpp"

namespace lamina::cases {

namespace fs = std::filesystem;

namespace {

constexpr const char* mesh_format = "openfoam";

/// Returns the files of a moving case beside the mesh and the times. The solution of its equations is that of cases in
/// time.
std::vector<SolverCaseFile> moving_case_files() {
    std::vector<SolverCaseFile> files;
    for (const Template& file : templates()) {
        if (file.solver == "motion") files.push_back({file.name, std::string(file.text), file.text.starts_with("#!")});
        if (file.solver == "openfoam" && file.name == "system/fvSolution.unsteady")
            files.push_back({"motion/fvSolution.unsteady", std::string(file.text)});
    }
    return files;
}

/// Returns the name of the folder of a time, as OpenFOAM gives it.
std::string time_name(double time) { return fmt::format("{:.8g}", time); }

/// Throws UsageError where a folder has times of another motion, which Allrun would take for those of this one.
void require_no_other_times(std::span<const double> times, const fs::path& folder) {
    std::set<std::string> names;
    for (const double time : times) names.insert(time_name(time));
    std::error_code missing;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing))
        if (fs::exists(entry.path() / "displacement") && !names.contains(entry.path().filename().string()))
            throw UsageError(fmt::format("{}: is the time of another motion: remove it, or name another folder",
                                         entry.path().string()));
}

}  // namespace

}  // namespace lamina::cases

namespace lamina {

using namespace cases;

void write_moving_case(const Mesh& reference, std::span<const double> times, const fs::path& folder) {
    if (std::any_of(reference.markers.begin(), reference.markers.end(), io::is_axis<Marker>))
        throw UsageError("a case with a mesh that moves is that of a plane flow: the mesh has a marker 'axis'");
    require_no_other_times(times, folder);
    write_mesh(reference, folder, {.format = mesh_format});
    for (const SolverCaseFile& file : moving_case_files()) {
        core::NewFolders folders;
        folders.create_above(folder / file.name);
        write_case_file(file, folder);
        folders.keep();
    }
}

void add_moved_points(const Mesh& reference, std::span<const Point> points, double time, const fs::path& folder) {
    if (points.size() != reference.points.size())
        throw InputError({},
                         fmt::format("{} points for a mesh of {} vertices", points.size(), reference.points.size()));
    if (!(time >= 0) || std::isinf(time)) throw InputError({}, fmt::format("{} is no time of a case", time));
    io::write_openfoam_time(reference, points, folder / time_name(time));
}

std::vector<fs::path> moving_case_outputs(const fs::path& folder, std::span<const double> times) {
    std::vector<fs::path> outputs = output_files(folder, {.format = mesh_format});
    for (const SolverCaseFile& file : moving_case_files()) outputs.push_back(folder / file.name);
    for (const double time : times)
        for (const fs::path& file : io::openfoam_time_files(folder / time_name(time))) outputs.push_back(file);
    return outputs;
}

}  // namespace lamina
