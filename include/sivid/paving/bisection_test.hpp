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
/// and knows nothing else. Outside: in some experiment more than its budget of outliers certainly
/// fail, for all starts and inputs; inside: in each all but the budget certainly hold, for all of
/// them. A budget of 0 is Algorithm 1.
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
        finding<I> says{.rest = parameters};
        if constexpr (single_interval<I>) {
            auto const found = judge(parameters);
            says.inside = found == box_verdict::inside;
            says.outside = found == box_verdict::outside;
        } else {
            for (std::size_t k = 0; k < interval_traits<I>::lanes; ++k) {
                auto const own = lane_of(parameters, k);
                if (is_empty(own)) continue;
                auto const found = judge(own);
                auto const bit = lane_mask<I>{1} << k;
                if (found == box_verdict::inside) says.inside |= bit;
                if (found == box_verdict::outside) says.outside |= bit;
            }
        }
        return says;
    }

    /// Whether it was told to stop (`enclosure_options::keep_going`).
    [[nodiscard]] bool cancelled() const { return options_.cancelled(); }

private:
    [[nodiscard]] box_verdict judge(basic_box<scalar> const& parameters) {
        bool inside = true;
        for (std::size_t e = 0; e < runs_.size(); ++e) {
            auto const budget = problem_->experiments[e].outliers;
            auto const& samples = runs_[e]->samples();
            std::size_t hits = 0, fails = 0;
            runs_[e]->each(starts_[e], parameters,
                           [&](std::size_t k, observation<scalar> const& seen) {
                               if (!seen.defined) return true;
                               if (lies_in(seen.value, samples[k].bound)) ++hits;
                               if (sivid::misses(seen.value, samples[k].bound)) ++fails;
                               return fails <= budget;
                           });
            if (fails > budget) return box_verdict::outside;
            inside = inside && hits + budget >= samples.size();
        }
        return inside ? box_verdict::inside : box_verdict::undecided;
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
