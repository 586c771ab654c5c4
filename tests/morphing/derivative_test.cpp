// The derivative of morphed places, against differences, and both of its products against each other.
#include <lamina/morph.hpp>

#include <gtest/gtest.h>

#include "morphing/morphing_fixtures.hpp"

namespace lamina::test {

namespace {

/// Returns the derivative of the places in a direction by Richardson's extrapolation of central differences, whose
/// error is of the sixth order in the step.
std::vector<Point> difference(const MorphMap& map, const std::vector<Point>& wall, const std::vector<Point>& direction,
                              double step) {
    const auto central = [&](double h) {
        std::vector<Point> ahead = wall, behind = wall;
        for (std::size_t i = 0; i < wall.size(); ++i) {
            ahead[i] = wall[i] + h * direction[i];
            behind[i] = wall[i] - h * direction[i];
        }
        std::vector<Point> result = map.positions(ahead);
        const std::vector<Point> other = map.positions(behind);
        for (std::size_t v = 0; v < result.size(); ++v) result[v] = (0.5 / h) * (result[v] - other[v]);
        return result;
    };
    std::vector<Point> whole = central(step);
    const std::vector<Point> half = central(0.5 * step), quarter = central(0.25 * step);
    for (std::size_t v = 0; v < whole.size(); ++v) whole[v] = (1.0 / 45) * (64 * quarter[v] - 20 * half[v] + whole[v]);
    return whole;
}

double largest_difference(const std::vector<Point>& a, const std::vector<Point>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, distance(a[i], b[i]));
    return largest;
}

double scalar_product(const std::vector<Point>& a, const std::vector<Point>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
    return sum;
}

/// Returns random vectors of lengths up to 1.
std::vector<Point> random_vectors(std::size_t n, core::Random& random) {
    std::vector<Point> vectors;
    for (std::size_t i = 0; i < n; ++i) vectors.push_back({random.real(-1, 1), random.real(-1, 1)});
    return vectors;
}

TEST(MorphDerivative, AgreesWithDifferences) {
    const Mesh mesh = mesh_to_morph({"naca:0012:60"});
    const MorphMap map(mesh);
    const std::vector<Point> wall = deformed_walls(map, 1.1, 0.01);
    for (int k = 1; k <= 3; ++k) {
        const std::vector<Point> direction = moved_walls(map, [&](Point p) {
            return Point{0.1 * k * p.y, p.x * p.x * (k - p.x) + 0.3 * p.y};
        });
        const std::vector<Point> exact = map.jacobian_vector(wall, direction);
        EXPECT_LT(largest_difference(exact, difference(map, wall, direction, 4e-3)), 1e-8);
    }
}

/// Returns the walls of two sections with the second one turned and moved, which narrows the slot between them.
std::vector<Point> narrowed_slot(const MorphMap& map) {
    return moved_walls(map, [](Point p) {
        return p.x < 1.005 ? p : Point{p.x - 0.002, p.y + 0.05 * (p.x - 1.1) + 0.002};
    });
}

TEST(MorphDerivative, AgreesWithDifferencesInSlots) {
    const Mesh mesh = mesh_with_slot();
    const MorphMap map(mesh);
    const std::vector<Point> wall = narrowed_slot(map);
    expect_valid(map, morph(map, wall).points);
    const std::vector<Point> direction = moved_walls(map, [&](Point p) {
        return p.x < 1.005 ? Point{p.y, -0.2 * p.x} : Point{p.y - 0.3, p.x};
    });
    EXPECT_LT(largest_difference(map.jacobian_vector(wall, direction), difference(map, wall, direction, 1e-3)), 1e-8);
}

/// Expects the same of a gradient times the derivative times a direction from both sides.
void expect_products_agree(const MorphMap& map, const std::vector<Point>& wall) {
    const Mesh& mesh = map.reference();
    core::Random random(1);
    for (int k = 0; k < 10; ++k) {
        const std::vector<Point> direction = random_vectors(wall.size(), random);
        const std::vector<Point> gradient = random_vectors(mesh.points.size(), random);
        const double jv = scalar_product(gradient, map.jacobian_vector(wall, direction));
        const double vj = scalar_product(map.vector_jacobian(wall, gradient), direction);
        EXPECT_NEAR(jv, vj,
                    1e-12 * std::sqrt(scalar_product(gradient, gradient) * scalar_product(direction, direction)));
    }
}

TEST(MorphDerivative, ProductsFromBothSidesAgree) {
    const Mesh mesh = mesh_with_slot();
    const MorphMap map(mesh);
    expect_products_agree(map, narrowed_slot(map));
}

TEST(MorphDerivative, IsThatOfVerticesThatSlide) {
    const Mesh mesh = mesh_over_ground();
    const MorphMap map(mesh);
    const std::vector<Point> wall = deformed_walls(map, 1.1, 0.01);
    expect_products_agree(map, wall);
    const std::vector<Point> direction = moved_walls(map, [](Point p) { return Point{1 + p.y, p.x * p.x}; });
    EXPECT_LT(largest_difference(map.jacobian_vector(wall, direction), difference(map, wall, direction, 1e-3)), 1e-8);
}

}  // namespace

}  // namespace lamina::test
