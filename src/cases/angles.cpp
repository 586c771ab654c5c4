// The angles of attack on the way to a large one.
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cases/words.hpp"

namespace lamina::cases {

std::vector<double> angles_to(double alpha_deg, double largest_step) {
    // Near the largest lift the equations have two steady solutions, and a start from the free stream ends at the
    // separated one: with SU2 at 15 degrees and with OpenFOAM at 17 on NACA 0012, while at 12 neither does. Beyond 30
    // degrees no section has an attached flow that could be followed.
    constexpr double largest_from_free_stream = 12, largest_attached = 30, first = 10;
    const double size = std::abs(alpha_deg);
    std::vector<double> angles;
    if (size > largest_from_free_stream && size <= largest_attached) {
        // Equal steps, in whole tenths of a degree.
        const double steps = std::ceil((size - first) / largest_step);
        for (int i = 0; i < static_cast<int>(steps); ++i)
            angles.push_back(std::copysign(std::round(10 * (first + i * (size - first) / steps)) / 10, alpha_deg));
    }
    angles.push_back(alpha_deg);
    return angles;
}

std::string angles_of(const CaseFlow& flow, double largest_step) {
    // The flow that meets a row comes along its blades, however large its angle is.
    if (flow.row) return fmt::format("{}", flow.alpha_deg);
    return fmt::format("{}", fmt::join(angles_to(flow.alpha_deg, largest_step), " "));
}

}  // namespace lamina::cases
