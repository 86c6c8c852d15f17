// SPDX-License-Identifier: MIT
// Constants that are functions of others, wherever constants are bound.
#include <sivid/model/parameter_choice.hpp>

#include <sivid/model/bound_model.hpp>
#include <sivid/model/change/detail/substitution.hpp>
#include <sivid/model/effect.hpp>
#include <sivid/model/structure/find_combinations.hpp>

#include "support/catch.hpp"
#include "support/formulas.hpp"

#include <array>
#include <string>

using namespace sivid;

namespace {

/// x' = -F D^4 / A, with A = 3 R^2 and R = D/2: the nominal A is rounded.
struct disc {
    static constexpr auto name = "disc";
    static constexpr auto states = sivid::states({{"x", "m", 5}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "m"}});
    static constexpr auto constants = [] {
        using namespace sivid::literals;
        return sivid::constants({{"A", "m^2", 12.001_dec},
                                 {"D", "m", 4_dec},
                                 {"R", "m", 2_dec},
                                 {"F", "1/(m s)", 1_dec}});
    }();
    template <class T>
    std::array<relation_of_constants<T>, 2> derived(constants_of<disc, T> const& c) const {
        return {{{"R", c[1] / 2}, {"A", 3 * sqr(c[2])}}};
    }
    template <class T>
    states_of<disc, T> rate(T const&, states_of<disc, T> const&, constants_of<disc, T> const& c,
                            inputs_of<disc, T> const&) const {
        return {-c[3] * pown(c[1], 4) / c[0]};
    }
    template <class T>
    channels_of<disc, T> observe(T const&, states_of<disc, T> const& x,
                                 constants_of<disc, T> const&, inputs_of<disc, T> const&) const {
        return x;
    }
};

/// The rate and its derivatives by the parameters at a point.
std::vector<double> bound_at(recorded_model const& model, parameter_choice const& choice,
                             std::vector<double> const& p) {
    auto const bound = bind(model, choice, {});
    support::place_box where;
    where.x = box{interval(0.0)};
    where.p = box(p.size());
    for (std::size_t j = 0; j < p.size(); ++j) where.p[j] = interval(p[j]);
    auto outputs = bound.rate;
    outputs.insert(outputs.end(), bound.rate_dp[0].begin(), bound.rate_dp[0].end());
    std::vector<double> result;
    for (auto const& y : support::evaluate(bound.g, outputs, where).outputs) {
        result.push_back(mid(y));
    }
    return result;
}

std::vector<std::string> names_followed(recorded_model const& m, parameter_choice const& choice) {
    std::vector<std::string> names;
    for (auto const& d : followed(m, choice)) names.push_back(m.about.constants[d.constant].name);
    return names;
}
using names = std::vector<std::string>;

} // namespace

TEST_CASE("a derived constant follows once a constant of its formula is stated") {
    auto const m = record_model(disc{});
    CHECK(m.about.constants[0].formula == "3 * R^2");
    CHECK(m.about.constants[2].formula == "D / 2");
    CHECK(m.about.constants[1].formula.empty());
    CHECK(names_followed(m, {{"F"}, {}}).empty());
    CHECK(names_followed(m, {{"D"}, {}}) == names{"R", "A"});
    CHECK(names_followed(m, {{"F"}, {{"D", interval(3.0)}}}) == names{"R", "A"});
    CHECK(names_followed(m, {{"R"}, {}}) == names{"A"});
    CHECK(names_followed(m, {{"D"}, {{"R", interval(2.0)}}}) == names{"A"});
    CHECK(names_followed(m, {{"D", "A"}, {}}) == names{"R"});
    CHECK(names_followed(m, {{"A"}, {}}).empty());
    CHECK(names_followed(m, {{"D"}, {{"A", interval(12.0)}}}) == names{"R"});

    CHECK(derivation_words(m, {{"F"}, {}}).empty());
    auto const words = derivation_words(m, {{"D", "A"}, {}});
    REQUIRE(words.size() == 2);
    CHECK(words[0].find("R = D / 2") != std::string::npos);
    CHECK(words[1].find("whatever") != std::string::npos);
}

TEST_CASE("binding respects the relations, its derivatives too") {
    auto const m = record_model(disc{});
    // Nominal: the stated A, not its formula.
    auto const nominal = bound_at(m, {{"F"}, {}}, {1});
    CHECK_THAT(nominal[0], WithinRel(-256 / 12.001, 1e-14));
    // A = 3 D^2/4: the rate is -4/3 F D^2.
    auto const free = bound_at(m, {{"D"}, {}}, {3});
    CHECK_THAT(free[0], WithinRel(-12.0, 1e-14));
    CHECK_THAT(free[1], WithinRel(-8.0, 1e-14));
    auto const fixed = bound_at(m, {{"F"}, {{"D", interval(3.0)}}}, {2});
    CHECK_THAT(fixed[0], WithinRel(-24.0, 1e-14));
    auto const radius = bound_at(m, {{"R"}, {}}, {1});
    CHECK_THAT(radius[0], WithinRel(-256.0 / 3, 1e-14));
    // What the choice states of A comes first.
    auto const both = bound_at(m, {{"D", "A"}, {}}, {3, 10});
    CHECK_THAT(both[0], WithinRel(-8.1, 1e-14));
    CHECK_THAT(both[1], WithinRel(-10.8, 1e-14)); // -4 F D^3 / A
    auto const kept = bound_at(m, {{"D"}, {{"A", interval(10.0)}}}, {3});
    CHECK_THAT(kept[1], WithinRel(-10.8, 1e-14));
}

TEST_CASE("what data can tell apart respects the relations") {
    auto const m = record_model(disc{});
    auto const told = [&](parameter_choice const& choice) {
        auto const bound = bind(m, choice, {});
        return find_combinations({&bound});
    };
    auto const related = told({{"F", "D"}, {}}); // F D^2 alone counts
    REQUIRE(related.combinations.size() == 1);
    CHECK(related.combinations[0].formula == "F*D^2");
    auto const apart = told({{"F", "D"}, {{"A", interval(12.0)}}});
    REQUIRE(apart.combinations.size() == 1);
    CHECK(apart.combinations[0].formula == "F*D^4");
}

TEST_CASE("ranges of all constants contain the derived ones") {
    auto const m = record_model(disc{});
    auto const r = constant_ranges(m, {{"D"}, {}}, box{interval(2, 4)});
    CHECK(subset(interval(1, 2), r[2]));
    CHECK(subset(interval(3, 12), r[0]));
    CHECK(width(r[0]) < 9.001);
    CHECK(r[3].lower() == 1);
    CHECK(constant_ranges(m, {{"F"}, {}}, box{interval(2.0)})[2].lower() == 2);
    CHECK(constant_ranges(m, {{"D", "A"}, {}}, box{interval(2, 4), interval(7.0)})[0].lower() == 7);
}

TEST_CASE("effects leave relations between constants as they are") {
    using namespace sivid::literals;
    effect worn;
    worn.name = "worn";
    worn.parameters = {{"k", "1", 0_dec, 0.5_dec, 0_dec}};
    worn.on_inputs = [](effect_scope& s) { s.constant("D") *= 1 - s.parameter(); };
    auto const m = with(disc{}, worn);
    REQUIRE(m.derived.size() == 2);
    // Neutral, with D nominal: the model itself, whose A is nominal.
    CHECK_THAT(bound_at(m, {{"worn.k"}, {}}, {0})[0], WithinRel(-256 / 12.001, 1e-14));
    // The equations see the worn D; A follows the D that is stated.
    CHECK_THAT(bound_at(m, {{"D", "worn.k"}, {}}, {4, 0.5})[0], WithinRel(-16.0 / 12, 1e-14));
}

TEST_CASE("a derived constant follows what replaces the constants of its formula") {
    auto const m = record_model(disc{});
    recorded_map const twice(1, [](auto const& q) { return std::vector{2 * q[0]}; });
    auto const fresh = substituted(m, {"D"}, {{"half", "m", literal{interval(2.0), 2.0}}}, twice);
    CHECK_THAT(bound_at(fresh, {{"half"}, {}}, {1.5})[0], WithinRel(-12.0, 1e-14));
    CHECK_THAT(bound_at(fresh, {{"F"}, {}}, {1})[0], WithinRel(-64.0 / 3, 1e-14)); // D is 4
    CHECK_THAT(bound_at(fresh, {{"half", "A"}, {}}, {1.5, 10})[0], WithinRel(-8.1, 1e-14));
    // One that is replaced itself is no longer derived.
    auto const own = substituted(m, {"A"}, {{"B", "m^2", literal{interval(6.0), 6.0}}}, twice);
    CHECK_THAT(bound_at(own, {{"B", "D"}, {}}, {5, 3})[0], WithinRel(-8.1, 1e-14));
}

TEST_CASE("a derived constant may be computed in many steps") {
    auto m = record_model(disc{});
    m.derived.clear();
    expression const d(m.g, m.g.leaf(operation::constant, 1));
    expression root(1.5); // of d
    for (int k = 0; k < 40; ++k) root = root - (root * root - d) / (2 * root);
    model_detail::add_derived(m, "R", root);
    CHECK(m.about.constants[2].formula == "something that is too long to be shown");
    CHECK_THAT(bound_at(m, {{"D"}, {}}, {4})[0], WithinRel(-256 / 12.001, 1e-14));
    CHECK(names_followed(m, {{"D"}, {}}) == names{"R"});
}

TEST_CASE("relations that make no sense are refused, with the reason") {
    auto const refused = [](std::string const& name, auto const& formula) -> std::string {
        auto m = record_model(disc{});
        m.derived.clear();
        std::vector<expression> c;
        for (std::size_t k = 0; k < 4; ++k) {
            c.emplace_back(m.g, m.g.leaf(operation::constant, k));
        }
        try {
            formula(m, c);
        } catch (std::invalid_argument const& e) {
            CHECK(m.derived.size() < 2);
            return std::string(e.what()).find("'" + name + "'") != std::string::npos ? e.what()
                                                                                     : "?";
        }
        return "accepted";
    };
    auto const contains_text = [](std::string const& text, std::string const& part) {
        INFO(text);
        return text.find(part) != std::string::npos;
    };
    using model_detail::add_derived;
    CHECK(contains_text(refused("Q", [](auto& m, auto& c) { add_derived(m, "Q", c[1]); }),
                        "none of its constants"));
    CHECK(contains_text(refused("A", [](auto& m, auto& c) { add_derived(m, "A", c[0] * 1.0001); }),
                        "function of itself"));
    CHECK(contains_text(refused("A", [](auto& m, auto& c) { add_derived(m, "A", 4 * c[1]); }),
                        "is nominally 12.001, but 4 * D gives 16"));
    CHECK(contains_text(refused("A", [](auto& m, auto& c) { add_derived(m, "A", sqrt(-c[1])); }),
                        "gives no value"));
    CHECK(contains_text(refused("R",
                                [](auto& m, auto& c) {
                                    add_derived(m, "R", c[1] / 2);
                                    add_derived(m, "R", c[1] / 2);
                                }),
                        "stands twice"));
    CHECK(contains_text(refused("R",
                                [](auto& m, auto& c) {
                                    add_derived(m, "A", 3 * sqr(c[2]));
                                    add_derived(m, "R", c[1] / 2);
                                }),
                        "comes before it"));
    CHECK(contains_text(refused("A",
                                [](auto& m, auto&) {
                                    expression const t(m.g, m.g.leaf(operation::time, 0));
                                    add_derived(m, "A", 12 + t);
                                }),
                        "more than constants"));
}
