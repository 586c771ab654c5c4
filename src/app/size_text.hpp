// The words for wakes and size sources: "10:2:0.01", "box:0,-1,3,1,0.05".
#pragma once

#include <string>

#include <lamina/pipeline.hpp>

namespace lamina::app {

/// "ANGLE[:LENGTH[:SIZE]]". Throws UsageError with the bare reason.
WakeOptions parse_wake(const std::string& text);
std::string wake_text(const WakeOptions& wake);

/// "box:X0,Y0,X1,Y1,H", "circle:X,Y,R,H" or "line:X0,Y0,X1,Y1,H". Throws UsageError with the bare reason.
SizeSource parse_size_source(const std::string& text);
std::string size_source_text(const SizeSource& source);

}  // namespace lamina::app
