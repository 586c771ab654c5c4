// The words for wakes, size sources and outlines: "10:2:0.01", "box:0,-1,3,1,0.05", "-9,-9,9,-9,0,9".
#pragma once

#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

namespace lamina::app {

/// "ANGLE[:LENGTH[:SIZE]]". Throws UsageError with the bare reason.
WakeOptions parse_wake(const std::string& text);
std::string wake_text(const WakeOptions& wake);

/// "box:X0,Y0,X1,Y1,H", "circle:X,Y,R,H" or "line:X0,Y0,X1,Y1,H". Throws UsageError with the bare reason.
SizeSource parse_size_source(const std::string& text);
std::string size_source_text(const SizeSource& source);

/// "X0,Y0,X1,Y1,...": three corners or more. Throws UsageError with the bare reason.
std::vector<Point> parse_outline(const std::string& text);
std::string outline_text(const std::vector<Point>& corners);

}  // namespace lamina::app
