// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_WEIGHTED_OUTPUTS_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_WEIGHTED_OUTPUTS_HPP

#include <sivid/paving/response/response.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace sivid {

/// The certificate of an exclusion, evaluated: \f$ \sum_i w_i (y_i(p, x_0) - b_i) \f$ over a box of
/// parameters and all starts, where \f$ b_i \f$ is the upper end of measurement i for a positive
/// weight and the lower one for a negative. Who meets all weighted measurements makes no term
/// positive; where the sum is positive throughout, nobody does.
///   Written apart from what proposes the weights and from the certificates of the search, in the
///   arithmetic of I.
/// @tparam I  interval type
template <class I>
class weighted_outputs {
    using traits = interval_traits<I>;

public:
    /// @param known    of boxes of parameters around `part`; null where an experiment is not known
    /// @param weights  (experiment, output, weight), of measurements that are bounded in the
    ///                 direction of their weights
    weighted_outputs(response_list const& known, box const& part,
                     std::vector<measurement_weight> const& weights) {
        std::size_t unknowns = part.size();
        for (std::size_t e = 0; e < known.size(); ++e) {
            if (!known[e]) continue;
            auto const& r = *known[e];
            std::vector<I> c(r.table->size(), traits::point(0.0));
            bool any = false;
            for (auto const& w : weights) {
                if (w.experiment != e) continue;
                any = true;
                take(r, w, c);
            }
            if (any) place(r, part, unknowns, std::move(c));
            for (auto const& side : r.unknowns.initial) unknowns += side.radius > 0 ? 1 : 0;
        }
    }

    /// Whether the sum is positive throughout, by proof.
    [[nodiscard]] bool positive() const {
        I least = constant_;
        for (auto const& [e, c] : terms_) {
            bool const even =
                std::all_of(e.begin(), e.end(), [](auto const& f) { return f.second % 2 == 0; });
            double const size = traits::mag(c);
            if (!std::isfinite(size)) return false;
            if (even && traits::lower(c) >= 0) continue; // never below 0
            least = traits::sub(least, traits::bounds(0.0, size));
        }
        return traits::lower(least) > 0;
    }

private:
    /// Unknowns with their powers, those of power 0 left out.
    using monomial = std::vector<std::pair<std::size_t, std::uint8_t>>;

    void take(response const& r, measurement_weight const& w, std::vector<I>& c) {
        I const weight = traits::point(w.value);
        double const end = w.value > 0 ? r.bounds[w.output].upper() : r.bounds[w.output].lower();
        constant_ = traits::sub(constant_, traits::mul(weight, traits::point(end)));
        double const radius = r.radius[w.output];
        constant_ = traits::add(constant_, traits::mul(weight, traits::bounds(-radius, radius)));
        for (std::size_t m = 0; m < c.size(); ++m) {
            double const own = r.coefficients[m * r.outputs() + w.output];
            c[m] = traits::add(c[m], traits::mul(weight, traits::point(own)));
        }
    }

    /// Adds the polynomial in the unknowns of the part: \f$ q = middle + reach \, d \f$.
    void place(response const& r, box const& part, std::size_t first_start, std::vector<I> c) {
        auto const n = r.table->variables;
        std::vector<std::size_t> unknown(n, 0);
        std::vector<I> middle(n, traits::point(0.0)), reach(n, traits::point(1.0));
        typename traits::mask undefined{};
        for (std::size_t j = 0; j < part.size(); ++j) {
            auto const& side = r.unknowns.parameters[j];
            if (side.radius == 0) continue;
            I const radius = traits::point(side.radius);
            I const off = traits::sub(traits::point(mid(part[j])), traits::point(side.centre));
            unknown[side.variable] = j;
            middle[side.variable] = traits::div(off, radius, undefined);
            reach[side.variable] = traits::div(traits::point(rad(part[j])), radius, undefined);
        }
        for (auto const& side : r.unknowns.initial) {
            if (side.radius > 0) unknown[side.variable] = first_start++;
        }
        for (std::size_t v = 0; v < n; ++v) {
            if (traits::mag(middle[v]) == 0) continue;
            for (auto const& line : r.table->lines[v]) { // by repeated synthetic division
                for (std::size_t low = 0; low + 1 < line.size(); ++low) {
                    for (std::size_t k = line.size() - 1; k-- > low;) {
                        c[line[k]] =
                            traits::add(c[line[k]], traits::mul(middle[v], c[line[k + 1]]));
                    }
                }
            }
        }
        for (std::size_t m = 0; m < c.size(); ++m) {
            monomial e;
            for (std::size_t v = 0; v < n; ++v) {
                auto const power = r.table->exponents[m][v];
                if (power == 0) continue;
                e.emplace_back(unknown[v], power);
                for (std::size_t k = 0; k < power; ++k) c[m] = traits::mul(c[m], reach[v]);
            }
            if (e.empty()) {
                constant_ = traits::add(constant_, c[m]);
                continue;
            }
            std::sort(e.begin(), e.end());
            auto const [term, is_new] = terms_.emplace(std::move(e), c[m]);
            if (!is_new) term->second = traits::add(term->second, c[m]);
        }
        if (undefined) constant_ = traits::entire();
    }

    I constant_ = traits::point(0.0);
    std::map<monomial, I> terms_;
};

/// Whether weights prove that no parameter of a part explains the data.
///   Whoever explains the data violates at most the allowed outliers, so a group of measurements
///   that share none with another is met in the whole when there is a group more than outliers
///   allowed to the experiments in the groups. Each group is proved to be met by nobody.
/// @param known   of boxes of parameters around `part`; null where an experiment is not known
/// @param groups  from anywhere: what names no measurement, or shares one, proves nothing
template <class I>
[[nodiscard]] bool weights_exclude(response_list const& known, box const& part,
                                   proof_step::groups const& groups) {
    std::set<std::pair<std::size_t, std::size_t>> seen;
    std::set<std::size_t> experiments;
    for (auto const& group : groups) {
        std::set<std::pair<std::size_t, std::size_t>> own;
        for (auto const& w : group) {
            if (w.experiment >= known.size() || !known[w.experiment]) return false;
            auto const& r = *known[w.experiment];
            if (w.output >= r.outputs() || !std::isfinite(w.value)) return false;
            auto const& bound = r.bounds[w.output];
            if (!std::isfinite(w.value > 0 ? bound.upper() : bound.lower())) return false;
            experiments.insert(w.experiment);
            if (r.allowed > 0) own.insert({w.experiment, w.output});
        }
        for (auto const& m : own) {
            if (!seen.insert(m).second) return false;
        }
    }
    std::size_t allowed = 0;
    for (auto const e : experiments) allowed += known[e]->allowed;
    return groups.size() > allowed &&
           std::all_of(groups.begin(), groups.end(), [&](auto const& group) {
               return weighted_outputs<I>(known, part, group).positive();
           });
}

} // namespace sivid

#endif
