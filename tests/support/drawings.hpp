// Texts of drawings: DXF, SVG, IGES and STEP, made of curves that tests know.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace lamina::fixtures {

/// Returns a DXF drawing of entities, with what stands before them.
inline std::string dxf(const std::string& entities, const std::string& before = "") {
    return before + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

/// Returns an entity of DXF: its type and its groups, each "code value".
inline std::string entity(const std::string& type, const std::vector<std::string>& groups) {
    std::string text = "0\n" + type + "\n8\n0\n";
    for (const std::string& group : groups) {
        const std::size_t space = group.find(' ');
        text += group.substr(0, space) + "\n" + group.substr(space + 1) + "\n";
    }
    return text;
}

inline std::string svg(const std::string& shapes) {
    return "<?xml version=\"1.0\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\">\n" + shapes + "\n</svg>\n";
}

/// An entity of IGES: its type, its parameters behind the type, and the words of its directory that matter.
struct IgesEntity {
    int type;
    std::string parameters;
    int matrix = 0, form = 0;
    std::string status = "00000000";
};

/// Returns an IGES file of these entities, whose numbers in the directory are 1, 3, 5 and so on.
inline std::string iges(const std::vector<IgesEntity>& entities) {
    std::string start = fmt::format("{:<72}S{:>7}\n", "drawing", 1), directory, parameters;
    const std::string global = "1H,,1H;,7Hproduct,5Hfile;,3Hsys,3Hpre,32,38,6,308,15,,1.0,2,2HMM,1,";
    std::string text = fmt::format("{:<72}G{:>7}\n{:<72}G{:>7}\n", global, 1, "0.01,15H20200101.000000,0.001,1.0;", 2);
    std::size_t line = 1;
    for (std::size_t i = 0; i < entities.size(); ++i) {
        const IgesEntity& e = entities[i];
        const std::string record = fmt::format("{},{};", e.type, e.parameters);
        const std::size_t first = line;
        for (std::size_t at = 0; at < record.size(); at += 64)
            parameters += fmt::format("{:<64}{:>8}P{:>7}\n", record.substr(at, 64), 2 * i + 1, line++);
        directory += fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}D{:>7}\n", e.type, first, 0, 0, 0, 0,
                                 e.matrix, 0, e.status, 2 * i + 1);
        directory += fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}D{:>7}\n", e.type, 0, 0, line - first,
                                 e.form, "", "", "", 0, 2 * i + 2);
    }
    return start + text + directory + parameters + fmt::format("{:<72}T{:>7}\n", "S1G2", 1);
}

inline std::string step(const std::string& instances) {
    return "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n" + instances + "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// Drawings of the unit circle, whose coordinates begin with y = 0, x = 1, and of one half of it by an arc each where
/// the format can: all ways to draw it exactly.
inline std::vector<std::pair<std::string, std::string>> unit_circles() {
    const std::string half = "0.7071067811865476";
    std::vector<std::string> groups{"71 2", "70 4"};
    for (const char* knot : {"0", "0", "0", "1", "1", "2", "2", "3", "3", "4", "4", "4"})
        groups.push_back(std::string("40 ") + knot);
    const std::vector<std::pair<const char*, const char*>> square{{"1", "0"},  {"1", "1"},  {"0", "1"},
                                                                  {"-1", "1"}, {"-1", "0"}, {"-1", "-1"},
                                                                  {"0", "-1"}, {"1", "-1"}, {"1", "0"}};
    std::string weights, control, points_of_step, references;
    for (std::size_t i = 0; i < square.size(); ++i) {
        const std::string weight = i % 2 == 0 ? "1" : half;
        groups.push_back("41 " + weight);
        groups.push_back(std::string("10 ") + square[i].first);
        groups.push_back(std::string("20 ") + square[i].second);
        weights += weight + ",";
        control += fmt::format("{},{},0,", square[i].first, square[i].second);
        points_of_step +=
            fmt::format("#{}=CARTESIAN_POINT('',({}.,{}.,0.));\n", 10 + i, square[i].first, square[i].second);
        references += fmt::format("{}#{}", i == 0 ? "" : ",", 10 + i);
    }
    weights.pop_back();
    const std::string placement =
        "#1=CARTESIAN_POINT('',(0.,0.,0.));\n#2=DIRECTION('',(0.,0.,1.));\n#3=DIRECTION('',(1.,0.,0.));\n"
        "#4=AXIS2_PLACEMENT_3D('',#1,#2,#3);\n#5=CIRCLE('',#4,1.);\n";
    return {
        {"dxf circle", dxf(entity("CIRCLE", {"10 0", "20 0", "40 1"}))},
        {"dxf arcs", dxf(entity("ARC", {"10 0", "20 0", "40 1", "50 0", "51 180"}) +
                         entity("ARC", {"10 0", "20 0", "40 1", "50 180", "51 0"}))},
        {"dxf mirrored arcs",
         dxf(entity("ARC", {"10 0", "20 0", "40 1", "50 0", "51 180", "210 0", "220 0", "230 -1"}) +
             entity("ARC", {"10 0", "20 0", "40 1", "50 180", "51 360"}))},
        {"dxf bulges", dxf(entity("LWPOLYLINE", {"90 2", "70 1", "10 1", "20 0", "42 1", "10 -1", "20 0", "42 1"}))},
        {"dxf polyline", dxf(entity("POLYLINE", {"66 1", "70 1"}) + entity("VERTEX", {"10 1", "20 0", "42 1"}) +
                             entity("VERTEX", {"10 -1", "20 0", "42 1"}) + entity("SEQEND", {}))},
        {"dxf ellipse",
         dxf(entity("ELLIPSE", {"10 0", "20 0", "11 1", "21 0", "40 1", "41 0", "42 6.283185307179586"}))},
        {"dxf spline", dxf(entity("SPLINE", groups))},
        {"dxf insert", dxf(entity("INSERT", {"2 ROUND", "10 -1", "20 0", "41 0.5", "42 0.5", "50 90"}),
                           "0\nSECTION\n2\nBLOCKS\n" + entity("BLOCK", {"2 ROUND", "10 0", "20 2"}) +
                               entity("CIRCLE", {"10 0", "20 0", "40 2"}) + entity("ENDBLK", {}) + "0\nENDSEC\n")},
        {"svg circle", svg("<circle cx='0' cy='0' r='1'/>")},
        {"svg ellipse", svg("<g transform='scale(0.5)'><ellipse cx='3' cy='1' rx='2' ry='2' "
                            "transform=\"translate(-3,-1)\" /></g>")},
        {"svg arcs", svg("<path d='M1 0A1 1 0 0 0-1,0 1 1,0,10 1 0z'/>")},
        {"svg relative arcs", svg("<path d='m1-0a1 1 30 01-2 0a1,1 0 012,0'/>")},
        {"iges spline", iges({{126, "8,2,1,1,0,0,0,0,0,1,1,2,2,3,3,4,4,4," + weights + "," + control + "0,4,0,0,1"}})},
        {"iges arc", iges({{100, "0,0,0,1,0,1,0"}})},
        {"iges composite", iges({{102, "2,3,5", 7},
                                 {100, "0,0,0,2,0,-2,0", 0, 0, "00010000"},
                                 {100, "0,0,0,-2,0,2,0", 0, 0, "00010000"},
                                 {124, "0.5,0,0,0,0,0,1,0,0,0.5,0,0"}})},
        {"step circle", step(placement + "#6=CARTESIAN_POINT('',(1.,0.,0.));\n#7=VERTEX_POINT('',#6);\n"
                                         "#8=EDGE_CURVE('',#7,#7,#5,.T.);\n")},
        {"step halves", step(placement + "#6=CARTESIAN_POINT('',(1.,0.,0.));\n#7=VERTEX_POINT('',#6);\n"
                                         "#8=CARTESIAN_POINT('',(-1.,0.,0.));\n#9=VERTEX_POINT('',#8);\n"
                                         "#10=EDGE_CURVE('',#7,#9,#5,.T.);\n#11=EDGE_CURVE('',#7,#9,#5,.F.);\n")},
        {"step spline", step(points_of_step + "#30=(BOUNDED_CURVE()B_SPLINE_CURVE(2,(" + references +
                             "),.UNSPECIFIED.,.T.,.F.)\nB_SPLINE_CURVE_WITH_KNOTS((3,2,2,2,3),(0.,1.,2.,3.,4.),"
                             ".UNSPECIFIED.) CURVE() RATIONAL_B_SPLINE_CURVE((" +
                             weights +
                             "))"
                             "REPRESENTATION_ITEM(''));\n")},
    };
}

}  // namespace lamina::fixtures
