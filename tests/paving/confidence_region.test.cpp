// SPDX-License-Identifier: MIT
// Regions with a stated probability: how often they hold the truth, what their boxes say beside the
// definition in plain doubles, and what is refused.
#include <sivid/paving/confidence_region.hpp>

#include "paving/confidence/confidence_models.hpp"
#include "support/catch.hpp"

using namespace sivid;
using namespace confidence_models;
using support::draws;

namespace {

template <class Model>
recorded<Model> usual();
template <>
recorded<line> usual() {
    return {{1, 0.5}, {interval(-10, 10), interval(-10, 10)}, 12, 2};
}
template <>
recorded<decay> usual() {
    return {{1, 0.5}, {interval(0.2, 4), interval(0.1, 2)}, 12, 4};
}
template <>
recorded<two_decays> usual() {
    return {{1, 0.3, 2, 2},
            {interval(0.5, 1.5), interval(0.1, 0.6), interval(1, 3), interval(1, 4)},
            16,
            4};
}

/// Whether the region holds the truth, asked of the truth alone.
box_verdict holds(identification_problem const& problem, std::vector<double> const& truth,
                  double probability, confidence_options const& options) {
    confidence_test test(problem, options.test);
    (void)prepare_confidence(test, probability, options);
    return test.learn({point_box(truth)})[0].verdict;
}

/// So far may a share of n draws be from p: three standard deviations, and half a draw.
double binomial_error(double p, std::size_t n) {
    double const all = static_cast<double>(n);
    return 3 * std::sqrt(p * (1 - p) / all) + 0.5 / all;
}

/// Draws records, each with signs of its own.
template <class Model>
void check_coverage(std::uint64_t seed, std::size_t records, double probability,
                    std::size_t sums = 20) {
    auto data = usual<Model>();
    for (auto const kind : all_noises) {
        draws d(seed);
        std::size_t held = 0, open = 0;
        for (std::size_t n = 0; n < records; ++n) {
            data.draw(kind, 0.05, d);
            auto const says =
                holds(data.problem, data.truth, probability, {.seed = seed + n, .sums = sums});
            held += says == box_verdict::inside ? 1 : 0;
            open += says == box_verdict::undecided ? 1 : 0;
        }
        double const share = static_cast<double>(held) / static_cast<double>(records);
        CAPTURE(Model::name, static_cast<int>(kind), share);
        CHECK(std::abs(share - probability) <= binomial_error(probability, records));
        CHECK(open == 0);
        if (records > 1000)
            WARN(Model::name << ", errors " << static_cast<int>(kind) << ": " << held << " of "
                             << records << " regions of " << probability << " hold the truth");
    }
}

/// Whether a point is in the region by its definition; nothing where rounding might decide.
template <class Model>
int by_definition(recorded<Model> const& data, confident_region const& region,
                  std::vector<double> const& p) {
    auto const n = data.times.size();
    auto const r = static_cast<std::size_t>(region.weights.cols());
    sign_source draw(region.seed);
    auto const own = draw();
    std::vector<bool> wins;
    for (std::size_t k = 1; k < region.sums; ++k) wins.push_back(draw() > own);
    auto const norm_of = [&](auto const& sign) {
        double norm = 0;
        std::vector<double> sum(r, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            double const s = sign();
            for (std::size_t j = 0; j < r; ++j)
                sum[j] +=
                    s * region.weights(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                    (data.seen[i] - Model::output(data.times[i], p));
        }
        for (double const x : sum) norm += x * x;
        return norm;
    };
    double const mine = norm_of([] { return 1.0; });
    std::size_t above = 0;
    for (std::size_t k = 1; k < region.sums; ++k) {
        bool minus = false, plus = false;
        double const other = norm_of([&] {
            bool const is_minus = draw() >> 63U != 0;
            minus = minus || is_minus;
            plus = plus || !is_minus;
            return is_minus ? -1.0 : 1.0;
        });
        bool const tie = !minus || !plus;
        if (!tie && std::abs(other - mine) < 1e-9 * (other + mine)) return -1;
        above += tie ? (wins[k - 1] ? 1 : 0) : (other > mine ? 1 : 0);
    }
    return above >= region.above ? 1 : 0;
}

template <class Model>
void check_boxes(std::uint64_t seed, double size, confidence_options options) {
    auto data = usual<Model>();
    draws d(seed);
    data.draw(noise::laplace, size, d);
    options.seed = seed;
    options.search.sufficient_ratio = 0.5;
    auto const found = confidence_region(data.problem, 0.9, options);
    CAPTURE(Model::name, seed, found.found.tested);
    std::size_t asked = 0, inside = 0;
    auto const& boxes = found.found.paving.boxes();
    for (std::size_t k = 0; k < boxes.size(); k += 1 + boxes.size() / 800) {
        auto const& b = boxes[k];
        if (b.verdict == box_verdict::undecided || b.verdict == box_verdict::pending) continue;
        bool const is_inside = b.verdict == box_verdict::inside;
        auto const says = by_definition(data, found, d.in(b.set));
        CHECK((says == -1 || says == (is_inside ? 1 : 0)));
        inside += is_inside ? 1 : 0;
        ++asked;
    }
    CHECK(asked > 5);
    CHECK((inside > 0 || options.search.boxes < 5000));
    auto const truth = by_definition(data, found, data.truth);
    for (auto const& b : found.found.paving.boxes()) {
        if (!contains(b.set, data.truth)) continue;
        CHECK((truth != 1 || b.verdict != box_verdict::outside));
        CHECK((truth != 0 || b.verdict != box_verdict::inside));
    }
}

std::string refused(identification_problem const& problem, double probability = 0.95,
                    confidence_options const& options = {}) {
    try {
        (void)confidence_region(problem, probability, options);
    } catch (std::invalid_argument const& e) {
        return e.what();
    }
    return "";
}
using Catch::Matchers::ContainsSubstring;

} // namespace

TEST_CASE("regions hold the truth as often as stated") {
    check_coverage<line>(100, 300, 0.9);
    check_coverage<decay>(200, 300, 0.95);
    check_coverage<two_decays>(300, 120, 0.5);
}
TEST_CASE("regions of 95 percent hold the truth in 95 percent of 2000 records", "[.long]") {
    check_coverage<line>(1000, 2000, 0.95);
    check_coverage<decay>(4000, 2000, 0.95);
    check_coverage<two_decays>(7000, 2000, 0.95);
    check_coverage<decay>(10000, 2000, 0.95, 100);
}

TEST_CASE("two measurements, whose sums are equal every other time, give the probability, too") {
    recorded<line> data({0, 0.5}, {interval(-10, 10), interval(-10, 10)}, 2, 2);
    draws d(7);
    data.draw(noise::gaussian, 0.1, d);
    CHECK_THAT(refused(data.problem), ContainsSubstring("2 measurements cannot test"));
    data.problem.choice = {{"b"}, {{"a", interval(0.0)}}};
    data.problem.prior = {interval(-10, 10)};
    std::size_t held = 0;
    for (std::size_t n = 0; n < 1000; ++n) {
        data.draw(noise::gaussian, 0.1, d);
        held +=
            holds(data.problem, {0.5}, 0.8, {.seed = n, .sums = 5}) == box_verdict::inside ? 1 : 0;
    }
    CHECK(std::abs(static_cast<double>(held) / 1000 - 0.8) <= binomial_error(0.8, 1000));
}

TEST_CASE("boxes of a region say what its definition says of their points") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        check_boxes<line>(seed, 0.1, {});
        check_boxes<decay>(seed, 0.05, {});
    }
    confidence_options coarse;
    coarse.search.boxes = 1000;
    check_boxes<two_decays>(9, 0.01, coarse);
    for (double const nominal : {0.3, 1.9}) // wherever the model is linearised
        check_boxes<decay>(3, 0.05, {.nominal = {{"A", 2}, {"k", nominal}}});
}

TEST_CASE("a region is the same for any number of threads, and its signs are everybody's") {
    sign_source draw(1234567);
    CHECK(draw() == 6457827717110365317U); // the published sequence
    CHECK(draw() == 3203168211198807973U);
    auto data = usual<decay>();
    draws d(4);
    data.draw(noise::uniform, 0.1, d);
    auto const once = confidence_region(data.problem, 0.95);
    auto const again = confidence_region(data.problem, 0.95);
    CHECK(once.sums == 100);
    CHECK(once.above == 5);
    CHECK(once.probability() == 0.95);
    CHECK(once.found.tested == again.found.tested);
    CHECK(subset(once.found.paving.outer_hull(), again.found.paving.outer_hull()));
    CHECK(once.found.paving.inner_volume().lower() == again.found.paving.inner_volume().lower());
    auto const other = confidence_region(data.problem, 0.95, {.seed = 2});
    CHECK(other.found.paving.inner_volume().lower() != once.found.paving.inner_volume().lower());
    CHECK(is_complete(once.found.reason));
    CHECK(once.found.paving.inner_volume().lower() >=
          0.79 * once.found.paving.outer_volume().upper());
}

TEST_CASE("weights look neither at measured values nor at their bounds") {
    auto data = usual<decay>();
    draws d(5);
    data.draw(noise::gaussian, 0.1, d);
    auto const one = confidence_region(data.problem, 0.95, {.search = {.boxes = 1}});
    data.draw(noise::mixed, 100, d);
    for (auto& m : data.problem.experiments[0].measurements) // bounds that follow the values
        m.bound = interval(0.9, 1.1) * mid(m.bound);
    auto const other = confidence_region(data.problem, 0.95, {.search = {.boxes = 1}});
    CHECK(one.weights == other.weights);
    CHECK(one.measured != other.measured);
}

TEST_CASE("unknown starts are unknowns of the region") {
    auto data = usual<decay>();
    data.problem.experiments[0].initial = {interval(0.5, 2)};
    data.problem.choice = {{"k"}, {{"A", interval(1.0)}}};
    data.problem.prior = {interval(0.1, 2)};
    auto second = data.problem.experiments[0];
    second.name = "again";
    second.initial = {interval(1.0)};
    data.problem.experiments.push_back(second);
    draws d(11);
    std::size_t held = 0;
    for (std::size_t n = 0; n < 300; ++n) {
        data.draw(noise::laplace, 0.05, d);
        data.problem.experiments[1].measurements = data.problem.experiments[0].measurements;
        data.draw(noise::laplace, 0.05, d);
        held += holds(data.problem, {0.5, 1}, 0.9, {.seed = n, .sums = 20}) == box_verdict::inside
                    ? 1
                    : 0;
    }
    CHECK(std::abs(static_cast<double>(held) / 300 - 0.9) <= binomial_error(0.9, 300));
    auto const found = confidence_region(data.problem, 0.9);
    REQUIRE(found.names.size() == 2);
    CHECK(found.names[1] == "x at the start of run");
    CHECK(found.found.paving.inner_volume().lower() > 0);
    CHECK(width(found.found.paving.outer_hull()[1]) < 0.5);
}

TEST_CASE("what the theorem does not cover is refused in words") {
    auto data = usual<decay>();
    draws d(6);
    data.draw(noise::gaussian, 0.1, d);
    auto const& good = data.problem;
    for (double const p : {0.0, 1.0, -0.5, 1.5, std::nan(""), HUGE_VAL})
        CHECK_THAT(refused(good, p), ContainsSubstring("not between 0 and 1"));
    CHECK_THAT(refused(good, 0.123456789), ContainsSubstring("round it to four digits"));
    CHECK(refused(good, 2.0 / 3, {.search = {.boxes = 1}}).empty());
    CHECK_THAT(refused(good, 0.95, {.nominal = {{"B", 1}}}), ContainsSubstring("no unknown 'B'"));
    CHECK_THAT(refused(good, 0.95, {.nominal = {{"k", 7}}}), ContainsSubstring("not in the prior"));
    CHECK_THAT(refused(good, 0.95, {.nominal = {{"k", std::nan("")}}}),
               ContainsSubstring("not in the prior"));

    auto one_sided = good;
    one_sided.experiments[0].measurements[3].bound = interval(0.5, HUGE_VAL);
    CHECK_THAT(refused(one_sided), ContainsSubstring("bounded on one side"));
    auto condition = good;
    condition.experiments[0].constraint = true;
    CHECK_THAT(refused(condition), ContainsSubstring("is a condition"));
    auto idle = good; // k does nothing where A is 0, and A nothing
    idle.experiments[0].initial = {interval(0.0)};
    CHECK_THAT(refused(idle), ContainsSubstring("moves any measured output"));
    // A and x(0) move the outputs alike: the region is exact, and says what it cannot tell apart.
    auto alike = good;
    alike.experiments[0].initial = {interval(0.5, 2)};
    auto const found = confidence_region(alike, 0.95, {.search = {.boxes = 200}});
    CHECK(found.weights.cols() == 2);
    REQUIRE(found.remarks.size() == 1);
    CHECK_THAT(found.remarks[0], ContainsSubstring("3 unknowns move the outputs in 2 ways"));
}
