// What the files of PyFR's case say about this flow and this mesh.
#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/error.hpp>

#include "cases/words.hpp"

namespace lamina::cases {

namespace {

/// Steps from one sample of the forces to the next, which costs a part of a step.
constexpr int sample_steps = 50;

/// Returns a name as PyFR's reader of MSH files has it: in small letters.
std::string name_in_pyfr(std::string name) {
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    return name;
}

/// Throws UsageError for flows and markers that PyFR does not know.
void require_known_to_pyfr(const CaseFlow& flow) {
    const char* const reason = flow.row                     ? "a row of blades"
                               : flow.axisymmetric          ? "an axisymmetric flow"
                               : !flow.moving_walls.empty() ? "walls that move"
                               : flow.has_internal_lines    ? "internal lines"
                                                            : nullptr;
    if (reason != nullptr) throw UsageError(fmt::format("a case of PyFR is not for {}", reason));
    std::set<std::string> names{"fluid"};  // that of the cells
    for (const auto& list : {flow.all_walls(), flow.far_fields, flow.symmetries})
        for (const std::string& name : list)
            if (!names.insert(name_in_pyfr(name)).second || name_in_pyfr(name).starts_with("periodic"))
                throw UsageError(fmt::format(
                    "PyFR cannot have a marker '{}': names differ in more than the case of letters, are not fluid, "
                    "and do not begin with periodic",
                    name));
}

/// Returns the section of a boundary condition.
std::string boundary(const std::string& name, const std::string& condition) {
    return fmt::format("\n[soln-bcs-{}]\ntype = {}\n", name_in_pyfr(name), condition);
}

/// Returns the section that samples the forces on a wall, exactly for polynomials of twice the order.
std::string forces_on(const std::string& wall, const CaseFlow& flow) {
    return fmt::format(
        "\n[soln-plugin-fluidforce-{0}]\nnsteps = {1}\nfile = forces-{0}.csv\nmorigin = ({2}, {3})\n"
        "quad-deg = {4}\n",
        name_in_pyfr(wall), sample_steps, flow.moment_point.x, flow.moment_point.y, 2 * flow.order + 1);
}

/// Returns the conditions of all markers, and what samples forces.
std::string boundaries(const CaseFlow& flow, double pressure) {
    std::string sections;
    for (const std::string& name : flow.all_walls()) sections += boundary(name, "no-slp-adia-wall");
    for (const std::string& name : flow.symmetries) sections += boundary(name, "slp-adia-wall");
    const Point stream = flow.velocity * flow.direction;
    for (const std::string& name : flow.far_fields)
        sections +=
            boundary(name, fmt::format("char-riem-inv\nrho = 1\nu = {}\nv = {}\np = {}", stream.x, stream.y, pressure));
    for (const std::string& name : flow.walls) sections += forces_on(name, flow);
    return sections;
}

/// Returns the velocity at the beginning, in one direction: that of the stream and, for flow that sheds vortices, of a
/// gust across it in the middle of the chord.
std::string initial_velocity(const CaseFlow& flow, double along, double across) {
    if (!flow.time) return fmt::format("{}", flow.velocity * along);
    constexpr double share = 0.3;  // of the speed
    const Point middle = flow.moment_point + Point{flow.chord / 4, 0};
    return fmt::format("{} + {}*exp(-(pow(x - {}, 2) + pow(y - {}, 2))/{})", flow.velocity * along,
                       share * flow.velocity * across, middle.x, middle.y, flow.chord * flow.chord);
}

/// Returns the time step that the smallest cell allows an explicit scheme at this order p: one that crosses a share
/// 1 / (2 p + 1) of its height by convection and sound, and the square of that share by diffusion. Source: B. Cockburn,
/// C.-W. Shu, Runge-Kutta discontinuous Galerkin methods for convection-dominated problems, J. Sci. Comput. 16 (2001).
double explicit_step(const CaseFlow& flow) {
    const double between_nodes = flow.least_height / (2 * flow.order + 1);
    const double fastest = flow.velocity * (1 + 1 / flow.mach);
    return std::min(between_nodes / fastest, between_nodes * between_nodes / flow.viscosity);
}

}  // namespace

Words pyfr_words(const CaseFlow& flow) {
    require_known_to_pyfr(flow);
    constexpr double heat_ratio = 1.4;
    constexpr int times = 20;
    const double sound_speed = flow.velocity / flow.mach, pressure = sound_speed * sound_speed / heat_ratio,
                 time = flow.chord / flow.velocity;
    const int whole = flow.time ? flow.time->times : times;
    std::vector<std::string> wall_files;
    std::transform(flow.walls.begin(), flow.walls.end(), std::back_inserter(wall_files), name_in_pyfr);
    return {{"VISCOSITY", fmt::format("{}", flow.viscosity)},
            {"ORDER", fmt::format("{}", flow.order)},
            {"END", fmt::format("{}", whole * time)},
            {"STEP", fmt::format("{:.3g}", explicit_step(flow))},
            {"PRESSURE", fmt::format("{}", pressure)},
            {"INITIAL_X", initial_velocity(flow, flow.direction.x, -flow.direction.y)},
            {"INITIAL_Y", initial_velocity(flow, flow.direction.y, flow.direction.x)},
            {"BOUNDARIES", boundaries(flow, pressure)},
            {"SAMPLE_STEPS", fmt::format("{}", sample_steps)},
            {"TIME", fmt::format("{}", time)},
            {"TIMES", fmt::format("{}", whole)},
            {"WALL_FILES", fmt::format("{}", fmt::join(wall_files, " "))},
            {"COSINE", fmt::format("{}", flow.direction.x)},
            {"SINE", fmt::format("{}", flow.direction.y)},
            {"FORCE", fmt::format("{}", 0.5 * flow.velocity * flow.velocity * flow.area)},
            {"CHORD", fmt::format("{}", flow.chord)}};
}

}  // namespace lamina::cases
