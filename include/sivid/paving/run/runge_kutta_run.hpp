// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_RUNGE_KUTTA_RUN_HPP
#define SIVID_PAVING_RUN_RUNGE_KUTTA_RUN_HPP

/// @file
/// Identification by Taylor-model sets whose centre follows a Runge-Kutta method. Expensive to
/// compile, and nowhere narrower than the Taylor series (docs/runge_kutta.md): not part of
/// sivid::compiled, no other header includes it.

#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/enclosure/taylor/parametric_runge_kutta.hpp>
#include <sivid/paving/run/experiment_run.hpp>
// What builds on it.
#include <sivid/paving/run/detail/taylor_run.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace sivid {

namespace paving_detail {

/// `parametric_runge_kutta` as `taylor_run` drives it: a flow of one lane.
class runge_kutta_lane {
public:
    using polynomial = taylor_model<double>;
    using shape_type = polynomial::shape_type;

    runge_kutta_lane(flow const& f, enclosure_options const& options, std::size_t unknowns,
                     std::size_t degree)
        : flow_(&f),
          run_(f, options, unknowns, degree),
          shape_(&shape_type::of(unknowns, degree)),
          observe_(f.observe(), 0, *shape_) {}

    void begin(std::size_t, double time, box const& initial, box const& parameters) {
        run_.begin(time, initial, parameters);
        std::vector<polynomial> p;
        for (auto const& s : run_.unknowns().parameters) {
            enclosure_detail::put(s, 0, p.emplace_back(*shape_));
        }
        observe_.set_parameters(p);
        running_ = true;
    }
    [[nodiscard]] shape_type const& shape() const { return *shape_; }
    void end(std::size_t) { running_ = false; }
    [[nodiscard]] bool advance(double limit) {
        return running_ && run_.time() < limit && run_.step(limit);
    }
    [[nodiscard]] double time(std::size_t) const { return run_.time(); }
    [[nodiscard]] std::optional<enclosure_failure> const& failure(std::size_t) const {
        return run_.failure();
    }
    [[nodiscard]] std::vector<polynomial> outputs() {
        auto const& set = run_.set();
        std::vector<polynomial> x;
        for (std::size_t i = 0; i < set.centre.size(); ++i) {
            x.push_back(widened(set.centre[i], set.reach[i]));
        }
        auto const t = polynomial::constant(set.time);
        auto const inputs = widened(input_pieces<polynomial>(*flow_, set.time, t), *flow_,
                                    input_errors(*flow_, set.time, set.time));
        observe_.evaluate(t, x, inputs);
        std::vector<polynomial> result;
        for (std::size_t y = 0; y < flow_->channels(); ++y) {
            result.push_back(observe_.output(y, 0));
            if (observe_.undefined()) result.back().r() = detail::infinity;
        }
        return result;
    }

private:
    flow const* flow_;
    parametric_runge_kutta<polynomial> run_;
    shape_type const* shape_;
    series<polynomial> observe_;
    bool running_ = false;
};

} // namespace paving_detail

/// A `run_maker`: `options.test.make = runge_kutta_run` with a `method` in the enclosure's
/// options. Of the degree that `suggested_degree` says.
/// Smooth models only: kinks are not crossed, the outputs end there.
/// @throws std::invalid_argument  without a method
[[nodiscard]] inline std::unique_ptr<experiment_run>
runge_kutta_run(flow const& f, experiment const& e, record const& samples, box const& initial,
                box const& prior, run_options const& options) {
    using namespace paving_detail;
    auto const unknowns = unknown_count(initial, prior);
    return std::make_unique<taylor_run<double, runge_kutta_lane>>(f, e, samples, options, unknowns,
                                                                  suggested_degree(unknowns));
}

} // namespace sivid

#endif
