// SPDX-License-Identifier: MIT
#include <sivid/model/structure/rounded_sign.hpp>

#include "support/catch.hpp"
#include "support/models.hpp"

#include <string>
#include <vector>

using namespace sivid;

namespace {

/// A mass with friction: place x0, speed x1, friction p0 that is rounded off below p1.
template <class Way>
identification_problem pushed(Way way) {
    identification_problem p;
    p.model = support::model_of({2, 2}, support::recorded_rate([way](auto const&, auto const& x,
                                                                     auto const& c, auto const&) {
                                    return std::vector{x[1], 1.0 - way(x[1], c[0], c[1])};
                                }));
    p.choice = {{"p0"}, {{"p1", interval(0.05)}}};
    p.prior = {interval(0, 2)};
    experiment e;
    e.name = "A";
    e.initial = {interval(0.0), interval(0.0)};
    p.experiments = {e};
    return p;
}

void read(identification_problem& p, std::size_t channel, double t, double y, double error) {
    p.experiments[0].measurements.push_back({t, channel, support::around(y, error)});
}

} // namespace

TEST_CASE("a model whose friction is rounded off is told where the data stand still") {
    using std::sqrt;
    using std::tanh;
    auto const root = pushed([](auto w, auto k, auto s) { return k * w / sqrt(sqr(w) + sqr(s)); });
    auto const apart =
        pushed([](auto w, auto k, auto s) { return k * (w / sqrt(sqr(s) + w * w)); });
    auto const steep = pushed([](auto w, auto k, auto s) { return k * tanh(w / s); });
    auto const quick = pushed([](auto w, auto k, auto) { return k * tanh(20.0 * w); });
    for (auto p : {root, apart, steep, quick}) {
        CHECK(creeping_words(p).empty());
        // A turning point: less than ten times what s moves.
        for (int k = 0; k < 4; ++k) read(p, 0, 0.1 * k, 1, 0.001);
        read(p, 0, 0.4, 2, 0.001);
        CHECK(creeping_words(p).empty());
        for (int k = 0; k < 11; ++k) read(p, 0, 1 + 0.1 * k, 3, 0.001);
        auto const words = creeping_words(p);
        REQUIRE(words.size() == 1);
        INFO(words[0]);
        CHECK(words[0].find("the sign of x1 is rounded off below 0.05") != std::string::npos);
        CHECK(words[0].find("where y0 stands still, as in A from 1 to 2 s, the") !=
              std::string::npos);
    }
    auto idle = root; // friction that is known to be 0
    idle.choice = {{"p1"}, {{"p0", interval(0.0)}}};
    auto exact = pushed([](auto w, auto k, auto) { return k * sign(w); });
    auto drag = pushed([](auto w, auto k, auto s) { return k * w / sqrt(1.0 + sqr(w * s)); });
    auto sine = pushed([](auto w, auto k, auto s) { return k / sqrt(sqr(w) + sqr(s)); });
    for (auto* p : {&idle, &exact, &drag, &sine}) {
        for (int k = 0; k < 11; ++k) read(*p, 0, 0.1 * k, 1, 0.001);
        CHECK(creeping_words(*p).empty());
    }
}
