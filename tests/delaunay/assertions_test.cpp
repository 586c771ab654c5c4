// The builds that run the tests have assertions, in headers and in the library (LAMINA_ASSERTIONS).
#include <gtest/gtest.h>

#include "delaunay/triangulate/link_triangles.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::test {
namespace {

using namespace delaunay;

class Assertions : public testing::Test {
protected:
    void SetUp() override {
#ifdef NDEBUG
        FAIL() << "this build has no assertions; ./dev test configures it with -DLAMINA_ASSERTIONS=ON";
#endif
        GTEST_FLAG_SET(death_test_style, "threadsafe");
    }

    /// Two triangles, (0, 1, 2) and (2, 1, 3), whose common edge is constrained.
    Tris tris_ = link_triangles(std::vector<Triangle>{{{VertexId{0u}, VertexId{1u}, VertexId{2u}}},
                                                      {{VertexId{2u}, VertexId{1u}, VertexId{3u}}}},
                                std::vector<Segment>{{VertexId{1u}, VertexId{2u}}});
};

TEST_F(Assertions, AreOnInHeaders) {
    release_edge(tris_, 0, 0);
    EXPECT_DEATH(release_edge(tris_, 0, 1), "is_border");
}

TEST_F(Assertions, AreOnInTheLibrary) {
    EXPECT_DEATH(flip_edge(tris_, 0, 0), "is_constrained");
    release_edge(tris_, 0, 0);
    flip_edge(tris_, 0, 0);
    EXPECT_TRUE(are_linked(tris_));
}

TEST_F(Assertions, FindLinksThatDoNotReferBack) {
    release_edge(tris_, 0, 0);
    tris_[1].n[tris_[0].n[0].edge()] = Link::border();
    EXPECT_DEATH(flip_edge(tris_, 0, 0), "is_linked");
}

}  // namespace
}  // namespace lamina::test
