// A run that makes a family of similar meshes, for a study of convergence: what `lamina family` and `lamina case` have
// in common.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/case.hpp"
#include "app/command_line.hpp"
#include "app/mesh_run.hpp"

namespace lamina::app {

/// The options of families.
struct FamilyArguments {
    int levels;                       ///< number of meshes
    double ratio;                     ///< of lengths from level to level
    std::optional<int> base_level{};  ///< the level with the lengths of the given options; empty: the middle one
    std::string table{};              ///< file of the table; empty: named after the output
};

/// Adds the options of families to a command. levels: the number of meshes where it is not given.
std::shared_ptr<FamilyArguments> add_family_options(CLI::App& command, int levels);

/// Returns where the mesh of a level goes; its outputs are those of the case.
using DestinationOfLevel = std::function<MeshDestination(const MeshCase&)>;

/// Makes the meshes of a family and writes them with a table of their h. In the outputs of the case, {level} stands for
/// the number of the level. Throws UsageError where that is missing.
void run_family(const FamilyArguments& arguments, const MeshCase& mesh_case,
                const DestinationOfLevel& destination_of_level);

}  // namespace lamina::app
