#include "pipeline/sharing/shared_seams.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "core/word_hash.hpp"

namespace lamina::pipeline {

namespace {

using core::Packer;
using core::Unpacker;
using decoupling::LineVertex;
using Wanted = mesh::Seams::Wanted;

/// Puts numbers below 16 two to a byte.
class NibblePacker {
public:
    void put(std::uint8_t nibble) {
        if (half_)
            bytes_.back() = static_cast<char>(static_cast<unsigned char>(bytes_.back()) | nibble << 4);
        else
            bytes_.push_back(static_cast<char>(nibble));
        half_ = !half_;
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
    bool half_ = false;
};

/// Calls f(v, n) for the vertices of a border that belong to a process: n successive ones from v on.
template <class F>
void for_owned_vertices(const decoupling::LineBorder& border, const decoupling::Lines& lines, const SeamOwners& owners,
                        unsigned process, F&& f) {
    for (const decoupling::LineLoop& loop : border.loops)
        for (const decoupling::Stretch& stretch : loop.stretches) {
            // The first vertex may be one of another line, or of none; the others are inside this one.
            if (const LineVertex first = lines.vertex(stretch.line, stretch.first); owners.owner(first) == process)
                f(first.id, 1);
            const std::uint32_t n = stretch.segments();
            if (n == 1 || owners.owner(stretch.line) != process) continue;
            if (lines.is_loop(stretch.line))
                for (std::uint32_t i = 1; i < n; ++i) f(lines.id(stretch.line, stretch.place(i)), 1);
            else
                f(lines.id(stretch.line, std::min(stretch.first, stretch.last) + 1), n - 1);
        }
}

/// Calls f(i, edge, line) for the edges of border_chain() on lines that take(line) takes.
template <class Take, class F>
void for_edges(const decoupling::LineBorder& border, const decoupling::Lines& lines, Take&& take, F&& f) {
    if (border.may_dangle) {
        const BorderChain chain = border_chain(border, lines);
        for (std::uint32_t i = 0; i < chain.edges.size(); ++i)
            if (take(chain.lines[i])) f(i, chain.edges[i], chain.lines[i]);
        return;
    }
    std::uint32_t next = 0;
    for (const decoupling::LineLoop& loop : border.loops)
        for (const decoupling::Stretch& stretch : loop.stretches) {
            const std::uint32_t n = stretch.segments(), first = std::exchange(next, next + n);
            if (!take(stretch.line)) continue;
            VertexId from = lines.id(stretch.line, stretch.first);
            for (std::uint32_t i = 0; i < n; ++i) {
                const VertexId to = lines.id(stretch.line, stretch.place(i + 1));
                f(first + i, Segment{std::exchange(from, to), to}, stretch.line);
            }
        }
}

/// A question for an edge, and where the answer goes.
struct Question {
    std::uint32_t piece = 0, edge = 0;
    bool apex = false;
    bool ends = false;  ///< whether the ends of the edge are wanted, too
    bool along_layer = false;
    std::size_t seam_edge = 0;
};

/// Takes the apex above an edge, or the area of the triangle there, from an answer.
void take_answer(const Question& question, auto& seams, Unpacker& answer) {
    if (question.apex)
        seams.set_apex(question.seam_edge, answer.get<Point>());
    else
        seams.set_area(question.seam_edge, answer.get<double>());
}

/// Puts questions, piece by piece.
std::string pack_questions(std::span<const Question> questions) {
    Packer packer;
    for (std::size_t begin = 0; begin < questions.size();) {
        std::size_t end = begin;
        while (end < questions.size() && questions[end].piece == questions[begin].piece &&
               (end == begin || questions[end].edge > questions[end - 1].edge))
            ++end;
        packer.put_short(questions[begin].piece);
        packer.put_short(end - begin);
        std::uint32_t last = 0;
        for (; begin < end; ++begin)
            packer.put_short(4 * (questions[begin].edge - std::exchange(last, questions[begin].edge)) +
                             (questions[begin].ends ? 2 : 0) + (questions[begin].apex ? 1 : 0));
    }
    return packer.take();
}

}  // namespace

std::uint64_t hash_of_places(Segment edge, std::span<const Point> points) {
    const auto [low, high] = std::minmax(edge.a, edge.b);
    core::WordHash hash;
    hash.add(std::uint64_t{low.value} << 32 | high.value);
    hash.add(points[low.index()]);
    hash.add(points[high.index()]);
    return edge.a < edge.b ? hash.value() : -hash.value();
}

std::uint64_t sum_of_places(std::span<const Segment> edges, std::span<const Point> points) {
    std::uint64_t sum = 0;
    for (const Segment& edge : edges) sum += hash_of_places(edge, points);
    return sum;
}

SharedSeams::SharedSeams(SharedDecoupling& shared, const HeldPieces& held, core::ConnectedRanks& ranks)
    : shared_(shared),
      held_(held),
      ranks_(ranks),
      owners_(shared.cut, shared.layer_vertices(), ranks.rank()),
      used_(owners_.own_vertices(), 0),
      is_far_field_(shared.cut.lines.size(), false),
      seams_(shared.points()) {
    for (const std::uint32_t line : shared.cut.far_field_lines) is_far_field_[line] = true;
}

const HeldPiece& SharedSeams::held(std::size_t piece) const {
    return *std::lower_bound(held_.pieces.begin(), held_.pieces.end(), piece,
                             [](const HeldPiece& one, std::size_t number) { return one.piece < number; });
}

std::vector<std::string> SharedSeams::pack_borders() const {
    std::vector<Packer> packers(ranks_.size());
    std::vector<NibblePacker> classes(ranks_.size());
    std::vector<unsigned> concerned;
    std::vector<bool> is_concerned(ranks_.size(), false);
    for (const HeldPiece& held : held_.pieces) {
        const decoupling::LineBorder border = shared_.cut.border(held.piece);
        const decoupling::Lines& lines = shared_.cut.lines;
        const auto concern = [&](unsigned owner) {
            if (is_concerned[owner]) return;
            is_concerned[owner] = true;
            concerned.push_back(owner);
        };
        for (const decoupling::LineLoop& loop : border.loops)
            for (const decoupling::Stretch& stretch : loop.stretches) {
                concern(owners_.owner(lines.vertex(stretch.line, stretch.first)));
                concern(owners_.owner(stretch.line));
            }
        NibblePacker* of_line = nullptr;
        for_edges(
            border, lines,
            [&](std::uint32_t line) {
                of_line = &classes[owners_.owner(line)];
                return true;
            },
            [&](std::uint32_t i, Segment, std::uint32_t) {
                const std::uint8_t none = 0;
                of_line->put(i < held.shape_classes.size() ? held.shape_classes[i] : none);
            });
        for (const unsigned owner : concerned) {
            packers[owner].put_short(held.piece);
            packers[owner].put_text(std::exchange(classes[owner], {}).bytes());
            is_concerned[owner] = false;
        }
        concerned.clear();
    }
    std::vector<std::string> texts;
    texts.reserve(packers.size());
    for (Packer& packer : packers) texts.push_back(packer.take());
    return texts;
}

void SharedSeams::take_vertices(VertexId first, std::size_t n) {
    if (owners_.is_in_layer(first))
        for (std::size_t i = 0; i < n; ++i) vertices_in_layer_.push_back(VertexId{first.index() + i});
    else
        std::fill_n(used_.begin() + static_cast<std::ptrdiff_t>(owners_.place(first)), n, std::uint8_t{1});
}

void SharedSeams::take_borders(std::uint32_t rank, const std::string& told) {
    const unsigned self = ranks_.rank();
    Unpacker unpacker(told);
    while (!unpacker.at_end()) {
        const auto piece = static_cast<std::uint32_t>(unpacker.get_short());
        const std::string classes = unpacker.get_text();
        const decoupling::LineBorder border = shared_.cut.border(piece);
        for_owned_vertices(border, shared_.cut.lines, owners_, self,
                           [&](VertexId first, std::size_t n) { take_vertices(first, n); });
        const HeldPiece* here = rank == self ? &held(piece) : nullptr;
        std::size_t next = 0;
        const auto take_edge = [&](std::uint32_t i, Segment edge, std::uint32_t line) {
            const auto both = static_cast<unsigned char>(classes[next / 2]);
            const auto its_class = static_cast<std::uint8_t>(next % 2 == 0 ? both & 15 : both >> 4);
            ++next;
            const bool in_layer = owners_.is_in_layer(edge.a) && owners_.is_in_layer(edge.b);
            const Point apex = here != nullptr && i < here->apexes.size() ? here->apexes[i] : mesh::unknown_apex;
            const mesh::PieceBorderEdge taken{edge.a, edge.b, apex, its_class};
            if (in_layer)
                along_layer_.push_back(taken);
            else
                seams_.add({&taken, 1});
            const bool outer = is_far_field_[line] && shared_.cut.lines.runs_along(line, edge);
            (in_layer ? sources_along_layer_ : sources_).push_back({rank, piece, i, outer});
        };
        for_edges(
            border, shared_.cut.lines, [&](std::uint32_t line) { return owners_.owner(line) == self; }, take_edge);
    }
}

void SharedSeams::collect() {
    const std::vector<std::string> told = ranks_.exchange(pack_borders());
    // Each takes half a byte and more.
    std::size_t most_edges = 0;
    for (const std::string& of_rank : told) most_edges += 2 * of_rank.size();
    seams_.expect(most_edges);
    sources_.reserve(most_edges);
    for (std::uint32_t rank = 0; rank < told.size(); ++rank) take_borders(rank, told[rank]);
    seams_.match();
}

mesh::QualityCollector SharedSeams::least_ratios() const {
    mesh::QualityCollector ratios(0);
    ratios.add_area_ratios(seams_.least_ratios());
    return ratios;
}

std::string SharedSeams::answer(const std::string& questions) const {
    const std::span<const Point> points = shared_.points();
    Packer packer;
    Unpacker unpacker(questions);
    while (!unpacker.at_end()) {
        const std::size_t number = unpacker.get_short();
        const HeldPiece& piece = held(number);
        const std::vector<Segment> chain = shared_.chain(number).edges;
        std::size_t edge = 0;
        for (std::size_t left = unpacker.get_short(); left > 0; --left) {
            const std::size_t question = unpacker.get_short();
            edge += question / 4;
            const Point apex = piece.apexes[edge];
            const Point a = points[chain[edge].a.index()], b = points[chain[edge].b.index()];
            if (question % 2 == 1)
                packer.put(apex);
            else
                packer.put(mesh::area_over(a, b, apex));
            if (question & 2) {
                packer.put(a);
                packer.put(b);
            }
        }
    }
    return packer.take();
}

/// Returns whether an edge between pieces is one of a piece that this process holds.
bool SharedSeams::has_source_here(std::size_t edge) const { return sources_[edge].rank == ranks_.rank(); }

void SharedSeams::ask(double even_ratio, mesh::PiecewiseCheck* check) {
    std::vector<std::vector<Question>> asked(ranks_.size());
    const auto add = [&](std::span<const Wanted> wanted, bool along_layer) {
        for (const auto [edge, apex] : wanted) {
            const Source& source = along_layer ? sources_along_layer_[edge] : sources_[edge];
            // Rank 0 has the layer. Beyond it one side tells where the ends of the edge are, unless a piece here has
            // it.
            const bool ends = apex && !along_layer && seams_.edges()[edge].a < seams_.edges()[edge].b &&
                              !has_source_here(seams_.pairs().twin[edge]);
            asked[source.rank].push_back({source.piece, source.edge, apex, ends, along_layer, edge});
        }
    };
    if (check) add(check->wanted(even_ratio), true);
    add(seams_.wanted(even_ratio), false);
    std::vector<std::string> questions, answers;
    for (const std::vector<Question>& of_rank : asked) questions.push_back(pack_questions(of_rank));
    for (const std::string& of_rank : ranks_.exchange(questions)) answers.push_back(answer(of_rank));
    answers = ranks_.exchange(answers);
    for (std::size_t rank = 0; rank < answers.size(); ++rank) {
        Unpacker unpacker(answers[rank]);
        for (const Question& question : asked[rank]) {
            if (question.along_layer)
                take_answer(question, *check, unpacker);
            else
                take_answer(question, seams_, unpacker);
            if (!question.ends) continue;
            const Segment ends = seams_.edges()[question.seam_edge];
            shared_.cut.lines.set_gathered(ends.a, unpacker.get<Point>());
            shared_.cut.lines.set_gathered(ends.b, unpacker.get<Point>());
        }
    }
}

mesh::SeamFindings SharedSeams::findings() const {
    mesh::SeamFindings findings;
    const mesh::EdgePairs& pairs = seams_.pairs();
    findings.edges = pairs.edges;
    findings.vertices = static_cast<std::size_t>(std::count(used_.begin(), used_.end(), std::uint8_t{1}));
    findings.measures = seams_.measure([](Segment) { return false; });
    for (const std::uint32_t e : pairs.boundary)
        if (sources_[e].outer)
            ++findings.outer_edges;
        else
            findings.one_sided.push_back(seams_.edges()[e]);
    for (const std::uint32_t e : pairs.overused) findings.overused.push_back(seams_.edges()[e]);
    return findings;
}

std::uint64_t SharedSeams::places() const {
    std::uint64_t sum = 0;
    for (const HeldPiece& piece : held_.pieces) sum += piece.places;
    for (const mesh::PieceBorderEdge& edge : along_layer_) sum -= hash_of_places({edge.a, edge.b}, shared_.points());
    return sum;
}

std::string pack_findings(const SharedFindings& shared) {
    const mesh::SeamFindings& findings = shared.seams;
    Packer packer;
    packer.put(shared.places);
    packer.put_short(findings.edges);
    packer.put_short(findings.vertices);
    packer.put_short(findings.measures.delaunay.edges);
    packer.put_short(findings.measures.delaunay.violations);
    packer.put(findings.measures.ratios.totals().max_area_ratio);
    packer.put_counts(findings.measures.ratios.area_ratios());
    packer.put_short(findings.outer_edges);
    packer.put_all<Segment>(findings.one_sided);
    packer.put_all<Segment>(findings.overused);
    return packer.take();
}

SharedFindings unpack_findings(std::string_view bytes) {
    Unpacker unpacker(bytes);
    SharedFindings shared;
    shared.places = unpacker.get<std::uint64_t>();
    mesh::SeamFindings& findings = shared.seams;
    findings.edges = unpacker.get_short();
    findings.vertices = unpacker.get_short();
    findings.measures.delaunay.edges = unpacker.get_short();
    findings.measures.delaunay.violations = unpacker.get_short();
    mesh::QualityTotals totals;
    totals.max_area_ratio = unpacker.get<double>();
    findings.measures.ratios.append(totals);
    findings.measures.ratios.append_area_ratios(unpacker.get_counts());
    findings.outer_edges = unpacker.get_short();
    findings.one_sided = unpacker.get_all<Segment>();
    findings.overused = unpacker.get_all<Segment>();
    return shared;
}

std::string join_findings(std::string_view one, std::string_view other) {
    SharedFindings all = unpack_findings(one);
    const SharedFindings more = unpack_findings(other);
    all.places += more.places;
    all.seams.add(more.seams);
    return pack_findings(all);
}

}  // namespace lamina::pipeline
