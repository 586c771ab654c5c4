#include "morphing/arc_curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace lamina::morphing {

namespace {

/// Nodes and weights of the Gauss-Legendre rule of five points on [0, 1].
/// Source: M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), table 25.4.
constexpr std::array<double, 5> gauss_nodes{0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                                            0.95308992296933200};
constexpr std::array<double, 5> weights{0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                        0.23931433524968324, 0.11846344252809454};

/// Returns by how much the arc grows with the share of a piece, whose chord has this length.
double speed(const surface::SplineCurve& curve, std::size_t piece, double share, double chord) {
    return chord * length(curve.direction(piece, share));
}

double arc_up_to(const surface::SplineCurve& curve, std::size_t piece, double share, double chord) {
    double sum = 0;
    for (std::size_t k = 0; k < gauss_nodes.size(); ++k)
        sum += weights[k] * speed(curve, piece, share * gauss_nodes[k], chord);
    return share * sum;
}

double chord_of(const surface::SplineCurve& curve, std::size_t piece) {
    return distance(curve.at(piece, 0), curve.at(piece, 1));
}

}  // namespace

ArcCurve::ArcCurve(const surface::SmoothRun& run) : curve_(run), arc_{0} {
    for (std::size_t piece = 0; piece < curve_.pieces(); ++piece)
        arc_.push_back(arc_.back() + arc_up_to(curve_, piece, 1, chord_of(curve_, piece)));
}

Point ArcCurve::at(double arc_length) const {
    const auto above = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, arc_length);
    const auto piece = static_cast<std::size_t>(above - arc_.begin() - 1);
    const double chord = chord_of(curve_, piece), rest = arc_length - arc_[piece];
    // Newton's method. The arc is nearly linear in the share, and each step squares the error: from 0.1 to 1e-16 in
    // four.
    double share = rest / (arc_[piece + 1] - arc_[piece]);
    for (int k = 0; k < 4; ++k)
        share -= (arc_up_to(curve_, piece, share, chord) - rest) / speed(curve_, piece, share, chord);
    return curve_.at(piece, std::clamp(share, 0.0, 1.0));
}

}  // namespace lamina::morphing
