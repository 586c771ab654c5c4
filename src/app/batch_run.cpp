#include "app/batch_run.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string_view>
#include <thread>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/morph.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/threads.hpp>
#include <lamina/version.hpp>

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

namespace fs = std::filesystem;

/// Returns the text that names a job among those of a batch.
std::string id_of(const BatchJob& job) {
    std::string id = job.name;
    for (const auto& [option, value] : job.swept) id += fmt::format(" {}={}", option, value);
    return id;
}

Json quality_of(const MeshResult& result) {
    return {{"min_angle", result.check.isotropic.min_angle_deg},
            {"max_angle", std::max(result.check.isotropic.max_angle_deg, result.check.layer.max_angle_deg)},
            {"median_first_height", result.check.walls.median_first_height}};
}

/// The contents of a file in few words.
struct FileContents {
    std::uintmax_t bytes = 0;
    std::uint64_t hash = no_text;
};

/// Returns the contents of a file; nothing where it cannot be read.
std::optional<FileContents> contents_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return {};
    FileContents contents;
    std::string block(std::size_t{1} << 20, '\0');
    while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
        const std::string_view read(block.data(), static_cast<std::size_t>(in.gcount()));
        contents.bytes += read.size();
        contents.hash = hashed(contents.hash, read);
    }
    if (in.bad()) return {};
    return contents;
}

/// Adds a file to a list, or the files of a folder in the order of their names.
void add_files(const fs::path& path, std::vector<fs::path>& files) {
    if (!fs::is_directory(path)) {
        files.push_back(path);
        return;
    }
    std::vector<fs::path> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(path)) inside.push_back(entry.path());
    std::sort(inside.begin(), inside.end());
    for (const fs::path& file : inside) add_files(file, files);
}

/// Returns the files that a job has written, with their contents.
Json files_report(const MeshCase& mesh_case, const MeshDestination& destination) {
    std::vector<fs::path> files;
    for (const RunFile& file : files_written(mesh_case, destination)) add_files(file.path, files);
    Json report = Json::array();
    for (const fs::path& file : files) {
        const std::optional<FileContents> contents = contents_of(file);
        if (!contents) throw IoError(file.string(), "cannot be read back");
        report.push_back({{"file", file.string()}, {"bytes", contents->bytes}, {"fnv1a", text_of(contents->hash)}});
    }
    return report;
}

/// Returns whether a file still has the contents that an entry of files_report() names.
bool is_unchanged(const Json& entry) {
    const fs::path file = entry["file"].get<std::string>();
    std::error_code failed;
    if (fs::file_size(file, failed) != entry["bytes"].get<std::uintmax_t>() || failed) return false;
    const std::optional<FileContents> contents = contents_of(file);
    return contents && text_of(contents->hash) == entry["fnv1a"].get<std::string>();
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

/// Returns a record as one line.
std::string line_of(const Json& record) { return record.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// The records of a journal by the names of their jobs. A line that an interruption cut off does not count.
std::map<std::string, Json> read_journal(const fs::path& journal) {
    std::map<std::string, Json> records;
    std::ifstream in(journal);
    for (std::string line; std::getline(in, line);) {
        const Json record = Json::parse(line, nullptr, false);
        if (record.is_object() && record.contains("job") && record["job"].is_string())
            records[record["job"].get<std::string>()] = record;
    }
    return records;
}

// Types of the values of a record.
bool is_text(const Json& value) { return value.is_string(); }
bool is_number(const Json& value) { return value.is_number(); }
bool is_count(const Json& value) { return value.is_number_unsigned(); }
bool is_list(const Json& value) { return value.is_array(); }

/// Returns whether an object has a value of this type under a key.
bool holds(const Json& object, const char* key, bool (*is_type)(const Json&)) {
    const auto found = object.find(key);
    return found != object.end() && is_type(*found);
}

bool is_file(const Json& value) {
    return value.is_object() && holds(value, "file", is_text) && holds(value, "bytes", is_count) &&
           holds(value, "fnv1a", is_text);
}

/// Returns whether a record has all that a job which is done has, so that it can be read without a look at types. A
/// journal may come from another version, or from an editor.
bool is_complete(const Json& record) {
    for (const char* key : {"fingerprint", "outcome", "error", "hash"})
        if (!holds(record, key, is_text)) return false;
    for (const char* key : {"exit_code", "points", "triangles", "quadrilaterals", "seconds"})
        if (!holds(record, key, is_number)) return false;
    if (!holds(record, "warnings", is_list) || !holds(record, "files", is_list)) return false;
    const Json &files = record["files"], quality = record.value("quality", Json());
    return std::all_of(files.begin(), files.end(), is_file) && quality.is_object() &&
           std::all_of(quality.begin(), quality.end(), is_number);
}

/// Returns whether a record is of a job with this fingerprint, and the files of the job are still as they were written.
bool still_holds(const Json& record, const std::string& digits) {
    if (!is_complete(record) || record["fingerprint"] != digits || record["outcome"] != "done") return false;
    return std::all_of(record["files"].begin(), record["files"].end(), is_unchanged);
}

/// Returns whether a spreadsheet takes a text for a formula. Negative numbers are none.
bool is_formula(const std::string& text) {
    if (text.empty() || std::string_view("=+-@\t\r").find(text.front()) == std::string_view::npos) return false;
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + (text.front() == '+' ? 1 : 0), end, number);
    return read.ec != std::errc{} || read.ptr != end;
}

/// Returns a field of CSV. An apostrophe before what would be a formula makes it a text.
std::string csv_field(std::string text) {
    if (is_formula(text)) text.insert(0, 1, '\'');
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
    return '"' + text + '"';
}

std::string csv_field(const Json& value) {
    return csv_field(value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump());
}

std::string table_of(const std::vector<BatchJob>& jobs, const std::vector<Json>& records) {
    std::string text = "name";
    if (!jobs.empty())
        for (const auto& [option, value] : jobs.front().swept) text += "," + option;
    text +=
        ",outcome,exit_code,error,warnings,points,triangles,quadrilaterals,min_angle,max_angle,median_first_height,"
        "seconds,hash\n";
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const Json& record = records[i];
        text += csv_field(jobs[i].name);
        for (const auto& [option, value] : jobs[i].swept) text += "," + csv_field(value);
        for (const char* key : {"outcome", "exit_code", "error"}) text += "," + csv_field(record.value(key, Json()));
        text += fmt::format(",{}", record.value("warnings", Json::array()).size());
        for (const char* key : {"points", "triangles", "quadrilaterals"})
            text += "," + csv_field(record.value(key, Json()));
        const Json quality = record.value("quality", Json::object());
        for (const char* key : {"min_angle", "max_angle", "median_first_height"})
            text += "," + csv_field(quality.value(key, Json()));
        for (const char* key : {"seconds", "hash"}) text += "," + csv_field(record.value(key, Json()));
        text += "\n";
    }
    return text;
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
