// Background meshes: sizes at the vertices of VTU and MSH files.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "support/point_sets.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::TemporaryFolder;

struct PointArray {
    std::string name;
    std::vector<double> values;
    std::size_t components = 1;
};

/// Returns a VTU file of the mesh with these arrays of point data.
std::string vtu_with(const Mesh& mesh, const std::vector<PointArray>& arrays, const TemporaryFolder& folder) {
    write_mesh(mesh, folder / "plain.vtu");
    std::string bytes = folder.read("plain.vtu");
    const std::size_t first = bytes.find('_', bytes.find("<AppendedData")) + 1;
    const std::size_t end = bytes.rfind("\n  </AppendedData>");
    std::string header = "<PointData>\n", appended;
    for (const PointArray& array : arrays) {
        header += "<DataArray type=\"Float64\" Name=\"" + array.name + "\" NumberOfComponents=\"" +
                  std::to_string(array.components) + "\" format=\"appended\" offset=\"" +
                  std::to_string(end - first + appended.size()) + "\"/>\n";
        const std::uint64_t length = array.values.size() * sizeof(double);
        std::string stored(sizeof length + length, '\0');
        std::memcpy(stored.data(), &length, sizeof length);
        std::memcpy(stored.data() + sizeof length, array.values.data(), length);
        appended += stored;
    }
    bytes.insert(end, appended);
    return bytes.insert(bytes.find("<Points>"), header + "</PointData>\n");
}

std::vector<double> some_sizes(std::size_t n) {
    std::vector<double> sizes(n);
    for (std::size_t i = 0; i < n; ++i) sizes[i] = 0.1 + 0.01 * static_cast<double>(i);
    return sizes;
}

void expect_bad(const std::filesystem::path& file, const std::string& said) {
    try {
        read_sizes(file);
        ADD_FAILURE() << "accepted: " << said;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(file.filename().string()), std::string::npos) << error.what();
    }
}

TEST(Sizes, AreReadFromPointDataOfVtu) {
    const TemporaryFolder folder;
    const Mesh mesh = test::annulus({.quads_in_layer = true});
    const std::vector<double> sizes = some_sizes(mesh.points.size());
    const std::vector<double> other(mesh.points.size(), -1);
    const std::vector<double> vectors(3 * mesh.points.size(), 7);
    for (const auto& arrays : {std::vector<PointArray>{{"h", sizes}, {"velocity", vectors, 3}},
                               std::vector<PointArray>{{"mach", other}, {"size", sizes}, {"velocity", vectors, 3}}}) {
        const SizedMesh read = read_sizes(folder.write("a.vtu", vtu_with(mesh, arrays, folder)));
        EXPECT_EQ(read.points, mesh.points);
        EXPECT_EQ(read.sizes, sizes);
        EXPECT_EQ(read.triangles.size(), mesh.triangles.size() + 2 * mesh.quads.size());
    }
}

// --- VTU files as VTK, ParaView and meshio write them

std::string base64(const std::string& bytes) {
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
        };
        const unsigned quantum = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (unsigned k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : alphabet[quantum >> (18 - 6 * k) & 63];
    }
    return text;
}

struct VtuEncoding {
    std::string format = "ascii";  ///< "ascii", "binary", "raw" or "base64"
    bool compressed = false, long_header = false, big_endian = false;
};

/// Writes a VTU file in an encoding. The file holds two triangles on a square, sizes from 0.1 to 0.4 in single
/// precision, a vertex and a polyline as further cells, and cell data, one of which has a name that lamina uses for
/// something else.
class EncodedVtu {
public:
    explicit EncodedVtu(VtuEncoding encoding) : encoding_(std::move(encoding)) {}

    std::string file() {
        const bool appended = encoding_.format == "raw" || encoding_.format == "base64";
        std::string xml = std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\"") +
                          " byte_order=\"" + (encoding_.big_endian ? "BigEndian" : "LittleEndian") + "\"" +
                          (encoding_.long_header ? " header_type=\"UInt64\"" : "") +
                          (encoding_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
                          ">\n<!-- made > by <a> solver -->\n<UnstructuredGrid>\n"
                          "<Piece NumberOfPoints=\"4\" NumberOfCells=\"4\">\n<PointData Scalars=\"size\">\n";
        xml += array<float>("Float32", "size", {0.1f, 0.2f, 0.3f, 0.4f});
        xml +=
            array<float>("Float32", "velocity", {1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3}, 3) + "</PointData>\n<CellData>\n";
        xml += array<double>("Float64", "region", {0.5, -1, 7, 3});
        xml += array<std::int32_t>("Int32", "group", {1, 1, 2, 3}) + "</CellData>\n<Points>\n";
        xml += array<double>("Float64", "Points", {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3) + "</Points>\n<Cells>\n";
        xml += array<std::int32_t>("Int32", "connectivity", {0, 1, 2, 0, 0, 2, 3, 1, 2, 3});
        xml += array<std::int32_t>("Int32", "offsets", {3, 4, 7, 10});
        xml += array<std::uint8_t>("UInt8", "types", {5, 1, 5, 4}) + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
        if (appended)
            xml += "<AppendedData encoding=\"" + encoding_.format + "\">\n_" + appended_ + "\n</AppendedData>\n";
        return xml + "</VTKFile>\n";
    }

private:
    template <class T>
    std::string bytes_of(T value) const {
        std::string bytes(sizeof value, '\0');
        std::memcpy(bytes.data(), &value, sizeof value);
        if (encoding_.big_endian) std::reverse(bytes.begin(), bytes.end());
        return bytes;
    }
    std::string header(std::size_t value) const {
        return encoding_.long_header ? bytes_of(std::uint64_t{value}) : bytes_of(static_cast<std::uint32_t>(value));
    }
    std::string stored(const std::string& plain) const {
        const bool in_base64 = encoding_.format != "raw";
        if (!encoding_.compressed) {
            const std::string all = header(plain.size()) + plain;
            return in_base64 ? base64(all) : all;
        }
        // Blocks of 13 bytes, so that the last one is shorter in some arrays.
        constexpr std::size_t block = 13;
        const std::size_t blocks = (plain.size() + block - 1) / block;
        std::string sizes = header(blocks) + header(block) + header(plain.size() % block), packed;
        for (std::size_t i = 0; i < blocks; ++i) {
            const std::string part = plain.substr(i * block, block);
            uLongf length = compressBound(part.size());
            std::string deflated(length, '\0');
            compress(reinterpret_cast<Bytef*>(deflated.data()), &length, reinterpret_cast<const Bytef*>(part.data()),
                     part.size());
            packed += deflated.substr(0, length);
            sizes += header(length);
        }
        return in_base64 ? base64(sizes) + base64(packed) : sizes + packed;
    }
    template <class T>
    std::string array(const std::string& type, const std::string& name, const std::vector<T>& values,
                      int components = 1) {
        std::string xml = "<DataArray type=\"" + type + "\" Name=\"" + name + "\"";
        if (components > 1) xml += " NumberOfComponents=\"" + std::to_string(components) + "\"";
        if (encoding_.format == "ascii") {
            xml += " format=\"ascii\">\n";
            for (const T& value : values) xml += "  " + std::to_string(value) + "\n";
            return xml + "</DataArray>\n";
        }
        std::string plain;
        for (const T& value : values) plain += bytes_of(value);
        if (encoding_.format == "binary") return xml + " format=\"binary\">\n   " + stored(plain) + "\n</DataArray>\n";
        xml += " format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
        appended_ += stored(plain);
        return xml;
    }

    VtuEncoding encoding_;
    std::string appended_;
};

std::vector<VtuEncoding> vtu_encodings() {
    std::vector<VtuEncoding> all{{.format = "ascii"}};
    for (const char* format : {"binary", "raw", "base64"})
        for (const bool compressed : {false, true})
            for (const bool long_header : {false, true})
                for (const bool big_endian : {false, true})
                    all.push_back({format, compressed, long_header, big_endian});
    return all;
}

TEST(Sizes, AreReadFromVtuInEveryEncoding) {
    const TemporaryFolder folder;
    for (const VtuEncoding& encoding : vtu_encodings()) {
        SCOPED_TRACE(encoding.format + (encoding.compressed ? " compressed" : "") +
                     (encoding.long_header ? " long" : "") + (encoding.big_endian ? " big" : ""));
        const SizedMesh read = read_sizes(folder.write("a.vtu", EncodedVtu(encoding).file()));
        EXPECT_EQ(read.points, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
        EXPECT_EQ(read.triangles.size(), 2u);
        ASSERT_EQ(read.sizes.size(), 4u);
        for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(read.sizes[i], 0.1 * double(i + 1), 1e-7);
    }
}

// Files that are cut short, or have bytes changed or removed, are read or refused in one line, and never crash.
TEST(Sizes, OfDamagedVtuInEveryEncodingAreReadOrRefused) {
    const TemporaryFolder folder;
    test::Random random(5);
    std::size_t read = 0, refused = 0;
    for (const VtuEncoding& encoding : vtu_encodings()) {
        const std::string whole = EncodedVtu(encoding).file();
        for (int i = 0; i < 60; ++i) {
            std::string damaged = whole;
            if (i % 3 == 0) {
                damaged.resize(random.below(whole.size()));
            } else if (i % 3 == 1) {
                for (int k = 0; k < 3; ++k) damaged[random.below(whole.size())] = static_cast<char>(random.bits());
            } else {
                damaged.erase(random.below(whole.size()), 1 + random.below(9));
            }
            try {
                read_sizes(folder.write("a.vtu", damaged));
                ++read;
            } catch (const InputError& error) {
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
                ++refused;
            }
        }
    }
    EXPECT_GT(read, 20u);
    EXPECT_GT(refused, 200u);
}

// No number in a file makes lamina ask for more memory than the bytes of the file could hold.
TEST(Sizes, OfVtuWithAbsurdHeadersAreRefused) {
    const TemporaryFolder folder;
    const std::string whole = EncodedVtu({.format = "raw", .compressed = true}).file();
    // The header of the array `size` holds the blocks, the bytes of a block and the bytes of the last one.
    const std::size_t header = whole.find('_', whole.find("<AppendedData")) + 1;
    for (const auto& [blocks, block, last] : std::vector<std::array<std::uint32_t, 3>>{
             {1, 5'000'000, 0}, {1, 0xffffffff, 0xffffffff}, {0xffffffff, 13, 3}, {2, 13, 14}}) {
        std::string damaged = whole;
        for (std::size_t k = 0; const std::uint32_t number : {blocks, block, last})
            std::memcpy(damaged.data() + header + 4 * k++, &number, 4);
        expect_bad(folder.write("a.vtu", damaged), "broken header");
    }
}

TEST(Sizes, OfVtuThatAreWrongAreRefused) {
    const TemporaryFolder folder;
    const Mesh mesh = test::annulus();
    const std::size_t n = mesh.points.size();
    const auto refuse = [&](const std::vector<PointArray>& arrays, const std::string& said) {
        expect_bad(folder.write("a.vtu", vtu_with(mesh, arrays, folder)), said);
    };
    refuse({}, "no sizes");
    refuse({{"velocity", std::vector<double>(3 * n, 1), 3}}, "no sizes");
    refuse({{"mach", some_sizes(n)}, {"p", some_sizes(n)}}, "mach, p");
    refuse({{"size", some_sizes(n - 1)}}, "announced");
    for (const double wrong : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
        std::vector<double> sizes = some_sizes(n);
        sizes[3] = wrong;
        refuse({{"size", sizes}}, "vertex 3");
    }
    Mesh empty;
    empty.points = {{0, 0}, {1, 0}};
    expect_bad(folder.write("a.vtu", vtu_with(empty, {{"size", {1, 1}}}, folder)), "no triangles");
    EXPECT_THROW(read_sizes(folder / "missing.vtu"), IoError);
    EXPECT_THROW(read_sizes(folder / "a.su2"), UsageError);
}

constexpr const char* square =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$Nodes\n5\n7 0 0 0\n8 1 0 0\n9 1 1 0\n4 0 1 0\n5 9 9 0\n$EndNodes\n"
    "$Elements\n2\n1 2 2 0 1 7 8 9\n2 2 2 0 1 7 9 4\n$EndElements\n";

std::string node_data(const std::string& name, const std::string& values, int count, int components = 1) {
    return "$NodeData\n1\n\"" + name + "\"\n1\n0.0\n3\n0\n" + std::to_string(components) + "\n" +
           std::to_string(count) + "\n" + values + "$EndNodeData\n";
}

TEST(Sizes, AreReadFromNodeDataOfMsh) {
    const TemporaryFolder folder;
    const std::string velocity = node_data("velocity", "7 1 2 3\n", 1, 3);
    const std::string size = node_data("size", "9 0.3\n7 0.1\n8 0.2\n4 0.4\n", 4);
    const std::string other = node_data("mach", "7 -1\n", 1);
    for (const std::string& data : {velocity + size, other + size}) {
        const SizedMesh read = read_sizes(folder.write("a.msh", square + data));
        // The node that belongs to no triangle is left out.
        EXPECT_EQ(read.points, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
        EXPECT_EQ(read.sizes, (std::vector<double>{0.1, 0.2, 0.3, 0.4}));
        EXPECT_EQ(read.triangles.size(), 2u);
    }
    expect_bad(folder.write("a.msh", square), "no sizes");
    expect_bad(folder.write("a.msh", square + node_data("size", "7 1\n8 1\n9 1\n", 3)), "vertex 3 has no size");
    expect_bad(folder.write("a.msh", square + node_data("size", "7 1\n8 1\n9 0\n4 1\n", 4)), "must be positive");
    expect_bad(folder.write("a.msh", square + node_data("size", "7 1\n3 1\n", 2)), "a.msh:27: node 3");
    expect_bad(folder.write("a.msh", square + node_data("size", "7 1\n", 2)), "a.msh:27");
}

TEST(Sizes, AreReadFromBinaryMsh) {
    const TemporaryFolder folder;
    const Mesh mesh = test::annulus();
    const std::vector<double> sizes = some_sizes(mesh.points.size());
    for (const char* format : {"msh41-binary", "msh22-binary"}) {
        write_mesh(mesh, folder / "a.msh", {.format = format});
        std::string data = node_data("size", "", static_cast<int>(sizes.size()));
        std::string values;
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const auto node = static_cast<std::int32_t>(i + 1);
            values.append(reinterpret_cast<const char*>(&node), sizeof node);
            values.append(reinterpret_cast<const char*>(&sizes[i]), sizeof(double));
        }
        data.insert(data.find("$EndNodeData"), values + "\n");
        const SizedMesh read = read_sizes(folder.write("a.msh", folder.read("a.msh") + data));
        EXPECT_EQ(read.points, mesh.points) << format;
        EXPECT_EQ(read.sizes, sizes) << format;
    }
}

}  // namespace
}  // namespace lamina
