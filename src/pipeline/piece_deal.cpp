#include "pipeline/piece_deal.hpp"

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
    constexpr double kept_share = 0.75;
    double work = 0;
    for (const decoupling::EstimatedBorder& border : borders)
        if (!border.made) work += border.work;
    const double kept = processes == 1 ? work : kept_share * work / processes;
    PieceDeal deal;
    std::vector<double> kept_by(processes, 0);
    for (std::size_t i = 0; i < borders.size(); ++i) {
        if (borders[i].made) continue;
        double& of_process = kept_by[borders[i].process];
        if (of_process + borders[i].work > kept) {
            deal.shared.push_back(i);
            continue;
        }
        of_process += borders[i].work;
        if (borders[i].process == process) deal.own.push_back(i);
    }
    sort_by_work(borders, deal.own);
    sort_by_work(borders, deal.shared);
    return deal;
}

}  // namespace lamina::pipeline
