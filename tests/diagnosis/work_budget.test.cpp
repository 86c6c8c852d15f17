// SPDX-License-Identifier: MIT
// A diagnosis that its budget cuts short says the same with any number of threads and under load.
#include <sivid/diagnosis/diagnose.hpp>

#include "support/catch.hpp"
#include "support/oscillator_in_units.hpp"
#include "support/threads.hpp"

#include <chrono>
#include <cstddef>
#include <string>
#include <thread>

using namespace sivid;
using namespace support::in_units;

namespace {

diagnosis diagnosed(executor const& workers, bool slowly) {
    missing truth;
    truth.friction = 0.35;
    diagnosis_options options;
    options.seconds = 1;
    // Within another limit, so that the time of a loaded machine has no say.
    options.test.keep_going = work_limit(1e6);
    options.test.workers = workers;
    if (slowly) {
        options.progress = [](std::string const&) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            return true;
        };
    }
    return diagnose(problem_in({}, truth, {4, 40}), catalogue_in({}), options).result;
}

} // namespace

TEST_CASE("what a budget of work leaves of a diagnosis hangs on no thread and no load") {
    auto const once = diagnosed({}, false);
    for (auto const& other : {diagnosed(support::threads(2), false), diagnosed({}, true)}) {
        CHECK_FALSE(other.by_clock);
        CHECK(other.gap == once.gap);
        CHECK(other.answer == once.answer);
        CHECK(other.effects == once.effects);
        CHECK(other.interrupted == once.interrupted);
        CHECK(other.tried.complete() == once.tried.complete());
        CHECK(other.inflation.lower() == once.inflation.lower());
        CHECK(other.inflation.upper() == once.inflation.upper());
        REQUIRE(other.causes.size() == once.causes.size());
        for (std::size_t k = 0; k < once.causes.size(); ++k) {
            CHECK(other.causes[k].effects == once.causes[k].effects);
            CHECK(other.causes[k].verdict == once.causes[k].verdict);
            CHECK(other.causes[k].inflation.lower() == once.causes[k].inflation.lower());
            CHECK(other.causes[k].inflation.upper() == once.causes[k].inflation.upper());
        }
        REQUIRE(other.constants.size() == once.constants.size());
        for (std::size_t k = 0; k < once.constants.size(); ++k)
            CHECK(other.constants[k].value == once.constants[k].value);
    }
}
