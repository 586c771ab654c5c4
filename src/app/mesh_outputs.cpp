#include "app/mesh_outputs.hpp"

#include <filesystem>
#include <string>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "app/mesh_command_options.hpp"
#include "app/report.hpp"
#include "app/stopwatch.hpp"

namespace lamina::app {

namespace {

WriteOptions write_options(const MeshCase& mesh_case) {
    return {.format = mesh_case.format, .wall_distance = mesh_case.wall_distance};
}

}  // namespace

std::vector<RunFile> files_written(const MeshCase& mesh_case) {
    std::vector<RunFile> files;
    for (const std::string& output : mesh_case.outputs)
        for (const std::filesystem::path& file : output_files(output, write_options(mesh_case)))
            files.push_back({file, "option --output " + output});
    if (!mesh_case.wall_data.empty()) files.push_back({mesh_case.wall_data, "option --wall-data"});
    if (!mesh_case.report.empty()) files.push_back({mesh_case.report, "option --report"});
    return files;
}

void require_outputs(const MeshCase& mesh_case) {
    if (mesh_case.outputs.empty()) throw UsageError("no output: give -o FILE");
    for (const std::string& output : mesh_case.outputs) {
        require_format(output, mesh_case.format, "--format");
        check_writable(output, write_options(mesh_case));
    }
    if (!mesh_case.wall_data.empty()) check_folder_writable(mesh_case.wall_data);
    if (!mesh_case.report.empty()) check_folder_writable(mesh_case.report);
    require_distinct(files_of_case(mesh_case), files_written(mesh_case));
}

void write_outputs(const MeshCase& mesh_case, const MeshResult& result) {
    Stopwatch watch;
    for (const std::string& output : mesh_case.outputs) write_mesh(result.mesh, output, write_options(mesh_case));
    if (!mesh_case.wall_data.empty()) write_wall_data(result.mesh, mesh_case.wall_data);
    const double write_seconds = watch.lap();
    if (!mesh_case.report.empty()) write_file(mesh_case.report, to_text(mesh_report(mesh_case, result, write_seconds)));
}

}  // namespace lamina::app
