#include "app/polar_run.hpp"

#include <unistd.h>

#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>

#include "app/fingerprint.hpp"
#include "app/folder_lock.hpp"
#include "app/mesh_command_options.hpp"
#include "app/mesh_run.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"

namespace lamina::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* row_file = "row.json";
constexpr const char* polar_files[] = {"polar.csv", "polar.json", "polar.txt"};

void write_polar(const fs::path& folder, const PolarConditions& conditions, std::span<const PolarRow> rows) {
    for (const char* name : polar_files) write_file(folder / name, polar_text(name, conditions, rows));
}

/// A row with what a later angle begins from.
struct SolvedAngle {
    PolarRow row;
    SolvedForces forces;
};

Json json_of(const SolvedAngle& angle, const std::string& digits) {
    return {{"fingerprint", digits}, {"CL", angle.forces.cl}, {"CD", angle.forces.cd}, {"steady", angle.forces.steady}};
}

SolvedAngle solved_angle(double alpha_deg, const SolvedForces& forces) {
    PolarRow row{.alpha_deg = alpha_deg, .state = forces.steady ? "steady" : "not steady"};
    row.steady = forces.steady;
    row.cl = forces.cl;
    row.cd = forces.cd;
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
          angles_(values_of(*mesh_case.options.conditions.alphas)) {}

    std::vector<PolarRow> run() {
        std::vector<PolarRow> rows;
        std::optional<std::pair<fs::path, SolvedForces>> last_steady;
        for (const double alpha : angles_) {
            const fs::path folder = folder_of(alpha);
            std::optional<SolvedAngle> angle = read_angle(folder, alpha);
            if (!angle) angle = solve(alpha, last_steady);
            if (angle->row.steady) last_steady.emplace(folder, angle->forces);
            rows.push_back(angle->row);
            write_polar(settings_.folder, conditions(), rows);
        }
        return rows;
    }
    PolarConditions conditions() const {
        return {fmt::format("{}", fmt::join(case_.inputs, " ")), case_.options.conditions.reynolds,
                case_.options.conditions.mach};
    }

private:
    fs::path folder_of(double alpha) const { return settings_.folder / fmt::format("alpha_{}", alpha); }

    /// Returns the digits of all that an angle depends on. One mesh serves all, so that it is the range as a whole, too.
    std::string digits_of(double alpha) const {
        return text_of(hashed(no_text, fmt::format("{}{}\n{}", fingerprint(case_), settings_.identity, alpha)));
    }

    std::optional<SolvedAngle> read_angle(const fs::path& folder, double alpha) const {
        std::error_code ignored;
        if (!fs::exists(folder, ignored)) return {};
        const auto refuse = [&](const char* reason) {
            throw UsageError(fmt::format("{}: {}: give another folder, or remove it", folder.string(), reason));
        };
        if (!fs::exists(folder / row_file, ignored)) refuse("exists, and is no angle of this command");
        const Json json = Json::parse(read_file(folder / row_file), nullptr, false);
        SolvedForces forces;
        try {
            if (json.at("fingerprint") != digits_of(alpha)) refuse("was made with other options or inputs");
            forces.cl = json.at("CL");
            forces.cd = json.at("CD");
            forces.steady = json.at("steady");
        } catch (const Json::exception&) {
            throw InputError({(folder / row_file).string(), 0, {}}, "is no record of an angle");
        }
        return solved_angle(alpha, forces);
    }

    /// Solves at an angle in a folder of another name, which gets the name of the angle in the end.
    SolvedAngle solve(double alpha, const std::optional<std::pair<fs::path, SolvedForces>>& last_steady) {
        if (!mesh_) make_mesh();
        const fs::path folder = settings_.folder / fmt::format("alpha.part-{}", ::getpid());
        fs::remove_all(folder);
        fs::create_directories(folder);
        MeshCase of_angle = case_;
        of_angle.options.conditions.alpha_deg = alpha;
        of_angle.options.conditions.alphas.reset();
        mesh_->conditions.alpha_deg = alpha;
        write_mesh(mesh_->mesh, folder / "mesh.vtu");
        solver_.write_case(*mesh_, of_angle, folder);
        if (last_steady) solver_.start_from(last_steady->first, last_steady->second, folder);
        if (!case_.quiet)
            std::fputs(fmt::format("lamina: {} degrees, in {}\n", alpha, folder.string()).c_str(), stderr);
        try {
            const SolvedAngle angle = solved_angle(alpha, solver_.run(folder, guard_));
            write_file(folder / row_file, to_text(json_of(angle, digits_of(alpha))));
            fs::rename(folder, folder_of(alpha));
            return angle;
        } catch (const IoError& error) {
            PolarRow row{.alpha_deg = alpha, .state = "failed"};
            row.steady = false;
            row.note = error.what();
            return {row, {}};
        }
    }

    void make_mesh() {
        mesh_ = generate_mesh(case_.inputs, options_with_files(case_));
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
    std::vector<double> angles_;
    std::optional<MeshResult> mesh_;
};

/// Creates the folder, in which the files of the polar can be written then.
std::vector<RunFile> prepare_folder(const fs::path& folder) {
    std::vector<RunFile> files;
    for (const char* name : polar_files) files.push_back({folder / name, "option --output"});
    create_folders_above(files.front().path);
    check_folder_writable(files.front().path);
    return files;
}

}  // namespace

std::vector<PolarRow> run_polar_of_flow(const PolarSettings& settings, const MeshCase& mesh_case) {
    require_consistent(mesh_case);
    require_inputs(mesh_case);
    const SignalGuard guard(prepare_folder(settings.folder));
    const CaseOptions& options = mesh_case.options;
    const Geometry geometry = read_geometry(mesh_case.inputs, options.geometry);
    const FlowPolar polar = flow_polar(geometry, options);
    write_polar(settings.folder, polar.conditions, polar.rows);
    return polar.rows;
}

std::vector<PolarRow> run_polar_of_solver(const PolarSettings& settings, MeshCase mesh_case, AdaptSolver& solver) {
    require_whole(mesh_case);
    require_consistent(mesh_case);
    // What the solver prefers does not depend on the angle, and it knows no ranges.
    const std::optional<ValueRange> alphas = std::exchange(mesh_case.options.conditions.alphas, {});
    solver.prepare(mesh_case);
    mesh_case.options.conditions.alphas = alphas;
    require_inputs(mesh_case);
    solver.require_programs();
    SignalGuard guard(prepare_folder(settings.folder));
    const FolderLock lock(settings.folder);
    return PolarLoop(settings, mesh_case, solver, guard).run();
}

}  // namespace lamina::app
