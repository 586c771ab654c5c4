// Whatever the bytes of a damaged file, the reader ends with a Geometry that passes check_simple() or with an Error.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>
#include <lamina/surface.hpp>

#include "geometry/parse_airfoil.hpp"
#include "support/geometry_fixtures.hpp"
#include "support/mutator.hpp"
#include "surface/summary.hpp"

namespace lamina {
namespace {

using surface::summarize;

TEST(Fuzz, DamagedFilesGiveASimpleGeometryOrAnError) {
    std::vector<std::string> seeds = fixtures::same_loop;
    seeds.insert(seeds.end(), {fixtures::two_999, fixtures::two_blank, fixtures::two_labelled, fixtures::two_lednicer,
                               fixtures::open_base});
    const test::Mutator mutator(7, {"nan",
                                    "-inf",
                                    "1e999",
                                    "999.0 999.0\n",
                                    "\n\n",
                                    "#",
                                    ";",
                                    ",",
                                    "5 5\n",
                                    "1 0\n",
                                    std::string(1, '\0'),
                                    "0x1p3",
                                    "-",
                                    ".",
                                    "e",
                                    "D",
                                    "\xFF",
                                    "\t",
                                    "\r",
                                    "1e61",
                                    "4294967295 4294967295\n",
                                    "0 0 0\n",
                                    "1e8 1e8\n",
                                    "text\n",
                                    "-0",
                                    "1e-300"});
    test::expect_taken_or_refused(mutator, seeds, 20'000, [](const std::string& content) {
        const Geometry geometry = make_geometry(geometry::parse_airfoil(content, "fuzz.dat"), {});
        ASSERT_FALSE(geometry.elements.empty());
        ASSERT_NO_THROW(check_simple(geometry)) << content;
        ASSERT_FALSE(describe(geometry).empty());
        for (const Element& e : geometry.elements) {
            ASSERT_EQ(e.points.size(), e.lines.size());
            ASSERT_GT(summarize(e).area, 0);
        }
    });
}

}  // namespace
}  // namespace lamina
