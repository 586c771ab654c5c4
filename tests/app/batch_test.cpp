// lamina batch: many inputs, failures, sweeps, interruptions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <lamina/io.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::vector<std::string> quick{"--first-height", "1e-4", "--layers", "8", "--quiet"};

ProgramRun run_batch(const TemporaryFolder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "batch");
    arguments.insert(arguments.end(), quick.begin(), quick.end());
    return run_lamina(folder, arguments);
}

/// Returns the records of a journal by the names of the jobs.
std::map<std::string, Json> journal(const TemporaryFolder& folder, const std::string& file) {
    std::map<std::string, Json> records;
    for (const std::string& line : lines_of(folder.read(file))) {
        const Json record = Json::parse(line);
        EXPECT_TRUE(records.emplace(record["job"], record).second) << line;
    }
    return records;
}

/// Returns the table with the column of seconds left out.
std::vector<std::string> table_without_times(const TemporaryFolder& folder, const std::string& file) {
    std::vector<std::string> lines = lines_of(folder.read(file));
    for (std::string& line : lines) {
        const std::size_t hash = line.rfind(','), seconds = line.rfind(',', hash - 1);
        line.erase(seconds, hash - seconds);
    }
    return lines;
}

TEST(Batch, TemplatesGiveAllShapesTheirCells) {
    const TemporaryFolder folder;
    std::vector<std::string> first{"mesh", "naca:0012:80", "-o", "first.vtu"};
    first.insert(first.end(), quick.begin(), quick.end());
    ASSERT_EQ(run_lamina(folder, first).exit_code, 0);
    const std::vector<std::string> arguments{"naca:0013:200",  "naca:0010:200", "naca:0012:101:blunt",
                                             "--template",     "first.vtu",     "-o",
                                             "out/{name}.vtu", "--summary",     "s"};
    const ProgramRun run = run_batch(folder, arguments);
    EXPECT_EQ(run.exit_code, mesh_failed) << run.err;  // one shape has other corners
    std::map<std::string, Json> records = journal(folder, "s.jsonl");
    EXPECT_EQ(records["naca_0012_101_blunt"]["outcome"], "failed");
    EXPECT_NE(records["naca_0012_101_blunt"]["error"].get<std::string>().find("corners"), std::string::npos);
    const Mesh reference = read_mesh(folder / "first.vtu");
    for (const char* name : {"naca_0013_200", "naca_0010_200"}) {
        EXPECT_EQ(records[name]["outcome"], "done");
        const Mesh morphed = read_mesh(folder / ("out/" + std::string(name) + ".vtu"));
        EXPECT_EQ(morphed.triangles, reference.triangles);
        EXPECT_NE(morphed.points, reference.points);
        EXPECT_TRUE(check_mesh(morphed).valid());
    }
    run_batch(folder, arguments);
    EXPECT_EQ(journal(folder, "s.jsonl")["naca_0013_200"], records["naca_0013_200"]);  // kept
    const std::vector<std::string> one{"batch", "naca:0013:200", "--template", "first.vtu", "-o"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), one.begin(), one.end());
        return more;
    };
    expect_refused(folder, with({"first.vtu"}), usage, "would replace an input");
    expect_refused(folder, with({"{name}.vtu", "--report", "{name}.json"}), usage, "option --template");
}

TEST(Batch, MeshesForOpenFoamHaveQuadsUnlessToldOtherwise) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments{"naca:0012", "--format", "openfoam", "-o", "out/{name}", "--summary", "s"};
    EXPECT_EQ(run_batch(folder, arguments).exit_code, 0);
    EXPECT_GT(journal(folder, "s.jsonl")["naca_0012"]["quadrilaterals"], 0);
    std::vector<std::string> layered = arguments;
    layered.insert(layered.end(), {"--layer-topology", "layered"});
    EXPECT_EQ(run_batch(folder, layered).exit_code, 0);
    const Json record = Json::parse(lines_of(folder.read("s.jsonl")).back());
    EXPECT_EQ(record["quadrilaterals"], 0);
    const auto is_unsuited = [](const Json& warning) { return warning.at("code") == "unsuited_to_solver"; };
    EXPECT_EQ(std::count_if(record["warnings"].begin(), record["warnings"].end(), is_unsuited), 1);
}

TEST(Batch, MissingFoldersAreCreatedUnlessTheCallIsWrong) {
    const TemporaryFolder folder;
    expect_refused(folder, {"batch", "naca:0012", "naca:0015", "-o", "new/m.su2"}, usage, "would be written twice");
    EXPECT_FALSE(fs::exists(folder / "new"));
    EXPECT_EQ(run_batch(folder, {"naca:0012", "naca:0015", "-o", "new/{name}/m.su2", "--report", "r/{name}.json",
                                 "--summary", "s/all.csv"})
                  .exit_code,
              0);
    for (const char* file : {"new/naca_0012/m.su2", "new/naca_0015/m.su2", "r/naca_0015.json", "s/all.csv"})
        EXPECT_TRUE(fs::exists(folder / file)) << file;
    folder.write("fish.dat", "fish\n0 0\n1 0.1\n1 0\n0 0.1\n");
    EXPECT_EQ(run_batch(folder, {"naca:0012", "fish.dat", "-o", "some/{name}/m.su2", "--summary", "s"}).exit_code, 4);
    EXPECT_TRUE(fs::exists(folder / "some/naca_0012/m.su2"));
    EXPECT_FALSE(fs::exists(folder / "some/fish")) << "nothing is in it";
}

TEST(Batch, LinesInsideAreTakenAsInMesh) {
    const TemporaryFolder folder;
    const ProgramRun run =
        run_batch(folder, {"naca:0012", "-o", "{name}.su2", "--summary", "s", "--line", "a:-0.2,0.05,1.2,0.06"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const Json record = Json::parse(lines_of(folder.read("s.jsonl")).back());
    const auto is_loss = [](const Json& warning) {
        return warning.at("message").get<std::string>().find("a left out") != std::string::npos;
    };
    EXPECT_EQ(std::count_if(record["warnings"].begin(), record["warnings"].end(), is_loss), 1) << record["warnings"];
}

TEST(Batch, NoFileReplacesAnInput) {
    const TemporaryFolder folder;
    const std::string wedge = "wedge\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n";
    fs::create_directories(folder / "case/constant/polyMesh");
    const std::vector<std::string> inputs = {"a.csv", "summary.csv", "a.dat", "case/a.dat",
                                             "case/constant/polyMesh/a.dat"};
    for (const std::string& file : inputs) folder.write(file, wedge);
    fs::create_directory_symlink(".", folder / "here");
    fs::create_symlink("../a.dat", folder / "case/link.su2");
    const std::vector<std::vector<std::string>> calls = {
        {"a.csv", "-o", "out/{name}.su2", "--summary", "a.csv"},
        {"a.csv", "summary.csv", "-o", "{name}.su2"},
        {"a.dat", "-o", "here/{name}.dat", "--format", "su2"},
        {"a.dat", "-o", "case/link.su2"},
        {"case/a.dat", "-o", "out/{name}.su2", "--report", "here/case/{name}.dat"},
        {"case/constant/polyMesh/a.dat", "-o", "case", "--format", "openfoam"}};
    for (std::vector<std::string> arguments : calls) {
        SCOPED_TRACE(arguments.back());
        arguments.insert(arguments.begin(), "batch");
        expect_refused(folder, arguments, usage, "would replace an input");
    }
    for (const std::string& file : inputs) EXPECT_EQ(folder.read(file), wedge) << file;
}

TEST(Batch, WarningsAreLinesAlsoUnderQuiet) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(folder, {"batch", "naca:63012", "naca:0012", "-o", "{name}.su2", "--quiet"});
    EXPECT_EQ(run.exit_code, 0);
    ASSERT_EQ(lines_of(run.err).size(), 1u) << run.err;
    EXPECT_EQ(run.err.find("lamina: warning: naca_63012: airfoil: naca:63012 is the five-digit section"), 0u)
        << run.err;
}

TEST(Batch, OneBadFileDoesNotStopTheRest) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "out");
    folder.write("bad.dat", "title\n1 0\n0.5 nan\n0 0\n");
    const ProgramRun run =
        run_batch(folder, {"naca:0012", "bad.dat", "naca:4412", "missing.dat", "-o", "out/{name}.su2", "--jobs", "2"});
    EXPECT_EQ(run.exit_code, 4);
    EXPECT_NE(run.err.find("2 of 4 meshes were not made; out/summary.csv says why"), std::string::npos) << run.err;
    auto records = journal(folder, "out/summary.jsonl");
    ASSERT_EQ(records.size(), 4u);
    EXPECT_EQ(records["bad"]["exit_code"], 3);
    EXPECT_NE(records["bad"]["error"].get<std::string>().find("bad.dat:3"), std::string::npos);
    EXPECT_EQ(records["missing"]["exit_code"], 5);
    const std::vector<std::string> table = lines_of(folder.read("out/summary.csv"));
    ASSERT_EQ(table.size(), 5u);
    EXPECT_TRUE(table[1].starts_with("naca_0012,done,0,")) << table[1];
    EXPECT_TRUE(table[2].starts_with("bad,failed,3,")) << table[2];
    // The meshes are those of lamina mesh.
    for (const std::string digits : {"0012", "4412"}) {
        std::vector<std::string> arguments{"mesh", "naca:" + digits, "-o", "m.su2", "--report", "r.json"};
        arguments.insert(arguments.end(), quick.begin(), quick.end());
        ASSERT_EQ(run_lamina(folder, arguments).exit_code, 0);
        EXPECT_EQ(Json::parse(folder.read("r.json"))["hash"], records["naca_" + digits]["hash"]);
        EXPECT_EQ(folder.read("m.su2"), folder.read("out/naca_" + digits + ".su2"));
    }
}

TEST(Batch, SweepsAndShards) {
    const TemporaryFolder folder;
    const std::vector<std::string> sweep{"naca:0012", "naca:2412",          "-o",      "{name}_{growth}_{layers}.vtu",
                                         "--sweep",   "growth=1.2,1.3,1.4", "--sweep", "layers=5,8"};
    EXPECT_EQ(run_batch(folder, sweep).exit_code, 0);
    const auto all = journal(folder, "summary.jsonl");
    EXPECT_EQ(all.size(), 12u);
    EXPECT_EQ(all.at("naca_2412 growth=1.3 layers=5")["sweep"]["growth"], "1.3");
    EXPECT_TRUE(fs::exists(folder / "naca_2412_1.3_5.vtu"));
    const std::vector<std::string> table = lines_of(folder.read("summary.csv"));
    EXPECT_TRUE(table[0].starts_with("name,growth,layers,outcome,"));
    EXPECT_TRUE(table[2].starts_with("naca_0012,1.2,8,done,"));

    std::map<std::string, Json> of_shards;
    for (const std::string shard : {"1", "2", "3", "4", "5"}) {
        std::vector<std::string> arguments = sweep;
        arguments.insert(arguments.end(), {"--shard", shard + "/5", "--summary", "part.csv"});
        ASSERT_EQ(run_batch(folder, arguments).exit_code, 0);
        for (const auto& [job, record] : journal(folder, "part." + shard + "-of-5.jsonl"))
            EXPECT_TRUE(of_shards.emplace(job, record).second);
    }
    ASSERT_EQ(of_shards.size(), all.size());
    for (const auto& [job, record] : all) EXPECT_EQ(of_shards[job]["hash"], record["hash"]);
}

TEST(Batch, TakesSamplesOfIntervals) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments{"naca:0012",
                                             "-o",
                                             "{name}_{alpha}_{reynolds}_{growth}.vtu",
                                             "--sweep",
                                             "growth=1.2,1.3",
                                             "--sample",
                                             "alpha=-4:8",
                                             "--sample",
                                             "reynolds=1e5:1e7:log",
                                             "--samples",
                                             "4",
                                             "--far-field",
                                             "5"};
    ASSERT_EQ(run_batch(folder, arguments).exit_code, 0);
    const auto made = journal(folder, "summary.jsonl");
    EXPECT_EQ(made.size(), 8u);
    // Each quarter of each interval holds a sample, and both ratios have the same ones.
    std::map<std::string, std::set<int>> quarters;
    for (const auto& [job, record] : made) {
        const auto& swept = record["sweep"];
        const double alpha = std::stod(swept["alpha"].get<std::string>());
        const double reynolds = std::stod(swept["reynolds"].get<std::string>());
        const std::string growth = swept["growth"];
        quarters["alpha " + growth].insert(static_cast<int>(std::floor((alpha + 4) / 3)));
        quarters["reynolds " + growth].insert(static_cast<int>(std::floor((std::log10(reynolds) - 5) * 2)));
    }
    ASSERT_EQ(quarters.size(), 4u);
    for (const auto& [name, held] : quarters) EXPECT_EQ(held, (std::set<int>{0, 1, 2, 3})) << name;

    const std::vector<std::pair<std::vector<std::string>, std::string>> refused{
        {{"--sample", "alpha=4:-4", "--samples", "3"}, "alpha: '4:-4': is no interval: A must be below B"},
        {{"--sample", "alpha=1", "--samples", "3"}, "'1': is no interval A:B"},
        {{"--sample", "alpha=-1:1:log", "--samples", "3"}, "A must be above 0"},
        {{"--sample", "alhpa=1:2", "--samples", "3"}, "did you mean 'alpha'"},
        {{"--sample", "layer-topology=1:2", "--samples", "3"}, "only numbers have intervals"},
        {{"--sample", "alpha=1:2", "--samples", "3", "--sweep", "alpha=1,2"}, "'alpha' has values already"},
        {{"--sample", "alpha=1:2"}, "--samples"}};
    for (const auto& [further, message] : refused) {
        std::vector<std::string> all{"batch", "naca:0012", "-o", "{alpha}.su2"};
        all.insert(all.end(), further.begin(), further.end());
        const TemporaryFolder empty;
        expect_refused(empty, all, usage, message);
    }
}

TEST(Batch, GoesOnAfterAnInterruption) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments{"batch", "-o", "{name}_{growth}.su2", "--jobs", "1", "--sweep", "growth="};
    for (int i = 0; i < 8; ++i) arguments.back() += (i > 0 ? "," : "") + std::to_string(1.1 + 0.005 * i);
    arguments.insert(arguments.begin() + 1, {"naca:0012", "naca:4412"});
    arguments.insert(arguments.end(), quick.begin(), quick.end());
    const auto lines = [&] {
        return fs::exists(folder / "summary.jsonl") ? lines_of(folder.read("summary.jsonl")).size() : 0;
    };
    ASSERT_EQ(interrupt_lamina(folder, arguments, SIGKILL, [&] { return lines() >= 3; }), SIGKILL);
    const std::size_t before = lines();
    ASSERT_LT(before, 16u);
    EXPECT_FALSE(fs::exists(folder / "summary.csv"));
    // The last line may have been cut off.
    folder.write("summary.jsonl", folder.read("summary.jsonl") + "{\"job\": \"naca_");

    std::vector<std::string> loud = arguments;
    std::erase(loud, "--quiet");
    const ProgramRun resumed = run_lamina(folder, loud);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(resumed.out.find(", 0 kept"), std::string::npos) << resumed.out;
    EXPECT_EQ(journal(folder, "summary.jsonl").size(), 16u);
    const auto table = table_without_times(folder, "summary.csv");

    const TemporaryFolder other;
    ASSERT_EQ(run_lamina(other, arguments).exit_code, 0);
    EXPECT_EQ(table, table_without_times(other, "summary.csv"));

    // Missing files and other options are made anew, and nothing else.
    fs::remove(folder / "naca_0012_1.100000.su2");
    EXPECT_NE(run_lamina(folder, loud).out.find("1 meshes made, 15 kept"), std::string::npos);
    loud.insert(loud.end(), {"--far-field", "20"});
    EXPECT_NE(run_lamina(folder, loud).out.find("16 meshes made, 0 kept"), std::string::npos);
}

// What a journal says of files holds only while they have the same bytes.
TEST(Batch, ResumingMakesFilesAnewThatHaveChanged) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments{"naca:0012",       "naca:0015",  "-o",          "{name}.vtu", "-o",
                                             "{name}/polyMesh", "-o",         "{name}.pvtu", "--parts",    "2",
                                             "--report",        "{name}.json"};
    const auto kept = [&] {
        std::vector<std::string> loud = arguments;
        loud.insert(loud.begin(), "batch");
        loud.insert(loud.end(), quick.begin(), quick.end() - 1);
        const ProgramRun run = run_lamina(folder, loud);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return run.out.substr(run.out.find(','), run.out.find("kept") - run.out.find(','));
    };
    EXPECT_EQ(kept(), ", 0 ");
    EXPECT_EQ(kept(), ", 2 ");
    for (const char* file : {"naca_0012.vtu", "naca_0012/polyMesh/owner", "naca_0012_1.vtu", "naca_0012.json"}) {
        SCOPED_TRACE(file);
        const std::string whole = folder.read(file);
        folder.write(file, whole.substr(0, whole.size() / 2));
        EXPECT_EQ(kept(), ", 1 ");
        if (!std::string(file).ends_with("json")) {  // a report has times
            EXPECT_EQ(folder.read(file), whole);
        }
        std::string changed = folder.read(file);
        changed[changed.size() / 2] ^= 1;
        folder.write(file, changed);
        EXPECT_EQ(kept(), ", 1 ");
        fs::remove(folder / file);
        EXPECT_EQ(kept(), ", 1 ");
        EXPECT_EQ(kept(), ", 2 ");
    }
}

TEST(Batch, LinesOfAJournalThatAreNoRecordsDoNotCount) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments{"naca:0012:40", "--no-layers", "--far-field", "5",
                                             "--gradation",  "0.5",         "-o",          "m.su2"};
    ASSERT_EQ(run_batch(folder, arguments).exit_code, 0);
    const Json record = Json::parse(folder.read("summary.jsonl"));
    const auto hash = record["hash"];
    std::vector<Json> wrong{Json::array(), 5, "text", nullptr, {{"job", 5}}, {{"job", record["job"]}}};
    for (const auto& [key, value] : record.items())
        for (const Json& other : {Json(nullptr), Json(5), Json("x"), Json::array({1}), Json{{"a", "b"}}, Json(-1.5)}) {
            Json line = record;
            line[key] = other;
            wrong.push_back(line);
        }
    for (const char* key : {"file", "bytes", "fnv1a"}) {
        Json line = record;
        line["files"][0][key] = {1, "x"};
        wrong.push_back(line);
    }
    for (const Json& line : wrong) {
        SCOPED_TRACE(line.dump());
        folder.write("summary.jsonl", line.dump() + "\n");
        const ProgramRun run = run_batch(folder, arguments);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.err.find("error"), std::string::npos) << run.err;
        const Json made = Json::parse(lines_of(folder.read("summary.jsonl")).at(0));
        EXPECT_EQ(made["hash"].type(), hash.type());
    }
}

TEST(Batch, NamesStayInTheirFolder) {
    const TemporaryFolder folder;
    const std::string wedge = "wedge\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n";
    fs::create_directory(folder / "in");
    for (const char* file : {"in/...dat", "in/..dat"}) folder.write(file, wedge);
    EXPECT_EQ(run_batch(folder, {"in/...dat", "in/..dat", "-o", "out/{name}/m.su2", "--summary", "s"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(folder / "out/__/m.su2"));
    EXPECT_TRUE(fs::exists(folder / "out/_/m.su2"));
    EXPECT_EQ(run_batch(folder, {"naca:0012", "-o", "out/{names}/m.su2", "--sweep", "names=../a,..", "--summary", "s"})
                  .exit_code,
              0);
    EXPECT_TRUE(fs::exists(folder / "out/.._a/m.su2"));
    EXPECT_TRUE(fs::exists(folder / "out/__/m.su2"));
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"in", "out", "s.csv", "s.jsonl"}));
}

// Spreadsheets run what begins like a formula.
TEST(Batch, TablesHoldNoFormulas) {
    const TemporaryFolder folder;
    const std::string wedge = "wedge\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n";
    const std::vector<std::string> names{"=1+1", "+x", "@SUM(A1)", "-2+3"};
    std::vector<std::string> arguments;
    for (const std::string& name : names) {
        folder.write(name + ".dat", wedge);
        arguments.push_back("./" + name + ".dat");
    }
    arguments.insert(arguments.end(), {"-o", "{name}_{alpha}.su2", "--sweep", "alpha=-4", "--summary", "s"});
    EXPECT_EQ(run_batch(folder, arguments).exit_code, 0);
    const std::vector<std::string> table = lines_of(folder.read("s.csv"));
    ASSERT_EQ(table.size(), 1 + names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
        EXPECT_TRUE(table[i + 1].starts_with("'" + names[i] + ",-4,done,0,")) << table[i + 1];
}

TEST(Batch, WrongCallsAreRefusedBeforeTheWork) {
    const TemporaryFolder folder;
    folder.write("a.dat", "title\n1 0\n0 0.1\n0 -0.1\n");
    expect_refused(folder, {"batch", "naca:0012"}, usage, "no output");
    expect_refused(folder, {"batch", "naca:0012", "naca:0015", "-o", "m.su2"}, usage, "would be written twice");
    expect_refused(folder, {"batch", "a.dat", "-o", "{name}.dat", "--format", "su2"}, usage, "would replace an input");
    expect_refused(folder, {"batch", "naca:0012", "-o", "-", "--format", "su2"}, usage, "not '-'");
    expect_refused(folder, {"batch", "naca:0012", "-o", "m.su2", "--sweep", "growht=1.2"}, usage,
                   "did you mean 'growth'");
    expect_refused(folder, {"batch", "naca:0012", "-o", "m.su2", "--sweep", "growth=0.5"}, usage, "growth");
    expect_refused(folder, {"batch", "naca:0012", "-o", "m.su2", "--sweep", "growth"}, usage, "OPTION=VALUE");
    for (const char* shard : {"0/4", "5/4", "1", "1/", "a/b", "1/4x"})
        expect_refused(folder, {"batch", "naca:0012", "-o", "m.su2", "--shard", shard}, usage, "--shard");
    folder.write("file", "");
    expect_refused(folder, {"batch", "naca:0012", "-o", "file/{name}.su2"}, io_failed, "file");
}

}  // namespace
}  // namespace lamina::test
