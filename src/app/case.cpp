#include "app/case.hpp"

#include <algorithm>
#include <filesystem>
#include <tuple>

#include <lamina/error.hpp>

#include "app/case_file.hpp"

namespace lamina::app {

MeshCase case_of_inputs(const std::vector<std::string>& inputs) {
    if (inputs.empty()) throw UsageError("no INPUT: give an airfoil file, naca:DIGITS or a case file");
    const auto is_case_file = [](const std::string& input) {
        return std::filesystem::path(input).extension() == ".toml";
    };
    if (inputs.size() == 1 && is_case_file(inputs.front())) return read_case_file(inputs.front());
    const auto beside = std::find_if(inputs.begin(), inputs.end(), is_case_file);
    if (beside != inputs.end()) throw UsageError("case file " + *beside + " must be the only INPUT");

    MeshCase mesh_case;
    mesh_case.inputs = inputs;
    return mesh_case;
}

CaseOptions case_options(const MeshCase& mesh_case) {
    const auto& [first_height, y_plus, reynolds, chord] =
        std::tie(mesh_case.first_height, mesh_case.y_plus, mesh_case.reynolds, mesh_case.chord);
    if (first_height && y_plus) throw UsageError("first height given twice: by first-height and by y-plus");
    if (y_plus && !reynolds) throw UsageError("y-plus needs reynolds, the Reynolds number based on the chord");
    if (reynolds && !y_plus) throw UsageError("reynolds is of use with y-plus only");
    if (chord && !y_plus) throw UsageError("chord is of use with y-plus only");

    CaseOptions options = mesh_case.options;
    if (!options.far_field_outline.empty()) {
        if (options.far_field_shape != FarFieldShape::box)
            throw UsageError("far field given twice: by far-field-shape and by far-field-outline");
        options.far_field_shape = FarFieldShape::convex;
    }
    if (first_height) options.layer.first_height = *first_height;
    if (y_plus) options.y_plus = {*y_plus, *reynolds, chord};
    return options;
}

}  // namespace lamina::app
