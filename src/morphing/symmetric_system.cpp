// Source: I. S. Duff, J. K. Reid, The multifrontal solution of indefinite sparse symmetric linear equations, ACM Trans.
// Math. Softw. 9 (1983), for definite ones: each supernode assembles a dense front from its entries and from what is
// left of its children's.
#include "morphing/symmetric_system.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <memory>
#include <utility>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "core/text.hpp"
#include "morphing/front.hpp"
#include "morphing/supernodes.hpp"

namespace lamina::morphing {

/// A subtree of supernodes that one thread works on.
struct Subtree {
    std::size_t begin, root;              ///< its first and its last supernode
    std::size_t first_beyond;             ///< the places of the rows beyond it begin here
    std::vector<std::uint32_t> beyond{};  ///< these rows
};

/// Where the entries of a factor are, and what may be done at the same time.
struct EliminationPlan {
    Supernodes nodes;
    std::vector<Subtree> subtrees;
    std::vector<std::size_t> top;  ///< the supernodes that are in none, each after its children
    std::size_t places;            ///< of columns, and of rows beyond subtrees

    std::size_t rows(std::size_t s) const { return nodes.columns(s) + nodes.rows_below(s).size(); }
};

namespace {

/// Subtrees are independent pieces of work, which threads take, where each makes a smaller share of it than this one.
constexpr double share_of_subtree = 1. / 64;

/// Returns the matrix, and takes the memory of the entries back.
Matrix matrix_of(std::size_t n, std::vector<Entry> entries) {
    struct Triplet {
        const Entry* entry;
        const Triplet* operator->() const { return this; }
        const Triplet& operator*() const { return *this; }
        int row() const { return static_cast<int>(entry->row); }
        int col() const { return static_cast<int>(entry->column); }
        double value() const { return entry->value; }
        Triplet& operator++() { return ++entry, *this; }
        bool operator!=(const Triplet& other) const { return entry != other.entry; }
    };
    assert(std::all_of(entries.begin(), entries.end(), [&](const Entry& e) { return e.column <= e.row && e.row < n; }));
    Matrix matrix(static_cast<int>(n), static_cast<int>(n));
    matrix.setFromTriplets(Triplet{entries.data()}, Triplet{entries.data() + entries.size()});
    return matrix;
}

/// Returns the products that each supernode and all before it in its subtree take.
std::vector<double> work_of_subtrees(const Supernodes& nodes) {
    std::vector<double> work(nodes.size(), 0);
    for (std::size_t s = 0; s < nodes.size(); ++s) {
        const auto columns = static_cast<double>(nodes.columns(s));
        const double rows = columns + static_cast<double>(nodes.rows_below(s).size());
        work[s] += columns * rows * rows;
        if (nodes.parent[s] != no_supernode) work[nodes.parent[s]] += work[s];
    }
    return work;
}

EliminationPlan divide(Supernodes nodes) {
    EliminationPlan plan{std::move(nodes), {}, {}, 0};
    const std::vector<std::uint32_t>& parent = plan.nodes.parent;
    const std::vector<double> work = work_of_subtrees(plan.nodes);
    double all = 0;
    for (std::size_t s = 0; s < work.size(); ++s)
        if (parent[s] == no_supernode) all += work[s];
    plan.places = plan.nodes.place.size();
    for (std::size_t s = 0, begin = 0; s < work.size(); ++s) {
        if (work[s] > share_of_subtree * all) {
            plan.top.push_back(s);
            begin = s + 1;
        } else if (parent[s] == no_supernode || work[parent[s]] > share_of_subtree * all) {
            plan.subtrees.push_back({begin, s, plan.places});
            plan.places += plan.nodes.rows_below(s).size();
            begin = s + 1;
        }
    }
    // Few supernodes are in no subtree, and thus few subtrees have rows beyond them: on meshes fewer than the columns.
    assert(plan.places < no_supernode);
    return plan;
}

/// Makes the panels of the supernodes, each after its children.
class Factorisation {
public:
    Factorisation(const Matrix& lower, const EliminationPlan& plan)
        : lower_(lower), plan_(plan), panels_(plan.nodes.size()), left_(plan.nodes.size()) {
        children_.resize(plan.nodes.size());
        for (std::size_t s = 0; s < plan.nodes.size(); ++s)
            if (plan.nodes.parent[s] != no_supernode) children_[plan.nodes.parent[s]].push_back(s);
    }

    std::vector<std::vector<double>> run() {
        core::parallel_for(plan_.subtrees.size(), 1, [&](std::size_t t, std::size_t) {
            for (std::size_t s = plan_.subtrees[t].begin; s <= plan_.subtrees[t].root; ++s) make(s);
        });
        for (const std::size_t s : plan_.top) make(s);
        return std::move(panels_);
    }

private:
    const Matrix& lower_;
    const EliminationPlan& plan_;
    std::vector<std::vector<double>> panels_, left_;  ///< left: for the rows below the panels, until the parent has it
    std::vector<std::vector<std::size_t>> children_;

    void make(std::size_t s) {
        const std::size_t rows = plan_.rows(s), columns = plan_.nodes.columns(s), below = rows - columns;
        panels_[s].assign(rows * columns, 0);
        left_[s].assign(below * below, 0);
        add_matrix(s);
        for (const std::size_t child : children_[s]) {
            add_child(s, child);
            left_[child] = {};
        }
        if (!factor_panel({panels_[s], rows, columns}, left_[s]))
            throw MeshError("cells of the mesh are too flat for a field to be found on it");
    }

    void add_matrix(std::size_t s) {
        const std::span<const std::uint32_t> below = plan_.nodes.rows_below(s);
        const std::uint32_t first = plan_.nodes.first[s], end = plan_.nodes.first[s + 1];
        double* column = panels_[s].data();
        for (std::uint32_t j = first; j < end; ++j, column += plan_.rows(s))
            for (Matrix::InnerIterator entry(lower_, static_cast<int>(j)); entry; ++entry) {
                const auto row = static_cast<std::uint32_t>(entry.row());
                const auto at = row < end
                                    ? row - first
                                    : std::lower_bound(below.begin(), below.end(), row) - below.begin() + (end - first);
                column[at] += entry.value();
            }
    }

    void add_child(std::size_t s, std::size_t child) {
        const std::vector<std::size_t> places = places_of_child(s, child);
        const std::size_t rows = plan_.rows(s), columns = plan_.nodes.columns(s);
        const double* from = left_[child].data();
        for (std::size_t j = 0; j < places.size(); ++j, from += places.size()) {
            double* const to = places[j] < columns ? panels_[s].data() + places[j] * rows
                                                   : left_[s].data() + (places[j] - columns) * (rows - columns);
            const std::size_t first_row = places[j] < columns ? 0 : columns;
            for (std::size_t i = j; i < places.size(); ++i) to[places[i] - first_row] += from[i];
        }
    }

    /// Returns the rows of the front that the rows below a child are.
    std::vector<std::size_t> places_of_child(std::size_t s, std::size_t child) const {
        const std::span<const std::uint32_t> below = plan_.nodes.rows_below(s);
        const std::size_t columns = plan_.nodes.columns(s);
        std::vector<std::size_t> places;
        std::size_t at = 0;
        for (const std::uint32_t row : plan_.nodes.rows_below(child)) {
            if (row < plan_.nodes.first[s + 1]) {
                places.push_back(row - plan_.nodes.first[s]);
                continue;
            }
            while (below[at] != row) ++at;
            places.push_back(columns + at);
        }
        return places;
    }
};

/// Gives the rows of supernodes in subtrees that are beyond the subtree places after all columns, for each subtree its
/// own, so that threads never write to the same place.
void separate_subtrees(EliminationPlan& plan) {
    Supernodes& nodes = plan.nodes;
    for (Subtree& subtree : plan.subtrees) {
        const std::span<const std::uint32_t> beyond = nodes.rows_below(subtree.root);
        subtree.beyond.assign(beyond.begin(), beyond.end());
        for (std::size_t k = nodes.first_below[subtree.begin]; k < nodes.first_below[subtree.root + 1]; ++k)
            if (nodes.below[k] >= nodes.first[subtree.root + 1]) {
                const auto at = std::lower_bound(subtree.beyond.begin(), subtree.beyond.end(), nodes.below[k]);
                nodes.below[k] = static_cast<std::uint32_t>(subtree.first_beyond) +
                                 static_cast<std::uint32_t>(at - subtree.beyond.begin());
            }
    }
}

void subtract_times(Row& from, double factor, const Row& row) {
    for (std::size_t k = 0; k < from.size(); ++k) from[k] -= factor * row[k];
}

}  // namespace

struct SymmetricSystem::Factors {
    explicit Factors(const Matrix& matrix) : plan_(divide(find_supernodes(matrix))) {
        panels_ = Factorisation(reordered(matrix, plan_.nodes.place), plan_).run();
        separate_subtrees(plan_);
    }

    std::size_t unknowns() const { return plan_.nodes.place.size(); }

    std::vector<Row> solve(std::span<const Row> right) const {
        std::vector<Row> x(plan_.places, Row{}), solution(right.size());
        for (std::size_t i = 0; i < right.size(); ++i) x[plan_.nodes.place[i]] = right[i];
        for_each_subtree([&](const Subtree& subtree, std::vector<Row>& rows) {
            for (std::size_t s = subtree.begin; s <= subtree.root; ++s) eliminate(s, x, rows);
        });
        for (const Subtree& subtree : plan_.subtrees)
            for (std::size_t i = 0; i < subtree.beyond.size(); ++i)
                subtract_times(x[subtree.beyond[i]], -1, x[subtree.first_beyond + i]);
        std::vector<Row> rows;
        for (const std::size_t s : plan_.top) eliminate(s, x, rows);
        for (std::size_t t = plan_.top.size(); t-- > 0;) substitute(plan_.top[t], x, rows);
        for_each_subtree([&](const Subtree& subtree, std::vector<Row>& rows_of_thread) {
            for (std::size_t i = 0; i < subtree.beyond.size(); ++i) x[subtree.first_beyond + i] = x[subtree.beyond[i]];
            for (std::size_t s = subtree.root + 1; s-- > subtree.begin;) substitute(s, x, rows_of_thread);
        });
        for (std::size_t i = 0; i < right.size(); ++i) solution[i] = x[plan_.nodes.place[i]];
        return solution;
    }

private:
    EliminationPlan plan_;
    std::vector<std::vector<double>> panels_;  ///< per supernode

    template <class F>
    void for_each_subtree(F&& f) const {
        core::parallel_for(plan_.subtrees.size(), 1, [&](std::size_t t, std::size_t) {
            std::vector<Row> rows;
            f(plan_.subtrees[t], rows);
        });
    }

    /// Copies the rows of a supernode, which are those of its panel.
    void gather(std::size_t s, const std::vector<Row>& x, std::vector<Row>& rows) const {
        const auto first = x.begin() + plan_.nodes.first[s];
        rows.assign(first, first + static_cast<std::ptrdiff_t>(plan_.nodes.columns(s)));
        for (const std::uint32_t row : plan_.nodes.rows_below(s)) rows.push_back(x[row]);
    }

    /// Solves L y = x for the columns of a supernode, and subtracts them from the rows below.
    void eliminate(std::size_t s, std::vector<Row>& x, std::vector<Row>& rows) const {
        gather(s, x, rows);
        const std::size_t columns = plan_.nodes.columns(s);
        const double* column = panels_[s].data();
        for (std::size_t j = 0; j < columns; ++j, column += rows.size())
            for (std::size_t i = j + 1; i < rows.size(); ++i) subtract_times(rows[i], column[i], rows[j]);
        const std::span<const std::uint32_t> below = plan_.nodes.rows_below(s);
        std::copy_n(rows.begin(), columns, x.begin() + plan_.nodes.first[s]);
        for (std::size_t i = 0; i < below.size(); ++i) x[below[i]] = rows[columns + i];
    }

    /// Solves D L' y = x for the columns of a supernode, where the rows below are solved.
    void substitute(std::size_t s, std::vector<Row>& x, std::vector<Row>& rows) const {
        gather(s, x, rows);
        const std::size_t columns = plan_.nodes.columns(s);
        for (std::size_t j = columns; j-- > 0;) {
            const double* const column = panels_[s].data() + j * rows.size();
            Row sum = rows[j];
            for (double& number : sum) number /= column[j];
            for (std::size_t i = j + 1; i < rows.size(); ++i) subtract_times(sum, column[i], rows[i]);
            rows[j] = sum;
        }
        std::copy_n(rows.begin(), columns, x.begin() + plan_.nodes.first[s]);
    }
};

SymmetricSystem::SymmetricSystem() = default;
SymmetricSystem::SymmetricSystem(SymmetricSystem&&) noexcept = default;
SymmetricSystem& SymmetricSystem::operator=(SymmetricSystem&&) noexcept = default;
SymmetricSystem::~SymmetricSystem() = default;

SymmetricSystem::SymmetricSystem(std::size_t n, std::vector<Entry> entries) {
    // Eigen numbers the entries of the matrix by 31 bits: on meshes seven of a row, half as many more for the order.
    constexpr std::size_t max_rows = std::size_t{1} << 27;
    if (n > max_rows)
        throw MeshError(core::concat("a mesh to morph has at most ", max_rows, " vertices beyond its rays, not ", n));
    if (n == 0) return;
    const Matrix matrix = matrix_of(n, std::move(entries));
    factors_ = std::make_unique<const Factors>(matrix);
}

std::vector<Row> SymmetricSystem::solve(std::span<const Row> right) const {
    assert(right.size() == (factors_ ? factors_->unknowns() : 0));
    return factors_ ? factors_->solve(right) : std::vector<Row>{};
}

}  // namespace lamina::morphing
