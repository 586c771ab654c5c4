#include "layers/mechanisms.hpp"

#ifdef LAMINA_ABLATION
#include <cstdlib>
#include <string>

namespace lamina::layers {

bool uses(std::string_view mechanism) {
    static const std::string without = [] {
        const char* names = std::getenv("LAMINA_WITHOUT");
        return "," + std::string(names ? names : "") + ",";
    }();
    return without.find("," + std::string(mechanism) + ",") == std::string::npos;
}

}  // namespace lamina::layers
#endif
