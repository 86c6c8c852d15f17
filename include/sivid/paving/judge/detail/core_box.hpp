// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_JUDGE_DETAIL_CORE_BOX_HPP
#define SIVID_PAVING_JUDGE_DETAIL_CORE_BOX_HPP

#include <sivid/paving/contract/detail/weighted_certificate.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Whether responses prove that every parameter of a part explains the data.
/// @param known  by experiment, for starts from which existence is proved
/// @given  the part lies in the box of the responses (trusted)
[[nodiscard]] inline bool explained_by_responses(response_list const& known, box const& part) {
    return std::all_of(known.begin(), known.end(), [&](std::shared_ptr<response const> const& r) {
        auto copy = part; // may be contracted
        return assess(*r, copy).explained;
    });
}

/// Looks for a box about a point all of whose parameters explain the data, by responses alone.
///   Each side first gets an n-th of what the margins and slopes of all measurements at the point
///   allow it; then all sides together, and each by itself, grow as long as the proof holds.
/// @guarantee  every parameter of a box that is returned explains the data
/// @cost  some ten judgements of parts by the responses, then some ten for each side
class core_search {
    using traits = interval_traits<interval>;

public:
    /// @given  `part` lies in the box of the responses, the point in `part` (trusted)
    /// @param keep_going  false ends the growth with what is proved until then; may be empty
    core_search(response_list known, box part, std::vector<double> point,
                std::function<bool()> keep_going = nullptr)
        : known_(std::move(known)),
          part_(std::move(part)),
          point_(std::move(point)),
          keep_going_(std::move(keep_going)) {}

    /// All sides in proportion.
    [[nodiscard]] std::optional<box> scaled() {
        reach_ = first_reach();
        best_ = proved(reach_);
        for (int k = 0; !best_ && k < halvings; ++k) {
            scale(reach_, 0.5);
            best_ = proved(reach_);
        }
        while (best_ && grow([](std::vector<double>& r) { scale(r, 1.5); })) {
        }
        return best_;
    }
    /// Then each side by itself.
    /// @given  `scaled` has found a box
    [[nodiscard]] box grown() {
        std::vector<bool> grows(reach_.size(), true);
        for (bool any = true; any;) {
            any = false;
            for (std::size_t j = 0; j < reach_.size(); ++j) {
                grows[j] = grows[j] && grow([j](std::vector<double>& r) { r[j] *= 1.5; });
                any = any || grows[j];
            }
        }
        return *best_;
    }

private:
    static constexpr int halvings = 6;

    static void scale(std::vector<double>& reach, double by) {
        for (auto& r : reach) r *= by;
    }
    static std::vector<double> width(box const& x) {
        std::vector<double> w;
        for (auto const& side : x) w.push_back(sivid::width(side));
        return w;
    }
    [[nodiscard]] box about(std::vector<double> const& reach) const {
        auto x = part_;
        for (std::size_t j = 0; j < x.size(); ++j) {
            auto const side =
                traits::add(traits::point(point_[j]), traits::bounds(-reach[j], reach[j]));
            x[j] = traits::intersect(x[j], side);
        }
        return x;
    }
    template <class Change>
    [[nodiscard]] bool grow(Change const& change) {
        auto more = reach_;
        change(more);
        auto found = proved(more);
        if (!found || width(*found) == width(*best_)) return false; // the ends of the part
        best_ = std::move(found);
        reach_ = std::move(more);
        return true;
    }
    [[nodiscard]] std::optional<box> proved(std::vector<double> const& reach) const {
        if (keep_going_ && !keep_going_()) return std::nullopt;
        auto x = about(reach);
        if (!explained_by_responses(known_, x)) return std::nullopt;
        return x;
    }

    /// By slopes and margins at the point.
    [[nodiscard]] std::vector<double> first_reach() const {
        auto const n = part_.size();
        std::vector<double> small, reach;
        for (auto const& side : part_) {
            small.push_back(0x1p-20 * rad(side));
            reach.push_back(sivid::width(side));
        }
        auto const near = about(small);
        for (auto const& known : known_) {
            auto const local = expand(*known, near);
            for (std::size_t y = 0; y < known->outputs(); ++y) {
                auto const& bound = known->bounds[y];
                double const off = std::abs(local.value[y] - mid(bound));
                if (!(off < rad(bound))) continue; // an outlier, or another start makes it hold
                double const margin = std::max(rad(bound) - off - local.rest[y], 0.1 * rad(bound));
                for (std::size_t j = 0; j < n; ++j) {
                    auto const& side = known->unknowns.parameters[j];
                    if (side.radius == 0) continue;
                    auto const moved = std::abs(local.slope[side.variable * known->outputs() + y]);
                    if (!(moved > 0)) continue;
                    reach[j] = std::min(reach[j],
                                        margin * rad(near[j]) / (moved * static_cast<double>(n)));
                }
            }
        }
        return reach;
    }

    response_list known_;
    box part_;
    std::vector<double> point_;
    std::function<bool()> keep_going_;
    std::vector<double> reach_;
    std::optional<box> best_;
};

/// A box about a point all of whose parameters explain the data from the starts of the test: the
/// largest that is found from responses over regions about the point, each half as wide as the one
/// before, which are integrated together. It is for problems with so many unknowns that bisection
/// meets no such box: that takes \f$ 2^{h_1 + ... + h_n} \f$ boxes where side i has to be halved
/// h_i times.
/// @param around  the first region: what is left of the prior, with the point in it
/// @returns  nothing when none was found, or the test was told to stop before
/// @cost  eight integrations of each experiment, and some hundred re-expansions of each response
[[nodiscard]] inline std::optional<box> core_about(feasibility_test& test, box const& around,
                                                   std::vector<double> const& point) {
    using traits = interval_traits<interval>;
    std::vector<box> regions;
    double share = 0.5;
    for (std::size_t k = 0; k < test.at_once(); ++k, share /= 2) {
        auto& region = regions.emplace_back(around);
        for (std::size_t j = 0; j < around.size(); ++j) {
            double const reach = share * width(around[j]);
            region[j] = traits::intersect(
                around[j], traits::add(traits::point(point[j]), traits::bounds(-reach, reach)));
        }
    }
    std::vector<response_list> known(regions.size());
    for (std::size_t e = 0; e < test.starts().size(); ++e) {
        auto const answers = test.run(e, test.starts()[e], regions);
        for (std::size_t k = 0; k < regions.size(); ++k) known[k].push_back(answers[k]);
    }
    std::optional<core_search> best;
    double best_size = 0;
    for (std::size_t k = 0; k < regions.size(); ++k) {
        core_search search(std::move(known[k]), regions[k], point,
                           [&test] { return !test.cancelled(); });
        auto const core = search.scaled();
        double const size = core ? relative_volume(*core, around).upper() : 0;
        if (best && size <= best_size) break; // it is the region that limits, not the remainders
        if (!core) continue;
        best_size = size;
        best = std::move(search);
    }
    return best ? std::optional(best->grown()) : std::nullopt;
}

} // namespace sivid

#endif
