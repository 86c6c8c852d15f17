// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DIAGNOSIS_JSON_HPP
#define SIVID_IO_DIAGNOSIS_JSON_HPP

#include <sivid/compiled.hpp>
#include <sivid/diagnosis/diagnosis.hpp>
#include <sivid/io/result/reach_json.hpp>
#include <sivid/io/text/json_writer.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sivid {

namespace io_detail {

/// Writes one diagnosis part by part.
class diagnosis_writer {
public:
    explicit diagnosis_writer(diagnosis const& d) : d_(&d) {}

    [[nodiscard]] std::string text(std::string const& dataset) {
        json_.begin_object();
        json_.key("format").string("sivid-diagnosis-1").key("dataset").string(dataset);
        gap();
        relations();
        where();
        causes();
        answer();
        json_.key("shrink").begin_object(one_line);
        maybe("fit", d_->shrink_fit);
        maybe("holdout", d_->shrink_holdout);
        maybe("holdout_over_fits", d_->shrink_over_fits);
        json_.end_object();
        remainder();
        next();
        strings("unobservable", d_->unobservable);
        strings("assumptions", d_->assumptions);
        withdrawn();
        json_.key("interrupted").boolean(d_->interrupted);
        json_.key("seconds").nearest(d_->seconds);
        json_.end_object();
        return json_.text();
    }

private:
    static constexpr auto one_line = json_writer::layout::one_line;

    void strings(char const* key, std::vector<std::string> const& all) {
        json_.key(key).begin_array(one_line);
        for (auto const& s : all) json_.string(s);
        json_.end_array();
    }
    void maybe(std::string const& key, std::optional<interval> const& x) {
        json_.key(key);
        x ? (void)json_.bounds(*x) : (void)json_.null();
    }
    void text_or_null(char const* key, std::string const& s) {
        json_.key(key);
        s.empty() ? (void)json_.null() : (void)json_.string(s);
    }
    /// {"name": [lower, upper], ...}
    void hulls(char const* key, std::vector<named_estimate> const& all) {
        json_.key(key).begin_object(one_line);
        for (auto const& e : all) maybe(e.name, e.hull);
        json_.end_object();
    }
    /// {"name": value, ...}
    void values(char const* key, std::vector<named_estimate> const& all) {
        json_.key(key).begin_object(one_line);
        for (auto const& e : all) json_.key(e.name).nearest(e.value);
        json_.end_object();
    }

    void gap() {
        json_.key("gap").begin_object();
        json_.key("verdict").string(to_string(d_->gap));
        json_.key("inflation").bounds(d_->inflation);
        hulls("scenarios", d_->scenario_inflation);
        hulls("channels", d_->channel_inflation);
        confined();
        write_reach(json_, d_->reach);
        json_.end_object();
    }
    void confined() {
        json_.key("confined").begin_array();
        for (auto const& c : d_->confined) {
            json_.begin_object();
            text_or_null("channel", c.channel);
            strings("scenarios", c.scenarios);
            json_.key("factor").bounds(c.factor);
            witness(c.witness);
            strings("assumptions", c.assumptions);
            json_.key("grows");
            if (c.grows) {
                bool const rate = c.grows->what == noise_growth::with::rate;
                json_.begin_object();
                json_.key("with").string(rate ? "rate" : "value");
                json_.key("unit").string(rate ? "s" : "1");
                json_.key("coefficient").bounds(c.grows->coefficient);
                json_.key("likelier").nearest(c.grows->likelier);
                witness(c.grows->witness);
                witness(c.grows->shown, "shown");
                json_.end_object();
            } else {
                json_.null();
            }
            json_.key("correlated");
            if (c.correlated) {
                json_.begin_object();
                json_.key("of_neighbours").nearest(c.correlated->of_neighbours);
                json_.key("seconds").nearest(c.correlated->seconds);
                json_.end_object();
            } else {
                json_.null();
            }
            json_.key("steps");
            if (c.steps) {
                json_.begin_object(one_line);
                json_.key("size").nearest(c.steps->size).key("unit").string(c.steps->unit);
                json_.key("cut_off").boolean(c.steps->cut_off).end_object();
            } else {
                json_.null();
            }
            json_.end_object();
        }
        json_.end_array();
    }
    void relations() {
        json_.key("relations").begin_array();
        for (auto const& r : d_->relations) {
            json_.begin_object();
            json_.key("equation").string(r.equation);
            strings("sensors", r.sensors);
            json_.key("proved").boolean(r.proved);
            json_.key("definition").boolean(r.definition);
            strings("assumptions", r.assumptions);
            json_.key("windows").begin_array();
            for (auto const& w : r.windows) {
                json_.begin_object(one_line).key("scenario").string(w.scenario);
                json_.key("from").nearest(w.from).key("to").nearest(w.to).end_object();
            }
            json_.end_array().end_object();
        }
        json_.end_array();
    }
    void where() { where(d_->where); }
    void where(std::vector<suspected_place> const& places) {
        json_.key("where").begin_array();
        for (auto const& p : places) {
            json_.begin_object();
            json_.key("kind").string(p.kind).key("name").string(p.name);
            json_.key("proved").boolean(p.proved).key("scenario").string(p.where.scenario);
            json_.key("from").nearest(p.where.from).key("to").nearest(p.where.to);
            maybe("missing", p.missing);
            json_.key("estimate");
            p.estimate ? (void)json_.nearest(*p.estimate) : (void)json_.null();
            json_.key("unit").string(p.unit);
            text_or_null("law", p.law);
            text_or_null("regime", p.regime);
            strings("alternatives", p.alternatives);
            strings("assumptions", p.assumptions);
            json_.end_object();
        }
        json_.end_array();
    }
    /// {"S1": {"value": t, "hull": [lower, upper], "prior": [begin, end]}, ...}
    void times(char const* key, std::vector<named_estimate> const& all) {
        json_.key(key).begin_object();
        for (auto const& o : all) {
            json_.key(o.name).begin_object(one_line).key("value").nearest(o.value);
            maybe("hull", o.hull);
            maybe("prior", o.prior);
            json_.end_object();
        }
        json_.end_object();
    }
    void witness(std::optional<named_witness> const& w, std::string const& key = "witness") {
        json_.key(key);
        if (!w) {
            json_.null();
            return;
        }
        json_.begin_object();
        values("parameters", w->parameters);
        json_.key("initial").begin_object();
        for (auto const& s : w->starts) {
            json_.key(s.scenario).begin_object(one_line);
            for (auto const& x : s.states) json_.key(x.name).nearest(x.value);
            json_.end_object();
        }
        json_.end_object().end_object();
    }
    void per_channel(char const* key, std::vector<std::string> const& names,
                     std::vector<double> const& v) {
        json_.key(key).begin_object(one_line);
        for (std::size_t i = 0; i < names.size() && i < v.size(); ++i) {
            json_.key(names[i]).nearest(v[i]);
        }
        json_.end_object();
    }
    void holdout(std::optional<holdout_figures> const& h) {
        json_.key("holdout");
        if (!h) {
            json_.null();
            return;
        }
        json_.begin_object();
        json_.key("inflation_before").bounds(h->inflation_before);
        json_.key("inflation_after").bounds(h->inflation_after);
        maybe("over_fits_before", h->over_fits_before);
        maybe("over_fits_after", h->over_fits_after);
        per_channel("rmse_before", h->channels, h->rmse_before);
        per_channel("rmse_after", h->channels, h->rmse_after);
        json_.key("covered_before").nearest(h->covered_before);
        json_.key("covered_after").nearest(h->covered_after);
        json_.key("tube_width_before").nearest(h->width_before);
        json_.key("tube_width_after").nearest(h->width_after);
        json_.end_object();
    }
    void causes() {
        json_.key("causes").begin_array();
        for (auto const& c : d_->causes) {
            json_.begin_object();
            strings("effects", c.effects);
            json_.key("verdict").string(to_string(c.verdict));
            json_.key("inflation").bounds(c.inflation);
            json_.key("fitted_inflation").nearest(c.fitted_inflation);
            json_.key("score").nearest(c.score);
            hulls("parameters", c.parameters);
            values("estimates", c.parameters);
            times("onsets", c.onsets);
            times("ends", c.ends);
            witness(c.witness);
            strings("assumptions", c.assumptions);
            strings("untouched", c.untouched);
            text_or_null("excluded_by", c.excluded_by);
            holdout(c.holdout);
            json_.end_object();
        }
        json_.end_array();
    }
    void tried(char const* key, tried_candidates::count const& c) {
        json_.key(key).begin_object(one_line);
        json_.key("tried").integer(c.tried).key("planned").integer(c.planned).end_object();
    }
    /// {"name": {"value": v, "prior": [lower, upper], "hull": null, "end": null}, ...}
    void constants() {
        json_.key("constants").begin_object();
        for (auto const& c : d_->constants) {
            json_.key(c.name).begin_object(one_line).key("value").nearest(c.value);
            maybe("prior", c.prior);
            maybe("hull", c.hull);
            auto const end = c.prior ? end_of_prior(c.value, *c.prior) : prior_end::none;
            json_.key("end");
            end == prior_end::none ? (void)json_.null() : (void)json_.string(to_string(end));
            json_.end_object();
        }
        json_.end_object();
    }
    /// [{"formula": "k/Iz", "factors": {"e.k": 1, "Iz": -1}, "value": v, "unit": u,
    ///   "hull": [lower, upper], "prior": [lower, upper]}, ...]; a sum has "terms"
    void combinations() {
        json_.key("combinations").begin_array();
        for (auto const& c : d_->combinations) {
            json_.begin_object(one_line).key("formula").string(c.about.name);
            json_.key(c.is_sum ? "terms" : "factors").begin_object(one_line);
            for (auto const& f : c.parts) json_.key(f.name).integer(f.number);
            json_.end_object();
            json_.key("value").nearest(c.about.value).key("unit").string(c.about.unit);
            maybe("hull", c.about.hull);
            maybe("prior", c.about.prior);
            json_.end_object();
        }
        json_.end_array();
    }
    void answer() {
        json_.key("answer").begin_object();
        json_.key("kind").string(to_string(d_->answer));
        strings("effects", d_->effects);
        json_.key("tried").begin_object();
        tried("singles", d_->tried.singles);
        tried("pairs", d_->tried.pairs);
        tried("larger", d_->tried.larger);
        json_.end_object();
        constants();
        combinations();
        strings("formulas", d_->change.lines);
        json_.key("symbols").begin_object(one_line);
        for (auto const& [name, symbol] : d_->change.symbols) json_.key(name).string(symbol);
        json_.end_object();
        json_.key("verified").boolean(d_->constants_verified);
        json_.key("at_ends").begin_array();
        for (auto const& a : d_->at_ends) {
            json_.begin_object(one_line);
            strings("effects", a.effects);
            json_.key("constant").string(a.constant.name).key("end").string(to_string(a.end));
            json_.key("value").nearest(a.constant.value);
            maybe("prior", a.constant.prior);
            json_.end_object();
        }
        json_.end_array();
        json_.key("indistinguishable").begin_array();
        for (auto const& other : d_->indistinguishable) {
            json_.begin_array(one_line);
            for (auto const& e : other) json_.string(e);
            json_.end_array();
        }
        json_.end_array().end_object();
    }
    void remainder() {
        json_.key("remainder");
        if (!d_->remainder) {
            json_.null();
            return;
        }
        json_.begin_object();
        strings("effects", d_->remainder->effects);
        json_.key("inflation").bounds(d_->remainder->inflation);
        where(d_->remainder->where);
        json_.end_object();
    }
    void withdrawn() {
        json_.key("withdrawn").begin_array();
        for (auto const& w : d_->withdrawn) {
            json_.begin_object(one_line).key("claim").string(w.claim);
            json_.key("reason").string(w.reason).end_object();
        }
        json_.end_array();
    }
    void next() {
        json_.key("next");
        if (!d_->next) {
            json_.null();
            return;
        }
        json_.begin_object();
        json_.key("manoeuvre").string(d_->next->manoeuvre);
        values("settings", d_->next->settings);
        json_.key("separation").nearest(d_->next->separation);
        json_.key("recorded").boolean(d_->next->recorded);
        json_.end_object();
    }

    diagnosis const* d_;
    json_writer json_;
};

} // namespace io_detail

/// The text of `diagnosis.json` in the format sivid-diagnosis-1.
/// @guarantee  bounds are printed outward; the witness's numbers read back as the doubles that were
///             verified
[[nodiscard]] SIVID_DECL std::string diagnosis_json(diagnosis const& d, std::string const& dataset);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/impl/diagnosis_json.ipp>
#endif

#endif
