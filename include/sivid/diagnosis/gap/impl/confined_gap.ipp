// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_GAP_IMPL_CONFINED_GAP_IPP
#define SIVID_DIAGNOSIS_GAP_IMPL_CONFINED_GAP_IPP

#include <sivid/diagnosis/gap/detail/coarse_steps.hpp>
#include <sivid/diagnosis/gap/detail/confined_gap.hpp>
#include <sivid/diagnosis/gap/detail/error_sequence.hpp>

#include <sivid/approximate/fit/fit.hpp>
#include <sivid/compiled.hpp>
#include <sivid/diagnosis/candidate/detail/describe_candidate.hpp>
#include <sivid/diagnosis/verification.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

class gap_confinement {
public:
    gap_confinement(identification_problem const& p, approximate_fit const& fit,
                    inflation_range const& whole, confinement_options const& options)
        : p_(&p), fit_(&fit), whole_(whole), options_(&options) {}

    /// What fits find.
    [[nodiscard]] std::vector<data_part> parts() const {
        std::vector<data_part> result;
        for (auto& f : smallest_parts()) result.push_back(std::move(f.part));
        return result;
    }
    /// With proof.
    [[nodiscard]] std::vector<confined_gap> operator()() const {
        std::vector<confined_gap> result;
        for (auto const& f : smallest_parts()) {
            if (!go_on()) break;
            if (auto proved = judged(f)) result.push_back(std::move(*proved));
        }
        return result;
    }

private:
    /// A part, and a fit of all measurements but these.
    struct found {
        data_part part;
        approximate_fit others;
    };
    /// By so many times its bounds a part says nothing.
    static constexpr double nothing = 1e6;
    /// Factors are found to within this share ...
    static constexpr double precision = 0.02;
    /// ... and a validated run has this much room.
    static constexpr double slack = 1e-3;
    /// Growth that adds so many times its width to some bound is tried first.
    static constexpr double widest = 1000;
    /// Of two explanations one is much likelier: by a factor of 20 (logarithm), ...
    static constexpr double clearly = 3;

    [[nodiscard]] bool go_on() const { return !options_->go_on || options_->go_on(); }

    [[nodiscard]] std::vector<found> smallest_parts() const {
        std::set<std::size_t> measured;
        for (auto const& e : p_->experiments) {
            for (auto const& m : e.measurements) measured.insert(m.channel);
        }
        std::vector<data_part> channels, experiments, both;
        if (options_->channels && measured.size() > 1) {
            for (auto const y : measured) channels.push_back({y, {}});
        }
        auto const n = p_->experiments.size();
        for (std::size_t e = 0; n > 1 && e < n; ++e) experiments.push_back({{}, {e}});
        auto const without_channel = explained(channels);
        std::vector<found> not_enough;
        auto const without_experiment = explained(experiments, &not_enough);
        for (auto const& c : without_channel) {
            for (auto const& e : without_experiment)
                both.push_back({c.part.channel, e.part.experiments});
        }
        auto result = explained(both);
        auto const smaller = result;
        for (auto const* larger : {&without_channel, &without_experiment}) {
            for (auto const& f : *larger) {
                bool const holds =
                    std::any_of(smaller.begin(), smaller.end(), [&f](found const& s) {
                        return f.part.channel ? s.part.channel == f.part.channel
                                              : s.part.experiments == f.part.experiments;
                    });
                if (!holds) result.push_back(f);
            }
        }
        return result.empty() ? several_experiments(std::move(not_enough)) : result;
    }

    /// Those parts without which the others are explained.
    /// @param not_enough  receives those without which they are not
    [[nodiscard]] std::vector<found> explained(std::vector<data_part> const& parts,
                                               std::vector<found>* not_enough = nullptr) const {
        std::vector<found> result;
        for (auto const& part : parts) {
            if (!go_on()) break;
            found f{part, fit_of_others(part)};
            if (f.others.inflation <= 1) {
                result.push_back(std::move(f));
            } else if (not_enough != nullptr) {
                not_enough->push_back(std::move(f));
            }
        }
        return result;
    }
    [[nodiscard]] approximate_fit fit_of_others(data_part const& part) const {
        constexpr double promising = 3, close = 1.05;
        auto const others = bound_growth::of(*p_, part)(*p_, nothing);
        approximate_fitter descend(others, options_->go_on);
        auto best = descend({fit_->parameters});
        auto const try_again = [&](double below, fit_start const& from) {
            if (!(best.inflation > 1 && best.inflation < below)) return;
            if (auto other = descend(from); other.inflation < best.inflation)
                best = std::move(other);
        };
        try_again(promising, {}); // from where the part has not drawn it
        try_again(close, {best.parameters, best.starts});
        return best;
    }

    /// Two or three experiments are left out, from those on that leave the least.
    [[nodiscard]] std::vector<found> several_experiments(std::vector<found> one_less) const {
        auto const n = p_->experiments.size();
        for (std::size_t size = 2; size <= 3 && size + 2 <= n && !one_less.empty(); ++size) {
            keep_closest(one_less);
            std::set<std::vector<std::size_t>> sets;
            for (auto const& f : one_less) {
                for (auto const e : worst(f)) {
                    auto without = f.part.experiments;
                    without.push_back(e);
                    std::sort(without.begin(), without.end());
                    sets.insert(std::move(without));
                }
            }
            std::vector<data_part> parts;
            for (auto const& without : sets) parts.push_back({{}, without});
            std::vector<found> not_enough;
            auto result = explained(parts, &not_enough);
            keep_closest(result);
            if (!result.empty()) return result;
            one_less = std::move(not_enough);
        }
        return {};
    }
    void keep_closest(std::vector<found>& all) const {
        std::stable_sort(all.begin(), all.end(), [](found const& a, found const& b) {
            return a.others.inflation < b.others.inflation;
        });
        if (all.size() > options_->most) all.resize(options_->most);
    }
    /// The experiments with the largest residuals, of those that a part does not hold.
    [[nodiscard]] std::vector<std::size_t> worst(found const& f) const {
        std::vector<std::pair<double, std::size_t>> all;
        for (std::size_t e = 0; e < f.others.residuals.size(); ++e) {
            auto const& out = f.part.experiments;
            if (std::find(out.begin(), out.end(), e) != out.end()) continue;
            double most = 0;
            for (double const r : f.others.residuals[e]) most = std::max(most, std::abs(r));
            all.emplace_back(-most, e);
        }
        std::sort(all.begin(), all.end());
        std::vector<std::size_t> result;
        for (std::size_t k = 0; k < std::min(all.size(), options_->most); ++k) {
            result.push_back(all[k].second);
        }
        return result;
    }

    /// Both ends of the least growth, in its units, and who proves the upper one.
    struct least_growth {
        double lower, upper; ///< lower 0: nothing is proved
        approximate_fit at;
        verified_inflation proved;
    };
    /// Brings a fit to about the least growth, by halving its logarithm.
    void approach(bound_growth const& by, double share, approximate_fit& at, double& high) const {
        double low = std::max(1.0, whole_.lower());
        while (high > low * (1 + precision) && go_on()) {
            double const middle = std::sqrt(low) * std::sqrt(high);
            auto const problem = by(*p_, (middle - 1) / share);
            auto next = approximate_fitter(problem, options_->go_on)({at.parameters});
            if (next.inflation > 1) {
                low = middle;
            } else {
                high = middle;
                at = std::move(next);
            }
        }
    }
    /// The least growth that a fit finds, proved from above by a witness and from below by a
    /// search.
    /// @param at    explains all data where some bound grows to `high` times its width
    [[nodiscard]] std::optional<least_growth> least(bound_growth const& by, approximate_fit at,
                                                    double high) const {
        double const share = by.greatest_share(*p_);
        approach(by, share, at, high);
        double const upper = high * (1 + slack);
        auto const grown_by = [&](double greatest) { return by(*p_, (greatest - 1) / share); };
        auto const problem = grown_by(upper);
        auto proved = verify_at(problem, at, options_->lower.test);
        if (!(proved.range.upper() <= 1) || !proved.witness) return std::nullopt;
        double const most = by.between(*p_, problem); // bounds were rounded outward
        if (!(most < detail::infinity)) return std::nullopt;
        double const lower = std::min(lower_end(by, share, at, upper), most);
        return least_growth{lower, most, std::move(at), std::move(proved)};
    }
    [[nodiscard]] std::optional<confined_gap> judged(found const& f) const {
        using traits = interval_traits<interval>;
        auto const& part = f.part;
        double const high = needed(part, f.others);
        if (!(high > 1)) return std::nullopt; // it explains all data
        auto const times = bound_growth::of(*p_, part);
        auto const known = least(times, f.others, high);
        if (!known) return std::nullopt;
        confined_gap result;
        if (part.channel) result.channel = p_->model.about.channels[*part.channel].name;
        for (auto const e : part.experiments) {
            result.scenarios.push_back(p_->experiments[e].name);
        }
        auto const factor =
            traits::add(traits::point(1.0), traits::bounds(known->lower, known->upper));
        result.factor = known->lower > 0 ? factor : traits::bounds(0.0, factor.upper());
        result.witness = witness_of(*known);
        result.assumptions = known->proved.assumptions;
        if (!part.channel) return result;
        result.steps = coarse_steps(*p_, part, times(*p_, known->upper));
        if (result.steps) return result; // errors of rounding, whatever they look like
        result.grows = likelier_growth(part, times, *known);
        result.correlated = correlation(part, times, *known);
        return result;
    }
    /// By least squares within the grown bounds: Chebyshev fits shape what they leave.
    [[nodiscard]] std::optional<error_correlation>
    correlation(data_part const& part, bound_growth const& times, least_growth const& known) const {
        auto const grown = times(*p_, known.upper);
        auto const at = approximate_fitter(grown, options_->go_on)({known.at.parameters, {}},
                                                                   fit_norm::squares);
        if (at.residuals.empty()) return std::nullopt;
        std::vector<error_sequence> records(grown.experiments.size());
        for (std::size_t e = 0; e < records.size(); ++e) {
            auto const data = sorted(grown.experiments[e].measurements);
            for (std::size_t k = 0; k < data.size(); ++k) {
                if (!part.holds(e, data[k])) continue;
                records[e].times.push_back(data[k].time);
                records[e].errors.push_back(at.residuals[e][k]);
            }
        }
        auto together = correlation_of(records);
        if (together) together->unit = p_->model.about.time_unit;
        return together;
    }
    [[nodiscard]] named_witness witness_of(least_growth const& g) const {
        return named(*p_, g.proved.witness->parameters, g.proved.witness->starts);
    }

    /// Noise of a channel that grows with what it shows, or with how fast that changes, where it is
    /// much likelier than bounds that are so many times as wide.
    [[nodiscard]] std::optional<noise_growth> likelier_growth(data_part const& part,
                                                              bound_growth const& times,
                                                              least_growth const& known) const {
        std::optional<noise_growth> best;
        double const cost = times.cost(*p_, known.upper);
        for (auto const what : {noise_growth::with::value, noise_growth::with::rate}) {
            if (!go_on()) break;
            // What is shown is taken at a fit that its own growth leads to.
            auto by = growth_with(what, part, known.at);
            auto at = known.at, shown = at;
            double high = 1 + widest;
            for (bool const last : {false, true}) {
                at = approximate_fitter(by(*p_, widest / by.greatest_share(*p_)),
                                        options_->go_on)({at.parameters});
                high = 1 + widest;
                if (last || at.inflation > 1) break;
                approach(by, by.greatest_share(*p_), at, high);
                by = growth_with(what, part, at);
                shown = at;
            }
            if (at.inflation > 1) continue;
            auto const own = least(by, std::move(at), high);
            if (!own) continue;
            double const likelier = cost - by.cost(*p_, own->upper);
            // ... and by more than the few largest errors decide by chance where tails are thin.
            if (!(likelier > clearly + std::sqrt(times.count())) ||
                (best && !(likelier > best->likelier)))
                continue;
            best = {what,
                    interval_traits<interval>::bounds(own->lower, own->upper),
                    likelier,
                    witness_of(*own),
                    named(*p_, shown.parameters, shown.starts),
                    what == noise_growth::with::rate ? p_->model.about.time_unit : "1"};
        }
        return best;
    }
    /// The size of what a channel shows at a fit, or of its rate, by central differences.
    [[nodiscard]] bound_growth growth_with(noise_growth::with what, data_part const& part,
                                           approximate_fit const& at) const {
        auto const there = approximate_fitter(*p_).at(at.parameters, at.starts);
        std::vector<std::map<double, double>> shown(p_->experiments.size()); // by time
        for (std::size_t e = 0; e < p_->experiments.size(); ++e) {
            auto const data = sorted(p_->experiments[e].measurements);
            for (std::size_t k = 0; k < data.size(); ++k) {
                auto const& m = data[k];
                if (part.holds(e, m))
                    shown[e][m.time] = mid(m.bound) + there.residuals[e][k] * rad(m.bound);
            }
        }
        auto result = bound_growth::of(*p_, part, [&](std::size_t e, std::size_t k) {
            auto const now = shown[e].find(p_->experiments[e].measurements[k].time);
            auto before = now, after = std::next(now);
            if (what == noise_growth::with::value) return std::abs(now->second);
            if (before != shown[e].begin()) --before;
            if (after == shown[e].end()) after = now;
            double const lasts = after->first - before->first;
            return lasts > 0 ? std::abs(after->second - before->second) / lasts : 0.0;
        });
        // What is lost in rounding would be a large share of next to nothing.
        double most = 0;
        for (auto const& own : result.reach)
            for (double const size : own) most = std::max(most, size);
        for (auto& own : result.reach)
            for (double& size : own) size = size > 1e-6 * most ? size : 0;
        return result;
    }
    /// By how much a part's bounds must grow at a fit, outliers included.
    [[nodiscard]] double needed(data_part const& part, approximate_fit const& f) const {
        double most = 1;
        for (std::size_t e = 0; e < p_->experiments.size(); ++e) {
            auto const data = sorted(p_->experiments[e].measurements);
            for (std::size_t k = 0; k < data.size(); ++k) {
                if (part.holds(e, data[k]))
                    most = std::max(most, nothing * std::abs(f.residuals[e][k]));
            }
        }
        return most;
    }
    /// Where no parameter explains the data with all bounds so wide, none does with some of them.
    /// @param share  the largest growth by one unit, as a share of a bound
    /// @param upper  times its width to which some bound grows
    [[nodiscard]] double lower_end(bound_growth const& by, double share, approximate_fit const& at,
                                   double upper) const {
        using traits = interval_traits<interval>;
        bool undefined = false;
        auto const above = traits::sub(traits::point(whole_.lower()), traits::point(1.0));
        double const known =
            whole_.lower() > 1
                ? std::max(0.0, traits::div(above, traits::point(share), undefined).lower())
                : 0;
        double const tried = ((1 - 2 * precision) * upper - 1) / share;
        if (!(tried > known) || p_->model.has_memory() || !go_on()) return known;
        auto search = options_->lower;
        search.only_verdict = true;
        auto const refuted = bound_inflation(by(*p_, tried), &at, search);
        return refuted.value.lower() > 1 ? tried : known;
    }

    identification_problem const* p_;
    approximate_fit const* fit_;
    inflation_range whole_;
    confinement_options const* options_;
};

} // namespace diagnosis_detail

SIVID_DECL std::vector<data_part> find_unexplained_parts(identification_problem const& p,
                                                         approximate_fit const& fit,
                                                         confinement_options const& options) {
    if (fit.parameters.size() != p.prior.size()) return {};
    return diagnosis_detail::gap_confinement(p, fit, unknown_inflation(), options).parts();
}

SIVID_DECL std::vector<confined_gap> find_confined_gaps(identification_problem const& p,
                                                        approximate_fit const& fit,
                                                        inflation_range const& whole,
                                                        confinement_options const& options) {
    if (fit.parameters.size() != p.prior.size()) return {};
    return diagnosis_detail::gap_confinement(p, fit, whole, options)();
}

} // namespace sivid

#endif
