// Triangulates a million points and checks the number of triangles by Euler's formula.
#include <cstdint>
#include <cstdio>
#include <vector>

#include <lamina/delaunay.hpp>

int main() {
    std::vector<lamina::Point> points;
    std::uint64_t state = 1;
    const auto random = [&] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state >> 11) * 0x1p-53;
    };
    for (int i = 0; i < 1'000'000; ++i) {
        const double x = random();
        points.push_back({x, random()});
    }
    for (const lamina::Point corner : {lamina::Point{-1, -1}, {2, -1}, {2, 2}, {-1, 2}}) points.push_back(corner);
    const lamina::Triangulation t = lamina::triangulate(points);
    std::printf("%zu triangles in %zu pieces\n", t.triangles.size(), t.decomposition.pieces);
    return t.triangles.size() == 2 * points.size() - 2 - 4 ? 0 : 1;
}
