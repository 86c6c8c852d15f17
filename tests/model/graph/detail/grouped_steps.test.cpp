// SPDX-License-Identifier: MIT
#include <sivid/model/graph/detail/grouped_steps.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

using namespace sivid;

TEST_CASE("steps in groups do what they do one after the other") {
    support::draws d(6127);
    operation const kinds[] = {operation::neg,  operation::add, operation::sub, operation::mul,
                               operation::div,  operation::sqr, operation::sin, operation::abs,
                               operation::pown, operation::max, operation::tanh};
    for (int round = 0; round < 50; ++round) {
        std::size_t const arguments = 4;
        auto const count = d.below(61);
        std::vector<program::step> steps;
        for (std::size_t k = 0; k < count; ++k) {
            auto const any = [&] { return static_cast<program::slot>(d.below(arguments + k)); };
            auto const op = kinds[d.below(std::size(kinds))];
            steps.push_back({op, static_cast<std::int32_t>(d.below(9)) - 3,
                             static_cast<program::slot>(arguments + k), any(), any()});
        }
        std::vector<double> memory(arguments + count, 0.0);
        for (std::size_t k = 0; k < arguments; ++k) memory[k] = d.uniform(-2, 2);
        auto one_by_one = memory;
        for (auto const& s : steps) {
            bool undefined = false;
            one_by_one[s.target] = apply<approximate_arithmetic>(
                s.op, one_by_one[s.a], one_by_one[s.b], s.index, undefined);
        }
        grouped_steps const grouped(steps, memory.size());
        grouped.run(memory);
        for (std::size_t k = 0; k < memory.size(); ++k) {
            CAPTURE(round, k);
            bool const same = memory[k] == one_by_one[k];
            bool const neither = memory[k] != memory[k] && one_by_one[k] != one_by_one[k];
            CHECK((same || neither));
        }
    }
}
