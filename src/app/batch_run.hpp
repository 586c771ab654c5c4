// The jobs of `lamina batch`: run on several threads, each recorded in one line as soon as it is finished, so that an
// interrupted batch goes on where it was.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/case.hpp"

namespace lamina::app {

/// One mesh of a batch.
struct BatchJob {
    std::string name;                                          ///< stands for {name} in names of files
    std::vector<std::pair<std::string, std::string>> swept{};  ///< names and values of the options that are swept
    MeshCase mesh_case;                                        ///< with the names of files filled in
};

/// Options of run_batch().
struct BatchSettings {
    unsigned jobs = 0;              ///< number of meshes made at a time; 0: one per core
    std::filesystem::path journal;  ///< a line of JSON for each finished job, in the order in which they finish
    std::filesystem::path table;    ///< written at the end: a line of CSV for each job, in their order
    std::string template_mesh;      ///< file of the mesh whose cells all meshes have; empty: each is made anew
    bool quiet = false;             ///< whether finished jobs are not printed on standard error
    bool strict = false;            ///< whether warnings make a job fail
};

/// The numbers of jobs by their outcome.
struct BatchOutcome {
    std::size_t done = 0;    ///< number of jobs that were done now
    std::size_t kept = 0;    ///< number of those that were done by an earlier run
    std::size_t failed = 0;  ///< number of those that failed
};

/// Runs the jobs, each on as many threads as its case asks for, else on one. An earlier journal counts: jobs that it
/// has with the same options and the same input are not run again, unless files that they wrote are missing or have
/// changed. A job that fails is recorded with its error and does not stop the others. Throws IoError where journal or
/// table cannot be written.
BatchOutcome run_batch(const std::vector<BatchJob>& jobs, const BatchSettings& settings);

}  // namespace lamina::app
