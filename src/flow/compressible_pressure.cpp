// Pressures of compressible flow by formulas.
#include <cmath>

#include <lamina/compressible_flow.hpp>

#include "core/reproducible_math.hpp"

namespace lamina {

double critical_pressure_coefficient(double mach) {
    const double ratio = (1 + 0.2 * mach * mach) / 1.2;
    return (core::pow_reproducible(ratio, 3.5) - 1) / (0.7 * mach * mach);
}

double compressed_pressure_coefficient(double incompressible, double mach) {
    const double b = std::sqrt(1 - mach * mach), divisor = b + mach * mach / (1 + b) * incompressible / 2;
    return divisor > 0 ? incompressible / divisor : -HUGE_VAL;
}

}  // namespace lamina
