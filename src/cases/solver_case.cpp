// Cases of flow solvers: which files there are, and what they say.
#include <lamina/solver_case.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "cases/case_files.hpp"
#include "cases/templates.hpp"
#include "cases/words.hpp"
#include "core/atomic_file.hpp"
#include "core/reproducible_math.hpp"
#include "flow/boundary_layer.hpp"
#include "mesh/periodic.hpp"

namespace lamina::cases {

namespace fs = std::filesystem;

namespace {

/// What the solvers differ in.
struct SolverEntry {
    FlowSolver solver;
    const char* program;  ///< that solves
    const char* name;     ///< on the command line, and of the folder of its templates
    const char* format;   ///< of its mesh (io.hpp)
    const char* mesh;     ///< name of the mesh within the case; empty: the case is the name
    double far_field;     ///< far_field_for()
    bool marches;         ///< whether steady flow, too, is found in time
    Words (*words)(const CaseFlow&);
};

constexpr std::array solver_entries{
    SolverEntry{FlowSolver::openfoam, "simpleFoam", "openfoam", "openfoam", "", 100, false, openfoam_words},
    SolverEntry{FlowSolver::su2, "SU2_CFD", "su2", "su2", "mesh.su2", 5000, false, su2_words},
    SolverEntry{FlowSolver::pyfr, "PyFR", "pyfr", "msh22", "mesh.msh", 100, true, pyfr_words},
};

const SolverEntry& entry_of(FlowSolver solver) {
    return *std::find_if(solver_entries.begin(), solver_entries.end(),
                         [&](const SolverEntry& entry) { return entry.solver == solver; });
}

fs::path mesh_file(const SolverEntry& entry, const fs::path& folder) {
    return *entry.mesh == '\0' ? folder : folder / entry.mesh;
}

TurbulenceModel turbulence_of(const SolverCaseOptions& options, bool is_laminar) {
    return options.turbulence.value_or(is_laminar ? TurbulenceModel::laminar : TurbulenceModel::spalart_allmaras);
}

/// Files of cases in time have this behind their name where steady cases have another one of that name.
constexpr std::string_view in_time = ".unsteady";

/// Returns whether a file is one of cases in time, or of steady ones, as it is asked for.
bool suits_time(std::string_view name, bool unsteady) {
    constexpr std::array alone_in_time{"system/march", "system/setFieldsDict", "unsteady.awk"};
    constexpr std::array alone_steady{"Allrun",
                                      "settled.awk",
                                      "summary.awk",
                                      "system/fvSolution",
                                      "system/medium",
                                      "system/medium.first",
                                      "system/medium.incompressible"};
    const auto among = [&](const auto& names) { return std::find(names.begin(), names.end(), name) != names.end(); };
    if (name.ends_with(in_time) || among(alone_in_time)) return unsteady;
    return !unsteady || !among(alone_steady);
}

/// Returns the name that a template's file has in the case.
fs::path name_in_case(const Template& file) {
    std::string_view name = file.name;
    if (name.ends_with(in_time)) name.remove_suffix(in_time.size());
    return name;
}

/// Returns whether the solver's case has this file: fields of other turbulence models are left out, and without
/// compressibility what describes a gas.
bool belongs_to_case(const Template& file, const SolverEntry& entry, TurbulenceModel turbulence,
                     const SolverCaseOptions& options) {
    const std::string_view name = file.name;
    if ((file.solver != entry.name && file.solver != "common") || !suits_time(name, options.unsteady || entry.marches))
        return false;
    constexpr std::array of_gas{"0/T",
                                "0/alphat",
                                "constant/thermophysicalProperties",
                                "system/compress.awk",
                                "system/fvOptions.gas",
                                "system/medium.compressible"};
    if (std::find(of_gas.begin(), of_gas.end(), name) != of_gas.end()) return options.compressible;
    constexpr std::array of_adjoint{"Alladjoint", "adjoint/Ua", "adjoint/pa", "constant/adjointRASProperties",
                                    "system/optimisationDict"};
    if (std::find(of_adjoint.begin(), of_adjoint.end(), name) != of_adjoint.end()) return options.adjoint.has_value();
    if (name == "adjoint/nuaTilda") return options.adjoint && turbulence == TurbulenceModel::spalart_allmaras;
    if (name == "0/nut") return turbulence != TurbulenceModel::laminar;
    if (name == "0/nuTilda") return turbulence == TurbulenceModel::spalart_allmaras;
    if (name == "0/k" || name == "0/omega") return turbulence == TurbulenceModel::k_omega_sst;
    return true;
}

std::vector<std::string> names_of_markers(const Mesh& mesh, MarkerKind kind) {
    std::vector<std::string> names;
    for (const Marker& marker : mesh.markers)
        if (marker.kind == kind) names.push_back(marker.name);
    return names;
}

/// Returns the number of triangles of the mesh's layer where most of its cells are triangles, else 0.
std::ptrdiff_t thin_triangles(const Mesh& mesh) {
    if (mesh.region.empty()) return 0;
    const auto triangles_end = mesh.region.begin() + static_cast<std::ptrdiff_t>(mesh.triangles.size());
    const auto triangles = std::count(mesh.region.begin(), triangles_end, Region::layer);
    return triangles > std::count(triangles_end, mesh.region.end(), Region::layer) ? triangles : 0;
}

bool is_one_of(const std::string& name, const std::vector<std::string>& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the foremost vertex of these walls, the lowest of several.
Point foremost_wall_vertex(const Mesh& mesh, const std::vector<std::string>& walls) {
    Point foremost{HUGE_VAL, HUGE_VAL};
    for (const Marker& marker : mesh.markers) {
        if (!is_one_of(marker.name, walls)) continue;
        for (const Segment& edge : marker.edges) {
            const Point p = mesh.points[edge.a.index()];
            if (std::pair(p.x, p.y) < std::pair(foremost.x, foremost.y)) foremost = p;
        }
    }
    return foremost;
}

/// Returns the area of the largest circle of these walls about y = 0.
double largest_circle(const Mesh& mesh, const std::vector<std::string>& walls) {
    double radius = 0;
    for (const Marker& marker : mesh.markers) {
        if (!is_one_of(marker.name, walls)) continue;
        for (const Segment& edge : marker.edges) radius = std::max(radius, mesh.points[edge.a.index()].y);
    }
    return core::pi * radius * radius;
}

/// Returns the direction in which the rear of the rearmost wall points, in degrees: from the middle of its vertices
/// about a tenth of the chord ahead of its rearmost vertex. Throws MeshError where no wall has edges.
double exit_angle(const Mesh& mesh, const std::vector<std::string>& walls, double chord) {
    constexpr double nearest = 0.05, farthest = 0.15;  // in chords
    Point rear{-HUGE_VAL, 0};
    const Marker* rearmost = nullptr;
    for (const Marker& marker : mesh.markers) {
        if (!is_one_of(marker.name, walls)) continue;
        for (const Segment& edge : marker.edges)
            if (const Point p = mesh.points[edge.a.index()]; p.x > rear.x) {
                rear = p;
                rearmost = &marker;
            }
    }
    if (rearmost == nullptr) throw MeshError("a case of a row of blades needs a mesh with a wall that has edges");
    Point sum{};
    double count = 0;
    for (const Segment& edge : rearmost->edges) {
        const Point p = mesh.points[edge.a.index()];
        const double share = distance(p, rear) / chord;
        if (share < nearest || share > farthest) continue;
        sum = sum + p;
        ++count;
    }
    const Point along = count > 0 ? rear - (1 / count) * sum : Point{1, 0};
    return along.x > 0 ? core::atan2_reproducible(along.y, along.x) * 180 / core::pi : 0;
}

/// Returns the row of blades that a mesh with periodic borders is a part of. Throws MeshError where the mesh has no
/// inlet and outlet.
std::optional<BladeRow> row_of(const Mesh& mesh, const CaseFlow& flow) {
    const auto [pair, mismatch] = mesh::find_periodic_pair(mesh.points, mesh.markers);
    if (mismatch) throw MeshError(mismatch->reason, mismatch->at);
    if (!pair) return std::nullopt;
    if (!is_one_of(inlet_name, flow.far_fields) || !is_one_of(outlet_name, flow.far_fields) ||
        flow.far_fields.size() != 2)
        throw MeshError("a case of a row of blades needs a mesh with markers inlet and outlet");
    return BladeRow{mesh.markers[pair->first].name, mesh.markers[pair->second].name, pair->translation,
                    exit_angle(mesh, flow.walls, flow.chord)};
}

/// Returns the steps of a case in time: in one of them the stream crosses no more than one edge as long as the shortest
/// quarter of the triangles outside the layer has them, each by its shortest edge. These are the triangles of the wake.
TimeSteps steps_in_time(const Mesh& mesh, const CaseFlow& flow) {
    constexpr double courant_number = 1, quarter = 0.25;
    std::vector<double> edges;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (!mesh.region.empty() && mesh.region[i] == Region::layer) continue;
        const auto& v = mesh.triangles[i].v;
        const Point a = mesh.points[v[0].index()], b = mesh.points[v[1].index()], c = mesh.points[v[2].index()];
        edges.push_back(std::min({distance(a, b), distance(b, c), distance(c, a)}));
    }
    if (edges.empty()) throw MeshError("a case in time needs a mesh with triangles outside the layer");
    const auto at = edges.begin() + static_cast<std::ptrdiff_t>(quarter * static_cast<double>(edges.size()));
    std::nth_element(edges.begin(), at, edges.end());
    // Shedding grows slowly in laminar flow.
    constexpr int laminar_times = 100, times = 20;
    return {.per_time = static_cast<int>(std::ceil(flow.chord / (courant_number * *at))),
            .times = flow.turbulence == TurbulenceModel::laminar ? laminar_times : times};
}

/// Returns the least height that a cell has over its longest edge, as if it were straight.
double least_height(const Mesh& mesh) {
    double least = HUGE_VAL;
    const auto include = [&](const auto& corners) {
        const std::size_t n = std::size(corners);
        double twice_area = 0, longest = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const Point a = mesh.points[corners[i].index()], b = mesh.points[corners[(i + 1) % n].index()];
            twice_area += cross(a - mesh.points[corners[0].index()], b - a);
            longest = std::max(longest, distance(a, b));
        }
        least = std::min(least, (n == 3 ? twice_area : twice_area / 2) / longest);
    };
    for (const Triangle& triangle : mesh.triangles) include(triangle.v);
    for (const Quad& quad : mesh.quads) include(quad.v);
    return least;
}

CaseFlow case_flow(FlowSolver solver, const Mesh& mesh, const SolverConditions& conditions,
                   const SolverCaseOptions& options, unsigned order) {
    const auto& [chord, alpha_deg, reynolds, mach] = conditions.reference;
    if (!reynolds) throw OptionError("reynolds", "a case needs it, or velocity and viscosity");
    validate(solver, options, mach);
    CaseFlow flow;
    flow.chord = chord;
    flow.alpha_deg = alpha_deg;
    flow.reynolds = *reynolds;
    flow.mach = mach.value_or(default_case_mach);
    flow.compressible = options.compressible;
    flow.velocity = conditions.velocity.value_or(1);
    flow.viscosity = flow.velocity * chord / *reynolds;
    const double alpha = core::radians(alpha_deg);
    flow.direction = {core::cos_reproducible(alpha), core::sin_reproducible(alpha)};
    flow.wall_functions = conditions.wall_functions;
    flow.adjoint = options.adjoint;
    flow.turbulence = turbulence_of(options, solver == FlowSolver::pyfr || flow::is_laminar(conditions.reference));
    flow.order = order;
    flow.least_height = least_height(mesh);
    flow.has_internal_lines = !names_of_markers(mesh, MarkerKind::internal).empty();
    flow.walls = names_of_markers(mesh, MarkerKind::wall);
    flow.far_fields = names_of_markers(mesh, MarkerKind::far_field);
    flow.symmetries = names_of_markers(mesh, MarkerKind::symmetry);
    flow.outer_walls = conditions.outer_walls;
    flow.moving_walls = conditions.moving_walls;
    flow.axisymmetric = conditions.axisymmetric;
    flow.area = chord;
    std::erase_if(flow.walls, [&](const std::string& name) { return is_one_of(name, flow.outer_walls); });
    if (flow.walls.empty()) throw MeshError("a case needs a mesh with a marker that is a wall");
    if (flow.far_fields.empty()) throw MeshError("a case needs a mesh with a marker that is a far field");
    flow.row = row_of(mesh, flow);
    if (flow.row && flow.compressible && flow.mach >= 1)
        throw OptionError("mach", "must be below 1 at a row of blades");
    if (flow.adjoint && (flow.axisymmetric || flow.row))
        throw OptionError("adjoint", "is that of a flow in a plane, within a far field");
    if (flow.axisymmetric) flow.area = largest_circle(mesh, flow.walls);
    if (options.unsteady) flow.time = steps_in_time(mesh, flow);
    flow.moment_point =
        conditions.moment_point.value_or(foremost_wall_vertex(mesh, flow.walls) + Point{0.25 * chord, 0});
    return flow;
}

/// Returns the words for the flow, and for what Allrun does in time, which solvers have in common.
Words words_of_run(const CaseFlow& flow) {
    const TimeSteps time = flow.time.value_or(TimeSteps{});
    // The moment point is a quarter of the chord behind the nose.
    return {{"TITLE", fmt::format("Reynolds number {}, Mach number {}, angle of attack {} degrees, chord {}",
                                  flow.reynolds, flow.mach, flow.alpha_deg, flow.chord)},
            {"STEPS", fmt::format("{}", time.per_time)},
            {"TIMES", fmt::format("{}", time.times)},
            {"MIDDLE_X", fmt::format("{}", flow.moment_point.x + flow.chord / 4)},
            {"MIDDLE_Y", fmt::format("{}", flow.moment_point.y)}};
}

/// Writes the mesh of a case. PyFR reads one region of cells alone.
void write_case_mesh(const SolverEntry& entry, const Mesh& mesh, const CurvedNodes& nodes, const fs::path& folder) {
    MeshView view = mesh;
    if (entry.solver == FlowSolver::pyfr) view.region = {};
    if (nodes.order > 1)
        write_curved_mesh(view, nodes, mesh_file(entry, folder), {.format = entry.format});
    else
        write_mesh(view, mesh_file(entry, folder), {.format = entry.format});
}

}  // namespace

void write_case_file(const SolverCaseFile& file, const fs::path& folder) {
    const fs::path path = folder / file.name;
    write_file(path, file.text);
    if (!file.executable) return;
    std::error_code failed;
    const auto all = fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec;
    fs::permissions(path, all, fs::perm_options::add, failed);
    if (failed) throw IoError(path.string(), "cannot be made executable: " + failed.message());
}

std::vector<SolverCaseFile> solver_case_files(FlowSolver solver, const Mesh& mesh, const SolverConditions& conditions,
                                              const SolverCaseOptions& options, unsigned order) {
    if (solver == FlowSolver::su2 && thin_triangles(mesh) > 0)
        throw UsageError(
            "a case of SU2 needs quadrilaterals in the layer, since SU2 finds wrong forces on triangles: "
            "--layer-topology quads, with thinner or fewer layers where rows would cross");
    const SolverEntry& entry = entry_of(solver);
    const CaseFlow flow = case_flow(solver, mesh, conditions, options, order);
    Words words = entry.words(flow);
    words.merge(words_of_run(flow));
    std::vector<SolverCaseFile> files;
    for (const Template& file : templates())
        if (belongs_to_case(file, entry, flow.turbulence, options))
            files.push_back({name_in_case(file), fill_in(file.text, words), file.text.starts_with("#!")});
    return files;
}

}  // namespace lamina::cases

namespace lamina {

using namespace cases;

const std::vector<std::pair<std::string, FlowSolver>>& flow_solvers() {
    static const std::vector<std::pair<std::string, FlowSolver>> names = [] {
        std::vector<std::pair<std::string, FlowSolver>> list;
        list.reserve(std::size(solver_entries));
        for (const SolverEntry& entry : solver_entries) list.emplace_back(entry.name, entry.solver);
        return list;
    }();
    return names;
}

void validate(FlowSolver solver, const SolverCaseOptions& options, const std::optional<double>& mach) {
    if (options.adjoint) {
        const char* reason = solver != FlowSolver::openfoam ? "is what cases of OpenFOAM alone find"
                             : options.compressible         ? "is that of an incompressible flow: leave out mach"
                             : options.unsteady             ? "is that of a steady flow"
                                                            : nullptr;
        if (reason != nullptr) throw OptionError("adjoint", reason);
    }
    if (solver == FlowSolver::pyfr && options.turbulence.value_or(TurbulenceModel::laminar) != TurbulenceModel::laminar)
        throw OptionError("turbulence", "a case of PyFR has no model: laminar");
    if (!options.compressible) return;
    if (solver == FlowSolver::openfoam && options.unsteady)
        throw OptionError("unsteady", "a case of OpenFOAM in time is incompressible: leave out mach, or take su2");
    if (!mach) throw OptionError("mach", "a compressible flow needs it");
    if (!(*mach > 0)) throw OptionError("mach", fmt::format("must be above 0 in a case, not {}", *mach));
    if (solver == FlowSolver::pyfr && *mach >= 1)
        throw OptionError("mach",
                          fmt::format("must be below 1 in a case of PyFR, not {}: openfoam and su2 take more", *mach));
}

double far_field_for(FlowSolver solver, double mach) {
    constexpr double supersonic = 30;
    return mach < 1 ? entry_of(solver).far_field : supersonic;
}

std::vector<Warning> find_solver_warnings(FlowSolver solver, const Mesh& mesh, const ReferenceConditions& conditions) {
    if (solver == FlowSolver::pyfr && conditions.reynolds && !flow::is_laminar(conditions))
        return {{.code = WarningCode::unsuited_to_solver,
                 .number = *conditions.reynolds,
                 .unit = "Reynolds number",
                 .message = fmt::format("a plane case of PyFR has no model of turbulence, which flow at a Reynolds "
                                        "number of {:.4g} has: lamina case su2",
                                        *conditions.reynolds)}};
    const std::ptrdiff_t triangles = thin_triangles(mesh);
    if (solver != FlowSolver::openfoam || triangles == 0) return {};
    return {
        {.code = WarningCode::unsuited_to_solver,
         .number = static_cast<double>(triangles),
         .unit = "triangles",
         .message = fmt::format("{} thin triangles make up the layer, on which {} diverges: let --layer-topology be "
                                "quads",
                                triangles, entry_of(solver).program)}};
}

std::vector<fs::path> solver_case_outputs(FlowSolver solver, const fs::path& folder, const SolverCaseOptions& options) {
    const SolverEntry& entry = entry_of(solver);
    std::vector<fs::path> outputs = output_files(mesh_file(entry, folder), {.format = entry.format});
    for (const Template& file : templates())
        if (belongs_to_case(file, entry, turbulence_of(options, false), options))
            outputs.push_back(folder / name_in_case(file));
    return outputs;
}

void check_solver_case_writable(FlowSolver solver, const fs::path& folder, const SolverCaseOptions& options) {
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
        throw IoError(folder.string(), "cannot write: is a file, not a folder");
    const std::vector<fs::path> files = solver_case_outputs(solver, folder, options);
    for (const fs::path& file : files)
        if (!options.overwrite && fs::exists(file, ignored))
            throw UsageError(file.string() + " exists: give another folder, or --overwrite");
    for (const fs::path& file : files) {
        const std::vector<fs::path> missing = missing_folders(file);
        // A mesh that is a folder of files is looked at by its format.
        if (!missing.empty())
            check_folder_writable(missing.front());
        else if (file == files.front())
            check_writable(mesh_file(entry_of(solver), folder), {.format = entry_of(solver).format});
        else
            check_folder_writable(file);
    }
}

void write_solver_case(FlowSolver solver, const Mesh& mesh, const SolverConditions& conditions, const fs::path& folder,
                       const SolverCaseOptions& options, const CurvedNodes& nodes) {
    check_solver_case_writable(solver, folder, options);
    const std::vector<SolverCaseFile> files = solver_case_files(solver, mesh, conditions, options, nodes.order);
    const SolverEntry& entry = entry_of(solver);
    core::NewFolders folders;
    std::vector<fs::path> fresh;  // what a failure must not leave
    std::error_code ignored;
    for (const fs::path& output : solver_case_outputs(solver, folder, options)) {
        if (!fs::exists(output, ignored)) fresh.push_back(output);
        folders.create_above(output);
    }
    try {
        write_case_mesh(entry, mesh, nodes, folder);
        for (const SolverCaseFile& part : files) write_case_file(part, folder);
    } catch (...) {
        for (const fs::path& output : fresh) fs::remove_all(output, ignored);
        throw;
    }
    folders.keep();
}

}  // namespace lamina
