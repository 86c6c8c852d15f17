// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_CANDIDATE_IMPL_EFFECT_HULLS_IPP
#define SIVID_DIAGNOSIS_CANDIDATE_IMPL_EFFECT_HULLS_IPP

#include <sivid/diagnosis/candidate/detail/effect_hulls.hpp>

#include <sivid/diagnosis/candidate/detail/hull_search.hpp>
#include <sivid/diagnosis/candidate/detail/input_slices.hpp>
#include <sivid/diagnosis/candidate/detail/sliced_input.hpp>
#include <sivid/model/affected_problem.hpp>

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

    [[nodiscard]] explained_hull operator()() {
        auto whole = affected(*base_, *effects_);
        if (auto const sliced = sliced_input_of(*base_, *effects_)) {
            return over_slices(whole, *sliced);
        }
        if (whole.model.has_memory()) return {whole.prior};
        return over_lags(std::move(whole));
    }

private:
    // Shares of the boxes and of the time that is left.
    static constexpr double least_of_slice = 1.0 / 256, most_of_slice = 1.0 / 16;
    static constexpr double of_quick_slice = 1.0 / 8;
    static constexpr double of_octave = 1.0 / 8;
    static constexpr double of_time = 1.0 / 4, of_untouched = 1.0 / 3;

    /// A hull of all parameters from one without parameter `j`, and the range of that.
    [[nodiscard]] static explained_hull joined(explained_hull others, std::size_t j,
                                               interval const& range) {
        auto const at = static_cast<std::ptrdiff_t>(j);
        std::vector<interval> sides(others.parameters.begin(), others.parameters.end());
        sides.insert(sides.begin() + at, range);
        others.parameters = box(std::move(sides));
        for (auto& p : others.products) {
            p.what.exponents.insert(p.what.exponents.begin() + at, 0);
            if (p.what.is_sum()) p.what.signs.insert(p.what.signs.begin() + at, 0);
        }
        return others;
    }

    /// A part of the prior, and its share of the boxes.
    struct slice {
        explained_hull all; ///< parameters
        double share;
    };

    /// What the untouched data leave of the prior, in slices, each cut to what it leaves or halved,
    /// until they are excluded or narrow. What is excluded at all mostly is so by few boxes: all
    /// are tried with few, then with more.
    [[nodiscard]] explained_hull over_slices(identification_problem const& whole,
                                             sliced_input const& sliced) const {
        auto const prior = left_by_untouched(whole, sliced);
        if (!prior) return {empty_box(whole.prior.size())};
        auto waiting = first_slices(*prior, sliced); // in the order of coming
        explained_hull hulls;
        for (std::size_t next = 0; next < waiting.size(); ++next) {
            auto const now = waiting[next];
            if (hulls.contains(now.all)) continue; // it changes nothing
            if (!search_.in_time()) {
                hulls.join(now.all);
                continue;
            }
            auto const over = sliced.over(now.all.parameters);
            auto const found = search_(over, now.share, of_time,
                                       products_in(over, whole, sliced, now.all.products));
            if (!found) continue;
            auto const left = explained_by(whole, sliced, now.all, over, *found);
            if (!left) continue;
            auto const finer = once_more(now, *left, whole, sliced);
            if (finer.empty()) hulls.join(*left);
            waiting.insert(waiting.end(), finer.begin(), finer.end());
        }
        return or_nothing(std::move(hulls), whole);
    }
    [[nodiscard]] std::optional<explained_hull>
    left_by_untouched(identification_problem const& whole, sliced_input const& sliced) const {
        explained_hull prior{whole.prior};
        if (!sliced.untouched || !search_.in_time()) return prior;
        auto const found = search_(*sliced.untouched, 1, of_untouched);
        if (!found) return std::nullopt;
        return explained_by(whole, sliced, prior, *sliced.untouched, *found);
    }
    /// Every side in pieces of one width: few of several, since wider ones are rarely excluded.
    [[nodiscard]] static std::vector<slice> first_slices(explained_hull const& prior,
                                                         sliced_input const& sliced) {
        std::vector<slice> slices{{prior, least_of_slice}};
        int const pieces = sliced.sides.size() == 1 ? 8 : 4;
        for (auto const& side : sliced.sides) {
            auto const& all = prior.parameters[side.index];
            std::vector<slice> finer;
            double from = all.lower();
            for (int k = 1; k <= pieces; ++k) {
                double const way = static_cast<double>(k) / pieces;
                double const to =
                    k == pieces ? all.upper() : all.lower() + way * (all.upper() - all.lower());
                for (auto const& s : slices) {
                    finer.push_back(s);
                    finer.back().all.parameters[side.index] = interval(from, to);
                }
                from = to;
            }
            slices = std::move(finer);
        }
        return slices;
    }
    /// How a slice is searched again, of which something is left: cut to that, with more boxes, or
    /// in halves; not at all where it is narrow.
    [[nodiscard]] std::vector<slice> once_more(slice const& now, explained_hull const& left,
                                               identification_problem const& whole,
                                               sliced_input const& sliced) const {
        // Closer, the inputs have less of an error.
        bool const closer =
            std::any_of(sliced.sides.begin(), sliced.sides.end(), [&](auto const& side) {
                auto const j = side.index;
                return width(left.parameters[j]) < 0.7 * width(now.all.parameters[j]);
            });
        if (closer) return {{left, now.share}};
        if (now.share < most_of_slice) return {{left, std::min(most_of_slice, 4 * now.share)}};
        auto const j = widest(sliced, left.parameters, whole.prior);
        auto const& side = left.parameters[j];
        double const half = mid(side);
        bool const splits = side.lower() < half && half < side.upper();
        // Of several sides there are many slices, and most narrow ones are unknowns besides.
        double const narrow = (sliced.sides.size() == 1 ? 1 : 4) * search_.accuracy();
        if (!(width(side) > narrow * width(whole.prior[j])) || !splits) return {};
        std::vector<slice> halves(2, {left, least_of_slice});
        halves[0].all.parameters[j] = interval(side.lower(), half);
        halves[1].all.parameters[j] = interval(half, side.upper());
        return halves;
    }
    /// The sliced side that is the largest share of its prior.
    [[nodiscard]] static std::size_t widest(sliced_input const& sliced, box const& all,
                                            box const& prior) {
        auto const share = [&](sliced_input::side const& s) {
            return width(all[s.index]) / width(prior[s.index]);
        };
        return std::max_element(sliced.sides.begin(), sliced.sides.end(),
                                [&](auto const& a, auto const& b) { return share(a) < share(b); })
            ->index;
    }

    /// Where the time constant of a lag may be 0, short ones are excluded as inputs with errors, if
    /// possible: the lag's equation is for the others.
    [[nodiscard]] explained_hull over_lags(identification_problem whole) {
        explained_hull hulls;
        for (std::size_t k = 0; k < effects_->size(); ++k) {
            auto const& e = (*effects_)[k];
            if (!e.lags || e.lags->input.empty() || e.changes_within() ||
                !finds_as_recorded(base_->model, *effects_, k, e.lags->input))
                continue;
            auto const j = index_of_parameter(whole, e.name + "." + e.parameters[0].name);
            auto const prior = whole.prior[j];
            if (prior.lower() != 0) continue; // below 0 a lag is none
            for (double const share : {1.0 / 16, 1.0 / 64, 1.0 / 256}) {
                double const longest = share * prior.upper();
                auto const quick = without_lag(k, longest);
                if (!quick || !search_.in_time()) break;
                auto const left = search_(*quick, of_quick_slice);
                if (left && share > 1.0 / 256) continue; // shorter ones may be excluded
                if (left) hulls.join(joined(*left, j, interval(prior.lower(), longest)));
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
            if (auto const left = search_(octave, of_octave, of_time)) hulls.join(*left);
            whole.prior[j] = interval(2 * from, end);
        }
        if (auto const left = search_(whole, 1)) hulls.join(*left);
        return or_nothing(std::move(hulls), whole);
    }
    [[nodiscard]] static explained_hull or_nothing(explained_hull hulls,
                                                   identification_problem const& whole) {
        if (hulls.parameters.size() == 0) return {empty_box(whole.prior.size())};
        return hulls;
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
            if (!(*effects_)[k].acts_in(e.name)) continue;
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

SIVID_DECL explained_hull effect_hulls(identification_problem const& base,
                                       std::vector<effect> const& effects,
                                       effect_hull_options const& options) {
    return diagnosis_detail::hulls_by_slices(base, effects, options)();
}

} // namespace sivid

#endif
