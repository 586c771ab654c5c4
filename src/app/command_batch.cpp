// lamina batch: makes the meshes of many inputs, and of many values of options.
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "app/batch_conditions.hpp"
#include "app/batch_run.hpp"
#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/mesh_command_options.hpp"
#include "app/mesh_run.hpp"
#include "app/options.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"

namespace lamina::app {

namespace {

struct BatchArguments {
    unsigned jobs = 0;
    ConditionArguments conditions;
    std::string shard, summary, template_mesh;
};

/// The part of the jobs that this run makes: every `of`-th one, from `number` on, which counts from 1.
struct Shard {
    std::size_t number = 1, of = 1;
};

Shard parse_shard(const std::string& text) {
    Shard shard;
    if (text.empty()) return shard;
    const char* const end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, shard.number);
    const bool slash = number.ec == std::errc{} && number.ptr != end && *number.ptr == '/';
    const auto of = slash ? std::from_chars(number.ptr + 1, end, shard.of) : number;
    if (!slash || of.ec != std::errc{} || of.ptr != end || shard.number < 1 || shard.number > shard.of)
        throw UsageError(fmt::format("option --shard: '{}' is not I/N with I from 1 to N", text));
    return shard;
}

/// Returns the name of a job's input: the stem of its file, or "naca_0012".
std::string name_of(const std::string& input) {
    if (input.starts_with("naca:")) {
        std::string name = input;
        std::replace(name.begin(), name.end(), ':', '_');
        return name;
    }
    return std::filesystem::path(input).stem().string();
}

/// Returns a text that is a part of a name of a file and never a path, or a part of one that leads elsewhere: "." and
/// "..".
std::string part_of_name(std::string text) {
    std::replace(text.begin(), text.end(), '/', '_');
    if (text.find_first_not_of('.') == std::string::npos) std::replace(text.begin(), text.end(), '.', '_');
    return text;
}

/// Returns the name of a file with {name} and the names of swept options in braces replaced.
std::string filled_in(std::string text, const BatchJob& job) {
    std::vector<std::pair<std::string, std::string>> marks = job.swept;
    marks.emplace_back("name", job.name);
    for (const auto& [name, given] : marks) {
        const std::string mark = "{" + name + "}", value = part_of_name(given);
        for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += value.size())
            text.replace(at, mark.size(), value);
    }
    return text;
}

/// Returns the jobs of one input, one for each of the conditions.
std::vector<BatchJob> jobs_of(const GivenOptions& options, const std::string& input,
                              const std::vector<BatchCondition>& conditions) {
    std::vector<BatchJob> jobs;
    for (const BatchCondition& condition : conditions) {
        BatchJob job;
        job.name = name_of(input);
        for (const auto& [option, value] : condition) job.swept.emplace_back(option->key(), value);
        job.mesh_case = case_of_command_line(options, {input}, condition);
        for (std::string& output : job.mesh_case.outputs) output = filled_in(output, job);
        for (const auto& [file, option] : files_beside_mesh) job.mesh_case.*file = filled_in(job.mesh_case.*file, job);
        prefer_quads_for_openfoam(job.mesh_case);
        require_consistent(job.mesh_case);
        jobs.push_back(std::move(job));
    }
    return jobs;
}

/// The files of a batch, by their paths behind links. It is for many files: it looks each of them up.
class BatchFiles {
public:
    explicit BatchFiles(const std::vector<BatchJob>& jobs) {
        for (const BatchJob& job : jobs)
            for (const RunFile& file : files_of_case(job.mesh_case)) add_input(path_behind_links(file.path));
    }

    /// Throws where a file would be written twice or replace an input.
    void add_output(const RunFile& file) {
        if (is_standard_stream(file.path)) throw UsageError(file.role + ": a batch writes files, not '-'");
        const std::filesystem::path path = path_behind_links(file.path);
        if (inputs_.contains(path) || (input_folders_.contains(path) && std::filesystem::is_directory(path)))
            throw UsageError(fmt::format("{}: '{}' would replace an input", file.role, file.path.string()));
        if (!written_.insert(path).second)
            throw UsageError(
                fmt::format("{}: '{}' would be written twice: put {{name}} and what is swept into the "
                            "name, as in 'out/{{name}}_{{reynolds}}.su2'",
                            file.role, file.path.string()));
        files_.push_back(file);
    }

    std::vector<RunFile> take() { return std::move(files_); }

    void add_input(const std::filesystem::path& path) {
        inputs_.insert(path);
        std::filesystem::path folder = path.parent_path();
        while (input_folders_.insert(folder).second && folder.has_relative_path()) folder = folder.parent_path();
    }

private:
    std::set<std::filesystem::path> inputs_, input_folders_, written_;
    std::vector<RunFile> files_;
};

/// Throws UsageError for files that tell how a mesh was made, which one of a template was not.
void require_morphable(const std::vector<BatchJob>& jobs) {
    for (const BatchJob& job : jobs)
        if (!job.mesh_case.report.empty() || !job.mesh_case.html.empty())
            throw UsageError("option --template: --report and --html tell how a mesh was made; leave them out");
}

/// Returns the files of all jobs and the given ones. Throws where a file would be written twice or replace an input.
std::vector<RunFile> require_different_files(const std::vector<BatchJob>& jobs, const std::string& template_mesh,
                                             const std::vector<RunFile>& others) {
    BatchFiles files(jobs);
    if (!template_mesh.empty())
        for (const RunFile& file : files_of_mesh(template_mesh, "")) files.add_input(path_behind_links(file.path));
    for (const BatchJob& job : jobs)
        for (const RunFile& file : files_written(job.mesh_case, destination_of_outputs(job.mesh_case)))
            files.add_output(file);
    for (const RunFile& file : others) files.add_output(file);
    return files.take();
}

/// Creates the folders of files that do not exist, such as one for each input, and returns them, inner ones before
/// outer ones. Throws where a file certainly cannot be written.
std::vector<std::filesystem::path> prepare_folders(const std::vector<BatchJob>& jobs,
                                                   const std::vector<RunFile>& files) {
    std::vector<std::filesystem::path> created;
    for (const RunFile& file : files) {
        const std::vector<std::filesystem::path> missing = missing_folders(file.path);
        created.insert(created.end(), missing.begin(), missing.end());
        create_folders_above(file.path);
    }
    std::reverse(created.begin(), created.end());
    for (const BatchJob& job : jobs) {
        destination_of_outputs(job.mesh_case).require_writable();
        for (const auto& [file, option] : files_beside_mesh)
            if (!(job.mesh_case.*file).empty()) check_folder_writable(job.mesh_case.*file);
    }
    return created;
}

/// Returns the stem of the names of journal and table: beside the outputs, unless it is given.
std::string summary_stem(const BatchArguments& arguments, const std::string& output, const Shard& shard) {
    std::string stem = arguments.summary;
    if (stem.ends_with(".csv")) stem.resize(stem.size() - 4);
    if (stem.empty())
        stem = (std::filesystem::path(output.substr(0, output.find('{')) + "x").parent_path() / "summary").string();
    return shard.of > 1 ? fmt::format("{}.{}-of-{}", stem, shard.number, shard.of) : stem;
}

void batch(const GivenOptions& options, const BatchArguments& arguments) {
    const Shard shard = parse_shard(arguments.shard);
    const std::vector<BatchCondition> conditions = conditions_of_batch(arguments.conditions);
    std::vector<BatchJob> all;
    for (const std::string& input : given_texts(options, "input"))
        for (BatchJob& job : jobs_of(options, input, conditions)) all.push_back(std::move(job));
    if (all.empty()) throw UsageError("no INPUT: give airfoil files, naca:DIGITS or case files");
    for (const BatchJob& job : all)
        if (job.mesh_case.outputs.empty()) throw UsageError("no output: give -o 'FOLDER/{name}.EXTENSION'");
    const std::vector<std::string> outputs = given_texts(options, "output");
    const std::string first_output = (outputs.empty() ? all.front().mesh_case.outputs : outputs).front();
    BatchSettings settings;
    settings.jobs = arguments.jobs;
    const std::string stem = summary_stem(arguments, first_output, shard);
    settings.journal = stem + ".jsonl";
    settings.table = stem + ".csv";
    if (!arguments.template_mesh.empty()) require_morphable(all);
    const std::vector<RunFile> files = require_different_files(
        all, arguments.template_mesh, {{settings.journal, "option --summary"}, {settings.table, "option --summary"}});

    std::vector<BatchJob> jobs;
    for (std::size_t i = shard.number - 1; i < all.size(); i += shard.of) jobs.push_back(std::move(all[i]));
    const MeshCase common = jobs.empty() ? MeshCase{} : jobs.front().mesh_case;
    settings.quiet = common.quiet;
    settings.strict = common.strict;
    settings.template_mesh = arguments.template_mesh;
    const SignalGuard guard(files);
    const std::vector<std::filesystem::path> created = prepare_folders(jobs, files);
    const BatchOutcome outcome = run_batch(jobs, settings);
    std::error_code not_empty;
    for (const std::filesystem::path& folder : created) std::filesystem::remove(folder, not_empty);
    if (!common.quiet)
        print_result(fmt::format("{} meshes made, {} kept from before, {} failed: {}\n", outcome.done, outcome.kept,
                                 outcome.failed, settings.table.string()));
    if (outcome.failed > 0)
        throw MeshError(fmt::format("{} of {} meshes were not made; {} says why", outcome.failed, jobs.size(),
                                    settings.table.string()));
}

}  // namespace

void add_batch_command(CLI::App& app) {
    CLI::App* command = add_command(app, "batch", "make the meshes of many inputs, several at a time");
    auto options = std::make_shared<GivenOptions>(add_mesh_options(*command));
    auto arguments = std::make_shared<BatchArguments>();
    add_option(*command, "--jobs", arguments->jobs,
               "number of meshes made at a time, each on one thread; 0: one per core")
        .type_name("N")
        .group("Batch");
    add_option(*command, "--sweep", arguments->conditions.sweeps,
               "values of an option to combine, as in reynolds=1e5,1e6, or ranges of them, as in alpha=-4:18:2; may be "
               "given several times, for all combinations")
        .type_name("OPTION=A,B:C:STEP,...")
        .one_at_a_time()
        .group("Batch");
    const AddedOption intervals =
        add_option(*command, "--sample", arguments->conditions.samples,
                   "interval of an option to take samples from, evenly or, with :log, by the logarithm; with "
                   "several of them, together a Latin hypercube")
            .type_name("OPTION=A:B[:log]")
            .one_at_a_time()
            .group("Batch");
    add_option(*command, "--samples", arguments->conditions.number_of_samples,
               "number of samples of these intervals, for each combination of --sweep")
        .type_name("N")
        .in_range(1, 100000)
        .needs("--sample")
        .group("Batch");
    intervals.needs("--samples");
    add_option(*command, "--seed", arguments->conditions.seed, "other samples, as good as those of any other seed")
        .type_name("N")
        .show_default()
        .needs("--sample")
        .group("Batch");
    add_option(*command, "--shard", arguments->shard, "make the I-th of N parts of the meshes alone, for N machines")
        .type_name("I/N")
        .group("Batch");
    add_option(*command, "--template", arguments->template_mesh,
               "mesh whose cells all meshes get, moved to the shapes as lamina morph does: options of layers and "
               "sizes count for nothing then, and shapes that it cannot reach are rows that say so")
        .type_name("MESH")
        .group("Batch");
    add_option(*command, "--summary", arguments->summary,
               "table of all meshes to write; beside it, with the extension .jsonl, a line for each as soon as it "
               "is finished; else summary.csv beside the outputs")
        .type_name("FILE.csv")
        .group("Batch");
    set_footer(*command, format_help());
    run_with(*command, [options, arguments] { batch(*options, *arguments); });
}

}  // namespace lamina::app
