#include "flow/euler/euler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "flow/euler/block_system.hpp"
#include "flow/euler/displacement.hpp"
#include "flow/euler/dual_mesh.hpp"
#include "flow/euler/residual.hpp"

namespace lamina::flow::euler {

namespace {

/// Returns the dual mesh in units of the chord.
DualMesh dual_of(const EulerMesh& mesh, double chord) {
    std::vector<Point> points(mesh.points.begin(), mesh.points.end());
    for (Point& p : points) p = (1 / chord) * p;
    const VertexId first = mesh.walls.empty() ? VertexId(0) : mesh.walls[0].outline[0];
    DualMesh dual = make_dual_mesh(points, mesh.triangles, first);
    if (dual.points.empty()) throw MeshError("a vertex is not connected with the others");
    for (const EulerWall& wall : mesh.walls)
        for (std::size_t k = 0; k < wall.outline.size(); ++k) {
            const VertexId a = wall.outline[k], b = wall.outline[(k + 1) % wall.outline.size()];
            add_boundary_edge(dual, {b, a}, k < wall.sides_end ? BoundaryKind::wall : BoundaryKind::base);
        }
    for (const Segment& edge : mesh.far_field) add_boundary_edge(dual, edge, BoundaryKind::far);
    return dual;
}

/// Returns the quarter point of the box round the walls, in which the vortex of the lift sits.
Point vortex_of(const DualMesh& mesh) {
    Box box;
    for (const BoundaryEdge& e : mesh.boundary)
        if (e.kind != BoundaryKind::far) box.include(mesh.points[e.a]);
    return {box.lower.x + 0.25 * box.width(), box.center().y};
}

/// A flow on its way to the steady one.
struct Iteration {
    DualMesh mesh;
    FarFlow far;
    std::vector<Four> states, conserved;
    double lift = 0, drag = 0;
    std::vector<Four> sums{};     ///< of fluxes
    std::vector<double> waves{};  ///< wave_sums()
    ResidualMemory memory{};
    BlockSystem system{};
    std::vector<std::array<float, 4>> changes{};
    std::optional<DisplacementLayers> layers{};
};

Iteration begin(const EulerMesh& mesh, const EulerOptions& options) {
    const double alpha = core::radians(options.alpha_deg);
    const Four stream{1, options.mach * core::cos_reproducible(alpha), options.mach * core::sin_reproducible(alpha),
                      1 / heat_ratio};
    Iteration flow{.mesh = dual_of(mesh, options.chord), .far = {.free_stream = stream}, .states = {}, .conserved = {}};
    if (!mesh.walls.empty()) flow.far.vortex = vortex_of(flow.mesh);
    flow.states.assign(flow.mesh.points.size(), stream);
    flow.conserved.assign(flow.mesh.points.size(), conserved_of(stream));
    return flow;
}

/// Applies the change of one vertex, halved until density and pressure rise or fall by no more than a factor. Returns
/// whether it was halved.
bool apply_change(const std::array<float, 4>& change, Four& state, Four& conserved) {
    constexpr double largest_factor = 2.5;
    constexpr int halvings = 8;
    double share = 1;
    for (int h = 0; h < halvings; ++h, share *= 0.5) {
        Four next = conserved;
        for (std::size_t m = 0; m < 4; ++m) next[m] += share * change[m];
        const Four candidate = state_of(next);
        const auto is_near = [&](std::size_t m) {
            return candidate[m] < largest_factor * state[m] && state[m] < largest_factor * candidate[m];
        };
        if (!is_near(0) || !is_near(3)) continue;
        conserved = next;
        state = candidate;
        return h > 0;
    }
    return true;
}

/// Sums up the pressures on the walls.
void update_forces(Iteration& flow) {
    Point force;
    for (const BoundaryEdge& e : flow.mesh.boundary) {
        if (e.kind == BoundaryKind::far) continue;
        const double pressure = 0.5 * (flow.states[e.a][3] + flow.states[e.b][3]) - flow.far.free_stream[3];
        force = force + pressure * e.normal;
    }
    const Point stream = velocity(flow.far.free_stream);
    const double speed = length(stream), dynamic = 0.5 * speed * speed;
    flow.drag = dot(stream, force) / (speed * dynamic);
    flow.lift = cross(stream, force) / (speed * dynamic);
    flow.far.lift = flow.lift;
}

/// Makes one step and changes `cfl` for the next one. Returns the root mean square of the residuals of the density
/// before it, each over the wave speeds of its control volume, so that large volumes count no more than small ones.
double step(Iteration& flow, const EulerOptions& options, int order, double& cfl) {
    constexpr double share_of_halved = 0.005;  // vertices with halved changes that make time steps smaller
    const std::size_t vertices = flow.mesh.points.size();
    residual(flow.mesh, flow.states, flow.far, order, flow.memory, flow.sums);
    if (flow.layers) flow.layers->add_fluxes(flow.states, flow.sums);
    wave_sums(flow.mesh, flow.states, flow.waves);
    double squares = 0;
    for (std::size_t v = 0; v < vertices; ++v) {
        const double change = flow.sums[v][0] / flow.waves[v];
        squares += change * change;
        flow.sums[v] = -1 * flow.sums[v];
    }
    assemble(flow.mesh, flow.states, flow.far.free_stream, flow.waves, cfl, flow.system);
    solve(flow.mesh, flow.system, flow.sums, options.sweeps, flow.changes);
    std::size_t halved = 0;
    for (std::size_t v = 0; v < vertices; ++v)
        halved += apply_change(flow.changes[v], flow.states[v], flow.conserved[v]) ? 1 : 0;
    const bool wild = static_cast<double>(halved) > share_of_halved * static_cast<double>(vertices);
    const double factor = wild ? 0.5 : halved > 0 ? 1.0 : options.cfl_growth;
    cfl = std::max(factor * cfl, 1.0);
    update_forces(flow);
    return std::sqrt(squares / static_cast<double>(vertices));
}

/// The forces of the last steps.
class ForceHistory {
public:
    void add(double lift, double drag) {
        lifts_[count_ % steps] = lift;
        drags_[count_ % steps] = drag;
        ++count_;
    }
    /// Returns whether all that it holds are equal up to this share, or to this share of small numbers.
    bool settled(double share) const {
        constexpr double least_lift = 0.1, least_drag = 0.01;
        return count_ >= steps && even(lifts_, share, least_lift) && even(drags_, share, least_drag);
    }

private:
    static constexpr std::size_t steps = 10;
    static bool even(const std::array<double, steps>& values, double share, double least) {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return *high - *low <= share * std::max({std::abs(*low), std::abs(*high), least});
    }
    std::array<double, steps> lifts_{}, drags_{};
    std::size_t count_ = 0;
};

EulerSolution solution_of(const Iteration& flow) {
    EulerSolution solution;
    solution.densities.reserve(flow.states.size());
    for (const std::uint32_t number : flow.mesh.number_of) {
        const Four& state = flow.states[number];
        solution.densities.push_back(state[0]);
        solution.velocities.push_back(velocity(state));
        solution.pressures.push_back(state[3]);
    }
    solution.lift = flow.lift;
    solution.drag = flow.drag;
    return solution;
}

/// Makes steps until the flow is steady, but at most as many as the options say. Steps are no longer than the fall of
/// the residual allows: W. A. Mulder, B. van Leer, Experiments with implicit upwind methods for the Euler equations,
/// J. Comput. Phys. 59 (1985). Without this limit oblique shocks go on swinging.
EulerSolution iterate(const EulerMesh& mesh, const EulerOptions& options) {
    Iteration flow = begin(mesh, options);
    // Without walls nothing changes but for rounding errors.
    constexpr double least_residual = 1e-14;
    double first = 0, now = 0, cfl = options.first_cfl;
    ForceHistory history;
    int iterations = 0;
    bool converged = false;
    while (!converged && iterations < options.max_iterations) {
        const bool begins = iterations < options.first_order_iterations;
        if (!begins && options.reynolds && !flow.layers) flow.layers.emplace(mesh, flow.mesh, options, flow.states);
        if (flow.layers) flow.layers->update(flow.states);
        now = step(flow, options, begins ? 1 : 2, cfl);
        if (!std::isfinite(now)) break;
        if (++iterations == 1) first = std::max(now, least_residual);
        cfl = std::clamp(options.first_cfl * first / now, 1.0, cfl);
        if (begins) continue;
        history.add(flow.lift, flow.drag);
        converged = now < options.tolerance * first ||
                    (history.settled(options.settled) && now < options.settled_residual * first);
    }
    if (std::isfinite(now)) converged = converged || history.settled(options.nearly_settled);
    EulerSolution solution = solution_of(flow);
    if (flow.layers) solution.layers = flow.layers->walls();
    solution.residual = now / first;
    solution.iterations = iterations;
    solution.converged = converged;
    return solution;
}

}  // namespace

EulerSolution solve_euler(const EulerMesh& mesh, const EulerOptions& options) {
    if (!(options.mach > 0 && options.mach <= largest_mach))
        throw OptionError("mach", "must be above 0 and at most 10 for a flow without friction");
    EulerSolution solution = iterate(mesh, options);
    if (solution.converged || !options.reynolds) return solution;
    EulerOptions without_layers = options;
    without_layers.reynolds.reset();
    return iterate(mesh, without_layers);
}

double mach_at(const EulerSolution& solution, std::size_t vertex) {
    return length(solution.velocities[vertex]) /
           std::sqrt(heat_ratio * solution.pressures[vertex] / solution.densities[vertex]);
}

}  // namespace lamina::flow::euler
