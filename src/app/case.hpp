// One run of `lamina mesh`: what goes in, every option, what comes out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

namespace lamina::app {

enum class ProgressShown { automatic, always, never };

struct MeshCase {
    std::vector<std::string> inputs;  ///< airfoil files and NACA names; never a case file
    std::vector<std::string> outputs;
    std::string format;          ///< of every output; empty = by extension
    bool base_marker = false;    ///< for the base of a blunt trailing edge
    bool wall_distance = false;  ///< in VTU files
    std::string wall_data;       ///< CSV file; empty = none
    std::string report;          ///< empty = none
    std::string background;      ///< mesh file with sizes; empty = none
    CaseOptions options;         ///< but for the background mesh, which is read when the work begins, and for the first
                                 ///< height, of which only one of the next two may be given
    std::optional<double> first_height;
    std::optional<double> y_plus, reynolds, chord;
    ProgressShown progress = ProgressShown::automatic;
    bool quiet = false;
};

/// The case that the INPUT arguments of a command stand for: that of a case file if they are one, else the defaults
/// with these inputs. Throws UsageError where a case file stands beside other inputs, and as read_case_file().
MeshCase case_of_inputs(const std::vector<std::string>& inputs);

/// The options of the whole case. Throws UsageError where the first height is given twice, or by half.
CaseOptions case_options(const MeshCase& mesh_case);

}  // namespace lamina::app
