// RingRegions: the borders that tracing finds, without tracing.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "decoupling/rings.hpp"
#include "decoupling/skeleton.hpp"

namespace lamina::test {
namespace {

using decoupling::Ring;

TEST(RingRegions, AreThoseThatTracingFinds) {
    const decoupling::RingBoxes boxes{{{-1, -1}, {2, 1.5}}, {{-9, -11}, {10, 12}}};
    const std::vector<std::vector<Ring>> cases{{{0, 1, 1}},
                                               {{0, 0.3, 2}, {0.3, 1, 2}},
                                               {{0, 0.1, 4}, {0.1, 0.2, 2}, {0.2, 0.5, 2}, {0.5, 0.7, 8}, {0.7, 1, 1}}};
    for (const std::vector<Ring>& rings : cases) {
        SCOPED_TRACE(rings.size());
        decoupling::Skeleton skeleton(std::vector<Point>{}), traced(std::vector<Point>{});
        const std::vector<std::uint32_t> outermost = decoupling::add_rings(skeleton, rings, boxes, false);
        const decoupling::Lines& lines = skeleton.lines;
        for (std::size_t i = 0; i < lines.junctions(); ++i)
            traced.add_junction(lines.point(decoupling::LineVertex{VertexId{i}}));
        // The same lines, with regions on both sides of all but the outermost ones.
        for (std::uint32_t line = 0; line < lines.size(); ++line) {
            const auto [from, to] = lines.ends(line);
            const bool is_outermost = line >= outermost.front() && line <= outermost.back();
            traced.add_line(from.id, to.id, 3, {true, !is_outermost});
        }
        for (std::uint32_t line = 0; line < lines.size(); ++line) {
            const std::size_t interior = 2 + line * 7 % 5;
            skeleton.lines.number(line, interior);
            traced.lines.number(line, interior);
        }
        const std::vector<decoupling::LineBorder> all = traced.trace(), untraced = skeleton.trace();
        ASSERT_EQ(all.size(), 1 + skeleton.rings.size());
        ASSERT_EQ(untraced.size(), 1u);
        EXPECT_EQ(untraced.front().loops, all.front().loops);
        for (std::size_t i = 0; i < skeleton.rings.size(); ++i) {
            const decoupling::LineBorder border = skeleton.rings.border(i, lines);
            EXPECT_EQ(border.loops, all[i + 1].loops) << i;
            EXPECT_EQ(border.vertices(), skeleton.rings.vertices(i, lines)) << i;
            std::size_t segments = 0;
            skeleton.rings.for_lines(i, [&](std::uint32_t line) { segments += lines.segments(line); });
            EXPECT_EQ(segments, border.vertices()) << i;
        }
    }
}

}  // namespace
}  // namespace lamina::test
