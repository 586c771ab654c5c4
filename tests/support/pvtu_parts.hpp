// The parts of a PVTU file as one mesh again.
#pragma once

#include <cstdint>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <lamina/io.hpp>

#include "support/temporary_folder.hpp"

namespace lamina::test {

/// Returns the point data `vertex` of a raw VTU file.
inline std::vector<std::int64_t> vertices_of(const std::string& file, std::size_t count) {
    const std::size_t tag = file.find("Name=\"vertex\""), attribute = file.find("offset=\"", tag) + 8;
    const std::size_t data = file.find('_', file.find("<AppendedData")) + 1 + std::stoul(file.substr(attribute));
    std::vector<std::int64_t> vertices(count);
    std::memcpy(vertices.data(), file.data() + data + 8, count * sizeof(std::int64_t));
    return vertices;
}

/// Returns the files that a list names.
inline std::vector<std::string> sources_of(const std::string& list) {
    std::vector<std::string> sources;
    for (std::size_t at = list.find("Source=\""); at != std::string::npos; at = list.find("Source=\"", at)) {
        at += 8;
        sources.push_back(list.substr(at, list.find('"', at) - at));
    }
    return sources;
}

/// Returns the mesh that the parts make together. Throws where a vertex is missing or two parts have it at two places.
inline Mesh join_parts(const TemporaryFolder& folder, const std::string& name) {
    Mesh joined;
    std::vector<bool> known;
    for (const std::string& source : sources_of(folder.read(name))) {
        const Mesh part = read_mesh(folder / source);
        const std::vector<std::int64_t> vertices = vertices_of(folder.read(source), part.points.size());
        const auto global = [&](VertexId v) { return VertexId{static_cast<std::size_t>(vertices.at(v.index()))}; };
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const std::size_t v = global(VertexId{i}).index();
            if (v >= known.size()) {
                known.resize(v + 1, false);
                joined.points.resize(v + 1);
            }
            if (known[v] && !(joined.points[v] == part.points[i])) throw std::runtime_error("a vertex at two places");
            known[v] = true;
            joined.points[v] = part.points[i];
        }
        for (const Triangle& t : part.triangles)
            joined.triangles.push_back({global(t.v[0]), global(t.v[1]), global(t.v[2])});
        for (const Quad& q : part.quads)
            joined.quads.push_back({{global(q.v[0]), global(q.v[1]), global(q.v[2]), global(q.v[3])}});
        if (joined.markers.empty())
            for (const Marker& marker : part.markers) joined.markers.push_back({marker.name, marker.kind, {}});
        for (std::size_t m = 0; m < part.markers.size(); ++m)
            for (const Segment& edge : part.markers[m].edges)
                joined.markers.at(m).edges.push_back({global(edge.a), global(edge.b)});
    }
    for (const bool is_known : known)
        if (!is_known) throw std::runtime_error("a vertex is missing");
    return joined;
}

}  // namespace lamina::test
