// Source: P. R. Amestoy, T. A. Davis, I. S. Duff, An approximate minimum degree ordering algorithm, SIAM J. Matrix
// Anal. Appl. 17 (1996), as in Eigen. J. W. H. Liu, The role of elimination trees in sparse factorization, SIAM J.
// Matrix Anal. Appl. 11 (1990). C. Ashcraft, R. Grimes, The influence of relaxed supernode partitions on the
// multifrontal method, ACM Trans. Math. Softw. 15 (1989), for supernodes with entries that are zero.
#include "morphing/supernodes.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/OrderingMethods>

namespace lamina::morphing {

namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers minimum_degree_places(const Matrix& lower) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> inverse;  // of the places
    Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), inverse);
    Numbers place(static_cast<std::size_t>(lower.cols()));
    for (std::size_t i = 0; i < place.size(); ++i)
        place[static_cast<std::size_t>(inverse.indices()[static_cast<int>(i)])] = static_cast<std::uint32_t>(i);
    return place;
}

/// Returns the parents in the elimination tree: the first row below the diagonal that a column of the factor has an
/// entry in. Paths to the roots are shortened as they are walked.
Numbers elimination_tree(const Matrix& lower) {
    const Matrix upper = lower.transpose();
    const auto n = static_cast<std::uint32_t>(lower.cols());
    Numbers parent(n, no_supernode), ancestor(n, no_supernode);
    for (std::uint32_t column = 0; column < n; ++column)
        for (Matrix::InnerIterator entry(upper, static_cast<int>(column)); entry; ++entry) {
            auto at = static_cast<std::uint32_t>(entry.row());
            while (at < column) {
                const std::uint32_t next = std::exchange(ancestor[at], column);
                if (next == no_supernode) parent[at] = column;
                at = std::min(next, column);
            }
        }
    return parent;
}

/// Returns the place of each column where all of a subtree come right before its root, in their order.
Numbers postorder(const Numbers& parent) {
    const std::size_t n = parent.size();
    Numbers size(n, 1), place(n), next(n, 0);
    for (std::size_t i = 0; i < n; ++i)
        if (parent[i] != no_supernode) size[parent[i]] += size[i];
    // Parents have higher numbers than children. From the end, each subtree gets the last free places of its parent's.
    auto end_of_roots = static_cast<std::uint32_t>(n);
    for (std::size_t i = n; i-- > 0;) {
        std::uint32_t& end = parent[i] == no_supernode ? end_of_roots : next[parent[i]];
        place[i] = next[i] = end - 1;
        end -= size[i];
    }
    return place;
}

/// Finds the supernodes of columns in postorder. A column goes on with the one before it with the same rows below.
class SupernodeFinder {
public:
    SupernodeFinder(const Matrix& lower, const Numbers& tree) : lower_(lower), tree_(tree), marked_(tree.size(), none) {
        find_children();
        for (std::uint32_t column = 0; column < tree.size(); ++column)
            if (!goes_on(column)) begin(column);
    }

    /// Returns the supernodes, without the places of the unknowns.
    Supernodes merged() const {
        std::vector<Group> groups;
        for (auto s = static_cast<std::uint32_t>(nodes_.size()); s-- > 0;)
            if (groups.empty() || !takes_in(groups.back(), nodes_[s])) groups.push_back({nodes_[s].first, s});
        std::reverse(groups.begin(), groups.end());
        return gathered(groups);
    }

private:
    static constexpr std::uint32_t none = no_supernode;

    struct Node {
        std::uint32_t first, last;
        std::size_t below, end;  ///< its rows below the last column, in below_

        std::size_t columns() const { return last - first + 1; }
        std::size_t rows() const { return columns() + (end - below); }
    };

    /// A supernode and those before it that it takes in.
    struct Group {
        std::uint32_t first, node;
        std::size_t zeros = 0;  ///< entries of the factor that are kept for them, but are zero
    };

    const Matrix& lower_;
    const Numbers& tree_;
    Numbers first_child_, next_child_;  ///< per column, in the tree
    Numbers node_of_;                   ///< per column
    Numbers marked_;                    ///< per row: the last node that has it
    Numbers below_;
    std::vector<Node> nodes_;

    void find_children() {
        first_child_.assign(tree_.size(), none);
        next_child_ = node_of_ = first_child_;
        for (auto i = static_cast<std::uint32_t>(tree_.size()); i-- > 0;)
            if (tree_[i] != none) next_child_[i] = std::exchange(first_child_[tree_[i]], i);
    }

    template <class Visit>
    void for_rows_of_matrix(std::uint32_t column, Visit&& visit) const {
        for (Matrix::InnerIterator entry(lower_, static_cast<int>(column)); entry; ++entry)
            if (const auto row = static_cast<std::uint32_t>(entry.row()); row > column) visit(row);
    }

    bool goes_on(std::uint32_t column) {
        const std::uint32_t child = first_child_[column];
        if (child == none || child + 1 != column || next_child_[child] != none) return false;
        const std::uint32_t node = node_of_[child];
        bool all_there = true;
        for_rows_of_matrix(column, [&](std::uint32_t row) { all_there = all_there && marked_[row] == node; });
        if (!all_there) return false;
        nodes_[node].last = column;
        ++nodes_[node].below;
        node_of_[column] = node;
        return true;
    }

    void begin(std::uint32_t column) {
        const auto node = static_cast<std::uint32_t>(nodes_.size());
        const std::size_t start = below_.size();
        const auto take = [&](std::uint32_t row) {
            if (row != column && std::exchange(marked_[row], node) != node) below_.push_back(row);
        };
        for_rows_of_matrix(column, take);
        for (std::uint32_t child = first_child_[column]; child != none; child = next_child_[child]) {
            const Node& below_it = nodes_[node_of_[child]];
            for (std::size_t i = below_it.below; i < below_it.end; ++i) take(below_[i]);
        }
        std::sort(below_.begin() + static_cast<std::ptrdiff_t>(start), below_.end());
        nodes_.push_back({column, column, start, below_.size()});
        node_of_[column] = node;
    }

    /// Takes the node right before a group into it, where that adds few zeros: small supernodes cost more than they.
    /// The bounds are those of CHOLMOD (Y. Chen, T. A. Davis, W. W. Hager, S. Rajamanickam, Algorithm 887, ACM Trans.
    /// Math. Softw. 35 (2008)).
    bool takes_in(Group& group, const Node& node) const {
        const Node& root = nodes_[group.node];
        if (node.below == node.end || below_[node.below] > root.last) return false;
        const std::size_t columns = root.last + 1 - node.first;
        const std::size_t rows = columns + (root.end - root.below);
        const std::size_t zeros = group.zeros + node.columns() * (rows - node.rows());
        const auto share = static_cast<double>(zeros) /
                           (static_cast<double>(columns) * static_cast<double>(2 * rows + 1 - columns) / 2);
        if (columns > 4 && !(share < (columns <= 16 ? 0.8 : columns <= 48 ? 0.1 : 0.05))) return false;
        group = {node.first, group.node, zeros};
        return true;
    }

    Supernodes gathered(const std::vector<Group>& groups) const {
        Supernodes result;
        Numbers of_column(tree_.size());
        for (const Group& group : groups) {
            const Node& root = nodes_[group.node];
            for (std::uint32_t column = group.first; column <= root.last; ++column)
                of_column[column] = static_cast<std::uint32_t>(result.first.size());
            result.first.push_back(group.first);
            result.first_below.push_back(result.below.size());
            result.below.insert(result.below.end(), below_.begin() + static_cast<std::ptrdiff_t>(root.below),
                                below_.begin() + static_cast<std::ptrdiff_t>(root.end));
        }
        result.first.push_back(static_cast<std::uint32_t>(tree_.size()));
        result.first_below.push_back(result.below.size());
        for (std::size_t s = 0; s < groups.size(); ++s) {
            const std::span<const std::uint32_t> below = result.rows_below(s);
            result.parent.push_back(below.empty() ? none : of_column[below.front()]);
        }
        return result;
    }
};

}  // namespace

Supernodes find_supernodes(const Matrix& lower) {
    Numbers place = minimum_degree_places(lower);
    Numbers tree = elimination_tree(reordered(lower, place));
    const Numbers later = postorder(tree);
    for (std::uint32_t& column : place) column = later[column];
    Numbers in_postorder(tree.size(), no_supernode);
    for (std::size_t i = 0; i < tree.size(); ++i)
        if (tree[i] != no_supernode) in_postorder[later[i]] = later[tree[i]];
    Supernodes supernodes = SupernodeFinder(reordered(lower, place), in_postorder).merged();
    supernodes.place = std::move(place);
    return supernodes;
}

Matrix reordered(const Matrix& lower, std::span<const std::uint32_t> place) {
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation(lower.cols());
    for (std::size_t i = 0; i < place.size(); ++i)
        permutation.indices()[static_cast<int>(i)] = static_cast<int>(place[i]);
    Matrix result(lower.rows(), lower.cols());
    result.selfadjointView<Eigen::Lower>() = lower.selfadjointView<Eigen::Lower>().twistedBy(permutation);
    return result;
}

}  // namespace lamina::morphing
