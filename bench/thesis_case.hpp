// The case of the thesis that measurements of whole runs share.
#pragma once

#include <lamina/pipeline.hpp>

#include "support/layers.hpp"

namespace lamina::bench {

/// Returns the options of the case of the thesis (Figs. 24 to 28), for one thread.
inline CaseOptions thesis_case(double gradation) {
    CaseOptions options;
    options.layer = test::thesis_layer();
    options.far_field.size = 50;
    options.sizing.gradation = gradation;
    options.threads = 1;
    return options;
}

}  // namespace lamina::bench
