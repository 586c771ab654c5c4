#include "decoupling/lines.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include <lamina/error.hpp>

#include "decoupling/separators.hpp"

namespace lamina::decoupling {

struct Lines::Group {
    std::array<Line, group_size> lines;
};

Lines::Chunk::~Chunk() {
    for (const auto& group : groups) delete group.load();
}

Lines::Lines(std::span<const Point> points)
    : given_(points), chunks_(std::make_unique<std::unique_ptr<Chunk>[]>(max_chunks)), vertices_(points.size()) {}

Lines::Lines(Lines&& other) noexcept
    : given_(other.given_),
      junctions_(std::move(other.junctions_)),
      chunks_(std::move(other.chunks_)),
      size_(other.size_.load()),
      rows_(std::move(other.rows_)),
      row_ends_(std::move(other.row_ends_)),
      first_in_rows_(other.first_in_rows_),
      lines_in_rows_(other.lines_in_rows_),
      vertices_(other.vertices_),
      gathered_(std::move(other.gathered_)),
      gathered_vertices_(other.gathered_vertices_),
      gathered_room_(other.gathered_room_),
      gathered_lines_(other.gathered_lines_) {}

Lines& Lines::operator=(Lines&& other) noexcept {
    given_ = other.given_;
    junctions_ = std::move(other.junctions_);
    chunks_ = std::move(other.chunks_);
    size_ = other.size_.load();
    rows_ = std::move(other.rows_);
    row_ends_ = std::move(other.row_ends_);
    first_in_rows_ = other.first_in_rows_;
    lines_in_rows_ = other.lines_in_rows_;
    vertices_ = other.vertices_;
    gathered_ = std::move(other.gathered_);
    gathered_vertices_ = other.gathered_vertices_;
    gathered_room_ = other.gathered_room_;
    gathered_lines_ = other.gathered_lines_;
    return *this;
}

Lines::~Lines() = default;

Lines::Line& Lines::at(std::uint32_t line) const {
    Group* group = chunk(line).groups[line % chunk_size / group_size].load(std::memory_order_acquire);
    if (group == nullptr) group = make_group(line);
    return group->lines[line % group_size];
}

Lines::Group* Lines::make_group(std::uint32_t line) const {
    auto made = std::make_unique<Group>();
    draw_rows(line, *made);
    // Another thread may have made it meanwhile.
    Group* expected = nullptr;
    if (!chunk(line).groups[line % chunk_size / group_size].compare_exchange_strong(expected, made.get()))
        return expected;
    return made.release();
}

void Lines::draw_rows(std::uint32_t line, Group& group) const {
    const std::uint32_t begin = line - line % group_size;
    for (std::uint32_t number = begin; number < begin + group_size; ++number) {
        if (!is_in_row(number)) continue;
        const auto row =
            static_cast<std::size_t>(std::upper_bound(row_ends_.begin(), row_ends_.end(), number) - row_ends_.begin());
        const std::uint32_t in_row = number - (row_ends_[row] - rows_[row].count);
        Line& drawn = group.lines[number - begin];
        drawn.from = {rows_[row].from(in_row)};
        drawn.to = {rows_[row].to(in_row)};
        drawn.min_segments = rows_[row].min_segments;
    }
}

std::uint32_t Lines::add(std::size_t lines) {
    const std::size_t first = size_;
    if (first + lines > chunk_size * max_chunks) throw MeshError("the domain would be cut along too many lines");
    for (std::size_t chunk = (first + chunk_size - 1) / chunk_size; chunk * chunk_size < first + lines; ++chunk)
        chunks_[chunk] = std::make_unique<Chunk>();
    size_.store(first + lines, std::memory_order_release);
    return static_cast<std::uint32_t>(first);
}

std::size_t Lines::end_of(std::uint32_t line) const {
    return first_inside(line).index() + (is_loop(line) ? at(line).own : segments(line) - 1);
}

VertexId Lines::add_junction(Point p) {
    assert(vertices_ == junctions());
    junctions_.push_back(p);
    return VertexId{vertices_++};
}

std::uint32_t Lines::add_loop(std::span<const VertexId> loop) {
    const std::uint32_t number = add(1);
    number_segments(number, loop.size());
    Line& line = at(number);
    line.loop.assign(loop.begin(), loop.end());
    line.loop.push_back(loop.front());
    for (const VertexId v : line.loop) line.interior.push_back(point(LineVertex{v}));
    std::call_once(line.divided, [] {});
    return number;
}

std::uint32_t Lines::add_new_loop(std::vector<Point> loop) {
    const std::uint32_t number = add(1);
    number_segments(number, loop.size());
    Line& line = at(number);
    for (std::size_t i = 0; i < loop.size(); ++i) line.loop.push_back(VertexId{vertices_ + i});
    line.loop.push_back(line.loop.front());
    vertices_ += loop.size();
    line.own = static_cast<std::uint32_t>(loop.size());
    loop.push_back(loop.front());
    line.interior = std::move(loop);
    std::call_once(line.divided, [] {});
    return number;
}

std::uint32_t Lines::add_row(const LineRow& row) {
    assert(rows_.empty() || size() == row_ends_.back());
    const std::uint32_t first = add(row.count);
    if (rows_.empty()) first_in_rows_ = first;
    lines_in_rows_ += row.count;
    rows_.push_back(row);
    row_ends_.push_back(first + row.count);
    // Loops before them may have made the group of the first ones.
    if (Group* group = chunk(first).groups[first % chunk_size / group_size]) draw_rows(first, *group);
    return first;
}

std::uint32_t Lines::add_line(const LineVertex& from, const LineVertex& to, std::uint32_t min_segments) {
    const std::uint32_t number = add(1);
    Line& line = at(number);
    line.from = from;
    line.to = to;
    line.min_segments = min_segments;
    return number;
}

void Lines::number_segments(std::uint32_t line, std::size_t segments) {
    chunk(line).first[line % chunk_size] = VertexId{vertices_};
    chunk(line).segments[line % chunk_size] = static_cast<std::uint32_t>(segments);
}

void Lines::number(std::uint32_t line, std::size_t interior) {
    assert(line < size() && !is_loop(line) && segments(line) == 0);
    number_segments(line, interior + 1);
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
    if (place == segments(number)) return line.to;
    return {VertexId{first_inside(number).index() + place - 1}, number, place};
}

VertexId Lines::id(std::uint32_t line, std::uint32_t place) const { return vertex(line, place).id; }

bool Lines::runs_along(std::uint32_t number, Segment edge) const {
    const Line& line = at(number);
    if (!line.loop.empty())
        return edge.b.index() ==
               first_inside(number).index() + (edge.a.index() + 1 - first_inside(number).index()) % line.own;
    return edge.a == line.from.id ? edge.b == id(number, 1)
                                  : edge.b == line.to.id || edge.b.index() == edge.a.index() + 1;
}

Point Lines::point(std::uint32_t number, std::uint32_t place) const {
    const Line& line = at(number);
    if (!line.loop.empty()) return line.interior[place];
    if (place == 0) return point(line.from);
    if (place == segments(number)) return point(line.to);
    return line.interior[place - 1];
}

std::size_t Lines::divide(std::uint32_t number, const SizeField& size_field) {
    Line& line = at(number);
    std::call_once(line.divided, [&] {
        for (const LineVertex& end : {line.from, line.to})
            if (end.line != LineVertex::no_line) divide(end.line, size_field);
        std::vector<Point> interior = divide_separator(point(line.from), point(line.to), size_field, line.min_segments);
        // Whoever has numbered its vertices has divided it in the same way.
        const std::uint32_t told = segments(number);
        if (told != 0 && interior.size() + 1 != told)
            throw MeshError(
                "processes divide a line between subdomains in different ways: all must run the same program "
                "on the same kind of machine");
        line.interior = std::move(interior);
        if (told != 0 && end_of(number) <= gathered_vertices_) store(number, gathered_points());
    });
    return line.interior.size();
}

void Lines::divide_between(VertexId begin, VertexId end, const SizeField& size_field) {
    // The first line that ends behind `begin`.
    std::size_t low = 0, high = size();
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (end_of(static_cast<std::uint32_t>(middle)) <= begin.index())
            low = middle + 1;
        else
            high = middle;
    }
    for (auto i = static_cast<std::uint32_t>(low); i < size() && first_inside(i) < end; ++i)
        if (!is_loop(i)) divide(i, size_field);
}

void Lines::store(std::uint32_t number, std::span<Point> points) const {
    const Line& line = at(number);
    const std::size_t first = first_inside(number).index();
    // A loop repeats its first vertex.
    const std::size_t n = line.loop.empty() ? line.interior.size() : segments(number);
    for (std::size_t i = 0; i < n; ++i) points[line.loop.empty() ? first + i : line.loop[i].index()] = line.interior[i];
}

void Lines::store_from(std::uint32_t line, std::span<Point> points) const {
    for (; line < size(); ++line) {
        const Group* group = chunk(line).groups[line % chunk_size / group_size].load(std::memory_order_acquire);
        if (group == nullptr)
            line += group_size - 1 - line % group_size;
        else if (!group->lines[line % group_size].interior.empty())
            store(line, points);
    }
}

void Lines::copy_points(std::span<Point> points) const {
    std::copy(given_.begin(), given_.end(), points.begin());
    std::copy(junctions_.begin(), junctions_.end(), points.begin() + static_cast<std::ptrdiff_t>(given_.size()));
    store_from(0, points);
}

void Lines::gather_points() {
    if (vertices_ > gathered_room_) {
        // Cuts seldom add more than this.
        gathered_room_ = vertices_ + vertices_ / 2;
        gathered_ = core::ScratchMemory(gathered_room_ * sizeof(Point), false);
        gathered_vertices_ = vertices_;
        copy_points(gathered_points());
    } else {
        gathered_vertices_ = vertices_;
        store_from(static_cast<std::uint32_t>(gathered_lines_), gathered_points());
    }
    gathered_lines_ = size();
}

}  // namespace lamina::decoupling
