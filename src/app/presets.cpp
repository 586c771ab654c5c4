#include "app/presets.hpp"

namespace lamina::app {

MeshCase case_of_preset(const std::string& name, bool has_reynolds) {
    MeshCase mesh_case;
    mesh_case.options = preset_options(name, has_reynolds);
    return mesh_case;
}

}  // namespace lamina::app
