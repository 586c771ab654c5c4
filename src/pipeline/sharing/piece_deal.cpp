#include "pipeline/sharing/piece_deal.hpp"

#include <functional>
#include <map>

namespace lamina::pipeline {

namespace {

/// Sorts pieces by their work, the largest first, and equal ones by their numbers, in which they are given. Most are as
/// much work as many others, and as the ones before.
void sort_by_work(std::span<const decoupling::EstimatedBorder> borders, std::vector<std::size_t>& pieces) {
    std::map<float, std::vector<std::size_t>, std::greater<>> by_work;
    auto last = by_work.end();
    for (const std::size_t piece : pieces) {
        if (last == by_work.end() || last->first != borders[piece].work)
            last = by_work.try_emplace(borders[piece].work).first;
        last->second.push_back(piece);
    }
    pieces.clear();
    for (const auto& [work, equal] : by_work) pieces.insert(pieces.end(), equal.begin(), equal.end());
}

}  // namespace

PieceDeal deal_pieces(std::span<const decoupling::EstimatedBorder> borders, unsigned process, unsigned processes) {
    constexpr double most_of_share = 0.8;
    std::vector<double> kept_by(processes, 0);
    double work = 0, rest = 0;
    for (const decoupling::EstimatedBorder& border : borders) {
        work += border.work;
        if (border.kept)
            kept_by[border.process] += border.work;
        else
            rest += border.work;
    }
    const double most = processes == 1 ? work : most_of_share * work / processes;
    const double most_of_rest = processes == 1 ? rest : most_of_share * rest / processes;
    PieceDeal deal;
    std::vector<double> of_rest(processes, 0);
    for (std::size_t i = 0; i < borders.size(); ++i) {
        const std::uint32_t owner = borders[i].process;
        if (!borders[i].kept) {
            const double of_piece = borders[i].work;
            if (kept_by[owner] + of_piece > most || of_rest[owner] + of_piece > most_of_rest) {
                deal.shared.push_back(i);
                continue;
            }
            kept_by[owner] += of_piece;
            of_rest[owner] += of_piece;
        }
        if (owner == process) deal.own.push_back(i);
    }
    sort_by_work(borders, deal.own);
    sort_by_work(borders, deal.shared);
    return deal;
}

}  // namespace lamina::pipeline
