#include "app/morph_sequence.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
#include <lamina/solver_case.hpp>

#include "app/summary.hpp"

namespace lamina::app {

namespace {

constexpr std::string_view step_mark = "{step}";
constexpr double latest = 1e100;  // time, as that of a duration
constexpr const char *foam_format = "openfoam", *su2_format = "su2";

Json morph_quality(const MorphQuality& quality) {
    return {{"min_angle", quality.min_angle_deg},
            {"mean_min_angle", quality.mean_min_angle_deg},
            {"min_scaled_jacobian", quality.min_scaled_jacobian}};
}

/// Returns the names of the files of all steps, whose numbers have as many digits as the last one.
std::vector<std::string> files_of_steps(const std::string& pattern, std::size_t n) {
    const std::size_t digits = std::to_string(n - 1).size();
    std::vector<std::string> files;
    for (std::size_t i = 0; i < n; ++i) {
        std::string file = pattern;
        const std::string number = fmt::format("{:0{}}", i, digits);
        for (std::size_t at = 0; (at = file.find(step_mark, at)) != std::string::npos; at += number.size())
            file.replace(at, step_mark.size(), number);
        files.push_back(std::move(file));
    }
    return files;
}

std::vector<double> times_up_to(double end, int steps) {
    std::vector<double> times;
    for (int i = 0; i <= steps; ++i) times.push_back(end * i / steps);
    return times;
}

/// Adds the folder of a solver's case.
void plan_case(MorphSequence& sequence, const std::string& output) {
    std::string& format = sequence.options.format;
    const bool is_folder = !std::filesystem::path(output).has_extension();
    if (format.empty() && is_folder) format = foam_format;
    std::vector<std::filesystem::path> files;
    if (format == su2_format && is_folder) {
        if (sequence.turns.size() != 1) throw UsageError("option --sequence: a case of SU2 has one turn");
        files = pitching_case_outputs(output);
    } else if (format_name(output, sequence.options) == foam_format) {
        check_writable(output, sequence.options);
        files = moving_case_outputs(output, sequence.times);
    } else {
        throw UsageError(
            "option --output: a sequence needs {step} in the name of its files, or a folder for OpenFOAM or, with "
            "--format su2, for SU2");
    }
    sequence.folder = output;
    for (const std::filesystem::path& file : files) sequence.outputs.push_back({file, "option --output"});
}

/// Writes a case of SU2, which turns the reference mesh as a whole: its cells are the same at all times.
Json write_pitching(const MorphMap& map, const MorphSequence& sequence) {
    const Mesh& reference = map.reference();
    write_pitching_case(reference, sequence.turns.front(), sequence.times.back(),
                        static_cast<int>(sequence.times.size() - 1), sequence.folder);
    const Json quality = morph_json({}, compare_morphed(map, reference));
    Json reports = Json::array();
    for (const double time : sequence.times) {
        reports.push_back({{"time", time}});
        reports.back().update(quality);
    }
    return reports;
}

/// Moves the mesh to a time.
MorphResult morph_to(const MorphMap& map, std::span<const TurnInTime> turns, double time, const MorphOptions& options) {
    std::vector<Transformation> changes;
    for (const TurnInTime& turn : turns) changes.push_back(turn_at(turn, time));
    try {
        return morph(map, moved_wall_points(map, changes), options);
    } catch (const OptionError& error) {
        throw UsageError("option --sequence: " + error.reason());
    } catch (const MeshError& error) {
        throw MeshError(fmt::format("at time {:.6g}: {}", time, error.what()), error.at());
    }
}

}  // namespace

Json morph_json(const MorphResult& result, const MorphReport& report) {
    Json json{
        {"fraction", result.fraction},
        {"maps", result.maps},
        {"max_first_height_change", report.max_first_height_change},
        {"max_first_height_change_at", {report.max_first_height_change_at.x, report.max_first_height_change_at.y}},
        {"before", morph_quality(report.before)},
        {"after", morph_quality(report.after)}};
    if (result.stop)
        json["stopped_by"] = {{"cell", result.stop->description}, {"at", {result.stop->at.x, result.stop->at.y}}};
    return json;
}

MorphSequence plan_sequence(const SequenceArguments& arguments, const std::string& output,
                            const WriteOptions& options) {
    MorphSequence sequence;
    sequence.options = options;
    double longest = 0;
    for (const std::string& text : arguments.turns) {
        try {
            sequence.turns.push_back(parse_turn_in_time(text));
        } catch (const UsageError& error) {
            throw UsageError(fmt::format("option --sequence: {}", error.what()));
        }
        longest = std::max(longest, duration_of(sequence.turns.back()));
    }
    const double end = arguments.until.value_or(longest);
    if (!(end > 0 && end <= latest)) throw UsageError(fmt::format("option --until: must be > 0 and <= {:g}", latest));
    sequence.times = times_up_to(end, arguments.steps);
    if (output.find(step_mark) != std::string::npos) {
        sequence.meshes = files_of_steps(output, sequence.times.size());
        for (const std::string& file : sequence.meshes) {
            check_writable(file, options);
            const std::vector<RunFile> files = files_of_output(file, options);
            sequence.outputs.insert(sequence.outputs.end(), files.begin(), files.end());
        }
        return sequence;
    }
    plan_case(sequence, output);
    return sequence;
}

Json write_sequence(const MorphMap& map, const MorphSequence& sequence, const MorphOptions& options) {
    if (!sequence.folder.empty() && sequence.options.format == su2_format) return write_pitching(map, sequence);
    // All times are found before the first one is written: a motion that ends on the way leaves no files.
    std::vector<MorphResult> results;
    for (const double time : sequence.times) results.push_back(morph_to(map, sequence.turns, time, options));
    const Mesh& reference = map.reference();
    if (!sequence.folder.empty()) write_moving_case(reference, sequence.times, sequence.folder);
    Json reports = Json::array();
    for (std::size_t i = 0; i < results.size(); ++i) {
        const double time = sequence.times[i];
        const std::vector<Point>& points = results[i].points;
        Json report{{"time", time}};
        report.update(morph_json(results[i], compare_morphed(map, points)));
        reports.push_back(std::move(report));
        if (!sequence.folder.empty()) {
            add_moved_points(reference, points, time, sequence.folder);
            continue;
        }
        MeshView morphed = reference;
        morphed.points = points;
        write_mesh(morphed, sequence.meshes[i], sequence.options);
    }
    return reports;
}

std::string sequence_summary(const std::string& mesh, const Json& report, const std::string& output) {
    double height = 0, angle = 180, fraction = 1;
    for (const Json& step : report) {
        height = std::max(height, step["max_first_height_change"].get<double>());
        angle = std::min(angle, step["after"]["min_angle"].get<double>());
        fraction = std::min(fraction, step["fraction"].get<double>());
    }
    std::string text =
        fmt::format("{} moved to {} times, up to {:.6g}\n", mesh, report.size(), report.back()["time"].get<double>());
    if (fraction < 1) text += summary_line("motion", fmt::format("{:.3g} % of it at least", 100 * fraction));
    text += summary_line("heights", fmt::format("of first cells change by at most {:.2g} %", 100 * height));
    text += summary_line("angles", fmt::format("smallest {:.4g}", angle));
    return text + summary_line("wrote", output);
}

}  // namespace lamina::app
