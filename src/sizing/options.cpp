// The table of the options of the size field.
#include <lamina/sizing.hpp>

#include "core/option_rows.hpp"
#include "sizing/shapes.hpp"
#include "sizing/wake.hpp"

namespace lamina {

template <>
OptionTable<SizingOptions> option_rows() {
    OptionTableBuilder<SizingOptions> table("Outer region");
    table.number("gradation", "G", "growth of the edge length per unit of distance", numbers_above_up_to(0, 1),
                 member_at(&SizingOptions::gradation));
    table.length("wall-size", "H",
                 "largest edge length at the outer border of the layer; else the edges of the border decide",
                 positive_numbers, member_at(&SizingOptions::wall_size));
    table.length("far-size", "H", "largest edge length; else unbounded", positive_numbers,
                 member_at(&SizingOptions::far_size));
    table.specs(
        "wake", "ANGLE[:LENGTH[:SIZE]]",
        "small triangles along a line from each trailing edge: ANGLE in degrees to the x axis, or auto for that "
        "of the flow (alpha); LENGTH of the line (2 chords); SIZE at the trailing edge (else the size there "
        "without a wake); may be given several times",
        sizing::parse_wake, sizing::wake_text, member_at(&SizingOptions::wakes));
    table.specs("refine", "SHAPE",
                "edge length H in and round a shape, " + sizing::source_forms() +
                    ", in units of the input; may be given several times",
                sizing::parse_size_source, sizing::size_source_text, member_at(&SizingOptions::sources));
    return table.take();
}
template LAMINA_EXPORT const OptionTable<SizingOptions>& option_table();

void validate(const SizingOptions& options) { require_in_range(option_table<SizingOptions>(), options); }

}  // namespace lamina
