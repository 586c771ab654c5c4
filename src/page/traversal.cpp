#include "page/traversal.hpp"

#include <utility>

#include "mesh/adjacency.hpp"

namespace lamina::page {

namespace {

constexpr std::size_t no_gate = static_cast<std::size_t>(-1);

/// An edge s -> t with a stored cell on its left.
struct Gate {
    std::uint32_t s, t;  ///< new numbers
    std::uint32_t o;     ///< the vertex of the stored cell that predicts the one across: s + t - o
    std::uint32_t cell;  ///< the stored cell, by its new number
    std::uint32_t edge;  ///< the directed edge of the stored cell; no_edge for a diagonal
    std::size_t previous = no_gate, next = no_gate;
    bool open = true;  ///< whether it waits in the queue
};

/// Walks over a mesh.
class Walk {
public:
    explicit Walk(const Mesh& mesh) : edges_(mesh), adjacency_(mesh::find_adjacency(mesh)), stored_(edges_.cells()) {
        found_.new_number.assign(mesh.points.size(), no_vertex);
        found_.cell.reserve(edges_.cells());
        found_.parent.reserve(edges_.cells());
    }

    Traversal run() {
        for (std::size_t cell = 0; cell < edges_.cells(); ++cell) {
            if (stored_[cell]) continue;
            begin_at(cell);
            for (; head_ < gates_.size(); ++head_)
                if (gates_[head_].open) pass(head_);
        }
        return std::move(found_);
    }

private:
    void store(std::size_t cell, std::uint32_t parent) {
        stored_[cell] = true;
        found_.cell.push_back(static_cast<std::uint32_t>(cell));
        found_.parent.push_back(parent);
    }

    std::uint32_t add_vertex(VertexId v, const Prediction& prediction) {
        const auto number = static_cast<std::uint32_t>(found_.vertex.size());
        found_.new_number[v.index()] = number;
        found_.vertex.push_back(v.value);
        found_.prediction.push_back(prediction);
        return number;
    }

    std::uint32_t back_reference(std::uint32_t number) const {
        return static_cast<std::uint32_t>(found_.vertex.size()) - number;
    }

    /// Stores a cell that no gate leads to.
    void begin_at(std::size_t cell) {
        const bool quad = edges_.corners(cell) == 4;
        found_.symbols.push_back(quad ? quad_mark : 0);
        std::array<std::uint32_t, 4> v{};
        for (std::size_t i = 0; i < edges_.corners(cell); ++i) {
            const VertexId corner = edges_.corner(cell, i);
            v[i] = found_.new_number[corner.index()];
            found_.references.push_back(v[i] == no_vertex ? 0 : back_reference(v[i]));
            if (v[i] != no_vertex) continue;
            const std::uint32_t near = i > 0 ? v[i - 1] : static_cast<std::uint32_t>(found_.vertex.size()) - 1;
            v[i] = add_vertex(corner, {near, near, near});
        }
        store(cell, no_vertex);
        const auto number = static_cast<std::uint32_t>(found_.cell.size() - 1);
        const auto first = static_cast<std::uint32_t>(edges_.first(cell));
        const std::size_t corners = edges_.corners(cell), gate = gates_.size();
        for (std::size_t i = 0; i < corners; ++i)
            gates_.push_back({v[i], v[(i + 1) % corners], v[(i + 2) % corners], number,
                              first + static_cast<std::uint32_t>(i), gate + (i + corners - 1) % corners,
                              gate + (i + 1) % corners});
    }

    void link(std::size_t gate, std::size_t next) {
        gates_[gate].next = next;
        gates_[next].previous = gate;
    }

    std::size_t add_gate(std::uint32_t s, std::uint32_t t, std::uint32_t o, std::uint32_t edge) {
        gates_.push_back({s, t, o, static_cast<std::uint32_t>(found_.cell.size() - 1), edge});
        return gates_.size() - 1;
    }

    /// The two gates that take the place of one; no_gate where there is none.
    struct NewGates {
        std::size_t first, second;
    };

    /// Puts a triangle on a gate. Its further edges, s -> c and c -> t, are these edges of the mesh.
    NewGates attach(std::size_t gate, VertexId corner, std::uint32_t edge_sc, std::uint32_t edge_ct,
                    std::uint8_t mark) {
        gates_[gate].open = false;
        const auto [s, t, o] = Prediction{gates_[gate].s, gates_[gate].t, gates_[gate].o};
        const std::size_t previous = gates_[gate].previous, next = gates_[gate].next;
        const bool closes_before = is_twin(edge_sc, previous);
        const bool closes_behind = is_twin(edge_ct, next);
        std::uint32_t c = found_.new_number[corner.index()];
        Symbol symbol = fresh;
        if (closes_before || closes_behind) {
            symbol = closes_before && closes_behind ? closing : closes_before ? before : behind;
        } else if (c == no_vertex) {
            c = add_vertex(corner, {s, t, o});
        } else {
            symbol = distant;
            found_.references.push_back(back_reference(c));
        }
        found_.symbols.push_back(static_cast<std::uint8_t>(symbol + mark));

        NewGates gates{no_gate, no_gate};
        std::size_t left = previous, right = next;
        if (closes_before) {
            gates_[previous].open = false;
            left = gates_[previous].previous;
        } else {
            gates.first = add_gate(s, c, t, edge_sc);
        }
        if (closes_behind) {
            gates_[next].open = false;
            right = gates_[next].next;
        } else {
            gates.second = add_gate(c, t, s, edge_ct);
        }
        std::size_t last = left;
        for (const std::size_t added : {gates.first, gates.second}) {
            if (added == no_gate) continue;
            link(last, added);
            last = added;
        }
        link(last, right);
        return gates;
    }

    /// Returns whether the edge of a cell is that of the stored cell at a gate, seen from the other side.
    bool is_twin(std::uint32_t edge, std::size_t gate) const {
        return edge != mesh::no_edge && gates_[gate].open && gates_[gate].edge != mesh::no_edge &&
               adjacency_.twin[edge] == gates_[gate].edge;
    }

    /// Stores the cell across a gate, if there is one that is not stored yet.
    void pass(std::size_t gate) {
        const std::uint32_t twin = adjacency_.twin[gates_[gate].edge];
        if (twin == mesh::no_edge || stored_[edges_.cell_of(twin)]) {
            gates_[gate].open = false;
            found_.symbols.push_back(no_cell);
            return;
        }
        const std::size_t cell = edges_.cell_of(twin), corners = edges_.corners(cell), first = edges_.first(cell);
        const std::size_t turn = twin - first;
        const auto edge = [&](std::size_t i) { return static_cast<std::uint32_t>(first + (turn + i) % corners); };
        store(cell, gates_[gate].cell);
        const VertexId c = edges_.origin(edge(2));
        if (corners == 3) {
            attach(gate, c, edge(1), edge(2), 0);
            return;
        }
        // In a layer of quadrilaterals, the one across lies straight on.
        const std::uint32_t s = gates_[gate].s;
        const NewGates half = attach(gate, c, edge(1), mesh::no_edge, quad_mark);
        const NewGates other = attach(half.second, edges_.origin(edge(3)), edge(2), edge(3), 0);
        const std::uint32_t d = found_.new_number[edges_.origin(edge(3)).index()];
        if (half.first != no_gate) gates_[half.first].o = d;
        if (other.second != no_gate) gates_[other.second].o = s;
    }

    mesh::CellEdges edges_;
    mesh::Adjacency adjacency_;
    std::vector<bool> stored_;
    std::vector<Gate> gates_;
    std::size_t head_ = 0;
    Traversal found_;
};

}  // namespace

Traversal traverse(const Mesh& mesh) { return Walk(mesh).run(); }

}  // namespace lamina::page
