// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_SAME_PROBLEM_HPP
#define SIVID_IO_RESULT_SAME_PROBLEM_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>

#include <filesystem>

namespace sivid {

/// Whether a result speaks of this problem: its parameters, its scenarios.
/// @throws input_error when it speaks of another
SIVID_DECL void require_same_problem(identification_problem const& problem,
                                     stored_identification const& stored,
                                     std::filesystem::path const& file);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/io/result/impl/same_problem.ipp>
#endif

#endif
