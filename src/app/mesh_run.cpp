#include "app/mesh_run.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/forecast.hpp>
#include <lamina/io.hpp>
#include <lamina/page.hpp>
#include <lamina/solver_case.hpp>
#include <lamina/stream.hpp>

#include "app/case_inputs.hpp"
#include "app/options.hpp"
#include "app/page_text.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/standard_output.hpp"
#include "app/stopwatch.hpp"
#include "app/summary.hpp"

namespace lamina::app {

namespace {

bool is_for_openfoam(const MeshCase& mesh_case) {
    return std::any_of(mesh_case.outputs.begin(), mesh_case.outputs.end(), [&](const std::string& output) {
        return format_name(output, write_options(mesh_case)) == "openfoam";
    });
}

bool holds_quads(const std::string& output, const MeshCase& mesh_case) {
    const std::vector<MeshFormat> formats = mesh_formats();
    const std::string name = format_name(output, write_options(mesh_case));
    return std::any_of(formats.begin(), formats.end(),
                       [&](const MeshFormat& format) { return format.name == name && format.quads; });
}

/// Throws UsageError where the case asks for what needs the whole mesh in one place; `who` does not have it.
void require_one_output(const MeshCase& mesh_case, const std::string& who) {
    const auto refuse = [&](const char* what) { throw UsageError(who + ": " + what); };
    if (mesh_case.outputs.size() != 1) refuse("writes one mesh file: give one --output");
    if (!mesh_case.wall_data.empty()) refuse("holds no mesh for --wall-data");
    if (mesh_case.wall_distance) refuse("holds no mesh for --wall-distance");
    if (!mesh_case.html.empty()) refuse("holds no mesh for --html");
}

/// Collective: returns what all processes have sent, on rank 0.
RankTraffic total_traffic(Ranks& ranks) {
    const RankTraffic own = ranks.traffic();
    RankTraffic total;
    for (const std::string& text : ranks.gather(fmt::format("{} {}", own.messages, own.bytes))) {
        std::istringstream numbers(text);
        RankTraffic one;
        numbers >> one.messages >> one.bytes;
        total.messages += one.messages;
        total.bytes += one.bytes;
    }
    return total;
}

}  // namespace

WriteOptions write_options(const MeshCase& mesh_case, double chord) {
    return {.format = mesh_case.format,
            .wall_distance = mesh_case.wall_distance,
            .parts = mesh_case.parts,
            .span = mesh_case.span ? in_units(*mesh_case.span, chord) : 0,
            .span_cells = mesh_case.span_cells,
            .span_periodic = mesh_case.span_periodic};
}

MeshDestination destination_of_outputs(const MeshCase& mesh_case) {
    MeshDestination destination;
    if (mesh_case.outputs.empty()) throw UsageError("no output: give -o FILE");
    for (const std::string& output : mesh_case.outputs) {
        require_format(output, mesh_case.format, "--format");
        for (const std::filesystem::path& file : output_files(output, write_options(mesh_case)))
            destination.files.push_back({file, "option --output " + output});
    }
    const bool is_curved = mesh_case.options.order > 1;
    destination.holds_curved_cells = true;
    destination.require_writable = [&mesh_case, is_curved] {
        for (const std::string& output : mesh_case.outputs) {
            if (is_curved)
                require_curved_format(output, write_options(mesh_case), mesh_case.options.order,
                                      mesh_case.options.node_distribution);
            check_writable(output, write_options(mesh_case));
        }
    };
    destination.warnings = [&mesh_case](const MeshResult& result) {
        return is_for_openfoam(mesh_case) ? find_solver_warnings(FlowSolver::openfoam, result.mesh)
                                          : std::vector<Warning>{};
    };
    destination.write = [&mesh_case](const MeshResult& result) {
        for (const std::string& output : mesh_case.outputs) {
            const WriteOptions options = write_options(mesh_case, result.conditions.chord);
            if (result.curved.order > 1)
                write_curved_mesh(result.mesh, result.curved, output, options);
            else
                write_mesh(result.mesh, output, options);
        }
    };
    return destination;
}

std::vector<RunFile> files_written(const MeshCase& mesh_case, const MeshDestination& destination) {
    std::vector<RunFile> files = destination.files;
    for (const auto& [name, option] : files_beside_mesh)
        if (!(mesh_case.*name).empty()) files.push_back({mesh_case.*name, std::string("option ") + option});
    return files;
}

void require_outputs(const MeshCase& mesh_case, const MeshDestination& destination) {
    if (!destination.holds_curved_cells) require_straight(mesh_case);
    destination.require_writable();
    require_parts_taken(mesh_case.outputs, write_options(mesh_case));
    for (const auto& [name, option] : files_beside_mesh)
        if (!(mesh_case.*name).empty()) check_folder_writable(mesh_case.*name);
    require_distinct(files_of_case(mesh_case), files_written(mesh_case, destination));
}

void require_whole(const MeshCase& mesh_case) {
    if (mesh_case.stream) throw UsageError("option --stream: only 'lamina mesh' writes a mesh while it is made");
}

void require_straight(const MeshCase& mesh_case) {
    if (mesh_case.options.order > 1)
        throw UsageError("option --order: only 'lamina mesh', 'family', 'batch' and 'case pyfr' make curved cells");
}

namespace {

/// Adds to the warnings of the result which markers the file loses.
void add_warnings_of_lost_markers(const MeshCase& mesh_case, const std::filesystem::path& file, MeshResult& result) {
    std::vector<Warning> lost = lost_marker_warnings(result.mesh.markers, file, write_options(mesh_case));
    std::move(lost.begin(), lost.end(), std::back_inserter(result.warnings));
}

}  // namespace

void add_warnings_of_readers(const MeshCase& mesh_case, const MeshDestination& destination, MeshResult& result) {
    std::vector<Warning> of_readers = destination.warnings(result);
    std::move(of_readers.begin(), of_readers.end(), std::back_inserter(result.warnings));
    for (const RunFile& written : destination.files) {
        if (!format_name(written.path, write_options(mesh_case)).empty())
            add_warnings_of_lost_markers(mesh_case, written.path, result);
    }
}

void report_warnings(const MeshCase& mesh_case, const MeshDestination& destination, MeshResult& result) {
    add_warnings_of_readers(mesh_case, destination, result);
    print_warnings(result.warnings);
    require_promised_angles(result.check, mesh_case);
}

double write_outputs(const MeshCase& mesh_case, const MeshDestination& destination, const MeshResult& result) {
    Stopwatch watch;
    destination.write(result);
    if (!mesh_case.wall_data.empty()) write_wall_data(result.mesh, mesh_case.wall_data);
    const double seconds = watch.lap();
    if (mesh_case.report.empty() && mesh_case.html.empty()) return seconds;
    const Json report = mesh_report(mesh_case, result, facts_of(result.mesh), seconds);
    if (!mesh_case.report.empty()) write_file(mesh_case.report, to_text(report));
    if (!mesh_case.html.empty()) write_page(result.mesh, mesh_case.html, page_of_run(mesh_case, result, report));
    return seconds;
}

namespace {

/// Every run begins so: its inputs are there, its outputs can be written, and a signal leaves nothing half-written.
struct StartedRun {
    std::vector<RunFile> outputs;
    SignalGuard guard;
    CaseOptions options;

    StartedRun(const MeshCase& mesh_case, const MeshDestination& destination)
        : outputs(checked_outputs(mesh_case, destination)), guard(outputs), options(options_with_files(mesh_case)) {}

private:
    static std::vector<RunFile> checked_outputs(const MeshCase& mesh_case, const MeshDestination& destination) {
        require_inputs(mesh_case);
        require_outputs(mesh_case, destination);
        return files_written(mesh_case, destination);
    }
};

}  // namespace

void run_mesh(const MeshCase& mesh_case, const MeshDestination& destination) {
    require_whole(mesh_case);
    const StartedRun run(mesh_case, destination);
    ProgressPrinter progress(mesh_case.progress, mesh_case.quiet);
    MeshResult result = generate_mesh(mesh_case.inputs, run.options, [&](const auto& event) { progress.begin(event); });
    report_warnings(mesh_case, destination, result);

    progress.begin({"writing"});
    const double write_seconds = write_outputs(mesh_case, destination, result);
    const Mesh& mesh = result.mesh;
    const MeshCounts counts{mesh.points.size(), mesh.triangles.size(), mesh.quads.size()};
    if (!mesh_case.quiet) print_summary(mesh_summary(mesh_case, result, counts, write_seconds), run.outputs);
    require_no_warnings(result.warnings, mesh_case.strict);
}

void forecast_mesh_of_case(const MeshCase& mesh_case) {
    require_inputs(mesh_case);
    std::vector<RunFile> files;
    if (!mesh_case.report.empty()) {
        check_folder_writable(mesh_case.report);
        files.push_back({mesh_case.report, "option --report"});
        require_distinct(files_of_case(mesh_case), files);
    }
    const SignalGuard guard(files);
    ProgressPrinter progress(mesh_case.progress, mesh_case.quiet);
    const MeshForecast forecast = forecast_mesh(mesh_case.inputs, options_with_files(mesh_case),
                                                [&](const auto& event) { progress.begin(event); });
    print_warnings(forecast.result.warnings);
    if (!mesh_case.report.empty()) write_file(mesh_case.report, to_text(forecast_report(mesh_case, forecast)));
    if (!mesh_case.quiet) print_summary(forecast_summary(mesh_case, forecast), files);
    require_no_warnings(forecast.result.warnings, mesh_case.strict);
}

void stream_mesh_of_case(const MeshCase& mesh_case, const MeshDestination& destination) {
    require_one_output(mesh_case, "option --stream");
    require_streamable(mesh_case.outputs.front(), write_options(mesh_case));
    const std::string& output = mesh_case.outputs.front();
    const StartedRun run(mesh_case, destination);
    ProgressPrinter progress(mesh_case.progress, mesh_case.quiet);
    StreamedMesh streamed = stream_mesh(
        mesh_case.inputs, run.options, [&] { return open_mesh_sink(output, write_options(mesh_case)); },
        [&](const auto& event) { progress.begin(event); });
    add_warnings_of_lost_markers(mesh_case, output, streamed.result);
    print_warnings(streamed.result.warnings);
    require_promised_angles(streamed.result.check, mesh_case);

    progress.begin({"writing"});
    Stopwatch watch;
    streamed.sink->commit();
    const double seconds = watch.lap();
    if (!mesh_case.report.empty())
        write_file(mesh_case.report,
                   to_text(mesh_report(mesh_case, streamed.result, {streamed.counts, streamed.hash}, seconds)));
    if (!mesh_case.quiet)
        print_summary(mesh_summary(mesh_case, streamed.result, streamed.counts, seconds), run.outputs);
    require_no_warnings(streamed.result.warnings, mesh_case.strict);
}

void share_mesh_of_case(const MeshCase& mesh_case, const MeshDestination& destination, Ranks& ranks) {
    require_one_output(mesh_case, "a run of several processes");
    require_shareable(mesh_case.outputs.front(), write_options(mesh_case));
    if (std::any_of(mesh_case.inputs.begin(), mesh_case.inputs.end(), is_standard_stream))
        throw UsageError("INPUT: '-' reaches one of several processes alone: give a file");
    const std::string& output = mesh_case.outputs.front();
    const StartedRun run(mesh_case, destination);
    const bool reports = ranks.rank() == 0;
    ProgressPrinter progress(mesh_case.progress, mesh_case.quiet || !reports);
    std::optional<std::filesystem::path> beside;
    if (mesh_case.stream) beside = output;
    const SharedMesh shared =
        share_mesh(mesh_case.inputs, run.options, ranks, beside, [&](const auto& event) { progress.begin(event); });
    const MeshResult& result = shared.result;
    if (reports) {
        print_warnings(result.warnings);
        require_promised_angles(result.check, mesh_case);
    }

    progress.begin({"writing"});
    Stopwatch watch;
    write_shared_mesh(*shared.parts, {shared.counts, result.mesh.markers, shared.constraints}, ranks, output,
                      write_options(mesh_case));
    const double seconds = watch.lap();
    const RankTraffic traffic = total_traffic(ranks);
    if (!reports) return;
    if (!mesh_case.report.empty()) {
        Json report = mesh_report(mesh_case, result, {shared.counts, shared.hash}, seconds);
        report["ranks"] = {{"processes", ranks.size()}, {"messages", traffic.messages}, {"bytes", traffic.bytes}};
        write_file(mesh_case.report, to_text(report));
    }
    if (!mesh_case.quiet)
        print_summary(mesh_summary(mesh_case, result, shared.counts, seconds) +
                          traffic_line(ranks.size(), traffic, result.inviscid_pieces),
                      run.outputs);
    require_no_warnings(result.warnings, mesh_case.strict);
}

void prefer_quads(MeshCase& mesh_case) {
    if (!is_given(mesh_case, "layer-topology")) mesh_case.options.layer.topology = LayerTopology::quads;
}

void prefer_quads_for_openfoam(MeshCase& mesh_case) {
    if (is_for_openfoam(mesh_case) &&
        std::all_of(mesh_case.outputs.begin(), mesh_case.outputs.end(),
                    [&](const std::string& output) { return holds_quads(output, mesh_case); }))
        prefer_quads(mesh_case);
}

}  // namespace lamina::app
