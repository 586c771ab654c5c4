// The table of the options of the stage "read".
#include <lamina/geometry.hpp>

#include "core/option_rows.hpp"
#include "core/text.hpp"
#include "geometry/sheets.hpp"

namespace lamina {

namespace {

constexpr OptionRange gaps = numbers_from_to(0, 0.2), distances = numbers_from_to(0, 1);
constexpr const char* open_te_key = "open_te";

TrailingEdgeGap parse_gap(const std::string& text) {
    const std::vector<double> numbers = core::parse_numbers(text, ':');
    core::require_text(numbers.size() <= 2, text, "it is GAP or GAP:DISTANCE");
    return numbers.size() > 1 ? TrailingEdgeGap{numbers[0], numbers[1]} : TrailingEdgeGap{numbers[0]};
}

std::string gap_text(const TrailingEdgeGap& gap) { return core::concat(gap.gap, ":", gap.distance); }

}  // namespace

template <>
OptionTable<GeometryOptions> option_rows() {
    OptionTableBuilder<GeometryOptions> table("Geometry");
    table.list(
        "names", OptionKind::words, "A,B,...",
        "marker names, one per element; else the stems of the files, or 'airfoil' for a single element; names that not "
        "every format takes are changed",
        member_at(&GeometryOptions::names));
    table.flag("close", "close outlines whose ends lie apart by a straight edge, however long it is", true,
               member_at(&GeometryOptions::close));
    table.flag("mirror-half",
               "complete symmetric sections of which the files hold one half, from nose to tail: the other half is its "
               "mirror image",
               true, member_at(&GeometryOptions::mirror_half));
    table.flag("union",
               "join bodies that overlap or touch, after all transformations: the outline is the outer border of their "
               "union, and each part of the wall keeps the marker of its body",
               true, member_at(&GeometryOptions::unite));
    table.choice(
        "sharpen-te",
        "make blunt trailing edges sharp: extend both sides straight, or blend them together; before transform",
        Choices<TailSharpening>{{"extend", TailSharpening::extend}, {"blend", TailSharpening::blend}},
        member_at(&GeometryOptions::sharpen_te));
    table
        .spec("open-te", "GAP[:DISTANCE]",
              "gap of all trailing edges, in chords of their elements: the sides move apart, which fades over DISTANCE "
              "chords as with XFOIL's TGAP; 1, the default: in proportion to the distance from the nose",
              parse_gap, gap_text, member_at(&GeometryOptions::open_te))
        .excludes = {"sharpen-te"};
    table.specs("transform", "ELEMENT:CHANGE",
                "change of an element, given by its name, or of all: scale:S[:X,Y], rotate:DEG[:X,Y] "
                "(counter-clockwise, about the origin or X,Y), shift:DX,DY, mirror[:Y] (in a horizontal line), "
                "flap:DEG:X,Y (a plain flap with its hinge at X,Y, downwards); may be given several times, in order",
                parse_transformation, transformation_text, member_at(&GeometryOptions::transformations));
    table.specs("sheet", "NAME:PLACE",
                "a body without thickness with the marker NAME, as a sail, a splitter plate or a Gurney strip: a wall "
                "with layers "
                "on both sides along the points of PLACE, X0,Y0,X1,Y1[,...] or a file of them, in units of the input; "
                "an end at a "
                "wall stands on that; may be given several times, without INPUT too",
                geometry::parse_sheet, geometry::sheet_text, member_at(&GeometryOptions::sheets));
    table
        .count("naca-points", "N",
               "surface points of naca: inputs that do not give their number; 0: as many as a wall needs",
               numbers_from_to(0, 1e7), member_at(&GeometryOptions::naca_points))
        .library_only = true;
    return table.take();
}
template LAMINA_EXPORT const OptionTable<GeometryOptions>& option_table();

void validate(const GeometryOptions& options) {
    require_in_range(option_table<GeometryOptions>(), options);
    if (options.open_te) {
        require_in_range(gaps, options.open_te->gap, open_te_key);
        require_in_range(distances, options.open_te->distance, open_te_key);
    }
    geometry::validate_sheets(options.sheets);
    if (options.open_te && options.sharpen_te) throw OptionError(open_te_key, "excludes sharpening (sharpen_te)");
    if (options.close && options.mirror_half)
        throw OptionError("mirror_half", "excludes closing the half by a straight edge (close)");
}

}  // namespace lamina
