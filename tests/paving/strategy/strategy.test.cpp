// SPDX-License-Identifier: MIT
#include <sivid/paving/strategy/strategy.hpp>

#include "paving/plain_problem.hpp"
#include "support/catch.hpp"

#include <sivid/paving/strategy/inquiry.hpp>

#include <functional>
#include <memory>
#include <string>
#include <utility>

using namespace sivid;
using outcome = contraction_record::outcome;

namespace {

/// Leaves what it is told to of the first side, as often as it is asked.
class cutting : public contractor {
public:
    cutting(std::string name, std::function<double()> share, std::string obstacle = "")
        : name_(std::move(name)), share_(std::move(share)), obstacle_(std::move(obstacle)) {}
    [[nodiscard]] std::string name() const override { return name_; }
    [[nodiscard]] std::string obstacle(identification_problem const&) const override {
        return obstacle_;
    }
    [[nodiscard]] leftover operator()(inquiry& asked, work_limit const&,
                                      contraction_record& says) const override {
        ++says.integrations;
        auto left = asked.problem().prior;
        left[0] = interval(left[0].lower(), left[0].lower() + share_() * width(left[0]));
        return {left};
    }

private:
    std::string name_;
    std::function<double()> share_;
    std::string obstacle_;
};

std::shared_ptr<contractor const> cuts(std::string name, std::function<double()> share,
                                       std::string obstacle = "") {
    return std::make_shared<cutting>(std::move(name), std::move(share), std::move(obstacle));
}

} // namespace

TEST_CASE("contractors of a step are asked in turn, each again when another has gained") {
    inquiry asked(plain_problem::make(), {}, {}, work_limit(60));
    int left_a = 2, left_b = 1;
    strategy const how{{{{cuts("a", [&] { return left_a-- > 0 ? 0.5 : 1; }),
                          cuts("b", [&] { return left_b-- > 0 ? 0.5 : 1; })}}}};
    contract(how, asked);
    auto const& j = asked.journal();
    REQUIRE(j.size() == 2);
    CHECK(j[0].integrations == 2); // its second gain is after that of b
    CHECK(j[1].integrations == 2);
    CHECK(j[0].how == outcome::gained);
    CHECK(j[0].left < 0.26);
    CHECK(j[1].left < 0.51);
    CHECK(width(asked.problem().prior[0]) < 0.13 * width(plain_problem::make().prior[0]));
}

TEST_CASE("steps say why they were not tried, and one may end the rest") {
    inquiry asked(plain_problem::make(), {}, {}, work_limit(60));
    auto const same = [] { return 1.0; };
    strategy const how{{{{cuts("none", same, "delays")}},
                        {{cuts("later", same)},
                         1,
                         [](inquiry&) {
                             return strategy::promise{false, "too early"};
                         }},
                        {{cuts("idle", same)}, 1, nullptr, true},
                        {{cuts("last", [] { return 0.9; })}, 1, nullptr, true},
                        {{cuts("never", same)}}}};
    contract(how, asked);
    auto const& j = asked.journal();
    REQUIRE(j.size() == 4);
    CHECK(j[0].why == "delays");
    CHECK(j[0].how == outcome::not_applicable);
    CHECK(j[1].why == "too early");
    CHECK(j[2].how == outcome::idle);
    CHECK(j[3].how == outcome::gained);
    CHECK(asked.gained("last"));
    CHECK_FALSE(asked.gained("idle"));
    CHECK(how.without("last").steps.size() == 4);
}

TEST_CASE("without time nothing is asked, and that is said") {
    inquiry asked(plain_problem::make(), {}, {}, work_limit(0));
    contract({{{{cuts("a", [] { return 0.5; })}}}}, asked);
    REQUIRE(asked.journal().size() == 1);
    CHECK(asked.journal()[0].how == outcome::cut_short);
    CHECK(asked.journal()[0].integrations == 0);
    CHECK_FALSE(asked.narrowed());
}
