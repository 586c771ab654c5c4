#include "io/su2_restart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "core/atomic_file.hpp"
#include "core/file_name.hpp"
#include "io/binary_output.hpp"
#include "io/number_text.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

/// The file begins with five integers: this number, the numbers of fields and of vertices, and two zeros. Names follow,
/// then all fields of one vertex after the other.
constexpr std::int32_t magic = 535532;
constexpr std::size_t head_bytes = 20, name_bytes = 33;

[[noreturn]] void fail(const fs::path& file, const std::string& reason) {
    throw InputError({file.string(), 0, {}}, reason);
}

Su2Restart read_binary(const std::string& bytes, const fs::path& file) {
    const auto integer = [&](std::size_t i) { return load<std::int32_t>(bytes.data() + 4 * i, ByteOrder::little); };
    if (bytes.size() < head_bytes || integer(0) != magic) fail(file, "is no restart file of SU2");
    if (integer(1) < 2 || integer(2) < 1) fail(file, "holds no vertices");
    const auto fields = static_cast<std::size_t>(integer(1)), points = static_cast<std::size_t>(integer(2));
    const std::size_t values_at = head_bytes + name_bytes * fields;
    if (values_at > bytes.size() || (bytes.size() - values_at) / (8 * fields) < points)
        fail(file, fmt::format("is shorter than {} fields at {} vertices", fields, points));
    Su2Restart restart;
    for (std::size_t f = 0; f < fields; ++f) {
        const std::string name = bytes.substr(head_bytes + name_bytes * f, name_bytes);
        restart.names.push_back(name.substr(0, name.find('\0')));
        std::vector<double>& values = restart.values.emplace_back(points);
        for (std::size_t i = 0; i < points; ++i)
            values[i] = load<double>(bytes.data() + values_at + 8 * (fields * i + f), ByteOrder::little);
    }
    return restart;
}

/// Returns the fields of a line between commas, without blanks and quotes.
std::vector<std::string_view> split_line(std::string_view line) {
    std::vector<std::string_view> fields;
    for (bool more = true; more;) {
        const std::size_t comma = line.find(',');
        std::string_view field = line.substr(0, comma);
        const std::size_t first = field.find_first_not_of(" \t\r\"");
        field =
            first == std::string_view::npos ? "" : field.substr(first, field.find_last_not_of(" \t\r\"") + 1 - first);
        fields.push_back(field);
        more = comma != std::string_view::npos;
        if (more) line.remove_prefix(comma + 1);
    }
    return fields;
}

Su2Restart read_ascii(const std::string& bytes, const fs::path& file) {
    Su2Restart restart;
    std::size_t number = 0;
    for (std::string_view rest = bytes; !rest.empty();) {
        const std::size_t end = rest.find('\n');
        const std::vector<std::string_view> fields = split_line(rest.substr(0, end));
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
        if (++number == 1) {
            if (fields.size() < 3 || fields[0] != "PointID") fail(file, "is no restart file of SU2");
            restart.names.assign(fields.begin() + 1, fields.end());
            restart.values.resize(restart.names.size());
            continue;
        }
        if (fields.size() != restart.names.size() + 1) break;  // what follows the vertices
        for (std::size_t f = 0; f < restart.names.size(); ++f) {
            const auto value = parse_whole<double>(fields[f + 1]);
            if (!value) throw InputError({file.string(), number, {}}, fmt::format("'{}' is no number", fields[f + 1]));
            restart.values[f].push_back(*value);
        }
    }
    return restart;
}

const std::vector<double>& values_of(const Su2Restart& restart, const std::string& name, const fs::path& file) {
    const auto found = std::find(restart.names.begin(), restart.names.end(), name);
    if (found == restart.names.end()) throw UsageError(fmt::format("{}: no field '{}'", file.string(), name));
    return restart.values[static_cast<std::size_t>(found - restart.names.begin())];
}

}  // namespace

Su2Restart read_su2_restart(const fs::path& file) {
    const std::string bytes = read_file(file);
    Su2Restart restart = core::extension_of(file) == ".csv" ? read_ascii(bytes, file) : read_binary(bytes, file);
    if (restart.names.size() < 2 || restart.names[0] != "x" || restart.names[1] != "y" ||
        std::find(restart.names.begin(), restart.names.end(), "z") != restart.names.end())
        fail(file, "holds no flow in a plane");
    for (std::size_t f = 0; f < restart.names.size(); ++f)
        for (std::size_t i = 0; i < restart.values[f].size(); ++i)
            if (!std::isfinite(restart.values[f][i]))
                fail(file,
                     fmt::format("field '{}': the value at vertex {} is not a finite number", restart.names[f], i));
    return restart;
}

void write_su2_restart(const Su2Restart& restart, const fs::path& file) {
    const std::size_t points = restart.values.front().size();
    core::write_stream_atomically(file, [&](std::ostream& out) {
        const auto count = [](std::size_t n) { return static_cast<std::int32_t>(n); };
        for (const std::int32_t head : {magic, count(restart.names.size()), count(points), 0, 0})
            write_value(out, head);
        for (const std::string& name : restart.names) {
            std::array<char, name_bytes> stored{};
            std::copy_n(name.begin(), std::min(name.size(), name_bytes - 1), stored.begin());
            out.write(stored.data(), name_bytes);
        }
        write_records(out, points, 8 * restart.names.size(), [&](char* p, std::size_t i) {
            for (const std::vector<double>& values : restart.values) p = store(p, values[i]);
        });
    });
}

Solution with_mesh(Su2Restart restart, Mesh mesh, const fs::path& file) {
    if (restart.values[0].size() != mesh.points.size())
        fail(file, fmt::format("is of another mesh: it has {} vertices where the mesh has {}", restart.values[0].size(),
                               mesh.points.size()));
    Box box;
    for (const Point p : mesh.points) box.include(p);
    // SU2 keeps coordinates in double precision, but may read those of the mesh from rounded text.
    const double rounding = 1e-9 * box.width();
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        if (distance(mesh.points[i], {restart.values[0][i], restart.values[1][i]}) > rounding)
            fail(file, fmt::format("is of another mesh: vertex {} lies elsewhere", i));
    Solution solution{std::move(mesh), {}};
    for (std::size_t f = 2; f < restart.names.size(); ++f)
        solution.fields.push_back({std::move(restart.names[f]), false, std::move(restart.values[f])});
    return solution;
}

Solution read_su2_solution(const fs::path& file, std::span<const FieldRequest> fields, const fs::path& mesh) {
    Su2Restart restart = read_su2_restart(file);
    Su2Restart wanted{{"x", "y"}, {restart.values[0], restart.values[1]}};
    for (const FieldRequest& request : fields) {
        constexpr std::array axes{"_x", "_y", "_z"};
        wanted.names.push_back(request.name);
        if (request.part == FieldPart::scalar) {
            wanted.values.push_back(values_of(restart, request.array, file));
        } else if (request.part == FieldPart::component) {
            wanted.values.push_back(values_of(restart, request.array + axes[request.component], file));
        } else {
            const std::vector<double>&x = values_of(restart, request.array + axes[0], file),
                  &y = values_of(restart, request.array + axes[1], file);
            std::vector<double>& lengths = wanted.values.emplace_back();
            for (std::size_t i = 0; i < x.size(); ++i) lengths.push_back(length(Point{x[i], y[i]}));
        }
    }
    return with_mesh(std::move(wanted), read_mesh(mesh.empty() ? file.parent_path() / "mesh.su2" : mesh), file);
}

}  // namespace lamina::io
