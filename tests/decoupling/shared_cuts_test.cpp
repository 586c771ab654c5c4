// cut_region() on several ranks: the borders of one process, whatever the number of ranks. Threads stand in for
// processes.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lamina/decoupling.hpp>

#include "core/difference_packing.hpp"
#include "decoupling/cut_region.hpp"
#include "decoupling/far_field.hpp"
#include "decoupling/lines.hpp"
#include "decoupling/shared_search.hpp"
#include "support/thread_ranks.hpp"

namespace lamina::test {
namespace {

/// Discs, with a source for each edge of their borders.
struct Discs {
    std::vector<Point> points;
    std::vector<std::vector<VertexId>> borders;
    std::vector<SizeSource> sources;

    void add(std::size_t n, Point center, double radius) {
        auto& border = borders.emplace_back();
        const auto at = [&](std::size_t i) {
            const double angle = 2 * std::numbers::pi * double(i % n) / double(n);
            return center + radius * Point{std::cos(angle), std::sin(angle)};
        };
        for (std::size_t i = 0; i < n; ++i) {
            border.push_back(VertexId{points.size()});
            points.push_back(at(i));
            sources.push_back({at(i), at(i + 1), distance(at(i), at(i + 1))});
        }
    }
};

struct CutCase {
    std::string name;
    Discs discs;
    FarField far_field;
    double gradation, pieces_target;
};

std::vector<CutCase> cut_cases() {
    Discs one, three;
    one.add(90, {0.5, 0}, 0.5);
    three.add(120, {0.5, 0}, 0.5);
    three.add(40, {1.4, 0.2}, 0.1);
    three.add(60, {-0.5, -0.4}, 0.2);
    return {{"box", one, {FarFieldShape::box, {0.5, 0}, 20}, 0.06, 400},
            {"circle", one, {FarFieldShape::circle, {0.5, 0}, 12}, 0.08, 500},
            {"several bodies", three, {FarFieldShape::box, {0.5, 0}, 20}, 0.07, 700},
            {"no rings", three, {FarFieldShape::box, {0.5, 0}, 1.7}, 0.1, 300},
            {"one piece", one, {FarFieldShape::box, {0.5, 0}, 5}, 0.2, 1e9}};
}

SizeField size_of(const CutCase& c) {
    const double half = c.far_field.radius;
    return {c.discs.sources, {.gradation = c.gradation}, {{0.5 - half, -half}, {0.5 + half, half}}};
}

/// Returns all vertices, each where its line has it.
std::vector<Point> points_of(decoupling::CutRegion& cut, const SizeField& size) {
    for (std::uint32_t line = 0; line < cut.lines.size(); ++line)
        if (!cut.lines.is_loop(line)) cut.lines.divide(line, size);
    std::vector<Point> points(cut.lines.vertices());
    cut.lines.copy_points(points);
    return points;
}

void expect_equal(const decoupling::CutRegion& one, const decoupling::CutRegion& other) {
    EXPECT_EQ(one.far_field, other.far_field);
    EXPECT_EQ(one.separator_vertices, other.separator_vertices);
    ASSERT_EQ(one.borders.size(), other.borders.size());
    for (std::size_t i = 0; i < one.borders.size(); ++i) {
        EXPECT_EQ(one.border(i).loops, other.border(i).loops) << i;
        EXPECT_EQ(one.border(i).may_dangle, other.border(i).may_dangle) << i;
        const decoupling::WorkEstimate& exact = *one.borders[i].estimate;
        const decoupling::WorkEstimate* told = other.borders[i].estimate.get();
        if (told) {
            EXPECT_EQ(exact.triangles, told->triangles) << i;
            EXPECT_EQ(exact.lattice, told->lattice) << i;
        }
        // What all ranks know.
        EXPECT_NEAR(exact.triangles, other.borders[i].work, 0.07 * exact.triangles) << i;
    }
}

/// Returns how many lines are divided.
std::size_t divided(const decoupling::CutRegion& cut) {
    std::size_t sum = 0;
    for (std::uint32_t line = 0; line < cut.lines.size(); ++line) sum += cut.lines.is_divided(line);
    return sum;
}

TEST(SharedCuts, AreThoseOfOneProcess) {
    for (const CutCase& c : cut_cases()) {
        SCOPED_TRACE(c.name);
        const SizeField size = size_of(c);
        const DecouplingOptions options{c.pieces_target};
        const decoupling::OuterRegion region{c.discs.points, c.discs.borders, size, c.far_field, options};
        decoupling::CutRegion alone = decoupling::cut_region(region);
        const std::size_t lines = alone.lines.size();
        EXPECT_EQ(divided(alone), lines);
        const std::vector<Point> points = points_of(alone, size);
        EXPECT_EQ(alone.borders.size() > 10, c.name != "one piece") << alone.borders.size();
        for (const unsigned n : {1u, 2u, 3u, 7u}) {
            SCOPED_TRACE(n);
            std::atomic<std::size_t> bytes = 0;
            EXPECT_EQ(run_ranks(n,
                                [&](core::ConnectedRanks& ranks) {
                                    decoupling::CutRegion cut = decoupling::cut_region(region, &ranks);
                                    expect_equal(alone, cut);
                                    if (n == 7 && lines > 40) {
                                        EXPECT_LT(divided(cut), 3 * lines / 4);
                                    }
                                    EXPECT_EQ(points_of(cut, size), points);
                                    bytes += ranks.traffic().bytes;
                                }),
                      "");
            // The ends of a separator, or an estimate, for each border that was searched; and what each collective
            // function asks.
            if (n > 1) {
                EXPECT_LT(bytes, n * (30 * (alone.borders.size() + 1) + 500));
            }
        }
    }
}

/// Ranks of which the first one, which alone cuts, ends its cuts after another one has made a piece.
class SlowCutters : public ThreadRanks {
public:
    using ThreadRanks::ThreadRanks;
    static inline std::atomic<bool> made = false;

protected:
    void do_send(unsigned to, std::string_view bytes) override {
        if (rank() == 0) made.wait(false);
        ThreadRanks::do_send(to, bytes);
    }
};

// All ranks know which trapezoids are kept, and those that have become pieces during the cuts were made once, where
// they are kept.
TEST(SharedCuts, LeaveTimeForPieces) {
    const CutCase c = cut_cases()[2];
    const SizeField size = size_of(c);
    const DecouplingOptions options{c.pieces_target};
    const decoupling::OuterRegion region{c.discs.points, c.discs.borders, size, c.far_field, options};
    const decoupling::CutRegion alone = decoupling::cut_region(region);
    constexpr unsigned n = 7;
    std::vector<std::size_t> kept(n, 0);
    std::atomic<std::size_t> made = 0;
    SlowCutters::made = false;
    EXPECT_EQ(
        run_ranks<SlowCutters>(n,
                               [&](core::ConnectedRanks& ranks) {
                                   std::mutex mutex;
                                   std::set<std::uint32_t> own;
                                   decoupling::BesideCuts beside;
                                   bool is_numbered = false;
                                   beside.once_numbered = [&] { is_numbered = true; };
                                   beside.make = [&](std::uint32_t trapezoid, const decoupling::LineBorder& border,
                                                     const decoupling::WorkEstimate&, decoupling::Lines& lines) {
                                       const std::lock_guard lock(mutex);
                                       EXPECT_TRUE(own.insert(trapezoid).second);
                                       const auto vertices = lines.gathered().size();
                                       for (const decoupling::LineLoop& loop : border.loops)
                                           for (const VertexId v : decoupling::ids_of(loop, lines))
                                               EXPECT_LT(v.index(), vertices);
                                       SlowCutters::made = true;
                                       EXPECT_TRUE(is_numbered);
                                       SlowCutters::made.notify_all();
                                   };
                                   const decoupling::CutRegion cut = decoupling::cut_region(region, &ranks, beside);
                                   expect_equal(alone, cut);
                                   std::set<std::uint32_t> known;
                                   for (const decoupling::EstimatedBorder& border : cut.borders)
                                       if (border.kept && border.process == ranks.rank())
                                           known.insert(border.trapezoid);
                                   EXPECT_TRUE(std::includes(known.begin(), known.end(), own.begin(), own.end()));
                                   made += own.size();
                                   for (const decoupling::EstimatedBorder& border : cut.borders)
                                       kept[ranks.rank()] += border.kept;
                               }),
        "");
    EXPECT_GT(made, 0u);
    EXPECT_LT(kept.front(), alone.borders.size());
    EXPECT_EQ(kept, std::vector<std::size_t>(n, kept.front()));
}

TEST(SharedCuts, AreRefusedWhereRanksDiffer) {
    const CutCase c = cut_cases().front();
    const SizeField size = size_of(c);
    const std::string line = run_ranks(3, [&](core::ConnectedRanks& ranks) {
        FarField far_field = c.far_field;
        if (ranks.rank() == 2) far_field.radius *= 0.99;
        const DecouplingOptions options{c.pieces_target};
        decoupling::cut_region({c.discs.points, c.discs.borders, size, far_field, options}, &ranks);
    });
    EXPECT_NE(line.find("process 2 has cut the domain in another way"), std::string::npos) << line;
}

/// Ranks of which one hears that each line has a vertex more than it has. It is found out by whoever divides the line:
/// by this rank, if it cuts regions round the bodies, when it begins to search the first one.
class MisledCutter : public ThreadRanks {
public:
    using ThreadRanks::ThreadRanks;
    static inline unsigned misled = 0;

protected:
    std::vector<std::string> do_all_gather(std::string_view bytes) override {
        std::vector<std::string> told = ThreadRanks::do_all_gather(bytes);
        if (rank() != misled || std::exchange(has_heard_, true)) return told;
        constexpr std::size_t hash_bytes = sizeof(decoupling::LinesHash);
        for (std::string& text : told) {
            core::DifferencePacker packer;
            const auto numbers = std::string_view(text).substr(hash_bytes);
            for (core::DifferenceUnpacker unpacker(numbers); !unpacker.at_end();) packer.put(unpacker.get() + 1);
            text = text.substr(0, hash_bytes) + packer.take();
        }
        return told;
    }

private:
    bool has_heard_ = false;
};

// The other cutters wait for what this one finds, and all other ranks make pieces until the cuts are made.
TEST(SharedCuts, EndOnAllRanksWhereOneOfTheCuttersFails) {
    const CutCase c = cut_cases().front();
    const SizeField size = size_of(c);
    const DecouplingOptions options{c.pieces_target};
    constexpr unsigned n = 12, cutters = 3;
    for (unsigned failing = 0; failing < cutters; ++failing) {
        SCOPED_TRACE(failing);
        MisledCutter::misled = failing;
        const std::string line = run_ranks<MisledCutter>(n, [&](core::ConnectedRanks& ranks) {
            decoupling::BesideCuts beside;
            beside.make = [](std::uint32_t, const decoupling::LineBorder&, const decoupling::WorkEstimate&,
                             decoupling::Lines&) {};
            const decoupling::CutRegion cut =
                decoupling::cut_region({c.discs.points, c.discs.borders, size, c.far_field, options}, &ranks, beside);
            ASSERT_EQ(decoupling::cutting_processes(cut.rings.size(), n), cutters);
        });
        EXPECT_NE(line.find("processes divide a line between subdomains in different ways"), std::string::npos) << line;
        EXPECT_EQ(line.find("differently"), std::string::npos) << line;
    }
}

}  // namespace
}  // namespace lamina::test
