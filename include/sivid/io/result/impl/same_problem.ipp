// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_IMPL_SAME_PROBLEM_IPP
#define SIVID_IO_RESULT_IMPL_SAME_PROBLEM_IPP

#include <sivid/io/result/same_problem.hpp>

#include <sivid/compiled.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>

#include <cstddef>
#include <filesystem>
#include <string>

namespace sivid {

SIVID_DECL void require_same_problem(identification_problem const& problem,
                                     stored_identification const& stored,
                                     std::filesystem::path const& file) {
    auto const fail = [&](std::string const& what) {
        throw input_error{{.file = file.string()}, what, "give the data set of this result"};
    };
    auto const& names = problem.choice.unknown;
    if (stored.parameters.size() != names.size()) fail("other parameters than the data set's");
    for (std::size_t j = 0; j < names.size(); ++j) {
        if (stored.parameters[j].name != names[j]) fail("other parameters than the data set's");
    }
    for (auto const& e : problem.experiments) {
        if (stored.budget.count(e.name) == 0) {
            fail(text_of("no outlier budget for the scenario ", in_quotes(e.name)));
        }
    }
    if (stored.budget.size() != problem.experiments.size()) fail("other scenarios");
}

} // namespace sivid

#endif
