// The contents of CGNS files, as the CGNS library reads them.
#include <cgns_io.h>
#include <cgnslib.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/io.hpp>
#include <lamina/solution.hpp>

#include "support/curved_cell.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::one_cell;
using test::TemporaryFolder;
using test::tiny;

/// The name of a section, its kind of elements, and the first and the last of them.
using CgnsSection = std::tuple<std::string, ElementType_t, cgsize_t, cgsize_t>;

std::vector<CgnsSection> sections_of(int file) {
    int count = 0;
    EXPECT_EQ(cg_nsections(file, 1, 1, &count), CG_OK);
    std::vector<CgnsSection> sections;
    for (int s = 1; s <= count; ++s) {
        char name[33];
        ElementType_t elements;
        cgsize_t first = 0, last = 0;
        int boundary_elements = 0, parents = 0;
        EXPECT_EQ(cg_section_read(file, 1, 1, s, name, &elements, &first, &last, &boundary_elements, &parents), CG_OK);
        sections.emplace_back(name, elements, first, last);
    }
    return sections;
}

TEST(Cgns, SolutionsAtVertices) {
    const TemporaryFolder folder;
    const Mesh mesh = tiny();
    write_mesh(mesh, folder / "s.cgns");
    int file = 0, solution = 0, field = 0;
    ASSERT_EQ(cg_open((folder / "s.cgns").c_str(), CG_MODE_MODIFY, &file), CG_OK);
    ASSERT_EQ(cg_sol_write(file, 1, 1, "FlowSolution", Vertex, &solution), CG_OK);
    const std::vector<double> x{3, 0, 1, 2, 5}, y{4, 1, 0, 0, 12};
    const std::vector<float> pressure{1, 2, 3, 4, 5};
    EXPECT_EQ(cg_field_write(file, 1, 1, solution, RealDouble, "VelocityX", x.data(), &field), CG_OK);
    EXPECT_EQ(cg_field_write(file, 1, 1, solution, RealDouble, "VelocityY", y.data(), &field), CG_OK);
    EXPECT_EQ(cg_field_write(file, 1, 1, solution, RealSingle, "Pressure", pressure.data(), &field), CG_OK);
    cg_close(file);
    EXPECT_EQ(solution_fields(folder / "s.cgns"), (std::vector<std::string>{"VelocityX", "VelocityY", "Pressure"}));
    const Solution read = read_solution(folder / "s.cgns", {"Pressure", "Velocity:y", "mag(Velocity)"});
    EXPECT_EQ(read.mesh.points, mesh.points);
    EXPECT_EQ(read.fields[0].values, (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(read.fields[1].values, y);
    EXPECT_EQ(read.fields[2].values, (std::vector<double>{5, 1, 1, 2, 13}));
    EXPECT_THROW(read_solution(folder / "s.cgns", {"Mach"}), UsageError);
}

TEST(Cgns, HoldsEverythingThatSolversLookFor) {
    const TemporaryFolder folder;
    Mesh mesh = tiny();
    mesh.region = {Region::isotropic, Region::layer};
    for (const std::string format : {"cgns", "cgns-3d", "cgns-adf"}) {
        write_mesh(mesh, folder / "m.cgns", {.format = format});
        int file = 0, type = 0, count = 0, cell_dimension = 0, dimension = 0;
        ASSERT_EQ(cg_open((folder / "m.cgns").c_str(), CG_MODE_READ, &file), CG_OK) << cg_get_error();
        EXPECT_EQ(cg_get_file_type(file, &type), CG_OK);
        EXPECT_EQ(type, format == "cgns-adf" ? CG_FILE_ADF : CG_FILE_HDF5);
        char name[33];
        ASSERT_EQ(cg_base_read(file, 1, name, &cell_dimension, &dimension), CG_OK);
        EXPECT_EQ(cell_dimension, 2);
        EXPECT_EQ(dimension, format == "cgns-3d" ? 3 : 2);
        cgsize_t sizes[9];
        ASSERT_EQ(cg_zone_read(file, 1, 1, name, sizes), CG_OK);
        EXPECT_EQ(sizes[0], 5);
        EXPECT_EQ(sizes[1], 2);

        DataType_t data;
        for (int axis = 1; axis <= dimension; ++axis) {
            ASSERT_EQ(cg_coord_info(file, 1, 1, axis, &data, name), CG_OK);
            EXPECT_EQ(std::string(name), std::string("Coordinate") + "XYZ"[axis - 1]);
            EXPECT_EQ(data, RealDouble);
        }

        const std::vector<CgnsSection> sections{{"isotropic_triangles", TRI_3, 1, 1},
                                                {"layer_quads", QUAD_4, 2, 2},
                                                {"wall", BAR_2, 3, 4},
                                                {"farfield", BAR_2, 5, 7}};
        EXPECT_EQ(sections_of(file), sections);

        ASSERT_EQ(cg_nbocos(file, 1, 1, &count), CG_OK);
        ASSERT_EQ(count, 2);
        for (int c = 1; c <= count; ++c) {
            const std::string marker = c == 1 ? "wall" : "farfield";
            BCType_t condition;
            PointSetType_t set;
            cgsize_t points = 0, normals = 0, range[2];
            int index[3], data_sets = 0, families = 0, geometries = 0;
            ASSERT_EQ(cg_boco_info(file, 1, 1, c, name, &condition, &set, &points, index, &normals, &data, &data_sets),
                      CG_OK);
            EXPECT_EQ(name, marker);
            EXPECT_EQ(condition, FamilySpecified);
            EXPECT_EQ(set, PointRange);
            ASSERT_EQ(cg_boco_read(file, 1, 1, c, range, nullptr), CG_OK);
            EXPECT_EQ(range[0], c == 1 ? 3 : 5);
            EXPECT_EQ(range[1], c == 1 ? 4 : 7);
            GridLocation_t location;
            ASSERT_EQ(cg_boco_gridlocation_read(file, 1, 1, c, &location), CG_OK);
            EXPECT_EQ(location, EdgeCenter);
            ASSERT_EQ(cg_goto(file, 1, "Zone_t", 1, "ZoneBC_t", 1, "BC_t", c, "end"), CG_OK);
            ASSERT_EQ(cg_famname_read(name), CG_OK);
            EXPECT_EQ(name, marker);
            ASSERT_EQ(cg_family_read(file, 1, c, name, &families, &geometries), CG_OK);
            EXPECT_EQ(name, marker);
            ASSERT_EQ(cg_fambc_read(file, 1, c, 1, name, &condition), CG_OK);
            EXPECT_EQ(condition, c == 1 ? BCWallViscous : BCFarfield);
        }
        cg_close(file);

        const Mesh back = read_mesh(folder / "m.cgns");
        EXPECT_EQ(mesh_hash(back), mesh_hash(mesh));
        EXPECT_EQ(back.region, mesh.region);
        EXPECT_EQ(back.markers[0].kind, MarkerKind::wall);
        EXPECT_EQ(back.markers[1].kind, MarkerKind::far_field);
    }
}

TEST(Cgns, HoldsCurvedCells) {
    const TemporaryFolder folder;
    const std::array<std::array<ElementType_t, 3>, 2> types{{{TRI_6, TRI_10, TRI_15}, {QUAD_9, QUAD_16, QUAD_25}}};
    for (const std::string format : {"cgns", "cgns-3d", "cgns-adf"})
        for (const unsigned corners : {3u, 4u})
            for (unsigned order = 2; order <= max_cell_order; ++order) {
                const CurvedMesh cell = one_cell(corners, order);
                write_curved_mesh(cell.mesh, cell.nodes, folder / "m.cgns", {.format = format});
                int file = 0;
                ASSERT_EQ(cg_open((folder / "m.cgns").c_str(), CG_MODE_READ, &file), CG_OK);
                EXPECT_EQ(std::get<1>(sections_of(file)[0]), types[corners - 3][order - 2]);
                cg_close(file);
                const CurvedMesh read = read_curved_mesh(folder / "m.cgns");
                EXPECT_EQ(read.nodes.order, order);
                EXPECT_EQ(read.nodes.points, cell.nodes.points);
                EXPECT_EQ(read.nodes.triangle_nodes, cell.nodes.triangle_nodes);
                EXPECT_EQ(read.nodes.quad_nodes, cell.nodes.quad_nodes);
                EXPECT_EQ(read.nodes.marker_nodes, cell.nodes.marker_nodes);
                EXPECT_THROW(read_mesh(folder / "m.cgns"), InputError);
            }
}

// The inner nodes of quadrilaterals of order 4 run round their border, counter-clockwise, and end in the middle.
TEST(Cgns, CurvedQuadsOfOrderFourHaveTheOrderOfTheStandard) {
    const TemporaryFolder folder;
    const CurvedMesh cell = one_cell(4, 4);
    write_curved_mesh(cell.mesh, cell.nodes, folder / "m.cgns");
    int file = 0;
    ASSERT_EQ(cg_open((folder / "m.cgns").c_str(), CG_MODE_READ, &file), CG_OK);
    std::vector<cgsize_t> nodes(25);
    ASSERT_EQ(cg_elements_read(file, 1, 1, 1, nodes.data(), nullptr), CG_OK);
    cg_close(file);
    const std::vector<Point> inner{{1, 1}, {2, 1}, {3, 1}, {3, 2}, {3, 3}, {2, 3}, {1, 3}, {1, 2}, {2, 2}};
    for (std::size_t k = 0; k < inner.size(); ++k)
        EXPECT_EQ(4 * cell.nodes.points[static_cast<std::size_t>(nodes[16 + k]) - 5], inner[k]) << k;
}

TEST(Cgns, HoldsMeshesInSpace) {
    const TemporaryFolder folder;
    for (const bool periodic : {false, true}) {
        write_mesh(tiny(), folder / "m.cgns", {.span = 0.5, .span_cells = 3, .span_periodic = periodic});
        int file = 0, count = 0, cell_dimension = 0, dimension = 0;
        ASSERT_EQ(cg_open((folder / "m.cgns").c_str(), CG_MODE_READ, &file), CG_OK) << cg_get_error();
        char name[33];
        ASSERT_EQ(cg_base_read(file, 1, name, &cell_dimension, &dimension), CG_OK);
        EXPECT_EQ(cell_dimension, 3);
        cgsize_t sizes[9];
        ASSERT_EQ(cg_zone_read(file, 1, 1, name, sizes), CG_OK);
        EXPECT_EQ(sizes[0], 20);
        EXPECT_EQ(sizes[1], 6);
        const std::vector<CgnsSection> sections{{"fluid_prisms", PENTA_6, 1, 3}, {"fluid_hexahedra", HEXA_8, 4, 6},
                                                {"wall", QUAD_4, 7, 12},         {"farfield", QUAD_4, 13, 21},
                                                {"z0_triangles", TRI_3, 22, 22}, {"z0_quads", QUAD_4, 23, 23},
                                                {"z1_triangles", TRI_3, 24, 24}, {"z1_quads", QUAD_4, 25, 25}};
        EXPECT_EQ(sections_of(file), sections);
        ASSERT_EQ(cg_nbocos(file, 1, 1, &count), CG_OK);
        EXPECT_EQ(count, periodic ? 2 : 4);
        ASSERT_EQ(cg_nconns(file, 1, 1, &count), CG_OK);
        EXPECT_EQ(count, periodic ? 2 : 0);
        if (periodic) {
            float center[3], angle[3], shift[3];
            ASSERT_EQ(cg_conn_periodic_read(file, 1, 1, 1, center, angle, shift), CG_OK);
            EXPECT_EQ(shift[2], 0.5F);
        }
        EXPECT_EQ(cg_close(file), CG_OK);
    }
}

TEST(Cgns, RefusesMarkersItCannotName) {
    const TemporaryFolder folder;
    for (const std::string name :
         {"", "with/slash", "longer_than_the_thirty-two_letters_there_are", "fluid_quads", "Zone", "ZoneBC"}) {
        Mesh mesh = tiny();
        mesh.markers[0].name = name;
        EXPECT_THROW(write_mesh(mesh, folder / "m.cgns"), UsageError) << name;
    }
    Mesh mesh = tiny();
    mesh.markers[0].name = mesh.markers[1].name;
    EXPECT_THROW(write_mesh(mesh, folder / "m.cgns"), UsageError);
    EXPECT_TRUE(folder.names().empty());
}

// The library ends the process by an assertion on some of these, which must not be that of the reader.
TEST(Cgns, SurvivesDamagedAdfFiles) {
    const TemporaryFolder folder;
    write_mesh(tiny(), folder / "m.cgns", {.format = "cgns-adf"});
    const std::string sound = folder.read("m.cgns");
    ASSERT_EQ(read_mesh(folder / "m.cgns").points.size(), tiny().points.size());
    std::size_t refused = 0;
    constexpr std::size_t positions = 150;
    for (std::size_t k = 0; k < positions; ++k) {
        std::string damaged = sound;
        damaged[k * sound.size() / positions] ^= '\x15';
        const auto file = folder.write("damaged.cgns", damaged);
        try {
            EXPECT_LE(read_mesh(file).points.size(), sound.size());
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 0u);
}

/// Gives a node of a CGNS file so many bytes or numbers, which are not written and take no room in it.
void declare_size(const std::filesystem::path& file, const char* node, const char* type, cgsize_t size) {
    int cgio = 0;
    double root = 0, id = 0;
    ASSERT_EQ(cgio_open_file(file.c_str(), CGIO_MODE_MODIFY, CGIO_FILE_HDF5, &cgio), CGIO_ERR_NONE);
    ASSERT_EQ(cgio_get_root_id(cgio, &root), CGIO_ERR_NONE);
    ASSERT_EQ(cgio_get_node_id(cgio, root, node, &id), CGIO_ERR_NONE) << node;
    ASSERT_EQ(cgio_set_dimensions(cgio, id, type, 1, &size), CGIO_ERR_NONE) << node;
    ASSERT_EQ(cgio_close_file(cgio), CGIO_ERR_NONE);
}

/// Returns the most memory in kB that this process, or a child of it, has ever used.
long peak(int whose) {
    rusage usage{};
    getrusage(whose, &usage);
    return usage.ru_maxrss;
}

// The library unpacks texts and lists of any size when it opens a file, and writes some of them into short arrays.
TEST(Cgns, DeclaredSizesAskForNoMemory) {
    const TemporaryFolder folder;
    const long before = std::max(peak(RUSAGE_SELF), peak(RUSAGE_CHILDREN));
    constexpr cgsize_t many = 400'000'000;
    const struct {
        const char *node, *type;
    } nodes[] = {{"/Base", "I4"},
                 {"/Base/Zone", "I4"},
                 {"/Base/Zone/ZoneType", "C1"},
                 {"/Base/Zone/GridCoordinates/CoordinateX", "R8"},
                 {"/Base/Zone/isotropic_triangles", "I4"},
                 {"/Base/Zone/isotropic_triangles/ElementRange", "I4"},
                 {"/Base/Zone/isotropic_triangles/ElementConnectivity", "I4"},
                 {"/Base/Zone/ZoneBC/wall", "C1"},
                 {"/Base/Zone/ZoneBC/wall/PointRange", "I4"},
                 {"/Base/Zone/ZoneBC/wall/FamilyName", "C1"},
                 {"/Base/Zone/ZoneBC/wall/GridLocation", "C1"},
                 {"/Base/wall/FamBC", "C1"}};
    Mesh mesh = tiny();
    mesh.region = {Region::isotropic, Region::layer};
    for (const auto& [node, type] : nodes) {
        SCOPED_TRACE(node);
        write_mesh(mesh, folder / "m.cgns");
        declare_size(folder / "m.cgns", node, type, many);
        EXPECT_THROW(read_mesh(folder / "m.cgns"), InputError);
    }
    constexpr long allowance = 150'000;
    EXPECT_LT(std::max(peak(RUSAGE_SELF), peak(RUSAGE_CHILDREN)), before + allowance);
}

}  // namespace
}  // namespace lamina
