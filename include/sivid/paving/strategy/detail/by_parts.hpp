// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STRATEGY_DETAIL_BY_PARTS_HPP
#define SIVID_PAVING_STRATEGY_DETAIL_BY_PARTS_HPP

#include <sivid/paving/inversion_options.hpp>
#include <sivid/paving/strategy/contractor.hpp>
#include <sivid/paving/strategy/inquiry.hpp>
#include <sivid/paving/strategy/strategy.hpp>
#include <sivid/space/box.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// Asks contractors about parts of the prior, where they say little of all of it (constructive
/// disjunction): each side is halved, and all are asked of each part. What explains the data is in
/// what is left of one of the parts: in the hull of these. Again while less than four fifths are
/// left, in few parts.
///   All sides at once, since which one blurs a run is not known before.
/// @cost  a part takes a quarter of the time that is left, at most; 64 parts for each of 64
class by_parts : public contractor {
public:
    explicit by_parts(strategy others) : others_(std::move(others)) {}

    [[nodiscard]] std::string name() const override { return "parts of the prior"; }
    [[nodiscard]] std::shared_ptr<contractor const> without(std::string_view name) const override {
        return std::make_shared<by_parts>(others_.without(name));
    }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const& limit,
                                      contraction_record& says) const override {
        auto const& prior = asked.problem().prior;
        stopwatch const clock;
        std::vector<box> left{prior};
        double volume = 1;
        std::size_t parts = 0;
        for (double before = HUGE_VAL;
             limit() && volume < 0.8 * before && left.size() <= most_parts;) {
            std::vector<box> less;
            for (auto const& whole : left) {
                for (auto const& x : halved(whole, prior)) {
                    bool const in_time = limit() && parts < asked.search().boxes;
                    auto rest = in_time ? contracted(x, asked, limit, says) : x;
                    if (!is_empty(rest)) less.push_back(std::move(rest));
                    parts += in_time ? 1 : 0;
                    if (in_time && asked.search().progress)
                        (void)asked.search().progress({.seconds = clock.spent(),
                                                       .tested = parts,
                                                       .pending = less.size(),
                                                       .outer = volume});
                }
            }
            left = std::move(less);
            before = std::exchange(volume, 0);
            for (auto const& x : left) volume += relative_volume(x, prior).upper();
        }
        says.figures.emplace_back("parts", static_cast<double>(parts));
        auto all = empty_box(prior.size());
        for (auto const& x : left) all = is_empty(all) ? x : hull(all, x);
        return {all};
    }

private:
    static constexpr std::size_t most_parts = 64; ///< where more are left a search is for them

    /// Its halves of up to six sides, the widest against the prior.
    [[nodiscard]] static std::vector<box> halved(box const& whole, box const& prior) {
        auto const share = [&](std::size_t j) {
            return width(prior[j]) > 0 ? width(whole[j]) / width(prior[j]) : 0;
        };
        std::vector<std::size_t> sides(whole.size());
        std::iota(sides.begin(), sides.end(), 0);
        std::ranges::stable_sort(sides, std::greater{}, share);
        sides.resize(std::min<std::size_t>(sides.size(), 6));
        std::vector<box> result{whole};
        for (auto const j : sides) {
            double const middle = mid(whole[j]);
            if (!(whole[j].lower() < middle && middle < whole[j].upper())) continue;
            for (std::size_t k = result.size(); k-- > 0;) {
                auto [below, above] = bisect(result[k], j, middle);
                result[k] = std::move(below);
                result.push_back(std::move(above));
            }
        }
        return result;
    }
    [[nodiscard]] box contracted(box const& x, inquiry& asked, work_limit const& limit,
                                 contraction_record& says) const {
        auto posed = asked.problem();
        posed.prior = x;
        work_limit const own(0.25 * limit.seconds(), limit);
        inquiry part(std::move(posed), asked.options(), asked.search(), own);
        contract(others_, part);
        says.integrations += part.integrations();
        for (auto const& r : part.journal()) says.integrations += r.integrations;
        return part.problem().prior;
    }

    strategy others_;
};

} // namespace sivid::paving_detail

#endif
