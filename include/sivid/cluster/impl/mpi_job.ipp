// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_IMPL_MPI_JOB_IPP
#define SIVID_CLUSTER_IMPL_MPI_JOB_IPP

#include <sivid/cluster/mpi_job.hpp>

#include <sivid/cluster/diagnose.hpp>
#include <sivid/cluster/identify.hpp>
#include <sivid/cluster/job.hpp>
#include <sivid/cluster/mpi_world.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sivid::cluster {

namespace detail {

class job_of_mpi final : public job {
public:
    job_of_mpi(int& argc, char**& argv) : world_(argc, argv) {}

    [[nodiscard]] std::size_t rank() const override { return world_.rank(); }
    [[nodiscard]] std::size_t size() const override { return world_.size(); }
    [[nodiscard]] transport& others() override { return world_.others(); }
    [[noreturn]] void end_all(int code) override { mpi_world::end_all(code); }

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
    mpi_world world_;
};

} // namespace detail

SIVID_DECL std::unique_ptr<job> mpi_job(int& argc, char**& argv) {
    if (!mpi_world::started()) return nullptr;
    return std::make_unique<detail::job_of_mpi>(argc, argv);
}

} // namespace sivid::cluster

#endif
