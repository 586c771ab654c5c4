// Meshes moved to other shapes, and the derivative of the places of their vertices.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <lamina/error.hpp>
#include <lamina/morph.hpp>
#include <lamina/remesh.hpp>

#include "arrays.hpp"
#include "bindings.hpp"
#include "interruption.hpp"
#include "sections.hpp"
#include "shared_mesh.hpp"

namespace lamina::python {

namespace {

/// A map with its reference mesh.
class SharedMorphMap {
public:
    explicit SharedMorphMap(const SharedMesh& mesh) : mesh_(mesh) {
        require_straight(mesh, "morphing");
        run_unlocked([&] {
            require_valid(*mesh_);
            map_.emplace(*mesh_);
        });
    }

    ReadOnlyArray<std::uint32_t> wall() const { return owning_array<std::uint32_t>(map_->walls().vertex); }
    ReadOnlyArray<double> wall_points() const { return owning_array<double>(map_->wall_points()); }

    ReadOnlyArray<double> positions(const PointsArgument& wall) const {
        return computed([&, at = at_walls(wall)] { return map_->positions(at); });
    }
    ReadOnlyArray<double> jacobian_vector(const PointsArgument& wall, const PointsArgument& direction) const {
        return computed(
            [&, at = at_walls(wall), along = at_walls(direction)] { return map_->jacobian_vector(at, along); });
    }
    ReadOnlyArray<double> vector_jacobian(const PointsArgument& wall, const PointsArgument& gradient) const {
        require_rows(gradient.shape(0), (*mesh_).points.size(), "vertices of the mesh");
        return computed([&, at = at_walls(wall), by = points_of(gradient)] { return map_->vector_jacobian(at, by); });
    }
    ReadOnlyArray<double> walls_on(const nb::list& sections) const {
        return computed([&, given = sections_of(sections)] { return wall_points_on(*map_, geometry_of(given, {})); });
    }
    ReadOnlyArray<double> walls_moved(const std::vector<std::string>& changes) const {
        std::vector<Transformation> transformations;
        for (const std::string& change : changes) transformations.push_back(parse_transformation(change));
        return computed([&] { return moved_wall_points(*map_, transformations); });
    }

    /// Returns the mesh, the fraction of the motion that was made, the number of maps that made it, and the text of the
    /// cell that stops it.
    nb::tuple morph(const PointsArgument& wall, bool as_far_as_possible, bool incremental, bool reconnects) const {
        MorphResult result;
        const std::vector<Point> at = at_walls(wall);
        run_unlocked([&] { result = lamina::morph(*map_, at, {as_far_as_possible, incremental}); });
        Mesh morphed = *mesh_;
        morphed.points = std::move(result.points);
        if (reconnects) run_unlocked([&] { morphed = reconnect(morphed); });
        return nb::make_tuple(shared(std::move(morphed)), result.fraction, result.maps,
                              result.stop ? result.stop->description : std::string());
    }

    nb::dict compare(const SharedMesh& morphed) const {
        require_rows((*morphed).points.size(), (*mesh_).points.size(), "vertices of the mesh");
        MorphReport report;
        run_unlocked([&] { report = compare_morphed(*map_, *morphed); });
        nb::dict facts;
        facts["max_first_height_change"] = report.max_first_height_change;
        for (const auto& [name, quality] : {std::pair{"before", report.before}, {"after", report.after}}) {
            nb::dict part;
            part["min_angle"] = quality.min_angle_deg;
            part["mean_min_angle"] = quality.mean_min_angle_deg;
            part["min_scaled_jacobian"] = quality.min_scaled_jacobian;
            facts[name] = part;
        }
        return facts;
    }

private:
    SharedMesh mesh_;
    std::optional<MorphMap> map_;

    static void require_rows(std::size_t given, std::size_t needed, const char* what) {
        if (given != needed) throw InputError({}, fmt::format("{} points for the {} {}", given, needed, what));
    }
    std::vector<Point> at_walls(const PointsArgument& points) const {
        require_rows(points.shape(0), map_->wall_points().size(), "wall vertices of the mesh");
        return points_of(points);
    }
    template <class F>
    static ReadOnlyArray<double> computed(F&& f) {
        std::vector<Point> points;
        run_unlocked([&] { points = f(); });
        return owning_array<double>(std::move(points));
    }
};

}  // namespace

void add_morphing(nb::module_& module) {
    nb::class_<SharedMorphMap>(module, "MorphMap")
        .def(nb::init<const SharedMesh&>())
        .def("wall", &SharedMorphMap::wall)
        .def("wall_points", &SharedMorphMap::wall_points)
        .def("positions", &SharedMorphMap::positions)
        .def("jacobian_vector", &SharedMorphMap::jacobian_vector)
        .def("vector_jacobian", &SharedMorphMap::vector_jacobian)
        .def("walls_on", &SharedMorphMap::walls_on)
        .def("walls_moved", &SharedMorphMap::walls_moved)
        .def("morph", &SharedMorphMap::morph)
        .def("compare", &SharedMorphMap::compare);
}

}  // namespace lamina::python
