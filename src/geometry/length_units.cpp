#include "geometry/length_units.hpp"

#include <algorithm>
#include <array>

#include "core/text.hpp"

namespace lamina::geometry {

namespace {

struct WrittenUnit {
    std::string_view written;
    LengthUnitName unit;
};

constexpr LengthUnitName micrometre{"um", 1e-6}, millimetre{"mm", 1e-3}, centimetre{"cm", 1e-2}, metre{"m", 1},
    inch{"in", 0.0254}, feet{"ft", 0.3048};

constexpr std::array<WrittenUnit, 14> units = {{{"um", micrometre},
                                                {"\xC2\xB5m", micrometre},  // the micro sign
                                                {"\xCE\xBCm", micrometre},  // the letter mu
                                                {"mm", millimetre},
                                                {"millimeter", millimetre},
                                                {"cm", centimetre},
                                                {"m", metre},
                                                {"meter", metre},
                                                {"in", inch},
                                                {"inch", inch},
                                                {"inches", inch},
                                                {"ft", feet},
                                                {"foot", feet},
                                                {"feet", feet}}};

}  // namespace

std::optional<LengthUnitName> length_unit(std::string_view text) {
    const std::string lower = core::lower_case(std::string(text));
    const auto found = std::find_if(units.begin(), units.end(), [&](const auto& u) { return u.written == lower; });
    return found == units.end() ? std::nullopt : std::optional(found->unit);
}

}  // namespace lamina::geometry
