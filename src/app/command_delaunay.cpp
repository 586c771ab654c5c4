// lamina delaunay: plain or constrained Delaunay triangulation of Triangle's files, refined where asked.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/mesh.hpp>
#include <lamina/threads.hpp>
#include <lamina/triangle_files.hpp>
#include <lamina/version.hpp>

#include "app/commands.hpp"
#include "app/options.hpp"
#include "app/report.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

namespace {

namespace fs = std::filesystem;

struct DelaunayArguments {
    std::string file;
    std::string stem;
    std::string min_angle, max_area, threads;
    std::string report;
    bool keep_border = false;
    bool keep_hull = false;
    bool insert_crossings = false;
    bool quiet = false;
};

struct Settings {
    fs::path stem;
    RefineOptions refine{.min_angle_deg = 0};
    double max_area = HUGE_VAL;
    CaseOptions run;  ///< the number of threads
};

/// What is written, with what the report says about it.
struct Outcome {
    TriangleOutput output;
    double triangulation_seconds = 0, refinement_seconds = 0;
    RefineStats stats;
    Json decomposition, thread_seconds;  ///< of points without segments
};

class Stopwatch {
public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

Settings settings_of(const DelaunayArguments& arguments) {
    Settings settings;
    settings.stem = arguments.stem;
    if (arguments.stem.empty()) {
        settings.stem = arguments.file;
        settings.stem.replace_extension();
        settings.stem += ".1";
    }
    set_by_name(refine_option_table(), "min-angle", arguments.min_angle, settings.refine);
    set_by_name(case_option_table(), "threads", arguments.threads, settings.run);
    if (!arguments.max_area.empty()) {
        settings.max_area = parse_real(arguments.max_area, "option --max-area");
        if (!positive_numbers.contains(settings.max_area))
            throw UsageError("option --max-area: must be " + positive_numbers.text());
    }
    return settings;
}

/// Errors of the triangulation know points and segments by index: says in which file they are.
template <class F>
auto naming_file(const TriangleInput& input, F&& f) {
    try {
        return f();
    } catch (const InputError& error) {
        if (!error.place().file.empty()) throw;
        InputPlace place = error.place();
        place.file = (input.segment_file.empty() ? input.point_file : input.segment_file).string();
        throw InputError(place, error.reason() + " (counted from 0)");
    }
}

/// The size field whose triangles have at most this area; without a bound, one coarser than anything.
SizeField size_field(double max_area, const std::vector<Point>& points) {
    Box extent;
    for (Point p : points) extent.include(p);
    const double whole = extent.width() * extent.width() + extent.height() * extent.height();
    return SizeField(size_for_area(std::min(max_area, 16 * whole)));
}

ConstrainedRefinement refine_input(const TriangleInput& input, const ConstrainedTriangulation& triangulation,
                                   const Settings& settings, bool keep_border) {
    ConstrainedRefineOptions options;
    options.refine = settings.refine;
    options.split_segments = !keep_border;
    for (const TriangleRegion& region : input.regions)
        options.regions.push_back(
            {region.at,
             size_field(region.max_area > 0 ? std::min(region.max_area, settings.max_area) : settings.max_area,
                        input.points)});
    return refine(input.points, triangulation, size_field(settings.max_area, input.points), options);
}

/// Points without segments are triangulated in pieces, on all threads.
ConstrainedTriangulation triangulate_points(const TriangleInput& input, Outcome& outcome) {
    Triangulation made = lamina::triangulate(input.points);
    outcome.decomposition = decomposition_report(made.decomposition);
    for (const TriangulationThread& thread : made.threads) {
        outcome.thread_seconds["decomposition"].push_back({{"busy", thread.cutting}});
        outcome.thread_seconds["triangulation"].push_back({{"busy", thread.triangulating}, {"idle", thread.idle}});
    }
    ConstrainedTriangulation result;
    result.triangles = std::move(made.triangles);
    return result;
}

ConstrainedTriangulation triangulate_input(const DelaunayArguments& arguments, const TriangleInput& input,
                                           Outcome& outcome) {
    if (input.segments.empty() && input.holes.empty()) return triangulate_points(input, outcome);
    ConstrainedOptions options;
    options.holes = input.holes;
    options.crossings = arguments.insert_crossings ? Crossings::insert : Crossings::refuse;
    if (!input.segments.empty() && !arguments.keep_hull) options.keep = KeptRegion::inside_segments;
    return lamina::triangulate(input.points, input.segments, options);
}

/// Attributes and markers of the input are kept; new vertices have attributes 0 and the marker of their segment.
Outcome triangulate(const DelaunayArguments& arguments, const Settings& settings, TriangleInput input) {
    Outcome outcome;
    Stopwatch watch;
    const ConstrainedTriangulation triangulation =
        naming_file(input, [&] { return triangulate_input(arguments, input, outcome); });
    outcome.triangulation_seconds = watch.lap();

    TriangleOutput& output = outcome.output;
    std::vector<Point> steiner_points = triangulation.steiner_points;
    std::vector<std::uint32_t> parents = triangulation.parents;
    output.triangles = triangulation.triangles;
    output.segments = triangulation.segments;
    const bool bounded_regions = std::any_of(input.regions.begin(), input.regions.end(),
                                             [](const TriangleRegion& region) { return region.max_area > 0; });
    const bool refined = settings.refine.min_angle_deg > 0 || std::isfinite(settings.max_area) || bounded_regions;
    std::vector<std::uint32_t> regions;
    if (refined || !input.regions.empty()) {
        ConstrainedRefinement refinement =
            naming_file(input, [&] { return refine_input(input, triangulation, settings, arguments.keep_border); });
        steiner_points = std::move(refinement.steiner_points);
        parents = std::move(refinement.parents);
        output.triangles = std::move(refinement.triangles);
        output.segments = std::move(refinement.segments);
        regions = std::move(refinement.regions);
        outcome.stats = refinement.stats;
    }
    outcome.refinement_seconds = watch.lap();

    output.first_index = input.first_index;
    output.points = std::move(input.points);
    output.points.insert(output.points.end(), steiner_points.begin(), steiner_points.end());
    output.attribute_count = input.attribute_count;
    output.attributes = std::move(input.attributes);
    output.attributes.resize(output.points.size() * output.attribute_count, 0.0);
    output.markers = std::move(input.markers);
    output.markers.resize(output.points.size(), 0);
    for (std::size_t i = 0; i < output.segments.size(); ++i) {
        const long marker = input.segment_markers.empty() ? 0 : input.segment_markers[parents[i]];
        output.segment_markers.push_back(marker);
        for (VertexId v : {output.segments[i].a, output.segments[i].b})
            if (output.markers[v.index()] == 0) output.markers[v.index()] = marker;
    }
    mark_boundary(output);
    for (std::uint32_t region : regions)
        output.regional.push_back(region == ConstrainedRefinement::no_region ? 0 : input.regions[region].attribute);
    if (input.regions.empty()) output.regional.clear();
    output.holes = std::move(input.holes);
    output.regions = std::move(input.regions);
    return outcome;
}

void run(const DelaunayArguments& arguments) {
    const Settings settings = settings_of(arguments);
    check_folder_writable(settings.stem);
    if (!arguments.report.empty()) check_folder_writable(arguments.report);

    Stopwatch watch, total;
    TriangleInput input = read_triangle_files(arguments.file);
    const bool with_poly = !input.segment_file.empty();
    const double read_seconds = watch.lap();
    Outcome outcome;
    with_threads(settings.run.threads, [&] { outcome = triangulate(arguments, settings, std::move(input)); });
    const TriangleOutput& output = outcome.output;
    watch.lap();
    write_triangle_files(output, settings.stem, with_poly);
    const double write_seconds = watch.lap();
    const double angle = smallest_angle_deg(output.points, output.triangles);

    if (!arguments.report.empty()) {
        Mesh mesh;
        mesh.points = output.points;
        mesh.triangles = output.triangles;
        Json report = {{"version", LAMINA_VERSION},
                       {"threads", settings.run.threads == 0 ? thread_count() : settings.run.threads},
                       {"vertices", output.points.size()},
                       {"triangles", output.triangles.size()},
                       {"min_angle_deg", angle},
                       {"angles_below_bound", outcome.stats.below_bound},
                       {"angles_exempt", outcome.stats.exempt},
                       {"oversized", outcome.stats.oversized},
                       {"seconds",
                        {{"read", read_seconds},
                         {"triangulation", outcome.triangulation_seconds},
                         {"refinement", outcome.refinement_seconds},
                         {"write", write_seconds},
                         {"total", total.lap()}}},
                       {"hash", mesh_hash(mesh)}};
        if (!outcome.decomposition.is_null()) {
            report["decomposition"] = outcome.decomposition;
            report["thread_seconds"] = outcome.thread_seconds;
        }
        write_file(arguments.report, to_text(report));
    }
    if (arguments.quiet) return;
    fmt::print("{}.node, .ele{}: {} vertices, {} triangles, smallest angle {:.2f} degrees\n", settings.stem.string(),
               with_poly ? ", .poly" : "", output.points.size(), output.triangles.size(), angle);
    if (const auto& stats = outcome.stats; stats.below_bound + stats.oversized > 0)
        fmt::print("  under the angle bound: {} triangles, {} of them at sharp corners of the input; too large: {}\n",
                   stats.below_bound, stats.exempt, stats.oversized);
}

}  // namespace

void add_delaunay_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "delaunay", "Delaunay triangulation of Triangle's files, constrained and refined where asked");
    auto a = std::make_shared<DelaunayArguments>();
    command->add_option("FILE", a->file, "FILE.poly (segments, holes, regions) or FILE.node (points)")->required();
    command->add_option("-o,--output", a->stem, "writes STEM.node, STEM.ele, and STEM.poly for a .poly [FILE.1]")
        ->type_name("STEM");
    add_table_option(*command, refine_option_table(), "min-angle", a->min_angle);
    command->add_option("--max-area", a->max_area, "largest area of a triangle; > 0")->type_name("A");
    command->add_flag("--keep-border", a->keep_border, "split no segment and no edge of the rim");
    command->add_flag("--keep-hull", a->keep_hull, "fill the convex hull, concavities included");
    command->add_flag("--insert-crossings", a->insert_crossings, "add a vertex where segments cross; else an error");
    add_table_option(*command, case_option_table(), "threads", a->threads);
    command->add_option("--report", a->report, "JSON report of the run")->type_name("FILE");
    command->add_flag("--quiet", a->quiet, "no summary");
    command->callback([a] { run(*a); });
}

}  // namespace lamina::app
