// SPDX-License-Identifier: MIT
#include "judge.hpp"
#include "catalogue.hpp"
#include "places.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <set>

namespace withheld {

namespace {

using json = nlohmann::json;
using names = std::set<std::string>;

/// The simulation behind the labels is good to far less than this share of a bound.
constexpr double tolerance = 1e-3;

std::string joined(names const& all, std::string const& otherwise) {
    std::string text;
    for (auto const& n : all) text += (text.empty() ? "" : "+") + n;
    return text.empty() ? otherwise : text;
}

names names_in(json const& list) {
    names all;
    if (list.is_array())
        for (auto const& n : list) all.insert(n.get<std::string>());
    return all;
}

json member(json const& j, std::string const& key) {
    return j.is_object() && j.contains(key) ? j.at(key) : json{};
}

std::optional<double> number(json const& pair, std::size_t index) {
    if (!pair.is_array() || pair.size() != 2 || !pair[index].is_number()) return std::nullopt;
    return pair[index].get<double>();
}

bool includes(names const& all, names const& some) {
    return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

bool right_answer(label const& l, json const& answer, bool absorbed) {
    auto const kind = answer.at("kind").get<std::string>();
    auto const said = names_in(member(answer, "effects"));
    if (l.family == "none") return kind == "none";
    if (absorbed && kind == "none") return true;
    if (l.family == "outside") {
        // A servo of second order may come close to a lag; nothing else in the catalogue comes
        // close.
        bool const near = l.names().contains("servo") && said == names{"rudder_lag"};
        return kind == "unexplained" || (kind == "effects" && near);
    }
    if (kind != "effects") return false;
    if (said == l.names()) return true;
    auto const other = member(answer, "indistinguishable");
    if (!other.is_array() || other.size() > 3) return false;
    return std::any_of(other.begin(), other.end(),
                       [&](json const& e) { return names_in(e) == l.names(); });
}

void judge_gap(json const& d, judgement& j) {
    auto const gap = member(d, "gap");
    j.gap_certified = member(gap, "verdict") == "certified";
    j.inflation_lower = number(member(gap, "inflation"), 0);
    j.inflation_upper = number(member(gap, "inflation"), 1);
    if (j.gap_certified) {
        ++j.proofs;
        if (j.absorbed) j.false_proofs.emplace_back("gap");
    }
    if (j.inflation_lower && j.inflation_bound) {
        ++j.proofs;
        if (*j.inflation_lower > *j.inflation_bound + tolerance)
            j.false_proofs.emplace_back("inflation");
    }
}

void judge_relations(label const& l, json const& d, judgement& j) {
    auto const broken = places_of(l.names());
    for (auto const& r : member(d, "relations")) {
        if (member(r, "proved") != true) continue;
        ++j.proofs;
        j.relation_proved = true;
        auto const equation = member(r, "equation");
        bool touched =
            equation.is_string() && holds(broken, "equation", equation.get<std::string>());
        for (auto const& s : names_in(member(r, "sensors")))
            touched = touched || holds(broken, "sensor", s);
        if (!touched || j.absorbed) j.false_proofs.emplace_back("relation");
    }
}

void judge_places(label const& l, json const& d, judgement& j) {
    auto const broken = places_of(l.names());
    auto const where = member(d, "where");
    bool first = true;
    for (auto const& w : where) {
        bool const hit =
            holds(broken, w.at("kind").get<std::string>(), w.at("name").get<std::string>());
        if (first) j.place_right = hit;
        first = false;
        if (member(w, "proved") != true) continue;
        ++j.proofs;
        if (!hit || j.absorbed) j.false_proofs.emplace_back("place");
    }
    if (!first) return;
    // Nothing is said: right where there is nothing to say.
    j.place_right = l.family == "none" || j.absorbed;
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

void judge_causes(label const& l, json const& d, judgement& j) {
    for (auto const& c : member(d, "causes")) {
        auto const effects = names_in(member(c, "effects"));
        // More effects explain no less: their neutral values lie in the priors.
        bool const explains = j.absorbed || (l.family != "outside" && includes(effects, l.names()));
        auto const verdict = member(c, "verdict");
        if (verdict == "explains" && effects == l.names()) {
            j.truth_explains = true;
            judge_parameters(l, c, j);
        }
        if (verdict == "excluded") {
            ++j.proofs;
            if (explains) j.false_proofs.emplace_back("excluded");
        }
        auto const lower = number(member(c, "inflation"), 0);
        auto const least = j.absorbed ? j.inflation_bound : l.number("fit_true");
        if (explains && lower && *lower > least.value_or(1.0) + tolerance)
            j.false_proofs.emplace_back("inflation");
    }
    if (!j.truth_explains && !l.effects.empty() && l.family != "outside") j.truth_explains = false;
}

/// What the effect itself would bring on hold-out data, at the true constants.
void judge_shrink(label const& l, json const& d, judgement& j) {
    auto const shrink = member(member(d, "shrink"), "holdout");
    j.shrink_lower = number(shrink, 0);
    j.shrink_upper = number(shrink, 1);
    auto const before = l.number("holdout_base"), after = l.number("holdout_true");
    if (before && after && *before > 1 && l.family != "outside")
        j.shrink_true = 1 - std::max(0.0, *after - 1) / (*before - 1);
}

} // namespace

judgement judge(label const& l, json const& d) {
    judgement j;
    j.id = l.id;
    j.family = l.family;
    j.truth = joined(l.names(), "none");
    auto const at_truth = l.number("fit_base"), fitted = l.number("fit_base_best");
    if (at_truth || fitted)
        j.inflation_bound = std::min(at_truth.value_or(1e300), fitted.value_or(1e300));
    j.absorbed = l.effects.empty() || (j.inflation_bound && *j.inflation_bound <= 1 - tolerance);

    auto const answer = d.at("answer");
    auto const kind = answer.at("kind").get<std::string>();
    j.answer = kind == "effects" ? joined(names_in(member(answer, "effects")), "effects()") : kind;
    j.right = right_answer(l, answer, j.absorbed);
    judge_gap(d, j);
    judge_relations(l, d, j);
    judge_places(l, d, j);
    judge_causes(l, d, j);
    judge_shrink(l, d, j);
    if (auto const s = member(d, "seconds"); s.is_number()) j.seconds = s.get<double>();
    return j;
}

judgement judge_case(label const& l, std::filesystem::path const& results,
                     std::filesystem::path const& data) {
    judgement j;
    try {
        std::ifstream file{results / l.id / "diagnosis.json"};
        if (!file) throw std::runtime_error("no diagnosis");
        auto const diagnosis = json::parse(file);
        j = judge(l, diagnosis);
        if (!data.empty()) check_witnesses(read_recording(data / l.id), diagnosis, j);
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
