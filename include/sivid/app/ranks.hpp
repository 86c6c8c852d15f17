// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_RANKS_HPP
#define SIVID_APP_RANKS_HPP

#include <sivid/app/console.hpp>
#include <sivid/app/program.hpp>
#include <sivid/cluster/job.hpp>

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
    ranks(cluster::job_start start, int& argc, char**& argv) {
        if (start != nullptr) {
            job_ = start(argc, argv);
            return;
        }
        auto const* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
        if (size != nullptr && std::string{size} != "1")
            throw std::invalid_argument(
                "this program was built without MPI, and mpirun has started it " +
                std::string{size} +
                " times; install it (Debian: libboost-mpi-dev openmpi-bin libopenmpi-dev), "
                "configure and build anew, or start it without mpirun");
    }
    [[nodiscard]] std::size_t size() const { return job_ ? job_->size() : 1; }
    [[nodiscard]] std::size_t rank() const { return job_ ? job_->rank() : 0; }
    /// All of them. @given  there are several
    [[nodiscard]] cluster::job& all() const { return *job_; }
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
    std::unique_ptr<cluster::job> job_;
};

/// `guarded` for a program of several ranks: an error of one ends all. All ranks read the same
/// command and the same data, so most errors are everybody's; rank 0 tells them.
template <class Program>
int guarded_on_ranks(std::string const& name, cluster::job_start start, int& argc, char**& argv,
                     outputs const& to, Program const& program) {
    std::optional<ranks> here;
    int code = guarded(name, to, [&] {
        here.emplace(start, argc, argv);
        return 0;
    });
    if (!here) return code;
    std::ostringstream unheard, kept;
    code =
        guarded(name, here->helps() ? outputs{unheard, kept} : to, [&] { return program(*here); });
    bool const failed = code == bad_input || code == internal_error;
    if (failed && here->several()) {
        if (here->helps()) { // unless rank 0 has ended the job by then, it is this one's alone
            std::this_thread::sleep_for(std::chrono::seconds(2));
            // At once, lest what others write come in between.
            auto const words = "rank " + std::to_string(here->rank()) + ": " + kept.str();
            to.notices << words << std::flush;
        }
        to.results << std::flush;
        here->all().end_all(code);
    }
    if (code != done && here->several() && !here->helps()) {
        // mpirun takes such a code for a failure, and waits for those who have not left by then.
        here.reset();
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    return code;
}

} // namespace sivid::app

#endif
