// SPDX-License-Identifier: MIT
#include <sivid/model/graph/program.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"
#include "support/random.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

using namespace sivid;
using support::between;
using support::draws;

namespace {

using proven = proven_arithmetic<interval>;
using plain = approximate_arithmetic;

auto const model =
    support::model_of({2, 2, 1}, [](auto const& t, auto const& x, auto const& p, auto const& u) {
        return std::vector{log(x[0] - p[0]) * u[0] + 0.5, sqrt(x[1]) / p[1] + pown(t, 3)};
    });

template <class T>
auto reader(T t, std::vector<T> const& x, std::vector<T> const& p, std::vector<T> const& u) {
    return [=](operation op, std::size_t k) {
        return op == operation::time    ? t
               : op == operation::state ? x[k]
               : op == operation::input ? u[k]
                                        : p[k];
    };
}

} // namespace

TEST_CASE("a program computes its outputs in any arithmetic, and intervals hold the doubles") {
    program const code(model.g, model.rate);
    auto m = code.memory<plain>();
    auto wide = code.memory<proven>();
    draws d(31);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<interval> x{d.interval(3, 5, 0.5), d.interval(1, 2, 0.5)};
        std::vector<interval> p{d.interval(0, 1, 0.5), d.interval(1, 2, 0.5)};
        std::vector<interval> u{d.interval(-1, 1, 0.5)};
        auto const t = d.interval(0, 2, 0.5);
        code.read(wide, reader(t, x, p, u));
        REQUIRE_FALSE(code.run<proven>(wide));
        for (int sample = 0; sample < 20; ++sample) {
            double const at = d.in(t);
            std::vector<double> const xs{d.in(x[0]), d.in(x[1])}, ps{d.in(p[0]), d.in(p[1])},
                us{d.in(u[0])};
            code.read(m, reader(at, xs, ps, us));
            code.run<plain>(m);
            double const first = std::log(xs[0] - ps[0]) * us[0] + 0.5;
            double const second = std::sqrt(xs[1]) / ps[1] + at * at * at;
            CHECK_THAT(m[model.rate[0]], WithinAbs(first, 1e-12));
            CHECK_THAT(m[model.rate[1]], WithinAbs(second, 1e-12));
            for (std::size_t i : {0u, 1u}) {
                double const y = m[model.rate[i]];
                CHECK(wide[model.rate[i]].lower() <= y + 1e-12);
                CHECK(wide[model.rate[i]].upper() >= y - 1e-12);
            }
        }
    }
}

TEST_CASE("what is not defined is told, for all steps or one by one") {
    program const code(model.g, model.rate);
    auto m = code.memory<proven>();
    code.read(m, reader<interval>(0.0, {between(0, 2), between(-1, 1)}, {1.0, 2.0}, {1.0}));
    CHECK(code.run<proven>(m));
    std::vector<operation> undefined;
    code.run<proven>(m, [&](program::step const& s, bool flag) {
        if (flag) undefined.push_back(s.op);
    });
    CHECK(undefined == std::vector{operation::log, operation::sqrt});
    program const second(model.g, {model.rate[1]}); // the other output plays no part
    CHECK(second.steps().size() < code.steps().size());
    CHECK(second.leaves().size() == 3);
    second.read(m, reader<interval>(0.0, {between(0, 2), between(1, 2)}, {1.0, 2.0}, {1.0}));
    CHECK_FALSE(second.run<proven>(m));
}

TEST_CASE("slots of one's own, in parts that share a memory") {
    auto const needed = operands_of(model.g, model.rate);
    std::vector<bool> leaves(model.g.size()), others(model.g.size());
    for (std::size_t k = 0; k < model.g.size(); ++k) {
        bool const leaf = is_leaf(model.g.nodes()[k].op);
        leaves[k] = needed[k] && leaf;
        others[k] = needed[k] && !leaf;
    }
    auto const n = model.g.size();
    auto const place = [n](std::size_t k) { return static_cast<program::slot>(n - 1 - k); };
    program const first(model.g, leaves, place, n), second(model.g, others, place, n);
    CHECK(first.steps().empty());
    CHECK(second.leaves().empty());
    auto m = first.memory<plain>();
    first.read(m, reader<double>(2, {3, 4}, {1, 2}, {1}));
    second.run<plain>(m);
    CHECK(m[place(model.rate[0])] == std::log(2.0) + 0.5);
    CHECK(m[place(model.rate[1])] == 9);
}

TEST_CASE("a program without outputs does nothing") {
    program const none;
    auto m = none.memory<plain>();
    CHECK(m.empty());
    CHECK_FALSE(none.run<plain>(m));
}

TEST_CASE("plain powers are those of repeated products") {
    bool undefined = false;
    CHECK(plain::pown(3, 5, undefined) == 243);
    CHECK(plain::pown(-2, 3, undefined) == -8);
    CHECK(plain::pown(2, -2, undefined) == 0.25);
    CHECK(plain::pown(0, 0, undefined) == 1);
    CHECK_THAT(plain::pown(1.1, 17, undefined), WithinRel(std::pow(1.1, 17), 1e-14));
    CHECK_FALSE(undefined);
}
