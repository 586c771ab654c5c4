// The work of references.hpp done by CDT.
#include <vector>

#include <CDT.h>

#include "references.hpp"

namespace lamina::bench {

Work cdt_constrained(std::span<const Point> points, std::span<const Segment> segments) {
    std::vector<CDT::V2d<double>> vertices;
    for (const Point p : points) vertices.push_back({p.x, p.y});
    std::vector<CDT::Edge> edges;
    for (const Segment s : segments)
        edges.emplace_back(static_cast<CDT::VertInd>(s.a.index()), static_cast<CDT::VertInd>(s.b.index()));
    return [vertices, edges] {
        CDT::Triangulation<double> triangulation;
        triangulation.insertVertices(vertices);
        if (!edges.empty()) triangulation.insertEdges(edges);
        triangulation.eraseSuperTriangle();
        return triangulation.triangles.size();
    };
}

}  // namespace lamina::bench
