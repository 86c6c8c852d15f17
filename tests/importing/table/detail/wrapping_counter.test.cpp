// SPDX-License-Identifier: MIT
#include <sivid/importing/table/detail/turns.hpp>

#include "io/import_support.hpp"

#include <cstdint>
#include <random>

using namespace sivid;
using io_support::dec;

TEST_CASE("counts are followed beyond the ends of their range") {
    for (unsigned const bits : {8u, 16u, 32u, 48u}) {
        auto const range = std::int64_t{1} << bits;
        std::mt19937_64 random{bits};
        wrapping_counter counter{bits};
        std::int64_t truth = range - 5;
        bool ok = counter(truth).count == truth;
        for (int i = 0; i < 5000; ++i) {
            auto const most = range / 2 - 1;
            truth +=
                static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * most + 1)) -
                most;
            auto raw = ((truth % range) + range) % range;
            auto const s = counter(raw);
            ok = ok && s.possible && s.count == truth;
        }
        CAPTURE(bits);
        CHECK(ok);
    }
}

TEST_CASE("signed counters, doubt and what cannot be decided") {
    wrapping_counter counter{16};
    CHECK(counter(-32768).count == -32768);
    CHECK(counter(32767).count == -32769);
    auto const s = counter(20000);
    CHECK(s.count == -32769 - 12767);
    CHECK_FALSE(s.wrapped);
    CHECK_FALSE(s.doubtful);
    auto const far = counter(0);
    CHECK(far.doubtful);
    CHECK(far.possible);
    CHECK_FALSE(counter(32768).possible); // exactly half the range
    CHECK_FALSE(counter(65536).possible);
    CHECK_FALSE(counter(-32769).possible);
    CHECK(counter(1).count == far.count + 1); // what was impossible changed nothing
    CHECK(counter(65535).wrapped);
}

TEST_CASE("whole numbers are recognised") {
    CHECK(whole_number(dec("12")) == 12);
    CHECK(whole_number(dec("-12.000")) == -12);
    CHECK(whole_number(dec("1.2e1")) == 12);
    CHECK(whole_number(dec("0")) == 0);
    CHECK_FALSE(whole_number(dec("0.5")));
    CHECK_FALSE(whole_number(dec("1e300")));
    CHECK_FALSE(whole_number(dec("12345678901234567")));
}

TEST_CASE("time stamps go on, through the end of the counter too") {
    time_stamps const t{16, dec("0.05"), dec("1e-3")};
    CHECK(t.wraps());
    CHECK(t.possible(dec("65535")));
    CHECK_FALSE(t.possible(dec("65536")));
    CHECK_FALSE(t.possible(dec("-1")));
    CHECK_FALSE(t.possible(dec("3.5")));
    CHECK(t.goes_on(dec("10"), dec("60")));
    CHECK_FALSE(t.goes_on(dec("10"), dec("61")));
    CHECK_FALSE(t.goes_on(dec("10"), dec("10")));
    CHECK(t.goes_on(dec("65530"), dec("4")));
    CHECK_FALSE(t.goes_on(dec("10"), dec("9")));
    CHECK(*t.forward(dec("10"), dec("9")) == dec("65535"));
    time_stamps const seconds{std::nullopt, dec("0.5"), dec("1")};
    CHECK_FALSE(seconds.wraps());
    CHECK(seconds.possible(dec("-3.5")));
    CHECK(seconds.goes_on(dec("1"), dec("1.5")));
    CHECK_FALSE(seconds.forward(dec("1.5"), dec("1")));
}
