// SPDX-License-Identifier: MIT
// What a program from headers alone has: with COMPLETE all, without it runs in lanes. It says
// which.
#ifdef COMPLETE
#include <sivid/paving/complete.hpp>
#endif
#include <sivid/paving/identify.hpp>

#include <iostream>
#include <stdexcept>
#include <string>

using namespace sivid;

namespace {

/// x' = -k x
struct decay {
    static constexpr auto name = "decay";
    static constexpr auto states = sivid::states({{"x", "1", 1}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"x", "1"}});
    static constexpr auto constants = sivid::constants({{"k", "1/s", 1_dec}});
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 1> const& k, vec<T, 0> const&) const {
        return {-k[0] * x[0]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 1> const&, vec<T, 0> const&) const {
        return x;
    }
};

int failed = 0;
void check(bool holds, char const* what) {
    if (holds) return;
    std::cout << "failed: " << what << '\n';
    ++failed;
}

} // namespace

int main() {
#ifdef COMPLETE
    bool const complete = true;
#else
    bool const complete = false;
#endif
    experiment e;
    e.name = "decay";
    e.initial = {interval(1, 1)};
    e.measurements = {{1, 0, interval(0.58, 0.63)}, {2, 0, interval(0.35, 0.39)}};
    identification_problem problem{record_model<decay>(), {{"k"}, {}}, {interval(0, 4)}, {e}};
    auto const found = identify(problem);
    check(found.verdict == verdict::consistent, "some rate explains the data");
    check(contains(found.hull[0], 0.5) && width(found.hull[0]) < 0.2, "the rate is about 0.5");
    check(!found.journal.empty() && (found.journal[0].by != "fits and contractors") == complete,
          "the journal says whether there are contractors");
    check(found.guess.has_value() == complete, "a fit was made where there are fits");
    identify_options by_first_order;
    by_first_order.test.set = carried_set::doubleton;
    bool refused = false;
    try {
        check(contains(identify(problem, by_first_order).hull[0], 0.5), "the rate is kept");
    } catch (std::invalid_argument const& why) {
        refused = std::string(why.what()).find("complete.hpp") != std::string::npos;
    }
    check(refused != complete, "sets of first order are there, or refused by name");
    problem.experiments[0].measurements[1].bound = interval(0.5, 0.52);
    check(identify(problem).verdict == verdict::inconsistent, "no rate explains other data");
    return failed;
}
