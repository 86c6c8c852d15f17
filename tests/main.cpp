// SPDX-License-Identifier: MIT
// The main function of every test program, compiled once; Catch2 2.13 and 3. A filter that matches
// no test case is a failure: version 2 would end with 0, and a test whose name was taken apart on
// its way would pass without having run.
#if __has_include(<catch2/catch_session.hpp>)
#include <catch2/catch_session.hpp>
#include <catch2/reporters/catch_reporter_event_listener.hpp>
#include <catch2/reporters/catch_reporter_registrars.hpp>
using listener_base = Catch::EventListenerBase;
using spec_text = Catch::StringRef;
#else
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
using listener_base = Catch::TestEventListenerBase;
using spec_text = std::string const&;
#endif

#include <iostream>

namespace {

struct {
    std::size_t groups = 0, cases = 0, unmatched = 0;
} seen;

/// Counts what ran, and the parts of the filter that match nothing.
class counter : public listener_base {
public:
    using listener_base::listener_base;
    void testRunStarting(Catch::TestRunInfo const& info) override {
        listener_base::testRunStarting(info);
        ++seen.groups;
    }
    void testCaseStarting(Catch::TestCaseInfo const& info) override {
        listener_base::testCaseStarting(info);
        ++seen.cases;
    }
    void noMatchingTestCases(spec_text spec) override {
        listener_base::noMatchingTestCases(spec);
        ++seen.unmatched;
    }
};
CATCH_REGISTER_LISTENER(counter)

} // namespace

int main(int argc, char* argv[]) {
    int const result = Catch::Session().run(argc, argv);
    if (seen.groups == 0)
        return result; // a list or a help text was asked for, or an option was wrong
    if (result == 0 && (seen.cases == 0 || seen.unmatched > 0)) {
        std::cerr << "error: the filter matches no test case\n";
        return 4;
    }
    return result;
}
