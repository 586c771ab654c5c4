// A build without CGNS has no CGNS formats, and says so to those who ask for one.
#include <gtest/gtest.h>

#include <string>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

/// Calls f() and expects the reason why there is no CGNS.
template <class F>
void expect_reason(F&& f) {
    try {
        f();
        ADD_FAILURE() << "no error";
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("this lamina was built without CGNS"), std::string::npos)
            << error.what();
    }
}

TEST(WithoutCgns, RequestsAreRefusedWithTheReason) {
    for (const MeshFormat& format : mesh_formats()) EXPECT_FALSE(format.name.starts_with("cgns")) << format.name;
    const test::TemporaryFolder folder;
    for (const std::string name : {"cgns", "cgns-3d", "cgns-adf"})
        expect_reason([&] { write_mesh(test::tiny(), folder / "m.vtu", {.format = name}); });
    expect_reason([&] { write_mesh(test::tiny(), folder / "m.cgns"); });
    expect_reason([&] { check_writable(folder / "m.CGNS"); });
    expect_reason([&] { read_mesh(folder / "m.cgns"); });
    expect_reason([&] { read_sizes(folder / "m.cgns"); });
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace lamina
