// The exact stages of the predicates.
// Source: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, Discrete &
// Computational Geometry 18 (1997): expansions, error bounds, stages. Section numbers below refer to it.
//
// Nothing over- or underflows in the range of coordinates that lamina accepts (predicates.hpp):
// - A coordinate of magnitude in [1e-60, 1e60] is below 2^200 and a multiple of u = 2^-252, since 1e-60 > 2^-200 and a
//   double has 52 bits below its first one. Sums, differences and their round-off are multiples of u, too, and below
//   2^201. The two halves of a split number are multiples of the same unit as the number itself. Every value in a
//   product of k differences, round-off included, is hence a multiple of u^k. For k = 4 this is 2^-1008, which is above
//   the smallest subnormal number 2^-1074, so that no round-off is ever lost.
// - The largest determinant is below 6 * 2 * 2^(4 * 201) < 2^808, and splitting multiplies by 2^27 at most, which is
//   far below 2^1024.
// - The error bounds themselves (2^-53 and 2^-106 times a permanent) might underflow only where the permanent is below
//   about 2^-955. Such a permanent holds less than 53 bits over its unit, so every operation under it was exact. So
//   were the differences: an inexact one is at least 2^-199, and its square times two other differences at least
//   2^-902.

#include "core/predicates.hpp"

#include <lamina/predicates.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace lamina::core {

namespace {

// Error bounds of the later stages (sections 4.3 and 4.4), as multiples of the permanent. Bound B holds for the exact
// determinant of the rounded differences, bound C after its first-order correction by the tails of the differences.
constexpr double result_bound = (3 + 8 * epsilon) * epsilon;
constexpr double orient2d_bound_b = (2 + 12 * epsilon) * epsilon;
constexpr double orient2d_bound_c = (9 + 64 * epsilon) * epsilon * epsilon;
constexpr double incircle_bound_b = (4 + 48 * epsilon) * epsilon;
constexpr double incircle_bound_c = (44 + 576 * epsilon) * epsilon * epsilon;

/// The exact result of an operation, head + tail, where head is the rounded result.
struct HeadTail {
    double head, tail;
};

/// Returns a + b.
/// Precondition: |a| >= |b| or a == 0.
inline HeadTail fast_two_sum(double a, double b) {
    const double head = a + b;
    return {head, b - (head - a)};
}

inline HeadTail two_sum(double a, double b) {
    const double head = a + b;
    const double b_seen = head - a;
    const double a_seen = head - b_seen;
    return {head, (a - a_seen) + (b - b_seen)};
}

inline HeadTail two_diff(double a, double b) { return two_sum(a, -b); }

/// Returns a as two halves of 26 bits, whose products are exact (Dekker). Fused multiply-add would be simpler, but is
/// not part of baseline x86-64.
inline HeadTail split(double a) {
    const double c = 0x1.0000002p27 * a;
    const double high = c - (c - a);
    return {high, a - high};
}

inline HeadTail two_product(double a, HeadTail a_halves, double b, HeadTail b_halves) {
    const double head = a * b;
    const double error =
        ((head - a_halves.head * b_halves.head) - a_halves.tail * b_halves.head) - a_halves.head * b_halves.tail;
    return {head, a_halves.tail * b_halves.tail - error};
}

inline HeadTail two_product(double a, double b) { return two_product(a, split(a), b, split(b)); }

/// Returns a number with the sign of a b - c d. Rounding never changes the order of two products, so their round-off
/// counts only where the rounded ones are equal.
inline double compare_products(double a, double b, double c, double d) {
    const double left = a * b, right = c * d;
    if (left != right) return left - right;
    return two_product(a, b).tail - two_product(c, d).tail;
}

/// A sum of doubles that do not overlap, in ascending order of magnitude and without zeros. The last one has the sign
/// of the sum.
template <int Capacity>
struct Expansion {
    int size = 0;
    std::array<double, Capacity> part;  // only the first `size` are set

    void push(double x) {
        if (x != 0) part[size++] = x;
    }
    /// Returns a number with the sign of the sum.
    double sign() const { return size == 0 ? 0.0 : part[size - 1]; }
    /// Returns the rounded sum.
    double estimate() const {
        double sum = 0;
        for (int i = 0; i < size; ++i) sum += part[i];
        return sum;
    }
};

inline Expansion<2> expansion(HeadTail a) {
    Expansion<2> result;
    result.push(a.tail);
    result.push(a.head);
    return result;
}

// The loops over expansions stand outside of the templates, so that they are compiled once and not for each length.

/// Appends x to the n parts of an expansion, unless it is zero.
inline void push(double x, double* parts, int& n) {
    if (x != 0) parts[n++] = x;
}

/// Sets `h` to the sum of the m parts of e and the n parts of f by FAST-EXPANSION-SUM (section 2.4): both are merged
/// by magnitude and summed in one sweep. Zeros are left out. Returns the number of parts.
int add_expansions(const double* e, int m, const double* f, int n, double* h) {
    if (m == 0 || n == 0) {
        std::copy_n(e, m, h);
        std::copy_n(f, n, h);
        return m + n;
    }
    int i = 0, j = 0, size = 0;
    const auto next = [&] {
        const bool from_e = j == n || (i < m && std::abs(e[i]) < std::abs(f[j]));
        return from_e ? e[i++] : f[j++];
    };
    double q = next();
    for (int k = 1; k < m + n; ++k) {
        const HeadTail s = two_sum(q, next());
        push(s.tail, h, size);
        q = s.head;
    }
    push(q, h, size);
    return size;
}

/// Sets `h` to the product of the n parts of e and b by SCALE-EXPANSION (section 2.5). Zeros are left out. Returns the
/// number of parts.
int scale_expansion(const double* e, int n, double b, double* h) {
    if (n == 0 || b == 0) return 0;
    int size = 0;
    const HeadTail b_halves = split(b);
    HeadTail p = two_product(e[0], split(e[0]), b, b_halves);
    push(p.tail, h, size);
    double q = p.head;
    for (int i = 1; i < n; ++i) {
        p = two_product(e[i], split(e[i]), b, b_halves);
        const HeadTail low = two_sum(q, p.tail);
        push(low.tail, h, size);
        const HeadTail high = fast_two_sum(p.head, low.head);
        push(high.tail, h, size);
        q = high.head;
    }
    push(q, h, size);
    return size;
}

template <int M, int N>
Expansion<M + N> operator+(const Expansion<M>& e, const Expansion<N>& f) {
    Expansion<M + N> h;
    h.size = add_expansions(e.part.data(), e.size, f.part.data(), f.size, h.part.data());
    return h;
}

template <int N>
Expansion<2 * N> operator*(const Expansion<N>& e, double b) {
    Expansion<2 * N> h;
    h.size = scale_expansion(e.part.data(), e.size, b, h.part.data());
    return h;
}

template <int N>
Expansion<N> operator-(Expansion<N> e) {
    for (int i = 0; i < e.size; ++i) e.part[i] = -e.part[i];
    return e;
}

/// Returns the product of e and an expansion of up to N parts, which is halved, so that partial sums stay short.
template <int M, int N>
Expansion<2 * M * N> product(const Expansion<M>& e, const double* f, int size) {
    if constexpr (N == 1) {
        return e * (size == 0 ? 0.0 : f[0]);
    } else {
        const int half = std::min(size / 2, N / 2);
        return product<M, N / 2>(e, f, half) + product<M, N - N / 2>(e, f + half, size - half);
    }
}

template <int M, int N>
Expansion<2 * M * N> operator*(const Expansion<M>& e, const Expansion<N>& f) {
    return product<M, N>(e, f.part.data(), f.size);
}

/// Returns a b - c d, exactly.
inline Expansion<4> cross_expansion(double a, double b, double c, double d) {
    return expansion(two_product(a, b)) + expansion(two_product(-c, d));
}

/// Returns a b - c d for factors with tails, exactly.
inline Expansion<16> cross_expansion(const HeadTail& a, const HeadTail& b, const HeadTail& c, const HeadTail& d) {
    return expansion(a) * expansion(b) + -(expansion(c) * expansion(d));
}

/// The difference of two points with its round-off.
struct Difference {
    HeadTail x, y;
    /// Returns whether rounding changed nothing.
    bool exact() const { return x.tail == 0 && y.tail == 0; }
};

inline Difference difference(Point a, Point b) { return {two_diff(a.x, b.x), two_diff(a.y, b.y)}; }

/// Returns (x^2 + y^2) m for the rounded difference.
inline Expansion<32> lifted(const Difference& p, const Expansion<4>& m) {
    return m * p.x.head * p.x.head + m * p.y.head * p.y.head;
}

/// Returns (x^2 + y^2) m for the exact difference.
Expansion<512> lifted(const Difference& p, const Expansion<16>& m) {
    const Expansion<2> x = expansion(p.x), y = expansion(p.y);
    return m * (x * x + y * y);
}

/// Returns the first-order change of one term of the determinant of incircle() by the tails of a, b, c.
inline double first_order(const Difference& a, const Difference& b, const Difference& c) {
    return (a.x.head * a.x.head + a.y.head * a.y.head) *
               ((b.x.head * c.y.tail + c.y.head * b.x.tail) - (b.y.head * c.x.tail + c.x.head * b.y.tail)) +
           2.0 * (a.x.head * a.x.tail + a.y.head * a.y.tail) * (b.x.head * c.y.head - b.y.head * c.x.head);
}

// A stage between the filter and the expansions. Points of a mesh often lie so close together that their differences,
// round-off included, are integers below 2^61 in a common unit. Then 256-bit integers decide exactly, at a quarter of
// the cost of expansions. Lattices and layers need this stage some hundred thousand times.
__extension__ using Int128 = __int128;
__extension__ using Unsigned128 = unsigned __int128;

/// Converts differences to integers, in units of 2^-60 times the power of two below the largest difference. Returns
/// false where one of them is not an integer.
template <std::size_t N>
bool to_integers(const std::array<HeadTail, N>& differences, std::array<std::int64_t, N>& integers) {
    double largest = 0;
    for (const HeadTail& d : differences) largest = std::max(largest, std::abs(d.head));
    if (largest == 0) {
        integers.fill(0);
        return true;
    }
    constexpr std::uint64_t bias = 1023, mantissa_bits = 52;
    // The biased exponent; the range of coordinates keeps it far from its ends.
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(largest) >> mantissa_bits;
    const double scale = std::bit_cast<double>((2 * bias + 60 - exponent) << mantissa_bits);
    bool exact = true;
    for (std::size_t i = 0; i < N; ++i) {
        const double head = differences[i].head * scale, tail = differences[i].tail * scale;
        const auto head_integer = static_cast<std::int64_t>(head), tail_integer = static_cast<std::int64_t>(tail);
        exact &= static_cast<double>(head_integer) == head && static_cast<double>(tail_integer) == tail;
        integers[i] = head_integer + tail_integer;
    }
    return exact;
}

inline Int128 product(std::int64_t a, std::int64_t b) { return static_cast<Int128>(a) * b; }

/// A sum of products of 124-bit numbers in three overlapping parts: high 2^128 + middle 2^64 + low.
class Sum256 {
public:
    /// Adds a b for 0 <= a < 2^124, |b| < 2^124.
    void add_product(Int128 a, Int128 b) {
        const auto a_high = static_cast<std::int64_t>(a >> 64), b_high = static_cast<std::int64_t>(b >> 64);
        const auto a_low = static_cast<std::uint64_t>(a), b_low = static_cast<std::uint64_t>(b);
        const Unsigned128 lowest = static_cast<Unsigned128>(a_low) * b_low;
        high_ += product(a_high, b_high);
        middle_ += static_cast<Int128>(a_high) * b_low + static_cast<Int128>(b_high) * a_low +
                   static_cast<Int128>(lowest >> 64);
        low_ += static_cast<std::uint64_t>(lowest);
    }
    double sign() const {
        const Int128 middle = middle_ + static_cast<Int128>(low_ >> 64);
        const Int128 high = high_ + (middle >> 64);
        if (high != 0) return high > 0 ? 1 : -1;
        return static_cast<std::uint64_t>(middle) != 0 || static_cast<std::uint64_t>(low_) != 0 ? 1 : 0;
    }

private:
    Int128 high_ = 0, middle_ = 0;
    Unsigned128 low_ = 0;
};

/// Sets `sign` to that of incircle() and returns true where the differences are integers; else returns false.
bool incircle_integer(const Difference& a, const Difference& b, const Difference& c, double& sign) {
    std::array<std::int64_t, 6> integers;
    if (!to_integers<6>({a.x, a.y, b.x, b.y, c.x, c.y}, integers)) return false;
    const auto [ax, ay, bx, by, cx, cy] = integers;
    Sum256 det;
    det.add_product(product(ax, ax) + product(ay, ay), product(bx, cy) - product(by, cx));
    det.add_product(product(bx, bx) + product(by, by), product(cx, ay) - product(cy, ax));
    det.add_product(product(cx, cx) + product(cy, cy), product(ax, by) - product(ay, bx));
    sign = det.sign();
    return true;
}

double incircle_exact(const Difference& a, const Difference& b, const Difference& c) {
    const auto term = [](const Difference& p, const Difference& q, const Difference& r) {
        return lifted(p, cross_expansion(q.x, r.y, r.x, q.y));
    };
    return (term(a, b, c) + term(b, c, a) + term(c, a, b)).sign();
}

double incircle_adaptive(Point pa, Point pb, Point pc, Point pd) {
    const Difference a = difference(pa, pd), b = difference(pb, pd), c = difference(pc, pd);
    double sign;
    if (incircle_integer(a, b, c, sign)) return sign;

    const auto term = [](const Difference& p, const Difference& q, const Difference& r) {
        return lifted(p, cross_expansion(q.x.head, r.y.head, r.x.head, q.y.head));
    };
    const Expansion<96> det_of_heads = term(a, b, c) + term(b, c, a) + term(c, a, b);
    if (a.exact() && b.exact() && c.exact()) return det_of_heads.sign();

    double det = det_of_heads.estimate();
    const double permanent = rounded_incircle(pa, pb, pc, pd).permanent;
    if (std::abs(det) > incircle_bound_b * permanent) return det;
    const double error = incircle_bound_c * permanent + result_bound * std::abs(det);
    det += first_order(a, b, c) + first_order(b, c, a) + first_order(c, a, b);
    if (std::abs(det) > error) return det;
    return incircle_exact(a, b, c);
}

/// Returns a number whose sign is that of the change of the determinant of incircle() where the point `index` of a, b,
/// c, d is lowered: minus the point's cofactor in the column of heights.
double change_by_lowering(int index, const std::array<Point, 4>& p) {
    switch (index) {
        case 0:
            return -inline_orient2d(p[1], p[2], p[3]);
        case 1:
            return -inline_orient2d(p[2], p[0], p[3]);
        case 2:
            return -inline_orient2d(p[0], p[1], p[3]);
        default:
            return inline_orient2d(p[0], p[1], p[2]);
    }
}

/// Returns a number whose sign is that of incircle_perturbed() for cocircular points. In lexicographical order, each
/// point is lowered by an infinitesimal beyond those of all later points, so that the first cofactor that is not 0
/// decides. This is the cofactor of the smallest point, since no three of four distinct cocircular points are
/// collinear.
double break_tie(const std::array<Point, 4>& p) {
    const int smaller_ab = lexicographically_less(p[1], p[0]) ? 1 : 0;
    const int smaller_cd = lexicographically_less(p[3], p[2]) ? 3 : 2;
    const int smallest = lexicographically_less(p[smaller_cd], p[smaller_ab]) ? smaller_cd : smaller_ab;
    return change_by_lowering(smallest, p);
}

}  // namespace

double orient2d_after_filter(Point pa, Point pb, Point pc) {
    const Difference a = difference(pa, pc), b = difference(pb, pc);
    if (a.exact() && b.exact()) return compare_products(a.x.head, b.y.head, a.y.head, b.x.head);
    std::array<std::int64_t, 4> integers;
    if (to_integers<4>({a.x, a.y, b.x, b.y}, integers)) {
        const auto [ax, ay, bx, by] = integers;
        const Int128 left = product(ax, by), right = product(ay, bx);
        return left > right ? 1 : left < right ? -1 : 0;
    }
    const Expansion<4> det_of_heads = cross_expansion(a.x.head, b.y.head, a.y.head, b.x.head);
    double det = det_of_heads.estimate();
    const double permanent = std::abs(a.x.head * b.y.head) + std::abs(a.y.head * b.x.head);
    if (std::abs(det) > orient2d_bound_b * permanent) return det;
    const double error = orient2d_bound_c * permanent + result_bound * std::abs(det);
    det += (a.x.head * b.y.tail + b.y.head * a.x.tail) - (a.y.head * b.x.tail + b.x.head * a.y.tail);
    if (std::abs(det) > error) return det;
    return cross_expansion(a.x, b.y, a.y, b.x).sign();
}

double incircle_after_filter(Point a, Point b, Point c, Point d) {
    const double det = incircle_adaptive(a, b, c, d);
    return det != 0 ? det : break_tie({a, b, c, d});
}

double compare_distances(Point p, Point a, Point b) {
    const double to_a = squared_length(a - p), to_b = squared_length(b - p);
    // Each square has four roundings at most: of the difference, twice, of the square and of the sum.
    constexpr double bound = 5 * epsilon;
    if (std::abs(to_a - to_b) > bound * (to_a + to_b)) return to_a - to_b;
    const auto square = [](const HeadTail& t) { return expansion(t) * expansion(t); };
    const Difference da = difference(a, p), db = difference(b, p);
    return ((square(da.x) + square(da.y)) + -(square(db.x) + square(db.y))).sign();
}

double flattened_turn_after_filter(Point pa, Point pb, Point pc, double cut) {
    const HeadTail ax = two_diff(pa.x, cut), bx = two_diff(pb.x, cut), cx = two_diff(pc.x, cut);
    const HeadTail by = two_diff(pb.y, pa.y), cy = two_diff(pc.y, pa.y);
    std::array<std::int64_t, 5> integers;
    if (to_integers<5>({ax, bx, cx, by, cy}, integers)) {
        const auto [a_across, b_across, c_across, b_along, c_along] = integers;
        const Int128 squared_a = product(a_across, a_across);
        Sum256 det;
        det.add_product(b_along, product(c_across, c_across) - squared_a + product(c_along, c_along));
        det.add_product(c_along, squared_a - product(b_across, b_across) - product(b_along, b_along));
        return det.sign();
    }
    const auto square = [](const HeadTail& t) { return expansion(t) * expansion(t); };
    const Expansion<8> squared_a = square(ax);
    const Expansion<24> b_height = square(bx) + -squared_a + square(by),
                        c_height = square(cx) + -squared_a + square(cy);
    return (c_height * expansion(by) + -(b_height * expansion(cy))).sign();
}

}  // namespace lamina::core

namespace lamina {

using namespace core;

double orient2d(Point a, Point b, Point c) { return inline_orient2d(a, b, c); }

double incircle(Point a, Point b, Point c, Point d) {
    const RoundedIncircle rounded = rounded_incircle(a, b, c, d);
    return rounded.certain() ? rounded.det : incircle_adaptive(a, b, c, d);
}

double incircle_perturbed(Point a, Point b, Point c, Point d) { return inline_incircle_perturbed(a, b, c, d); }

}  // namespace lamina
