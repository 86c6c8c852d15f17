// SPDX-License-Identifier: MIT
// The units of time, of the states and of the input are the user's: the same campaign in other
// numbers gets the same fits, places, relations, proofs, causes and, but for rounding, hulls.
#include <sivid/approximate/fit/fit.hpp>
#include <sivid/approximate/place/detail/place_estimate.hpp>
#include <sivid/diagnosis/diagnose.hpp>
#include <sivid/paving/relation/detail/broken_relation.hpp>
#include <sivid/paving/relation/relation_contraction.hpp>

#include "support/catch.hpp"
#include "support/oscillator_in_units.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace sivid;
using namespace support::in_units;

namespace {

std::vector<units> few_units() {
    return {{1e3, 1e-3, 1e3, "ms"}, {1.0 / 3600, 1, 1e6, "h"}, {1 / 0.37, 1e3, 1e-6, "0.37 s"}};
}
/// Every unit of time, then every size of states and of inputs.
std::vector<units> all_units() {
    std::vector<units> result(units_of_time.begin(), units_of_time.end());
    for (double const size : scalings) {
        result.push_back({1, size, 1, "s, states"});
        result.push_back({1, 1, size, "s, input"});
        result.push_back({1.0 / 3600, size, 1 / size, "h, both"});
    }
    return result;
}
missing const& truth_of(std::string const& effect) {
    static auto const all = all_planted();
    return std::find_if(all.begin(), all.end(), [&](auto const& p) { return p.effect == effect; })
        ->truth;
}
std::string text(units const& in) {
    return std::string(in.name) + ", states x " + std::to_string(in.state) + ", input x " +
           std::to_string(in.input);
}
/// A model's constants in base units.
std::vector<double> size_of_constants(units const& in) {
    return {in.acceleration() / in.input, 1 / (in.time * in.time), 1 / in.time};
}
/// A parameter of an effect of the catalogue in base units.
double size_of(std::string const& effect, units const& in) {
    if (effect == "late" || effect == "latency" || effect == "lag") return in.time;
    if (effect == "cube") return in.acceleration() / std::pow(in.state, 3);
    if (effect == "friction") return in.acceleration();
    if (effect == "bias") return in.state;
    return effect == "drag" ? 1 / in.state : 1;
}

/// Ends of a range in base units are those of another one, within a share of its width.
void check_same(interval const& own, double size, interval const& base, double share) {
    double const near = share * width(base);
    CHECK_THAT(own.lower() / size, WithinAbs(base.lower(), near));
    CHECK_THAT(own.upper() / size, WithinAbs(base.upper(), near));
}

/// What a diagnosis says but for numbers.
struct said {
    gap_verdict gap;
    answer_kind answer;
    std::vector<std::string> effects, places;
    std::map<std::string, bool> relations;
    std::map<std::string, std::string> causes;
    bool operator==(said const&) const = default;
};
said words_of(diagnosis const& d) {
    said result{d.gap, d.answer, d.effects, {}, {}, {}};
    for (auto const& w : d.where)
        result.places.push_back(w.kind + " " + w.name + (w.proved ? " (proved)" : ""));
    for (auto const& r : d.relations) result.relations[r.equation] = r.proved;
    for (auto const& c : d.causes)
        if (c.effects.size() == 1)
            result.causes[c.effects[0]] = std::string(to_string(c.verdict)) +
                                          (c.excluded_by.empty() ? "" : " by " + c.excluded_by);
    return result;
}
diagnosis diagnosed(std::string const& effect, units const& in) {
    diagnosis_options options;
    options.seconds = 600; // boxes end the steps
    options.hulls.boxes = 200;
    return diagnose(problem_in(in, truth_of(effect)), catalogue_in(in), options).result;
}
void check_same(diagnosis const& own, units const& in, diagnosis const& base) {
    CHECK(words_of(own) == words_of(base));
    REQUIRE(own.constants.size() == base.constants.size());
    auto sizes = size_of_constants(in);
    for (auto const& e : own.effects) sizes.push_back(size_of(e, in));
    for (std::size_t j = 0; j < own.constants.size(); ++j) {
        CAPTURE(own.constants[j].name);
        CHECK(own.constants[j].hull.has_value() == base.constants[j].hull.has_value());
        if (own.constants[j].hull && base.constants[j].hull)
            check_same(*own.constants[j].hull, sizes.at(j), *base.constants[j].hull, 0.01);
    }
    CHECK_THAT(own.inflation.lower(), WithinRel(base.inflation.lower(), 0.01));
    CHECK_THAT(own.inflation.upper(), WithinRel(base.inflation.upper(), 0.01));
}

void check_fit(std::string const& effect, std::vector<units> const& list) {
    CAPTURE(effect);
    auto const base = approximate_fitter(problem_in({}, truth_of(effect)))();
    for (auto const& in : list) {
        INFO(text(in));
        auto const own = approximate_fitter(problem_in(in, truth_of(effect)))();
        CHECK_THAT(own.inflation, WithinRel(base.inflation, 2e-3));
        REQUIRE(own.parameters.size() == base.parameters.size());
        auto const sizes = size_of_constants(in);
        for (std::size_t j = 0; j < sizes.size(); ++j)
            CHECK_THAT(own.parameters[j] / sizes[j], WithinRel(base.parameters[j], 0.02));
    }
}

void check_places(std::string const& effect, std::vector<units> const& list) {
    CAPTURE(effect);
    auto const labels = [&](place_estimate const& e) {
        std::multiset<std::string> result;
        for (auto const& p : e.places)
            result.insert(std::to_string(static_cast<int>(p.kind)) + " " + p.name);
        return result;
    };
    auto const base = estimate_places(problem_in({}, truth_of(effect)));
    REQUIRE_FALSE(base.places.empty());
    for (auto const& in : list) {
        INFO(text(in));
        auto const own = estimate_places(problem_in(in, truth_of(effect)));
        CHECK(labels(own) == labels(base));
        CHECK_THAT(own.inflation, WithinRel(base.inflation, 0.05));
        if (own.places.empty()) continue;
        auto const& first = own.places.front();
        CHECK(first.law == base.places.front().law);
        double const size = first.kind == place_kind::sensor ? (first.law == "latency"  ? in.time
                                                                : first.law == "offset" ? in.state
                                                                                        : 1)
                                                             : 0;
        if (size > 0)
            CHECK_THAT(first.missing / size, WithinRel(base.places.front().missing, 0.05));
    }
}

void check_relations(std::string const& effect, std::vector<units> const& list) {
    CAPTURE(effect);
    auto const base = find_broken_relations(problem_in({}, truth_of(effect)));
    for (auto const& in : list) {
        INFO(text(in));
        auto const own = find_broken_relations(problem_in(in, truth_of(effect)));
        REQUIRE(own.size() == base.size());
        for (std::size_t k = 0; k < own.size(); ++k) {
            CHECK(own[k].name == base[k].name);
            CHECK(own[k].proved == base[k].proved);
            CHECK(own[k].channels == base[k].channels);
        }
    }
}

void check_contraction(std::vector<units> const& list, sizes const& of = {}) {
    auto const base = contract_by_relations(problem_in({}, {}, of));
    for (std::size_t j = 0; j < 3; ++j) REQUIRE(width(base[j]) < 0.9 * width(prior_in({})[j]));
    for (auto const& in : list) {
        INFO(text(in));
        auto const own = contract_by_relations(problem_in(in, {}, of));
        auto const sizes = size_of_constants(in);
        auto const truth = true_constants(in);
        for (std::size_t j = 0; j < 3; ++j) {
            CHECK(contains(own[j], truth[j]));
            check_same(own[j], sizes[j], base[j], 0.01);
        }
    }
}

} // namespace

TEST_CASE("in other units a fit is the same") {
    check_fit("", few_units());
    check_fit("cube", few_units());
}
TEST_CASE("in other units places are the same") {
    check_places("late", few_units());
    check_places("latency", few_units());
}
TEST_CASE("in other units broken relations are the same") {
    check_relations("friction", few_units());
    check_relations("latency", few_units());
}
TEST_CASE("in other units equations contract as much") {
    check_contraction(few_units(), {.duration = 8, .samples = 80});
}

TEST_CASE("in other units all fits, places and relations are the same", "[.long]") {
    for (auto const& p : all_planted()) {
        check_fit(p.effect, all_units());
        if (*p.effect != 0) check_places(p.effect, all_units());
        check_relations(p.effect, all_units());
    }
    check_contraction(all_units());
}
TEST_CASE("in other units a diagnosis is the same", "[.long]") {
    for (auto const& p : all_planted()) {
        INFO(p.effect);
        auto const base = diagnosed(p.effect, {});
        CHECK(base.effects ==
              (*p.effect == 0 ? std::vector<std::string>{} : std::vector<std::string>{p.effect}));
        bool const widely = std::string(p.effect) == "late";
        for (auto const& in : widely ? all_units() : few_units()) {
            INFO(text(in));
            check_same(diagnosed(p.effect, in), in, base);
        }
    }
}
