// Reads and writes metrics. Source of the format of Medit: P. J. Frey, MEDIT, INRIA technical report 253 (2001),
// appendix.
#include <lamina/metric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/atomic_file.hpp"
#include "core/file_name.hpp"
#include "io/byte_reader.hpp"
#include "io/vtk_xml.hpp"

namespace lamina::io {

namespace {

/// Returns the tensor that a size stands for; one that is not positive definite where the size is not positive.
MetricTensor metric_of_size(double size) {
    const double eigenvalue = 1 / (size * std::abs(size));
    return {eigenvalue, 0, eigenvalue};
}

/// Where a tensor with so many components has xx, xy and yy; all in the first place where it is one size.
std::array<std::size_t, 3> places_in_tensor(std::size_t components) {
    switch (components) {
        case 1:
            return {0, 0, 0};
        case 4:
            return {0, 1, 3};
        case 6:
            return {0, 3, 1};
        case 9:
            return {0, 1, 4};
        default:
            return {0, 1, 2};
    }
}

/// Reads the words and numbers of a file of Medit, in which lines do not matter.
class MeditReader {
public:
    MeditReader(const std::string& bytes, const std::string& file) : in_(bytes, file) {}

    std::vector<MetricTensor> read() {
        std::size_t dimension = 2;
        in_.expect("MeshVersionFormatted");
        in_.number<int>("the version");
        for (std::string_view word = in_.word(); word != "SolAtVertices"; word = in_.word()) {
            if (word.empty() || word == "End") in_.fail("no SolAtVertices");
            if (word.front() == '#') in_.rest_of_line();
            if (word != "Dimension") continue;
            dimension = in_.number<std::size_t>("the dimension");
            if (dimension != 2 && dimension != 3) in_.fail(fmt::format("dimension {}: must be 2 or 3", dimension));
        }
        return read_values(dimension);
    }

private:
    std::vector<MetricTensor> read_values(std::size_t dimension) {
        constexpr int scalar = 1, symmetric_tensor = 3;
        const std::size_t count =
            in_.checked_count(in_.number<std::size_t>("the number of vertices"), 1, "number of vertices");
        const auto solutions = in_.number<std::size_t>("the number of solutions");
        const auto type = in_.number<int>("the type of the solution");
        if (solutions != 1 || (type != scalar && type != symmetric_tensor))
            in_.fail("a metric is one solution per vertex, of type 1 (a size) or 3 (a symmetric tensor)");
        std::vector<MetricTensor> metric(count);
        for (MetricTensor& m : metric) {
            const auto first = in_.number<double>("a value");
            m = type == scalar ? metric_of_size(first) : MetricTensor{first, 0, 0};
            if (type == scalar) continue;
            // Rows of the lower triangle: xx, then xy and yy, then those of z.
            m.xy = in_.number<double>("a value");
            m.yy = in_.number<double>("a value");
            for (std::size_t i = 3; i < dimension * (dimension + 1) / 2; ++i) in_.number<double>("a value");
        }
        return metric;
    }

    ByteReader in_;
};

/// Returns the name of the array that holds the tensors, and the number of its components.
std::pair<std::string, std::size_t> metric_array(const VtkXmlFile& xml) {
    const auto components = [&](const std::string& name) { return xml.components("PointData/" + name); };
    std::string found = "metric";
    if (!xml.has("PointData/metric")) {
        // Three components may be those of a vector: they need the name.
        std::vector<std::string> tensors = xml.arrays("PointData");
        tensors.erase(std::remove_if(tensors.begin(), tensors.end(),
                                     [&](const std::string& name) {
                                         const std::size_t count = components(name);
                                         return count != 4 && count != 6 && count != 9;
                                     }),
                      tensors.end());
        if (tensors.size() != 1) xml.fail("no point data named 'metric', and not one array of tensors alone");
        found = tensors.front();
    }
    const std::size_t count = components(found);
    if (count != 1 && count != 3 && count != 4 && count != 6 && count != 9)
        xml.fail(fmt::format("'{}' has {} components: must be 1, 3, 4, 6 or 9", found, count));
    return {"PointData/" + found, count};
}

std::vector<MetricTensor> read_medit_metric(const std::string& bytes, const std::string& file) {
    return MeditReader(bytes, file).read();
}

std::vector<MetricTensor> read_vtu_metric(const std::string& bytes, const std::string& file) {
    const VtkXmlFile xml(bytes, file);
    const auto [name, components] = metric_array(xml);
    const std::vector<double> values = xml.values<double>(name, xml.points() * components);
    const auto [xx, xy, yy] = places_in_tensor(components);
    std::vector<MetricTensor> metric;
    metric.reserve(xml.points());
    for (std::size_t first = 0; first < values.size(); first += components)
        metric.push_back(components == 1 ? metric_of_size(values[first])
                                         : MetricTensor{values[first + xx], values[first + xy], values[first + yy]});
    return metric;
}

}  // namespace

}  // namespace lamina::io

namespace lamina {

using namespace io;

std::vector<MetricTensor> read_metric(const std::filesystem::path& file) {
    const std::string extension = core::extension_of(file), name = input_name(file);
    if (extension == ".sol") return read_medit_metric(read_file(file), name);
    if (extension == ".vtu") return read_vtu_metric(read_file(file), name);
    throw UsageError(fmt::format("{}: metrics are Medit files (.sol) or VTU files (.vtu)", name));
}

void write_metric(std::span<const MetricTensor> metric, const std::filesystem::path& file) {
    if (core::extension_of(file) != ".sol")
        throw UsageError(fmt::format("{}: metrics are written to Medit files (.sol)", file.string()));
    core::write_stream_atomically(file, [&](std::ostream& out) {
        out << "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n" << metric.size() << "\n1 3\n";
        for (const MetricTensor& m : metric) out << fmt::format("{:.17g} {:.17g} {:.17g}\n", m.xx, m.xy, m.yy);
        out << "End\n";
    });
}

}  // namespace lamina
