// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_DIAGNOSIS_REPORT_IPP
#define SIVID_REPORT_IMPL_DIAGNOSIS_REPORT_IPP

#include <sivid/report/diagnosis_report.hpp>

#include <sivid/report/detail/reach_words.hpp>

namespace sivid::report {

namespace detail {

inline range drawn(interval const& x) { return {x.lower(), x.upper()}; }
inline range drawn(std::optional<interval> const& x) { return x ? drawn(*x) : range{}; }

inline estimate_view drawn(named_estimate const& e, std::map<std::string, interval> const& priors) {
    auto const prior = priors.find(e.name);
    return {e.name, e.unit, e.value, drawn(e.hull),
            prior == priors.end() ? drawn(e.prior) : drawn(prior->second)};
}

inline std::vector<named_value> drawn(std::vector<named_estimate> const& all) {
    std::vector<named_value> out;
    for (named_estimate const& e : all) out.push_back({e.name, e.unit, e.value});
    return out;
}

inline std::vector<share_of_gap> drawn_shares(std::vector<named_estimate> const& all) {
    std::vector<share_of_gap> out;
    for (named_estimate const& e : all) out.push_back({e.name, drawn(e.hull), e.value});
    return out;
}

inline holdout_view drawn(holdout_figures const& h) {
    auto const at = [](std::vector<double> const& all, std::size_t i) {
        return i < all.size() ? all[i] : std::nan("");
    };
    holdout_view out{.inflation_before = drawn(h.inflation_before),
                     .inflation_after = drawn(h.inflation_after),
                     .over_fits_before = drawn(h.over_fits_before),
                     .over_fits_after = drawn(h.over_fits_after)};
    for (std::size_t i = 0; i < h.channels.size(); ++i) {
        out.channels.push_back({h.channels[i], "", at(h.rmse_before, i), at(h.rmse_after, i)});
    }
    // A tube without width was not computed.
    if (h.width_before > 0 || h.width_after > 0) {
        out.covered_before = h.covered_before;
        out.covered_after = h.covered_after;
        out.width_before = h.width_before;
        out.width_after = h.width_after;
    }
    return out;
}

inline candidate_view drawn(cause const& c, std::map<std::string, interval> const& priors) {
    candidate_view out{.effects = c.effects,
                       .state = c.verdict == cause_verdict::explains   ? candidate_state::explains
                                : c.verdict == cause_verdict::excluded ? candidate_state::excluded
                                                                       : candidate_state::open,
                       .inflation = drawn(c.inflation),
                       .fitted = c.fitted_inflation,
                       .assumptions = c.assumptions};
    for (named_estimate const& e : c.parameters) out.parameters.push_back(drawn(e, priors));
    if (c.witness && c.verdict == cause_verdict::explains) {
        // What is called proved of the effect is so at the witness, wherever the fit lies.
        for (estimate_view& e : out.parameters) {
            for (named_estimate const& w : c.witness->parameters) {
                if (w.name == e.name) e.value = w.value, e.verified = true;
            }
        }
    }
    auto const times = [&](char const* what, std::vector<named_estimate> const& of) {
        for (named_estimate e : of) { // the witness begins, or ends, there
            e.name = what + e.name;
            out.parameters.push_back(drawn(e, priors));
            out.parameters.back().verified = c.verdict == cause_verdict::explains;
        }
    };
    times("onset in ", c.onsets);
    times("end in ", c.ends);
    if (c.witness) {
        witness_view w{.parameters = drawn(c.witness->parameters)};
        for (auto const& s : c.witness->starts) w.initial.push_back({s.scenario, drawn(s.states)});
        out.witness = std::move(w);
    }
    if (c.holdout) out.holdout = drawn(*c.holdout);
    return out;
}

inline std::vector<point> line_of(std::vector<double> const& times, std::vector<double> const& v) {
    std::vector<point> out;
    for (std::size_t k = 0; k < std::min(times.size(), v.size()); ++k) {
        out.push_back({times[k], v[k]});
    }
    return out;
}

inline comparison_series drawn(channel_data const& c, std::vector<double> const& line_times) {
    comparison_series out{.name = c.name, .unit = c.unit, .tube = c.tube};
    std::size_t const n = std::min({c.times.size(), c.values.size(), c.bounds.size()});
    for (std::size_t k = 0; k < n; ++k) {
        bool const suspect = k < c.outliers.size() && c.outliers[k];
        double const y = c.values[k], e = c.bounds[k];
        out.measured.push_back({.time = c.times[k],
                                .value = {y - e, y + e},
                                .state = suspect ? sample_state::suspect : sample_state::regular});
        if (k < c.base.size() && !suspect) {
            out.misfit_before.push_back({c.times[k], std::fabs(c.base[k] - y) / e});
        }
        if (k < c.after.size() && !suspect) {
            out.misfit_after.push_back({c.times[k], std::fabs(c.after[k] - y) / e});
        }
    }
    out.before = c.base_line.empty() ? line_of(c.times, c.base) : line_of(line_times, c.base_line);
    out.after =
        c.after_line.empty() ? line_of(c.times, c.after) : line_of(line_times, c.after_line);
    return out;
}

inline missing_rate_series drawn(missing_rate_data const& m) {
    missing_rate_series out{.equation = m.equation, .scenario = m.scenario, .unit = m.unit};
    for (std::size_t k = 0; k < std::min(m.times.size(), m.values.size()); ++k) {
        rate_sample s{.time = m.times[k], .value = m.values[k]};
        if (k < m.uncertainty.size()) {
            s.band = {m.values[k] - m.uncertainty[k], m.values[k] + m.uncertainty[k]};
        }
        out.estimate.push_back(s);
    }
    for (auto const& w : m.windows) out.certified.push_back({w.from, w.to, drawn(w.missing)});
    return out;
}

} // namespace detail

SIVID_DECL void describe(std::vector<effect> const& catalogue, diagnosis_report_options& options) {
    auto const add = [&options](effect const& e) {
        options.meanings.emplace(e.name, e.about);
        for (effect_parameter const& p : e.parameters)
            options.priors.emplace(e.name + "." + p.name, p.prior());
    };
    for (effect const& e : catalogue) {
        add(e);
        add(widened(e));
    }
}

SIVID_DECL diagnosis_view view_of(diagnosis const& d, diagnosis_plot_data const& plots,
                                  diagnosis_report_options const& options) {
    diagnosis_view v{.dataset = options.dataset,
                     .model = options.model,
                     .meanings = options.meanings,
                     .gap = d.gap == gap_verdict::none        ? gap_state::absent
                            : d.gap == gap_verdict::certified ? gap_state::present
                                                              : gap_state::open,
                     .inflation = detail::drawn(d.inflation),
                     .fitted = options.base_fitted,
                     .why = reach_words(d.reach),
                     .scenario_gaps = detail::drawn_shares(d.scenario_inflation),
                     .channel_gaps = detail::drawn_shares(d.channel_inflation),
                     .answer = d.answer == answer_kind::none      ? answer_state::nothing
                               : d.answer == answer_kind::effects ? answer_state::effects
                               : d.answer == answer_kind::open    ? answer_state::open
                                                                  : answer_state::unexplained,
                     .singles = {d.tried.singles.tried, d.tried.singles.planned},
                     .pairs = {d.tried.pairs.tried, d.tried.pairs.planned},
                     .larger = {d.tried.larger.tried, d.tried.larger.planned},
                     .effects = d.effects,
                     .formulas = d.change.lines,
                     .symbols = d.change.symbols,
                     .indistinguishable = d.indistinguishable,
                     .unobservable = d.unobservable,
                     .absorbed = options.absorbed,
                     .shrink_fit = detail::drawn(d.shrink_fit),
                     .shrink_holdout = detail::drawn(d.shrink_holdout),
                     .shrink_over_fits = detail::drawn(d.shrink_over_fits),
                     .after = options.after,
                     .assumptions = d.assumptions,
                     .warnings = options.warnings,
                     .interrupted = d.interrupted,
                     .seconds = d.seconds,
                     .version = std::string{"sivid "} + std::string{version},
                     .date = options.date,
                     .machine = options.machine,
                     .command = options.command};
    auto const window = [](time_window const& w) { return window_view{w.scenario, w.from, w.to}; };
    auto const place = [&](suspected_place const& p) {
        return place_view{p.kind,     p.name, p.proved, window(p.where), detail::drawn(p.missing),
                          p.estimate, p.unit, p.law,    p.regime,        p.alternatives};
    };
    for (confined_gap const& c : d.confined) {
        v.confined.push_back({c.channel, c.scenarios, detail::drawn(c.factor)});
        auto& own = v.confined.back();
        if (c.correlated) own.together_for = c.correlated->seconds;
        if (c.steps)
            own.step = c.steps->size, own.cut_off = c.steps->cut_off, own.unit = c.steps->unit;
        if (!c.grows) continue;
        own.grows = c.grows->what == noise_growth::with::rate ? confined_view::growth::rate
                                                              : confined_view::growth::value;
        own.coefficient = detail::drawn(c.grows->coefficient);
    }
    for (suspected_place const& p : d.where) v.places.push_back(place(p));
    for (broken_relation_report const& r : d.relations) {
        relation_view out{r.equation, r.sensors, r.proved, {}, r.assumptions};
        for (time_window const& w : r.windows) out.windows.push_back(window(w));
        v.relations.push_back(std::move(out));
    }
    for (named_estimate const& c : d.constants) {
        v.constants.push_back(detail::drawn(c, options.priors));
        v.constants.back().verified = d.constants_verified;
    }
    for (named_combination const& c : d.combinations) {
        v.combinations.push_back({detail::drawn(c.about, {}), c.of_effects});
        v.combinations.back().product.verified = d.constants_verified;
    }
    for (constant_at_end const& a : d.at_ends) {
        v.at_ends.push_back(
            {a.effects, detail::drawn(a.constant, options.priors), a.end == prior_end::upper});
    }
    for (cause const& c : d.causes) v.candidates.push_back(detail::drawn(c, options.priors));
    if (!v.candidates.empty() && find_candidate(v, {}) == nullptr) {
        // What the others are measured by.
        v.candidates.push_back({.state = v.gap == gap_state::present  ? candidate_state::excluded
                                         : v.gap == gap_state::absent ? candidate_state::explains
                                                                      : candidate_state::open,
                                .inflation = v.inflation});
    }
    for (candidate_view& c : v.candidates) {
        if (c.effects.empty() && !is_fitted(c.fitted)) c.fitted = v.fitted;
    }
    if (d.remainder) {
        remainder_view rest{.effects = d.remainder->effects,
                            .inflation = detail::drawn(d.remainder->inflation)};
        if (auto const* c = find_candidate(v, rest.effects)) rest.fitted = c->fitted;
        for (suspected_place const& p : d.remainder->where) rest.places.push_back(place(p));
        for (auto const& m : plots.remaining_rates) rest.missing_rates.push_back(detail::drawn(m));
        v.remainder = std::move(rest);
    }
    if (d.next) {
        v.next = next_experiment_view{d.next->manoeuvre, detail::drawn(d.next->settings),
                                      d.next->separation, d.next->recorded};
    }
    std::map<std::string, std::string> units;
    for (scenario_data const& s : plots.scenarios) {
        compared_scenario out{s.name, s.holdout, {}};
        for (channel_data const& c : s.channels) {
            out.channels.push_back(detail::drawn(c, s.line_times));
            units[c.name] = c.unit;
        }
        v.scenarios.push_back(std::move(out));
    }
    for (candidate_view& c : v.candidates) {
        if (!c.holdout) continue;
        for (auto& channel : c.holdout->channels) channel.unit = units[channel.name];
    }
    for (auto const& m : plots.missing_rates) v.missing_rates.push_back(detail::drawn(m));
    return v;
}

} // namespace sivid::report

#endif
