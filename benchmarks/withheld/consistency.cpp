// SPDX-License-Identifier: MIT
#include "consistency.hpp"
#include "catalogue.hpp"
#include "confined.hpp"
#include "places.hpp"
#include "reading.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace withheld {

namespace {

constexpr double digits = 1e-9; // bounds are printed outward, and with all their digits

struct told_cause {
    names effects;
    std::string verdict;
    bounds inflation;
    json about;
};

class file_check {
public:
    explicit file_check(json const& d) : d_(&d) {
        gap_ = text_of(member(member(d, "gap"), "verdict"));
        base_ = bounds_in(member(member(d, "gap"), "inflation")).value_or(bounds{});
        for (auto const& c : member(d, "causes"))
            causes_.push_back({names_in(member(c, "effects")), text_of(member(c, "verdict")),
                               bounds_in(member(c, "inflation")).value_or(bounds{}), c});
    }

    std::vector<finding> operator()() {
        verdicts();
        relations();
        places();
        causes();
        parts();
        confined();
        answer();
        shrink();
        return std::move(found_);
    }

private:
    void add(char const* kind, std::string about) { found_.push_back({kind, std::move(about)}); }

    /// Verdicts say no other than the inflations.
    void verdicts() {
        if (base_.lower > base_.upper) add("verdict", "inflation of the model " + text_of(base_));
        if ((gap_ == "none" && !(base_.upper <= 1)) || (gap_ == "none" && base_.lower > 1) ||
            (gap_ == "certified" && base_.upper <= 1))
            add("verdict", "gap " + gap_ + " with inflation " + text_of(base_));
        for (auto const& c : causes_) {
            bool const wrong = c.inflation.lower > c.inflation.upper ||
                               (c.verdict == "explains" && !(c.inflation.upper <= 1)) ||
                               (c.verdict == "excluded" && c.inflation.upper <= 1);
            if (wrong)
                add("verdict", joined(c.effects) + ' ' + c.verdict + " with inflation " +
                                   text_of(c.inflation));
        }
    }

    /// An explanation that leaves a relation as it is keeps it; no effect leaves all as they are.
    void relations() {
        for (auto const& r : member(*d_, "relations")) {
            if (member(r, "proved") != true) continue;
            auto const equation = text_of(member(r, "equation"));
            auto const sensors = names_in(member(r, "sensors"));
            if (gap_ == "none") add("relation", relation_text(r) + " beside gap none");
            for (auto const& c : causes_)
                if (c.verdict == "explains" && !touches(places_of(c.effects), equation, sensors))
                    add("relation", relation_text(r) + " beside " + joined(c.effects));
            explained_alone(r);
        }
    }

    /// A relation refuted by one scenario, which the model explains by itself.
    void explained_alone(json const& relation) {
        names scenarios;
        for (auto const& w : member(relation, "windows"))
            scenarios.insert(text_of(member(w, "scenario")));
        if (scenarios.size() != 1) return;
        auto const alone =
            number(member(member(member(*d_, "gap"), "scenarios"), *scenarios.begin()), 1);
        if (alone && *alone <= 1)
            add("relation",
                relation_text(relation) + " beside " + *scenarios.begin() + ", explained alone");
    }

    void places() {
        for (auto const& w : member(*d_, "where")) {
            auto const missing = bounds_in(member(w, "missing"));
            auto const estimate = member(w, "estimate");
            bool const proved = member(w, "proved") == true;
            bool const zero = missing && missing->contains(0, 0);
            if (proved && zero) add("zero", place_text(w) + " lacks " + text_of(*missing));
            if (missing && estimate.is_number() &&
                !missing->contains(estimate.get<double>(), digits))
                add("estimate", place_text(w) + " lacks " + text_of(*missing) + ", estimated " +
                                    short_text(estimate.get<double>()));
            if (!proved && (!missing || zero)) continue;
            if (gap_ == "none") add("place", place_text(w) + " beside gap none");
            for (auto const& c : causes_)
                if (c.verdict == "explains" &&
                    !holds_instrument(places_of(c.effects), text_of(member(w, "kind")),
                                      text_of(member(w, "name"))))
                    add("place", place_text(w) + " beside " + joined(c.effects));
        }
    }

    void causes() {
        for (auto const& c : causes_) {
            if (gap_ == "none" && c.verdict == "excluded")
                add("excluded", joined(c.effects) + " beside gap none");
            if (c.inflation.lower > base_.upper + digits)
                add("inflation", joined(c.effects) + ' ' + text_of(c.inflation) +
                                     " beside no effect " + text_of(base_));
            for (auto const& s : causes_) {
                if (s.effects == c.effects || !includes(c.effects, s.effects)) continue;
                if (c.verdict == "excluded" && s.verdict == "explains")
                    add("excluded", joined(c.effects) + " beside " + joined(s.effects));
                if (c.inflation.lower > s.inflation.upper + digits)
                    add("inflation", joined(c.effects) + ' ' + text_of(c.inflation) + " beside " +
                                         joined(s.effects) + ' ' + text_of(s.inflation));
            }
            witness(c);
        }
    }

    /// A witness that explains the data lies in the hulls; its hold-out figure among all fits'.
    void witness(told_cause const& c) {
        auto const values = member(member(c.about, "witness"), "parameters");
        if (c.verdict == "explains") hulls(member(c.about, "parameters"), values);
        times(c, "onsets", &episode::from);
        times(c, "ends", &episode::to);
        auto const answer = member(*d_, "answer");
        bool const answered =
            member(answer, "kind") == "effects" && names_in(member(answer, "effects")) == c.effects;
        if (answered) {
            hulls(member(answer, "constants"), values);
            products(member(answer, "combinations"), values);
            verified_constants(answer, values);
        }
        auto const holdout = member(c.about, "holdout");
        for (std::string const when : {"before", "after"}) {
            auto const at = bounds_in(member(holdout, "inflation_" + when));
            auto const over = bounds_in(member(holdout, "over_fits_" + when));
            if (at && over &&
                (over->lower > at->upper + digits || over->upper < at->lower - digits))
                add("holdout", joined(c.effects) + ' ' + when + ", at the witness " + text_of(*at) +
                                   ", over all fits " + text_of(*over));
        }
    }

    /// The times that the name says explain the data: they lie in their windows.
    void times(told_cause const& c, char const* key, double episode::*time) {
        auto const all = member(c.about, key);
        for (auto const& [scenario, about] : all.items()) {
            auto const window = hull_in(about);
            auto const value = value_in(member(about, "value"));
            bool const named = value && std::any_of(c.effects.begin(), c.effects.end(),
                                                    [&, &in = scenario](auto& e) {
                                                        return episode_in(e, in).*time == *value;
                                                    });
            if (!named || (window && !window->contains(*value, digits)))
                add("onset", joined(c.effects) + " in " + scenario +
                                 (window ? ' ' + text_of(*window) : std::string{}));
        }
    }

    void hulls(json const& all, json const& values) {
        for (auto const& [name, range] : all.items()) {
            auto const hull = hull_in(range);
            auto const value = value_in(member(values, name));
            if (hull && value && !hull->contains(*value, digits * (1 + std::abs(*value))))
                add("hull", name + " in " + text_of(*hull) + ", witness " + short_text(*value));
        }
    }

    void products(json const& all, json const& values) {
        for (auto const& p : all) {
            auto const hull = hull_in(p);
            auto const value = combination_in(
                p, [&values](std::string const& name) { return value_in(member(values, name)); });
            if (hull && value && !hull->contains(*value, digits * (1 + std::abs(*value))))
                add("hull", text_of(member(p, "formula")) + " in " + text_of(*hull) + ", witness " +
                                short_text(*value));
        }
    }

    /// Constants that are called verified are those of the witness.
    void verified_constants(json const& answer, json const& witness) {
        if (member(answer, "verified") != true) return;
        auto const constants = member(answer, "constants");
        for (auto const& [name, about] : constants.items()) {
            auto const told = value_in(member(about, "value")),
                       at = value_in(member(witness, name));
            if (told && at && std::abs(*told - *at) > digits * (1 + std::abs(*at)))
                add("witness",
                    name + " told " + short_text(*told) + ", verified " + short_text(*at));
        }
    }

    /// No part of the data needs more than all of them.
    void parts() {
        for (auto const* list : {"scenarios", "channels"}) {
            auto const parts = member(member(*d_, "gap"), list);
            for (auto const& [name, range] : parts.items()) {
                auto const part = bounds_in(range);
                if (part && part->lower > base_.upper + digits)
                    add("inflation",
                        name + " alone " + text_of(*part) + " beside all " + text_of(base_));
                if (part && part->lower > part->upper)
                    add("verdict", name + " alone " + text_of(*part));
            }
        }
    }

    /// Without such a part the model explains the data: all that is proved of the others.
    void confined() {
        for (auto const& part : member(member(*d_, "gap"), "confined")) {
            auto const factor = bounds_in(member(part, "factor")).value_or(bounds{});
            auto const text = confined_text(part) + ' ' + text_of(factor);
            if (gap_ == "none") add("confined", text + " beside gap none");
            if (factor.lower > factor.upper || factor.upper < base_.lower - digits)
                add("confined", text + " beside all " + text_of(base_));
            auto const channel = text_of(member(part, "channel"));
            auto const scenarios = names_in(member(part, "scenarios"));
            for (auto const& r : member(*d_, "relations")) {
                names seen, sensors = names_in(member(r, "sensors"));
                for (auto const& w : member(r, "windows"))
                    seen.insert(text_of(member(w, "scenario")));
                bool const apart = !scenarios.empty() && !seen.empty() &&
                                   std::none_of(seen.begin(), seen.end(), [&](auto const& s) {
                                       return scenarios.contains(s);
                                   });
                if (member(r, "proved") == true &&
                    (apart || (!channel.empty() && !sensors.contains(channel))))
                    add("relation", relation_text(r) + " beside all but " + text);
            }
            for (auto const& [list, in] :
                 {std::pair{"scenarios", scenarios}, std::pair{"channels", names{channel}}}) {
                auto const alone = member(member(*d_, "gap"), list);
                for (auto const& [name, range] : alone.items()) {
                    bool const other = !in.empty() && *in.begin() != "" && !in.contains(name);
                    if (other && number(range, 0).value_or(0) > 1)
                        add("inflation", name + " alone beside all but " + text);
                }
            }
        }
    }

    void answer() {
        auto const answer = member(*d_, "answer");
        auto const kind = text_of(member(answer, "kind"));
        auto const explaining = std::find_if(causes_.begin(), causes_.end(), [](auto const& c) {
            return c.verdict == "explains" && !c.effects.empty();
        });
        bool const given_up = kind == "unexplained" || kind == "open";
        if (given_up && explaining != causes_.end())
            add("answer", kind + " beside " + joined(explaining->effects) + ", which explains");
        if ((given_up || kind == "effects") && gap_ == "none")
            add("answer", kind + " beside gap none");
        if (kind == "none" && gap_ == "certified") add("answer", "none beside a certified gap");
        std::vector<names> named;
        if (kind == "effects") named.push_back(names_in(member(answer, "effects")));
        for (auto const& other : member(answer, "indistinguishable"))
            named.push_back(names_in(other));
        for (auto const& n : named)
            for (auto const& c : causes_)
                if (c.effects == n && c.verdict == "excluded")
                    add("answer", joined(n) + ", which is excluded");
        double tried = 0, planned = 0;
        count_tried(answer, tried, planned);
        count_tried(member(*d_, "tried"), tried, planned);
        if (kind == "unexplained" && tried < planned)
            add("untried",
                "unexplained, " + short_text(tried) + " of " + short_text(planned) + " tried");
        if (kind == "unexplained" && planned == 0) untried_singles();
        if (kind == "open" && planned > 0 && tried >= planned)
            add("untried", "open, all " + short_text(planned) + " tried");
    }

    /// Where nothing is told, `causes` holds all that was tried: at least each single effect.
    void untried_singles() {
        auto const unobservable = names_in(member(*d_, "unobservable"));
        names left;
        for (auto const& e : catalogue()) {
            std::string const name{e.name};
            bool const tried = std::any_of(causes_.begin(), causes_.end(),
                                           [&](auto const& c) { return c.effects == names{name}; });
            if (!tried && !unobservable.contains(name)) left.insert(name);
        }
        if (!left.empty()) add("untried", "unexplained without " + joined(left));
    }

    static void count_tried(json const& j, double& tried, double& planned) {
        if (!j.is_object()) return;
        auto const done = member(j, "tried"), all = member(j, "planned");
        if (done.is_number() && all.is_number()) {
            tried += done.get<double>();
            planned += all.get<double>();
            return; // the parts of a sum are not counted again
        }
        for (auto const& [name, inner] : j.items()) count_tried(inner, tried, planned);
    }

    /// 1 - max(0, after - 1)/max(0, before - 1) of the inflations that the file gives.
    void shrink() {
        auto const told = member(*d_, "shrink");
        auto const fit = bounds_in(member(told, "fit"));
        auto const holdout = bounds_in(member(told, "holdout"));
        if (!fit && !holdout) return;
        auto const answer = member(*d_, "answer");
        if (member(answer, "kind") == "none") return add("shrink", "without an effect");
        auto const effects = names_in(member(answer, "effects"));
        auto const* cause = causes_.empty() ? nullptr : &causes_.front();
        for (auto const& c : causes_)
            if (member(answer, "kind") == "effects" && c.effects == effects) cause = &c;
        if (cause == nullptr) return add("shrink", "without a cause");
        compare("fit", fit, base_, cause->inflation);
        auto const figures = member(cause->about, "holdout");
        auto const before = bounds_in(member(figures, "inflation_before"));
        auto const after = bounds_in(member(figures, "inflation_after"));
        if (before && after) compare("hold-out", holdout, *before, *after);
    }

    /// The stated range holds all that the inflations leave possible.
    void compare(char const* which, std::optional<bounds> const& told, bounds const& before,
                 bounds const& after) {
        if (!told) return;
        auto const excess = [](double x) { return std::max(0.0, x - 1); };
        auto const text = std::string{which} + ' ' + text_of(*told) + " with " + text_of(before) +
                          " before, " + text_of(after) + " after";
        if (!(before.upper > 1)) return add("shrink", text);
        double const best =
            std::isinf(before.upper) ? 1 : 1 - excess(after.lower) / excess(before.upper);
        double const worst = excess(before.lower) > 0 && !std::isinf(after.upper)
                                 ? 1 - excess(after.upper) / excess(before.lower)
                                 : -std::numeric_limits<double>::infinity();
        if (told->upper < best - 1e-6 || told->lower > worst + 1e-6) add("shrink", text);
    }

    json const* d_;
    std::string gap_;
    bounds base_;
    std::vector<told_cause> causes_;
    std::vector<finding> found_;
};

} // namespace

std::vector<finding> contradictions_in(json const& diagnosis) { return file_check(diagnosis)(); }

} // namespace withheld
