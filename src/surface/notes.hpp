// Notes for the user about the points of an element (Element::surface_notes).
#pragma once

#include <lamina/geometry.hpp>

namespace lamina::surface {

/// Adds a note where the points zigzag about the curve they were read from. Precondition: the corners are known.
void add_noise_note(Element& element);

/// Adds a note on each point that stands off the curve of its neighbours. Where there are many, they belong to the
/// shape of the body, and no note is added.
void add_misplaced_point_notes(Element& element);

}  // namespace lamina::surface
