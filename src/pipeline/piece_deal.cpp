#include "pipeline/piece_deal.hpp"

#include <algorithm>

namespace lamina::pipeline {

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
    for (std::vector<std::size_t>* order : {&deal.own, &deal.shared})
        std::stable_sort(order->begin(), order->end(),
                         [&](std::size_t a, std::size_t b) { return borders[a].work > borders[b].work; });
    return deal;
}

}  // namespace lamina::pipeline
