#include "meshes.hpp"

#include <cstdint>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/delaunay.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/places.hpp>
#include <lamina/threads.hpp>
#include <lamina/warning.hpp>

#include "core/marker_names.hpp"
#include "flows.hpp"
#include "request.hpp"
#include "values.hpp"

namespace lamina::web {

using emscripten::val;

namespace {

/// Returns a typed array of the numbers that structures such as points and triangles are made of.
template <class Number, class Item>
val flat(const std::vector<Item>& items) {
    static_assert(sizeof(Item) % sizeof(Number) == 0);
    return copied(reinterpret_cast<const Number*>(items.data()), items.size() * sizeof(Item) / sizeof(Number));
}

/// The same check that the program makes before it writes a mesh.
void require_promised_angles(const MeshResult& result, const MeshRequest& request) {
    const std::size_t narrow = result.check.isotropic.unexcused();
    if (request.allow_defects || !request.options.lines.empty() || narrow == 0) return;
    throw MeshError(fmt::format("{} triangle{} beyond the layer {} an angle below the bound (allow_defects returns the "
                                "mesh all the same)",
                                narrow, narrow == 1 ? "" : "s", narrow == 1 ? "has" : "have"),
                    result.mesh.points[result.mesh.triangles[result.check.unexcused_cells.front()].v[0].index()]);
}

val warnings_of(const std::vector<Warning>& warnings) {
    val list = val::array();
    for (const Warning& warning : warnings) {
        val entry = val::object();
        entry.set("code", warning_name(warning.code));
        entry.set("element", warning.element);
        entry.set("at", to_javascript(warning.at));
        entry.set("number", warning.number);
        entry.set("unit", warning.unit);
        entry.set("message", warning.message);
        list.call<void>("push", entry);
    }
    return list;
}

val quality_of(const QualitySummary& quality) {
    val entry = val::object();
    entry.set("cells", static_cast<double>(quality.cells));
    entry.set("min_angle", quality.min_angle_deg);
    entry.set("max_angle", quality.max_angle_deg);
    entry.set("mean_ratio", quality.mean_ratio);
    entry.set("max_aspect_ratio", quality.max_aspect_ratio);
    entry.set("angle_histogram", copied(quality.angle_histogram.data(), quality.angle_histogram.size()));
    return entry;
}

val elements_of(const MeshResult& result) {
    val list = val::array();
    for (std::size_t e = 0; e < result.geometry.elements.size(); ++e) {
        const Element& element = result.geometry.elements[e];
        val entry = val::object();
        entry.set("name", element.name);
        entry.set("source", element.file);
        entry.set("title", element.title);
        entry.set("wall_vertices", static_cast<double>(element.points.size()));
        entry.set("trailing_edge", to_javascript(element.features.trailing_edge));
        entry.set("first_height", e < result.first_heights.size() ? val(result.first_heights[e]) : val::null());
        entry.set("repairs", to_javascript(element.repairs));
        list.call<void>("push", entry);
    }
    return list;
}

val curved_of(const MeshResult& result) {
    if (result.curved.order <= 1) return val::null();
    val entry = val::object();
    entry.set("order", result.curved.order);
    entry.set("wall_edges", static_cast<double>(result.curving.wall_edges));
    entry.set("curved_wall_edges", static_cast<double>(result.curving.curved_edges));
    entry.set("min_scaled_jacobian", result.curved_check.min_scaled_jacobian);
    return entry;
}

val places_of(const Mesh& mesh) {
    val list = val::array();
    for (const auto& [name, window] : named_places(mesh)) {
        const double box[] = {window.lower.x, window.lower.y, window.upper.x, window.upper.y};
        val entry = val::object();
        entry.set("name", name);
        entry.set("window", val::array(std::begin(box), std::end(box)));
        list.call<void>("push", entry);
    }
    return list;
}

val facts_of(const MeshResult& result, const FlowConditions& conditions) {
    val facts = val::object();
    facts.set("chord", result.conditions.chord);
    facts.set("elements", elements_of(result));
    facts.set("places", places_of(result.mesh));
    facts.set("layer", quality_of(result.check.layer));
    facts.set("isotropic", quality_of(result.check.isotropic));
    facts.set("curved", curved_of(result));
    facts.set("flow", flow_facts_of(result, conditions));
    facts.set("seconds", result.seconds.total);
    return facts;
}

}  // namespace

val HeldMesh::arrays() const {
    val arrays = val::object();
    arrays.set("points", flat<double>(mesh_.points));
    arrays.set("triangles", flat<std::uint32_t>(mesh_.triangles));
    arrays.set("quads", flat<std::uint32_t>(mesh_.quads));
    arrays.set("region", flat<std::uint8_t>(mesh_.region));
    arrays.set("piece", flat<std::uint32_t>(mesh_.piece));
    arrays.set("layer", flat<std::uint16_t>(mesh_.layer));
    arrays.set("constraints", flat<std::uint32_t>(mesh_.constraints));
    val markers = val::array();
    for (const Marker& marker : mesh_.markers) {
        val entry = val::object();
        entry.set("name", marker.name);
        entry.set("kind", std::string(core::word_of(marker.kind)));
        entry.set("edges", flat<std::uint32_t>(marker.edges));
        markers.call<void>("push", entry);
    }
    arrays.set("markers", markers);
    return arrays;
}

void HeldMesh::write(const std::string& file, const std::string& format, bool wall_distance) const {
    const WriteOptions options{.format = format, .wall_distance = wall_distance};
    if (nodes_.order > 1)
        write_curved_mesh(mesh_, nodes_, file, options);
    else
        write_mesh(mesh_, file, options);
}

val generate(const val& inputs, const val& options, const val& progress) {
    const MeshRequest request = make_request(options);
    Progress report;
    if (!progress.isNull()) report = [&](const ProgressEvent& event) { progress(event.stage); };
    MeshResult result = generate_mesh(strings_of(inputs), request.options, report);
    require_promised_angles(result, request);
    val reply = val::object();
    reply.set("warnings", warnings_of(result.warnings));
    reply.set("facts", facts_of(result, request.options.conditions));
    reply.set("mesh", HeldMesh(std::move(result.mesh), std::move(result.curved)));
    return reply;
}

val outlines(const val& inputs) {
    const std::vector<std::string> names = strings_of(inputs);
    val list = val::array();
    for (const Element& element : read_geometry(names).elements) {
        val entry = val::object();
        entry.set("name", element.name);
        entry.set("title", element.title);
        entry.set("format", element.format);
        entry.set("points", flat<double>(element.points));
        entry.set("repairs", to_javascript(element.repairs));
        list.call<void>("push", entry);
    }
    return list;
}

val delaunay(const val& points) {
    const std::vector<double> numbers = numbers_of<double>(points);
    if (numbers.size() % 2 != 0) throw UsageError("points must be an even number of coordinates: x, y, x, y, ...");
    std::vector<Point> given(numbers.size() / 2);
    for (std::size_t i = 0; i < given.size(); ++i) given[i] = {numbers[2 * i], numbers[2 * i + 1]};
    Triangulation made;
    with_threads(0, [&] { made = triangulate(given); });
    return flat<std::uint32_t>(made.triangles);
}

}  // namespace lamina::web
