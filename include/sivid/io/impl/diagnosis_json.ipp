// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_DIAGNOSIS_JSON_IPP
#define SIVID_IO_IMPL_DIAGNOSIS_JSON_IPP

#include <sivid/io/diagnosis_json.hpp>

#include <sivid/io/result/journal_json.hpp>
#include <sivid/io/result/reach_json.hpp>
#include <sivid/io/text/json_writer.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sivid {

namespace io_detail {

/// Writes one diagnosis part by part.
class diagnosis_writer {
public:
    explicit diagnosis_writer(diagnosis const& d) : d_(&d) {}

    [[nodiscard]] std::string text(std::string const& dataset, diagnosis_source const& source) {
        json_.begin_object().members("format", "sivid-diagnosis-1", "dataset", dataset);
        if (!source.digest.empty())
            json_.key("source").object("folder", source.folder, "sha256", source.digest);
        if (!source.problem.empty()) json_.members("problem", source.problem);
        json_.members("time_unit", d_->time_unit);
        gap();
        relations();
        places(d_->where);
        causes();
        answer();
        json_.key("shrink").object("fit", d_->shrink_fit, "holdout", d_->shrink_holdout,
                                   "holdout_over_fits", d_->shrink_over_fits);
        json_.maybe("remainder", d_->remainder, [&](unexplained_remainder const& r) {
            json_.begin_object().members("effects", r.effects, "inflation", r.inflation);
            places(r.where);
            json_.list("disturbances", r.disturbances, [&](needed_disturbance const& n) {
                json_.begin_object().members("equation", n.equation, "unit", n.unit);
                json_.members("size", n.size);
                windows("reached", n.reached);
                windows("strongest", n.strongest);
                json_.members("regime", n.regime, "seconds", n.seconds).end_object();
            });
            json_.end_object();
        });
        json_.maybe("next", d_->next, [&](next_experiment const& n) {
            json_.begin_object().members("manoeuvre", n.manoeuvre);
            json_.named("settings", n.settings, value);
            json_.members("separation", n.separation, "recorded", n.recorded).end_object();
        });
        json_.members("unobservable", d_->unobservable, "assumptions", d_->assumptions);
        json_.list("withdrawn", d_->withdrawn, [&](withdrawn_claim const& w) {
            json_.object("claim", w.claim, "reason", w.reason);
        });
        json_.members("interrupted", d_->interrupted, "seconds", d_->seconds);
        if (d_->by_clock) json_.members("by_clock", true);
        json_.end_object();
        return json_.text();
    }

private:
    static constexpr auto one_line = json_writer::layout::one_line;
    static constexpr auto value = &named_estimate::value;
    static constexpr auto hull = &named_estimate::hull;

    static std::optional<std::string_view> unless_empty(std::string const& s) {
        return s.empty() ? std::nullopt : std::optional<std::string_view>{s};
    }

    void gap() {
        json_.key("gap").begin_object();
        json_.members("verdict", to_string(d_->gap), "inflation", d_->inflation);
        witness("witness", d_->witness);
        json_.named("scenarios", d_->scenario_inflation, hull);
        json_.named("channels", d_->channel_inflation, hull);
        json_.list("confined", d_->confined, [&](confined_gap const& c) { confined(c); });
        write_reach(json_, d_->reach);
        json_.end_object();
    }
    void confined(confined_gap const& c) {
        json_.begin_object().members("channel", unless_empty(c.channel));
        json_.members("scenarios", c.scenarios, "factor", c.factor);
        witness("witness", c.witness);
        json_.members("assumptions", c.assumptions);
        json_.maybe("grows", c.grows, [&](noise_growth const& g) {
            bool const rate = g.what == noise_growth::with::rate;
            json_.begin_object().members("with", rate ? "rate" : "value");
            json_.members("unit", g.unit);
            json_.members("coefficient", g.coefficient, "likelier", g.likelier);
            witness("witness", g.witness);
            witness("shown", g.shown);
            json_.end_object();
        });
        json_.maybe("correlated", c.correlated, [&](error_correlation const& r) {
            json_.object("of_neighbours", r.of_neighbours, "seconds", r.seconds, "unit", r.unit);
        });
        json_.maybe("steps", c.steps, [&](reading_steps const& s) {
            json_.object("size", s.size, "unit", s.unit, "cut_off", s.cut_off);
        });
        json_.end_object();
    }
    void relations() {
        json_.list("relations", d_->relations, [&](broken_relation_report const& r) {
            json_.begin_object().members("equation", r.equation, "sensors", r.sensors);
            json_.members("proved", r.proved, "definition", r.definition);
            json_.members("assumptions", r.assumptions);
            windows("windows", r.windows);
            json_.end_object();
        });
    }
    void windows(std::string_view key, std::vector<time_window> const& all) {
        json_.list(key, all, [&](time_window const& w) {
            json_.object("scenario", w.scenario, "from", w.from, "to", w.to);
        });
    }
    void places(std::vector<suspected_place> const& all) {
        json_.list("where", all, [&](suspected_place const& p) {
            json_.begin_object().members("kind", p.kind, "name", p.name, "proved", p.proved);
            json_.members("scenario", p.where.scenario, "from", p.where.from, "to", p.where.to);
            json_.members("missing", p.missing, "estimate", p.estimate, "unit", p.unit);
            json_.members("law", unless_empty(p.law), "regime", unless_empty(p.regime));
            json_.members("alternatives", p.alternatives, "assumptions", p.assumptions);
            json_.end_object();
        });
    }
    /// {"S1": {"value": t, "hull": [lower, upper], "prior": [begin, end]}, ...}
    void times(char const* key, std::vector<named_estimate> const& all) {
        json_.named(key, all, [&](named_estimate const& t) {
            json_.object("value", t.value, "hull", t.hull, "prior", t.prior);
        });
    }
    void witness(char const* key, std::optional<named_witness> const& found) {
        json_.maybe(key, found, [&](named_witness const& w) {
            json_.begin_object().named("parameters", w.parameters, value);
            json_.key("initial").begin_object();
            for (auto const& s : w.starts) json_.named(s.scenario, s.states, value);
            json_.end_object().end_object();
        });
    }
    void holdout(holdout_figures const& h) {
        json_.begin_object();
        json_.members("inflation_before", h.inflation_before, "inflation_after", h.inflation_after);
        json_.members("over_fits_before", h.over_fits_before, "over_fits_after", h.over_fits_after);
        json_.named("rmse_before", h.channels, h.rmse_before);
        json_.named("rmse_after", h.channels, h.rmse_after);
        json_.members("covered_before", h.covered_before, "covered_after", h.covered_after);
        json_.members("tube_width_before", h.width_before, "tube_width_after", h.width_after);
        json_.end_object();
    }
    void causes() {
        json_.list("causes", d_->causes, [&](cause const& c) {
            json_.begin_object().members("effects", c.effects, "verdict", to_string(c.verdict));
            json_.members("inflation", c.inflation, "fitted_inflation", c.fitted_inflation);
            json_.members("score", c.score);
            json_.named("parameters", c.parameters, hull).named("estimates", c.parameters, value);
            times("onsets", c.onsets);
            times("ends", c.ends);
            witness("witness", c.witness);
            json_.members("assumptions", c.assumptions, "untouched", c.untouched);
            json_.members("excluded_by", unless_empty(c.excluded_by));
            json_.maybe("holdout", c.holdout, [&](holdout_figures const& h) { holdout(h); });
            json_.end_object();
        });
    }
    void tried(char const* key, tried_candidates::count const& c) {
        json_.key(key).object("tried", c.tried, "planned", c.planned);
    }
    /// {"name": {"value": v, "prior": [lower, upper], "hull": null, "end": null}, ...}
    void constants() {
        json_.named("constants", d_->constants, [&](named_estimate const& c) {
            auto const end = c.prior ? end_of_prior(c.value, *c.prior) : prior_end::none;
            json_.object("value", c.value, "prior", c.prior, "hull", c.hull, "end",
                         end == prior_end::none ? std::nullopt : std::optional{to_string(end)});
        });
    }
    /// [{"formula": "k/Iz", "factors": {"e.k": 1, "Iz": -1}, "value": v, "unit": u,
    ///   "hull": [lower, upper], "prior": [lower, upper]}, ...]; a sum has "terms"
    void combinations() {
        json_.list("combinations", d_->combinations, [&](named_combination const& c) {
            json_.begin_object(one_line).members("formula", c.about.name);
            json_.named(c.is_sum ? "terms" : "factors", c.parts, &named_combination::part::number);
            json_.members("value", c.about.value, "unit", c.about.unit);
            json_.members("hull", c.about.hull, "prior", c.about.prior).end_object();
        });
    }
    void answer() {
        json_.key("answer").begin_object();
        json_.members("kind", to_string(d_->answer), "effects", d_->effects);
        json_.key("tried").begin_object();
        tried("singles", d_->tried.singles);
        tried("pairs", d_->tried.pairs);
        tried("larger", d_->tried.larger);
        json_.end_object();
        constants();
        combinations();
        write_journal(json_, d_->journal);
        json_.members("formulas", d_->change.lines).named("symbols", d_->change.symbols);
        json_.members("verified", d_->constants_verified);
        json_.list("at_ends", d_->at_ends, [&](constant_at_end const& a) {
            json_.object("effects", a.effects, "constant", a.constant.name, "end", to_string(a.end),
                         "value", a.constant.value, "prior", a.constant.prior);
        });
        json_.members("indistinguishable", d_->indistinguishable).end_object();
    }

    diagnosis const* d_;
    json_writer json_;
};

} // namespace io_detail

SIVID_DECL std::string diagnosis_json(diagnosis const& d, std::string const& dataset,
                                      diagnosis_source const& source) {
    return io_detail::diagnosis_writer(d).text(dataset, source);
}

} // namespace sivid

#endif
