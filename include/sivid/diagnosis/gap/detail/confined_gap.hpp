// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_GAP_DETAIL_CONFINED_GAP_HPP
#define SIVID_DIAGNOSIS_GAP_DETAIL_CONFINED_GAP_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/inflation.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

/// Measurements of one channel, of some experiments, or of both.
struct data_part {
    std::optional<std::size_t> channel{};   ///< nothing: every one
    std::vector<std::size_t> experiments{}; ///< none: every one

    [[nodiscard]] bool holds(std::size_t e, measurement const& m) const {
        bool const here = experiments.empty() ||
                          std::find(experiments.begin(), experiments.end(), e) != experiments.end();
        return here && (!channel || m.channel == *channel);
    }
};

/// The problem with the error bounds of a part so many times as wide, about the same middles.
/// @guarantee  the bounds are rounded outward
[[nodiscard]] inline identification_problem loosened(identification_problem p,
                                                     data_part const& part, double factor) {
    using traits = interval_traits<interval>;
    for (std::size_t e = 0; e < p.experiments.size(); ++e) {
        for (auto& m : p.experiments[e].measurements) {
            if (!part.holds(e, m)) continue;
            auto const reach = traits::mul(traits::point(rad(m.bound)), traits::point(factor));
            auto const middle = traits::point(mid(m.bound));
            m.bound = traits::bounds(traits::sub(middle, reach).lower(),
                                     traits::add(middle, reach).upper());
        }
    }
    return p;
}

/// By which factor bounds grew at most, about their exact middles: the least number, rounded up,
/// that widens each of `was` to hold its own of `is`. Bounds of no width that grew: infinite.
[[nodiscard]] inline double growth_of(identification_problem const& was,
                                      identification_problem const& is) {
    using traits = interval_traits<interval>;
    double most = 1;
    for (std::size_t e = 0; e < was.experiments.size(); ++e) {
        for (std::size_t k = 0; k < was.experiments[e].measurements.size(); ++k) {
            auto const &a = was.experiments[e].measurements[k].bound,
                       &b = is.experiments[e].measurements[k].bound;
            auto const ends = [](double x, double y) {
                return traits::sub(traits::point(x), traits::point(y));
            };
            double const grown =
                std::max(ends(a.lower(), b.lower()).upper(), ends(b.upper(), a.upper()).upper());
            if (!(grown > 0)) continue;
            bool undefined = false;
            auto const more = traits::div(traits::mul(traits::point(2.0), traits::point(grown)),
                                          ends(a.upper(), a.lower()), undefined);
            double const factor = traits::add(traits::point(1.0), more).upper();
            if (undefined) return std::numeric_limits<double>::infinity();
            most = std::max(most, factor);
        }
    }
    return most;
}

struct confinement_options {
    bool channels = true; ///< else parts are whole experiments
    /// Where several experiments are left out: how many sets of them are followed, and experiments
    /// tried with each; sets that leave as little are found together.
    std::size_t most = 4;
    inflation_options lower{};     ///< for the lower end of each factor
    std::function<bool()> go_on{}; ///< false ends it with what was found; may be empty
};

/// Parts of the measurements without which fits explain all others, as `find_confined_gaps` looks
/// for them. Nothing is proved.
[[nodiscard]] SIVID_DECL std::vector<data_part>
find_unexplained_parts(identification_problem const& p, approximate_fit const& fit,
                       confinement_options const& options);

/// Which measurements alone stand against a model: parts without which one parameter of the prior
/// explains all the others, and the factor by which the bounds of the part must then grow. Tried
/// are every channel, every experiment, a channel in one experiment and, where none of them is
/// enough, two or three experiments of which at least two stay; a part that holds another one is
/// not given.
/// @param fit    of the problem
/// @param whole  what is proved about its inflation
/// @guarantee  each factor contains the least one; its upper end is finite, the witness attains it
/// @cost  a fit for every channel and every experiment, about ten for each part that is found
[[nodiscard]] SIVID_DECL std::vector<confined_gap>
find_confined_gaps(identification_problem const& p, approximate_fit const& fit,
                   inflation_range const& whole, confinement_options const& options);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/diagnosis/gap/impl/confined_gap.ipp>
#endif

#endif
