// One run of `lamina mesh`: its inputs, its options and its outputs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/presets.hpp>

namespace lamina::app {

/// When the names of the stages are printed on standard error. `automatic`: where it is a terminal.
enum class ProgressShown { automatic, always, never };

/// The words of the help for INPUT, which `lamina mesh`, `flow` and `info` share.
inline constexpr const char* input_help =
    "airfoil files, naca:DIGITS[:POINTS][:blunt|:extended] (POINTS: so many, spaced by cosines; else as many as the "
    "wall needs), - for standard input, or one case file (.toml)";

struct MeshCase {
    std::string preset = automatic_preset;  ///< the preset that its options began with
    std::string case_file;                  ///< the case file that it was read from; empty: none
    std::vector<std::string> inputs;        ///< airfoil files and NACA names; never a case file
    std::vector<std::string> outputs;       ///< mesh files
    std::string format;                     ///< of every mesh file; empty: by its extension
    bool stream = false;                    ///< whether the mesh is written while it is made
    std::size_t parts = 1;                  ///< of PVTU files and of OpenFOAM's cellDecomposition
    std::optional<Length> span;             ///< of meshes in space; empty: plane ones
    std::size_t span_cells = 1;             ///< number of cells across the span
    bool span_periodic = false;             ///< whether its ends continue each other
    bool wall_distance = false;             ///< whether VTU files hold the distance to the nearest wall
    std::string wall_data;                  ///< CSV file of the wall vertices; empty: none
    std::string report;                     ///< JSON file; empty: none
    std::string html;                       ///< page with a view of the mesh; empty: none
    std::string background;                 ///< mesh file with sizes; empty: none
    CaseOptions options;                    ///< without the background mesh, which is read when the work begins
    ProgressShown progress = ProgressShown::automatic;
    bool quiet = false;              ///< whether the summary is left out
    bool strict = false;             ///< whether warnings make the run fail
    bool allow_defects = false;      ///< whether a mesh with angles below the bound is written
    std::vector<std::string> given;  ///< names of the options that a case file or the command line gave
};

/// A file that a run writes beside the mesh where it has a name.
struct FileBesideMesh {
    std::string MeshCase::*name;
    const char* option;  ///< "--report"
};
inline constexpr FileBesideMesh files_beside_mesh[] = {
    {&MeshCase::wall_data, "--wall-data"}, {&MeshCase::report, "--report"}, {&MeshCase::html, "--html"}};

/// Returns the case that the INPUT arguments of a command stand for: the contents of a case file, or the defaults with
/// these inputs. The preset replaces that of the case file. Throws UsageError where a case file stands beside other
/// inputs, and the errors of read_case_file().
MeshCase case_of_inputs(const std::vector<std::string>& inputs, const std::optional<std::string>& preset = {},
                        bool has_reynolds = false);

/// Throws UsageError for a case without inputs and without sheets.
void require_any_body(const MeshCase& mesh_case);

}  // namespace lamina::app
