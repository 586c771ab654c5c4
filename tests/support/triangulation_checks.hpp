// Checks of triangulations that tests share.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/triangulation.hpp>

namespace lamina::test {

/// Fails the test for every defect that check_triangulation() finds.
inline void expect_valid(const std::vector<Point>& points, const std::vector<Triangle>& triangles,
                         const std::vector<Segment>& constraints = {}) {
    for (const std::string& defect : check_triangulation(points, triangles, constraints)) ADD_FAILURE() << defect;
}

}  // namespace lamina::test
