// The list of what is wrong with a mesh: all are counted, the first few kept.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::mesh {

struct DefectList {
    static constexpr std::size_t most_kept = 20;

    std::vector<MeshDefect> kept;
    std::size_t count = 0;

    bool empty() const { return count == 0; }
    /// describe() -> MeshDefect; called only where there is room.
    template <class F>
    void add(F&& describe) {
        if (count++ < most_kept) kept.push_back(describe());
    }
    void append(DefectList&& other) {
        count += other.count;
        for (MeshDefect& defect : other.kept)
            if (kept.size() < most_kept) kept.push_back(std::move(defect));
    }
};

}  // namespace lamina::mesh
