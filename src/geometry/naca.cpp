// NACA 4- and 5-digit sections.
// Source: E. N. Jacobs, K. E. Ward, R. M. Pinkerton, NACA Report 460 (1933); E. N. Jacobs, R. M. Pinkerton, NACA Report
// 537 (1935). For a sharp trailing edge the last coefficient of the thickness is -0.1036, which closes the tail with
// the least change elsewhere (J. Moran, Theoretical and Computational Aerodynamics, 1984).
#include "geometry/naca.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/reproducible_math.hpp"
#include "geometry/characters.hpp"
#include "geometry/outline_repair.hpp"

namespace lamina::geometry {

namespace {

constexpr std::size_t min_points = 6, max_points = 10'000'000;

/// The mean line at one x.
struct Camber {
    double y = 0, slope = 0;
};

/// The mean line of 4-digit sections: two parabolas that meet at the largest camber.
struct FourDigitLine {
    double max_camber, position;  ///< in chords

    Camber operator()(double x) const {
        const double m = max_camber, p = position;
        if (m == 0) return {};
        if (x < p) return {m / (p * p) * (2 * p * x - x * x), 2 * m / (p * p) * (p - x)};
        const double q = 1 - p;
        return {m / (q * q) * ((1 - 2 * p) + 2 * p * x - x * x), 2 * m / (q * q) * (p - x)};
    }
};

/// The mean line of 5-digit sections (Report 537): cubic up to x = r; behind it straight or, if reflexed, cubic. The
/// tabled k1 are for a design lift coefficient of 0.3.
struct FiveDigitLine {
    double r, k1, k2_over_k1;
    bool reflexed;

    Camber operator()(double x) const {
        const double r3 = r * r * r, q = 1 - r, d = x - r;
        if (reflexed) {
            const double k = x < r ? 1.0 : k2_over_k1, tail = k2_over_k1 * q * q * q + r3;
            return {k1 / 6 * (k * d * d * d - tail * x + r3), k1 / 6 * (3 * k * d * d - tail)};
        }
        if (x < r)
            return {k1 / 6 * (x * x * x - 3 * r * x * x + r * r * (3 - r) * x),
                    k1 / 6 * (3 * x * x - 6 * r * x + r * r * (3 - r))};
        return {k1 * r3 / 6 * (1 - x), -k1 * r3 / 6};
    }
};

struct NacaSection {
    double thickness;  ///< in chords
    std::optional<FiveDigitLine> five_digit;
    FourDigitLine four_digit{0, 0};

    Camber camber(double x) const { return five_digit ? (*five_digit)(x) : four_digit(x); }

    /// Returns the x where both parts of the mean line meet. The curvature or the third derivative jumps there. Where
    /// the curvature does, the outline has a corner, since the thickness is put on across the mean line.
    std::optional<double> joint() const {
        if (five_digit) return five_digit->r;
        return four_digit.max_camber > 0 ? std::optional(four_digit.position) : std::nullopt;
    }
};

UsageError bad_digits(const std::string& digits, const std::string& reason) {
    return UsageError(fmt::format("naca:{}: {}", digits, reason));
}

/// Returns whether a name of digits and others begins as those of the 6-series do: 63 to 67.
bool is_of_six_series(const std::string& name) {
    return name.size() >= 5 && name[0] == '6' && name[1] >= '3' && name[1] <= '7';
}

/// Returns advice on the names of families that are not made here; empty for others. The ordinates of the 1-series and
/// the 6-series follow from flows, not from formulas of their digits.
std::string advice_on_family(const std::string& name) {
    const bool is_modified = name.size() > 5 && (name[4] == '-' || name[5] == '-');
    if (is_of_six_series(name)) return "; give a file of coordinates for a section of the 6-series, such as 63-012";
    if (name.size() >= 5 && name.starts_with("16")) return "; give a file of coordinates for a section of the 1-series";
    if (is_modified) return "; give a file of coordinates for a modified section, such as 0012-64";
    return "";
}

/// Returns a warning where the digits of a five-digit section are also those of one of the 6-series, whose name is
/// often written without its dash.
std::optional<Warning> ambiguity_of(const std::string& digits) {
    if (digits.size() != 5 || !is_of_six_series(digits)) return std::nullopt;
    const double lift = 0.15 * (digits[0] - '0');
    return Warning{.code = WarningCode::ambiguous_section,
                   .number = lift,
                   .unit = "design lift coefficient",
                   .message = fmt::format("naca:{} is the five-digit section with a design lift coefficient of {:.2g}, "
                                          "not NACA {}-{} of the 6-series; give a file of coordinates for that one",
                                          digits, lift, digits.substr(0, 2), digits.substr(2))};
}

FourDigitLine four_digit_line(const std::string& digits) {
    const int camber = digits[0] - '0', position = digits[1] - '0';
    if ((camber == 0) != (position == 0))
        throw bad_digits(digits, "camber and its position must both be given or both be 0");
    return {camber / 100.0, position / 10.0};
}

FiveDigitLine five_digit_line(const std::string& digits) {
    constexpr FiveDigitLine simple[] = {{0.0580, 361.400, 0, false},
                                        {0.1260, 51.640, 0, false},
                                        {0.2025, 15.957, 0, false},
                                        {0.2900, 6.643, 0, false},
                                        {0.3910, 3.230, 0, false}};
    constexpr FiveDigitLine reflexed[] = {{0.1300, 51.990, 0.000764, true},
                                          {0.2170, 15.793, 0.00677, true},
                                          {0.3180, 6.520, 0.0303, true},
                                          {0.4410, 3.191, 0.1355, true}};
    const int lift = digits[0] - '0', position = digits[1] - '0', reflex = digits[2] - '0';
    if (lift == 0 || reflex > 1 || position < 1 + reflex || position > 5)
        throw bad_digits(digits,
                         "the first three digits must be 110 to 950 or, reflexed, 121 to 951, the second of them at "
                         "most 5" +
                             advice_on_family(digits));
    FiveDigitLine line = reflex == 1 ? reflexed[position - 2] : simple[position - 1];
    line.k1 *= lift / 2.0;
    return line;
}

NacaSection parse_digits(const std::string& digits) {
    const std::size_t n = digits.size();
    if (!std::all_of(digits.begin(), digits.end(), is_digit) || (n != 4 && n != 5))
        throw bad_digits(digits,
                         "a section has 4 or 5 digits, as in naca:0012 or naca:23012" + advice_on_family(digits));
    NacaSection section;
    section.thickness = (10 * (digits[n - 2] - '0') + (digits[n - 1] - '0')) / 100.0;
    if (section.thickness == 0) throw bad_digits(digits, "no thickness");
    if (n == 4) {
        section.four_digit = four_digit_line(digits);
    } else {
        section.five_digit = five_digit_line(digits);
    }
    return section;
}

// ---- abscissae -----------------------------------------------------------------------------------------------------

/// Returns n + 1 numbers from 0 to 1 by cosine spacing.
std::vector<double> cosine_abscissae(std::size_t n) {
    std::vector<double> abscissae;
    for (std::size_t k = 0; k <= n; ++k) {
        // (1 - cos 2a) / 2 = sin^2 a has no cancellation at the leading edge.
        const double s = core::sin_reproducible(core::pi * static_cast<double>(k) / static_cast<double>(2 * n));
        abscissae.push_back(k == n ? 1.0 : s * s);
    }
    return abscissae;
}

// ---- points --------------------------------------------------------------------------------------------------------

/// Points of both surfaces from the leading to the trailing edge, which both have in common.
struct NacaSurfaces {
    std::vector<Point> upper, lower;
};

/// Where the published thickness vanishes behind the trailing edge, in chords.
constexpr double end_of_thickness = 1.0089304115;

/// Returns the points of each surface at ascending parameters x from 0 to 1.
NacaSurfaces make_surfaces(const NacaSection& section, std::span<const double> abscissae, TrailingEdge trailing_edge) {
    const std::size_t n = abscissae.size() - 1;
    const double last_coefficient = trailing_edge == TrailingEdge::sharp ? -0.1036 : -0.1015;
    const double length = trailing_edge == TrailingEdge::extended ? end_of_thickness : 1;
    NacaSurfaces surfaces{std::vector<Point>(n + 1), std::vector<Point>(n + 1)};
    for (std::size_t k = 1; k <= n; ++k) {
        const double x = abscissae[k];
        const double stretched = length * x;
        const double half_thickness =
            5 * section.thickness *
            (0.2969 * std::sqrt(stretched) +
             stretched * (-0.1260 + stretched * (-0.3516 + stretched * (0.2843 + stretched * last_coefficient)))) /
            length;
        // Rounding must open no gap at x = 1.
        const double t = k == n && trailing_edge != TrailingEdge::blunt ? 0.0 : half_thickness;
        Camber camber = section.camber(x);
        if (k == n) camber.y = 0;
        const double cosine = 1 / std::sqrt(1 + camber.slope * camber.slope);
        const Point normal{-camber.slope * cosine, cosine};
        surfaces.upper[k] = {x + t * normal.x, camber.y + t * normal.y};
        surfaces.lower[k] = {x - t * normal.x, camber.y - t * normal.y};
    }
    return surfaces;
}

Element make_element(const std::string& digits, const NacaSurfaces& surfaces) {
    RawOutline outline;
    outline.title = fmt::format("NACA {}", digits);
    outline.format = "naca";
    const std::size_t n = surfaces.upper.size() - 1;
    for (std::size_t k = n + 1; k-- > 0;) outline.points.push_back({surfaces.upper[k], 0});
    for (std::size_t k = 1; k <= n; ++k) outline.points.push_back({surfaces.lower[k], 0});
    Element element = repair_outline(outline, "naca:" + digits);
    element.points_read = 0;
    element.repairs.clear();  // joining the surfaces and closing the base repair nothing
    element.name = "airfoil";
    if (auto ambiguity = ambiguity_of(digits)) element.warnings.push_back(std::move(*ambiguity));
    return element;
}

}  // namespace

Element sample_naca_section(const std::string& digits, TrailingEdge trailing_edge) {
    constexpr std::size_t edges = 1000;  // of each surface
    const NacaSection section = parse_digits(digits);
    const std::optional<double> joint = section.joint();
    std::vector<double> abscissae = cosine_abscissae(edges);
    std::size_t nearest = 0;
    for (std::size_t k = 0; joint && k <= edges; ++k)
        if (std::abs(abscissae[k] - *joint) < std::abs(abscissae[nearest] - *joint)) nearest = k;
    if (joint) abscissae[nearest] = *joint;

    const NacaSurfaces surfaces = make_surfaces(section, abscissae, trailing_edge);
    Element element = make_element(digits, surfaces);
    element.samples_of_curve = true;
    for (std::size_t i = 0; joint && i < element.points.size(); ++i)
        if (element.points[i] == surfaces.upper[nearest] || element.points[i] == surfaces.lower[nearest])
            element.given_corners.push_back(i);
    return element;
}

}  // namespace lamina::geometry

namespace lamina {

using namespace geometry;

Element naca_airfoil(const std::string& digits, std::size_t points, TrailingEdge trailing_edge) {
    const NacaSection section = parse_digits(digits);
    if (points < min_points || points > max_points)
        throw UsageError(
            fmt::format("naca:{}: {} points; {} to {} can be made", digits, points, min_points, max_points));
    const std::size_t n =
        trailing_edge != TrailingEdge::blunt ? (points + 1) / 2 : points / 2;  // edges of each surface
    return make_element(digits, make_surfaces(section, cosine_abscissae(n), trailing_edge));
}

}  // namespace lamina
