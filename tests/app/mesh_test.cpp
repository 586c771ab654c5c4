// lamina mesh and lamina check on the case of the thesis, NACA 0012 (Figs. 24 to 28): files, report, validity, quality
// and numbers of threads.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <lamina/geometry.hpp>
#include <lamina/io.hpp>
#include <lamina/layers.hpp>
#include <lamina/surface.hpp>

#include "app/program.hpp"
#include "layers/layer.hpp"
#include "support/layers.hpp"

namespace lamina::test {
namespace {

using Json = nlohmann::json;

std::vector<std::string> thesis_case(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"mesh",
                                       "naca:0012:200",
                                       "--first-height",
                                       "2.5e-5",
                                       "--growth",
                                       "1.15",
                                       "--layers",
                                       "30",
                                       "--max-ray-angle",
                                       "4",
                                       "--far-field",
                                       "50"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// The case of the thesis, meshed once for all tests.
class MeshCommand : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        run_ = new ProgramRun(run_lamina(*folder_, thesis_case({"-o", "n.su2", "-o", "n.vtu", "--report", "r.json"})));
    }
    static void TearDownTestSuite() {
        delete run_;
        delete folder_;
    }
    void SetUp() override { ASSERT_EQ(run().exit_code, 0) << run().err; }

    static const TemporaryFolder& folder() { return *folder_; }
    static const ProgramRun& run() { return *run_; }
    static Json report() { return Json::parse(folder().read("r.json")); }

private:
    static inline const TemporaryFolder* folder_ = nullptr;
    static inline const ProgramRun* run_ = nullptr;
};

TEST_F(MeshCommand, DryRunSaysWhatTheMeshHasAndWritesNone) {
    const TemporaryFolder empty;
    const ProgramRun dry = run_lamina(empty, thesis_case({"-o", "n.su2", "--dry-run", "--report", "r.json"}));
    ASSERT_EQ(dry.exit_code, 0) << dry.err;
    EXPECT_NE(dry.out.find("cells in the layer, about"), std::string::npos) << dry.out;
    EXPECT_FALSE(std::filesystem::exists(empty / "n.su2"));
    const Json said = Json::parse(empty.read("r.json"))["forecast"], made = report();
    const double in_layer = made["layer_triangles"], beyond = made["isotropic_triangles"], vertices = made["vertices"];
    EXPECT_NEAR(said["layer_cells"], in_layer, 0.02 * in_layer);
    EXPECT_NEAR(said["cells_beyond"], beyond, 0.1 * beyond);
    EXPECT_NEAR(said["vertices"], vertices, 0.1 * vertices);
    EXPECT_NEAR(said["walls"][0]["first_height"]["chords"], 2.5e-5, 1e-15);
}

TEST_F(MeshCommand, WritesWhatWasAskedForAndNothingElse) {
    EXPECT_EQ(folder().names(), (std::vector<std::string>{"n.su2", "n.vtu", "r.json"}));
    // Thirty layers end far below isotropy.
    EXPECT_EQ(lines_of(run().err).size(), 1u) << run().err;
    EXPECT_NE(run().err.find("times as high as its last cells"), std::string::npos) << run().err;
    EXPECT_NE(run().out.find("n.su2"), std::string::npos) << run().out;
}

TEST_F(MeshCommand, TheReportHoldsWhatTheGuidePromises) {
    const Json r = report();
    EXPECT_TRUE(r["version"].is_string());
    EXPECT_GE(r["threads"].get<int>(), 1);
    ASSERT_EQ(r["input"].size(), 1u);
    EXPECT_EQ(r["input"][0]["name"], "airfoil");
    EXPECT_EQ(r["input"][0]["file"], "naca:0012:200");
    EXPECT_EQ(r["input"][0]["points"], 200);
    EXPECT_TRUE(r["input"][0]["repairs"].is_array());
    for (const char* count : {"vertices", "triangles", "layer_triangles", "isotropic_triangles", "surface_vertices"}) {
        EXPECT_GT(r[count].get<std::size_t>(), 0u) << count;
    }
    EXPECT_EQ(r["quads"], 0);
    EXPECT_EQ(r["triangles"].get<std::size_t>(),
              r["layer_triangles"].get<std::size_t>() + r["isotropic_triangles"].get<std::size_t>());
    EXPECT_GE(r["pieces"]["layer"].get<int>(), 1);
    EXPECT_GE(r["pieces"]["inviscid"].get<int>(), 1);
    EXPECT_EQ(r["hash"].get<std::string>().size(), 32u);
    const double share = r["layer_cells"]["share"];
    EXPECT_GT(share, 0.5);
    EXPECT_LE(share, 1);
    EXPECT_EQ(r["thread_seconds"]["refinement"].size(), r["threads"].get<std::size_t>());
}

TEST_F(MeshCommand, SecondsOfTheStagesAddUpToTheTotal) {
    const Json seconds = report()["seconds"];
    double sum = 0;
    for (const char* stage : {"geometry", "layers", "decomposition", "layer_triangulation", "sizing", "decoupling",
                              "refinement", "assembly", "check", "write"}) {
        EXPECT_GE(seconds[stage].get<double>(), 0) << stage;
        sum += seconds[stage].get<double>();
    }
    const double total = seconds["total"];
    EXPECT_LE(sum, total * 1.001 + 1e-3);
    EXPECT_GT(sum, 0.5 * total);
}

TEST_F(MeshCommand, IsotropicTrianglesKeepTheAngleBound) {
    const Json r = report();
    const Json isotropic = r["quality"]["isotropic"];
    const auto exempt = isotropic["exempt"].get<std::size_t>();
    EXPECT_LE(isotropic["angles_below_bound"].get<std::size_t>(), exempt);
    EXPECT_LT(static_cast<double>(exempt), 0.001 * r["isotropic_triangles"].get<double>());
    EXPECT_TRUE(exempt > 0 || isotropic["min_angle_deg"].get<double>() >= 20.7) << isotropic["min_angle_deg"];
    EXPECT_GT(isotropic["mean_ratio"].get<double>(), 0.98);
    EXPECT_LT(isotropic["share_below_40_deg"].get<double>(), 0.005);
    EXPECT_NEAR(isotropic["mean_edge_over_size"].get<double>(), 1, 0.03);
    EXPECT_EQ(r["quality"]["delaunay"]["violations"], 0);
    EXPECT_GT(r["quality"]["delaunay"]["interior_edges"].get<std::size_t>(), 1000u);
}

TEST(MeshCommandTopology, QuadsGoThroughEveryFormatAndCommand) {
    const TemporaryFolder folder;
    for (const std::string topology : {"layered", "quads"}) {
        const ProgramRun run = run_lamina(
            folder, thesis_case({"--layer-topology", topology, "-o", "q.su2", "-o", "q.vtu", "--report", "q.json"}));
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const Json r = Json::parse(folder.read("q.json"));
        const auto quads = r["quads"].get<std::size_t>(), triangles = r["layer_triangles"].get<std::size_t>();
        EXPECT_EQ(quads > 0, topology == "quads");
        EXPECT_EQ(run.out.find(std::to_string(quads) + " quads") != std::string::npos, topology == "quads") << run.out;
        EXPECT_EQ(r["quality"]["layer"]["cells"], quads + triangles);
        EXPECT_EQ(r["triangles"].get<std::size_t>(), triangles + r["isotropic_triangles"].get<std::size_t>());
        EXPECT_EQ(r["quality"]["delaunay"]["violations"], 0);
        for (const char* file : {"q.vtu", "q.su2"}) {
            const ProgramRun check = run_lamina(folder, {"check", file, "--json", "--wall", "airfoil"});
            ASSERT_EQ(check.exit_code, 0) << check.err;
            EXPECT_EQ(Json::parse(check.out)["quads"], quads);
            EXPECT_EQ(Json::parse(check.out)["hash"], r["hash"]);
        }
        // The triangles of the layer are not Delaunay. They need not be, since the file says which region they are in.
        const ProgramRun demanding = run_lamina(folder, {"check", "q.vtu", "--require-delaunay"});
        EXPECT_EQ(demanding.exit_code, 0) << demanding.err;
        const ProgramRun plot = run_lamina(folder, {"plot", "q.vtu", "-o", "q.png", "--width", "300"});
        EXPECT_EQ(plot.exit_code, 0) << plot.err;
    }
    const ProgramRun wrong = run_lamina(folder, thesis_case({"--layer-topology", "hexes", "-o", "w.su2"}));
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_NE(wrong.err.find("delaunay, layered, quads"), std::string::npos) << wrong.err;
}

TEST_F(MeshCommand, CheckFindsBothFilesValidAndTheSameMesh) {
    const ProgramRun vtu = run_lamina(folder(), {"check", "n.vtu", "--json", "--wall", "airfoil", "--far", "farfield",
                                                 "--require-delaunay", "--min-angle", "20.7"});
    EXPECT_EQ(vtu.exit_code, 0) << vtu.err;
    const ProgramRun su2 = run_lamina(folder(), {"check", "n.su2", "--json", "--wall", "airfoil", "--far", "farfield"});
    EXPECT_EQ(su2.exit_code, 0) << su2.err;
    for (const ProgramRun& checked : {vtu, su2}) {
        const Json c = Json::parse(checked.out);
        EXPECT_EQ(c["valid"], true);
        EXPECT_EQ(c["hash"], report()["hash"]);
        EXPECT_EQ(c["triangles"], report()["triangles"]);
        EXPECT_EQ(c["boundary_loops"], 2);
        EXPECT_EQ(c["markers"].size(), 2u);
    }
    EXPECT_EQ(Json::parse(vtu.out)["quality"]["delaunay"]["violations"], 0);
    // The summary says so where the file holds no regions, and only there.
    const auto says_so = [&](const char* file) {
        return run_lamina(folder(), {"check", file}).out.find("none in the file") != std::string::npos;
    };
    EXPECT_TRUE(says_so("n.su2"));
    EXPECT_FALSE(says_so("n.vtu"));
}

/// Returns the coordinates of all vertices of a file.
std::set<std::pair<double, double>> vertices_of(const std::filesystem::path& file) {
    std::set<std::pair<double, double>> vertices;
    for (const Point p : read_mesh(file).points) vertices.emplace(p.x, p.y);
    return vertices;
}

TEST_F(MeshCommand, EveryWallPointOfTheInputIsAVertexExactly) {
    const auto vertices = vertices_of(folder() / "n.su2");
    const Element section = naca_airfoil("0012", 200);
    ASSERT_EQ(section.points.size(), 200u);
    for (const Point p : section.points) EXPECT_TRUE(vertices.contains({p.x, p.y})) << p.x << " " << p.y;
}

TEST_F(MeshCommand, LayerHeightsAreTheRequestedOnesOnFullRays) {
    const auto vertices = vertices_of(folder() / "n.su2");
    Geometry geometry;
    geometry.elements.push_back(naca_airfoil("0012", 200));
    geometry = prepare_surfaces(std::move(geometry), {});
    LayerOptions options;
    options.first_height = 2.5e-5;
    options.growth = 1.15;
    options.layers = 30;
    options.max_ray_angle_deg = 4;
    const Layer layer = test::make_layer(geometry, options);
    std::size_t full = 0;
    for (const Ray& ray : layer.rays.front()) {
        if (ray.layers < ray.requested) continue;
        ++full;
        Point below = layer.points[ray.origin.index()];
        double spacing_below = 0;
        for (std::size_t n = 0; n < ray.layers; ++n) {
            const Point p = layer.points[ray.first_point + n];
            EXPECT_TRUE(vertices.contains({p.x, p.y}));
            const double spacing = distance(below, p);
            const double expected = n == 0 ? test::first_height(options) : options.growth * spacing_below;
            EXPECT_NEAR(spacing, expected, 0.01 * expected) << n;
            below = p;
            spacing_below = spacing;
        }
    }
    EXPECT_GT(full, 100u);
}

TEST_F(MeshCommand, ThreadsDoNotChangeTheFiles) {
    for (const char* threads : {"1", "2", "4"}) {
        const std::string stem = std::string("t") + threads;
        const ProgramRun again = run_lamina(
            folder(), thesis_case({"-o", stem + ".su2", "-o", stem + ".vtu", "--threads", threads, "--quiet"}));
        ASSERT_EQ(again.exit_code, 0) << again.err;
        EXPECT_EQ(again.out, "");
        EXPECT_TRUE(folder().read(stem + ".su2") == folder().read("n.su2")) << threads;
        EXPECT_TRUE(folder().read(stem + ".vtu") == folder().read("n.vtu")) << threads;
        std::filesystem::remove(folder() / (stem + ".su2"));
        std::filesystem::remove(folder() / (stem + ".vtu"));
    }
}

TEST(MeshOfGivenPoints, SaysHowManyPointsItAdds) {
    const TemporaryFolder folder;
    const auto said = [&](const std::vector<std::string>& options) {
        std::vector<std::string> words{"mesh", "naca:0012:60", "--surface", "keep", "-o", "a.su2"};
        words.insert(words.end(), options.begin(), options.end());
        return run_lamina(folder, words).out;
    };
    EXPECT_NE(said({}).find("points added by refining rays"), std::string::npos);
    EXPECT_NE(said({"--max-ray-angle", "40"}).find("no points added"), std::string::npos);
}

TEST_F(MeshCommand, PlotsEveryFormat) {
    const TemporaryFolder pictures;
    const std::string mesh = (folder() / "n.vtu").string();
    for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
        const ProgramRun plot =
            run_lamina(pictures, {"plot", mesh, "-o", name, "--window", "-0.1,0.1,-0.1,0.1", "--color", "quality"});
        EXPECT_EQ(plot.exit_code, 0) << plot.err;
        EXPECT_GT(pictures.read(name).size(), 1000u) << name;
    }
}

TEST_F(MeshCommand, ACutFileIsNoMesh) {
    const TemporaryFolder broken;
    const std::string whole = folder().read("n.su2");
    broken.write("cut.su2", whole.substr(0, whole.size() / 2));
    const ProgramRun run = run_lamina(broken, {"check", "cut.su2"});
    EXPECT_TRUE(run.exit_code == 3 || run.exit_code == 4) << run.exit_code;
    EXPECT_TRUE(run.err.starts_with("lamina: error: cut.su2")) << run.err;
}

/// Meshes the input with 30 layers, and expects a valid Delaunay mesh that keeps the angle bound.
void expect_good_mesh(const std::string& input) {
    SCOPED_TRACE(input);
    const TemporaryFolder folder;
    const ProgramRun mesh =
        run_lamina(folder, {"mesh", input, "--first-height", "2.5e-5", "--growth", "1.15", "--layers", "30",
                            "--far-field", "50", "-o", "a.vtu", "-o", "a.su2", "--report", "r.json"});
    ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
    const Json r = Json::parse(folder.read("r.json"));
    const Json isotropic = r["quality"]["isotropic"];
    const auto exempt = isotropic["exempt"].get<std::size_t>();
    EXPECT_LE(isotropic["angles_below_bound"].get<std::size_t>(), exempt);
    EXPECT_LT(static_cast<double>(exempt), 0.001 * r["isotropic_triangles"].get<double>());
    for (const char* file : {"a.vtu", "a.su2"}) {
        std::vector<std::string> arguments{"check", file, "--far", "farfield"};
        if (file == std::string("a.vtu")) arguments.emplace_back("--require-delaunay");
        const ProgramRun check = run_lamina(folder, arguments);
        EXPECT_EQ(check.exit_code, 0) << check.err;
    }
}

TEST(MeshOfRealSections, GeneratedOnes) {
    expect_good_mesh("naca:0012:200:blunt");
    expect_good_mesh("naca:23012");
    expect_good_mesh("naca:4412:90");
}

TEST(MeshOfRealSections, Measured) {
    const char* shared = std::getenv("LAMINA_SHARED");
    const std::filesystem::path folder =
        std::filesystem::path(shared != nullptr ? shared : LAMINA_SOURCE_DIR "/../shared") / "geometry/uiuc/selig";
    for (const char* name : {"rae2822.dat", "e387.dat", "s1223.dat", "naca63a210.dat", "n0012.dat", "goe417a.dat"}) {
        if (std::filesystem::exists(folder / name)) expect_good_mesh((folder / name).string());
    }
}

TEST(CheckCommand, AnInvalidMeshIsExitCode4) {
    const TemporaryFolder folder;
    folder.write("bad.su2",
                 "NDIME= 2\nNELEM= 2\n5 0 1 2 0\n5 0 3 2 1\nNPOIN= 4\n0 0 0\n1 0 1\n1 1 2\n0 1 3\nNMARK= 1\n"
                 "MARKER_TAG= wall\nMARKER_ELEMS= 4\n3 0 1\n3 1 2\n3 2 3\n3 3 0\n");
    const ProgramRun run = run_lamina(folder, {"check", "bad.su2"});
    EXPECT_EQ(run.exit_code, 4) << run.err;
    EXPECT_NE(run.out.find("not valid"), std::string::npos) << run.out;
    EXPECT_TRUE(run.err.starts_with("lamina: error: bad.su2: not valid")) << run.err;
}

/// Returns a mesh of one triangle of order 2, whose corners are in this order, with the middle of its first edge at
/// this y.
std::string curved_triangle(double y, bool is_inverted = false) {
    const std::string names = "$PhysicalNames\n1\n1 1 \"wall\"\n$EndPhysicalNames\n";
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + names + "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.5 " +
           std::to_string(y) + " 0\n5 0.5 0.5 0\n6 0 0.5 0\n$EndNodes\n$Elements\n4\n" +
           "1 8 2 1 1 1 2 4\n2 8 2 1 1 2 3 5\n3 8 2 1 1 3 1 6\n" +
           (is_inverted ? "4 9 2 0 0 1 3 2 6 5 4\n" : "4 9 2 0 0 1 2 3 4 5 6\n") + "$EndElements\n";
}

TEST(CurvedFiles, AreConvertedDrawnAndViewed) {
    const TemporaryFolder folder;
    folder.write("good.msh", curved_triangle(-0.1));
    EXPECT_EQ(run_lamina(folder, {"convert", "good.msh", "good.vtu"}).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"convert", "good.vtu", "again.msh", "--format", "msh22"}).exit_code, 0);
    const ProgramRun checked = run_lamina(folder, {"check", "again.msh", "--json"});
    EXPECT_EQ(Json::parse(checked.out)["curved"]["order"], 2) << checked.err;
    EXPECT_EQ(run_lamina(folder, {"convert", "good.vtu", "good.xml"}).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"check", "good.xml"}).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"convert", "good.xml", "of_xml.msh", "--format", "msh22"}).exit_code, 0);
    EXPECT_EQ(folder.read("of_xml.msh"), folder.read("again.msh"));
    for (const char* file : {"good.vtu", "good.xml"}) {
        EXPECT_EQ(run_lamina(folder, {"plot", file, "-o", "good.png"}).exit_code, 0);
        EXPECT_EQ(run_lamina(folder, {"view", file, "--no-open"}).exit_code, 0);
    }
    const ProgramRun refused = run_lamina(folder, {"convert", "good.vtu", "good.su2"});
    EXPECT_NE(refused.err.find("format 'su2' holds straight cells"), std::string::npos) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "good.su2"));
}

TEST(CurvedFiles, OfGaussAndLobattosNodesStayWithFormatsThatHoldThem) {
    const TemporaryFolder folder;
    const std::vector<std::string> words{
        "mesh",        "naca:0012", "--order",     "3",   "--layer-topology",    "quads",         "--layers", "4",
        "--far-field", "3",         "--gradation", "0.4", "--node-distribution", "gauss-lobatto", "-o"};
    const auto to = [&](const char* file) {
        std::vector<std::string> all = words;
        all.emplace_back(file);
        return all;
    };
    const ProgramRun refused = run_lamina(folder, to("m.msh"));
    EXPECT_EQ(refused.exit_code, usage);
    EXPECT_NE(refused.err.find("format 'msh41' has evenly spaced nodes"), std::string::npos) << refused.err;
    ASSERT_EQ(run_lamina(folder, to("m.xml")).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"check", "m.xml"}).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"plot", "m.xml", "-o", "m.png"}).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"convert", "m.xml", "m.mesh"}).exit_code, 0);
    EXPECT_NE(folder.read("m.mesh").find(" H1_2D_P3\n"), std::string::npos);
    EXPECT_EQ(run_lamina(folder, {"convert", "m.xml", "m.vtu"}).exit_code, usage);
}

TEST(CheckCommand, ProvesCurvedCells) {
    const TemporaryFolder folder;
    folder.write("good.msh", curved_triangle(-0.1));
    folder.write("folded.msh", curved_triangle(0.6));
    folder.write("inverted.msh", curved_triangle(0, true));
    const ProgramRun good = run_lamina(folder, {"check", "good.msh", "--json"});
    EXPECT_EQ(good.exit_code, 0) << good.err;
    const Json report = Json::parse(good.out);
    EXPECT_EQ(report["valid"], true);
    EXPECT_EQ(report["curved"]["order"], 2);
    EXPECT_EQ(report["curved"]["valid"], true);
    EXPECT_GT(report["curved"]["min_scaled_jacobian"], 0);

    const ProgramRun folded = run_lamina(folder, {"check", "folded.msh", "--json"});
    EXPECT_EQ(folded.exit_code, mesh_failed);
    EXPECT_TRUE(folded.err.starts_with("lamina: error: folded.msh: not valid")) << folded.err;
    const Json of_folded = Json::parse(folded.out);
    EXPECT_EQ(of_folded["valid"], false);
    EXPECT_EQ(of_folded["defect_count"], 0);
    EXPECT_EQ(of_folded["curved"]["invalid"], 1);
    EXPECT_EQ(of_folded["curved"]["defects"].size(), 1u);
    EXPECT_TRUE(of_folded["shortcomings"].empty());
    const std::string text = run_lamina(folder, {"check", "folded.msh"}).out;
    EXPECT_NE(text.find("defect"), std::string::npos) << text;
    EXPECT_EQ(text.find("required"), std::string::npos) << text;

    // Nothing is said of curved cells where the straight mesh is not valid.
    const ProgramRun inverted = run_lamina(folder, {"check", "inverted.msh", "--json"});
    EXPECT_EQ(inverted.exit_code, mesh_failed);
    EXPECT_FALSE(Json::parse(inverted.out).contains("curved"));
    EXPECT_EQ(run_lamina(folder, {"check", "inverted.msh"}).out.find("curved"), std::string::npos);
}

TEST(CheckCommand, AMarkerThatIsMissingIsExitCode4) {
    const TemporaryFolder folder;
    folder.write("square.su2",
                 "NDIME= 2\nNELEM= 2\n5 0 1 2 0\n5 0 2 3 1\nNPOIN= 4\n0 0 0\n1 0 1\n1 1 2\n0 1 3\nNMARK= 1\n"
                 "MARKER_TAG= box\nMARKER_ELEMS= 4\n3 0 1\n3 1 2\n3 2 3\n3 3 0\n");
    EXPECT_EQ(run_lamina(folder, {"check", "square.su2", "--far", "box"}).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"check", "square.su2", "--wall", "airfoil"}).exit_code, 4);
    EXPECT_EQ(run_lamina(folder, {"check", "square.su2", "--min-angle", "50"}).exit_code, 4);
}

TEST(MeshCommandOptions, TheFormatGoesOverTheExtension) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(folder, {"mesh", "naca:0012:40", "--no-layers", "--far-field", "2", "-o",
                                               "a.grid", "-o", "b.su2", "--format", "su2"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(folder.read("a.grid"), folder.read("b.su2"));
}

TEST(MeshCommandOptions, TheSummaryNamesEveryFile) {
    const TemporaryFolder folder;
    const std::vector<std::string> files{"m.su2", "m.vtu", "walls.csv", "r.json", "r.html"};
    const ProgramRun run = run_lamina(folder, {"mesh", "naca:0012", "--no-layers", "-o", files[0], "-o", files[1],
                                               "--wall-data", files[2], "--report", files[3], "--html", files[4]});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    for (const std::string& file : files) {
        EXPECT_NE(run.out.find("wrote       " + file + "\n"), std::string::npos) << run.out;
        EXPECT_TRUE(std::filesystem::exists(folder / file));
    }
}

TEST(MeshCommandOptions, ThePageIsNamedAfterTheSection) {
    const TemporaryFolder folder;
    const auto title_of = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "mesh");
        for (const char* argument : {"--no-layers", "--far-field", "3", "-o", "m.su2", "--html", "m.html"})
            arguments.emplace_back(argument);
        const ProgramRun run = run_lamina(folder, arguments);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        const std::string page = folder.read("m.html");
        const std::size_t begin = page.find("<title>") + 7;
        return page.substr(begin, page.find("</title>") - begin);
    };
    folder.write("file.dat", "A plate\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n");
    EXPECT_EQ(title_of({"naca:0012:40"}), "NACA 0012");
    EXPECT_EQ(title_of({"file.dat"}), "A plate");
    EXPECT_EQ(title_of({"file.dat", "naca:0012:40", "--names", "front,rear", "--transform", "rear:shift:2,0"}),
              "front, rear");
}

TEST(MeshCommandOptions, ProgressGoesToStandardError) {
    const TemporaryFolder folder;
    const std::vector<std::string> arguments{"mesh", "naca:0012:40", "--no-layers", "--far-field",
                                             "2",    "-o",           "a.vtu",       "--progress"};
    const auto with = [&](const char* shown) {
        std::vector<std::string> all = arguments;
        all.emplace_back(shown);
        return run_lamina(folder, all);
    };
    const ProgramRun always = with("always");
    EXPECT_EQ(always.exit_code, 0) << always.err;
    EXPECT_NE(always.err.find("lamina: "), std::string::npos);
    EXPECT_EQ(with("auto").err, "");
    EXPECT_EQ(with("never").err, "");
}

}  // namespace
}  // namespace lamina::test
