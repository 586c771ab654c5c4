// Faces between cells are nearly orthogonal to the lines between the cells' centroids, as cell-centred solvers want it.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

using shapes::Outline;

Point centroid(const std::vector<Point>& cell) {
    double area = 0;
    Point sum{0, 0};
    for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
        const Point a = cell[i] - cell[0], b = cell[i + 1] - cell[0];
        const double twice = a.x * b.y - a.y * b.x;
        area += twice;
        sum = sum + twice / 3 * (a + b);
    }
    return cell[0] + 1 / area * sum;
}

struct FaceQuality {
    double max_non_orthogonality_deg = 0;  ///< angle between the normal of a face and the line between the centroids
    /// Distance from the middle of a face to that line, over a fifth of the line's length, or over half of the face's
    /// length if that is more.
    double max_skewness = 0;
};

/// Measures the inner faces of a mesh as OpenFOAM's checkMesh does.
FaceQuality face_quality(const Mesh& mesh) {
    std::map<std::pair<std::size_t, std::size_t>, Point> centroid_beside;
    FaceQuality quality;
    const auto add = [&](const auto& vertices) {
        std::vector<Point> cell;
        for (const VertexId v : vertices) cell.push_back(mesh.points[v.index()]);
        const Point own = centroid(cell);
        for (std::size_t i = 0; i < cell.size(); ++i) {
            const std::size_t next = (i + 1) % cell.size(), a = vertices[i].index(), b = vertices[next].index();
            if (const auto other = centroid_beside.find({b, a}); other != centroid_beside.end()) {
                const Point across = other->second - own, along = cell[next] - cell[i];
                const double sine = across.x * along.x + across.y * along.y,
                             cosine = across.x * along.y - across.y * along.x;
                quality.max_non_orthogonality_deg = std::max(
                    quality.max_non_orthogonality_deg, core::degrees(std::atan2(std::abs(sine), std::abs(cosine))));
                // The line crosses that of the face this far from its middle.
                const Point to_middle = 0.5 * (cell[i] + cell[next]) - own;
                const double off = std::abs((to_middle.x * across.y - to_middle.y * across.x) / cosine);
                const double length_of_face = length(along);
                quality.max_skewness = std::max(
                    quality.max_skewness, off * length_of_face / std::max(0.2 * length(across), 0.5 * length_of_face));
            }
            centroid_beside.emplace(std::pair{a, b}, own);
        }
    };
    for (const auto& triangle : mesh.triangles) add(triangle.v);
    for (const auto& quad : mesh.quads) add(quad.v);
    return quality;
}

CaseOptions quads_for_flow(double alpha_deg) {
    CaseOptions options;
    options.conditions = {.alpha_deg = alpha_deg, .reynolds = 6e6};
    options.layer.first_height = YPlus{1};
    options.layer.layers.reset();
    options.layer.topology = LayerTopology::quads;
    options.far_field.size = 20;
    options.use_flow = true;
    return options;
}

/// Columns up to isotropy differ in their number of layers, and are stretched to end at one height. Where all of a
/// column was stretched, rows at the wall were 67 degrees from orthogonal beside changes of the number.
TEST(Orthogonality, QuadrilateralsOfLayersUpToIsotropy) {
    for (const auto& [outline, alpha] :
         {std::pair<Outline, double>{naca("0012", 200), 0}, {naca("0012", 200), 10}, {naca("4412", 200), 4}}) {
        const CaseOptions options = quads_for_flow(alpha);
        const MeshResult result = mesh_of({outline}, options);
        expect_sound(result, options);
        EXPECT_LT(face_quality(result.mesh).max_non_orthogonality_deg, 55) << "alpha " << alpha;
    }
}

/// Where a cove or another element cuts layers short, numbers of layers change on narrow columns beside rays that lean,
/// and the border divides the tops of high cells: faces were up to 63 degrees from orthogonal there.
TEST(Orthogonality, QuadrilateralsOfThreeElements) {
    const std::filesystem::path folder = LAMINA_SOURCE_DIR "/examples/geometry";
    std::vector<std::string> files;
    for (const char* name : {"slat", "main", "flap"})
        files.push_back((folder / (std::string("crmhl2d_") + name + ".dat")).string());
    CaseOptions options = quads_for_flow(16);
    options.conditions.chord = 1;
    options.conditions.reynolds = 5e6;
    options.surface.max_spacing = 0.01;
    const MeshResult result = generate_mesh(files, options);
    expect_sound(result, options);
    const FaceQuality quality = face_quality(result.mesh);
    EXPECT_LT(quality.max_non_orthogonality_deg, 70);  // beyond, solvers need more corrections
    EXPECT_LT(quality.max_skewness, 0.8);
}

/// At the corners of bases rows turn by 90 degrees. Where they did so at one ray, skewness was 2.2.
TEST(Orthogonality, SkewnessAtTheCornersOfBases) {
    for (const char* digits : {"0012", "2412"}) {
        SCOPED_TRACE(digits);
        const CaseOptions options = quads_for_flow(4);
        const MeshResult result = mesh_of({naca(digits, 200, TrailingEdge::blunt)}, options);
        expect_sound(result, options);
        const FaceQuality quality = face_quality(result.mesh);
        EXPECT_LT(quality.max_skewness, 0.9);
        EXPECT_LT(quality.max_non_orthogonality_deg, 62);
    }
}

}  // namespace
}  // namespace lamina::test
