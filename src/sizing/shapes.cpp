#include "sizing/shapes.hpp"

#include <iterator>
#include <vector>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "core/reproducible_math.hpp"
#include "core/text.hpp"

namespace lamina::sizing {

namespace {

/// A text of sources: a word and numbers, the last of which is the size.
struct SourceForm {
    const char* word;
    const char* numbers;  ///< what stands for them in help
    bool (*is_of)(const SizeSource& source);
    /// Makes a source of the numbers. Throws UsageError, which quotes the text.
    SizeSource (*read)(const std::vector<double>& numbers, const std::string& text);
    std::vector<double> (*write)(const SizeSource& source);

    std::string text() const { return core::concat(word, ":", numbers); }
    std::size_t count() const { return core::split(numbers, ',').size(); }
};

std::vector<double> corners_and_size(const SizeSource& s) { return {s.a.x, s.a.y, s.b.x, s.b.y, s.size}; }

bool is_segment(const SizeSource& source) { return source.shape == SizeSource::Shape::segment; }

constexpr SourceForm forms[] = {
    {"box", "X0,Y0,X1,Y1,H", [](const SizeSource& s) { return s.shape == SizeSource::Shape::box; },
     [](const std::vector<double>& n, const std::string&) {
         const Box box = core::bounding_box({n[0], n[1]}, {n[2], n[3]});
         return SizeSource{.a = box.lower, .b = box.upper, .size = n[4], .shape = SizeSource::Shape::box};
     },
     corners_and_size},
    {"circle", "X,Y,R,H", [](const SizeSource& s) { return is_segment(s) && s.radius > 0; },
     [](const std::vector<double>& n, const std::string& text) {
         core::require_text(n[2] > 0, text, "the radius must be > 0");
         return SizeSource{.a = {n[0], n[1]}, .b = {n[0], n[1]}, .size = n[3], .radius = n[2]};
     },
     [](const SizeSource& s) {
         return std::vector<double>{s.a.x, s.a.y, s.radius, s.size};
     }},
    {"line", "X0,Y0,X1,Y1,H", [](const SizeSource& s) { return is_segment(s) && !(s.radius > 0); },
     [](const std::vector<double>& n, const std::string&) {
         return SizeSource{.a = {n[0], n[1]}, .b = {n[2], n[3]}, .size = n[4]};
     },
     corners_and_size},
};

/// Returns the length of the part of a segment that lies in a box.
double length_inside(const Box& box, Point a, Point b) {
    double from = 0, to = 1;
    const auto clip = [&](double start, double along, double lower, double upper) {
        if (along == 0) {
            if (start < lower || start > upper) to = -1;
            return;
        }
        const double enter = (lower - start) / along, leave = (upper - start) / along;
        from = std::max(from, std::min(enter, leave));
        to = std::min(to, std::max(enter, leave));
    };
    clip(a.x, b.x - a.x, box.lower.x, box.upper.x);
    clip(a.y, b.y - a.y, box.lower.y, box.upper.y);
    return std::max(to - from, 0.0) * distance(a, b);
}

/// Returns width and height of the common part of the domain and the box round a source.
Point sides_inside(const Box& domain, const SizeSource& source) {
    const Box inside = bounding_box(source).intersection(domain);
    return {std::max(inside.width(), 0.0), std::max(inside.height(), 0.0)};
}

}  // namespace

Extent SegmentShape::extent_in(const Box& domain, const SizeSource& source) {
    if (!(source.radius > 0)) return {.border = 2 * length_inside(domain, source.a, source.b)};
    const auto [width, height] = sides_inside(domain, source);
    return {0.25 * core::pi * width * height, 0.5 * core::pi * (width + height)};
}

Extent BoxShape::extent_in(const Box& domain, const SizeSource& source) {
    const auto [width, height] = sides_inside(domain, source);
    return {width * height, 2 * (width + height)};
}

SourceShape prepare_shape(const SizeSource& s) {
    const Point along = s.b - s.a;
    const double squared = squared_length(along);
    return {s.a, along, squared > 0 ? 1.0 / squared : 0.0, s.radius, s.shape};
}

bool covers(const SourceShape& shape, const Box& box) {
    if (!has_inside(shape)) return false;
    // A convex shape holds a box if it holds the box's corners.
    const std::array<Point, 4> corners = box.corners();
    return std::all_of(corners.begin(), corners.end(), [&](Point p) { return distance_to(shape, p) == 0; });
}

Extent extent_in(const Box& domain, const SizeSource& source) {
    return with_shape(source.shape, [&](auto kind) { return kind.extent_in(domain, source); });
}

const char* shape_fault(const SizeSource& source) {
    return with_shape(source.shape, [&](auto kind) { return kind.fault(source); });
}

std::string source_forms() {
    std::string text;
    for (const SourceForm& form : forms) {
        const char* const before = &form == std::begin(forms) ? "" : &form == std::end(forms) - 1 ? " or " : ", ";
        text += before + form.text();
    }
    return text;
}

SizeSource parse_size_source(const std::string& text) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const std::string word = text.substr(0, colon);
    const auto form = std::find_if(std::begin(forms), std::end(forms), [&](const auto& f) { return f.word == word; });
    core::require_text(form != std::end(forms) && colon < text.size(), text, "a shape is " + source_forms());
    const std::vector<double> numbers = core::parse_numbers(text.substr(colon + 1), ',');
    core::require_text(numbers.size() == form->count(), text,
                       core::concat("a ", word, " takes ", form->count(), " numbers, not ", numbers.size()));
    core::require_text(numbers.back() > 0, text, "the edge length must be > 0");
    return form->read(numbers, text);
}

std::string size_source_text(const SizeSource& source) {
    const SourceForm& form =
        *std::find_if(std::begin(forms), std::end(forms), [&](const auto& f) { return f.is_of(source); });
    std::string text;
    for (const double number : form.write(source))
        text += core::concat(text.empty() ? core::concat(form.word, ":") : ",", number);
    return text;
}

}  // namespace lamina::sizing

namespace lamina {

using namespace sizing;

double distance_to(const SizeSource& source, Point p) { return distance_to(prepare_shape(source), p); }

Box bounding_box(const SizeSource& source) {
    const Box box = core::bounding_box(source.a, source.b);
    const Point margin{source.radius, source.radius};
    return {box.lower - margin, box.upper + margin};
}

}  // namespace lamina
