// The arguments of mesh(): the options of the library, and those that the module has beside them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <lamina/option.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/presets.hpp>

namespace lamina::python {

/// The options of one mesh.
struct MeshRequest {
    CaseOptions options;                    ///< of the library
    std::string preset = automatic_preset;  ///< the preset that they began with
    bool allow_defects = false;             ///< whether a mesh with angles below the bound is returned
    std::vector<std::string> given{};       ///< names of the options that have values: "first-height"
};

/// Returns the table of the options: those of option_table<CaseOptions>() that are for users, and those of the module.
const OptionTable<MeshRequest>& request_table();

/// Returns the request with these values of options, named as in Python. Throws OptionError for unknown names and wrong
/// values, UsageError for options that do not go together.
MeshRequest make_request(const std::vector<std::pair<std::string, OptionValue>>& values);

}  // namespace lamina::python
