// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_APP_HPP
#define SIVID_APP_APP_HPP

#include <sivid/app/console.hpp>
#include <sivid/app/outputs.hpp>
#include <sivid/app/robot.hpp>
#include <sivid/cluster/job.hpp>
#include <sivid/compiled.hpp>
#if defined(SIVID_HAS_MPI) && !defined(SIVID_LIBRARY) // libsivid has no MPI
#define SIVID_APP_BY_MPI
#include <sivid/cluster/mpi_job.hpp>
#endif

#include <string>
#include <vector>

namespace sivid::app {

/// How the processes of a program find each other: by MPI where it is linked to.
#ifdef SIVID_APP_BY_MPI
constexpr cluster::job_start job_of_program = cluster::mpi_job;
#else
constexpr cluster::job_start job_of_program = nullptr;
#endif

/// The whole program of a robot, `main` but for its name: `PROGRAM COMMAND ...`, with the commands
/// import, simulate, generate, identify, online, confidence, check, certificate, diagnose, predict,
/// verify, control, design, rank, disturbance, report, export, describe and fleet (`commands.hpp`),
/// and the robot's own. `PROGRAM COMMAND --help` lists options and an example.
///   The first Ctrl-C ends the work, and what is proved by then is written; a second one ends the
/// program. Files are written whole or not at all.
/// @param to  where it prints: the standard streams, in a program of its own
/// @param start  finds the others that mpirun has started with it
/// @returns  the exit code (`exit_code` in `program.hpp`); it does not throw
[[nodiscard]] SIVID_DECL int run(robot const& r, int argc, char** argv, outputs const& to,
                                 cluster::job_start start = job_of_program);

/// What a command within another program leaves beside its files.
struct command_answer {
    int code = 0;               ///< as the program's exit code
    std::string words, notices; ///< what the program prints as its result, and to the other output
};

/// The same command within another program, an interpreter for instance, which has a terminal and
/// ways to be interrupted of its own. One command runs at a time; a second one waits for
/// it.
/// @param words  of the command line, without the program's name
/// @throws  what the program has one message for (`failure_of` in `program.hpp`), words that there
///          are not as bad_request
[[nodiscard]] SIVID_DECL command_answer run_within(host const& h, robot const& r,
                                                   std::vector<std::string> const& words);

} // namespace sivid::app

#ifndef SIVID_COMPILED
#include <sivid/app/impl/app.ipp>
#include <sivid/app/impl/check.ipp>
#include <sivid/app/impl/decide.ipp>
#include <sivid/app/impl/design.ipp>
#include <sivid/app/impl/diagnose.ipp>
#include <sivid/app/impl/export.ipp>
#include <sivid/app/impl/fleet.ipp>
#include <sivid/app/impl/identify.ipp>
#include <sivid/app/impl/rank.ipp>
#include <sivid/app/impl/report.ipp>
#include <sivid/app/impl/simulate.ipp>
#endif

#endif
