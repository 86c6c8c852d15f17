// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_EFFECT_HULLS_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_EFFECT_HULLS_IPP

#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>

#include <sivid/diagnosis/affected_problem.hpp>
#include <sivid/diagnosis/candidate/detail/input_slices.hpp>
#include <sivid/diagnosis/candidate/detail/sliced_input.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

class hulls_by_slices {
public:
    hulls_by_slices(identification_problem const& base, std::vector<effect> const& effects,
                    effect_hull_options const& options)
        : base_(&base), effects_(&effects), search_(options) {}

    [[nodiscard]] box operator()() {
        auto whole = affected(*base_, *effects_);
        if (auto const sliced = sliced_input_of(*base_, *effects_)) {
            return over_slices(whole.prior, *sliced);
        }
        return whole.model.has_memory() ? whole.prior : over_lags(std::move(whole));
    }

private:
    // Shares of the boxes and of the time that is left.
    static constexpr double least_of_slice = 1.0 / 256, most_of_slice = 1.0 / 16;
    static constexpr double of_quick_slice = 1.0 / 8;
    static constexpr double of_octave = 1.0 / 8;
    static constexpr double of_time = 1.0 / 4;

    /// A box of all parameters from one without parameter `j`, and the range of that.
    [[nodiscard]] static box joined(box const& others, std::size_t j, interval const& range) {
        std::vector<interval> sides(others.begin(), others.end());
        sides.insert(sides.begin() + static_cast<std::ptrdiff_t>(j), range);
        return box(std::move(sides));
    }
    static void add(box& hulls, box const& more) {
        hulls = hulls.size() == 0 ? more : hull(hulls, more);
    }

    /// Slices of the prior, each cut to what it leaves or halved, until they are excluded or
    /// narrow. What is excluded at all mostly is so by few boxes: all are tried with few, then with
    /// more.
    [[nodiscard]] box over_slices(box const& prior, sliced_input const& sliced) const {
        using traits = interval_traits<interval>;
        auto const j = sliced.side;
        struct slice {
            box all; ///< parameters
            double share;
        };
        std::vector<slice> waiting;   // in the order of coming
        constexpr int begin_with = 8; // wider slices are rarely excluded
        auto const at = [&](int k) {
            double const way = static_cast<double>(k) / begin_with;
            auto const& all = prior[j];
            return k == 0            ? all.lower()
                   : k == begin_with ? all.upper()
                                     : all.lower() + way * (all.upper() - all.lower());
        };
        auto const wait = [&](box all, interval const& range, double share) {
            all[j] = range;
            waiting.push_back({std::move(all), share});
        };
        for (int k = 0; k < begin_with; ++k)
            wait(prior, interval(at(k), at(k + 1)), least_of_slice);
        double const narrow = search_.accuracy() * width(prior[j]);
        box hulls;
        for (std::size_t next = 0; next < waiting.size(); ++next) {
            auto const now = waiting[next];
            if (!search_.in_time()) {
                add(hulls, now.all);
                continue;
            }
            auto const& range = now.all[j];
            auto const found = search_(sliced.over(now.all), now.share, of_time);
            if (!found) continue;
            auto left = sliced.is_parameter ? *found : joined(*found, j, range);
            if (sliced.is_parameter) {
                left[j] = intersect(traits::add(traits::point(mid(range)), left[j]), range);
                if (is_empty(left[j])) continue;
                // Closer, the input has less of an error.
                if (width(left[j]) < 0.7 * width(range)) {
                    wait(left, left[j], now.share);
                    continue;
                }
            }
            if (now.share < most_of_slice) {
                wait(left, left[j], std::min(most_of_slice, 4 * now.share));
                continue;
            }
            double const half = mid(left[j]);
            bool const splits = left[j].lower() < half && half < left[j].upper();
            if (!(width(left[j]) > narrow) || !splits) {
                add(hulls, left);
                continue;
            }
            wait(left, traits::bounds(left[j].lower(), half), least_of_slice);
            wait(left, traits::bounds(half, left[j].upper()), least_of_slice);
        }
        return hulls.size() == 0 ? nothing_of(prior) : hulls;
    }

    /// Where the time constant of a lag may be 0, short ones are excluded as inputs with errors, if
    /// possible: the lag's equation is for the others.
    [[nodiscard]] box over_lags(identification_problem whole) {
        box hulls;
        for (std::size_t k = 0; k < effects_->size(); ++k) {
            auto const& e = (*effects_)[k];
            if (!e.lags || !acts_on_recorded_inputs(*effects_, k)) continue;
            auto const j = index_of_parameter(whole, e.name + "." + e.parameters[0].name);
            auto const prior = whole.prior[j];
            if (prior.lower() != 0) continue; // below 0 a lag is none
            for (double const share : {1.0 / 16, 1.0 / 64, 1.0 / 256}) {
                double const longest = share * prior.upper();
                auto const quick = without_lag(k, longest);
                if (!quick || !search_.in_time()) break;
                auto const left = search_(*quick, of_quick_slice);
                if (left && share > 1.0 / 256) continue; // shorter ones may be excluded
                if (left) add(hulls, joined(*left, j, interval(prior.lower(), longest)));
                whole.prior[j] = interval(longest, prior.upper());
                break;
            }
        }
        // Over a range of time constants an octave long the rest is nearly a polynomial in them.
        auto const j = first_lag(whole);
        double const end = j < whole.prior.size() ? whole.prior[j].upper() : 0;
        double from = end > 0 ? whole.prior[j].lower() : 0;
        for (; from > 0 && 2 * from < end && search_.in_time(); from *= 2) {
            auto octave = whole;
            octave.prior[j] = interval(from, 2 * from);
            if (auto const left = search_(octave, of_octave, of_time)) add(hulls, *left);
            whole.prior[j] = interval(2 * from, end);
        }
        if (auto const left = search_(whole, 1)) add(hulls, *left);
        return hulls.size() == 0 ? nothing_of(whole.prior) : hulls;
    }
    /// The side of the first effect that is a lag.
    [[nodiscard]] std::size_t first_lag(identification_problem const& whole) const {
        for (auto const& e : *effects_)
            if (e.lags) return index_of_parameter(whole, e.name + "." + e.parameters[0].name);
        return whole.prior.size();
    }
    /// The problem for all time constants up to the longest; nothing where the input is a formula.
    [[nodiscard]] std::optional<identification_problem> without_lag(std::size_t k,
                                                                    double longest) const {
        auto const& lag = *(*effects_)[k].lags;
        auto others = *effects_;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        auto late = *base_;
        auto const input = index_of(late.model.about.inputs, lag.input, "input");
        for (auto& e : late.experiments) {
            auto const* const recorded = std::get_if<sampled_signal>(&e.inputs[input]);
            if (recorded == nullptr) return std::nullopt;
            e.inputs[input] = lagged_within(*recorded, e.begin, e.end(), longest, lag.rests);
        }
        return affected(late, others);
    }

    identification_problem const* base_;
    std::vector<effect> const* effects_;
    hull_search search_;
};

} // namespace diagnosis_detail

SIVID_DECL box effect_hulls(identification_problem const& base, std::vector<effect> const& effects,
                            effect_hull_options const& options) {
    return diagnosis_detail::hulls_by_slices(base, effects, options)();
}

} // namespace sivid

#endif
