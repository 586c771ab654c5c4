#include "app/adapt_run.hpp"

#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/page.hpp>
#include <lamina/solution_metric.hpp>
#include <lamina/transfer.hpp>

#include "app/adapt_page.hpp"
#include "app/adapt_records.hpp"
#include "app/case_inputs.hpp"
#include "app/fingerprint.hpp"
#include "app/folder_lock.hpp"
#include "app/mesh_run.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/standard_output.hpp"
#include "app/stopwatch.hpp"

namespace lamina::app {

namespace fs = std::filesystem;

namespace {

/// Gives the cells of a mesh that OpenFOAM has numbered anew the regions that they have in another order. Their shapes
/// do not tell stretched triangles from those of the layer.
void copy_regions(const Mesh& mesh, Mesh& numbered_anew) {
    SolutionField layer{"layer", true, {}};
    for (const Region region : mesh.region) layer.values.push_back(region == Region::layer ? 1 : 0);
    if (mesh.region.empty()) return;
    const std::vector<SolutionField> moved = transfer({mesh, {layer}}, numbered_anew);
    for (const double share : moved.front().values)
        numbered_anew.region.push_back(share > 0.5 ? Region::layer : Region::isotropic);
}

std::string errors_text(const SolutionSizes& sizes, const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t f = 0; f < sizes.errors.size(); ++f)
        text += fmt::format("{}{:.4g} in {}", f == 0 ? "" : ", ", sizes.errors[f], names[f]);
    return text;
}

constexpr const char* row_heads = "round   vertices  iterations          CL          CD  residual\n";

std::string row_of(std::size_t number, const AdaptRound& round, bool kept) {
    const SolvedForces& forces = round.forces;
    return fmt::format("{:5} {:10} {:>11} {:11.6f} {:11.7f} {:>9}{}{}\n", number, round.vertices,
                       optional_text(forces.iterations, "-"), forces.cl, forces.cd,
                       forces.residual ? fmt::format("{:.2f}", *forces.residual) : "-",
                       forces.steady ? "" : "  not steady", kept ? "  done before" : "");
}

/// Makes meshes that have the numbers of vertices asked for.
class AdaptMesher {
public:
    explicit AdaptMesher(const MeshCase& mesh_case)
        : base_(options_with_files(mesh_case)),
          geometry_(read_geometry(mesh_case.inputs, mesh_case.options.geometry)),
          conditions_(reference_conditions(base_.conditions, geometry_)),
          options_(base_) {}

    /// Changes wall spacings and sizes alone, so that the mesh without a solution has so many vertices: its layers keep
    /// their heights. Returns this mesh, unless it was made for so many before.
    std::optional<MeshResult> aim_at(double vertices) {
        if (vertices == aim_) return {};
        ScaledMesh found = mesh_of_count(
            vertices, [&](double ratio) { return generate_mesh(geometry_, at_ratio(ratio)); },
            [](const MeshResult& result) { return static_cast<double>(result.mesh.points.size()); });
        constexpr double acceptable = 0.05;
        if (std::abs(std::log(found.count / vertices)) > acceptable)
            throw OptionError("vertices", fmt::format("cannot be {:.0f}: the nearest mesh of these layers has {:.0f}",
                                                      vertices, found.count));
        options_ = at_ratio(found.scale);
        aim_ = vertices;
        return std::move(found.result);
    }
    /// Returns the viscosity over the speed of the free stream; nothing without a Reynolds number.
    std::optional<double> viscosity() const {
        if (!conditions_.reynolds) return {};
        return conditions_.chord / *conditions_.reynolds;
    }
    /// Returns the growth of sizes that the number of vertices leads to.
    double gradation() const { return options_.sizing.gradation; }
    MeshResult make(const std::shared_ptr<const SizedMesh>& sizes) const {
        CaseOptions options = options_;
        options.sizing.background = sizes;
        return generate_mesh(geometry_, options);
    }

private:
    CaseOptions at_ratio(double ratio) const {
        CaseOptions options = refined(base_, ratio, conditions_);
        options.layer = base_.layer;
        options.far_field = base_.far_field;
        return options;
    }

    CaseOptions base_;
    Geometry geometry_;
    ReferenceConditions conditions_;
    CaseOptions options_;
    double aim_ = 0;
};

/// The rounds of one call: those that are done already, and those that it makes. Fingerprints tell whether a round is
/// of the same options.
class AdaptLoop {
public:
    AdaptLoop(const AdaptSettings& settings, const MeshCase& mesh_case, const AdaptSolver& solver, SignalGuard& guard)
        : settings_(settings), case_(mesh_case), solver_(solver), guard_(guard), digits_(digits_of_rounds()) {}

    void run() {
        const std::vector<AdaptRound> before = rounds_before();
        if (!case_.quiet) print_result(row_heads);
        for (std::size_t i = 0; i < digits_.size() && !has_settled(); ++i) {
            const bool kept = i < before.size();
            rounds_.push_back(kept ? before[i] : make_round(i));
            if (!case_.quiet) print_result(row_of(i, rounds_.back(), kept));
            if (!kept || i + 1 == before.size() || has_settled()) write_overview();
        }
        if (case_.quiet) return;
        print_result(has_settled()
                         ? fmt::format("forces have changed by less than {} % in two rounds: {}\n",
                                       100 * settings_.tolerance, (settings_.folder / "adapt.csv").string())
                         : fmt::format("all rounds are done: {}\n", (settings_.folder / "adapt.csv").string()));
    }
    void tell_plan() const {
        const std::size_t done = rounds_before().size();
        std::string text = fmt::format("would run {} in the folder of each round\n", solver_.command());
        for (std::size_t i = 0; i < digits_.size(); ++i)
            text +=
                fmt::format("  {}: {}{}\n", folder_of(i).string(), vertices_text(i), i < done ? ", done before" : "");
        print_result(text);
    }

private:
    std::string title() const { return fmt::format("{}", fmt::join(case_.inputs, ", ")); }
    double wanted_vertices(std::size_t round) const {
        const std::vector<double>& all = settings_.vertices;
        return all.empty() ? 0 : all[std::min(round, all.size() - 1)];
    }
    std::string vertices_text(std::size_t round) const {
        const double wanted = wanted_vertices(round);
        return wanted > 0 ? fmt::format("{:.0f} vertices", wanted) : "as many vertices as the options make";
    }
    void write_overview() const {
        write_file(settings_.folder / "adapt.csv", rounds_table(rounds_));
        write_file(settings_.folder / "adapt.html", adapt_page(title(), rounds_));
    }
    /// Returns the rounds that are complete already. Throws UsageError where they are not of these options.
    std::vector<AdaptRound> rounds_before() const {
        std::vector<AdaptRound> before;
        for (std::size_t i = 0; i < digits_.size(); ++i) {
            const std::optional<AdaptRound> round = read_round(folder_of(i), digits_[i]);
            if (round && before.size() < i)
                throw UsageError(fmt::format("{}: a round before it is missing: remove it", folder_of(i).string()));
            if (round) before.push_back(*round);
        }
        return before;
    }
    fs::path folder_of(std::size_t round) const { return settings_.folder / fmt::format("round_{}", round); }

    /// Returns for each round the digits of all that it depends on. Rounds may be added later, and the tolerance may
    /// change.
    std::vector<std::string> digits_of_rounds() const {
        std::string text = fingerprint(case_) + settings_.identity;
        for (const std::string& field : settings_.fields) text += "\n" + field;
        text += fmt::format("\n{} {} {}", settings_.sizes.gradation, settings_.sizes.max_change, settings_.sizes.norm);
        if (settings_.max_ratio) text += fmt::format(" {}", *settings_.max_ratio);
        std::vector<std::string> digits;
        for (int i = 0; i < settings_.rounds; ++i) {
            text += fmt::format("\n{}", wanted_vertices(static_cast<std::size_t>(i)));
            digits.push_back(text_of(hashed(no_text, text)));
        }
        return digits;
    }

    bool has_settled() const {
        if (rounds_.size() < 3 || rounds_.size() < settings_.vertices.size()) return false;
        const auto stays = [&](std::size_t i) {
            const SolvedForces &now = rounds_[i].forces, &before = rounds_[i - 1].forces;
            // Where there is hardly any lift, the drag says what a small change is.
            return std::abs(now.cd - before.cd) < settings_.tolerance * std::abs(now.cd) &&
                   std::abs(now.cl - before.cl) < settings_.tolerance * (std::abs(now.cl) + std::abs(now.cd));
        };
        return stays(rounds_.size() - 1) && stays(rounds_.size() - 2);
    }

    void say(const std::string& text) const {
        if (!case_.quiet && case_.progress != ProgressShown::never)
            std::fputs(fmt::format("lamina: {}\n", text).c_str(), stderr);
    }

    /// Makes a round in a folder of another name, which gets the name of the round in the end. What killed processes
    /// have left of the round is removed.
    AdaptRound make_round(std::size_t i) {
        Stopwatch watch;
        const std::string part = folder_of(i).filename().string() + ".part-";
        for (const fs::path& left : entries_of(settings_.folder, part)) fs::remove_all(left);
        const fs::path folder = settings_.folder / (part + std::to_string(::getpid()));
        fs::create_directories(folder);

        if (!mesher_) mesher_.emplace(case_);
        MeshResult result = mesh_of_round(i, folder);
        std::vector<Warning> of_solver = solver_.warnings(result);
        std::move(of_solver.begin(), of_solver.end(), std::back_inserter(result.warnings));
        print_warnings(result.warnings);
        require_promised_angles(result.check, case_);
        write_mesh(result.mesh, folder / "mesh.vtu");
        write_page(result.mesh, folder / "mesh.html", {.title = fmt::format("{}, round {}", title(), i)});
        solver_.write_case(result, case_, folder);
        if (i > 0) solver_.start_from(folder_of(i - 1), rounds_[i - 1].forces, folder);
        require_no_warnings(result.warnings, case_.strict);

        AdaptRound round;
        round.vertices = result.mesh.points.size();
        round.cells = result.mesh.triangles.size() + result.mesh.quads.size();
        say(fmt::format("round {}: {} vertices, solving in {}", i, round.vertices, folder.string()));
        round.forces = solver_.run(folder, guard_);
        round.seconds = watch.lap();
        write_round(folder, round, digits_[i]);
        fs::rename(folder, folder_of(i));
        return round;
    }
    MeshResult mesh_of_round(std::size_t i, const fs::path& folder) {
        std::optional<MeshResult> found;
        if (const double wanted = wanted_vertices(i); wanted > 0) found = mesher_->aim_at(wanted);
        if (i > 0) return adapted_mesh(i, folder);
        return found ? *std::move(found) : mesher_->make(nullptr);
    }
    MeshResult adapted_mesh(std::size_t i, const fs::path& folder) const {
        SolutionSizeOptions options = settings_.sizes;
        options.vertices = wanted_vertices(i) > 0 ? wanted_vertices(i) : static_cast<double>(rounds_.front().vertices);
        // A mesh with few vertices needs sizes that grow fast.
        options.gradation = std::max(options.gradation, mesher_->gradation());
        const std::vector<std::string> fields = options.goal               ? options.goal->fields()
                                                : settings_.fields.empty() ? solver_.usual_fields()
                                                                           : settings_.fields;
        const std::string velocity = solver_.velocity(folder_of(i - 1));
        std::vector<std::string> needed = fields;
        if (mesher_->viscosity() && !velocity.empty()) {
            options.walls = WallFlowOptions{velocity, *mesher_->viscosity()};
            options.keep_borders = false;
            for (const std::string& component : options.walls->components()) needed.push_back(component);
        }
        Solution solution = solver_.read(folder_of(i - 1), needed);
        if (settings_.max_ratio && solution.mesh.region.empty())
            copy_regions(read_mesh(folder_of(i - 1) / "mesh.vtu"), solution.mesh);
        const SolutionSizes made = solution_sizes(solution, options, [&](const SizedMesh& sizes) {
            return mesher_->make(std::make_shared<const SizedMesh>(sizes)).mesh.points.size();
        });
        // The estimate is that of isotropic triangles.
        if (i == 1 || !settings_.max_ratio)
            say(fmt::format("round {}: error of the solution before, estimated beyond the layer: {}", i,
                            errors_text(made, options.goal ? std::vector<std::string>{"the goal"} : fields)));
        write_sizes(made.sizes, folder / "sizes.vtu");
        MeshResult result = mesher_->make(std::make_shared<const SizedMesh>(made.sizes));
        // Walls and layers are those of isotropic sizes, and so is the check of angles.
        if (settings_.max_ratio)
            result.mesh = remesh_to_solution(result.mesh, solution, options, *settings_.max_ratio).mesh;
        assert(check_mesh(result.mesh).valid());
        return result;
    }

    const AdaptSettings& settings_;
    const MeshCase& case_;
    const AdaptSolver& solver_;
    SignalGuard& guard_;
    std::vector<std::string> digits_;
    std::optional<AdaptMesher> mesher_;
    std::vector<AdaptRound> rounds_;
};

}  // namespace

void run_adapt(const AdaptSettings& settings, MeshCase mesh_case, AdaptSolver& solver) {
    require_whole(mesh_case);
    require_straight(mesh_case);
    require_consistent(mesh_case);
    if (mesh_case.options.conditions.alphas)
        throw UsageError("option --alpha: the rounds are of one angle of attack; lamina polar runs a range of them");
    solver.prepare(mesh_case);
    require_inputs(mesh_case);
    solver.require_programs();
    const std::vector<RunFile> outputs{{settings.folder / "adapt.csv", "option --output"}};
    check_folder_writable(missing_folders(outputs.front().path).empty()
                              ? outputs.front().path
                              : missing_folders(outputs.front().path).front());
    SignalGuard guard(outputs);
    if (settings.dry_run) return AdaptLoop(settings, mesh_case, solver, guard).tell_plan();
    create_folders_above(outputs.front().path);
    const FolderLock lock(settings.folder);
    AdaptLoop(settings, mesh_case, solver, guard).run();
}

}  // namespace lamina::app
