// lamina delaunay.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/triangle_files.hpp>

#include "app/program.hpp"
#include "support/point_sets.hpp"

namespace lamina::test {
namespace {

/// A square with a square hole, two regions, markers.
const std::string plate =
    "9 2 1 1\n1 0 0 1 0\n2 4 0 2 0\n3 4 4 3 0\n4 0 4 4 0\n5 1 1 5 0\n6 2 1 6 0\n7 2 2 7 0\n8 1 2 8 0\n9 3 3 9 0\n"
    "8 1\n1 1 2 21\n2 2 3 0\n3 3 4 0\n4 4 1 0\n5 5 6 30\n6 6 7 30\n7 7 8 30\n8 8 5 30\n1\n1 1.5 1.5\n"
    "1\n1 0.1 0.1 42 0.5\n";

TEST(DelaunayCommand, PlainTriangulationOfPoints) {
    const TemporaryFolder folder;
    folder.write("p.node", "4 2 0 0\n0 0 0\n1 1 0\n2 1 1\n3 0 2\n");
    const ProgramRun run = run_lamina(folder, {"delaunay", "p.node"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"p.1.ele", "p.1.node", "p.node"}));
    EXPECT_TRUE(folder.read("p.1.ele").starts_with("2 3 0\n0 ")) << folder.read("p.1.ele");
}

TEST(DelaunayCommand, ManyPointsAreTriangulatedInPiecesOnAllThreads) {
    const TemporaryFolder folder;
    std::string points = "60000 2 0 0\n";
    Random random(3);
    for (int i = 0; i < 60'000; ++i) points += fmt::format("{} {} {}\n", i, random.real(), random.real());
    folder.write("p.node", points);
    std::string files[2];
    for (unsigned threads : {1u, 3u}) {
        const ProgramRun run = run_lamina(
            folder, {"delaunay", "p.node", "--threads", std::to_string(threads), "--report", "r.json", "--quiet"});
        EXPECT_EQ(run.exit_code, 0) << run.err;
        const auto report = nlohmann::json::parse(folder.read("r.json"));
        EXPECT_GT(report["decomposition"]["pieces"].get<int>(), 8);
        EXPECT_EQ(report["decomposition"]["rejected_cuts"]["crossing"].get<int>(), 0);
        const auto& triangulation = report["thread_seconds"]["triangulation"];
        ASSERT_EQ(triangulation.size(), threads);
        double busy = 0;
        for (unsigned i = 0; i < threads; ++i) {
            busy += triangulation[i]["busy"].get<double>();
            EXPECT_GE(triangulation[i]["idle"].get<double>(), 0);
        }
        EXPECT_GT(busy, 0);
        files[threads / 2] = folder.read("p.1.ele");
    }
    EXPECT_EQ(files[0], files[1]);
}

TEST(DelaunayCommand, ConstrainedAndRefinedWithReport) {
    const TemporaryFolder folder;
    folder.write("plate.poly", plate);
    const auto report_of = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"delaunay", "plate.poly", "-o", "out", "--report", "r.json", "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun run = run_lamina(folder, arguments);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.out, "");
        return nlohmann::json::parse(folder.read("r.json"));
    };
    const auto report = report_of({"--min-angle", "28", "--max-area", "0.1"});
    EXPECT_GE(report["min_angle_deg"].get<double>(), 28 - 1e-6);
    EXPECT_GT(report["triangles"].get<int>(), 150);
    for (const char* stage : {"read", "triangulation", "refinement", "write", "total"})
        EXPECT_GE(report["seconds"][stage].get<double>(), 0) << stage;
    EXPECT_EQ(report["hash"].get<std::string>().size(), 32u);

    const TriangleInput out = read_triangle_files(folder / "out.poly");
    EXPECT_EQ(out.points.size(), report["vertices"].get<std::size_t>());
    EXPECT_EQ(out.attributes[8], 9);
    EXPECT_EQ(out.attributes[20], 0);
    for (std::size_t i = 0; i < out.segments.size(); ++i) {
        const Point a = out.points[out.segments[i].a.index()], b = out.points[out.segments[i].b.index()];
        const bool bottom = a.y == 0 && b.y == 0;
        const bool outer = a.x == b.x ? a.x == 0 || a.x == 4 : a.y == 0 || a.y == 4;
        EXPECT_EQ(out.segment_markers[i], bottom ? 21 : outer ? 1 : 30);
    }
    EXPECT_TRUE(folder.read("out.ele").find(" 42\n") != std::string::npos);

    // The mesh is the same for any number of threads, and coarser where the region alone sets a bound.
    const auto again = report_of({"--min-angle", "28", "--max-area", "0.1", "--threads", "3"});
    EXPECT_EQ(again["hash"], report["hash"]);
    EXPECT_LT(report_of({})["triangles"].get<int>(), 120);
    const auto kept = report_of({"--min-angle", "20", "--keep-border"});
    EXPECT_EQ(read_triangle_files(folder / "out.poly").segments.size(), 8u);
    EXPECT_GT(kept["triangles"].get<int>(), 0);
}

TEST(DelaunayCommand, Refusals) {
    const TemporaryFolder folder;
    folder.write("cross.poly", "4 2\n1 0 0\n2 1 1\n3 0 1\n4 1 0\n2 0\n1 1 2\n2 3 4\n0\n");
    folder.write("bad.node", "2 2\n1 0 0\n2 0 oops\n");
    expect_refused(folder, {"delaunay", "cross.poly"}, 3,
                   "cross.poly: segment 3-4 (line 8) crosses segment 1-2 (line 7) (at 0.5, 0.5)");
    expect_refused(folder, {"delaunay", "bad.node"}, 3, "bad.node:3: coordinate expected, found 'oops'");
    expect_refused(folder, {"delaunay", "none.node"}, 5, "none.node");
    expect_refused(folder, {"delaunay", "bad.txt"}, 2, "neither a .node nor a .poly file");
    expect_refused(folder, {"delaunay", "bad.node", "--min-angle", "40"}, 2, "--min-angle");
    expect_refused(folder, {"delaunay", "bad.node", "--max-area", "-1"}, 2, "--max-area");
    expect_refused(folder, {"delaunay", "bad.node", "-o", "nowhere/x"}, 5, "nowhere");
    const ProgramRun run = run_lamina(folder, {"delaunay", "cross.poly", "--insert-crossings", "--keep-hull"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read_triangle_files(folder / "cross.1.poly").points.size(), 5u);
}

TEST(DelaunayCommand, HolesAndRegionsThatChangeNothingGiveAWarning) {
    const TemporaryFolder folder;
    // A square of side 2 with a hole, beside a triangle. Holes: the true one, twice; outside of the segments; beyond
    // all points. Regions: one in the square, one in the hole.
    folder.write("seeds.poly",
                 "11 2\n1 0 0\n2 2 0\n3 2 2\n4 0 2\n5 0.5 0.5\n6 1 0.5\n7 1 1\n8 0.5 1\n9 4 0\n10 5 0\n11 4 1\n"
                 "11 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 5 6\n6 6 7\n7 7 8\n8 8 5\n9 9 10\n10 10 11\n11 11 9\n"
                 "4\n1 0.7 0.7\n2 0.8 0.8\n3 3 1\n4 70 80\n2\n1 1.5 1.5 1 0.1\n2 0.75 0.75 2 0.1\n");
    const ProgramRun run = run_lamina(folder, {"delaunay", "seeds.poly", "-o", "out", "--report", "r.json", "--quiet"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const auto warnings = nlohmann::json::parse(folder.read("r.json"))["warnings"];
    ASSERT_EQ(warnings.size(), 4u) << warnings;
    const std::vector<std::tuple<std::string, double, Point>> expected = {
        {"hole", 2, {0.8, 0.8}}, {"hole", 3, {3, 1}}, {"hole", 4, {70, 80}}, {"region", 2, {0.75, 0.75}}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(warnings[i]["code"], "unused_seed");
        EXPECT_EQ(warnings[i]["unit"], std::get<0>(expected[i]));
        EXPECT_EQ(warnings[i]["number"], std::get<1>(expected[i]));
        EXPECT_EQ(warnings[i]["at"][0], std::get<2>(expected[i]).x);
        EXPECT_EQ(warnings[i]["at"][1], std::get<2>(expected[i]).y);
    }
}

TEST(DelaunayCommand, EmptyTriangulationsGiveAWarning) {
    const TemporaryFolder folder;
    folder.write("line.node", "4 2\n1 0 0\n2 1 1\n3 2 2\n4 5 5\n");
    folder.write("pair.node", "2 2\n1 0 0\n2 1 1\n");
    folder.write("all.poly", "4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n1\n1 0.25 0.5\n");
    folder.write("open.poly", "4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n1 0\n1 1 3\n0\n");
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"line.node", "4 points, but no triangle: all points lie on one line"},
        {"pair.node", "2 points, but no triangle: a triangle needs three points"},
        {"all.poly", "4 points, but no triangle: the holes take all of it away"},
        {"open.poly", "4 points, but no triangle: the segments enclose nothing"}};
    for (const auto& [file, message] : cases) {
        SCOPED_TRACE(file);
        std::vector<std::string> arguments{"delaunay", file, "-o", "out", "--report", "r.json", "--quiet"};
        const ProgramRun run = run_lamina(folder, arguments);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_NE(run.err.find("lamina: warning: " + message), std::string::npos) << run.err;
        const auto warnings = nlohmann::json::parse(folder.read("r.json"))["warnings"];
        ASSERT_EQ(warnings.size(), 1u);
        EXPECT_EQ(warnings[0]["code"], "no_triangles");
        EXPECT_EQ(warnings[0]["number"], file == "pair.node" ? 2 : 4);
        arguments.push_back("--strict");
        EXPECT_EQ(run_lamina(folder, arguments).exit_code, 4);
        arguments.insert(arguments.end(), {"--min-angle", "20"});
        EXPECT_EQ(run_lamina(folder, arguments).exit_code, 4);
    }
}

TEST(DelaunayCommand, SeedsThatChangeNothingGiveAWarning) {
    const TemporaryFolder folder;
    const std::string square = "4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n";
    folder.write("hole.poly", square + "1\n1 50 50\n");
    folder.write("regions.poly", square + "0\n3\n1 0.3 0.2 7 0.1\n2 0.6 0.2 8 0.2\n3 300 200 9 0.1\n");
    const ProgramRun hole = run_lamina(folder, {"delaunay", "hole.poly", "-o", "out", "--quiet"});
    EXPECT_EQ(hole.exit_code, 0);
    EXPECT_EQ(hole.err, "lamina: warning: hole 1 at (50, 50) lies beyond all points and takes nothing away\n");
    const ProgramRun regions = run_lamina(folder, {"delaunay", "regions.poly", "-o", "out", "--quiet", "--strict"});
    EXPECT_EQ(regions.exit_code, 4);
    EXPECT_NE(regions.err.find("region 2 at (0.6, 0.2) lies in no triangle, or where an earlier"), std::string::npos);
    EXPECT_NE(regions.err.find("region 3 at (300, 200)"), std::string::npos) << regions.err;
    EXPECT_EQ(regions.err.find("region 1"), std::string::npos) << regions.err;
}

TEST(DelaunayCommand, SegmentsThatChangeNothingAreCounted) {
    const TemporaryFolder folder;
    folder.write("a.poly", "4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n6 0\n1 1 2\n2 2 2\n3 2 3\n4 3 4\n5 4 1\n6 1 4\n0\n");
    const ProgramRun run = run_lamina(folder, {"delaunay", "a.poly", "--report", "r.json"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("1 segments from a vertex to itself were left out"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("1 segments lie on earlier ones"), std::string::npos) << run.out;
    const auto report = nlohmann::json::parse(folder.read("r.json"));
    EXPECT_EQ(report["zero_length_segments"], 1);
    EXPECT_EQ(report["repeated_segments"], 1);
    EXPECT_EQ(read_triangle_files(folder / "a.1.poly").segments.size(), 4u);
}

TEST(DelaunayCommand, MergesEqualAndClosePointsOnRequest) {
    const TemporaryFolder folder;
    folder.write("ring.poly",
                 "5 2 0 0\n1 0 0\n2 2 0\n3 2 2\n4 0 2\n5 0 0\n5 0\n1 1 2\n2 2 3\n3 3 4\n4 4 5\n5 5 1\n0\n");
    folder.write("near.poly", "4 2 0 0\n1 0 0\n2 2 0\n3 1 1e-7\n4 1 1\n2 0\n1 1 2\n2 3 4\n0\n");
    folder.write("same.node", "4 2 0 0\n1 0 0\n2 1 0\n3 0 1\n4 1 0\n");
    const ProgramRun refused = run_lamina(folder, {"delaunay", "ring.poly"});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_NE(refused.err.find("--merge"), std::string::npos) << refused.err;
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--merge"}, {"--merge", "0"}, {"--merge", "1e-9", "--min-angle", "25"}}) {
        std::vector<std::string> words{"delaunay", "ring.poly", "-o", "out", "--report", "r.json"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun run = run_lamina(folder, words);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        const auto report = nlohmann::json::parse(folder.read("r.json"));
        EXPECT_EQ(report["merged_points"], 1);
        EXPECT_EQ(report["zero_length_segments"], 1);
        EXPECT_EQ(report["angles_below_bound"], 0);
    }
    EXPECT_EQ(run_lamina(folder, {"delaunay", "same.node", "--merge"}).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"delaunay", "same.node", "--merge", "-1"}).exit_code, 2);
    EXPECT_EQ(run_lamina(folder, {"delaunay", "same.node", "--merge", "wide"}).exit_code, 2);
    // Segments are led through points that are that near.
    const ProgramRun near = run_lamina(
        folder, {"delaunay", "near.poly", "--keep-hull", "--insert-crossings", "--merge", "1e-6", "-o", "out"});
    EXPECT_EQ(near.exit_code, 0) << near.err;
    EXPECT_EQ(read_triangle_files(folder / "out.poly").segments.size(), 3u);
}

TEST(DelaunayCommand, FilesWithoutPointsAreRefusedByThatName) {
    const TemporaryFolder folder;
    folder.write("empty.node", "0 2 0 0\n");
    folder.write("empty.poly", "0 2 0 0\n0 0\n0\n");
    for (const std::string file : {"empty.node", "empty.poly"}) {
        for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--min-angle", "20"}}) {
            std::vector<std::string> words{"delaunay", file};
            words.insert(words.end(), more.begin(), more.end());
            const ProgramRun run = run_lamina(folder, words);
            EXPECT_EQ(run.exit_code, 3);
            EXPECT_NE(run.err.find("the file holds no points"), std::string::npos) << run.err;
        }
    }
}

TEST(DelaunayCommand, MergeSaysHowToWriteItsDistance) {
    const TemporaryFolder folder;
    folder.write("same.node", "4 2 0 0\n1 0 0\n2 1 0\n3 0 1\n4 1 0\n");
    EXPECT_EQ(run_lamina(folder, {"delaunay", "--merge", "same.node"}).exit_code, 0);
    for (const std::vector<std::string>& words : {std::vector<std::string>{"delaunay", "--merge", "wide", "same.node"},
                                                  {"delaunay", "same.node", "--merge", "wide"},
                                                  {"delaunay", "--merge=wide", "same.node"}}) {
        const ProgramRun run = run_lamina(folder, words);
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_NE(run.err.find("write --merge=TOL, or FILE before --merge"), std::string::npos) << run.err;
    }
    EXPECT_EQ(run_lamina(folder, {"delaunay", "--merge=0", "same.node"}).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"delaunay", "--merge", "--keep-hull", "same.node"}).exit_code, 0);
}

TEST(DelaunayCommand, DropsFlatTrianglesAtTheHull) {
    const TemporaryFolder folder;
    folder.write("p.node", "5 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n5 0.5 1e-12\n");
    folder.write("p.poly", "5 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n5 0.5 1e-12\n1 0\n1 5 3\n0\n");
    const auto triangles_with = [&](std::vector<std::string> words) {
        words.insert(words.end(), {"-o", "out", "--report", "r.json"});
        const ProgramRun run = run_lamina(folder, words);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return nlohmann::json::parse(folder.read("r.json"))["triangles"].get<int>();
    };
    EXPECT_EQ(triangles_with({"delaunay", "p.node"}), 4);
    EXPECT_EQ(triangles_with({"delaunay", "p.node", "--drop-flat", "1e-9"}), 3);
    EXPECT_EQ(triangles_with({"delaunay", "p.poly", "--drop-flat", "1e-9", "--keep-hull"}), 3);
    EXPECT_EQ(run_lamina(folder, {"delaunay", "p.poly", "--drop-flat", "1e-9"}).exit_code, 2);
    EXPECT_EQ(run_lamina(folder, {"delaunay", "p.node", "--drop-flat", "-1"}).exit_code, 2);
    EXPECT_EQ(run_lamina(folder, {"delaunay", "p.node", "--drop-flat", "0.5"}).exit_code, 2);
}

}  // namespace
}  // namespace lamina::test
