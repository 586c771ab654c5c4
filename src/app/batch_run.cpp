#include "app/batch_run.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "app/batch_job.hpp"
#include "app/batch_records.hpp"
#include "app/fingerprint.hpp"

namespace lamina::app {

namespace {

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
