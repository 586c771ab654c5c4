// All stages in their order. run(), and plan_layer() and make_mesh() that it is made of, are the only functions that
// see the options of all stages (CaseOptions): each stage below them gets its own.
#pragma once

#include <string>
#include <vector>

#include <lamina/limits.hpp>
#include <lamina/pipeline.hpp>

#include "layers/growth.hpp"
#include "pipeline/fit_layer.hpp"
#include "pipeline/flow_guidance.hpp"
#include "pipeline/mesh_stages.hpp"
#include "pipeline/sharing/mesh_driver.hpp"
#include "pipeline/stage_clock.hpp"

namespace lamina::pipeline {

/// What is known before the first cell is made.
struct PlannedLayer {
    layers::LayerGrowth growth;
    FlowGuidance guidance;  ///< its wakes are with the rays
    FittedLayer fitted;
};

/// Reads the inputs as the options say. Halves above a line of symmetry are closed along it.
Geometry read_inputs(const std::vector<std::string>& inputs, GeometryOptions options, const FarFieldOptions& domain);

/// Runs the stages up to the rays. Throws OptionError, and LimitError where walls or options ask for too much at this
/// cost.
PlannedLayer plan_layer(const Geometry& whole, const CaseOptions& options, const WorkCost& cost, StageClock& clock);

/// Makes a mesh round this layer. Throws MeshError where it is not valid, and LimitError.
MadeMesh make_mesh(const FittedLayer& fitted, const CaseOptions& options, MeshDriver& driver, StageClock& clock);

/// Moves what the flow decided to the result, with its warnings first.
void hand_over_decisions(PlannedLayer& plan, MeshResult& result);

/// Runs all stages on a geometry.
MadeMesh run(const Geometry& whole, const CaseOptions& options, MeshDriver& driver, StageClock& clock);

}  // namespace lamina::pipeline
