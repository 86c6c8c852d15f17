// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_OBSERVER_DETAIL_OBSERVER_CONTRACTION_HPP
#define SIVID_PAVING_OBSERVER_DETAIL_OBSERVER_CONTRACTION_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/observer/detail/observer_bank.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <utility>

namespace sivid {

struct observer_contraction_options {
    std::function<bool()> keep_going{}; ///< false ends it with what is proved until then
    std::size_t rounds = 24;            ///< of one box, at most
    /// A slab that is cut off is at least this share of its side.
    double least = 1.0 / 16;
};

/// Contracts boxes of parameters by interval observers: slabs at the ends of their sides, over
/// which observers contradict the measurements, are cut off (shaving, eight slabs at once).
///   Where trajectories over a box are not carried far (a kink that cannot be a polynomial, a fast
/// state, a start that nobody knows), observers often are: measurements narrow them again.
/// @guarantee  no parameter that explains the data is removed; empty: proved, there is none
/// @cost  two runs of the observers for every four parameters, and as many again for each time
///        that something is cut off; a run over five records of a hundred samples takes some 20 ms
class observer_contraction {
public:
    /// @param problem  outlives this; its model has no delays (checked)
    explicit observer_contraction(identification_problem const& problem,
                                  observer_contraction_options options = {})
        : observers_(problem), options_(std::move(options)) {}

    [[nodiscard]] SIVID_DECL box operator()(box x);

private:
    observer_bank observers_;
    observer_contraction_options options_;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/observer/impl/observer_contraction.ipp>
#endif

#endif
