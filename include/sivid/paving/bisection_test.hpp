// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_BISECTION_TEST_HPP
#define SIVID_PAVING_BISECTION_TEST_HPP

#include <sivid/paving/invert.hpp>
#include <sivid/paving/run/plain_run.hpp>
#include <sivid/work_limit.hpp>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid {

/// The test of the report's Algorithms 1 and 2 in any interval type: integrates each experiment
/// over the box by sets of first order, compares each measurement with the enclosure of its output,
/// and contracts the box by what the outputs are as functions of it, to first order. Outside: in
/// some experiment more than its budget of outliers certainly fail, for all starts and inputs;
/// inside: in each all but the budget certainly hold, for all of them. A budget of 0 is
/// Algorithm 1.
/// @tparam I  the type that everything is computed in. Sets of first order are centred on doubles,
///   one for each box: the lanes of a pack are integrated one after the other, in `interval`.
template <interval_scalar I>
class bisection_test {
    using scalar = std::conditional_t<single_interval<I>, I, interval>;

public:
    /// @param problem  is referred to
    /// @param options  `method` chooses a Runge-Kutta formula instead of the Taylor series
    /// @throws std::invalid_argument  for a problem that is not one
    bisection_test(identification_problem const& problem, enclosure_options options)
        : problem_(&problem), options_(std::move(options)) {
        problem.require_valid();
        for (auto const& e : problem.experiments) {
            runs_.push_back(
                std::make_unique<plain_run<scalar>>(problem.model, problem.choice, e, options_));
            starts_.push_back(box_in<scalar>(e.initial));
        }
    }

    /// @cost  one integration for each experiment and lane, until one excludes the box
    [[nodiscard]] finding<I> operator()(basic_box<I> const& parameters) {
        using traits = interval_traits<I>;
        finding<I> says{.rest = parameters};
        if constexpr (single_interval<I>) {
            auto const [verdict, rest] = judge(parameters);
            says.inside = verdict == box_verdict::inside;
            says.outside = verdict == box_verdict::outside;
            says.rest = rest;
        } else {
            std::vector<box> rests(traits::lanes);
            for (std::size_t k = 0; k < traits::lanes; ++k) {
                rests[k] = lane_of(parameters, k);
                if (is_empty(rests[k])) continue;
                auto const [verdict, rest] = judge(rests[k]);
                auto const bit = lane_mask<I>{1} << k;
                if (verdict == box_verdict::inside) says.inside |= bit;
                if (verdict == box_verdict::outside) says.outside |= bit;
                rests[k] = rest;
            }
            says.rest = side_by_side<I>(rests);
        }
        return says;
    }

    /// Whether it was told to stop (`enclosure_options::keep_going`).
    [[nodiscard]] bool cancelled() const { return options_.cancelled(); }

private:
    struct judged {
        box_verdict verdict = box_verdict::undecided;
        basic_box<scalar> rest;
    };

    /// One experiment after the other, each over what those before left of the box. All of the box
    /// is inside where each explains it without contracting it.
    [[nodiscard]] judged judge(basic_box<scalar> const& parameters) {
        judged all{box_verdict::inside, parameters};
        for (std::size_t e = 0; e < runs_.size(); ++e) {
            auto const budget = problem_->experiments[e].outliers;
            auto const& samples = runs_[e]->samples();
            std::size_t fails = 0;
            auto const known = runs_[e]->outputs_while(
                starts_[e], all.rest, [&](std::size_t k, observation<scalar> const& seen) {
                    if (seen.defined && sivid::misses(seen.value, samples[k].bound)) ++fails;
                    return fails <= budget;
                });
            auto const says = judge_deviations(known, samples, known.deviation, budget);
            if (says.finding == run_finding::refuted) return {box_verdict::outside, all.rest};
            if (says.finding == run_finding::explained) continue;
            all.verdict = box_verdict::undecided;
            if (!contract(all.rest, known, says.left)) return {box_verdict::outside, all.rest};
        }
        return all;
    }
    /// Parameters become what a run left of them.
    /// @returns  whether any are left
    [[nodiscard]] static bool contract(basic_box<scalar>& parameters,
                                       plain_outputs<scalar> const& known,
                                       basic_box<scalar> const& left) {
        using traits = interval_traits<scalar>;
        auto const states = left.size() - parameters.size();
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            auto const own =
                traits::add(left[states + j], traits::point(known.parameter_centre[j]));
            auto const both = traits::intersect(parameters[j], own);
            if (traits::is_empty(both)) return false;
            parameters[j] = both;
        }
        return true;
    }

    identification_problem const* problem_;
    enclosure_options options_;
    std::vector<std::unique_ptr<plain_run<scalar>>> runs_;
    std::vector<basic_box<scalar>> starts_;
};

/// Identification by the report's Algorithms 1 and 2 - integrate, compare, bisect - in any interval
/// type: `identify_by_bisection<mp_interval>(problem)`. `identify` answers the same question by
/// contraction, by orders of magnitude faster.
/// @param search  the boxes are taken in their order (`search_order::first_in`) whatever it says
/// @throws std::invalid_argument  for a problem that is not one
/// @guarantee  as `invert` with a `bisection_test`; `proved_verdict` of the paving is the answer
/// @cost  for each box one integration of each experiment until one excludes it; of n parameters
///   about (1 / accuracy)^(n - 1) boxes, those at the boundary of what explains the data
template <interval_scalar I = interval>
[[nodiscard]] inversion identify_by_bisection(
    identification_problem const& problem, inversion_options search = {},
    enclosure_options enclosure = {.order = 12, .tolerance = 1e-7, .minimum_step = 1e-4}) {
    work_limit const limit(search.seconds, search.keep_going);
    enclosure.keep_going = limit;
    search.order = search_order::first_in;
    bisection_test<I> test(problem, std::move(enclosure));
    return invert<I>(test, problem.prior, search);
}

} // namespace sivid

#endif
