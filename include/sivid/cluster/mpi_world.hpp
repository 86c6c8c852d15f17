// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_MPI_WORLD_HPP
#define SIVID_CLUSTER_MPI_WORLD_HPP

#include <sivid/cluster/diagnose.hpp>
#include <sivid/cluster/identify.hpp>
#include <sivid/cluster/job.hpp>
#include <sivid/cluster/transport.hpp>

#include <cstddef>
#include <cstdlib>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>
#include <boost/mpi/request.hpp>
#include <boost/mpi/status.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

namespace sivid::cluster {

/// The ranks of an MPI job: rank 0 writes to all others, these to rank 0.
///   cluster::mpi_world world(argc, argv);
///   auto const found = world.identify(problem, options, {}, spent); // of rank 0 alone
/// One for a program. Only the thread that made it uses it.
class mpi_world final : public job {
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

    [[nodiscard]] std::size_t rank() const override {
        return static_cast<std::size_t>(ranks_.rank());
    }
    [[nodiscard]] std::size_t size() const override {
        return static_cast<std::size_t>(ranks_.size());
    }
    [[nodiscard]] transport& others() override { return *mail_; }
    [[noreturn]] void end_all(int code) override {
        boost::mpi::environment::abort(code);
        std::_Exit(code);
    }

    [[nodiscard]] std::optional<identification> identify(identification_problem const& problem,
                                                         identify_options const& options,
                                                         std::string const& also,
                                                         traffic& spent) override {
        if (rank() == 0) return cluster::identify(others(), problem, options, also, &spent);
        help_identify(others(), problem, options, also);
        return std::nullopt;
    }
    [[nodiscard]] std::optional<diagnosis_run> diagnose(identification_problem const& problem,
                                                        std::vector<effect> const& catalogue,
                                                        diagnosis_options const& options,
                                                        std::string const& also) override {
        if (rank() == 0) return cluster::diagnose(others(), problem, catalogue, options, also);
        help_diagnose(others(), problem, catalogue, also);
        return std::nullopt;
    }

private:
    boost::mpi::environment environment_;
    boost::mpi::communicator ranks_;
    std::unique_ptr<mail> mail_;
};

} // namespace sivid::cluster

#endif
