// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_DOUBLETON_RUN_HPP
#define SIVID_PAVING_RUN_DETAIL_DOUBLETON_RUN_HPP

#include <sivid/enclosure/observation.hpp>
#include <sivid/enclosure/trajectory.hpp>
#include <sivid/paving/response/detail/affine_output.hpp>
#include <sivid/paving/run/detail/experiment_run_class.hpp>
#include <sivid/paving/run/detail/measurement_walk.hpp>
#include <sivid/paving/run_options.hpp>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Sets of first order, one box at a time.
class doubleton_run final : public experiment_run {
public:
    doubleton_run(flow const& f, experiment const& e, record const& samples,
                  run_options const& options)
        : experiment_(&e),
          samples_(&samples),
          options_(options),
          run_(f, options.enclosure),
          look_(f) {}

    using experiment_run::operator();

    std::vector<std::shared_ptr<response const>>
    operator()(box const& initial, std::vector<box> const& parameters) override {
        std::vector<std::shared_ptr<response const>> answers;
        for (auto const& p : parameters) answers.push_back(run_one(initial, p));
        return answers;
    }

private:
    std::shared_ptr<response const> run_one(box const& initial, box const& parameters) {
        using traits = interval_traits<interval>;
        auto answer = start_response(*experiment_, *samples_, initial, parameters);
        auto const& u = answer->unknowns;
        run_.begin(experiment_->begin, initial, parameters);
        look_.set_ensemble(run_.ensemble());
        answer->table = linear_table(u.variables);
        response_builder collected(answer->table->size());
        auto const& deviation = run_.ensemble().deviation;
        auto const keep = [&](observation<interval> const& seen, interval const& bound) {
            auto const y = affine_output(seen, u, deviation);
            collected.add([&](std::size_t m) { return y.coefficients[m]; }, y.radius, bound);
            bool const fails = seen.defined && traits::disjoint(seen.value, bound);
            return kept_output{
                fails, !(2 * y.radius <= options_.hopeless * (2 * y.spread() + width(bound)))};
        };
        measurement_walk walk(*samples_, answer->allowed);
        while (!walk.done()) {
            bool reached = true;
            while (reached && run_.time() < walk.time()) reached = run_.step(walk.time());
            if (!reached) break;
            auto const seen = look_(run_.set());
            walk.take([&](std::size_t channel, interval const& bound) {
                return keep(seen[channel], bound);
            });
        }
        std::move(collected).finish(*answer);
        return answer;
    }

    experiment const* experiment_;
    record const* samples_;
    run_options options_;
    trajectory<interval> run_;
    observer<interval> look_;
};

} // namespace paving_detail

} // namespace sivid

#endif
