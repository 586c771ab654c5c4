#include "mesh/edge_survey.hpp"

#include <algorithm>
#include <utility>

#include <lamina/error.hpp>

#include "core/parallel.hpp"

namespace lamina::mesh {

namespace {

constexpr std::size_t block_of(std::size_t cell) { return cell / cells_per_block; }

}  // namespace

EdgeSurvey::EdgeSurvey(const MeshView& mesh, std::optional<std::size_t> max_bytes, std::size_t least_bytes_for_edges)
    : mesh_(mesh), cell_edges_(mesh) {
    if (cell_edges_.size() >= no_edge) throw MeshError("mesh too large: more than 2^32 edges of cells");
    const std::size_t cells = cell_edges_.cells();
    owners_ = vertex_owners(mesh_, cells);
    totals_.orphans = find_orphans(owners_);
    buckets_ = bucket_count(cells);
    passes_ = max_bytes ? passes_within(*max_bytes, least_bytes_for_edges) : 1;
    buckets_ = std::max(buckets_, passes_);
    between_.resize((cells + cells_per_block - 1) / cells_per_block);
}

/// Looks at a few blocks, and infers the number of edges between blocks.
std::size_t EdgeSurvey::passes_within(std::size_t max_bytes, std::size_t least_bytes_for_edges) const {
    constexpr std::size_t every = 16, max_passes = 256;
    const std::size_t cells = cell_edges_.cells();
    std::size_t looked_at = 0, found = 0;
    for (std::size_t begin = 0; begin < cells; begin += every * cells_per_block) {
        const std::size_t end = std::min(begin + cells_per_block, cells);
        looked_at += end - begin;
        for_each_edge(mesh_, begin, end, [&](std::size_t, VertexId a, VertexId b) { found += is_between(a, b); });
    }
    const double share = looked_at == 0 ? 0 : static_cast<double>(cells) / static_cast<double>(looked_at);
    const double needed = 1.1 * share * static_cast<double>(found * sizeof(SharedEdge));
    const std::size_t owners = owners_.size() * sizeof(std::uint32_t);
    const std::size_t left = std::max(max_bytes - std::min(max_bytes, owners), least_bytes_for_edges);
    return 1 + static_cast<std::size_t>(std::min(needed / static_cast<double>(left), max_passes - 1.0));
}

void EdgeSurvey::add(const EdgeMatches& matches, std::span<const std::uint32_t> numbers) {
    const std::lock_guard lock(mutex_);
    totals_.edges += matches.edges;
    for (const std::uint32_t e : matches.boundary) totals_.boundary.push_back(numbers[e]);
    for (const std::uint32_t e : matches.overused) totals_.overused.push_back(numbers[e]);
}

void EdgeSurvey::match_block(std::size_t begin, std::size_t end, std::vector<std::uint32_t>& twin) {
    const std::size_t first = cell_edges_.first(begin), last_bucket = first_bucket(1);
    twin.assign(cell_edges_.first(end) - first, no_edge);
    TwoWayEdgeList within(twin.size());
    std::vector<SharedEdge> between;
    for_each_edge(mesh_, begin, end, [&](std::size_t e, VertexId a, VertexId b) {
        if (!is_between(a, b))
            within.add(a, b, e - first);
        else if (passes_ == 1 || bucket_of(a, b, buckets_) < last_bucket)
            between.push_back({a, b, static_cast<std::uint32_t>(e)});
    });
    EdgeMatches matches;
    match(within, twin, matches);
    for (std::vector<std::uint32_t>* edges : {&matches.boundary, &matches.overused})
        for (std::uint32_t& e : *edges) e += static_cast<std::uint32_t>(first);
    between_[block_of(begin)] = sort_into_buckets(between, buckets_, 0, last_bucket);
    const std::lock_guard lock(mutex_);
    totals_.edges += matches.edges;
    totals_.boundary.insert(totals_.boundary.end(), matches.boundary.begin(), matches.boundary.end());
    totals_.overused.insert(totals_.overused.end(), matches.overused.begin(), matches.overused.end());
}

void EdgeSurvey::collect_between(std::size_t pass) {
    const std::size_t first = first_bucket(pass), last = first_bucket(pass + 1);
    core::parallel_for(cell_edges_.cells(), cells_per_block, [&](std::size_t begin, std::size_t end) {
        std::vector<SharedEdge> between;
        for_each_edge(mesh_, begin, end, [&](std::size_t e, VertexId a, VertexId b) {
            if (!is_between(a, b)) return;
            if (const std::size_t bucket = bucket_of(a, b, buckets_); bucket >= first && bucket < last)
                between.push_back({a, b, static_cast<std::uint32_t>(e)});
        });
        between_[block_of(begin)] = sort_into_buckets(between, buckets_, first, last);
    });
}

/// `bucket` counts from the first one of the pass.
void EdgeSurvey::match_bucket(std::size_t bucket, const std::function<void(std::span<const EdgePair>)>& visit) {
    std::size_t size = 0;
    for (const EdgeBuckets& list : between_) size += list.start[bucket + 1] - list.start[bucket];
    TwoWayEdgeList edges(size);
    std::vector<std::uint32_t> numbers;
    numbers.reserve(size);
    for (const EdgeBuckets& list : between_)
        for (std::size_t i = list.start[bucket]; i < list.start[bucket + 1]; ++i) {
            edges.add(list.edges[i].origin, list.edges[i].target, numbers.size());
            numbers.push_back(list.edges[i].number);
        }
    std::vector<std::uint32_t> twin(size, no_edge);
    EdgeMatches matches;
    match(edges, twin, matches);
    add(matches, numbers);
    // The edges come in the order of their blocks, and hence of their numbers.
    std::vector<EdgePair> pairs;
    pairs.reserve(matches.edges);
    for (std::size_t i = 0; i < size; ++i)
        if (twin[i] != no_edge && twin[i] > i) pairs.push_back({numbers[i], numbers[twin[i]]});
    visit(pairs);
}

void EdgeSurvey::match_between(const std::function<void(std::span<const EdgePair>)>& visit) {
    for (std::size_t pass = 0; pass < passes_; ++pass) {
        if (pass > 0) collect_between(pass);
        core::parallel_for(first_bucket(pass + 1) - first_bucket(pass), 1,
                           [&](std::size_t bucket, std::size_t) { match_bucket(bucket, visit); });
    }
    between_ = {};
}

EdgeTotals EdgeSurvey::take_totals() {
    std::sort(totals_.boundary.begin(), totals_.boundary.end());
    std::sort(totals_.overused.begin(), totals_.overused.end());
    return std::move(totals_);
}

}  // namespace lamina::mesh
