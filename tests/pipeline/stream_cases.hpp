// Cases of meshes that are made piece by piece: all topologies, with and without layers, many pieces and few.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pipeline/cases.hpp"
#include "support/temporary_folder.hpp"

namespace lamina::test {

struct StreamCase {
    std::string name;
    std::vector<std::string> inputs;
    CaseOptions options;
};

inline std::vector<StreamCase> stream_cases() {
    const auto small = [](const std::function<void(CaseOptions&)>& change) {
        CaseOptions options = quick_options(6);
        options.decoupling.pieces_target = 1000;
        change(options);
        return options;
    };
    return {
        {"many pieces", {"naca:0012:60"}, small([](CaseOptions&) {})},
        {"few pieces", {"naca:0012:60"}, quick_options(6)},
        {"quads", {"naca:4412:60"}, small([](CaseOptions& o) { o.layer.topology = LayerTopology::quads; })},
        {"Delaunay layers", {"naca:4412:60"}, small([](CaseOptions& o) {
             o.layer.topology = LayerTopology::delaunay;
         })},
        {"no layers", {"naca:2412:60"}, small([](CaseOptions& o) { o.layer.enabled = false; })},
        {"lattices", {"naca:0012:60"}, small([](CaseOptions& o) {
             o.far_field.shape = FarFieldShape::circle;
             o.sizing.sources.push_back({.a = {2, 0}, .b = {2, 0}, .size = 0.05, .radius = 1.5});
             o.decoupling.pieces_target = 4000;
         })},
        {"ground", {"naca:0012:60"}, small([](CaseOptions& o) {
             o.far_field.ground = 0.1;
             o.far_field.ground_wall = OuterWallKind::moving;
         })},
        {"inlet and outlet", {"naca:0012:60:blunt"}, small([](CaseOptions& o) {
             o.assemble.inlet_outlet = true;
             o.assemble.base_marker = true;
             o.layer.layers.reset();
         })},
    };
}

/// A plate with a slit of 3 degrees, whose layers are thinned: a better mesh replaces the first one.
inline StreamCase thinned_case(const TemporaryFolder& folder) {
    const std::string plate =
        folder.write("plate.dat", "plate\n0 0\n1 0\n1 0.1\n0.606 0.1\n0.1 0.05\n0.6 0.1\n0 0.1\n0 0\n").string();
    CaseOptions options;
    options.far_field.size = 4;
    options.surface.treatment = SurfaceTreatment::keep;  // a fifth of the time of a wall that the slit makes fine
    return {"thinned", {plate}, options};
}

}  // namespace lamina::test
