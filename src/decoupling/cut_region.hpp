// The outer region as it is cut, before its subdomains are made: all that processes need of subdomains that others
// refine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/export.hpp>
#include <lamina/sizing.hpp>

#include "core/connected_ranks.hpp"
#include "decoupling/cut_to_size.hpp"
#include "decoupling/lines.hpp"
#include "decoupling/subdomain.hpp"

namespace lamina::decoupling {

/// The borders of all subdomains. The other members are those of Decoupling.
struct LAMINA_EXPORT CutRegion {
    Lines lines;
    RingRegions rings;
    std::vector<Segment> far_field;
    std::vector<std::uint32_t> far_field_lines;  ///< those that these edges are on, with the region on their left
    std::vector<EstimatedBorder> borders;
    std::size_t separator_vertices = 0;
    std::vector<std::vector<Segment>> inner_edges{};  ///< per line inside the region: its edges, in its direction

    /// Returns the border of a subdomain.
    LineBorder border(std::size_t subdomain) const;
    /// Calls f for the lines of a subdomain, for some of them more than once.
    template <class F>
    void for_lines(std::size_t subdomain, F&& f) const {
        const EstimatedBorder& border = borders[subdomain];
        if (!border.border) return rings.for_lines(border.trapezoid, f);
        for (const LineLoop& loop : border.border->loops)
            for (const Stretch& stretch : loop.stretches) f(stretch.line);
    }
};

/// BesideCuts holds functions that cut_region() calls on each process while it cuts, where they are given.
struct BesideCuts {
    std::function<void()> once_numbered{};  ///< called once, when all have waited for each other and none makes pieces
    MakeTrapezoid make{};                   ///< called for pieces, by processes that would wait
};

/// Cuts the outer region as decouple() does, and throws what it throws. Collective where `ranks` are given: they divide
/// the work among themselves, and each divides those lines alone that it needs for its share; throws MeshError where
/// another process would cut another region. BesideCuts::make finds the vertices of trapezoids in Lines::gathered():
/// these have their ids before anything is cut. EstimatedBorder::kept tells which pieces a process may have made with
/// it.
LAMINA_EXPORT CutRegion cut_region(const OuterRegion& region, core::ConnectedRanks* ranks = nullptr,
                                   const BesideCuts& beside = {});

/// Makes a subdomain from its border. Divides its lines, and estimates its work unless that is known: null. `size` is
/// the size field of the region.
LAMINA_EXPORT Subdomain make_subdomain(const LineBorder& border, const WorkEstimate* known, Lines& lines,
                                       const SizeField& size, const RefineOptions& refine);

/// A short hash of all lines before they are numbered. What processes tell of their cuts means something else where it
/// differs. All tell it to all, so it is short: require_same_borders() has a long one in the end.
using LinesHash = std::uint16_t;
LinesHash hash_of_lines(const Lines& lines);

/// Throws MeshError where processes have told different hashes, which begin these texts.
void require_same_hashes(std::span<const std::string> told, std::size_t bytes_of_hash);

/// Collective: throws MeshError on rank 0 where another process has other borders. Its numbers would mean other
/// vertices, which no check of a piece by itself can see.
LAMINA_EXPORT void require_same_borders(const CutRegion& cut, core::ConnectedRanks& ranks);

}  // namespace lamina::decoupling
