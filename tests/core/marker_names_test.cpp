// Names of markers that every format, solver and shell takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <lamina/marker_names.hpp>

#include "core/marker_names.hpp"

namespace lamina {
namespace {

std::string legal_wall(const std::string& name) { return legal_marker_name(name, MarkerKind::wall); }

std::vector<std::string> legal_walls(const std::vector<std::string>& names) {
    std::vector<core::NamedMarker> markers;
    for (const std::string& name : names) markers.push_back({name, MarkerKind::wall});
    return core::legal_marker_names(markers);
}

TEST(MarkerNames, LegalOnesStay) {
    for (const std::string name : {"airfoil", "main-2", "S1223.v2", "naca0012", "x", "A_b", "wall", "e1", "none2",
                                   "farfield_wall", "Layer2", "abcdefghijklmnopqrstuvwxyz012345"})
        EXPECT_EQ(legal_wall(name), name);
    for (const MarkerKind kind : {MarkerKind::far_field, MarkerKind::symmetry, MarkerKind::other})
        for (const std::string name : {"farfield", "inlet", "Outlet", "symmetry"})
            EXPECT_EQ(legal_marker_name(name, kind), name);
}

TEST(MarkerNames, OthersAreChangedSoThatTheyStillSayWhatWasMeant) {
    EXPECT_EQ(legal_wall("0012"), "wall_0012");
    EXPECT_EQ(legal_wall("63-215"), "wall_63-215");
    EXPECT_EQ(legal_wall("30p30n_1"), "wall_30p30n_1");
    EXPECT_EQ(legal_wall("1e5"), "wall_1e5");
    EXPECT_EQ(legal_wall(".5"), "wall_.5");
    EXPECT_EQ(legal_wall("-1"), "wall_-1");
    EXPECT_EQ(legal_wall("+"), "wall__");
    EXPECT_EQ(legal_wall("_x"), "wall__x");
    EXPECT_EQ(legal_wall(""), "wall_");
    EXPECT_EQ(legal_wall("main element (v2)"), "main_element__v2_");
    EXPECT_EQ(legal_wall("fl\xC3\xBCgel"), "fl_gel");
    EXPECT_EQ(legal_wall("a/../b;$c`d'e\"f\n%"), "a_.._b__c_d_e_f__");
    EXPECT_EQ(legal_wall(std::string(40, 'f')), std::string(32, 'f'));
    EXPECT_EQ(legal_wall("NaN"), "wall_NaN");
    EXPECT_EQ(legal_wall("NONE"), "wall_NONE");
    EXPECT_EQ(legal_wall("y0"), "wall_y0");
    EXPECT_EQ(legal_wall("ZoneBC"), "wall_ZoneBC");
    EXPECT_EQ(legal_wall("frontAndBack"), "wall_frontAndBack");
    EXPECT_EQ(legal_wall("FarField 1"), "wall_FarField_1");
    EXPECT_EQ(legal_wall("inlet"), "wall_inlet");
    EXPECT_EQ(legal_marker_name("7", MarkerKind::far_field), "far_7");
    EXPECT_EQ(legal_marker_name("7", MarkerKind::symmetry), "symmetry_7");
    EXPECT_EQ(legal_marker_name("7", MarkerKind::other), "marker_7");
}

// A format without kinds tells them by names.
TEST(MarkerNames, ChangedOnesReadAsTheirKind) {
    for (const MarkerKind kind : {MarkerKind::wall, MarkerKind::far_field, MarkerKind::symmetry, MarkerKind::other})
        EXPECT_EQ(core::kind_of_name(legal_marker_name("2", kind)), kind);
    EXPECT_TRUE(may_be_wall(core::kind_of_name(legal_wall("farfield"))));
}

TEST(MarkerNames, AreDistinguishedWhateverTheCase) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(legal_walls({"a b", "a_b"}), (Names{"a_b_2", "a_b"}));
    EXPECT_EQ(legal_walls({"a b", "a+b", "a:b"}), (Names{"a_b", "a_b_2", "a_b_3"}));
    EXPECT_EQ(legal_walls({"Flap", "flap", "FLAP"}), (Names{"Flap", "flap_2", "FLAP_3"}));
    EXPECT_EQ(legal_walls({"1", "wall_1"}), (Names{"wall_1_2", "wall_1"}));
    EXPECT_EQ(legal_walls({std::string(33, 'x'), std::string(34, 'x')}),
              (Names{std::string(32, 'x'), std::string(30, 'x') + "_2"}));
}

TEST(MarkerNames, AreLegalUniqueAndStayForRandomBytes) {
    std::mt19937 random(1);
    const std::string likely = "aA1._-+ \n%$\xC3\xBC";
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<core::NamedMarker> markers(1 + random() % 12);
        for (core::NamedMarker& marker : markers) {
            marker.kind = static_cast<MarkerKind>(random() % 4);
            for (unsigned n = random() % (trial % 2 == 0 ? 4 : 40); n > 0; --n)
                marker.name += likely[random() % likely.size()];
        }
        const std::vector<std::string> names = core::legal_marker_names(markers);
        ASSERT_EQ(names.size(), markers.size());
        std::set<std::string> used;
        for (std::size_t i = 0; i < names.size(); ++i) {
            const std::string& name = names[i];
            ASSERT_FALSE(name.empty());
            EXPECT_TRUE(std::isalpha(static_cast<unsigned char>(name.front()))) << name;
            EXPECT_TRUE(std::all_of(name.begin(), name.end(), [](char c) {
                return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
            })) << name;
            EXPECT_LE(name.size(), core::max_marker_name);
            std::string lower;
            for (const char c : name) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            EXPECT_TRUE(used.insert(lower).second) << name;
            markers[i].name = name;
        }
        EXPECT_EQ(core::legal_marker_names(markers), names);
    }
}

TEST(MarkerNames, TheWarningSaysBothNamesAndWhy) {
    const auto message = [](const std::string& name) {
        return core::renamed_marker_warning({name, MarkerKind::wall}, legal_wall(name)).message;
    };
    EXPECT_EQ(message("0012"), "the name '0012' does not begin with a letter: the marker is 'wall_0012'");
    EXPECT_EQ(message("a b"),
              "the name 'a b' has characters other than letters, digits and _ - .: the marker is 'a_b'");
    EXPECT_NE(message("none").find("means something else to a format or a solver"), std::string::npos);
    EXPECT_NE(message("Inlet").find("reads as that of an outer boundary"), std::string::npos);
    EXPECT_NE(message(std::string(33, 'x')).find("more than 32 characters"), std::string::npos);
    EXPECT_NE(core::renamed_marker_warning({"a", MarkerKind::wall}, "a_2").message.find("by case alone"),
              std::string::npos);
}

}  // namespace
}  // namespace lamina
