#include "app/polar_run.hpp"

#include <unistd.h>

#include <cstdio>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>

#include "app/case_inputs.hpp"
#include "app/fingerprint.hpp"
#include "app/flow_run.hpp"
#include "app/folder_lock.hpp"
#include "app/mesh_run.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"

namespace lamina::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* row_file = "row.json";
constexpr const char* folder_prefix = "alpha_";
constexpr const char* part_prefix = "alpha.part-";
/// Solvers find no part of the drag and no transition, which the format of XFOIL has.
constexpr const char* files_of_solver[] = {"polar.csv", "polar.json"};
constexpr const char* files_of_flow[] = {"polar.csv", "polar.json", "polar.txt"};

void write_polar(const fs::path& folder, std::span<const char* const> files, const FlowPolar& polar) {
    for (const char* name : files) write_file(folder / name, polar_text(name, polar.conditions, polar.rows));
}

/// A row with what a later angle begins from.
struct SolvedAngle {
    PolarRow row;
    SolvedForces forces;
};

Json json_of(const SolvedAngle& angle, const std::string& digits) {
    const SolvedForces& forces = angle.forces;
    Json json{{"fingerprint", digits}, {"CL", forces.cl}, {"CD", forces.cd}, {"steady", forces.steady}};
    if (forces.cm) json["CM"] = *forces.cm;
    if (forces.y_plus) json["y_plus"] = *forces.y_plus;
    return json;
}

SolvedAngle solved_angle(double alpha_deg, const SolvedForces& forces) {
    PolarRow row{.alpha_deg = alpha_deg, .state = forces.steady ? "steady" : "not steady"};
    row.steady = forces.steady;
    row.cl = forces.cl;
    row.cd = forces.cd;
    row.cm = forces.cm;
    row.y_plus = forces.y_plus;
    return {row, forces};
}

/// The angles of one call: those that are solved already, and those that it solves.
class PolarLoop {
public:
    PolarLoop(const PolarSettings& settings, const MeshCase& mesh_case, const AdaptSolver& solver, SignalGuard& guard)
        : settings_(settings),
          case_(mesh_case),
          solver_(solver),
          guard_(guard),
          digits_(fingerprint(mesh_case) + settings.identity),
          geometry_(read_geometry(mesh_case.inputs, mesh_case.options.geometry)),
          angles_(values_of(*mesh_case.options.conditions.alphas)) {}

    FlowPolar run() {
        const std::vector<std::optional<SolvedAngle>> before = angles_before();
        // What killed processes have left.
        for (const fs::path& left : entries_of(settings_.folder, part_prefix)) fs::remove_all(left);
        FlowPolar polar{conditions(), {}};
        for (std::size_t i = 0; i < angles_.size(); ++i) {
            const SolvedAngle angle = before[i] ? *before[i] : solve(angles_[i]);
            if (angle.row.steady) last_steady_ = {folder_of(angles_[i]), angle.forces};
            polar.rows.push_back(angle.row);
            write_polar(settings_.folder, files_of_solver, polar);
        }
        return polar;
    }

private:
    PolarConditions conditions() const {
        const Geometry bodies = in_row(geometry_, case_.options);
        return polar_conditions(bodies, reference_conditions(case_.options.conditions, bodies));
    }
    fs::path folder_of(double alpha) const { return settings_.folder / fmt::format("{}{}", folder_prefix, alpha); }

    /// Returns the digits of all that an angle depends on. One mesh serves all, so that it is the range as a whole,
    /// too.
    std::string digits_of(double alpha) const {
        return text_of(hashed(no_text, fmt::format("{}\n{}", digits_, alpha)));
    }

    /// Returns the angles that are complete already. Throws UsageError where one is not of these options.
    std::vector<std::optional<SolvedAngle>> angles_before() const {
        std::vector<std::optional<SolvedAngle>> before;
        for (const double alpha : angles_) {
            SolvedForces forces;
            const bool exists =
                read_record(folder_of(alpha) / row_file, "angle", digits_of(alpha), [&](const Json& json) {
                    forces.cl = json.at("CL");
                    forces.cd = json.at("CD");
                    forces.steady = json.at("steady");
                    if (json.contains("CM")) forces.cm = json.at("CM");
                    if (json.contains("y_plus")) forces.y_plus = json.at("y_plus");
                });
            before.push_back(exists ? std::optional(solved_angle(alpha, forces)) : std::nullopt);
        }
        return before;
    }

    void say(const std::string& text) const {
        if (!case_.quiet) std::fputs(fmt::format("lamina: {}\n", text).c_str(), stderr);
    }

    /// Solves at an angle in a folder of another name, which gets the name of the angle in the end, with ".failed"
    /// where the solver fails.
    SolvedAngle solve(double alpha) {
        if (!mesh_) make_mesh();
        const fs::path folder = settings_.folder / fmt::format("{}{}", part_prefix, ::getpid()),
                       failed = folder_of(alpha).string() + ".failed";
        fs::remove_all(failed);
        write_case(alpha, folder);
        say(fmt::format("{} degrees, in {}", alpha, folder.string()));
        SolvedForces forces;
        try {
            forces = solver_.run(folder, guard_);
        } catch (const IoError& error) {
            fs::rename(folder, failed);
            PolarRow row{.alpha_deg = alpha, .state = "failed"};
            row.steady = false;
            row.note = moved(error.what(), folder, failed);
            return {row, {}};
        }
        SolvedAngle angle = solved_angle(alpha, forces);
        write_file(folder / row_file, to_text(json_of(angle, digits_of(alpha))));
        fs::rename(folder, folder_of(alpha));
        return angle;
    }

    /// Returns a text with the new name of a folder in place of its former one.
    static std::string moved(std::string text, const fs::path& from, const fs::path& to) {
        if (const std::size_t at = text.find(from.string()); at != std::string::npos)
            text.replace(at, from.string().size(), to.string());
        return text;
    }

    /// Writes the case of an angle, which begins with the flow of the last steady one, or from rest where that cannot
    /// be read.
    void write_case(double alpha, const fs::path& folder) {
        MeshCase of_angle = case_;
        of_angle.options.conditions.alpha_deg = alpha;
        of_angle.options.conditions.alphas.reset();
        mesh_->conditions.alpha_deg = alpha;
        const auto write = [&] {
            fs::remove_all(folder);
            fs::create_directories(folder);
            write_mesh(mesh_->mesh, folder / "mesh.vtu");
            solver_.write_case(*mesh_, of_angle, folder);
        };
        write();
        if (!last_steady_) return;
        try {
            solver_.start_from(last_steady_->first, last_steady_->second, folder);
        } catch (const Error& error) {
            say(fmt::format("{} degrees begin from rest: {}", alpha, error.what()));
            write();
        }
    }

    void make_mesh() {
        mesh_ = generate_mesh(geometry_, options_with_files(case_));
        const std::vector<Warning> of_solver = solver_.warnings(*mesh_);
        mesh_->warnings.insert(mesh_->warnings.end(), of_solver.begin(), of_solver.end());
        print_warnings(mesh_->warnings);
        require_promised_angles(mesh_->check, case_);
        require_no_warnings(mesh_->warnings, case_.strict);
    }

    const PolarSettings& settings_;
    const MeshCase& case_;
    const AdaptSolver& solver_;
    SignalGuard& guard_;
    std::string digits_;
    Geometry geometry_;
    std::vector<double> angles_;
    std::optional<std::pair<fs::path, SolvedForces>> last_steady_;
    std::optional<MeshResult> mesh_;
};

/// Creates the folder, in which the files of the polar can be written then.
std::vector<RunFile> prepare_folder(const fs::path& folder, std::span<const char* const> names) {
    std::vector<RunFile> files;
    for (const char* name : names) files.push_back({folder / name, "option --output"});
    create_folders_above(files.front().path);
    check_folder_writable(files.front().path);
    return files;
}

}  // namespace

FlowPolar run_polar_of_flow(const PolarSettings& settings, const MeshCase& mesh_case,
                            const TransitionOptions& transition) {
    require_consistent(mesh_case);
    require_inputs(mesh_case);
    const SignalGuard guard(prepare_folder(settings.folder, files_of_flow));
    const FolderLock lock(settings.folder);
    if (!entries_of(settings.folder, folder_prefix).empty())
        throw UsageError(settings.folder.string() + ": holds the polar of a solver: give another folder");
    const CaseOptions& options = mesh_case.options;
    const Geometry geometry = read_geometry(mesh_case.inputs, options.geometry);
    FlowPolar polar = flow_polar(geometry, options, transition);
    write_polar(settings.folder, files_of_flow, polar);
    return polar;
}

FlowPolar run_polar_of_solver(const PolarSettings& settings, MeshCase mesh_case, AdaptSolver& solver) {
    require_whole(mesh_case);
    require_straight(mesh_case);
    require_consistent(mesh_case);
    // What the solver prefers does not depend on the angle, and it knows no ranges.
    const std::optional<ValueRange> alphas = std::exchange(mesh_case.options.conditions.alphas, {});
    solver.prepare(mesh_case);
    mesh_case.options.conditions.alphas = alphas;
    require_inputs(mesh_case);
    solver.require_programs();
    SignalGuard guard(prepare_folder(settings.folder, files_of_solver));
    const FolderLock lock(settings.folder);
    return PolarLoop(settings, mesh_case, solver, guard).run();
}

}  // namespace lamina::app
