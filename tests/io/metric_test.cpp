// Files of metrics: what is read back, and what is refused.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/metric.hpp>

#include "support/temporary_folder.hpp"

namespace lamina::test {
namespace {

class MetricFiles : public testing::Test {
protected:
    std::filesystem::path vtu(const std::string& components, const std::string& values,
                              const std::string& name = "M") const {
        return folder_.write(
            "m.vtu",
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"2\" "
            "NumberOfCells=\"0\"><PointData><DataArray type=\"Float64\" Name=\"p\" format=\"ascii\">1 2"
            "</DataArray><DataArray type=\"Float64\" Name=\"" +
                name + "\" NumberOfComponents=\"" + components + "\" format=\"ascii\">" + values +
                "</DataArray></PointData></Piece></UnstructuredGrid></VTKFile>");
    }
    TemporaryFolder folder_;
};

TEST_F(MetricFiles, AreReadBackExactly) {
    const std::vector<MetricTensor> metric{{1.0 / 3, -1e-300, 1e17}, {1e-17, 0.1, 2}, {4, 0, 9}};
    write_metric(metric, folder_ / "m.sol");
    EXPECT_EQ(read_metric(folder_ / "m.sol"), metric);
}

TEST_F(MetricFiles, OfMeditHoldSizesOrTensorsOfTwoOrThreeDimensions) {
    const std::string head = "MeshVersionFormatted 2\n# by hand\nDimension\n3\n\nSolAtVertices\n2\n1 ";
    EXPECT_EQ(read_metric(folder_.write("a.sol", head + "1\n0.5 0.25\nEnd\n")),
              (std::vector<MetricTensor>{{4, 0, 4}, {16, 0, 16}}));
    EXPECT_EQ(read_metric(folder_.write("b.sol", head + "3\n1 2 5 0 0 1\n3 1 4 0 0 1\nEnd\n")),
              (std::vector<MetricTensor>{{1, 2, 5}, {3, 1, 4}}));
}

TEST_F(MetricFiles, OfVtkHoldTensorsInEachOfTheirForms) {
    const std::vector<MetricTensor> metric{{5, 1, 7}, {6, 2, 8}};
    EXPECT_EQ(read_metric(vtu("3", "5 1 7 6 2 8", "metric")), metric);
    EXPECT_EQ(read_metric(vtu("4", "5 1 1 7 6 2 2 8")), metric);
    EXPECT_EQ(read_metric(vtu("6", "5 7 0 1 0 0 6 8 0 2 0 0")), metric);
    EXPECT_EQ(read_metric(vtu("9", "5 1 0 1 7 0 0 0 0 6 2 0 2 8 0 0 0 0")), metric);
}

TEST_F(MetricFiles, ThatAreNoneAreRefused) {
    const std::string head = "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n";
    EXPECT_THROW(read_metric(folder_.write("a.sol", "")), InputError);
    EXPECT_THROW(read_metric(folder_.write("b.sol", "MeshVersionFormatted 2\nDimension 2\nEnd\n")), InputError);
    EXPECT_THROW(read_metric(folder_.write("c.sol", head + "2\n1 2\n1 2 3 4\nEnd\n")), InputError);
    EXPECT_THROW(read_metric(folder_.write("d.sol", head + "2\n1 3\n1 0 1 1 x 1\n")), InputError);
    EXPECT_THROW(read_metric(folder_.write("e.sol", head + "999999999999\n1 3\n1 0 1\n")), InputError);
    EXPECT_THROW(read_metric(vtu("2", "1 2 3 4", "metric")), InputError);
    EXPECT_THROW(read_metric(vtu("3", "1 0 0 2 0 0")), InputError) << "a vector";
    EXPECT_THROW(read_metric(folder_.write("m.txt", "")), UsageError);
    EXPECT_THROW(write_metric({}, folder_ / "m.txt"), UsageError);
    EXPECT_THROW(write_metric({}, folder_ / "m.vtu"), UsageError);
    EXPECT_THROW(read_metric(folder_ / "none.sol"), IoError);
}

}  // namespace
}  // namespace lamina::test
