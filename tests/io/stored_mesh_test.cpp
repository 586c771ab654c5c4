// read_stored_mesh() reads what read_mesh() reads, with arrays in temporary files, and the check finds the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/mesh.hpp>

#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

template <class T>
std::vector<T> copy_of(std::span<const T> values) {
    return {values.begin(), values.end()};
}

void expect_same_as(const MeshView& view, const Mesh& mesh) {
    EXPECT_EQ(copy_of(view.points), mesh.points);
    EXPECT_EQ(view.triangles.size(), mesh.triangles.size());
    EXPECT_EQ(view.quads.size(), mesh.quads.size());
    EXPECT_EQ(mesh_hash(view), mesh_hash(mesh));
    EXPECT_EQ(copy_of(view.region), mesh.region);
    EXPECT_EQ(copy_of(view.piece), mesh.piece);
    EXPECT_EQ(copy_of(view.layer), mesh.layer);
    EXPECT_EQ(copy_of(view.constraints), mesh.constraints);
    ASSERT_EQ(view.markers.size(), mesh.markers.size());
    for (std::size_t m = 0; m < mesh.markers.size(); ++m) {
        EXPECT_EQ(view.markers[m].name, mesh.markers[m].name);
        EXPECT_EQ(view.markers[m].kind, mesh.markers[m].kind);
        EXPECT_EQ(view.markers[m].edges, mesh.markers[m].edges);
    }
    const MeshCheck one = check_mesh(view), other = check_mesh(mesh);
    EXPECT_TRUE(one.valid());
    EXPECT_EQ(one.defect_count, other.defect_count);
    EXPECT_EQ(one.area, other.area);
    EXPECT_EQ(one.euler_characteristic, other.euler_characteristic);
    EXPECT_EQ(one.delaunay_violations, other.delaunay_violations);
    EXPECT_EQ(one.isotropic.mean_ratio, other.isotropic.mean_ratio);
    EXPECT_EQ(one.unexcused_cells, other.unexcused_cells);
}

Mesh sample() { return test::annulus({.around = 200, .rings = 12, .layer_rings = 4, .quads_in_layer = true}); }

TEST(StoredMesh, IsThatOfTheFileInEveryFormat) {
    const test::TemporaryFolder folder;
    for (const std::string format : {"su2", "vtu", "vtu-zlib", "msh41", "msh22-binary"}) {
        SCOPED_TRACE(format);
        const auto file = folder.path() / (format + ".mesh");
        write_mesh(sample(), file, {.format = format});
        const Mesh mesh = read_mesh(file, {.format = format});
        const StoredMesh small = read_stored_mesh(file, {.format = format});
        EXPECT_FALSE(small.in_files());
        expect_same_as(small.view(), mesh);
        const StoredMesh large = read_stored_mesh(file, {.format = format, .max_bytes_in_memory = 0});
        EXPECT_EQ(large.in_files(), format == "su2" || format.starts_with("vtu"));
        expect_same_as(large.view(), mesh);
        // A view is written as the mesh is.
        write_mesh(large.view(), folder.path() / "again", {.format = format});
        EXPECT_EQ(read_file(folder.path() / "again"), read_file(file));
    }
}

TEST(StoredMesh, CanBeChanged) {
    const test::TemporaryFolder folder;
    write_mesh(sample(), folder.path() / "m.su2");
    StoredMesh stored = read_stored_mesh(folder.path() / "m.su2", {.max_bytes_in_memory = 0});
    stored.markers().front().kind = MarkerKind::symmetry;
    stored.set_region(std::vector<Region>(stored.view().triangles.size() + stored.view().quads.size(), Region::layer));
    EXPECT_EQ(stored.view().markers.front().kind, MarkerKind::symmetry);
    EXPECT_EQ(check_mesh(stored.view()).isotropic.cells, 0u);
}

TEST(MeshSink, RefusesNamesThatTheFormatDoesNotTake) {
    const test::TemporaryFolder folder;
    const std::vector<Marker> markers{{"none", MarkerKind::wall, {}}};
    EXPECT_ANY_THROW(open_mesh_sink(folder / "m.su2", {})->finish({}, markers, {}));
    EXPECT_NO_THROW(open_mesh_sink(folder / "m.vtu", {})->finish({}, markers, {}));
}

TEST(StoredMesh, RefusesDamagedFilesWithTheSameMessage) {
    const test::TemporaryFolder folder;
    for (const std::string name : {"m.su2", "m.vtu"}) {
        const auto file = folder.path() / name;
        write_mesh(sample(), file);
        const std::string whole = read_file(file);
        for (const std::size_t kept : {whole.size() / 10, whole.size() / 3, whole.size() / 2, whole.size() - 200}) {
            write_file(file, whole.substr(0, kept));
            std::string one, other;
            try {
                read_mesh(file);
            } catch (const InputError& error) {
                one = error.what();
            }
            try {
                read_stored_mesh(file, {.max_bytes_in_memory = 0});
            } catch (const InputError& error) {
                other = error.what();
            }
            EXPECT_FALSE(one.empty());
            EXPECT_EQ(one, other);
        }
    }
}

}  // namespace
}  // namespace lamina
