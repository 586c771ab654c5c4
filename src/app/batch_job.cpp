#include "app/batch_job.hpp"

#include <algorithm>
#include <exception>
#include <new>

#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/threads.hpp>

#include "app/batch_records.hpp"
#include "app/case_inputs.hpp"
#include "app/check_report.hpp"
#include "app/mesh_run.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/stopwatch.hpp"

namespace lamina::app {

namespace {

Json quality_of(const MeshResult& result) {
    return {{"min_angle", result.check.isotropic.min_angle_deg},
            {"max_angle", std::max(result.check.isotropic.max_angle_deg, result.check.layer.max_angle_deg)},
            {"median_first_height", result.check.walls.median_first_height}};
}

/// Moves the template to the bodies of a case.
MeshResult morphed_mesh(const MeshTemplate& reference, const MeshCase& mesh_case, const CaseOptions& options) {
    MeshResult result;
    with_threads(options.threads, [&] {
        result.geometry = read_geometry(mesh_case.inputs, options.geometry);
        for (const Element& element : result.geometry.elements)
            result.warnings.insert(result.warnings.end(), element.warnings.begin(), element.warnings.end());
        result.mesh = reference.mesh;
        result.mesh.points = morph(reference.map, wall_points_on(reference.map, result.geometry)).points;
        result.check = check_mesh(result.mesh);
    });
    return result;
}

/// Makes and writes the mesh of a job, and adds what is known about it to its record. `reference`: the template; null:
/// there is none.
void make_mesh(const MeshCase& mesh_case, const MeshTemplate* reference, unsigned jobs, bool strict, Json& record) {
    require_consistent(mesh_case);
    require_whole(mesh_case);
    if (reference != nullptr) require_straight(mesh_case);
    CaseOptions options = options_with_files(mesh_case);
    if (!mesh_case.options.limits.max_memory_bytes && options.limits.max_memory_bytes)
        *options.limits.max_memory_bytes /= jobs;  // what is free is for all that run at a time
    if (options.threads == 0) options.threads = 1;
    const MeshDestination destination = destination_of_outputs(mesh_case);
    MeshResult result =
        reference != nullptr ? morphed_mesh(*reference, mesh_case, options) : generate_mesh(mesh_case.inputs, options);
    add_warnings_of_readers(mesh_case, destination, result);
    record["warnings"] = warnings_report(result.warnings);
    // A template is what its shapes make of it: it promises validity alone.
    if (reference == nullptr) require_promised_angles(result.check, mesh_case);
    write_outputs(mesh_case, destination, result);
    record["files"] = files_report(mesh_case, destination);
    record["points"] = result.mesh.points.size();
    record["triangles"] = result.mesh.triangles.size();
    record["quadrilaterals"] = result.mesh.quads.size();
    record["quality"] = quality_of(result);
    record["hash"] = mesh_hash(result.mesh);
    require_no_warnings(result.warnings, strict);
}

}  // namespace

MeshTemplate::MeshTemplate(const std::string& file) : mesh(read_valid_mesh(file)), hash(mesh_hash(mesh)), map(mesh) {}

Json run_job(const BatchJob& job, const MeshTemplate* reference, const std::string& digits, unsigned jobs,
             bool strict) {
    Json record{{"job", id_of(job)}, {"fingerprint", digits}, {"name", job.name}};
    for (const auto& [option, value] : job.swept) record["sweep"][option] = value;
    record["outcome"] = "failed";
    Stopwatch watch;
    const auto fail = [&](ExitCode code, const std::string& error) {
        record["exit_code"] = static_cast<int>(code);
        record["error"] = error;
    };
    try {
        make_mesh(job.mesh_case, reference, jobs, strict, record);
        record["outcome"] = "done";
        fail(ExitCode::done, "");
    } catch (const Error& error) {
        fail(error.exit_code(), error.what());
    } catch (const std::bad_alloc&) {
        fail(ExitCode::mesh_failed, "out of memory");
    } catch (const std::exception& error) {
        fail(ExitCode::mesh_failed, std::string("internal error: ") + error.what());
    }
    record["seconds"] = watch.lap();
    return record;
}

}  // namespace lamina::app
