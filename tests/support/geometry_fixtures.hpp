// Airfoil files as strings, one per format or quirk. Each describes sections of about eight points.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <lamina/geometry.hpp>

#include "support/temporary_folder.hpp"

namespace lamina::fixtures {

/// A closed outline, counter-clockwise from the trailing edge. Line 2 holds the first point.
inline const std::string selig =
    "SAMPLE 12\n"
    "1.0 0.0\n0.75 0.04\n0.5 0.07\n0.2 0.06\n0.0 0.0\n0.2 -0.04\n0.5 -0.05\n0.75 -0.03\n1.0 0.0\n";

/// The outline of the file above.
inline const std::vector<Point> loop = {{1, 0}, {0.75, 0.04}, {0.5, 0.07},  {0.2, 0.06},
                                        {0, 0}, {0.2, -0.04}, {0.5, -0.05}, {0.75, -0.03}};

/// The rows of the file above, without its title.
inline const std::string loop_lines = selig.substr(selig.find('\n') + 1);

/// A wedge of few points.
inline const std::string wedge = "1 0\n0 0.3\n0 0\n0 -0.2\n1 0\n";

inline const std::string crlf =
    "SAMPLE 12\r\n1.0 0.0\r\n0.75 0.04\r\n0.5 0.07\r\n0.2 0.06\r\n0.0 0.0\r\n0.2 -0.04\r\n0.5 -0.05\r\n"
    "0.75 -0.03\r\n1.0 0.0";
inline const std::string old_mac = "SAMPLE\r1 0\r.75 .04\r.5 .07\r.2 .06\r0 0\r.2 -.04\r.5 -.05\r.75 -.03\r1 0\r";
inline const std::string no_title =
    "\t1\t0\n\t.75\t.04\n\t.5\t.07\n\t.2\t.06\n\t0.\t0.\n\t.2\t-.04\n\t.5\t-.05\n\t.75\t-.03\n\t1\t0\t\n";
inline const std::string fortran =
    "SAMPLE\n 1.0D+00 0.0D0\n 7.5d-1 +.4E-01\n .5 .07\n 2.D-1 6.D-2\n 0. -0.\n .2 -.04\n .5 -.05\n .75 -3D-2\n1. 0.\n";
inline const std::string csv =
    "x,y\n1,0\n0.75,0.04\n0.5, 0.07\n0.2 ,0.06\n0,0\n0.2,-0.04\n0.5,-0.05\n0.75,-0.03\n1,0,\n";
inline const std::string csv_semicolon =
    "\"x\";\"y\"\n1;0\n0.75;0.04\n0.5;0.07\n0.2;0.06\n0;0\n0.2;-0.04\n0.5;-0.05\n0.75;-0.03\n1;0\n";
inline const std::string decimal_comma =
    "SAMPLE\n1,0 0,0\n0,75 0,04\n0,5 0,07\n0,2 0,06\n0,0 0,0\n0,2 -0,04\n0,5 -0,05\n0,75 -0,03\n1 0\n";
inline const std::string lednicer =
    "SAMPLE 12\n 5. 5.\n\n0 0\n.2 .06\n.5 .07\n.75 .04\n1 0\n\n0 0\n.2 -.04\n.5 -.05\n.75 -.03\n1 0\n";
inline const std::string lednicer_one_run =
    "SAMPLE 12\n5 5\n0 0\n.2 .06\n.5 .07\n.75 .04\n1 0\n0 0\n.2 -.04\n.5 -.05\n.75 -.03\n1 0\n";
inline const std::string two_surfaces =
    "SAMPLE 12\n0 0\n.2 .06\n.5 .07\n.75 .04\n1 0\n\n0 0\n.2 -.04\n.5 -.05\n.75 -.03\n1 0\n";
inline const std::string two_surfaces_one_run =
    "SAMPLE 12\n0 0\n.2 .06\n.5 .07\n.75 .04\n1 0\n0 0\n.2 -.04\n.5 -.05\n.75 -.03\n1 0\n";
inline const std::string mses =
    "SAMPLE 12\n-2.0 3.0 -3.0 3.5\n1 0\n.75 .04\n.5 .07\n.2 .06\n0 0\n.2 -.04\n.5 -.05\n.75 -.03\n1 0\n";
inline const std::string digits_title = "23012 at 12 degrees\n" + selig.substr(selig.find('\n') + 1);
inline const std::string two_numbers_title = "63 212 modified\n" + selig.substr(selig.find('\n') + 1);
inline const std::string latin1_title = "G\xF6ttingen 417\xB0\n" + selig.substr(selig.find('\n') + 1);
inline const std::string comments =
    "# header\n# 1.0 2.0\nSAMPLE\n1 0 # tail\n.75 .04\n.5 .07\n.2 .06\n# nose\n0 0\n.2 -.04 ! lower\n.5 -.05\n"
    ".75 -.03\n1 0\n; end 5\n";
inline const std::string tagged =
    "<coords>\n1 0\n.75 .04\n.5 .07\n.2 .06\n0 0\n.2 -.04\n.5 -.05\n.75 -.03\n1 0\n</coords>\n<te>sharp</te>\n";
inline const std::string blank_inside =
    "SAMPLE\n\n1 0\n.75 .04\n.5 .07\n.2 .06\n0 0\n\n.2 -.04\n.5 -.05\n.75 -.03\n1 0\n\n\n";
inline const std::string double_spaced =
    "SAMPLE\n\n1 0\n\n.75 .04\n\n.5 .07\n\n.2 .06\n\n0 0\n\n.2 -.04\n\n.5 -.05\n\n.75 -.03\n\n1 0\n";
inline const std::string z_column =
    "SAMPLE\n1 0 0\n.75 .04 0\n.5 .07 0\n.2 .06 0\n0 0 0\n.2 -.04 0\n.5 -.05 0\n.75 -.03 0\n1 0 0\n";
inline const std::string clockwise = "SAMPLE\n1 0\n.75 -.03\n.5 -.05\n.2 -.04\n0 0\n.2 .06\n.5 .07\n.75 .04\n1 0\n";

// Numbers as programs print lists of points, and with signs that only look like those of ASCII.
inline const std::string python_list =
    "[[1.0, 0.0],\n [0.75, 0.04],\n [0.5, 0.07],\n [0.2, 0.06],\n [0.0, 0.0],\n [0.2, -0.04],\n [0.5, -0.05],\n"
    " [0.75, -0.03],\n [1.0, 0.0]]\n";
inline const std::string numpy_array =
    "array([[ 1.  ,  0.  ],\n       [ 0.75,  0.04],\n       [ 0.5 ,  0.07],\n       [ 0.2 ,  0.06],\n"
    "       [ 0.  ,  0.  ],\n       [ 0.2 , -0.04],\n       [ 0.5 , -0.05],\n       [ 0.75, -0.03]])\n";
inline const std::string one_line_list =
    "{\"name\": \"sample\", \"points\": [[1, 0], [0.75, 0.04], [0.5, 0.07], [0.2, 0.06], [0, 0], [0.2, -0.04], "
    "[0.5, -0.05], [0.75, -0.03], [1, 0]]}";
inline const std::string c_array =
    "double points[][2] = {\n{1.0, 0.0},\n{.75, .04},\n{.5, .07},\n{.2, .06},\n{0, 0}, // nose\n{.2, -.04},\n"
    "{.5, -.05},\n{.75, -.03}\n};\n";
inline const std::string matlab_matrix =
    "xy = [1.0 0.0;\n.75 .04;\n.5 .07; % upper\n.2 .06;\n0 0; .2 -.04; .5 -.05];\n[.75 -.03];\n";
inline const std::string numbers_in_brackets =
    "SAMPLE\n(1.0) (0.0)\n(.75) (.04)\n(.5) (.07)\n(.2) (.06)\n(0.0) (0.0)\n(.2) (-.04)\n(.5) (-.05)\n"
    "(.75) (-.03)\n";
inline const std::string foam_points =
    "9\n(\n(1 0 0)\n(.75 .04 0)\n(.5 .07 0)\n(.2 .06 0)\n(0 0 0)\n(.2 -.04 0)\n(.5 -.05 0)\n(.75 -.03 0)\n"
    "(1 0 0)\n)\n";
inline const std::string wide_spaces =
    "SAMPLE\n\xC2\xA0"
    "1.0\xC2\xA0"
    "0.0\n.75\xE2\x80\x83.04\n.5\xE2\x80\xAF.07\n.2\xE3\x80\x80.06\n0.0 0.0\xEF\xBB\xBF\n"
    ".2\xC2\xA0\xC2\xA0\xE2\x88\x92.04\n.5 \xE2\x80\x93.05\n.75 \xE2\x80\x91"
    "3e\xE2\x88\x92"
    "2\n1.0 0.0\n";
inline const std::string latin1_spaces =
    "SAMPLE\n1.0\xA0"
    "0.0\n.75\xA0.04\n.5\xA0.07\n.2\xA0.06\n0.0\xA0"
    "0.0\n.2\xA0\x96.04\n.5\xA0-.05\n.75\xA0-.03\n1.0\xA0"
    "0.0\n";

/// All files that hold the outline `loop`.
inline const std::vector<std::string> same_loop = {selig,
                                                   crlf,
                                                   old_mac,
                                                   no_title,
                                                   fortran,
                                                   csv,
                                                   csv_semicolon,
                                                   decimal_comma,
                                                   lednicer,
                                                   lednicer_one_run,
                                                   two_surfaces,
                                                   two_surfaces_one_run,
                                                   mses,
                                                   digits_title,
                                                   two_numbers_title,
                                                   latin1_title,
                                                   comments,
                                                   tagged,
                                                   blank_inside,
                                                   double_spaced,
                                                   z_column,
                                                   clockwise,
                                                   python_list,
                                                   numpy_array,
                                                   one_line_list,
                                                   c_array,
                                                   matlab_matrix,
                                                   numbers_in_brackets,
                                                   foam_points,
                                                   wide_spaces,
                                                   latin1_spaces};

inline const std::string second_body = "1.3 -0.1\n1.2 -0.05\n1.1 -0.04\n1.02 -0.06\n1.1 -0.09\n1.3 -0.1\n";
inline const std::string two_999 = selig + "999.0 999.0\n" + second_body;
inline const std::string two_blank = selig + "\n" + second_body;
inline const std::string two_labelled = selig + "Flap\n" + second_body;
inline const std::string two_lednicer = lednicer +
                                        "\nFlap\n 4 3\n1.02 -0.06\n1.1 -0.04\n1.2 -0.05\n1.3 -0.1\n\n"
                                        "1.02 -0.06\n1.1 -0.09\n1.3 -0.1\n";

/// An outline that is open at its blunt trailing edge.
inline const std::string open_base =
    "BLUNT\n1 0.01\n0.99 0.012\n.75 .04\n.5 .07\n.2 .06\n0 0\n.2 -.04\n.5 -.05\n.75 -.03\n0.99 -.011\n1 -0.01\n";

/// Returns a coordinate file with a title and these points.
inline std::string as_file(const std::vector<Point>& points) {
    std::string text = "title\n";
    for (const Point p : points) text += fmt::format("{} {}\n", p.x, p.y);
    return text;
}

/// Writes `content` to a temporary file of this name and reads it.
inline Geometry read(const std::string& content, const std::string& name = "sample.dat") {
    const test::TemporaryFolder folder;
    const std::vector<std::string> inputs{folder.write(name, content).string()};
    return read_geometry(inputs);
}

/// Returns whether one of the repairs of an element says so.
inline bool has_repair(const Element& e, const std::string& part) {
    return std::any_of(e.repairs.begin(), e.repairs.end(),
                       [&](const std::string& repair) { return repair.find(part) != std::string::npos; });
}

}  // namespace lamina::fixtures
