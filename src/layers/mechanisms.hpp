// Mechanisms of the layer that can be left out, to measure what each is worth: ./dev ablate.
#pragma once

#include <string_view>

#ifdef LAMINA_ABLATION
#include <cstdlib>
#include <string>
#endif

namespace lamina::layers {

#ifdef LAMINA_ABLATION
/// Returns whether the layer uses a mechanism: not those that the environment names, LAMINA_WITHOUT=name,name,...
inline bool uses(std::string_view mechanism) {
    static const std::string without = [] {
        const char* names = std::getenv("LAMINA_WITHOUT");
        return "," + std::string(names ? names : "") + ",";
    }();
    return without.find("," + std::string(mechanism) + ",") == std::string::npos;
}
#else
constexpr bool uses(std::string_view) { return true; }
#endif

}  // namespace lamina::layers
