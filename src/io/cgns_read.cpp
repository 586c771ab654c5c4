// Reads CGNS files with one base and one unstructured zone whose sections are of the types TRI_3, QUAD_4 and BAR_2 and
// have any names. An edge belongs to the boundary condition that lists it; an edge in none belongs to a marker that its
// section makes. Where cells are PENTA_6 and HEXA_8, the plane mesh is read whose copies in z they join; its edges are
// those that faces stand on. Source: CGNS Standard Interface Data Structures 3.4; the CGNS mid-level library.
#include <cgnslib.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <exception>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lamina/error.hpp>

#include "core/marker_names.hpp"
#include "io/cgns_elements.hpp"
#include "io/cgns_lock.hpp"
#include "io/curved_lists.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/plane_of_extrusion.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

MarkerKind kind_of(BCType_t condition) {
    switch (condition) {
        case BCWall:
        case BCWallInviscid:
        case BCWallViscous:
        case BCWallViscousHeatFlux:
        case BCWallViscousIsothermal:
            return MarkerKind::wall;
        case BCFarfield:
            return MarkerKind::far_field;
        case BCSymmetryPlane:
            return MarkerKind::symmetry;
        default:
            return MarkerKind::other;
    }
}

class CgnsReader {
public:
    explicit CgnsReader(const fs::path& file) : name_(file.string()) {
        // Where this fails within a damaged file, the library keeps the file open, since it cannot close what it has
        // read in part.
        require(cg_open(file.c_str(), CG_MODE_READ, &file_));
    }
    ~CgnsReader() { cg_close(file_); }
    CgnsReader(const CgnsReader&) = delete;
    CgnsReader& operator=(const CgnsReader&) = delete;

    CurvedMesh read() {
        read_zone();
        read_coordinates();
        read_sections();
        read_boundary_conditions();
        make_markers();
        if (is_in_space()) gather_extrusion();
        make_regions();
        CurvedMesh curved{std::move(mesh_), std::move(curved_)};
        if (order_ > 1) curved.nodes.order = order_;
        if (!orient_and_separate(curved)) fail("a node is the corner of one element and no corner of another one");
        return curved;
    }
    /// Returns the names of all arrays at the vertices. Precondition: read()
    std::vector<std::string> fields() const {
        std::vector<std::string> names;
        for_each_field([&](int, const char* name) { names.emplace_back(name); });
        return names;
    }
    /// Returns a field at the vertices. Vectors are those whose components end with X, Y and Z. Precondition: read()
    SolutionField field(const FieldRequest& request) const {
        constexpr std::string_view axes = "XYZ";
        if (request.part == FieldPart::scalar) return {request.name, false, part_of(request, values(request.array), 1)};
        if (request.part == FieldPart::component) {
            FieldRequest scalar = request;
            scalar.part = FieldPart::scalar;
            scalar.component = 0;
            return {request.name, false, part_of(scalar, values(request.array + axes[request.component]), 1)};
        }
        const std::vector<double> x = values(request.array + "X"), y = values(request.array + "Y");
        std::vector<double> vectors;
        for (std::size_t i = 0; i < x.size(); ++i) vectors.insert(vectors.end(), {x[i], y[i]});
        return {request.name, false, part_of(request, vectors, 2)};
    }

private:
    using Name = char[33];

    /// A section of edges or, in space, of faces.
    struct BoundarySection {
        std::string name;
        cgsize_t first;  ///< number of its first element
        std::vector<Segment> bars;
        std::vector<VertexId> nodes;  ///< per bar those between its ends
        std::vector<int> condition;   ///< per edge: the number of its boundary condition, from 1; 0 where it is in none
        std::vector<SpaceMesh::Face> faces;
    };

    [[noreturn]] void fail(const std::string& reason) const { throw InputError({name_, 0, {}}, reason); }
    void require(int status) const {
        if (status != CG_OK) fail(cg_get_error());
    }

    /// Calls act(solution, name) for each array at the vertices.
    template <class Act>
    void for_each_field(Act&& act) const {
        int solutions = 0;
        require(cg_nsols(file_, 1, 1, &solutions));
        for (int s = 1; s <= solutions; ++s) {
            Name name;
            GridLocation_t location;
            require(cg_sol_info(file_, 1, 1, s, name, &location));
            int arrays = 0;
            require(cg_nfields(file_, 1, 1, s, &arrays));
            for (int f = 1; location == Vertex && f <= arrays; ++f) {
                DataType_t type;
                require(cg_field_info(file_, 1, 1, s, f, &type, name));
                act(s, name);
            }
        }
    }
    std::vector<double> values(const std::string& array) const {
        int solution = 0;
        for_each_field([&](int s, const char* name) {
            if (array == name) solution = s;
        });
        if (solution == 0) throw UsageError(fmt::format("{}: no array '{}' at the vertices", name_, array));
        std::vector<double> read(points_);
        const cgsize_t first = 1, last = static_cast<cgsize_t>(points_);
        require(cg_field_read(file_, 1, 1, solution, array.c_str(), RealDouble, &first, &last, read.data()));
        if (is_in_space()) return values_at(read, plane_.nodes);
        return read;
    }

    void read_zone() {
        int bases = 0, zones = 0, cell_dimension = 0;
        Name name;
        ZoneType_t type;
        require(cg_nbases(file_, &bases));
        if (bases != 1) fail(fmt::format("{} bases: only files with one can be read", bases));
        require(cg_base_read(file_, 1, name, &cell_dimension, &dimension_));
        if (cell_dimension < 2 || dimension_ < cell_dimension || dimension_ > 3)
            fail(fmt::format("cells of dimension {} in {} dimensions", cell_dimension, dimension_));
        cell_dimension_ = cell_dimension;
        require(cg_nzones(file_, 1, &zones));
        if (zones != 1) fail(fmt::format("{} zones: only files with one can be read", zones));
        require(cg_zone_type(file_, 1, 1, &type));
        if (type != Unstructured) fail("the zone is structured: only unstructured ones can be read");
        cgsize_t sizes[9] = {};
        require(cg_zone_read(file_, 1, 1, name, sizes));
        // A point takes more than one byte, so a damaged number of points is refused before memory is asked for.
        std::error_code ignored;
        const auto bytes = fs::file_size(name_, ignored);
        if (sizes[0] < 0 || sizes[1] < 0 || static_cast<std::uintmax_t>(sizes[0]) > bytes)
            fail("absurd size of the zone");
        points_ = static_cast<std::size_t>(sizes[0]);
        bytes_ = bytes;
    }

    std::vector<double> read_axis(const char* name) {
        std::vector<double> values(points_);
        const cgsize_t first = 1, last = static_cast<cgsize_t>(points_);
        if (points_ > 0) require(cg_coord_read(file_, 1, 1, name, RealDouble, &first, &last, values.data()));
        return values;
    }
    void read_coordinates() {
        const std::vector<double> x = read_axis("CoordinateX"), y = read_axis("CoordinateY");
        mesh_.points.resize(points_);
        for (std::size_t i = 0; i < points_; ++i) {
            if (!std::isfinite(x[i]) || !std::isfinite(y[i])) fail(fmt::format("point {} is not finite", i + 1));
            mesh_.points[i] = {x[i], y[i]};
        }
        if (dimension_ == 2) return;
        std::vector<double> heights = read_axis("CoordinateZ");
        if (is_in_space()) {
            space_.heights = std::move(heights);
            for (const double z : space_.heights)
                if (!std::isfinite(z)) fail("a coordinate z is not finite");
            return;
        }
        std::optional<double> plane;
        for (const double z : heights) {
            if (z != plane.value_or(z))
                fail(fmt::format("points in the planes z = {} and z = {}: the mesh is not plane", *plane, z));
            plane = z;
        }
    }

    void read_sections() {
        int sections = 0;
        require(cg_nsections(file_, 1, 1, &sections));
        for (int s = 1; s <= sections; ++s) {
            Name name;
            ElementType_t type;
            cgsize_t first = 0, last = 0, size = 0;
            int boundary_elements = 0, has_parents = 0;
            require(cg_section_read(file_, 1, 1, s, name, &type, &first, &last, &boundary_elements, &has_parents));
            if (type == NODE) continue;
            const CgnsElement& element = element_of_section(type, name);
            if (order_ != 0 && element.order != order_) fail("elements of several orders");
            order_ = element.order;
            require(cg_ElementDataSize(file_, 1, 1, s, &size));
            const bool is_volume = type == PENTA_6 || type == HEXA_8;
            const auto of_element =
                static_cast<cgsize_t>(is_volume ? std::size_t{2} * element.corners : element.nodes());
            if (first < 1 || last < first || size < 0 || static_cast<std::uintmax_t>(size) > bytes_ ||
                size / of_element != last - first + 1 || size % of_element != 0)
                fail(fmt::format("section '{}' has not the elements {} to {}", name, first, last));
            const std::vector<cgsize_t> nodes = nodes_of_section(s, name, static_cast<std::size_t>(size));
            if (is_volume)
                add_volumes(name, element.corners, nodes);
            else if (is_in_space())
                add_faces(name, element.corners, first, nodes);
            else
                add_section(name, element, first, nodes);
        }
    }
    bool is_in_space() const { return cell_dimension_ == 3; }
    const CgnsElement& element_of_section(ElementType_t type, const std::string& name) const {
        const CgnsElement* const element = is_in_space() ? find_element_in_space(type) : find_cgns_element(type);
        if (element == nullptr)
            fail(fmt::format("section '{}' has elements {}: only {} can be read", name, cg_ElementTypeName(type),
                             is_in_space() ? "prisms, hexahedra and their faces"
                                           : "bars, triangles and quadrilaterals with all nodes of orders 1 to 4"));
        return *element;
    }
    /// Returns the numbers of a section's nodes, so many, from 1 on.
    std::vector<cgsize_t> nodes_of_section(int section, const std::string& name, std::size_t count) const {
        std::vector<cgsize_t> nodes(count);
        require(cg_elements_read(file_, 1, 1, section, nodes.data(), nullptr));
        for (const cgsize_t node : nodes)
            if (node < 1 || static_cast<std::size_t>(node) > points_)
                fail(fmt::format("section '{}': vertex {} where there are {}", name, node, points_));
        return nodes;
    }
    /// Returns the element that is one face of this one, or the face itself; null where there is none.
    static const CgnsElement* find_element_in_space(ElementType_t type) {
        if (type == TRI_3 || type == PENTA_6) return &cgns_element(3, 1);
        return type == QUAD_4 || type == HEXA_8 ? &cgns_element(4, 1) : nullptr;
    }
    void add_volumes(const std::string& name, std::size_t corners, const std::vector<cgsize_t>& nodes) {
        for (std::size_t first = 0; first < nodes.size(); first += 2 * corners) {
            SpaceMesh::Volume& volume = space_.volumes.emplace_back(SpaceMesh::Volume{corners, {}});
            for (std::size_t k = 0; k < 2 * corners; ++k)
                volume.nodes[k] = static_cast<std::uint32_t>(nodes[first + k] - 1);
        }
        section_of_volume_.resize(space_.volumes.size(), static_cast<std::uint32_t>(volume_sections_.size()));
        volume_sections_.push_back(name);
    }
    void add_faces(const std::string& name, std::size_t corners, cgsize_t first, const std::vector<cgsize_t>& nodes) {
        BoundarySection section{name, first, {}, {}, {}, {}};
        section.condition.resize(nodes.size() / corners, 0);
        for (std::size_t i = 0; i < nodes.size(); i += corners) {
            SpaceMesh::Face& face = section.faces.emplace_back(SpaceMesh::Face{corners, {}, 0});
            for (std::size_t k = 0; k < corners; ++k) face.nodes[k] = static_cast<std::uint32_t>(nodes[i + k] - 1);
        }
        boundary_sections_.push_back(std::move(section));
    }
    void add_section(const std::string& name, const CgnsElement& element, cgsize_t first,
                     const std::vector<cgsize_t>& nodes) {
        const auto vertex = [&](std::size_t i) { return VertexId(static_cast<std::size_t>(nodes[i] - 1)); };
        const std::size_t size = element.nodes(), count = nodes.size() / size;
        BoundarySection bars{name, first, {}, {}, {}, {}};
        std::vector<VertexId>& beside = element.corners == 3   ? curved_.triangle_nodes
                                        : element.corners == 4 ? curved_.quad_nodes
                                                               : bars.nodes;
        std::array<VertexId, mesh::nodes_of_cell(4, max_cell_order)> v;
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < size; ++k) v[place_of_cgns_node(element, k)] = vertex(i * size + k);
            if (element.corners == 3)
                mesh_.triangles.push_back({{v[0], v[1], v[2]}});
            else if (element.corners == 4)
                mesh_.quads.push_back({{v[0], v[1], v[2], v[3]}});
            else
                bars.bars.push_back({v[0], v[1]});
            beside.insert(beside.end(), v.begin() + element.corners, v.begin() + static_cast<std::ptrdiff_t>(size));
        }
        if (element.corners == 2) {
            bars.condition.resize(count, 0);
            boundary_sections_.push_back(std::move(bars));
        } else {
            (element.corners == 3 ? triangle_sections_ : quad_sections_).emplace_back(name, count);
        }
    }

    /// Makes a marker without edges of each boundary condition, and notes for each bar the condition that lists it.
    void read_boundary_conditions() {
        int count = 0;
        require(cg_nbocos(file_, 1, 1, &count));
        for (int c = 1; c <= count; ++c) {
            Name name;
            BCType_t type;
            PointSetType_t set;
            cgsize_t points = 0, normals = 0;
            int normal_index[3] = {}, data_sets = 0;
            DataType_t normal_type;
            require(cg_boco_info(file_, 1, 1, c, name, &type, &set, &points, normal_index, &normals, &normal_type,
                                 &data_sets));
            const MarkerKind kind = kind_of(type == FamilySpecified ? condition_of_family(c) : type);
            conditions_.push_back({name, core::kind_or_periodic(kind, name), {}});
            GridLocation_t location;
            require(cg_boco_gridlocation_read(file_, 1, 1, c, &location));
            const bool lists_elements =
                set == ElementRange || set == ElementList || location == EdgeCenter || location == FaceCenter;
            if (!lists_elements) continue;
            if (points < 0 || static_cast<std::uintmax_t>(points) > bytes_) fail("absurd size of a boundary condition");
            std::vector<cgsize_t> elements(static_cast<std::size_t>(points));
            require(cg_boco_read(file_, 1, 1, c, elements.data(), nullptr));
            if (set == PointRange || set == ElementRange) {
                if (elements.size() == 2) mark_elements(elements[0], elements[1], c);
            } else {
                for (const cgsize_t element : elements) mark_elements(element, element, c);
            }
        }
    }
    BCType_t condition_of_family(int boundary_condition) {
        Name family, name;
        require(cg_goto(file_, 1, "Zone_t", 1, "ZoneBC_t", 1, "BC_t", boundary_condition, "end"));
        int families = 0;
        if (cg_famname_read(family) != CG_OK || cg_nfamilies(file_, 1, &families) != CG_OK) return BCGeneral;
        for (int f = 1; f <= families; ++f) {
            int conditions = 0, geometries = 0;
            BCType_t type;
            require(cg_family_read(file_, 1, f, name, &conditions, &geometries));
            if (std::string(name) != family || conditions == 0) continue;
            require(cg_fambc_read(file_, 1, f, 1, name, &type));
            return type;
        }
        return BCGeneral;
    }
    /// Notes the boundary condition of the elements first to last, as far as they are of the boundary.
    void mark_elements(cgsize_t first, cgsize_t last, int condition) {
        for (BoundarySection& section : boundary_sections_) {
            const auto size = static_cast<cgsize_t>(section.condition.size());
            const cgsize_t begin = std::max<cgsize_t>(first - section.first, 0);
            const cgsize_t end = std::min<cgsize_t>(last - section.first + 1, size);
            for (cgsize_t i = begin; i < end; ++i) section.condition[static_cast<std::size_t>(i)] = condition;
        }
    }

    void make_markers() {
        const std::size_t of_conditions = conditions_.size();
        for (const BoundarySection& section : boundary_sections_)
            conditions_.push_back({section.name, core::kind_of_name(section.name), {}});
        std::vector<std::vector<VertexId>> nodes(conditions_.size());
        for (std::size_t s = 0; s < boundary_sections_.size(); ++s) {
            BoundarySection& section = boundary_sections_[s];
            const auto marker_of = [&](std::size_t i) {
                const int c = section.condition[i];
                return c == 0 ? of_conditions + s : static_cast<std::size_t>(c - 1);
            };
            for (std::size_t i = 0; i < section.faces.size(); ++i) {
                section.faces[i].marker = marker_of(i);
                space_.faces.push_back(section.faces[i]);
            }
            const std::ptrdiff_t between =
                section.bars.empty() ? 0 : std::ssize(section.nodes) / std::ssize(section.bars);
            for (std::size_t i = 0; i < section.bars.size(); ++i) {
                const std::size_t marker = marker_of(i);
                conditions_[marker].edges.push_back(section.bars[i]);
                const auto begin = section.nodes.begin() + static_cast<std::ptrdiff_t>(i) * between;
                nodes[marker].insert(nodes[marker].end(), begin, begin + between);
            }
        }
        if (is_in_space()) return;
        for (std::size_t m = 0; m < conditions_.size(); ++m) {
            if (conditions_[m].edges.empty()) continue;
            mesh_.markers.push_back(std::move(conditions_[m]));
            curved_.marker_nodes.insert(curved_.marker_nodes.end(), nodes[m].begin(), nodes[m].end());
        }
    }
    /// Reads the plane mesh whose copies in z the file holds.
    void gather_extrusion() {
        space_.points = std::exchange(mesh_.points, {});
        plane_ = plane_of_extrusion(space_, conditions_.size(), name_);
        mesh_.points = std::move(plane_.points);
        mesh_.triangles = std::move(plane_.triangles);
        mesh_.quads = std::move(plane_.quads);
        for (std::size_t m = 0; m < conditions_.size(); ++m) {
            conditions_[m].edges = std::move(plane_.edges[m]);
            if (!conditions_[m].edges.empty()) mesh_.markers.push_back(std::move(conditions_[m]));
        }
        for (const std::uint32_t volume : plane_.volumes)
            triangle_sections_.emplace_back(volume_sections_[section_of_volume_[volume]], 1);
    }
    void make_regions() {
        triangle_sections_.insert(triangle_sections_.end(), quad_sections_.begin(), quad_sections_.end());
        for (const auto& [name, count] : triangle_sections_) {
            Region region;
            if (!region_of_name(name.substr(0, name.rfind('_')), region)) {
                mesh_.region.clear();
                return;
            }
            mesh_.region.insert(mesh_.region.end(), count, region);
        }
    }

    std::string name_;
    int file_ = 0, dimension_ = 2, cell_dimension_ = 2;
    std::size_t points_ = 0;
    std::uintmax_t bytes_ = 0;                                                            ///< size of the file
    std::vector<std::pair<std::string, std::size_t>> triangle_sections_, quad_sections_;  ///< names, numbers of cells
    std::vector<BoundarySection> boundary_sections_;
    std::vector<Marker> conditions_;  ///< one marker per boundary condition, then the markers of sections
    unsigned order_ = 0;              ///< of all elements; 0 before the first one
    Mesh mesh_;
    CurvedNodes curved_;                        ///< the nodes of elements beside their corners, as points of the mesh
    SpaceMesh space_;                           ///< where cells are volumes
    std::vector<std::string> volume_sections_;  ///< names
    std::vector<std::uint32_t> section_of_volume_;
    PlaneOfExtrusion plane_;  ///< where cells are volumes
};

/// Returns whether a file is one of ADF, the older kind of CGNS files.
bool is_adf(const fs::path& file) {
    constexpr std::string_view name = "ADF Database";
    constexpr std::streamoff name_at = 4;
    std::string found(name.size(), '\0');
    std::ifstream in(file, std::ios::binary);
    in.seekg(name_at);
    in.read(found.data(), static_cast<std::streamsize>(found.size()));
    return in.good() && found == name;
}

/// Limits the memory of this process to what it has and what a file of this size may need in proportion.
void limit_memory(const fs::path& file) {
    constexpr rlim_t bytes_per_byte = 20, allowance = 100'000'000;
    rlim_t pages = 0;
    std::error_code unknown;
    const auto bytes = fs::file_size(file, unknown);
    if (unknown || !(std::ifstream("/proc/self/statm") >> pages)) return;  // a system without it
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0) return;
    const auto page = static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
    limit.rlim_cur = std::min(limit.rlim_cur, pages * page + allowance + bytes_per_byte * bytes);
    ::setrlimit(RLIMIT_AS, &limit);
}

/// Returns "+" for a file that can be opened, and read if `whole`, else "-" and the reason why not.
std::string answer_for(const fs::path& file, bool whole) {
    try {
        CgnsReader reader(file);
        if (whole) reader.read();
    } catch (const InputError& error) {
        return "-" + error.reason();
    } catch (const std::exception& error) {
        return std::string("-") + error.what();
    }
    return "+";
}

/// Tries a file, and sends the answer to the parent process. Sends nothing where the library ends the process, or
/// memory is lacking for the answer. No exception leaves the child process, which would go on with the work of its
/// parent.
[[noreturn]] void try_in_child(const fs::path& file, bool whole, int pipe) noexcept {
    const rlimit no_core{};
    ::setrlimit(RLIMIT_CORE, &no_core);
    if (const int null = ::open("/dev/null", O_WRONLY); null >= 0) ::dup2(null, STDERR_FILENO);
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE}) std::signal(signal, SIG_DFL);
    bool told = false;
    try {
        limit_memory(file);
        const std::string answer = answer_for(file, whole);
        told = ::write(pipe, answer.data(), answer.size()) == static_cast<ssize_t>(answer.size());
    } catch (const std::exception&) {
        told = false;
    }
    ::_exit(told ? 0 : 1);
}

/// Returns what a child process sends that tries the file.
std::string answer_of_child(const fs::path& file, bool whole) {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) throw IoError(file.string(), "cannot read: no pipe to a child process");
    const pid_t child = ::fork();
    if (child == 0) try_in_child(file, whole, pipe[1]);
    ::close(pipe[1]);
    std::string answer;
    std::array<char, 512> part{};
    ssize_t bytes = 0;
    while (child > 0 && ((bytes = ::read(pipe[0], part.data(), part.size())) > 0 || (bytes < 0 && errno == EINTR)))
        if (bytes > 0) answer.append(part.data(), static_cast<std::size_t>(bytes));
    ::close(pipe[0]);
    if (child < 0) throw IoError(file.string(), "cannot read: no child process");
    while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) continue;
    return answer;
}

/// Throws InputError for a file that the library cannot open. It ends the process where sizes in a file are damaged,
/// and unpacks texts and lists of any size, so that a child process tries it before. The arrays of HDF5 files are
/// checked by the library, those of ADF files by nobody.
void require_sound(const fs::path& file) {
    const bool adf = is_adf(file);
    const std::string answer = answer_of_child(file, adf);
    if (answer.starts_with('+')) return;
    if (answer.size() > 1) throw InputError({file.string(), 0, {}}, answer.substr(1));
    throw InputError({file.string(), 0, {}}, fmt::format("the file is damaged: the CGNS library breaks off on it{}",
                                                         adf ? " (adf2hdf makes HDF5 of a sound one)" : ""));
}

/// Returns what act(reader, its mesh) makes of a file that the library can open. The library is locked meanwhile.
template <class Act>
auto with_reader(const fs::path& file, Act act) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) throw IoError(file.string(), "cannot read: no such file");
    const std::lock_guard lock(cgns_lock());
    require_sound(file);
    CgnsReader reader(file);
    return act(reader, reader.read());
}

/// Returns the mesh. Throws InputError where its cells are curved.
Mesh straight(CurvedMesh mesh, const fs::path& file) {
    if (mesh.nodes.order > 1) throw InputError({file.string(), 0, {}}, curved_cells_refused(mesh.nodes.order));
    return std::move(mesh.mesh);
}

}  // namespace

Mesh read_cgns(const fs::path& file) { return straight(read_curved_cgns(file), file); }

CurvedMesh read_curved_cgns(const fs::path& file) {
    return with_reader(file, [](const CgnsReader&, CurvedMesh mesh) { return mesh; });
}

Solution read_cgns_solution(const fs::path& file, std::span<const FieldRequest> fields) {
    return with_reader(file, [&](CgnsReader& reader, CurvedMesh mesh) {
        Solution solution{straight(std::move(mesh), file), {}};
        for (const FieldRequest& field : fields) solution.fields.push_back(reader.field(field));
        return solution;
    });
}

std::vector<std::string> cgns_fields(const fs::path& file) {
    return with_reader(file, [](CgnsReader& reader, const CurvedMesh&) { return reader.fields(); });
}

}  // namespace lamina::io
