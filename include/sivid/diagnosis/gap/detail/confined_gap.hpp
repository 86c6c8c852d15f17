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

/// By how much bounds of a part grow, in units of some number: per experiment and measurement, in
/// the order of the problem; 0: not at all.
struct bound_growth {
    std::vector<std::vector<double>> reach;

    /// So many times as wide bounds: each grows by its own half-width.
    [[nodiscard]] static bound_growth of(identification_problem const& p, data_part const& part) {
        return of(p, part, [&](std::size_t e, std::size_t k) {
            return half_width(p.experiments[e].measurements[k].bound).lower();
        });
    }
    /// @param size  of (experiment, measurement), at least 0
    template <class Size>
    [[nodiscard]] static bound_growth of(identification_problem const& p, data_part const& part,
                                         Size const& size) {
        bound_growth result;
        for (std::size_t e = 0; e < p.experiments.size(); ++e) {
            auto const& all = p.experiments[e].measurements;
            auto& own = result.reach.emplace_back(all.size(), 0.0);
            for (std::size_t k = 0; k < all.size(); ++k)
                if (part.holds(e, all[k])) own[k] = size(e, k);
        }
        return result;
    }

    /// The problem with bounds that grow by so many units, about the same middles.
    /// @guarantee  the bounds are rounded outward
    [[nodiscard]] identification_problem operator()(identification_problem p, double units) const {
        using traits = interval_traits<interval>;
        for (std::size_t e = 0; e < p.experiments.size(); ++e) {
            for (std::size_t k = 0; k < p.experiments[e].measurements.size(); ++k) {
                if (!(reach[e][k] > 0)) continue;
                auto& bound = p.experiments[e].measurements[k].bound;
                auto const more =
                    traits::mul(traits::point(reach[e][k]), traits::point(units)).upper();
                bound = traits::bounds(
                    traits::sub(traits::point(bound.lower()), traits::point(more)).lower(),
                    traits::add(traits::point(bound.upper()), traits::point(more)).upper());
            }
        }
        return p;
    }
    /// The largest growth of a bound as a share of its half-width, for one unit; rounded up.
    [[nodiscard]] double greatest_share(identification_problem const& p) const {
        using traits = interval_traits<interval>;
        double most = 0;
        for (std::size_t e = 0; e < reach.size(); ++e) {
            for (std::size_t k = 0; k < reach[e].size(); ++k) {
                if (!(reach[e][k] > 0)) continue;
                bool undefined = false;
                auto const share =
                    traits::div(traits::point(reach[e][k]),
                                half_width(p.experiments[e].measurements[k].bound), undefined);
                most = std::max(most, undefined ? detail::infinity : share.upper());
            }
        }
        return most;
    }
    /// How many bounds grow.
    [[nodiscard]] double count() const {
        std::ptrdiff_t all = 0;
        for (auto const& own : reach)
            all += std::count_if(own.begin(), own.end(), [](double r) { return r > 0; });
        return static_cast<double>(all);
    }
    /// The logarithm by which so many units make uniform noise within the bounds less likely.
    [[nodiscard]] double cost(identification_problem const& p, double units) const {
        double sum = 0;
        for (std::size_t e = 0; e < reach.size(); ++e) {
            for (std::size_t k = 0; k < reach[e].size(); ++k) {
                if (reach[e][k] > 0)
                    sum += std::log1p(units * reach[e][k] /
                                      rad(p.experiments[e].measurements[k].bound));
            }
        }
        return sum;
    }
    /// The least number of units, rounded up, with which each bound of `was` holds its own of `is`;
    /// infinite where one without reach grew.
    [[nodiscard]] double between(identification_problem const& was,
                                 identification_problem const& is) const {
        using traits = interval_traits<interval>;
        auto const ends = [](double x, double y) {
            return traits::sub(traits::point(x), traits::point(y)).upper();
        };
        double most = 0;
        for (std::size_t e = 0; e < was.experiments.size(); ++e) {
            for (std::size_t k = 0; k < was.experiments[e].measurements.size(); ++k) {
                auto const &a = was.experiments[e].measurements[k].bound,
                           &b = is.experiments[e].measurements[k].bound;
                double const grown =
                    std::max(ends(a.lower(), b.lower()), ends(b.upper(), a.upper()));
                if (!(grown > 0)) continue;
                bool undefined = false;
                auto const units =
                    traits::div(traits::point(grown), traits::point(reach[e][k]), undefined);
                if (undefined) return std::numeric_limits<double>::infinity();
                most = std::max(most, units.upper());
            }
        }
        return most;
    }

private:
    [[nodiscard]] static interval half_width(interval const& bound) {
        using traits = interval_traits<interval>;
        return traits::mul(traits::point(0.5),
                           traits::sub(traits::point(bound.upper()), traits::point(bound.lower())));
    }
};

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
