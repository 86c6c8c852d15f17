// SPDX-License-Identifier: MIT
// Whether some start explains an experiment at given parameters: found by fits, told by the
// reference.
#ifndef SIVID_TESTS_SUPPORT_SOME_START_HPP
#define SIVID_TESTS_SUPPORT_SOME_START_HPP

#include "support/problems.hpp"

#include <sivid/approximate/fit/fit.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace support {

/// The measurements without some of them, by their order in time.
inline sivid::record without(sivid::record const& samples, std::vector<std::size_t> const& some) {
    sivid::record result;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        if (std::find(some.begin(), some.end(), k) == some.end()) result.push_back(samples[k]);
    }
    return result;
}

/// @param tries  starts that may do, and where fits begin
/// @param slack  by which a bound may be missed
inline bool some_start_explains(planted_problem const& planted, std::size_t e,
                                std::vector<double> const& p,
                                std::vector<std::vector<double>> const& tries, double slack) {
    auto const& own = planted.problem.experiments[e];
    auto const explains = [&](std::vector<double> const& start) {
        return contains(own.initial, start) && planted.violated(e, p, start, slack) <= own.outliers;
    };
    if (std::any_of(tries.begin(), tries.end(), explains)) return true;
    if (std::all_of(own.initial.begin(), own.initial.end(),
                    [](sivid::interval const& x) { return x.lower() == x.upper(); })) {
        return false;
    }
    auto held = planted.problem;
    held.experiments = {own};
    held.prior = sivid::point_box(p);
    held.experiments[0].outliers = 0;
    auto const samples = sivid::sorted(own.measurements);
    // Every choice of outliers: a fit that leaves out what is worst where it stands may choose
    // wrongly.
    std::vector<std::size_t> out;
    auto const search = [&](auto const& self, std::size_t next) -> bool {
        if (out.size() == own.outliers) {
            auto begin = tries;
            begin.push_back(sivid::mid(own.initial));
            for (auto const& start : begin) {
                auto const kept = without(samples, out);
                auto& bounds = held.experiments[0].measurements;
                bounds = kept;
                for (int round = 0; round < 3; ++round) {
                    auto const fit = sivid::approximate_fitter(held)({p, {start}});
                    if (fit.starts.empty()) break;
                    if (explains(fit.starts[0])) return true;
                    // Where bounds are narrower than the fit's simulation is exact they are moved
                    // by its error.
                    auto exact = planted.simulate(e, p, fit.starts[0]);
                    for (auto k = out.size(); k-- > 0;) {
                        exact.erase(exact.begin() + static_cast<std::ptrdiff_t>(out[k]));
                    }
                    for (std::size_t k = 0; k < kept.size(); ++k) {
                        double const plain =
                            mid(bounds[k].bound) + fit.residuals[0][k] * rad(bounds[k].bound);
                        double const error = plain - static_cast<double>(exact[k]);
                        bounds[k].bound = sivid::interval(kept[k].bound.lower() + error,
                                                          kept[k].bound.upper() + error);
                    }
                }
            }
            return false;
        }
        for (std::size_t k = next; k < samples.size(); ++k) {
            out.push_back(k);
            if (self(self, k + 1)) return true;
            out.pop_back();
        }
        return false;
    };
    return search(search, 0);
}

} // namespace support

#endif
