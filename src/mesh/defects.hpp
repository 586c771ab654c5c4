// The list of the defects of a mesh: it counts all and keeps the first few.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::mesh {

struct DefectList {
    static constexpr std::size_t max_kept = 20;

    std::vector<MeshDefect> kept;
    std::size_t count = 0;

    bool empty() const { return count == 0; }
    /// Adds a defect. Calls describe(), which returns a MeshDefect, only where there is room to keep it.
    template <class F>
    void add(F&& describe) {
        if (count++ < max_kept) kept.push_back(describe());
    }
    void append(DefectList&& other) {
        count += other.count;
        for (MeshDefect& defect : other.kept)
            if (kept.size() < max_kept) kept.push_back(std::move(defect));
    }
};

}  // namespace lamina::mesh
