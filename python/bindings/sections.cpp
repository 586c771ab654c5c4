#include "sections.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arrays.hpp"
#include "bindings.hpp"

namespace lamina::python {

namespace {

TrailingEdge trailing_edge_of(const std::string& word) {
    if (word == "sharp") return TrailingEdge::sharp;
    if (word == "blunt") return TrailingEdge::blunt;
    if (word == "extended") return TrailingEdge::extended;
    throw OptionError("trailing_edge", "must be 'sharp', 'blunt' or 'extended'");
}

/// Returns the points of a NACA section as an array.
ReadOnlyArray<double> naca(const std::string& digits, std::size_t points, const std::string& trailing_edge) {
    return owning_array<double>(naca_airfoil(digits, points, trailing_edge_of(trailing_edge)).points);
}

/// Returns (name, points, title, format, repairs) for each element.
nb::list outlines(const nb::list& given) {
    nb::list result;
    for (Element& element : geometry_of(sections_of(given), {}).elements)
        result.append(nb::make_tuple(element.name, owning_array<double>(std::move(element.points)), element.title,
                                     element.format, element.repairs));
    return result;
}

}  // namespace

std::vector<Section> sections_of(const nb::list& list) {
    std::vector<Section> sections;
    for (nb::handle item : list) {
        if (nb::isinstance<nb::str>(item)) {
            sections.emplace_back(nb::cast<std::string>(item));
        } else {
            const auto [source, points] = nb::cast<std::pair<std::string, PointsArgument>>(item);
            sections.emplace_back(std::pair(source, points_of(points)));
        }
    }
    return sections;
}

Geometry geometry_of(const std::vector<Section>& sections, const GeometryOptions& options) {
    validate(options);
    std::vector<Element> elements;
    std::vector<std::string> inputs;  // in a row, since two of them may hold the surfaces of one element
    const auto read = [&] {
        for (Element& element : read_inputs(inputs, options)) elements.push_back(std::move(element));
        inputs.clear();
    };
    for (const Section& section : sections) {
        if (const auto* input = std::get_if<std::string>(&section)) {
            inputs.push_back(*input);
        } else {
            read();
            const auto& [source, points] = std::get<1>(section);
            elements.push_back(element_of_points(points, source, options));
        }
    }
    read();
    return make_geometry(std::move(elements), options);
}

void add_sections(nb::module_& module) {
    module.def("naca", &naca);
    module.def("outlines", &outlines);
}

}  // namespace lamina::python
