// The arguments of mesh(): the options of the library, and those that the module has beside them.
#pragma once

#include <emscripten/val.h>

#include <lamina/option.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/presets.hpp>

namespace lamina::web {

/// The options of one mesh.
struct MeshRequest {
    CaseOptions options;                    ///< of the library
    std::string preset = automatic_preset;  ///< the preset that they began with
    bool allow_defects = false;             ///< whether a mesh with angles below the bound is returned
};

/// Returns the request with the options of an object, named as in case files. Throws OptionError for unknown names and
/// wrong values, UsageError for options that do not go together.
MeshRequest make_request(const emscripten::val& values);

/// Returns one object for each option: key, kind, metavar, help, range, group, default, excludes.
emscripten::val option_rows();

}  // namespace lamina::web
