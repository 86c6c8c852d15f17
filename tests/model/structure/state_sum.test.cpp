// SPDX-License-Identifier: MIT
#include <sivid/model/structure/state_sum.hpp>

#include "paving/relation/planted_balances.hpp"
#include "support/catch.hpp"

#include <sivid/model/graph/graph_range.hpp>

using namespace relation_support;

namespace {

bound_model opened(recorded_model const& m, std::size_t constants) {
    return bind(m, {support::all_constants(constants), {}},
                {sampled_signal({0.0}, {0.0}, interpolation::linear)});
}

} // namespace

TEST_CASE("sums of states change by their rates, wherever the states are") {
    draws d(731);
    for (auto const& what : all_balanced()) {
        auto const& s = what.system;
        INFO(s.name);
        auto model = opened(support::model_of(s.shape, s.rate), s.shape.constants);
        auto const sums = find_state_sums(model.g, model.rate);
        CHECK(sums.size() == what.sums);
        auto nodes = model.rate;
        for (auto const& sum : sums) {
            nodes.push_back(sum.rate);
            CHECK_FALSE(sum.weights.empty());
            for (auto const& w : sum.weights) {
                nodes.push_back(w.value);
                CHECK((model.g.depends(w.value) & ~on_constant) == 0);
            }
        }
        graph_range at(model.g, nodes);
        for (int n = 0; n < 200; ++n) {
            leaf_ranges x{interval(d.uniform(0, 3)), box(s.shape.states),
                          point_box(d.in(what.truths)), box{interval(d.uniform(-2, 2))}};
            for (std::size_t i = 0; i < s.shape.states; ++i)
                x.states[i] = interval(d.uniform(0.01, 3));
            at.evaluate(x);
            for (auto const& sum : sums) {
                auto off = at.value(sum.rate) - at.value(model.rate[sum.first]);
                for (auto const& w : sum.weights)
                    off = off - at.value(w.value) * at.value(model.rate[w.state]);
                CHECK((off.lower() <= 0 && 0 <= off.upper()));
                CHECK(width(off) < 1e-9);
            }
        }
    }
}

TEST_CASE("what is conserved of an enzyme is found with small integers") {
    auto model = opened(support::model_of({4, 3, 1}, michaelis), 3);
    auto const sums = find_state_sums(model.g, model.rate);
    auto const found = [&](std::size_t first, std::vector<std::pair<std::size_t, double>> of) {
        return std::any_of(sums.begin(), sums.end(), [&](state_sum const& s) {
            bool same = s.first == first && model.g.is(s.rate, 0) && s.weights.size() == of.size();
            for (std::size_t k = 0; same && k < of.size(); ++k)
                same = s.weights[k].state == of[k].first &&
                       model.g.is(s.weights[k].value, of[k].second);
            return same;
        });
    };
    CHECK(found(1, {{2, 1}}));
    CHECK(found(0, {{2, 1}, {3, 1}}));
    CHECK(found(0, {{1, -1}, {3, 1}}));
}

TEST_CASE("products of constants are weights, and what is not affine is left out") {
    auto const rates = [](auto const& rate, support::shape const& shape) {
        auto model = opened(support::model_of(shape, rate), shape.constants);
        return find_state_sums(model.g, model.rate).size();
    };
    // Yields with decimals that no double is.
    CHECK(rates(
              [](expression const&, terms const& x, terms const& p, terms const&) {
                  auto const g = p[0] * exp(-x[0]);
                  return terms{0.3_dec * g, -g / (0.7_dec * p[1]), sqr(p[1]) * g * 1.1_dec};
              },
              {3, 2, 1}) == 3);
    // A flow that is left over, one that is linear, and one of an input.
    auto const left = [&](auto const& more) {
        return rates(
            [more](expression const&, terms const& x, terms const& p, terms const& u) {
                auto const g = p[0] * x[0] * x[1];
                return terms{-g, g + more(x, p, u)};
            },
            {2, 2, 1});
    };
    CHECK(left([](auto const& x, auto const&, auto const&) { return sqr(x[1]); }) == 0);
    CHECK(left([](auto const& x, auto const& p, auto const& u) { return p[1] * u[0] * x[1]; }) ==
          1);
    CHECK(left([](auto const&, auto const&, auto const& u) { return sin(u[0]); }) == 1);
    // A weight with several terms in every state is no weight to divide by.
    CHECK(rates(
              [](expression const&, terms const& x, terms const& p, terms const&) {
                  auto const g = sin(x[0]);
                  return terms{(p[0] + p[1]) * g, (p[0] - p[1]) * g};
              },
              {2, 2, 1}) == 0);
}
