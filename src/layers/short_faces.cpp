// The rays of a short face lean out of the concave corner at its foot, and those of the fan at its top lean with them. If
// they were parallel to each other, their columns would be as narrow at the front as the face is divided, which is far
// finer than the walls beside it. So they open, as far as rays may lean from the normals at both ends:
//
//      front      / / / / / /                  front    /   /  /  / / /
//                / / / / / /                           /  /  /  / / /
//     ----------o / / / / /     fan at the top    ----o  / /  / / /
//               |/ / / / /                            | / / / / /
//          face | / / / /                             |/ / / / /
//               |/ / / /                              |/// / /
//               o--------------  foot                 o--------------
//            parallel rays                         rays that open
//
// docs/decisions/0065
#include "layers/short_faces.hpp"

#include <algorithm>
#include <numeric>

#include "core/angles.hpp"
#include "layers/mechanisms.hpp"
#include "layers/outline_walk.hpp"

namespace lamina::layers {

namespace {

/// The foot of a face is where the wall turns inwards by more than this.
constexpr double min_foot_deg = 20;
/// The rays of a face open by this at most, and by this share of the fan's angle, which must have rays of its own still.
constexpr double max_face_opening_deg = 15, opened_share_of_fan = 0.27;
/// Columns of a face open until they are this share of their height wide.
constexpr double min_column_width = 1.0 / 25;

bool is_foot(const WallVertex& vertex) { return vertex.turning < -core::radians(min_foot_deg); }

/// Returns the angles that the columns of a face lack, one per edge from its foot on. Empty if no fan is near.
std::vector<double> lacking_angles(const OutlineWalk& walk, std::span<const RayVertex> outline,
                                   std::span<const WallVertex> vertices) {
    double length = 0;
    std::vector<double> lacking;
    for (std::size_t k = 1; k < walk.size && !is_foot(vertices[walk.vertex(k)]); ++k) {
        const RayVertex& vertex = outline[walk.vertex(k)];
        const double edge = distance(outline[walk.vertex(k - 1)].at, vertex.at);
        length += edge;
        if (!(length < vertex.least_height)) break;
        lacking.push_back(std::max(0.0, min_column_width - edge / vertex.least_height));
        if (vertices[walk.vertex(k)].fan) return lacking;
    }
    return {};
}

}  // namespace

std::vector<double> openings_on_short_faces(std::span<const RayVertex> outline, std::span<const WallVertex> vertices) {
    std::vector<double> openings(outline.size(), 0.0);
    if (!uses("short_faces")) return openings;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        if (!is_foot(vertices[i])) continue;
        for (const bool ahead : {false, true}) {
            const OutlineWalk walk{outline.size(), i, ahead};
            const std::vector<double> lacking = lacking_angles(walk, outline, vertices);
            if (lacking.empty()) continue;
            const double of_fan = opened_share_of_fan * vertices[walk.vertex(lacking.size())].turning;
            const double of_foot = 2 * core::radians(max_angle_from_normal_deg) + vertices[i].turning;
            const double most = std::clamp(std::min(of_fan, of_foot), 0.0, core::radians(max_face_opening_deg));
            const double share = std::min(1.0, most / std::accumulate(lacking.begin(), lacking.end(), 0.0));
            for (std::size_t k = 0; k < lacking.size(); ++k) openings[walk.edge(k + 1)] = share * lacking[k];
        }
    }
    return openings;
}

}  // namespace lamina::layers
