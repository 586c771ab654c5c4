#include "geometry/drawings/outlines_of_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "core/text.hpp"
#include "geometry/drawings/chains.hpp"
#include "geometry/drawings/plane.hpp"
#include "geometry/drawings/samples.hpp"
#include "geometry/inside.hpp"

namespace lamina::geometry {

namespace {

/// Distances of ends that are joined, as shares of the drawing: the least one that joins most.
constexpr std::array<double, 3> join_shares{1e-6, 1e-5, 1e-4};
/// Edges leave the curves by at most this share of the outline.
constexpr double deviation_share = 1e-6;
/// The gap of an open outline is at most this share of its length.
constexpr double max_gap_share = 0.1;
/// Outlines below this share of the largest are text, arrows and marks.
constexpr double min_size_share = 0.01;
/// A far field that is no rectangle is this many times as large as what it contains, and about as wide as high.
constexpr double far_field_ratio = 5;
constexpr std::size_t max_drawn_outlines = 2000, max_drawn_points = 4'000'000;

/// A chain with its measures.
struct Outline {
    Chain chain;
    std::vector<Point> rough;
    Box box;
    double length = 0, area = 0;

    double size() const { return core::longer_side(box); }
    double gap() const { return chain.is_closed ? 0 : distance(rough.front(), rough.back()); }
    bool is_nearly_closed() const { return gap() <= max_gap_share * length && area > 1e-9 * length * length; }
};

Outline measured(std::span<const FlatCurve> curves, Chain chain) {
    Outline outline{std::move(chain), {}, {}, 0, 0};
    outline.rough = rough_points(curves, outline.chain);
    const std::vector<Point>& p = outline.rough;
    double area = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        outline.box.include(p[i]);
        const Point next = p[i + 1 < p.size() ? i + 1 : 0];
        if (i + 1 < p.size()) outline.length += distance(p[i], next);
        area += 0.5 * cross(p[i] - p[0], next - p[0]);
    }
    outline.area = std::abs(area);
    return outline;
}

bool is_one_straight_line(std::span<const FlatCurve> curves, const Chain& chain) {
    return std::all_of(chain.links.begin(), chain.links.end(), [&](const ChainLink& link) {
        return curves[link.curve].curve.is_straight() && curves[link.curve].curve.control.size() == 2;
    });
}

/// Joins the curves with the least distance that leaves the fewest chains open.
std::vector<Chain> chains_of(std::span<const FlatCurve> curves, double size, const std::string& file,
                             std::vector<std::string>& notes) {
    std::vector<Chain> best;
    std::vector<std::string> best_notes;
    std::size_t fewest = 0;
    for (const double share : join_shares) {
        std::vector<std::string> own_notes;
        std::vector<Chain> chains = join_curves(curves, share, size, file, own_notes);
        const auto open = static_cast<std::size_t>(std::count_if(chains.begin(), chains.end(), [&](const Chain& chain) {
            return !chain.is_closed && !is_one_straight_line(curves, chain);
        }));
        if (share != join_shares[0] && open >= fewest) continue;
        if (share != join_shares[0]) own_notes.push_back(fmt::format("ends up to {:.2g} apart joined", share * size));
        best = std::move(chains);
        best_notes = std::move(own_notes);
        fewest = open;
        if (open == 0) break;
    }
    notes.insert(notes.end(), best_notes.begin(), best_notes.end());
    return best;
}

bool box_holds(const Box& outer, const Box& inner) {
    return outer.contains(inner.lower) && outer.contains(inner.upper);
}

/// The outlines of a drawing, of which some are left out.
class Selection {
public:
    Selection(std::vector<Outline> outlines, std::vector<std::string>& notes)
        : outlines_(std::move(outlines)), notes_(notes) {}

    std::vector<Outline> take() {
        leave_out_repeated();
        while (leave_out_frame()) {
        }
        leave_out_small();
        leave_out_inner();
        return std::move(outlines_);
    }

private:
    std::vector<Outline> outlines_;
    std::vector<std::string>& notes_;

    template <class Predicate>
    void leave_out(Predicate predicate, const char* reason) {
        std::vector<Outline> kept;
        for (Outline& outline : outlines_)
            if (!predicate(outline)) kept.push_back(std::move(outline));
        const std::size_t count = outlines_.size() - kept.size();
        if (count > 0) notes_.push_back(core::counted(count, "outline") + " left out: " + reason);
        outlines_ = std::move(kept);
    }

    double largest() const {
        double size = 0;
        for (const Outline& outline : outlines_) size = std::max(size, outline.size());
        return size;
    }

    void leave_out_small() {
        const double least = min_size_share * largest();
        leave_out([&](const Outline& o) { return o.size() < least; }, "below 1 % of the largest");
    }

    void leave_out_repeated() {
        constexpr double rounding = 1e-4;
        std::stable_sort(outlines_.begin(), outlines_.end(),
                         [](const Outline& a, const Outline& b) { return a.box.lower.x < b.box.lower.x; });
        std::vector<bool> is_repeated(outlines_.size());
        for (std::size_t i = 0; i < outlines_.size(); ++i) {
            const Outline& a = outlines_[i];
            const double near = rounding * a.size();
            for (std::size_t j = i + 1; j < std::min(outlines_.size(), i + 64); ++j) {
                const Outline& b = outlines_[j];
                if (b.box.lower.x > a.box.lower.x + near) break;
                const bool is_same = distance(a.box.lower, b.box.lower) <= near &&
                                     distance(a.box.upper, b.box.upper) <= near &&
                                     std::abs(a.area - b.area) <= 10 * rounding * a.area;
                if (is_same) is_repeated[a.chain.links[0].curve < b.chain.links[0].curve ? j : i] = true;
            }
        }
        std::size_t i = 0;
        leave_out([&](const Outline&) { return is_repeated[i++]; }, "drawn twice");
        std::stable_sort(outlines_.begin(), outlines_.end(), [](const Outline& a, const Outline& b) {
            return a.chain.links[0].curve < b.chain.links[0].curve;
        });
    }

    /// Leaves out a rectangle round all others, or what is round them as far away as a far field.
    bool leave_out_frame() {
        if (outlines_.size() < 2) return false;
        const auto outer = std::max_element(outlines_.begin(), outlines_.end(), [](const Outline& a, const Outline& b) {
            return a.box.width() + a.box.height() < b.box.width() + b.box.height();
        });
        double inner = 0;
        for (const Outline& o : outlines_) {
            if (&o == &*outer) continue;
            if (!box_holds(outer->box, o.box)) return false;
            inner = std::max(inner, o.size());
        }
        constexpr double rounding = 1e-6, min_full_share = 0.6, max_aspect_ratio = 3;  // which no section has
        const double width = outer->box.width(), height = outer->box.height();
        const bool is_rectangle = outer->area > (1 - rounding) * width * height;
        const bool is_far_field = outer->size() >= far_field_ratio * inner &&
                                  std::max(width, height) <= max_aspect_ratio * std::min(width, height) &&
                                  outer->area >= min_full_share * width * height;
        if (!is_rectangle && !is_far_field) return false;
        const std::size_t first = outer->chain.links[0].curve;
        leave_out([&](const Outline& o) { return o.chain.links[0].curve == first; }, "a frame round all others");
        return true;
    }

    void leave_out_inner() {
        if (outlines_.size() > max_drawn_outlines) return;  // refused later
        std::vector<bool> is_inner(outlines_.size());
        for (std::size_t i = 0; i < outlines_.size(); ++i)
            for (std::size_t j = 0; j < outlines_.size() && !is_inner[i]; ++j)
                is_inner[i] = outlines_[j].area > outlines_[i].area && box_holds(outlines_[j].box, outlines_[i].box) &&
                              contains(outlines_[j].rough, outlines_[i].rough[0]);
        std::size_t i = 0;
        leave_out([&](const Outline&) { return is_inner[i++]; }, "inside another one, where there is no flow");
    }
};

[[noreturn]] void refuse_open(const std::vector<Outline>& open, std::span<const FlatCurve> curves,
                              const std::string& file) {
    const Outline& longest = *std::max_element(open.begin(), open.end(),
                                               [](const Outline& a, const Outline& b) { return a.length < b.length; });
    throw InputError(
        {file, curves[longest.chain.links[0].curve].line, longest.rough.front()},
        fmt::format("the curves close no outline: the longest of {} chains ends at ({:.6g}, {:.6g}), {:.3g} "
                    "from its start; join them, or give --close",
                    open.size(), longest.rough.back().x, longest.rough.back().y, longest.gap()));
}

/// Returns the outlines of the curves of one plane.
std::vector<RawOutline> outlines_of_plane(std::span<const FlatCurve> curves, const std::string& file, bool keep_open,
                                          std::vector<std::string>& notes) {
    Box box;
    for (const FlatCurve& drawn : curves)
        for (const Point p : drawn.curve.control) box.include(p);
    std::vector<Outline> closed, open;
    for (Chain& chain : chains_of(curves, core::longer_side(box), file, notes)) {
        Outline outline = measured(curves, std::move(chain));
        if (outline.rough.empty()) continue;  // polylines whose vertices are all the same
        (outline.is_nearly_closed() ? closed : open).push_back(std::move(outline));
    }
    std::erase_if(open, [&](const Outline& o) { return is_one_straight_line(curves, o.chain); });
    if (closed.empty()) {
        if (open.empty())
            throw InputError({file, curves[0].line, {}},
                             "the drawing has straight lines alone, and no outline: join them to a closed polyline, or "
                             "export points, one line 'x y' each");
        if (open.size() > 1 && !keep_open) refuse_open(open, curves, file);
        std::swap(closed, open);
    }
    if (!open.empty()) notes.push_back(core::counted(open.size(), "open chain") + " of curves left out");
    std::vector<Outline> outlines = Selection(std::move(closed), notes).take();
    if (outlines.empty())
        throw InputError({file, curves[0].line, {}},
                         "the drawing has no outline with an inside: export the section as a closed curve, or points, "
                         "one line 'x y' each");
    if (outlines.size() > max_drawn_outlines)
        throw InputError({file, 1, {}}, fmt::format("more than {} outlines in one drawing", max_drawn_outlines));

    std::vector<RawOutline> result;
    std::size_t points = 0;
    for (const Outline& outline : outlines) {
        SampledChain sampled = sample(curves, outline.chain, outline.size(), deviation_share * outline.size(), file);
        points += sampled.points.size();
        const FlatCurve& first = curves[outline.chain.links[0].curve];
        if (points > max_drawn_points)
            throw InputError({file, first.line, {}},
                             fmt::format("outlines that need more than {} points", max_drawn_points));
        RawOutline& raw = result.emplace_back();
        raw.points = std::move(sampled.points);
        raw.title = first.layer;
        raw.samples_of_curve = sampled.has_curves;
        raw.notes.push_back(
            fmt::format("line {}: outline of {}", first.line, core::counted(outline.chain.links.size(), "curve")));
    }
    return result;
}

}  // namespace

std::vector<RawOutline> outlines_of_drawing(const Drawing& drawing, const std::string& file, bool keep_open,
                                            std::vector<std::string>& notes) {
    std::exception_ptr first_error;  // of the plane that most likely holds the outlines
    for (const DrawnPlane& plane : planes_of(drawing, file)) {
        std::vector<std::string> own_notes = notes_on(plane, drawing);
        try {
            std::vector<RawOutline> outlines = outlines_of_plane(curves_in(plane, drawing), file, keep_open, own_notes);
            notes.insert(notes.end(), own_notes.begin(), own_notes.end());
            return outlines;
        } catch (const InputError&) {
            if (!first_error) first_error = std::current_exception();
        }
    }
    std::rethrow_exception(first_error);
}

}  // namespace lamina::geometry
