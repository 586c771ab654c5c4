// Each refusal of bad input names the file, the line, the place and the reason.
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>

#include "support/geometry_fixtures.hpp"

namespace lamina {
namespace {

struct Refusal {
    std::string message, file;
    std::size_t line = 0;
    std::optional<Point> at;
    ExitCode code = ExitCode::done;
};

Refusal refusal_of(const std::string& content) {
    try {
        fixtures::read(content, "bad.dat");
    } catch (const InputError& e) {
        return {e.what(), e.place().file, e.place().line, e.place().at, e.exit_code()};
    }
    ADD_FAILURE() << "accepted: " << content;
    return {};
}

void expect_refusal(const std::string& content, std::size_t line, const std::string& reason,
                    std::optional<Point> at = {}) {
    SCOPED_TRACE(content.substr(0, 400));
    const Refusal r = refusal_of(content);
    EXPECT_EQ(r.code, ExitCode::bad_input);
    EXPECT_EQ(r.line, line);
    EXPECT_NE(r.message.find(reason), std::string::npos) << r.message;
    EXPECT_EQ(r.message.find('\n'), std::string::npos) << r.message;
    EXPECT_TRUE(r.file.ends_with("bad.dat")) << r.file;
    EXPECT_EQ(r.message.find(r.file), 0u);
    if (at) {
        ASSERT_TRUE(r.at.has_value());
        EXPECT_NEAR(r.at->x, at->x, 1e-12);
        EXPECT_NEAR(r.at->y, at->y, 1e-12);
    }
}

TEST(Refusal, NothingToRead) {
    expect_refusal("", 0, "the file is empty");
    expect_refusal("\n\n   \n", 0, "no coordinates");
    expect_refusal("Dear reader,\nthere are no coordinates here.\nSee page 12.\n", 0, "no coordinates");
    expect_refusal(std::string("ab\0cd", 5), 1, "not a text file");
    const std::vector<std::string> missing{"/no/such/file.dat"}, folder{"/tmp"};
    EXPECT_THROW(read_geometry(missing), IoError);
    EXPECT_THROW(read_geometry(folder), IoError);
    EXPECT_THROW(read_geometry({}), UsageError);
}

TEST(Refusal, FilesOfAnotherKindShowALine) {
    expect_refusal("NACA 0012\nx=1.0 y=0.0\nx=0.5 y=0.1\n", 2,
                   "no line starts with two numbers; this one is 'x=1.0 y=0.0'");
    expect_refusal("[\n[\n1.0,\n0.0\n],\n[\n0.5,\n0.1\n]]\n", 1, "JSON, of which lamina reads lists of points alone");
    expect_refusal("{\"x\": 1.0, \"y\": 0.0}\n{\"x\": 0.5, \"y\": 0.1}\n", 1, "JSON, of which lamina reads lists");
    expect_refusal("one\ntwo\n", 0, "no coordinates found: no line starts with two numbers");
}

TEST(Refusal, DamagedNumbersInBrackets) {
    expect_refusal("[[1.0, 0.0],\n [0.5, oops],\n [0, 0]]\n", 2, "'oops' is not a number");
    expect_refusal("[[1.0, 0.0],\n [nan, 0.1],\n [0, 0]]\n", 2, "'nan' is not a finite number");
    expect_refusal("[[1.0, 0.0],\n [0.5, 1.2.3],\n [0, 0]]\n", 2, "'1.2.3' is not a number");
    expect_refusal("x = [1, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1]\n", 1,
                   "10 numbers where x and y are expected");
}

TEST(Refusal, DamagedNumbers) {
    expect_refusal("t\n1 0\n0.5 nan\n0 0\n0.5 -0.1\n1 0\n", 3, "'nan' is not a finite number");
    expect_refusal("t\n1 0\n-inf 0.1\n0 0\n0.5 -0.1\n1 0\n", 3, "'-inf' is not a finite number");
    expect_refusal("nan 0.0\n0.5 0.1\n0 0\n0.5 -0.1\n", 1, "not a finite number");
    expect_refusal("t\n1 0\n0.5 0.1\n0 0\n0.5 -0.0ABC1\n1 0\n", 5, "'-0.0ABC1' is not a number");
    expect_refusal("t\n1 0\n32:0.5 0.1\n0 0\n0.5 -0.1\n1 0\n", 3, "'32:0.5' is not a number");
    expect_refusal("t\n1.O 0.0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n", 2, "'1.O' is not a number");
    expect_refusal("t\n1 0\n0.5 ******\n0 0\n0.5 -0.1\n1 0\n", 3, "'******' is not a number");
    expect_refusal("t\n1 0\n***** 0.1\n0 0\n0.5 -0.1\n1 0\n", 3, "'*****' is not a number");
    expect_refusal("t\n1 0\n0.5 0.1\n0\n0.5 -0.1\n1 0\n", 4, "one number where two are expected");
    expect_refusal("x,y\n1,0\n0.5,,0.1\n0,0\n0.5,-0.1\n", 3, "is not a number");
    expect_refusal("t\n1 0\n0.5 0.1->0.11\n0 0\n0.5 -0.1\n1 0\n", 3, "'0.1->0.11' is not a number");
    expect_refusal("t\n1 0\n0.5 1e999\n0 0\n0.5 -0.1\n", 3, "beyond the range of numbers");
}

TEST(Refusal, CoordinatesOutsideTheExactRange) {
    expect_refusal("t\n1 0\n0.5 1e61\n0 0\n0.5 -0.1\n", 3, "magnitude", Point{0.5, 1e61});
    expect_refusal("t\n1 1e-70\n0.5 1\n0 0\n0.5 -0.1\n", 2, "magnitude", Point{1, 0});
}

TEST(Refusal, Tables) {
    expect_refusal("t\n0 0 0\n0.5 0.1 0.2\n1 0 0\n", 3, "three columns that vary", Point{0.5, 0.1});
    expect_refusal("x,thickness,camber\n0,0,0\n.5,.1,.02\n.4,.1,.02\n1,0,0\n", 4, "x turns back here");
    expect_refusal("t\n1 0 2 3 4 5\n0 0 2 3 4 5\n1 1 1 1 1 1\n", 4, "6 columns that vary, where x and y are expected");
    expect_refusal("t\n1 2 3 4 5 6 7 8 9\n1 2 3 4 5 6 7 8 8\n", 2, "9 numbers where x and y are expected");
    // A constant third column is z unless a heading says that it is the lower surface.
    expect_refusal("t\n0 0 0\n0.2 0.06 0\n0.5 0.07 0\n1 0 0\n", 5, "the outline is open");
    expect_refusal("t\n1 0\n0.5 0.1 0\n0 0\n0.5 -0.1\n", 3, "3 numbers where line 2 has 2");
}

// Such columns may look like a table of both surfaces.
TEST(Refusal, ColumnsOfUnknownNames) {
    const std::string rows = "0,0,0\n.1,.08,.01\n.3,.1,.02\n.6,.08,.02\n.8,.04,.01\n1,0,0\n";
    expect_refusal("x,foo,bar\n" + rows, 1, "the header names 2 columns 'foo', 'bar', whose meaning is unknown");
    expect_refusal("pos,foo,bar\n" + rows, 1, "the header names 3 columns 'pos', 'foo', 'bar'");
    expect_refusal("# x,upper,bar\n" + rows, 1, "the header names a column 'bar'");
    expect_refusal("title\nchord camber thickness\n0 0 0\n.3 .02 .1\n.6 .02 .08\n1 0 0\n", 2,
                   "the header names a column 'chord'");
    expect_refusal("x [mm],thickness [%],camber [%]\n" + rows, 1, "the header names different units, mm and %");
    expect_refusal("x,t,c\n" + rows, 1, "the header names a column 'c'");  // thickness, and perhaps camber
    expect_refusal("x,cp\n1,0\n0.5,0.1\n0,0\n0.5,-0.1\n1,0\n", 1, "the header names a column 'cp'");
}

TEST(Refusal, TooFewPoints) {
    expect_refusal("t\n1 0\n0 0\n", 2, "only 2 distinct points");
    expect_refusal("t\n1 0\n", 2, "only 1 distinct point;");
    expect_refusal("1 0\n0 0\n1 0\n", 1, "only 2 distinct points");
    expect_refusal("t\n1 0\n1 0\n1 0\n", 2, "only 1 distinct point;");
}

TEST(Refusal, AllPointsOnALine) {
    expect_refusal("t\n0 0\n1 1\n2 2\n0.5 0.5\n0 0\n", 2, "all 4 points lie on one line");
    expect_refusal("t\n0 3\n7 3\n1 3\n", 2, "lie on one line");
}

TEST(Refusal, SelfCrossing) {
    // The edge (1, 0)-(0, 1) of lines 3 and 4 crosses the edge (0, 0)-(1, 1) between the ends, lines 2 and 5.
    expect_refusal("t\n0 0\n1 0\n0 1\n1 1\n0 0\n", 3,
                   "the outline crosses itself: the edge of lines 3 and 4 and the edge of lines 2 and 5",
                   Point{0.5, 0.5});
}

TEST(Refusal, SelfTouching) {
    expect_refusal("t\n0 0\n2 0\n2 1\n1 0.5\n2 2\n1 3\n1 0.5\n0 1\n0 0\n", 4, "touches itself", Point{1, 0.5});
    // The outline touches itself with a vertex on an edge.
    expect_refusal("t\n0 0\n2 0\n2 1\n1 0\n0 1\n0 0\n", 2, "touches itself", Point{1, 0});
}

TEST(Refusal, FoldsAndSpikes) {
    expect_refusal("t\n0 0\n1 0\n1 1\n1 3\n1 1\n0 1\n0 0\n", 5, "folds back on itself", Point{1, 3});
    expect_refusal("t\n1 0\n0.9 0\n0.5 0.1\n0 0\n0.5 -0.1\n0.9 0\n1 0\n", 2, "folds back on itself", Point{1, 0});
}

TEST(Refusal, HalfAnOutline) {
    expect_refusal("t\n0 0\n0.2 0.06\n0.5 0.07\n1 0\n", 5, "the outline is open", Point{1, 0});
    // A single surface follows a whole body.
    expect_refusal(fixtures::selig + "\n2 0\n2.5 0.1\n3 0\n", 12, "neither a closed outline nor one of two surfaces");
}

TEST(Refusal, CountsThatDoNotFit) {
    expect_refusal("t\n10 10\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n", 2, "the counts 10 + 10 announce 20 points, but 5");
    expect_refusal("t\n3 3\n\n0 0\n.5 .1\n1 0\n\n0 0\n.5 -.1\n1 0\n1.1 0\n", 11, "a point beyond the 6");
}

// Such a row is either, and only the user knows which.
TEST(Refusal, TitlesThatMayBeCounts) {
    expect_refusal("12 10\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n", 1, "put # before the line if it is a title");
    expect_refusal("2 2\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n", 6, "put # before that line if it is a title");
}

TEST(Refusal, PointsBehindTheEnd) {
    expect_refusal("t\n1 0\n0.5 0.1\n0 0\n0.5 -0.1\n1 0\n0.9 -0.2\n", 7,
                   "the outline is back at its start (1, 0) on line 6, but goes on to line 7", Point{0.9, -0.2});
}

TEST(Refusal, TextInUtf16) {
    expect_refusal(std::string("\xFF\xFE"
                               "1\0 \0"
                               "0\0",
                               8),
                   1, "UTF-16");
}

TEST(Refusal, SectionsThatAreNoConfiguration) {
    const test::TemporaryFolder folder;
    const auto message = [&](const std::string& other) -> std::string {
        const std::vector<std::string> inputs{folder.write("a1.dat", fixtures::selig).string(),
                                              folder.write("a2.dat", other).string()};
        try {
            read_geometry(inputs);
        } catch (const InputError& e) {
            return e.what();
        }
        return "accepted";
    };
    const std::string advice = "mesh each in a run of its own, as in: for f in *.dat; do lamina mesh";
    EXPECT_NE(message(fixtures::selig).find(advice), std::string::npos);
    EXPECT_NE(message("thin\n1 0.001\n0.5 0.02\n0.02 0.001\n0.5 -0.02\n1 0.001\n").find(advice), std::string::npos);
    // A flap that touches the main element belongs to it.
    const std::string flap = message("flap\n1.3 0\n1.1 0.1\n0.9 0\n1.1 -0.1\n1.3 0\n");
    EXPECT_NE(flap.find("crosses that of 'a2'"), std::string::npos) << flap;
    EXPECT_EQ(flap.find("run of its own"), std::string::npos) << flap;
}

TEST(Refusal, LonePoints) {
    expect_refusal(fixtures::selig + "\n5 5\n\n6 6\n\n7 7\n", 16, "belongs to no outline", Point{7, 7});
}

TEST(Refusal, ElementsThatMeet) {
    const test::TemporaryFolder folder;
    const std::string box = folder.write("box.dat", "b\n0 0\n4 0\n4 4\n0 4\n0 0\n").string();
    const auto message = [&](const std::string& other) -> std::string {
        const std::vector<std::string> inputs{box, folder.write("other.dat", other).string()};
        try {
            read_geometry(inputs);
        } catch (const InputError& e) {
            EXPECT_GT(e.place().line, 0u);
            EXPECT_TRUE(e.place().at.has_value());
            EXPECT_NE(std::string(e.what()).find("other"), std::string::npos) << e.what();
            return e.what();
        }
        return "accepted";
    };
    EXPECT_NE(message("o\n3 1\n6 1\n6 2\n3 2\n3 1\n").find("crosses that of 'other'"), std::string::npos);
    // The place is that of the point that touches, whichever file comes first.
    EXPECT_NE(message("o\n6 2\n4 1\n6 1\n6 2\n").find("other.dat:3: the outline touches that of 'box'"),
              std::string::npos);
    EXPECT_NE(message("o\n4 -1\n6 -1\n6 5\n4 5\n4 -1\n").find("box.dat:3: the outline touches that of 'other'"),
              std::string::npos);
    EXPECT_NE(message("o\n1 1\n2 1\n2 2\n1 1\n").find("'other' lies inside 'box'"), std::string::npos);
    EXPECT_NE(message("o\n-1 -1\n6 -1\n6 6\n-1 6\n-1 -1\n").find("'box' lies inside 'other'"), std::string::npos);
    EXPECT_EQ(message("o\n5 1\n6 1\n6 2\n5 1\n"), "accepted");
}

}  // namespace
}  // namespace lamina
