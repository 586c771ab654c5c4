// The promises of every format: meshes are read back as they were written, broken files are refused, and failures leave
// nothing behind.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <random>
#include <string>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "core/parallel.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {

/// Prints the parameter of a test in the messages of GoogleTest.
static void PrintTo(const MeshFormat& format, std::ostream* stream) { *stream << format.name; }

namespace {

using test::annulus;
using test::box_with_hole;
using test::shuffled;
using test::TemporaryFolder;

/// Tests of one format. A mesh is one file or several, so each mesh gets a folder of its own.
class EveryFormat : public testing::TestWithParam<MeshFormat> {
protected:
    /// The files of a mesh: their names in its folder, and their contents.
    using Parts = std::map<std::filesystem::path, std::string>;

    void SetUp() override {
        if (!GetParam().readable) GTEST_SKIP() << "cannot be read here";
    }
    void write(const Mesh& mesh, const std::string& name = "m") const {
        std::filesystem::create_directory(folder_ / name);
        write_mesh(path(name), mesh);
    }
    void write_mesh(const std::filesystem::path& file, const Mesh& mesh) const {
        lamina::write_mesh(mesh, file, {.format = GetParam().name});
    }
    Mesh read(const std::string& name = "m") const { return read_mesh(path(name)); }
    std::filesystem::path path(const std::string& name = "m") const { return folder_ / name / file_name(); }
    std::string file_name() const {
        const std::string extension = GetParam().extensions.front();
        return extension.starts_with('.') ? "m" + extension : extension;
    }
    Parts parts(const std::string& name = "m") const {
        Parts parts;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / name))
            if (entry.is_regular_file()) {
                const auto part = std::filesystem::relative(entry.path(), folder_.path());
                parts[std::filesystem::relative(entry.path(), folder_ / name)] = folder_.read(part.string());
            }
        return parts;
    }
    /// Writes and reads a damaged mesh. Returns its hash, or an empty text where an InputError of one line is thrown.
    std::string hash_or_complaint(const Parts& parts) {
        for (const auto& [part, content] : parts) {
            const auto written = on_disk_.find(part);
            if (written != on_disk_.end() && written->second == content) continue;
            on_disk_[part] = content;
            const std::filesystem::path file = folder_ / "damaged" / part;
            std::filesystem::create_directories(file.parent_path());
            std::filesystem::remove(file);  // some file systems wait for the disk when a file is overwritten
            std::ofstream(file, std::ios::binary) << content;
        }
        try {
            const Mesh mesh = read("damaged");
            check_mesh(mesh);  // must not crash, whatever was read
            return mesh_hash(mesh);
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            return {};
        }
    }

    TemporaryFolder folder_;
    Parts on_disk_;  ///< the damaged mesh as it was last written
};

std::vector<Mesh> sample_meshes() {
    std::vector<Mesh> meshes{annulus(),
                             annulus({.quads_in_layer = true}),
                             annulus({.rings = 2, .quads_in_layer = true}),
                             shuffled(annulus(), 1),
                             shuffled(annulus({.quads_in_layer = true}), 3),
                             box_with_hole(),
                             shuffled(annulus({.around = 300, .rings = 40}), 2)};
    Mesh& negative_zero = meshes.front();
    negative_zero.points[3].y = -0.0;
    negative_zero.markers[0].name = "main_wing.upper-2";
    return meshes;
}

TEST_P(EveryFormat, ComesBackAsItWas) {
    for (const Mesh& mesh : sample_meshes()) {
        if (!mesh.quads.empty() && !GetParam().quads) {
            EXPECT_THROW(write(mesh), UsageError);
            continue;
        }
        write(mesh);
        const Mesh back = read();
        EXPECT_EQ(mesh_hash(mesh), mesh_hash(back));
        EXPECT_EQ(mesh.points, back.points);  // also in the same order, with the walls first
        EXPECT_EQ(check_mesh(mesh).valid(), check_mesh(back).valid());
        ASSERT_EQ(back.markers.size(), mesh.markers.size());
        for (std::size_t m = 0; m < mesh.markers.size(); ++m) {
            EXPECT_EQ(back.markers[m].name, mesh.markers[m].name);
            std::vector<Segment> found = back.markers[m].edges, expected = mesh.markers[m].edges;
            if (GetParam().name == "nektar")  // which numbers edges by cells, and lists them by their numbers
                for (auto* edges : {&found, &expected}) std::sort(edges->begin(), edges->end());
            EXPECT_EQ(found, expected);
        }
        // A mesh that was read back is written to the same files.
        write(back, "again");
        EXPECT_EQ(mesh_hash(read("again")), mesh_hash(mesh));
        EXPECT_EQ(parts().size(), parts("again").size());
    }
}

TEST_P(EveryFormat, IsTheSameForAnyNumberOfThreads) {
    if (GetParam().name.starts_with("cgns")) GTEST_SKIP() << "the library writes times and what lies in its buffers";
    const Mesh mesh = annulus({.around = 500, .rings = 100, .layer_rings = 50, .quads_in_layer = GetParam().quads});
    with_threads(1, [&] { write(mesh, "one"); });
    with_threads(4, [&] { write(mesh, "four"); });
    EXPECT_TRUE(parts("one") == parts("four"));
}

TEST_P(EveryFormat, LosesNothingInSilenceWhereItIsCutShort) {
    const Mesh mesh = annulus({.around = 4, .rings = 2, .layer_rings = 1, .quads_in_layer = GetParam().quads});
    write(mesh);
    const Parts whole = parts();
    EXPECT_EQ(hash_or_complaint(whole), mesh_hash(mesh));
    // The CGNS library takes a hundred times as long as other readers.
    const std::size_t places = (GetParam().name.starts_with("cgns") ? 100 : 1000) / whole.size();
    for (const auto& [part, content] : whole) {
        if (part.extension() == ".edge") continue;  // is not read, since it follows from the triangles
        const std::size_t step = 1 + content.size() / places;
        Parts cut = whole;
        // Nothing in a .mapbc file shows that the name at its end was shortened.
        const std::size_t end = part.extension() == ".mapbc" ? content.rfind(' ') : content.size();
        for (std::size_t length = 0; length < end; length += step) {
            cut[part] = content.substr(0, length);
            const std::string hash = hash_or_complaint(cut);
            EXPECT_TRUE(hash.empty() || hash == mesh_hash(mesh)) << part << " " << length;
            EXPECT_TRUE(hash.empty() || length > content.size() / 2) << part << " " << length;
        }
    }
}

TEST_P(EveryFormat, SurvivesRandomDamage) {
    std::mt19937 random(7);
    write(annulus({.around = 6, .rings = 2, .layer_rings = 1, .quads_in_layer = GetParam().quads}));
    const Parts whole = parts();
    // The CGNS library keeps damaged files open and limits the number of open files.
    const int trials = GetParam().name.starts_with("cgns") ? 30 : 1000;
    for (int trial = 0; trial < trials; ++trial) {
        Parts damaged_parts = whole;
        std::string& damaged = std::next(damaged_parts.begin(), random() % damaged_parts.size())->second;
        for (unsigned hits = 1 + random() % 4; hits > 0; --hits) {
            const std::size_t at = random() % damaged.size();
            switch (random() % 5) {
                case 0:
                    damaged[at] = static_cast<char>(random());
                    break;
                case 1:
                    damaged[at] = "0123456789-= <>\"\n%$"[random() % 19];
                    break;
                case 2:
                    damaged.erase(at, 1 + random() % 9);
                    break;
                case 3:
                    damaged.insert(at, "99999999999999999999", random() % 20);
                    break;
                default:
                    damaged.insert(at, damaged.substr(random() % damaged.size(), 1 + random() % 20));
            }
        }
        hash_or_complaint(damaged_parts);
    }
}

TEST_P(EveryFormat, FailuresLeaveNothingBehind) {
    const Mesh mesh = annulus();
    folder_.write("file", "");
    // A folder stands in the place of the file, or a file in the place of the folder.
    std::filesystem::create_directory(folder_ / "taken");
    if (path("taken").has_extension())
        std::filesystem::create_directory(path("taken"));
    else
        std::ofstream(path("taken")) << "x";
    std::filesystem::create_directory(folder_ / "locked");
    std::filesystem::permissions(folder_ / "locked", std::filesystem::perms::owner_read);
    std::vector<std::filesystem::path> unwritable{path("file"), path("taken")};
    if (path().has_extension()) unwritable.push_back(path("none"));  // for a polyMesh, missing folders are made
    if (geteuid() != 0) unwritable.push_back(path("locked"));        // root may write everywhere
    const auto before = folder_.names();
    for (const std::filesystem::path& file : unwritable) {
        EXPECT_THROW(check_writable(file, {.format = GetParam().name}), IoError) << file;
        EXPECT_THROW(write_mesh(file, mesh), IoError) << file;
        EXPECT_THROW(read_mesh(file), IoError) << file;
        EXPECT_EQ(parts("taken").size(), path("taken").has_extension() ? 0 : 1);
    }
    EXPECT_EQ(folder_.names(), before);
}

INSTANTIATE_TEST_SUITE_P(Io, EveryFormat, testing::ValuesIn(mesh_formats()), [](const auto& named) {
    std::string name = named.param.name;
    std::erase(name, '-');
    return name;
});

}  // namespace
}  // namespace lamina
