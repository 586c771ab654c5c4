// What stands for pictures in builds without Cairo, as those of Python wheels are.
#include <lamina/error.hpp>
#include <lamina/plot.hpp>

namespace lamina {

namespace {

[[noreturn]] void refuse_picture() {
    throw UsageError(
        "this build of lamina draws no pictures: it was made without Cairo; lamina view writes a page to zoom into, "
        "and Mesh.plot() of Python draws with matplotlib");
}

}  // namespace

void check_picture_format(const std::filesystem::path&, const std::string&) { refuse_picture(); }
void plot_mesh(const Mesh&, const std::filesystem::path&, const PlotOptions&) { refuse_picture(); }
void plot_mesh(const Mesh&, const CurvedNodes&, const std::filesystem::path&, const PlotOptions&) { refuse_picture(); }
void plot_field(const Mesh&, const PlotField&, const std::filesystem::path&, const PlotOptions&) { refuse_picture(); }
void plot_chart(std::span<const ChartCurve>, const std::filesystem::path&, const ChartOptions&) { refuse_picture(); }

}  // namespace lamina
