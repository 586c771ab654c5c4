// lamina delaunay: triangulates and refines the contents of Triangle's files.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/predicates.hpp>
#include <lamina/threads.hpp>
#include <lamina/triangle_files.hpp>

#include "app/commands.hpp"
#include "app/delaunay_report.hpp"
#include "app/delaunay_run.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/stopwatch.hpp"
#include "app/table_option.hpp"
#include "core/option_builders.hpp"

namespace lamina::app {

namespace {

namespace fs = std::filesystem;

struct DelaunayArguments {
    std::string file, format;
    std::string stem;
    std::string min_angle, max_area, drop_flat, threads, max_triangles, max_memory;
    std::optional<std::string> merge;  ///< empty text: equal points alone
    std::string report;
    bool quiet = false, strict = false;
    DelaunaySettings settings;  ///< the flags
};

/// Returns the stem of the output files: FILE.1 where none is given.
fs::path output_stem(const DelaunayArguments& arguments) {
    if (is_standard_stream(arguments.stem))
        throw UsageError("option --output: Triangle's format is several files, which standard output cannot carry");
    if (!arguments.stem.empty()) return arguments.stem;
    if (is_standard_stream(arguments.file))
        throw UsageError("standard input has no name that the outputs could be named after: give -o STEM");
    fs::path stem = arguments.file;
    stem.replace_extension();
    return stem += ".1";
}

/// Returns the input, and the .node file that a .poly file may refer to.
std::vector<RunFile> files_read(const DelaunayArguments& arguments) {
    const fs::path file = arguments.file;
    if (is_standard_stream(file)) return {{file, "FILE"}};
    return {{file, "FILE"}, {fs::path(file).replace_extension(".node"), "FILE"}};
}

std::vector<RunFile> files_written(const DelaunayArguments& arguments, const fs::path& stem) {
    std::vector<RunFile> files;
    const bool is_poly = fs::path(arguments.file).extension() == ".poly" || arguments.format == "poly";
    for (const fs::path& file : triangle_files(stem, is_poly)) files.push_back({file, "option --output"});
    if (!arguments.report.empty()) files.push_back({arguments.report, "option --report"});
    return files;
}

DelaunaySettings settings_of(const DelaunayArguments& arguments) {
    DelaunaySettings settings = arguments.settings;
    set_by_name(option_table<RefineOptions>(), "min-angle", arguments.min_angle, settings.refine);
    if (!arguments.max_area.empty()) {
        settings.max_area = parse_real(arguments.max_area, "option --max-area");
        if (!positive_numbers.contains(settings.max_area))
            throw UsageError("option --max-area: must be " + positive_numbers.text());
    }
    ConstrainedOptions constrained;
    set_by_name(option_table<ConstrainedOptions>(), "drop-flat", arguments.drop_flat, constrained);
    settings.drop_flat = constrained.drop_flat;
    if (arguments.merge) {
        settings.merge_distance = arguments.merge->empty() ? 0 : parse_real(*arguments.merge, "option --merge");
        if (!numbers_from_to(0, max_exact_coordinate).contains(*settings.merge_distance))
            throw UsageError("option --merge: must be " + numbers_from_to(0, max_exact_coordinate).text());
    }
    return settings;
}

/// Returns the options that the command has in common with `lamina mesh`: the threads and the limits.
CaseOptions case_options_of(const DelaunayArguments& arguments) {
    CaseOptions options;
    set_by_name(option_table<CaseOptions>(), "threads", arguments.threads, options);
    set_by_name(option_table<CaseOptions>(), "max-triangles", arguments.max_triangles, options);
    set_by_name(option_table<CaseOptions>(), "max-memory", arguments.max_memory, options);
    return options;
}

/// Returns why a word after --merge is no distance; empty if it is one.
std::string require_merge_distance(const std::string& word) {
    if (word.empty() || word == "true") return {};
    try {
        parse_real(word, "option --merge");
    } catch (const UsageError&) {
        return "takes " + word + " for its distance: write --merge=TOL, or FILE before --merge";
    }
    return {};
}

void run(const DelaunayArguments& arguments) {
    const CaseOptions options = case_options_of(arguments);
    DelaunaySettings settings = settings_of(arguments);
    settings.limits = with_default_limits(options.limits);
    DelaunayRunFacts facts{.stem = output_stem(arguments), .threads = options.threads};
    require_format(arguments.file, arguments.format, "--input-format");
    check_folder_writable(facts.stem);
    if (!arguments.report.empty()) check_folder_writable(arguments.report);
    const std::vector<RunFile> outputs = files_written(arguments, facts.stem);
    require_distinct(files_read(arguments), outputs);
    const SignalGuard guard(outputs);

    ProgressPrinter progress(ProgressShown::automatic, arguments.quiet);
    Stopwatch watch, total;
    progress.begin({"reading"});
    TriangleInput input = read_triangle_files(arguments.file, arguments.format,
                                              settings.merge_distance ? EqualPoints::accept : EqualPoints::refuse);
    facts.with_poly = !input.segment_file.empty();
    facts.read_seconds = watch.lap();
    DelaunayResult result;
    with_threads(facts.threads, [&] {
        result = run_delaunay(std::move(input), settings, [&](const auto& event) { progress.begin(event); });
    });
    print_warnings(result.warnings);
    watch.lap();
    progress.begin({"writing"});
    write_triangle_files(result.output, facts.stem, facts.with_poly);
    facts.write_seconds = watch.lap();
    facts.smallest_angle_deg = smallest_angle_deg(result.output.points, result.output.triangles);
    facts.total_seconds = total.lap();

    if (!arguments.report.empty()) write_file(arguments.report, delaunay_report(result, facts));
    if (!arguments.quiet) print_summary(delaunay_summary(result, facts), outputs);
    require_no_warnings(result.warnings, arguments.strict);
}

}  // namespace

void add_delaunay_command(CLI::App& app) {
    CLI::App* command = add_command(
        app, "delaunay", "triangulate the points and segments of Triangle's files, and refine the triangulation");
    auto arguments = std::make_shared<DelaunayArguments>();
    add_option(*command, "FILE", arguments->file,
               "FILE.poly (segments, holes, regions) or FILE.node (points); - for standard input")
        .required();
    add_option(*command, "--input-format", arguments->format,
               "format of FILE, node or poly; else its extension says it")
        .type_name("node|poly");
    add_option(*command, "-o,--output", arguments->stem,
               "write STEM.node, STEM.ele and, for a .poly file, STEM.poly [FILE.1]")
        .type_name("STEM");
    add_table_option(*command, option_table<RefineOptions>(), "min-angle", arguments->min_angle);
    add_option(*command, "--max-area", arguments->max_area,
               "largest area of a triangle, in squared units of the input; > 0")
        .type_name("A");
    add_flag(*command, "--keep-border", arguments->settings.keep_border,
             "split no segment and no edge of the boundary");
    add_flag(*command, "--keep-hull", arguments->settings.keep_hull,
             "keep the triangles of the convex hull that lie outside the segments");
    add_flag(*command, "--insert-crossings", arguments->settings.insert_crossings,
             "add a vertex where segments cross, which is an error otherwise, and lead segments through vertices "
             "that they miss by rounding alone");
    add_table_option(*command, option_table<ConstrainedOptions>(), "drop-flat", arguments->drop_flat);
    add_option_with_or_without_value(
        *command, "--merge", arguments->merge,
        "take points at most TOL apart, in units of the input, for the same, equal ones where TOL is left "
        "out, and with --insert-crossings lead segments through vertices at most TOL away; write --merge=TOL, "
        "or FILE before --merge")
        .check(&require_merge_distance)
        .type_name("[TOL]");
    add_table_option(*command, option_table<CaseOptions>(), "threads", arguments->threads);
    add_table_option(*command, option_table<CaseOptions>(), "max-triangles", arguments->max_triangles);
    add_table_option(*command, option_table<CaseOptions>(), "max-memory", arguments->max_memory);
    add_option(*command, "--report", arguments->report, "JSON report of the run to write").type_name("FILE");
    add_flag(*command, "--quiet", arguments->quiet,
             "print no summary and no progress; warnings and errors are printed");
    add_flag(*command, "--strict", arguments->strict,
             "end with exit code 4 where there is any warning; the outputs are written");
    run_with(*command, [arguments] { run(*arguments); });
}

}  // namespace lamina::app
