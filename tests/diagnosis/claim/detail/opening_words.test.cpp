// SPDX-License-Identifier: MIT
#include <sivid/diagnosis/claim/detail/opening_words.hpp>

#include "diagnosis/small_campaign.hpp"
#include "support/catch.hpp"

using namespace sivid;

TEST_CASE("a sentence claims what is proved and nothing else") {
    auto const p = small_campaign::problem();
    approximate_fit fit;
    fit.residuals.assign(2, std::vector<double>(80, 0.5));
    fit.residuals[1][7] = -3; // of two channels in turn: v
    diagnosis d;
    CHECK(opening_words(d, p, fit) ==
          "no parameter was found that explains the data; missed most: channel v in E2");
    d.relations.push_back({"v", {"v"}, true, {}, {}});
    CHECK(opening_words(d, p, fit) ==
          "no parameter was found that explains the data: equation v or its sensors (proved)");
    suspected_place place;
    place.kind = "equation";
    place.name = "v";
    d.where.push_back(place);
    place.kind = "sensor";
    place.name = "p";
    d.where.push_back(place);
    CHECK(opening_words(d, p, fit) ==
          "no parameter was found that explains the data: equation v, sensor p");
    d.gap = gap_verdict::certified;
    d.where[0].proved = true;
    CHECK(opening_words(d, p, fit) == "a gap is proved: equation v (proved), sensor p");
    d.gap = gap_verdict::none;
    CHECK(opening_words(d, p, fit) == "no gap: parameters are proved to explain the data");
}

TEST_CASE("outlier budgets are no miss") {
    auto p = small_campaign::problem();
    for (auto& e : p.experiments) e.outliers = 1;
    approximate_fit fit;
    fit.residuals.assign(2, std::vector<double>(80, 0.5));
    fit.residuals[0][3] = 40; // the one outlier
    fit.residuals[1][6] = 3;
    fit.residuals[1][8] = 2;
    CHECK(most_missed(p, fit) == "channel p in E2");
    CHECK(most_missed(p, {}).empty());
}
