// The flow before the mesh, for JavaScript.
#pragma once

#include <emscripten/val.h>

#include <lamina/pipeline.hpp>

namespace lamina::web {

/// Returns the flow that decided on a mesh, as FlowFacts of web/src/values.ts says; null where none did, and where it
/// is an estimate or too fast for its pressures.
emscripten::val flow_facts_of(const MeshResult& result, const FlowConditions& conditions);

}  // namespace lamina::web
