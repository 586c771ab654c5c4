// Wherever memory runs out, the library throws, leaves no file behind, and never returns another result.
#include <filesystem>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/threads.hpp>

#include "support/failing_new.hpp"
#include "support/point_sets.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina::test {
namespace {

/// Lets the first, second, ... allocation of work() fail, with growing strides, until there are no more. Expects an
/// exception for lack of memory or a typed error each time, or the result of a run in which nothing fails. Streams turn
/// a lack of memory into an error of the file.
void expect_exceptions(const std::function<std::string()>& work, const std::function<void()>& after_failure = {}) {
    const std::string expected = work();
    int runs = 0;
    for (long n = 1;; n += 1 + n / 12, ++runs) {
        FailingNew failing(n);
        std::string result;
        try {
            result = work();
        } catch (const std::bad_alloc&) {
            failing.disarm();
            if (after_failure) after_failure();
            continue;
        } catch (const Error& error) {
            // The child process that tries CGNS files counts for itself.
            const std::string reason = error.what();
            const bool in_child = reason.find("std::bad_alloc") != std::string::npos ||
                                  reason.find("the CGNS library breaks off") != std::string::npos;
            ASSERT_TRUE(failing.disarm() || in_child) << reason;
            if (after_failure) after_failure();
            continue;
        }
        EXPECT_EQ(result, expected) << "allocation " << n;
        if (!failing.disarm()) break;
    }
    // The thread sanitizer serves allocations of the standard library itself.
    EXPECT_GT(runs, 3);
}

std::string text_of(const std::vector<Triangle>& triangles) {
    std::string text;
    for (const Triangle& triangle : triangles)
        for (const VertexId vertex : triangle.v) text += std::to_string(vertex.index()) + ' ';
    return text;
}

TEST(OutOfMemory, Pipeline) {
    const TemporaryFolder folder;
    const std::string file =
        folder.write("a.dat", "section\n1 0\n0.5 0.06\n0.1 0.04\n0 0\n0.1 -0.04\n0.5 -0.06\n1 0\n");
    CaseOptions options;
    options.far_field.size = 2;
    for (const unsigned threads : {1u, 3u}) {
        options.threads = threads;
        expect_exceptions([&] { return mesh_hash(generate_mesh(std::vector<std::string>{file}, options).mesh); });
    }
}

TEST(OutOfMemory, Triangulation) {
    const auto points = random_points(300, 1);
    for (const unsigned threads : {1u, 3u})
        expect_exceptions([&] {
            std::string text;
            with_threads(threads, [&] {
                text = text_of(triangulate(points).triangles) +
                       text_of(triangulate(points, {.leaf_vertices = 100}).triangles);
            });
            return text;
        });
}

TEST(OutOfMemory, Refinement) {
    const Border square = square_border(1, 0.1);
    expect_exceptions([&] {
        const auto triangulation = triangulate(square.points, square.segments);
        return text_of(refine(square.points, triangulation, SizeField(0.02)).triangles);
    });
}

TEST(OutOfMemory, Files) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus();
    for (const MeshFormat& format : mesh_formats()) {
        SCOPED_TRACE(format.name);
        const auto file = folder / ("m" + format.extensions.front());
        const auto work = [&] {
            write_mesh(mesh, file, {.format = format.name});
            const std::string hash = format.readable ? mesh_hash(read_mesh(file, {.format = format.name})) : "";
            std::filesystem::remove_all(file);
            return hash;
        };
        const auto clean = [&] {
            for (const std::string& name : folder.names()) EXPECT_FALSE(name.starts_with(".")) << name;
        };
        expect_exceptions(work, clean);
    }
}

}  // namespace
}  // namespace lamina::test
