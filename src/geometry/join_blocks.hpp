// Blocks of coordinates that only blank lines and comments divide -> blocks that are whole runs.
#pragma once

#include "geometry/coordinate_blocks.hpp"

namespace lamina::geometry {

/// Joins blocks that comments divide, or blank lines where one stands after every point. A comment ends an outline only
/// where the outline is complete: where its end lies nearer to its start, or the ends of its two surfaces to each
/// other, than to the next point. A point of its own before an outline, as files of OpenFAST have it, stays a block.
void join_commented_blocks(CoordinateSection& section);

/// Joins blocks that blank lines divide where one continues the other: the step between them is at most twice as long
/// as a neighbouring step.
void join_continued_blocks(CoordinateSection& section);

}  // namespace lamina::geometry
