// Cases of SU2 whose mesh pitches as a whole.
//
// SU2 turns all vertices by itself, the far field included: cells keep their shapes at any angle, and in a uniform
// stream a far field that is turned is as good as one at rest.
#include <lamina/solver_case.hpp>

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "cases/case_files.hpp"
#include "cases/templates.hpp"
#include "cases/words.hpp"
#include "core/atomic_file.hpp"

namespace lamina::cases {

namespace fs = std::filesystem;

namespace {

constexpr const char *pitching_mesh = "mesh.su2", *pitching_format = "su2";

/// Returns whether the far field is closed, so that neither ground nor a line of symmetry goes on behind it.
bool has_closed_far_field(const Mesh& mesh) {
    std::vector<VertexId> begins, ends;
    for (const Marker& marker : mesh.markers) {
        if (marker.kind != MarkerKind::far_field) continue;
        for (const Segment& edge : marker.edges) {
            begins.push_back(edge.a);
            ends.push_back(edge.b);
        }
    }
    std::sort(begins.begin(), begins.end());
    std::sort(ends.begin(), ends.end());
    return !begins.empty() && begins == ends;
}

/// Returns whether an element is all that has walls: then the mesh may turn with it.
bool is_only_element(const std::string& element, const Mesh& mesh) {
    return element == "all" || std::all_of(mesh.markers.begin(), mesh.markers.end(), [&](const Marker& marker) {
               return !may_be_wall(marker.kind) || marker.name == element;
           });
}

/// Returns the files of the case beside the mesh.
std::vector<const Template*> pitching_templates() {
    std::vector<const Template*> files;
    for (const Template& file : templates())
        if (file.solver == "pitching") files.push_back(&file);
    return files;
}

}  // namespace

}  // namespace lamina::cases

namespace lamina {

using namespace cases;

void write_pitching_case(const Mesh& reference, const TurnInTime& turn, double end, int steps, const fs::path& folder) {
    const Pitching* pitching = std::get_if<Pitching>(&turn.course);
    if (pitching == nullptr || !is_only_element(turn.element, reference) || !has_closed_far_field(reference))
        throw UsageError("SU2's case is that of all bodies that pitch together within a closed far field");
    const Words words{{"STEPS", fmt::format("{}", steps)},
                      {"END", fmt::format("{}", end)},
                      {"MEAN", fmt::format("{}", pitching->mean_deg)},
                      {"AMPLITUDE", fmt::format("{}", pitching->amplitude_deg)},
                      {"FREQUENCY", fmt::format("{}", pitching->frequency)},
                      {"CENTER_X", fmt::format("{}", turn.center.x)},
                      {"CENTER_Y", fmt::format("{}", turn.center.y)},
                      {"SOUND_SPEED", fmt::format("{}", su2_sound_speed())},
                      {"TIME_OPTIONS", su2_steps_in_time("$seconds")}};
    core::NewFolders folders;
    folders.create_above(folder / pitching_mesh);
    write_mesh(reference, folder / pitching_mesh, {.format = pitching_format});
    for (const Template* file : pitching_templates())
        write_case_file({file->name, fill_in(file->text, words), file->text.starts_with("#!")}, folder);
    folders.keep();
}

std::vector<fs::path> pitching_case_outputs(const fs::path& folder) {
    std::vector<fs::path> outputs = output_files(folder / pitching_mesh, {.format = pitching_format});
    for (const Template* file : pitching_templates()) outputs.push_back(folder / file->name);
    return outputs;
}

}  // namespace lamina
