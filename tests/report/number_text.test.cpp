// SPDX-License-Identifier: MIT
#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/report/number_text.hpp>

#include <boost/multiprecision/cpp_dec_float.hpp>

#include <cmath>
#include <limits>
#include <string>

using namespace sivid::report;

TEST_CASE("number text: proven bounds go outward") {
    CHECK(outward_text({0.218203, 0.221809}) == "[0.21820, 0.22181]");
    CHECK(outward_text({-1.0, 2.0}) == "[\xE2\x88\x92"
                                       "1.00, 2.00]");
    CHECK(outward_text({2.961e-5, 2.969e-5}) ==
          "[2.96099, 2.96900] \xC3\x97 10\xE2\x81\xBB\xE2\x81\xB5");
    CHECK(outward_text({2.961e-4, 2.969e-4}, {.significant = 2, .shift = 2}) ==
          "[0.029609, 0.029691]");
    CHECK(outward_text({0, 0}) == "[0, 0]");
    CHECK(outward_text(range{}) == "empty");
    CHECK(outward_text({-INFINITY, 3}) == "[\xE2\x88\x92\xE2\x88\x9E, 3.00]");
    // A point is enclosed, not rounded.
    CHECK(outward_text({0.1, 0.1}) == "[0.1000000000000000, 0.1000000000000001]");
    CHECK(rounded_text(0.0573001, rounding::up) == "0.0574");
    CHECK(rounded_text(0.0573999, rounding::down) == "0.0573");
}

TEST_CASE("number text: an end that the proof did not move is printed as given") {
    range const prior{std::nextafter(0.25, 0), std::nextafter(0.35, 1)};
    CHECK(outward_text_within(prior, prior) == "[0.25, 0.35]");
    CHECK(outward_text_within({prior.lo, 0.3}, prior) == "[0.25, 0.3000]");
    CHECK(outward_text_within(range{}, prior) == "empty");
}

TEST_CASE("number text: given decimals come back short, exact ones exactly") {
    CHECK(given_text(0.1) == "0.1");
    CHECK(given_text(std::nextafter(0.1, 0)) == "0.1");
    CHECK(given_text(1e-9) == "1 \xC3\x97 10\xE2\x81\xBB\xE2\x81\xB9");
    CHECK(given_text(250) == "250");
    CHECK(given_text(range{0.0042, 0.0754}) == "[0.0042, 0.0754]");
    CHECK(exact_text(0.1) == "0.1");
    CHECK(exact_text(std::nextafter(0.1, 0)) == "0.09999999999999999");
    CHECK(exact_text(NAN) == "?");
}

TEST_CASE("number text: counts, durations, units") {
    CHECK(count_text(1532) == "1532");
    CHECK(count_text(184211) == "184\xE2\x80\xAF"
                                "211");
    CHECK(duration_text(0.0123) == "12.3 ms");
    CHECK(duration_text(12.34) == "12.3 s");
    CHECK(duration_text(245) == "4 min 5 s");
    CHECK(duration_text(-1) == "?");
    CHECK(unit_text("kg m^2") == "kg m\xC2\xB2");
    CHECK(unit_text("s^-1") == "s\xE2\x81\xBB\xC2\xB9");
    CHECK(unit_text("a^b") == "a^b");
    CHECK(unit_suffix("") == "");
}

TEST_CASE("a range all of whose points have a property is printed inward") {
    CHECK(inward_text({0.218203, 0.221809}) == "[0.21821, 0.22180]");
    CHECK(inward_text({2.9611e-5, 2.9689e-5}, {.significant = 1, .shift = 0}) ==
          "[2.962, 2.968] \xC3\x97 10\xE2\x81\xBB\xE2\x81\xB5");
    CHECK_FALSE(inward_text({1, 1 + 1e-15}));
    CHECK_FALSE(inward_text({1, 1}));
    CHECK_FALSE(inward_text(range{}));
    CHECK_FALSE(inward_text({0, INFINITY}));
    CHECK_FALSE(inward_text({0, 0}));
    using exact = boost::multiprecision::cpp_dec_float_100;
    support::draws d(7);
    int compared = 0;
    for (int k = 0; k < 2000; ++k) {
        double const at = d.uniform(-3, 3);
        double const width = std::pow(10, d.uniform(-15, 1));
        range const r{at, at + width};
        auto const text = inward_text(r, {.significant = 1 + static_cast<int>(d.below(4))});
        if (!text) continue;
        if (text->find("\xC3\x97") != std::string::npos) continue; // a power of ten
        auto plain = *text;
        for (auto minus = plain.find("\xE2\x88\x92"); minus != std::string::npos;
             minus = plain.find("\xE2\x88\x92")) {
            plain.replace(minus, 3, "-");
        }
        auto const comma = plain.find(',');
        exact const low(plain.substr(1, comma - 1));
        exact const high(plain.substr(comma + 2, plain.size() - comma - 3));
        CAPTURE(*text);
        CHECK(exact(r.lo) <= low);
        CHECK(low <= high);
        CHECK(high <= exact(r.hi));
        ++compared;
    }
    CHECK(compared > 1000);
}

TEST_CASE("wider is said in percent, from twice on as a factor, rounded up") {
    CHECK(wider_text(0.0119) == "1.2 % wider");
    CHECK(wider_text(-0.1) == "0 % wider");
    CHECK(wider_text(0.999) == "100 % wider");
    CHECK(wider_text(1) == "2.1 times as wide");
    CHECK(wider_text(1.33) == "2.4 times as wide");
    CHECK(wider_text(2100) == "2200 times as wide");
}
