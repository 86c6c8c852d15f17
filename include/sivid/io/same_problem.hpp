// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_SAME_PROBLEM_HPP
#define SIVID_IO_SAME_PROBLEM_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/detail/stored_identification.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/model/problem.hpp>

#include <filesystem>

namespace sivid {

/// Whether a result speaks of this problem: its parameters, its scenarios.
/// @throws input_error when it speaks of another
SIVID_ENTRY void require_same_problem(identification_problem const& problem,
                                      stored_identification const& stored,
                                      std::filesystem::path const& file);

} // namespace sivid

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_REQUIRE_SAME_PROBLEM)
#include <sivid/io/detail/same_problem_test.hpp>
#endif

#endif
