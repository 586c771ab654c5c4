// The kinds of outlines: how the vertices that rays start from were chosen.
#pragma once

#include <lamina/geometry.hpp>

namespace lamina::layers {

/// How the vertices of an outline were chosen.
enum class OutlineKind {
    given,   ///< those of the input, of which nothing is known
    smooth,  ///< smooth but at few corners (Element::smooth)
    jagged,  ///< resampled between many corners, as iced ones are
};

/// Returns the kind of an element's outline.
inline OutlineKind outline_kind(const Element& element) {
    if (element.smooth) return OutlineKind::smooth;
    return element.resampled ? OutlineKind::jagged : OutlineKind::given;
}

}  // namespace lamina::layers
