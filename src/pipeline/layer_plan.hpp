// The stages from the geometry to the rays of the layer, with what the flow before the mesh decides.
#pragma once

#include <string>
#include <vector>

#include <lamina/limits.hpp>
#include <lamina/pipeline.hpp>

#include "layers/growth.hpp"
#include "pipeline/fit_layer.hpp"
#include "pipeline/flow_guidance.hpp"
#include "pipeline/stage_clock.hpp"

namespace lamina::pipeline {

/// What is known before the first cell is made.
struct PlannedLayer {
    CaseOptions options;  ///< those given, with sizes that follow from them and from the flow
    layers::LayerGrowth growth;
    FlowGuidance guidance;  ///< its wakes are with the rays
    FittedLayer fitted;
};

/// Reads the inputs as the options say. Halves above a line of symmetry are closed along it.
Geometry read_inputs(const std::vector<std::string>& inputs, GeometryOptions options, const FarFieldOptions& domain);

/// Runs the stages up to the rays. Throws OptionError, and LimitError where walls or options ask for too much at this cost.
PlannedLayer plan_layer(const Geometry& whole, CaseOptions options, const WorkCost& cost, StageClock& clock);

/// Moves what the flow decided to the result, with its warnings first.
void hand_over_decisions(PlannedLayer& plan, MeshResult& result);

}  // namespace lamina::pipeline
