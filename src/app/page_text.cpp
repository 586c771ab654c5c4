#include "app/page_text.hpp"

#include <nlohmann/json.hpp>

#include <lamina/places.hpp>

#include "app/options.hpp"

namespace lamina::app {

namespace {

/// Returns JSON in which bytes that are not UTF-8 are replaced.
std::string text_of_facts(const Json& facts) { return facts.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json places_of_mesh(const Mesh& mesh) {
    Json places = Json::array();
    for (const auto& [name, window] : named_places(mesh))
        places.push_back(
            {{"name", name}, {"window", {window.lower.x, window.lower.y, window.upper.x, window.upper.y}}});
    return places;
}

/// Returns the options that are set. A page is made to be shared, so paths stay as they were given.
Json configuration_of_case(const MeshCase& mesh_case) {
    Json options = Json::array();
    for (const Option<MeshCase>& option : mesh_options())
        if (const std::optional<OptionValue> value = option.get(mesh_case))
            options.push_back(
                {{"name", option.name}, {"value", to_text(*value)}, {"given", is_given(mesh_case, option.name)}});
    return options;
}

/// Returns the extent of the walls in x; 0 where there are none.
double chord_of_walls(const Mesh& mesh) {
    Box walls;
    for (const Marker& marker : mesh.markers)
        if (may_be_wall(marker.kind))
            for (const Segment& edge : marker.edges) walls.include(mesh.points[edge.a.index()]);
    return walls.lower.x <= walls.upper.x ? walls.width() : 0;
}

/// Returns the title of a section, such as "RAE 2822 AIRFOIL", or the names of the elements.
std::string title_of_geometry(const Geometry& geometry) {
    if (geometry.elements.size() == 1 && !geometry.elements[0].title.empty()) return geometry.elements[0].title;
    std::string title;
    for (const Element& element : geometry.elements) title += (title.empty() ? "" : ", ") + element.name;
    return title;
}

}  // namespace

PageText page_of_run(const MeshCase& mesh_case, const MeshResult& result, const Json& report) {
    const std::string title = title_of_geometry(result.geometry);
    return {title, text_of_facts({{"title", title},
                                  {"chord", result.conditions.chord},
                                  {"places", places_of_mesh(result.mesh)},
                                  {"configuration", configuration_of_case(mesh_case)},
                                  {"report", report}})};
}

PageText page_of_mesh(const std::string& title, const Mesh& mesh, const Json& report) {
    return {
        title,
        text_of_facts(
            {{"title", title}, {"chord", chord_of_walls(mesh)}, {"places", places_of_mesh(mesh)}, {"report", report}})};
}

}  // namespace lamina::app
