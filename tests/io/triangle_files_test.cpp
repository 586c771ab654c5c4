// The files of Triangle.
#include <gtest/gtest.h>

#include <cmath>

#include <lamina/error.hpp>
#include <lamina/triangle_files.hpp>

#include "support/temporary_folder.hpp"

namespace lamina::test {
namespace {

const std::string square_poly =
    "# a square\n\n4 2 1 1   # vertices\n0 0 0 7.5 1\n1 1,0 8.5 2\n\t2 1 1 1e-3 0\r\n3 +0 1 -2 5\n"
    "4 1\n0 0 1 10\n1 1 2 0\n2 2 3 11\n3 3 0 12\n1\n0 0.5 0.5\n2\n0 .1 .1 3 0.25\n1 .2 .2 4\n";

TEST(TriangleFiles, ReadsPoly) {
    const TemporaryFolder folder;
    const TriangleInput in = read_triangle_files(folder.write("a.poly", square_poly));
    EXPECT_EQ(in.first_index, 0u);
    EXPECT_EQ(in.points, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(in.attributes, (std::vector<double>{7.5, 8.5, 1e-3, -2}));
    EXPECT_EQ(in.markers, (std::vector<long>{1, 2, 0, 5}));
    ASSERT_EQ(in.segments.size(), 4u);
    EXPECT_EQ(in.segments[3], (Segment{VertexId{3u}, VertexId{0u}}));
    EXPECT_EQ(in.segment_markers, (std::vector<long>{10, 0, 11, 12}));
    EXPECT_EQ(in.holes, (std::vector<Point>{{0.5, 0.5}}));
    ASSERT_EQ(in.regions.size(), 2u);
    EXPECT_EQ(in.regions[0].attribute, 3);
    EXPECT_EQ(in.regions[0].max_area, 0.25);
    EXPECT_EQ(in.regions[1].max_area, 4);
    EXPECT_EQ(in.segment_lines, (std::vector<std::size_t>{9, 10, 11, 12}));
}

TEST(TriangleFiles, VerticesMayStandInTheNodeFile) {
    const TemporaryFolder folder;
    folder.write("a.node", "3 2 0 0\n1 0 0\n2 4 0\n3 0 3\n");
    const TriangleInput in = read_triangle_files(folder.write("a.poly", "0 2 0 0\n1 0\n1 1 3\n0\n"));
    EXPECT_EQ(in.first_index, 1u);
    ASSERT_EQ(in.segments.size(), 1u);
    EXPECT_EQ(in.segments[0], (Segment{VertexId{0u}, VertexId{2u}}));
    EXPECT_TRUE(in.markers.empty());
}

TEST(TriangleFiles, AreReadBackBitForBit) {
    const TemporaryFolder folder;
    for (std::size_t first : {0u, 1u}) {
        TriangleOutput out;
        out.first_index = first;
        for (int i = 0; i < 50; ++i) out.points.push_back({std::sqrt(2.0 + i), 1.0 / (3 + i) * 1e-30});
        out.attribute_count = 2;
        for (int i = 0; i < 100; ++i) out.attributes.push_back(std::cbrt(double(i)));
        out.markers.assign(50, -3);
        for (std::size_t i = 0; i < 49; ++i) out.segments.push_back({VertexId{i}, VertexId{i + 1}});
        out.segment_markers.assign(49, 8);
        out.holes = {{0.1, 0.2}};
        out.regions = {{{0.3, 0.4}, 5, -1}};
        out.triangles = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}};
        out.triangle_attributes = {5};
        write_triangle_files(out, folder / "b.1", true);
        const TriangleInput in = read_triangle_files(folder / "b.1.poly");
        EXPECT_EQ(in.first_index, first);
        EXPECT_EQ(in.points, out.points);
        EXPECT_EQ(in.attributes, out.attributes);
        EXPECT_EQ(in.markers, out.markers);
        EXPECT_EQ(in.segments, out.segments);
        EXPECT_EQ(in.segment_markers, out.segment_markers);
        EXPECT_EQ(in.holes, out.holes);
        EXPECT_EQ(in.regions[0].attribute, 5);
        EXPECT_EQ(folder.read("b.1.ele"), first == 0 ? "1 3 1\n0 0 1 2 5\n" : "1 3 1\n1 1 2 3 5\n");
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"b.1.ele", "b.1.node", "b.1.poly"}));
}

TEST(TriangleFiles, RefusalsNameFileAndLine) {
    const TemporaryFolder folder;
    const auto message = [&](const std::string& name, const std::string& content) -> std::string {
        const std::string file = folder.write(name, content).string();
        try {
            read_triangle_files(file);
        } catch (const Error& e) {
            const std::string what = e.what();
            return what.starts_with(file) ? what.substr(file.size()) : what;
        }
        return "no error";
    };
    EXPECT_EQ(message("a.node", "3 2 0 0\n1 0 0\n2 1 0\n"), ":3: the file ends where a vertex is expected");
    EXPECT_EQ(message("a.node", "2 2 0 0\n1 0 0\n\n2 x 0\n"), ":4: coordinate expected, found 'x'");
    EXPECT_EQ(message("a.node", "2 2 0 0\n1 0 0\n2 1\n"), ":3: coordinate expected");
    EXPECT_EQ(message("a.node", "2 2 0 0\n1 0 0\n2 nan 0\n"), ":3: coordinate is not a finite number");
    EXPECT_EQ(message("a.node", "2 2 0 0\n1 0 0\n3 1 0\n"), ":3: vertex index 3 where 2 is expected");
    EXPECT_EQ(message("a.node", "2 2 0 0\n5 0 0\n6 1 0\n"), ":2: vertices are numbered from 0 or 1, not from 5");
    EXPECT_EQ(message("a.node", "2 3 0 0\n1 0 0 0\n2 1 0 0\n"), ":1: only two-dimensional vertices can be read");
    EXPECT_EQ(message("a.node", "999999999 2 0 0\n1 0 0\n"),
              ":1: number of vertices: 999999999, but the file is shorter than that");
    EXPECT_EQ(message("a.node", "3 2\n1 0 0\n2 1 0\n3 0 0\n"),
              ":4: vertices 3 and 1 (line 2) are the same, which --merge takes for one (at 0, 0)");
    EXPECT_EQ(message("a.node", "1 2\n1 0 0\n2 0 1\n"), ":3: something follows the last vertex");
    const std::string two = "2 2 0 0\n1 0 0\n2 1 0\n";
    EXPECT_EQ(message("a.poly", two), ":3: the file ends where the number of segments is expected");
    EXPECT_EQ(message("a.poly", two + "1 0\n1 1 3\n0\n"), ":5: vertex index 3, but vertices are numbered from 1 to 2");
    EXPECT_EQ(message("a.poly", two + "1 0\n1 1 2 9\n0\n"), ":5: end of line expected, found '9'");
    EXPECT_THROW(read_triangle_files(folder / "missing.poly"), IoError);
    EXPECT_THROW(read_triangle_files(folder.write("a.txt", two)), UsageError);
}

TEST(TriangleFiles, OutputThatContradictsItselfIsRefused) {
    const TemporaryFolder folder;
    TriangleOutput good;
    good.points = {{0, 0}, {1, 0}, {0, 1}};
    good.markers = {0, 0, 0};
    good.triangles = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}};
    good.segments = {{VertexId{0u}, VertexId{1u}}};
    good.segment_markers = {0};
    const auto expect_unwritten = [&](auto&& spoil, bool also_by_mark_boundary) {
        TriangleOutput bad = good;
        spoil(bad);
        EXPECT_THROW(write_triangle_files(bad, folder / "bad", true), InputError);
        if (also_by_mark_boundary) {
            EXPECT_THROW(mark_boundary(bad), InputError);
        }
    };
    expect_unwritten([](TriangleOutput& o) { o.triangles[0].v[1] = VertexId{3u}; }, true);
    expect_unwritten([](TriangleOutput& o) { o.segments[0].b = VertexId{7u}; }, true);
    expect_unwritten([](TriangleOutput& o) { o.markers.pop_back(); }, true);
    expect_unwritten([](TriangleOutput& o) { o.segment_markers.push_back(1); }, true);
    expect_unwritten([](TriangleOutput& o) { o.attribute_count = 1; }, false);
    expect_unwritten([](TriangleOutput& o) { o.triangle_attributes = {1, 2}; }, false);
    expect_unwritten([](TriangleOutput& o) { o.edges = {{VertexId{0u}, VertexId{9u}}}; }, false);
    expect_unwritten([](TriangleOutput& o) { o.points[2].x = std::nan(""); }, false);
    expect_unwritten([](TriangleOutput& o) { o.holes = {{0, HUGE_VAL}}; }, false);
    expect_unwritten([](TriangleOutput& o) { o.regions = {{{0, 0}, 1, std::nan("")}}; }, false);
    expect_unwritten([](TriangleOutput& o) { o.first_index = 2; }, false);
    mark_boundary(good);
    EXPECT_EQ(good.markers, (std::vector<long>{1, 1, 1}));
    write_triangle_files(good, folder / "good", true);
}

}  // namespace
}  // namespace lamina::test
