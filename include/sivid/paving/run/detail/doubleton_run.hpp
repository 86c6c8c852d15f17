// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_DOUBLETON_RUN_HPP
#define SIVID_PAVING_RUN_DETAIL_DOUBLETON_RUN_HPP

#include <sivid/enclosure/observation.hpp>
#include <sivid/enclosure/trajectory.hpp>
#include <sivid/paving/response/detail/affine_output.hpp>
#include <sivid/paving/run/detail/experiment_run_class.hpp>
#include <sivid/paving/run_options.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// One family of trajectories, carried as a set of first order.
class doubleton_family {
public:
    doubleton_family(flow const& f, enclosure_options const& options)
        : run_(f, options), look_(f) {}

    void begin(double time, box const& initial, box const& parameters) {
        unknowns_.emplace(initial, parameters);
        table_ = linear_table(unknowns_->variables);
        run_.begin(time, initial, parameters);
        look_.set_ensemble(run_.ensemble());
    }
    [[nodiscard]] normalised_unknowns const& unknowns() const { return *unknowns_; }
    [[nodiscard]] std::shared_ptr<monomial_table const> const& table() const { return table_; }
    /// @returns whether the time was reached
    [[nodiscard]] bool advance(double time) {
        while (run_.time() < time && run_.step(time)) {
        }
        return !(run_.time() < time);
    }
    /// All channels at the present time.
    [[nodiscard]] auto outputs() { return look_(run_.set()); }
    [[nodiscard]] output_polynomial polynomial_of(observation<interval> const& seen) const {
        return affine_output(seen, *unknowns_, run_.ensemble().deviation);
    }

private:
    trajectory<interval> run_;
    observer<interval> look_;
    std::optional<normalised_unknowns> unknowns_;
    std::shared_ptr<monomial_table const> table_;
};

/// Sets of first order over a record, one box at a time.
class doubleton_run final : public experiment_run {
public:
    doubleton_run(flow const& f, experiment const& e, record const& samples,
                  run_options const& options)
        : experiment_(&e), samples_(&samples), hopeless_(options.hopeless), carried_(f, options) {}

    using experiment_run::operator();

    std::vector<std::shared_ptr<response const>>
    operator()(box const& initial, std::vector<box> const& parameters) override {
        std::vector<std::shared_ptr<response const>> answers;
        for (auto const& p : parameters) answers.push_back(run_one(initial, p));
        return answers;
    }

private:
    std::shared_ptr<response const> run_one(box const& initial, box const& parameters) {
        auto answer = start_response(*experiment_, *samples_, initial, parameters);
        carried_.begin(experiment_->begin, initial, parameters);
        answer->table = carried_.table();
        response_builder collected(answer->table->size());
        auto const keep = [&](observation<interval> const& seen, interval const& bound) {
            auto const y = carried_.polynomial_of(seen);
            collected.add([&](std::size_t m) { return y.coefficients[m]; }, y.radius, bound);
            bool const fails =
                seen.defined && interval_traits<interval>::disjoint(seen.value, bound);
            return kept_output{fails, is_hopeless(y.radius, y.spread(), bound, hopeless_)};
        };
        measurement_walk walk(*samples_, answer->allowed);
        while (!walk.done() && carried_.advance(walk.time())) {
            auto const seen = carried_.outputs();
            walk.take([&](std::size_t channel, interval const& bound) {
                return keep(seen[channel], bound);
            });
        }
        std::move(collected).finish(*answer);
        return answer;
    }

    experiment const* experiment_;
    record const* samples_;
    double hopeless_;
    doubleton_family carried_;
};

} // namespace paving_detail

} // namespace sivid

#endif
