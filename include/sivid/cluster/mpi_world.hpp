// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_MPI_WORLD_HPP
#define SIVID_CLUSTER_MPI_WORLD_HPP

#include <sivid/cluster/transport.hpp>

#include <cstddef>
#include <cstdlib>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>
#include <boost/mpi/request.hpp>
#include <boost/mpi/status.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

namespace sivid::cluster {

/// The ranks of an MPI job: rank 0 writes to all others, these to rank 0.
///   cluster::mpi_world world(argc, argv);
///   if (world.rank() == 0) found = cluster::identify(world.others(), problem, options);
///   else cluster::help_identify(world.others(), problem, options);
/// One for a program. Only the thread that made it uses it.
class mpi_world {
    class mail final : public transport {
    public:
        explicit mail(boost::mpi::communicator const& ranks) : ranks_(ranks) {}
        ~mail() override {
            for (auto& s : sent_) s.wait();
        }
        [[nodiscard]] std::size_t others() const override {
            return ranks_.rank() == 0 ? static_cast<std::size_t>(ranks_.size()) - 1 : 1;
        }
        void send(std::size_t to, message says) override {
            while (!sent_.empty() && sent_.front().test()) sent_.pop_front();
            sent_.push_back(ranks_.isend(rank_of(to), tag, says));
        }
        [[nodiscard]] std::optional<letter> receive() override {
            auto const arrived = ranks_.iprobe(boost::mpi::any_source, tag);
            if (!arrived) return std::nullopt;
            auto const rank = arrived->source();
            letter got{ranks_.rank() == 0 ? static_cast<std::size_t>(rank) - 1 : 0, {}};
            ranks_.recv(rank, tag, got.says);
            return got;
        }
        [[nodiscard]] std::string name_of(std::size_t other) const override {
            return std::string{"rank "} + std::to_string(rank_of(other));
        }

    private:
        static constexpr int tag = 1;
        [[nodiscard]] int rank_of(std::size_t other) const {
            return ranks_.rank() == 0 ? static_cast<int>(other) + 1 : 0;
        }

        boost::mpi::communicator ranks_;
        std::deque<boost::mpi::request> sent_; ///< each holds what it sends
    };

public:
    /// @throws boost::mpi::exception  when MPI cannot be had
    mpi_world(int& argc, char**& argv)
        : environment_(argc, argv, boost::mpi::threading::funneled, false),
          mail_(std::make_unique<mail>(ranks_)) {}

    /// Whether mpirun, or srun with its support of MPI, has started this process: then there may be
    /// others. A program that was started alone has no need of MPI.
    [[nodiscard]] static bool started() {
        for (auto const* const name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_SIZE"}) {
            if (std::getenv(name) != nullptr) return true;
        }
        return false;
    }

    [[nodiscard]] std::size_t rank() const { return static_cast<std::size_t>(ranks_.rank()); }
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(ranks_.size()); }
    /// For rank 0 all others, for these rank 0.
    [[nodiscard]] transport& others() { return *mail_; }
    /// Ends all ranks.
    [[noreturn]] static void end_all(int code) {
        boost::mpi::environment::abort(code);
        std::_Exit(code);
    }

private:
    boost::mpi::environment environment_;
    boost::mpi::communicator ranks_;
    std::unique_ptr<mail> mail_;
};

} // namespace sivid::cluster

#endif
