#include "decoupling/lines.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include <lamina/error.hpp>

namespace lamina::decoupling {

/// Lines that never move, so that one thread can add some while others look at them.
struct Lines::Chunk {
    std::array<Line, chunk_size> lines;
};

Lines::Lines(std::span<const Point> points)
    : points_(points.begin(), points.end()),
      chunks_(std::make_unique<std::unique_ptr<Chunk>[]>(max_chunks)),
      vertices_(points.size()) {}

Lines::Lines(Lines&& other) noexcept
    : points_(std::move(other.points_)),
      chunks_(std::move(other.chunks_)),
      size_(other.size_.load()),
      vertices_(other.vertices_),
      gathered_(std::move(other.gathered_)),
      gathered_vertices_(other.gathered_vertices_) {}

Lines& Lines::operator=(Lines&& other) noexcept {
    points_ = std::move(other.points_);
    chunks_ = std::move(other.chunks_);
    size_ = other.size_.load();
    vertices_ = other.vertices_;
    gathered_ = std::move(other.gathered_);
    gathered_vertices_ = other.gathered_vertices_;
    return *this;
}

Lines::~Lines() = default;

Lines::Line& Lines::at(std::uint32_t line) const { return chunks_[line / chunk_size]->lines[line % chunk_size]; }

Lines::Line& Lines::add() {
    const std::size_t line = size_;
    if (line >= chunk_size * max_chunks) throw MeshError("the domain would be cut along too many lines");
    if (line % chunk_size == 0) chunks_[line / chunk_size] = std::make_unique<Chunk>();
    size_.store(line + 1, std::memory_order_release);
    return at(static_cast<std::uint32_t>(line));
}

std::size_t Lines::end_of(const Line& line) {
    return line.first.index() + (line.loop.empty() ? line.segments - 1 : line.own);
}

VertexId Lines::add_junction(Point p) {
    assert(vertices_ == points_.size());
    points_.push_back(p);
    return VertexId{vertices_++};
}

std::uint32_t Lines::add_loop(std::span<const VertexId> loop) {
    Line& line = add();
    line.segments = static_cast<std::uint32_t>(loop.size());
    line.first = VertexId{vertices_};
    line.loop.assign(loop.begin(), loop.end());
    line.loop.push_back(loop.front());
    for (const VertexId v : line.loop) line.interior.push_back(points_[v.index()]);
    std::call_once(line.divided, [] {});
    return static_cast<std::uint32_t>(size() - 1);
}

std::uint32_t Lines::add_new_loop(std::vector<Point> loop) {
    Line& line = add();
    line.segments = static_cast<std::uint32_t>(loop.size());
    line.first = VertexId{vertices_};
    for (std::size_t i = 0; i < loop.size(); ++i) line.loop.push_back(VertexId{vertices_ + i});
    line.loop.push_back(line.loop.front());
    vertices_ += loop.size();
    line.own = line.segments;
    loop.push_back(loop.front());
    line.interior = std::move(loop);
    std::call_once(line.divided, [] {});
    return static_cast<std::uint32_t>(size() - 1);
}

std::uint32_t Lines::add_line(const LineVertex& from, const LineVertex& to, std::uint32_t min_segments) {
    Line& line = add();
    line.from = from;
    line.to = to;
    line.min_segments = min_segments;
    return static_cast<std::uint32_t>(size() - 1);
}

void Lines::number(std::uint32_t number, std::size_t interior) {
    Line& line = at(number);
    line.first = VertexId{vertices_};
    line.segments = static_cast<std::uint32_t>(interior + 1);
    vertices_ += interior;
}

void Lines::set_interior(std::uint32_t number, std::vector<Point> interior) {
    Line& line = at(number);
    std::call_once(line.divided, [&] { line.interior = std::move(interior); });
}

LineVertex Lines::vertex(std::uint32_t number, std::uint32_t place) const {
    const Line& line = at(number);
    if (!line.loop.empty()) return {line.loop[place], number, place};
    if (place == 0) return line.from;
    if (place == line.segments) return line.to;
    return {VertexId{line.first.index() + place - 1}, number, place};
}

VertexId Lines::id(std::uint32_t line, std::uint32_t place) const { return vertex(line, place).id; }

bool Lines::runs_along(std::uint32_t number, Segment edge) const {
    const Line& line = at(number);
    if (!line.loop.empty())
        return edge.b.index() == line.first.index() + (edge.a.index() + 1 - line.first.index()) % line.own;
    return edge.a == line.from.id ? edge.b == id(number, 1)
                                  : edge.b == line.to.id || edge.b.index() == edge.a.index() + 1;
}

Point Lines::point(std::uint32_t number, std::uint32_t place) const {
    const Line& line = at(number);
    if (!line.loop.empty()) return line.interior[place];
    if (place == 0) return point(line.from);
    if (place == line.segments) return point(line.to);
    return line.interior[place - 1];
}

std::size_t Lines::divide(std::uint32_t number, const SeparatorSpacing& spacing) {
    Line& line = at(number);
    std::call_once(line.divided, [&] {
        for (const LineVertex& end : {line.from, line.to})
            if (end.line != LineVertex::no_line) divide(end.line, spacing);
        std::vector<Point> interior = divide_separator(point(line.from), point(line.to), spacing, line.min_segments);
        // Whoever has numbered its vertices has divided it in the same way.
        if (line.segments != 0 && interior.size() + 1 != line.segments)
            throw MeshError(
                "processes divide a line between subdomains in different ways: all must run the same program "
                "on the same kind of machine");
        line.interior = std::move(interior);
        if (line.segments != 0 && end_of(line) <= gathered_vertices_) store(line, gathered_points());
    });
    return line.interior.size();
}

void Lines::divide_between(VertexId begin, VertexId end, const SeparatorSpacing& spacing) {
    // The first line that ends behind `begin`.
    std::size_t low = 0, high = size();
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        const Line& line = at(static_cast<std::uint32_t>(middle));
        if (end_of(line) <= begin.index())
            low = middle + 1;
        else
            high = middle;
    }
    for (auto i = static_cast<std::uint32_t>(low); i < size() && at(i).first < end; ++i)
        if (!is_loop(i)) divide(i, spacing);
}

void Lines::store(const Line& line, std::span<Point> points) {
    // A loop repeats its first vertex.
    const std::size_t n = line.loop.empty() ? line.interior.size() : line.segments;
    for (std::size_t i = 0; i < n; ++i)
        points[line.loop.empty() ? line.first.index() + i : line.loop[i].index()] = line.interior[i];
}

void Lines::copy_points(std::span<Point> points) const {
    std::copy(points_.begin(), points_.end(), points.begin());
    for (std::uint32_t i = 0; i < size(); ++i)
        if (const Line& line = at(i); !line.interior.empty()) store(line, points);
}

void Lines::gather_points() {
    gathered_ = core::ScratchMemory(vertices_ * sizeof(Point), false);
    gathered_vertices_ = vertices_;
    copy_points(gathered_points());
}

}  // namespace lamina::decoupling
