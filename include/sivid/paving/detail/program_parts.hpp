// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DETAIL_PROGRAM_PARTS_HPP
#define SIVID_PAVING_DETAIL_PROGRAM_PARTS_HPP

#include <sivid/compiled.hpp>
#include <sivid/measurement/record.hpp>

#include <cstddef>
#include <memory>

namespace sivid {

class experiment_run;
class feasibility_test;
class flow;
class work_limit;
enum class search_kind;
struct experiment;
struct identification;
struct identification_problem;
struct run_options;
struct strategy;

namespace paving_detail {

/// What a search of parameters can do without, and what takes most of the time that it takes to
/// compile. A program from headers alone has it by name (`complete.hpp`).
struct program_parts {
    strategy (*usual_strategy)(search_kind) = nullptr;
    void (*find_witness)(feasibility_test&, identification_problem const&, work_limit const&,
                         identification&) = nullptr;
    std::unique_ptr<experiment_run> (*run_single)(flow const&, experiment const&, record const&,
                                                  run_options const&, std::size_t unknowns,
                                                  std::size_t degree) = nullptr;
    std::unique_ptr<experiment_run> (*run_first_order)(flow const&, experiment const&,
                                                       record const&, run_options const&) = nullptr;
};

#ifdef SIVID_COMPILED
[[nodiscard]] SIVID_DECL program_parts const& parts_of_program();
#else
inline program_parts known_parts{};
[[nodiscard]] inline program_parts const& parts_of_program() { return known_parts; }
#endif

} // namespace paving_detail

} // namespace sivid

#endif
