// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_RANKS_HPP
#define SIVID_APP_RANKS_HPP

#include <sivid/app/console.hpp>
#include <sivid/app/program.hpp>

#ifdef SIVID_HAS_MPI
#include <sivid/cluster/mpi_world.hpp>
#endif

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>

namespace sivid::app {

/// One rank unless mpirun has started more.
class ranks {
public:
    ranks() = default; ///< one, whoever has started it

    /// @throws std::invalid_argument  for a program without MPI that is started as one of several
    ranks(int& argc, char**& argv) {
#ifdef SIVID_HAS_MPI
        if (cluster::mpi_world::started()) {
            world_ = std::make_unique<cluster::mpi_world>(argc, argv);
        }
#else
        static_cast<void>(argc);
        static_cast<void>(argv);
        auto const* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
        if (size != nullptr && std::string{size} != "1")
            throw std::invalid_argument(
                "this program was built without MPI, and mpirun has started it " +
                std::string{size} +
                " times; install it (Debian: libboost-mpi-dev openmpi-bin libopenmpi-dev), "
                "configure and build anew, or start it without mpirun");
#endif
    }
#ifdef SIVID_HAS_MPI
    [[nodiscard]] std::size_t size() const { return world_ ? world_->size() : 1; }
    [[nodiscard]] std::size_t rank() const { return world_ ? world_->rank() : 0; }
    /// Of the others, or for them rank 0. @given  there are several
    [[nodiscard]] cluster::transport& others() const { return world_->others(); }
    [[noreturn]] static void end_all(int code) { cluster::mpi_world::end_all(code); }
#else
    [[nodiscard]] static std::size_t size() { return 1; }
    [[nodiscard]] static std::size_t rank() { return 0; }
    static void end_all(int /*code*/) {} // there are no others
#endif
    [[nodiscard]] bool several() const { return size() > 1; }
    /// Whether this one helps rank 0.
    [[nodiscard]] bool helps() const { return rank() > 0; }

    /// From now on a signal that asks the job to end asks for the result so far: Ctrl-C, which
    /// mpirun turns into SIGTERM, and SIGUSR1, which batch systems can send before time is up.
    /// Helpers go on until rank 0 lets them go.
    void watch_interrupts() const {
        app::watch_interrupts();
        if (!several()) return;
        for (int const signal : {SIGINT, SIGTERM, SIGUSR1})
            std::signal(signal, helps() ? SIG_IGN : detail::sivid_app_interrupt_of_job);
    }

private:
#ifdef SIVID_HAS_MPI
    std::unique_ptr<cluster::mpi_world> world_;
#endif
};

/// `guarded` for a program of several ranks: an error of one ends all. All ranks read the same
/// command and the same data, so most errors are everybody's; rank 0 tells them.
template <class Program>
int guarded_on_ranks(std::string const& name, int& argc, char**& argv, outputs const& to,
                     Program const& program) {
    std::optional<ranks> all;
    int code = guarded(name, to, [&] {
        all.emplace(argc, argv);
        return 0;
    });
    if (!all) return code;
    std::ostringstream unheard, kept;
    code = guarded(name, all->helps() ? outputs{unheard, kept} : to, [&] { return program(*all); });
    bool const failed = code == bad_input || code == internal_error;
    if (failed && all->several()) {
        if (all->helps()) { // unless rank 0 has ended the job by then, it is this one's alone
            std::this_thread::sleep_for(std::chrono::seconds(2));
            // At once, lest what others write come in between.
            auto const words = "rank " + std::to_string(all->rank()) + ": " + kept.str();
            to.notices << words << std::flush;
        }
        to.results << std::flush;
        ranks::end_all(code);
    }
    if (code != done && all->several() && !all->helps()) {
        // mpirun takes such a code for a failure, and waits for those who have not left by then.
        all.reset();
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    return code;
}

} // namespace sivid::app

#endif
