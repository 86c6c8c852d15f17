// SPDX-License-Identifier: MIT
#include "judge.hpp"
#include "catalogue.hpp"
#include "consistency.hpp"
#include "instruments.hpp"
#include "places.hpp"
#include "reading.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>

namespace withheld {

namespace {

/// The simulation behind the labels is good to far less than this share of a bound.
constexpr double tolerance = 1e-3;

bool catalogue_holds(names const& effects) {
    return std::all_of(effects.begin(), effects.end(),
                       [](auto const& e) { return effect_named(e) != nullptr; });
}

/// Effects that come close enough to a truth that no candidate holds.
bool is_near(names const& truth, names const& said) {
    return (truth == names{"servo"} && said == names{"rudder_lag"}) ||
           (truth == names{"lagging_xy"} && said == names{"position_latency"});
}

/// Is it honest to say that nothing explains the data: the truth is in no catalogue, beyond its
/// prior, not everywhere, or three effects at once, which are tried last?
bool may_be_unexplained(label const& l) { return !l.attainable() || l.effects.size() > 2; }

/// Terms that no catalogue has, all in equations that the truth touches.
bool right_terms(label const& l, names const& said) {
    auto const broken = places_of(l.names());
    return !said.empty() && std::all_of(said.begin(), said.end(), [&](std::string const& n) {
        auto const own = places_of(n).equations;
        return n.find("'~") != n.npos && !own.empty() &&
               std::includes(broken.equations.begin(), broken.equations.end(), own.begin(),
                             own.end());
    });
}

bool right_answer(label const& l, json const& answer, bool absorbed) {
    auto const kind = answer.at("kind").get<std::string>();
    // Beyond its prior the name is right, and with scenarios where the effect acts in some only.
    bool const partial = l.partial();
    auto const plain = [partial](json const& effects) {
        names result;
        for (auto const& n : names_in(effects))
            result.insert(partial || n.find('@') == n.npos ? drawn_name(plain_name(n)) : n);
        return result;
    };
    auto const said = plain(member(answer, "effects"));
    auto const truth = l.names();
    if (absorbed && kind == "none") return true;
    if (truth.empty()) return false;
    if (kind == "unexplained") return may_be_unexplained(l);
    if (kind != "effects") return false;
    if (said == truth || is_near(truth, said)) return true;
    if (may_be_unexplained(l) && right_terms(l, said)) return true;
    auto const other = member(answer, "indistinguishable");
    if (!catalogue_holds(truth) || !other.is_array() || other.size() > 3) return false;
    return std::any_of(other.begin(), other.end(),
                       [&](json const& e) { return plain(e) == truth; });
}

/// Lower bounds of the inflation of parts of the data against what fits have found.
void judge_parts(label const& l, json const& gap, judgement& j) {
    auto const known = l.values("best_of_parts");
    for (auto const* parts : {"scenarios", "channels"}) {
        auto const all = member(gap, parts);
        for (auto const& [name, range] : all.items()) {
            auto const lower = number(range, 0);
            auto const best = known.find(name);
            if (!lower || best == known.end()) continue;
            j.proof(*lower <= best->second + tolerance, "part",
                    name + " alone, at least " + short_text(*lower) + ", attained " +
                        short_text(best->second));
        }
    }
}

void judge_gap(label const& l, json const& d, judgement& j) {
    auto const gap = member(d, "gap");
    j.gap_certified = member(gap, "verdict") == "certified";
    j.inflation_lower = number(member(gap, "inflation"), 0);
    j.inflation_upper = number(member(gap, "inflation"), 1);
    if (j.gap_certified) j.proof(!j.absorbed, "gap", "certified");
    if (j.inflation_lower && j.inflation_bound)
        j.proof(*j.inflation_lower <= *j.inflation_bound + tolerance, "inflation",
                "of the model at least " + short_text(*j.inflation_lower) + ", attained " +
                    short_text(*j.inflation_bound));
    judge_parts(l, gap, j);
}

void judge_relations(label const& l, json const& d, judgement& j) {
    auto const broken = places_of(l.names());
    for (auto const& r : member(d, "relations")) {
        if (member(r, "proved") != true) continue;
        j.relation_proved = true;
        bool const touched =
            touches(broken, text_of(member(r, "equation")), names_in(member(r, "sensors")));
        j.proof(touched && !j.absorbed, "relation", relation_text(r));
    }
}

/// `acting` is what may be wrong there; the places of the truth are right for a first entry.
void judge_proved_places(json const& where, names const& acting, judgement& j) {
    auto const broken = places_of(acting);
    for (auto const& w : where) {
        if (member(w, "proved") != true) continue;
        bool const hit = holds_instrument(broken, w.at("kind").get<std::string>(),
                                          w.at("name").get<std::string>());
        j.proof(hit && !j.absorbed, "place", place_text(w));
    }
}

void judge_places(label const& l, json const& d, judgement& j) {
    auto const where = member(d, "where");
    judge_proved_places(where, l.names(), j);
    // With the effects of the candidate that comes closest, these may be wrong, too.
    auto const remainder = member(d, "remainder");
    auto acting = l.names();
    acting.merge(names_in(member(remainder, "effects")));
    judge_proved_places(member(remainder, "where"), acting, j);
    if (where.empty()) // right where there is nothing to say
        j.place_right = l.effects.empty() || j.absorbed;
    else
        j.place_right =
            holds_instrument(places_of(l.names()), where[0].at("kind").get<std::string>(),
                             where[0].at("name").get<std::string>());
}

/// Do the intervals that are reported for the true effects hold the true parameters?
void judge_parameters(label const& l, json const& cause, judgement& j) {
    auto const reported = member(cause, "parameters");
    for (auto const& [name, values] : l.effects) {
        auto const* known = effect_named(name);
        for (std::size_t i = 0; known != nullptr && i < values.size(); ++i) {
            auto const full = name + '.' + std::string{known->parameters.at(i).name};
            auto const lower = number(member(reported, full), 0);
            auto const upper = number(member(reported, full), 1);
            if (!lower || !upper) continue;
            ++j.intervals;
            j.intervals_hold += *lower <= values[i] && values[i] <= *upper ? 1U : 0U;
        }
    }
}

/// Whether the effects are the fault of an instrument that was drawn.
bool is_drawn_fault(label const& l, names const& effects) {
    return effects.size() == 1 && l.effects.size() == 1 && fault_in(*effects.begin()) &&
           drawn_name(*effects.begin()) == l.effects.front().first;
}

/// Fits that explain the data with the effects of a cause. Where a cause names its effect with
/// times at which it begins, or ends, or both, hulls hold whatever these are: the truth is one if
/// it does no more.
std::vector<known_fit> comparable(label const& l, known_fits const& known, json const& cause) {
    auto all = known.all();
    auto const effects = names_in(member(cause, "effects"));
    if (is_drawn_fault(l, effects)) { // no catalogue has it, so nobody fitted it
        auto truth = l.constants_true;
        truth.merge(fault_values(*fault_in(*effects.begin()), l.effects.front().second));
        all.push_back({effects, l.number("fit_true").value_or(1.0), std::move(truth)});
        return all;
    }
    bool const named = effects.size() == 1 && l.effects.size() == 1 &&
                       plain_name(*effects.begin()) == l.effects.front().first;
    auto const& name = *effects.begin();
    bool const ends = name.find('<') != name.npos;
    bool const begins = name.find(">=") != name.npos;
    if (!named || (!begins && !ends)) return all;
    for (auto const& [scenario, time] : l.values("onsets"))
        if (!begins && true_episode(l, scenario).begins_later()) return all;
    for (auto const& [scenario, time] : l.values("ends"))
        if (!ends && true_episode(l, scenario).ends()) return all;
    known_fit truth{effects, l.number("fit_true").value_or(1.0), l.constants_true};
    auto const* known_effect = effect_named(*effects.begin());
    auto const& values = l.effects.front().second;
    for (std::size_t i = 0; i < values.size() && i < known_effect->parameters.size(); ++i) {
        auto const& p = known_effect->parameters[i];
        if (values[i] < p.lo || values[i] > p.hi) return all;
        truth.values[*effects.begin() + '.' + std::string{p.name}] = values[i];
    }
    all.push_back(std::move(truth));
    return all;
}

/// The true onsets and ends lie in their windows, if the truth explains the data. What never acts
/// begins at the end, and ends at the begin.
void judge_times(label const& l, std::vector<known_fit> const& known, json const& cause,
                 char const* key, double episode::*time, judgement& j) {
    if (known.empty()) return;
    auto const& truth = known.back();
    if (truth.effects != names_in(member(cause, "effects")) || truth.inflation > 1 - 1e-6) return;
    bool const of_end = time == &episode::to;
    auto const times = member(cause, key);
    for (auto const& [scenario, about] : times.items()) {
        auto const window = hull_in(about);
        auto const all = bounds_in(member(about, "prior"));
        if (!window || !all) continue;
        auto const when = true_episode(l, scenario);
        double const at = when.never() ? (of_end ? all->lower : all->upper) : when.*time;
        j.onset_windows.push_back((window->upper - window->lower) / (all->upper - all->lower));
        j.proof(window->contains(std::clamp(at, all->lower, all->upper), 1e-9), "onset",
                scenario + (of_end ? " ends in " : " begins in ") + text_of(*window) +
                    ", in truth " + short_text(at));
    }
}

/// Hulls contain every value that explains the data: those of the truth and of the fits known.
void judge_hulls(std::vector<known_fit> const& known, json const& hulls, names const& effects,
                 judgement& j) {
    for (auto const& [name, range] : hulls.items()) {
        auto const hull = hull_in(range);
        if (!hull) continue;
        for (auto const& f : known) {
            auto const value = f.values.find(name);
            bool const comparable = f.effects == effects && f.inflation <= 1 - 1e-6;
            if (!comparable || value == f.values.end()) continue;
            ++j.hulls_checked;
            j.proof(hull->contains(value->second, 1e-7 * (1 + std::abs(value->second))), "hull",
                    name + " in " + text_of(*hull) + ", explains at " + short_text(value->second));
        }
    }
}

/// The same of products of powers.
void judge_products(std::vector<known_fit> const& known, json const& products, names const& effects,
                    judgement& j) {
    for (auto const& p : products) {
        auto const hull = hull_in(p);
        if (!hull) continue;
        for (auto const& f : known) {
            if (f.effects != effects || !(f.inflation <= 1 - 1e-6)) continue;
            auto const value = combination_in(p, [&f](std::string const& name) {
                auto const at = f.values.find(name);
                return at == f.values.end() ? std::nullopt : std::optional{at->second};
            });
            if (!value) continue;
            ++j.hulls_checked;
            j.proof(hull->contains(*value, 1e-7 * (1 + std::abs(*value))), "hull",
                    text_of(member(p, "formula")) + " in " + text_of(*hull) + ", explains at " +
                        short_text(*value));
        }
    }
}

void judge_causes(label const& l, known_fits const& known, json const& d, judgement& j) {
    bool const attainable = l.attainable();
    for (auto const& c : member(d, "causes")) {
        auto const effects = names_in(member(c, "effects"));
        auto const held_by = l.held_by();
        bool const explains =
            j.absorbed || (held_by && includes(effects, names{held_by->begin(), held_by->end()}));
        auto const least = known.least(effects);
        auto const verdict = member(c, "verdict");
        if (verdict == "explains") {
            if (effects == l.names() || is_drawn_fault(l, effects)) {
                j.truth_explains = true;
                judge_parameters(l, c, j);
            }
            auto const fits = comparable(l, known, c);
            judge_hulls(fits, member(c, "parameters"), effects, j);
            judge_times(l, fits, c, "onsets", &episode::from, j);
            judge_times(l, fits, c, "ends", &episode::to, j);
            auto const answer = member(d, "answer");
            if (member(answer, "kind") == "effects" &&
                names_in(member(answer, "effects")) == effects) {
                judge_hulls(fits, member(answer, "constants"), effects, j);
                judge_products(fits, member(answer, "combinations"), effects, j);
            }
        }
        if (verdict == "excluded")
            j.proof(!explains && !(least && *least <= 1 - 1e-6), "excluded", joined(effects));
        auto const lower = number(member(c, "inflation"), 0);
        if (lower && least)
            j.proof(*lower <= *least + tolerance, "inflation",
                    joined(effects) + " at least " + short_text(*lower) + ", attained " +
                        short_text(*least));
    }
    if (!j.truth_explains && !l.effects.empty() && attainable) j.truth_explains = false;
}

/// What the effect itself would bring on hold-out data, at the true constants.
void judge_shrink(label const& l, json const& d, judgement& j) {
    auto const shrink = member(member(d, "shrink"), "holdout");
    j.shrink_lower = number(shrink, 0);
    j.shrink_upper = number(shrink, 1);
    auto const before = l.number("holdout_base"), after = l.number("holdout_true");
    if (before && after && *before > 1 && l.attainable())
        j.shrink_true = 1 - std::max(0.0, *after - 1) / (*before - 1);
}

json read_json(std::filesystem::path const& path) {
    std::ifstream file{path};
    return file ? json::parse(file) : json{};
}

} // namespace

judgement judge(label const& l, json const& d, json const& baseline) {
    judgement j;
    j.id = l.id;
    j.family = l.family;
    j.truth = joined(l.names(), "none");
    known_fits const known(l, baseline);
    if (l.number("fit_base") || l.number("fit_base_best")) j.inflation_bound = known.least({});
    j.absorbed = l.effects.empty() || (j.inflation_bound && *j.inflation_bound <= 1 - tolerance);

    auto const answer = d.at("answer");
    auto const kind = answer.at("kind").get<std::string>();
    j.answer = kind == "effects" ? joined(names_in(member(answer, "effects")), "effects()") : kind;
    j.open = kind == "open";
    j.right = right_answer(l, answer, j.absorbed);
    judge_gap(l, d, j);
    judge_relations(l, d, j);
    judge_places(l, d, j);
    judge_causes(l, known, d, j);
    if (kind == "none") judge_hulls(known.all(), member(answer, "constants"), {}, j);
    judge_shrink(l, d, j);
    j.withdrawn = member(d, "withdrawn").size();
    j.contradictions = contradictions_in(d);
    if (auto const s = member(d, "seconds"); s.is_number()) j.seconds = s.get<double>();
    return j;
}

judgement judge_case(label const& l, std::filesystem::path const& results,
                     std::filesystem::path const& data, std::filesystem::path const& baseline) {
    judgement j;
    try {
        std::ifstream file{results / l.id / "diagnosis.json"};
        if (!file) throw std::runtime_error("no diagnosis");
        auto const diagnosis = json::parse(file);
        auto const other =
            baseline.empty() ? json{} : read_json(baseline / l.id / "diagnosis.json");
        j = judge(l, diagnosis, other);
        if (!data.empty()) {
            auto const recorded = read_recording(data / l.id);
            check_witnesses(recorded, diagnosis, j);
            check_claims(l, recorded, diagnosis, j);
            measure_widths(l, recorded, diagnosis, j);
        }
    } catch (std::exception const& e) {
        j = {};
        j.id = l.id;
        j.family = l.family;
        j.truth = joined(l.names(), "none");
        j.answer = "missing";
        j.missing = true;
        j.trouble = e.what();
    }
    std::ifstream time{results / l.id / "seconds.txt"};
    if (double seconds = 0; time >> seconds) j.seconds = seconds;
    return j;
}

} // namespace withheld
