// One run of `lamina mesh`: what goes in, every option, what comes out.
#pragma once

#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

namespace lamina::app {

enum class ProgressShown { automatic, always, never };

struct MeshCase {
    std::vector<std::string> inputs;  ///< airfoil files and NACA names; never a case file
    std::vector<std::string> outputs;
    std::string format;          ///< of every output; empty: by extension
    bool wall_distance = false;  ///< in VTU files
    std::string wall_data;       ///< CSV file; empty: none
    std::string report;          ///< empty: none
    std::string background;      ///< mesh file with sizes; empty: none
    CaseOptions options;         ///< without the background mesh, which is read when the work begins
    ProgressShown progress = ProgressShown::automatic;
    bool quiet = false;
    std::vector<std::string> given;  ///< names of the options that a case file or the command line gave
};

/// Returns the case that the INPUT arguments of a command stand for: that of a case file if they are one, else the
/// defaults with these inputs. Throws UsageError where a case file stands beside other inputs, and as read_case_file().
MeshCase case_of_inputs(const std::vector<std::string>& inputs);

}  // namespace lamina::app
