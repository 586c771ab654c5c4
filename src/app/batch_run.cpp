#include "app/batch_run.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/morph.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/threads.hpp>

#include "app/batch_records.hpp"
#include "app/case_inputs.hpp"
#include "app/check_report.hpp"
#include "app/fingerprint.hpp"
#include "app/mesh_run.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/run_files.hpp"
#include "app/stopwatch.hpp"

namespace lamina::app {

namespace {

Json quality_of(const MeshResult& result) {
    return {{"min_angle", result.check.isotropic.min_angle_deg},
            {"max_angle", std::max(result.check.isotropic.max_angle_deg, result.check.layer.max_angle_deg)},
            {"median_first_height", result.check.walls.median_first_height}};
}

/// The mesh whose cells all meshes of a batch have.
struct MeshTemplate {
    Mesh mesh;
    std::string hash;
    MorphMap map;

    explicit MeshTemplate(const std::string& file) : mesh(read_valid_mesh(file)), hash(mesh_hash(mesh)), map(mesh) {}
};

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

/// Returns the record of a job once it has run: one object of JSON.
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

/// Runs jobs on several threads. Each thread takes the next job that is left.
class BatchRunner {
public:
    BatchRunner(const std::vector<BatchJob>& jobs, const BatchSettings& settings)
        : jobs_(jobs), settings_(settings), records_(jobs.size()), fingerprints_(jobs.size()) {
        if (!settings.template_mesh.empty()) template_.emplace(settings.template_mesh);
        threads_ = settings.jobs > 0 ? settings.jobs : std::max(1u, std::thread::hardware_concurrency());
        keep_earlier_records();
    }

    BatchOutcome run() {
        std::vector<std::thread> workers;
        const auto count = static_cast<unsigned>(std::min<std::size_t>(threads_, left_.size()));
        for (unsigned i = 0; i < count; ++i) workers.emplace_back([this] { work(); });
        for (std::thread& worker : workers) worker.join();
        if (failure_) std::rethrow_exception(failure_);
        write_file(settings_.table, table_of(jobs_, records_));
        return outcome_;
    }

private:
    const std::vector<BatchJob>& jobs_;
    const BatchSettings& settings_;
    std::optional<MeshTemplate> template_;
    unsigned threads_ = 1;
    std::vector<Json> records_;
    std::vector<std::string> fingerprints_;
    std::vector<std::size_t> left_;  ///< numbers of the jobs to run
    std::atomic<std::size_t> next_ = 0;
    std::mutex mutex_;  ///< guards all below
    std::ofstream journal_;
    BatchOutcome outcome_;
    std::exception_ptr failure_;

    /// Takes the records of an earlier run that still hold, and begins a journal with them.
    void keep_earlier_records() {
        const std::map<std::string, Json> earlier = read_journal(settings_.journal);
        std::string kept;
        for (std::size_t i = 0; i < jobs_.size(); ++i) {
            fingerprints_[i] = fingerprint(jobs_[i].mesh_case) + (template_ ? template_->hash : "");
            const auto found = earlier.find(id_of(jobs_[i]));
            if (found == earlier.end() || !still_holds(found->second, fingerprints_[i])) {
                left_.push_back(i);
                continue;
            }
            records_[i] = found->second;
            kept += line_of(found->second);
            ++outcome_.kept;
        }
        write_file(settings_.journal, kept);
        journal_.open(settings_.journal, std::ios::app);
    }

    void work() {
        for (std::size_t n; (n = next_.fetch_add(1)) < left_.size();) {
            const std::size_t i = left_[n];
            try {
                record(i, run_job(jobs_[i], template_ ? &*template_ : nullptr, fingerprints_[i], threads_,
                                  settings_.strict));
            } catch (...) {
                next_ = left_.size();
                const std::lock_guard lock(mutex_);
                failure_ = std::current_exception();
            }
        }
    }

    void record(std::size_t i, Json result) {
        const std::lock_guard lock(mutex_);
        journal_ << line_of(result) << std::flush;
        if (!journal_) throw IoError(settings_.journal.string(), "cannot be written");
        const bool done = result["outcome"] == "done";
        ++(done ? outcome_.done : outcome_.failed);
        print_warnings(i, result);
        if (!settings_.quiet || !done) print(i, result, done);
        records_[i] = std::move(result);
    }

    void print_warnings(std::size_t i, const Json& result) const {
        for (const Json& warning : result.value("warnings", Json::array())) {
            std::fputs(fmt::format("lamina: warning: {}: {}\n", id_of(jobs_[i]), warning["message"].get<std::string>())
                           .c_str(),
                       stderr);
        }
    }

    void print(std::size_t i, const Json& result, bool done) const {
        const std::string what =
            done ? fmt::format("{} triangles, {:.2f} s", result["triangles"].dump(), result["seconds"].get<double>())
                 : result["error"].get<std::string>();
        std::fputs(fmt::format("lamina: {} of {}: {}: {}\n", outcome_.kept + outcome_.done + outcome_.failed,
                               jobs_.size(), id_of(jobs_[i]), what)
                       .c_str(),
                   stderr);
    }
};

}  // namespace

BatchOutcome run_batch(const std::vector<BatchJob>& jobs, const BatchSettings& settings) {
    return BatchRunner(jobs, settings).run();
}

}  // namespace lamina::app
