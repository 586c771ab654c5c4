// The search for the number of vertices of the next mesh.
#pragma once

#include <cmath>
#include <cstddef>

#include <lamina/solution_sizes.hpp>

namespace lamina::adaptation {

/// Finds the factor of all sizes with which the mesh has the number of vertices asked for.
class FactorSearch {
public:
    FactorSearch(double vertices, double first) : wanted_(vertices), factor_(first) {}

    /// Returns whether a mesh with factor() should be made.
    bool goes_on() const;
    double factor() const { return factor_; }
    /// Notes the number of vertices with factor(), and chooses the next one. Returns whether this mesh is the best so
    /// far.
    bool note(std::size_t vertices);
    /// Throws OptionError where the best mesh has another number of vertices than asked for.
    void require_found(const SolutionSizeOptions& options) const;
    /// Returns the number of vertices of the best mesh.
    std::size_t vertices() const { return vertices_; }
    /// Returns the number of meshes that were made.
    int rounds() const { return rounds_; }

private:
    struct End {
        double at = 0, miss = 0;
        bool known = false;
    };
    double wanted_, factor_, best_ = HUGE_VAL;
    std::size_t vertices_ = 0;
    int rounds_ = 0;
    double step_ = 0;            ///< the last one, while only one end is known
    End low_, high_;             ///< logarithms of factors with too many and too few vertices
    const End* last_ = nullptr;  ///< the one that was replaced last
};

}  // namespace lamina::adaptation
