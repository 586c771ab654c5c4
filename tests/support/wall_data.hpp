// Reads the table of the walls.
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::test {

/// A row of the table.
struct WallRow {
    std::string marker;
    std::size_t vertex = 0;
    Point at, normal;
    double arc_length = 0, first_height = 0;
};

inline std::vector<WallRow> read_wall_rows(const std::string& text) {
    std::istringstream in(text);
    std::string line, comma;
    std::getline(in, line);
    EXPECT_EQ(line, "marker,vertex,x,y,arc_length,normal_x,normal_y,first_height");
    std::vector<WallRow> rows;
    while (std::getline(in, line)) {
        WallRow row;
        std::istringstream cells(line);
        std::getline(cells, row.marker, ',');
        char c;
        cells >> row.vertex >> c >> row.at.x >> c >> row.at.y >> c >> row.arc_length >> c >> row.normal.x >> c >>
            row.normal.y >> c >> row.first_height;
        EXPECT_FALSE(cells.fail()) << line;
        rows.push_back(row);
    }
    return rows;
}

}  // namespace lamina::test
