#include "geometry/source_point.hpp"

#include <fmt/format.h>

namespace lamina::geometry {

std::string coordinates(Point p) { return fmt::format("({}, {})", p.x + 0.0, p.y + 0.0); }

}  // namespace lamina::geometry
