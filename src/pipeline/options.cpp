// The table of all options, and the options of one stage that follow from those of another.
#include <lamina/pipeline.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/limits.hpp"
#include "core/option_rows.hpp"
#include "core/reproducible_math.hpp"
#include "decoupling/far_field.hpp"
#include "geometry/symmetry.hpp"
#include "pipeline/curve_mesh.hpp"
#include "pipeline/derived_options.hpp"
#include "pipeline/internal_lines.hpp"
#include "sizing/requests.hpp"

namespace lamina::pipeline {

namespace {

/// Adds the numbers of vertices and cells that a mesh can be asked to have.
void add_budgets(OptionTableBuilder<CaseOptions>& outer) {
    constexpr double least_count = 100, most_count = 4e9;
    const char* const rule =
        ", within 3 %, on a mesh of the same first heights: with a scale s that is found by trial, all other lengths, "
        "angles between rays and gradations are divided by s, and the growth r of layers up to isotropy becomes "
        "r^(1/s)";
    outer
        .count("vertices", "N", std::string("number of vertices") + rule, numbers_from_to(least_count, most_count),
               member_at(&CaseOptions::vertices))
        .excludes = {"cells"};
    outer.count("cells", "N", "number of cells, likewise", numbers_from_to(least_count, most_count),
                member_at(&CaseOptions::cells));
}

/// Adds what a run may use.
void add_limits(OptionTableBuilder<CaseOptions>& run) {
    run.count("threads", "N", "number of threads; 0: one per core; never changes the mesh", numbers_from_to(0, 1024),
              member_at(&CaseOptions::threads));
    run.count("max-triangles", "N",
              "largest number of triangles; a run that needs more, by estimate, is refused before the work",
              numbers_from_to(1, 1e15), member_at(&CaseOptions::limits, &WorkLimits::max_triangles));
    run.spec("max-memory", "SIZE",
             "largest memory of the process, such as 500M or 2G; a run that needs more, by estimate, is refused before "
             "the work; the program's default is 80 % of what is free",
             core::parse_memory, core::memory_text, member_at(&CaseOptions::limits, &WorkLimits::max_memory_bytes));
}

/// Makes the rows that belong to no stage, or that are stricter here than in their stage.
OptionTable<CaseOptions> make_pipeline_rows() {
    OptionTableBuilder<CaseOptions> flow("Flow"), outer("Outer region"), files("Files"), run("Run");
    flow.choice("use-flow",
                "whether a panel method and boundary layers decide first heights for y+, the least thickness of "
                "--layers auto, and wakes; needs a Reynolds number",
                Choices<bool>{{"no", false}, {"yes", true}}, member_at(&CaseOptions::use_flow));
    // Without a bound there would be nothing to suit the edges of the layer's outer border to.
    outer.number("min-angle", "DEG", "smallest angle of isotropic triangles, in degrees",
                 numbers_above_up_to(0, max_min_angle_deg),
                 member_at(&CaseOptions::refine, &RefineOptions::min_angle_deg));
    files.flag("base-marker", "the base of a blunt trailing edge is a marker of its own, NAME_base", true,
               member_at(&CaseOptions::assemble, &AssembleOptions::base_marker));
    outer
        .number("fineness", "F",
                "the lengths that the program chooses by itself, such as those that the flow asks for, are divided by "
                "this",
                positive_numbers, member_at(&CaseOptions::fineness))
        .library_only = true;
    outer.specs(
        "line", "NAME[:two-sided][:H]:PLACE",
        "a line of edges with a marker NAME, through the points of PLACE, X0,Y0,X1,Y1[,...] or a file of them: edges "
        "between cells, or, two-sided, a wall without thickness; H is the edge length along it; units of the input; "
        "may be given several times",
        parse_line, line_text, member_at(&CaseOptions::lines));
    files.flag("inlet-outlet",
               "the far field is two markers: inlet, where a uniform flow at the angle of attack enters, and outlet",
               true, member_at(&CaseOptions::assemble, &AssembleOptions::inlet_outlet));
    files.count(
        "order", "P",
        "order of the cells: 1 for straight ones, 2 to 4 for curved ones that follow the walls, each proved valid; "
        "MSH, VTU, CGNS, MFEM and Nektar++ alone",
        numbers_from_to(1, max_cell_order), member_at(&CaseOptions::order));
    files.choice(
        "node-distribution",
        "where the nodes of curved cells are on straight ones: evenly spaced, or at the points of Gauss and Lobatto's "
        "quadrature, which MFEM and Nektar++ alone take",
        Choices<NodeDistribution>{{"equidistant", NodeDistribution::equidistant},
                                  {"gauss-lobatto", NodeDistribution::gauss_lobatto}},
        member_at(&CaseOptions::node_distribution));
    add_budgets(outer);
    add_limits(run);
    OptionTable<CaseOptions> rows;
    for (auto* builder : {&flow, &outer, &files, &run})
        for (Option<CaseOptions>& option : builder->take()) rows.push_back(std::move(option));
    return rows;
}

const OptionTable<CaseOptions>& pipeline_rows() {
    static const OptionTable<CaseOptions> rows = make_pipeline_rows();
    return rows;
}

/// Adds an option to the table. It replaces an option of the same name.
void add_row(const Option<CaseOptions>& option, OptionTable<CaseOptions>& table) {
    const auto same_name = [&](const Option<CaseOptions>& other) { return other.name == option.name; };
    const auto row = std::find_if(table.begin(), table.end(), same_name);
    if (row == table.end())
        table.push_back(option);
    else
        *row = option;
}

/// Adds the options of a stage to the table of all options.
template <class Inner>
void add_stage(Inner CaseOptions::*member, OptionTable<CaseOptions>& table) {
    for (const Option<CaseOptions>& option : nested_table<CaseOptions>(option_table<Inner>(), member_at(member)))
        add_row(option, table);
}

}  // namespace

}  // namespace lamina::pipeline

namespace lamina {

using namespace pipeline;

template <>
OptionTable<CaseOptions> option_rows() {
    OptionTable<CaseOptions> table;
    add_stage(&CaseOptions::surface, table);
    add_stage(&CaseOptions::geometry, table);
    add_stage(&CaseOptions::conditions, table);
    add_stage(&CaseOptions::layer, table);
    add_stage(&CaseOptions::far_field, table);
    add_stage(&CaseOptions::sizing, table);
    add_stage(&CaseOptions::refine, table);
    for (const Option<CaseOptions>& option : pipeline_rows()) add_row(option, table);
    for (Option<CaseOptions>& option : table) {
        if (option.name != "exact-points" && option.name != "points") continue;
        // Walls that are alike by number have rays that are.
        option.set = [set_points = option.set](CaseOptions& options, const OptionValue& value) {
            set_points(options, value);
            options.layer.equal_fans = options.surface.exact_points || !options.surface.side_edges.empty();
        };
    }
    return table;
}
template LAMINA_EXPORT const OptionTable<CaseOptions>& option_table();

namespace {

void require_stream_along_walls(const FlowConditions& conditions, const FarFieldOptions& domain) {
    const bool is_level = conditions.alpha_deg == 0 && !conditions.alphas;
    if (!is_level && (domain.tunnel || domain.ground))
        throw OptionError("alpha",
                          fmt::format("the flow runs along ground and tunnel walls: turn the configuration, as with "
                                      "--transform all:rotate:{:g}",
                                      conditions.alphas ? -10 : -conditions.alpha_deg));
    if (!is_level && domain.symmetry)
        throw OptionError(
            "alpha",
            "the flow runs along the line of symmetry, so alpha is 0 there: mesh the whole configuration without "
            "--symmetry at other angles");
}

}  // namespace

FlowWalls flow_walls(const Geometry& geometry, const FlowConditions& conditions, const FarFieldOptions& domain) {
    require_stream_along_walls(conditions, domain);
    const double chord = reference_conditions(conditions, geometry).chord;
    const decoupling::FarField far_field = decoupling::place_far_field(bounding_box(geometry), chord, domain);
    FlowWalls walls;
    if (std::isfinite(far_field.floor)) walls.below = far_field.floor;
    if (std::isfinite(far_field.ceiling)) walls.above = far_field.ceiling;
    // Bodies that a line of symmetry cuts are whole in the geometry, and so make it a streamline themselves.
    if (geometry::is_cut(geometry)) {
        walls.below.reset();
        if (walls.above) walls.below = 2 * far_field.floor - *walls.above;
    }
    if (far_field.pitch > 0) walls.pitch = far_field.pitch;
    return walls;
}

void validate(const CaseOptions& options) {
    validate(options.geometry);
    validate(options.conditions);
    validate(options.surface);
    validate(options.layer);
    validate(options.sizing);
    validate(options.far_field);
    validate(options.decoupling);
    validate(options.decomposition);
    validate(options.refine);
    require_in_range(pipeline_rows(), options);
    validate_lines(options.lines);
    validate_order(options);
    const bool by_y_plus = options.layer.enabled && std::holds_alternative<YPlus>(options.layer.first_height);
    if (options.vertices && options.cells) throw OptionError("cells", "follow from vertices, which are given");
    if (by_y_plus && !options.conditions.reynolds && !options.conditions.velocity)
        throw OptionError("y_plus", "needs reynolds, or velocity and viscosity");
    if (options.use_flow && !options.conditions.reynolds && !options.conditions.velocity)
        throw OptionError("use_flow", "needs reynolds, or velocity and viscosity");
    require_stream_along_walls(options.conditions, options.far_field);
    if (options.assemble.inlet_outlet && options.conditions.alphas)
        throw OptionError("inlet_outlet", "the flow enters at one angle of attack: give one alpha");
    if (options.layer.enabled && options.layer.wake_layers) {
        if (options.conditions.alphas)
            throw OptionError("wake_layers", "layers go on along the wake of one angle of attack: give one alpha");
        if (!options.use_flow) throw OptionError("wake_layers", "needs use_flow, which finds the wakes");
        if (options.far_field.pitch)
            throw OptionError("wake_layers", "layers do not go on along wakes behind a row of blades: leave it out");
        if (options.layer.layers) throw OptionError("wake_layers", "needs layers up to isotropy: layers auto");
    }
}

}  // namespace lamina

namespace lamina::pipeline {

double wall_gradation(const SizingOptions& sizing, double fineness) {
    constexpr double margin = 0.9;
    return std::max(margin * sizing::border_gradation(sizing.gradation), min_wall_gradation / fineness);
}

surface::SpacingLimits spacing_limits(const LayerOptions& layer, const layers::LayerGrowth& growth, double gradation,
                                      unsigned order) {
    surface::SpacingLimits limits;
    limits.max_turning_deg = layer.max_ray_angle_deg;
    limits.with_curves = order > 1;
    if (layer.equal_fans) limits.fan_parts = layers::equal_fan_parts(layer);
    // The layer's border over a fan of rays has edges of height x ray angle, and grows no faster than its gradation.
    // Where the wall's spacing exceeds this, border edges are divided, and the rows below fan out to the division
    // points.
    limits.gradation = gradation;
    if (!layer.enabled) return limits;
    // The height of automatic and adaptive layers follows from the spacing of the wall, so it sets no limit.
    const auto fan_edge = [&](const layers::LayerGrowth& on_element) {
        return requested_height(on_element).value_or(0) * core::radians(layer.max_ray_angle_deg);
    };
    if (!(fan_edge(growth) > 0)) return limits;
    limits.fan_spacing = fan_edge(growth);
    for (std::size_t e = 0; e < growth.first_heights.size(); ++e)
        limits.fan_spacings.push_back(fan_edge(growth_on_element(growth, e)));
    return limits;
}

layers::BorderOptions border_options(const SizingOptions& sizing, const RefineOptions& refine, double chord,
                                     std::span<const SizeSource> sources) {
    const auto largest = [&](const std::optional<Length>& size) { return size ? in_units(*size, chord) : HUGE_VAL; };
    layers::BorderOptions border;
    border.gradation = sizing::border_gradation(sizing.gradation);
    border.max_edge = sizing::frozen_share * std::min(largest(sizing.wall_size), largest(sizing.far_size));
    // Neighbouring frozen edges may differ by sqrt 2 / (2 sin(bound)) before a quality-driven vertex can encroach
    // (docs/decisions/0003). A tenth more saves many splits, and has never made a vertex encroach.
    const double bound = core::radians(refine.min_angle_deg);
    border.max_ratio = 1.1 * std::sqrt(2.0) / (2 * core::sin_reproducible(bound));
    return border_with_sources(std::move(border), sources);
}

sizing::SizedBodies sized_bodies(const Geometry& geometry, const ReferenceConditions& conditions) {
    sizing::SizedBodies bodies;
    bodies.chord = conditions.chord;
    bodies.alpha_deg = conditions.alpha_deg;
    for (const Element& element : geometry.elements) {
        bodies.walls.push_back(element.points);
        bodies.trailing_edges.push_back(element.features.trailing_edge);
    }
    return bodies;
}

layers::BorderOptions border_with_sources(layers::BorderOptions border, std::span<const SizeSource> sources) {
    // Edges may exceed the size of a source by up to a tenth (BorderOptions::sources), usually by less than this.
    constexpr double division_tolerance = 1.08;
    for (SizeSource source : sources) {
        source.size *= sizing::frozen_share / division_tolerance;
        border.sources.push_back(source);
    }
    return border;
}

Geometry part_in_domain(Geometry geometry, const FarFieldOptions& domain, const FlowConditions& conditions) {
    if (domain.symmetry) return cut_at_symmetry(std::move(geometry), *domain.symmetry);
    if (!domain.pitch) return geometry;
    const double chord = reference_conditions(conditions, geometry).chord;
    return blade_row(std::move(geometry), in_units(*domain.pitch, chord), domain.stagger_deg);
}

SizingOptions wakes_at_angles(SizingOptions sizing, const FlowConditions& conditions) {
    if (!conditions.alphas) return sizing;
    std::vector<WakeOptions> wakes;
    for (const WakeOptions& wake : sizing.wakes) {
        if (wake.angle_deg) {
            wakes.push_back(wake);
            continue;
        }
        for (const double alpha : values_of(*conditions.alphas)) {
            wakes.push_back(wake);
            wakes.back().angle_deg = alpha;
        }
    }
    sizing.wakes = std::move(wakes);
    return sizing;
}

SizingOptions sizes_between_borders(SizingOptions sizing, const FarFieldOptions& far_field, double chord,
                                    double fineness) {
    constexpr double edges_between = 20;
    const std::optional<Length>& height = far_field.pitch ? far_field.pitch : far_field.tunnel;
    if (height && !sizing.far_size)
        sizing.far_size = Length{in_units(*height, chord) / (edges_between * fineness), LengthUnit::input};
    return sizing;
}

}  // namespace lamina::pipeline
