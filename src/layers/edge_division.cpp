// One edge divided by equal shares of the integral of ds / target, and the lengths of its parts.
#include "layers/edge_division.hpp"

#include <algorithm>
#include <cmath>

namespace lamina::layers {

namespace {

/// Edges are divided for the sake of the ratio into at most this many times the parts that the target needs.
constexpr std::size_t max_refinement = 6;

}  // namespace

EdgeDivision::EdgeDivision(double length, std::vector<TargetInterval> target, double whole_up_to)
    : length_(length), target_(std::move(target)) {
    scale_targets(1, 1);
    excess_ = total_;
    const bool whole = total_ <= std::max(whole_up_to, target_slack);
    min_parts_ = whole ? 1 : static_cast<std::size_t>(std::ceil(total_ / target_slack));
    parts_ = min_parts_;
}

bool EdgeDivision::extensible() const { return parts_ < max_refinement * min_parts_; }

void EdgeDivision::scale_targets(double first, double last) {
    double length = 0, done = 0;
    for (const TargetInterval& i : target_) length += i.length;
    scaled_ = target_;
    total_ = 0;
    for (TargetInterval& i : scaled_) {
        i.target *= first + (last - first) * ((done + 0.5 * i.length) / length);
        done += i.length;
        total_ += i.length / i.target;
    }
}

std::vector<double> EdgeDivision::division_points() const {
    std::vector<double> points;
    double distance = 0, sum = 0;  // along the edge, and of length / target, up to the current interval
    std::size_t k = 1;
    for (const auto& [length, target] : scaled_) {
        const double share = length / target;
        while (k < parts_) {
            const double wanted = total_ * static_cast<double>(k) / static_cast<double>(parts_);
            if (wanted > sum + share) break;
            points.push_back(distance + (wanted - sum) * target);
            ++k;
        }
        sum += share;
        distance += length;
    }
    return points;
}

EdgeDivision::EndParts EdgeDivision::end_parts() const {
    if (parts_ == 1) return {length_, length_};
    const double part = total_ / static_cast<double>(parts_);
    const auto advance = [part](auto begin, auto end) {
        double distance = 0, sum = 0;
        for (auto it = begin; it != end; ++it) {
            const double share = it->length / it->target;
            if (sum + share >= part) return distance + (part - sum) * it->target;
            sum += share;
            distance += it->length;
        }
        return distance;
    };
    return {advance(scaled_.begin(), scaled_.end()), advance(scaled_.rbegin(), scaled_.rend())};
}

double EdgeDivision::max_ratio() const {
    double ratio = 1, from = 0, before = 0;
    std::vector<double> ends = division_points();
    ends.push_back(length_);
    for (double to : ends) {
        const double part = to - from;
        if (before > 0) ratio = std::max({ratio, part / before, before / part});
        before = part;
        from = to;
    }
    return ratio;
}

}  // namespace lamina::layers
