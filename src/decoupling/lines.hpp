// The lines along which subdomains meet. Their vertices have successive ids, so that a line and how many vertices it
// has tell all ids on it; where they lie is found out by who needs it.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "core/scratch_memory.hpp"

namespace lamina::decoupling {

/// A vertex, given by a line and its place on it: 0 is the begin of the line. Those that are on no line, as junctions
/// of lines are, have `no_line`.
struct LineVertex {
    static constexpr std::uint32_t no_line = std::numeric_limits<std::uint32_t>::max();

    VertexId id;
    std::uint32_t line = no_line, place = 0;
};

/// A part of a line from one place to another, in either direction.
struct Stretch {
    std::uint32_t line = 0, first = 0, last = 0;

    /// Returns the number of its segments.
    std::uint32_t segments() const { return first < last ? last - first : first - last; }
    /// Returns the place that is so many segments behind the first one.
    std::uint32_t place(std::uint32_t i) const { return first < last ? first + i : first - i; }
    friend bool operator==(const Stretch&, const Stretch&) = default;
};

/// Straight lines between junctions that follow from the numbers of the lines: line i of the row leads from junction
/// first_from + i from_step to junction first_to + ((i + to_shift) mod count) to_step. Nobody holds these ends.
struct LineRow {
    std::uint32_t count = 0;
    std::uint32_t first_from = 0, from_step = 1;
    std::uint32_t first_to = 0, to_step = 1, to_shift = 0;
    std::uint32_t min_segments = 1;

    VertexId from(std::uint32_t i) const { return VertexId{std::size_t{first_from} + std::size_t{i} * from_step}; }
    VertexId to(std::uint32_t i) const {
        return VertexId{std::size_t{first_to} + std::size_t{(i + to_shift) % count} * to_step};
    }
};

/// All lines, in the order in which their vertices are numbered. One thread adds lines; others may meanwhile look at
/// those that were there before, and divide them.
class LAMINA_EXPORT Lines {
public:
    /// The vertices that exist before all lines. They must outlive the use of this object, but for that of gathered().
    explicit Lines(std::span<const Point> points);
    Lines(Lines&&) noexcept;
    Lines& operator=(Lines&&) noexcept;
    ~Lines();

    /// Makes room for so many more vertices on no line.
    void expect_junctions(std::size_t more) { junctions_.reserve(junctions_.size() + more); }
    /// Adds a vertex on no line. Precondition: no vertices of lines are numbered yet.
    VertexId add_junction(Point p);
    /// Adds a closed line along vertices that exist. Returns its number.
    std::uint32_t add_loop(std::span<const VertexId> loop);
    /// Adds a closed line along new vertices, and numbers them.
    std::uint32_t add_new_loop(std::vector<Point> loop);
    /// Adds straight lines between junctions, whose vertices are not numbered yet. Returns the number of the first one.
    /// Rows follow one another: nothing else is added between them.
    std::uint32_t add_row(const LineRow& row);
    /// Adds a straight line whose vertices are not numbered yet.
    std::uint32_t add_line(const LineVertex& from, const LineVertex& to, std::uint32_t min_segments);
    /// Numbers the vertices inside the last line that has none, of which there are so many.
    void number(std::uint32_t line, std::size_t interior);
    /// Says where the vertices inside a line lie, whoever has divided it.
    void set_interior(std::uint32_t line, std::vector<Point> interior);

    /// Returns the number of lines, and of all vertices.
    std::size_t size() const { return size_.load(std::memory_order_acquire); }
    std::size_t vertices() const { return vertices_; }
    std::uint32_t segments(std::uint32_t line) const { return chunk(line).segments[line % chunk_size]; }
    /// Returns all rows; whether a line is in one of them; the first line that is, and how many are.
    std::span<const LineRow> rows() const { return rows_; }
    bool is_in_row(std::uint32_t line) const { return line - first_in_rows_ < lines_in_rows_; }
    std::uint32_t first_in_rows() const { return first_in_rows_; }
    std::uint32_t lines_in_rows() const { return lines_in_rows_; }
    /// Returns both ends of a line that is no loop.
    std::pair<LineVertex, LineVertex> ends(std::uint32_t line) const { return {at(line).from, at(line).to}; }
    LineVertex vertex(std::uint32_t line, std::uint32_t place) const;
    VertexId id(std::uint32_t line, std::uint32_t place) const;
    /// Returns the id of the first vertex that was added with a line, if there is one.
    VertexId first_inside(std::uint32_t line) const { return chunk(line).first[line % chunk_size]; }
    bool is_loop(std::uint32_t line) const { return !is_in_row(line) && !at(line).loop.empty(); }
    /// Returns whether an edge between two successive vertices has the direction of the line. Precondition: the
    /// vertices were added with the line, or the line is no loop.
    bool runs_along(std::uint32_t line, Segment edge) const;
    /// Returns the number of vertices that were added with a line: they have successive ids.
    std::size_t own_vertices(std::uint32_t line) const { return end_of(line) - first_inside(line).index(); }
    /// Returns the number of vertices on no line, which have the lowest ids.
    std::size_t junctions() const { return given_.size() + junctions_.size(); }

    /// Divides a line, unless that was done. Returns the number of vertices inside it. Any thread may call it. Throws
    /// MeshError where it has another number of vertices than number() was told.
    std::size_t divide(std::uint32_t line, const SizeField& size_field);
    /// Returns whether the places of the vertices of a line are known. Precondition: no other thread divides lines.
    bool is_divided(std::uint32_t line) const { return !at(line).interior.empty(); }
    /// Divides the lines that have vertices from `begin` to before `end` inside.
    void divide_between(VertexId begin, VertexId end, const SizeField& size_field);
    /// Returns where a vertex lies. Precondition: its line is divided.
    Point point(std::uint32_t line, std::uint32_t place) const;
    Point point(const LineVertex& v) const {
        if (v.line != LineVertex::no_line) return point(v.line, v.place);
        return v.id.index() < given_.size() ? given_[v.id.index()] : junctions_[v.id.index() - given_.size()];
    }

    /// Copies the vertices of all lines that are divided, and those on no line, to their ids.
    void copy_points(std::span<Point> points) const;
    /// Makes one array of all vertices that are numbered, by their ids. Those of lines that are not divided yet have no
    /// place in it until divide() gives them one. Call it again for those that are numbered later: ids stay, and so
    /// does the array where it has room for them.
    void gather_points();
    std::span<const Point> gathered() const {
        return {reinterpret_cast<const Point*>(gathered_.data()), gathered_vertices_};
    }
    /// Sets the place of a vertex that another process has told.
    void set_gathered(VertexId v, Point p) { gathered_points()[v.index()] = p; }

private:
    struct Line {
        LineVertex from, to;
        std::uint32_t min_segments = 1;
        std::uint32_t own = 0;  ///< of a loop: the number of vertices that were added with it
        std::once_flag divided;
        std::vector<Point> interior;  ///< of a loop: all its vertices, the first one at the end again
        std::vector<VertexId> loop;
    };
    /// Lines that never move, so that one thread can add some while others look at them. Of most lines a process needs
    /// the numbers of vertices alone: others have room once somebody asks for one of their group.
    static constexpr std::size_t group_size = 32, chunk_size = 4096, max_chunks = 4096;
    struct Group;
    struct Chunk {
        Chunk() = default;
        ~Chunk();
        std::array<VertexId, chunk_size> first;
        std::array<std::uint32_t, chunk_size> segments{};
        std::array<std::atomic<Group*>, chunk_size / group_size> groups{};
    };

    Chunk& chunk(std::uint32_t line) const { return *chunks_[line / chunk_size]; }
    /// Returns the id behind those of the vertices of a line that were added with it.
    std::size_t end_of(std::uint32_t line) const;
    Line& at(std::uint32_t line) const;
    Group* make_group(std::uint32_t line) const;
    /// Puts the ends of those lines of a group that are in rows. The group has this line.
    void draw_rows(std::uint32_t line, Group& group) const;
    void number_segments(std::uint32_t line, std::size_t segments);
    std::uint32_t add(std::size_t lines);
    /// Stores the vertices of all lines from this one on that are divided.
    void store_from(std::uint32_t line, std::span<Point> points) const;
    void store(std::uint32_t number, std::span<Point> points) const;

    std::span<const Point> given_;
    std::vector<Point> junctions_;
    std::unique_ptr<std::unique_ptr<Chunk>[]> chunks_;
    std::atomic<std::size_t> size_ = 0;
    std::vector<LineRow> rows_;
    std::vector<std::uint32_t> row_ends_;  ///< per row: the number behind that of its last line
    std::uint32_t first_in_rows_ = 0, lines_in_rows_ = 0;
    std::size_t vertices_ = 0;
    /// Each process has places for some lines alone: memory is taken for these, page by page.
    core::ScratchMemory gathered_;
    std::size_t gathered_vertices_ = 0, gathered_room_ = 0, gathered_lines_ = 0;

    std::span<Point> gathered_points() { return {reinterpret_cast<Point*>(gathered_.data()), gathered_vertices_}; }
};

}  // namespace lamina::decoupling
