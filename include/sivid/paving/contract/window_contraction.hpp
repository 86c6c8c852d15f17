// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_CONTRACT_WINDOW_CONTRACTION_HPP
#define SIVID_PAVING_CONTRACT_WINDOW_CONTRACTION_HPP

#include <sivid/compiled.hpp>
#include <sivid/executor.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace sivid {

/// What is known beside windows over a prior.
struct known_motions {
    box rest; ///< of the prior, contains every feasible parameter
    /// Encloses the states of experiment number e at a time, along motions that explain it.
    std::function<box(std::size_t e, double time)> states;
};

/// How a prior is contracted by windows of the records.
struct window_options {
    run_options run;
    double seconds = std::numeric_limits<double>::infinity();
    std::function<bool()> keep_going = nullptr; ///< asked now and then by any thread; may be empty
    executor workers{};                         ///< runs windows and programs at once
    double longest = std::numeric_limits<double>::infinity(); ///< no window is longer [time]
    double first = std::numeric_limits<double>::infinity();   ///< length that is tried first [time]
    /// In one program: they are run side by side, and a program's cost grows with their cube.
    std::size_t windows = 8;
    /// Windows of a record that follow each other; 1: one from its begin, which grows.
    std::size_t chained = 24;
    std::size_t degree = 3; ///< of Taylor models, at most
    /// Asked as the prior shrinks. Windows then begin all along a record at once, in these states,
    /// instead of one after the other; may be empty.
    std::function<known_motions(box const&)> equations = nullptr;
    /// Products of two unknowns that move no measurement by more than this share of its bound are
    /// errors, no unknowns.
    double share = 0.02;
    /// Ends when in so many rounds no window could grow and the sides shrank, on the average, by
    /// less.
    double gain = 0.02;
    std::size_t patience = 3;    ///< rounds
    bool keep_responses = false; ///< of the windows of the last program
};

/// What windows leave of the prior.
struct window_contraction {
    box rest;                ///< contains every feasible parameter; empty: proved, there is none
    std::vector<box> starts; ///< of each experiment, contain every start that explains it
    std::size_t rounds = 0;  ///< of programs over several windows
    std::size_t windows = 0; ///< that were carried, all together
    double longest = 0;      ///< of them [time]
    double seconds = 0;
    response_list responses{}; ///< where they are kept
    std::vector<box> from{};   ///< the states in which their windows begin

    [[nodiscard]] bool empty() const { return is_empty(rest); }
};

/// Contracts a prior over which no trajectory can be carried along the whole record.
///   A record becomes windows as long as the prior carries: the first begins where the experiment
///   does, each further one at the end of that before, in the box of states that its own
///   measurements leave there. Linear programs over many windows together, in which products of
///   unknowns are unknowns (`lifted_program`), contract the parameters; programs of one window
///   contract its start. The windows grow as the box shrinks.
/// @guarantee  no feasible parameter is removed, nor a start from which one explains its
/// experiment.
///   Experiments with outliers, models with delays and with states of effects take no part, and
///   nothing is done where `run` asks for other enclosures than Taylor models by Taylor series.
/// @cost  runs over windows, eight side by side, by Taylor models of degree 3, and a linear program
///   for each side
[[nodiscard]] SIVID_DECL window_contraction
contract_by_windows(identification_problem const& problem, window_options const& options = {});

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/paving/contract/impl/window_contraction.ipp>
#endif

#endif
