// SPDX-License-Identifier: MIT
// The contractors of the default strategy.
#include <sivid/paving/strategy/strategy.hpp>

#include "diagnosis/planted_records.hpp"
#include "support/catch.hpp"
#include "support/epidemic.hpp"
#include "support/planted_curves.hpp"
#include "support/planted_problems.hpp"
#include "support/problems.hpp"
#include "support/sweep.hpp"

#include <sivid/paving/identify.hpp>
#include <sivid/paving/strategy/contains_truth.hpp>
#include <sivid/paving/strategy/detail/by_parts.hpp>
#include <sivid/paving/strategy/inquiry.hpp>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace sivid;
using support::draws;

namespace {

std::vector<std::shared_ptr<contractor const>> all_contractors() {
    std::vector<std::shared_ptr<contractor const>> all;
    for (auto const& step : default_strategy().steps)
        all.insert(all.end(), step.by.begin(), step.by.end());
    return all;
}

/// Calls visit(problem, truth, draws) for planted problems of three kinds.
template <class Visit>
void each_planted(std::size_t count, Visit const& visit) {
    for (std::size_t n = 0; n < count; ++n) {
        draws d(8810 + n);
        CAPTURE(n);
        if (n % 3 == 0) {
            auto const kinds = diagnosis_support::all_planted();
            auto const& what = kinds[d.below(kinds.size())];
            auto const r =
                diagnosis_support::record_of(d, what, support::model_of(what.shape, what.rate));
            visit(r.problem, r.truth, d);
        } else if (n % 3 == 1) {
            auto const p = support::plant_curve(d, d.coin());
            visit(p.problem, p.truth, d);
        } else {
            auto const p = support::plant(
                d, d.below(support::planted_models),
                {.experiments = 1 + d.below(2), .outliers = d.below(2), .spread = 0.05});
            visit(p.problem, p.truth, d);
        }
    }
}

} // namespace

TEST_CASE("every contractor keeps the truth, over the prior and over parts of it, repeatedly") {
    each_planted(support::swept(6U, 300U), [](auto const& problem, auto const& truth, draws& d) {
        for (auto const& by : all_contractors()) {
            INFO(by->name());
            CHECK(contains_truth(*by, problem, truth,
                                 {.parts = 1, .seconds = 1, .seed = d.below(1000)}));
        }
    });
}

TEST_CASE("contractors keep the truth in any order, whenever they are asked") {
    each_planted(support::swept(6U, 300U), [](auto const& problem, auto const& truth, draws& d) {
        strategy how;
        std::string order;
        auto const all = all_contractors();
        for (int k = 0; k < 5; ++k) {
            how.steps.push_back({{all[d.below(all.size())]}, 0.5});
            order += how.steps.back().by[0]->name() + ", ";
        }
        CAPTURE(order);
        inquiry asked(problem, {}, {}, work_limit(4));
        contract(how, asked);
        CHECK(contains(asked.problem().prior, truth));
        CHECK(asked.journal().size() == 5);
    });
}

TEST_CASE("a search of parts leaves most of its time to them") {
    for (auto const& step : default_strategy(search_kind::parts).steps) CHECK(step.share <= 0.3);
    CHECK(default_strategy().without("shapes").steps.size() == default_strategy().steps.size() - 1);
}

TEST_CASE("where outliers are allowed groups of measurements are asked") {
    auto p = support::infection(1e7, 1);
    auto& readings = p.experiments[0].measurements;
    readings[3].bound = interval(1e-3, 2e-3);
    p.experiments[0].outliers = 1;
    auto const left = [&](strategy const& how) {
        inquiry asked(p, {}, {}, work_limit(1e3));
        contract(how, asked);
        return asked.problem().prior;
    };
    auto const how = default_strategy();
    auto const found = left(how);
    CHECK(contains(found, std::vector<double>{0.5, 0.3}));
    CHECK(found[0].upper() < 1000);
    CHECK(left(how.without("groups of measurements"))[0].upper() == 1e7);
    for (auto& m : readings) m.bound = interval(m.time, m.time + 0.1); // no outlier, but nonsense
    CHECK(is_empty(left(how)));
    p.experiments[0].outliers = 8;
    CHECK(left(how)[0].upper() == 1e7);
}

namespace {

/// Knows the truth of boxes of less than half of the prior; of others it says nothing.
class short_sighted : public contractor {
public:
    [[nodiscard]] std::string name() const override { return "short-sighted"; }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const&,
                                      contraction_record&) const override {
        auto const& x = asked.problem().prior;
        for (auto const& side : x)
            if (width(side) > 2.6) return asked.left();
        return {intersect(x, box{interval(1.0, 1.125), interval(3.0, 3.25)})};
    }
};

} // namespace

TEST_CASE("contractors that are blind to the whole prior are asked about its parts") {
    auto p = support::infection(10, 1);
    p.prior = {interval(0.0, 5.0), interval(0.0, 5.0)};
    strategy const blind{{{{std::make_shared<short_sighted>()}}}};
    auto const parts = std::make_shared<paving_detail::by_parts>(blind);
    inquiry asked(p, {}, {}, work_limit(1e3));
    contract({{{blind.steps[0].by}, {{parts}}}}, asked);
    auto const& left = asked.problem().prior;
    CHECK(subset(box{interval(1.0, 1.125), interval(3.0, 3.25)}, left));
    CHECK((width(left[0]) < 0.13 && width(left[1]) < 0.26)); // rounded outward
    REQUIRE(asked.journal().size() == 2);
    CHECK(asked.journal()[0].how == contraction_record::outcome::idle);
    CHECK(asked.journal()[1].figure("parts") == 8); // four, then four of what is left
    CHECK(strategy{{{{parts}}}}.without("short-sighted").steps[0].by[0] != parts);
    inquiry late(p, {}, {}, work_limit(0));
    work_limit const none(0);
    contraction_record says;
    CHECK(subset(p.prior, (*parts)(late, none, says).parameters));
}
