// Mechanisms of the layer that can be left out, to measure what each is worth: ./dev ablate.
#pragma once

#include <string_view>

namespace lamina::layers {

#ifdef LAMINA_ABLATION
/// Returns whether the layer uses a mechanism: not those that the environment names, LAMINA_WITHOUT=name,name,...
bool uses(std::string_view mechanism);
#else
constexpr bool uses(std::string_view) { return true; }
#endif

}  // namespace lamina::layers
