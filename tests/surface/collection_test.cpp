// The reader and the resampling on a collection of real files. The tests are skipped unless it is found in the folder
// LAMINA_SHARED, or in ../shared beside the sources.
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>
#include <lamina/surface.hpp>

#include "surface/summary.hpp"

namespace lamina {
namespace {

namespace fs = std::filesystem;

fs::path collection() {
    const char* shared = std::getenv("LAMINA_SHARED");
    return (shared ? fs::path(shared) : fs::path(LAMINA_SOURCE_DIR) / ".." / "shared") / "geometry";
}

class Collection : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::is_directory(collection())) GTEST_SKIP() << "no collection of real files";
    }
    static Geometry read(const std::vector<std::string>& names) {
        std::vector<std::string> inputs;
        for (const std::string& name : names) inputs.push_back((collection() / name).string());
        return read_geometry(inputs);
    }
};

/// Files that are rightly refused, for crossings, folds, half outlines or damaged text.
const std::set<std::string> refused = {"special/ag40d-02r_crossing.dat",
                                       "special/count_mismatch.dat",
                                       "special/flat_plate.dat",
                                       "special/hn1033a_wrong_format.dat",
                                       "special/iced/iced_glc305_08040436.dat",
                                       "special/iced/iced_naca0015_624964.dat",
                                       "special/soartech/DF103.COR",
                                       "uiuc/aerosandbox/naca23021.dat",
                                       "uiuc/selig/e378.dat",
                                       "uiuc/selig/naca1.dat"};

TEST_F(Collection, EveryFileIsReadOrRefusedForAReason) {
    std::size_t accepted = 0;
    for (const auto& entry : fs::recursive_directory_iterator(collection())) {
        const std::string extension = entry.path().extension().string();
        if (!entry.is_regular_file() || extension == ".md" || extension == ".py") continue;
        const std::string name = fs::relative(entry.path(), collection()).generic_string();
        try {
            const Geometry geometry = read({name});
            EXPECT_FALSE(refused.contains(name)) << name;
            EXPECT_NO_THROW(check_simple(geometry)) << name;
            ++accepted;
        } catch (const InputError& e) {
            EXPECT_TRUE(refused.contains(name)) << e.what();
            EXPECT_FALSE(e.place().file.empty());
        }
    }
    EXPECT_GE(accepted, 197u);
}

TEST_F(Collection, CrossingTailsAreCutFoldsAreMendedAndNothingElseIsWarnedOf) {
    const std::set<std::string> cut = {
        "uiuc/lednicer/cap21c-il.dat", "uiuc/selig/dsma523a.dat", "uiuc/selig/e340.dat",     "uiuc/selig/fx38153.dat",
        "uiuc/selig/fx62k131.dat",     "uiuc/selig/fx63147.dat",  "uiuc/selig/fx72150b.dat", "uiuc/selig/mh150.dat"};
    const std::set<std::string> folded = {"special/soartech/E197.DAT",  "special/soartech/S2046.DAT",
                                          "special/soartech/S3002.DAT", "special/soartech/S3010.DAT",
                                          "special/wind/s818_60p.txt",  "uiuc/selig/eh3012.dat",
                                          "uiuc/selig/fx79w470a.dat"};
    for (const auto& entry : fs::recursive_directory_iterator(collection())) {
        const std::string name = fs::relative(entry.path(), collection()).generic_string();
        if (!entry.is_regular_file() || refused.contains(name) || entry.path().extension() == ".md" ||
            entry.path().extension() == ".py")
            continue;
        for (const Element& e : read({name}).elements) {
            std::vector<WarningCode> codes;
            for (const Warning& warning : e.warnings)
                if (warning.code != WarningCode::marker_renamed) codes.push_back(warning.code);
            EXPECT_EQ(codes.size(), cut.contains(name) || folded.contains(name) ? 1u : 0u) << name;
            for (const WarningCode code : codes)
                EXPECT_EQ(code, cut.contains(name) ? WarningCode::crossing_tail_cut : WarningCode::folded_outline)
                    << name;
        }
    }
}

TEST_F(Collection, EveryOutlineCanBeResampled) {
    SurfaceOptions options;
    options.treatment = SurfaceTreatment::resample;
    options.max_turning_deg = 5;
    std::size_t resampled = 0;
    for (const auto& entry : fs::recursive_directory_iterator(collection())) {
        const std::string name = fs::relative(entry.path(), collection()).generic_string();
        if (!entry.is_regular_file() || refused.contains(name) || entry.path().extension() == ".md" ||
            entry.path().extension() == ".py")
            continue;
        const Geometry given = read({name}), result = prepare_surfaces(given, options);
        EXPECT_NO_THROW(check_simple(result)) << name;
        for (std::size_t i = 0; i < result.elements.size(); ++i) {
            if (result.elements[i].points == given.elements[i].points) continue;
            ++resampled;
            const surface::ElementSummary s = surface::summarize(result.elements[i]);
            if (s.min_spacing < 1.5 * options.min_spacing * s.chord) continue;  // as at the base of s1221-4deg-flap
            EXPECT_LE(s.max_spacing_ratio, options.max_ratio) << name;
        }
    }
    EXPECT_GE(resampled, 180u);
}

TEST_F(Collection, FilesWithSeveralElements) {
    const std::map<std::string, std::vector<std::size_t>> expected = {
        {"multielement/30p30n_uiuc.dat", {200, 220, 255}},
        {"multielement/nlr7301_flap_gap26.dat", {456, 248}},
        {"multielement/nrl071_inverted_two_element.txt", {148, 138}},
        {"multielement/williams_two_element.dat", {61, 61}}};
    for (const auto& [name, sizes] : expected) {
        const Geometry geometry = read({name});
        ASSERT_EQ(geometry.elements.size(), sizes.size()) << name;
        for (std::size_t i = 0; i < sizes.size(); ++i) EXPECT_EQ(geometry.elements[i].points.size(), sizes[i]) << name;
    }
}

TEST_F(Collection, GroupsOfFiles) {
    const std::string folder = "multielement/";
    for (const std::vector<std::string>& group : std::vector<std::vector<std::string>>{
             {"nlr7301_main_sharp.dat", "nlr7301_flap_sharp.dat"},
             {"nlr7301_clean_main.dat", "nlr7301_clean_flap.dat"},
             {"s414_main.dat", "s414_aft.dat"},
             {"s1210_slat.dat", "s1210_base.dat"},
             {"30p30n_slat_5digit.xyd", "30p30n_main_5digit.xyd", "30p30n_flap_5digit.xyd"},
             {"crmhl2d_dense_slat.dat", "crmhl2d_dense_main.dat", "crmhl2d_dense_flap.dat"}}) {
        std::vector<std::string> names;
        for (const std::string& name : group) names.push_back(folder + name);
        EXPECT_EQ(read(names).elements.size(), group.size()) << group[0];
    }
    EXPECT_THROW(read({folder + "ua79sf187_main_open.dat", folder + "ua79sf187_flap.dat"}), InputError);
}

TEST_F(Collection, TheTwoFormatsOfASectionAgree) {
    for (const std::string name : {"clarky", "n0012", "ag03", "usa98"}) {
        const Element selig = read({"uiuc/selig/" + name + ".dat"}).elements[0],
                      lednicer = read({"uiuc/lednicer/" + name + "-il.dat"}).elements[0];
        ASSERT_EQ(selig.points.size(), lednicer.points.size()) << name;
        for (std::size_t i = 0; i < selig.points.size(); ++i)
            EXPECT_LT(distance(selig.points[i], lednicer.points[i]), 2e-6) << name << ' ' << i;
    }
}

}  // namespace
}  // namespace lamina
