// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUNGE_KUTTA_RUN_HPP
#define SIVID_PAVING_RUNGE_KUTTA_RUN_HPP

/// @file
/// Identification by Taylor-model sets whose centre follows a Runge-Kutta method. Expensive to
/// compile, and nowhere narrower than the Taylor series (docs/runge_kutta.md): not part of
/// sivid::compiled, no other header includes it.

#include <sivid/enclosure/parametric_runge_kutta.hpp>
#include <sivid/paving/experiment_run.hpp>
// What builds on it.
#include <sivid/paving/detail/taylor_run.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

namespace paving_detail {

/// `parametric_runge_kutta` as `taylor_run` drives it: a flow of one lane.
template <std::size_t N, std::size_t D>
class runge_kutta_lane {
public:
    using polynomial = taylor_model<N, D>;

    runge_kutta_lane(flow const& f, enclosure_options const& options)
        : flow_(&f), run_(f, options), observe_(f.observe(), 0) {}

    void begin(std::size_t, double time, box const& initial, box const& parameters) {
        run_.begin(time, initial, parameters);
        std::vector<polynomial> p;
        for (auto const& s : run_.unknowns().parameters) {
            normalised_unknowns::put(s, 0, p.emplace_back());
        }
        observe_.set_parameters(p);
        running_ = true;
    }
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
        observe_.start(t);
        observe_.advance(
            0, [&x](std::size_t i, std::size_t) -> polynomial const& { return x[i]; }, inputs);
        std::vector<polynomial> result;
        for (std::size_t y = 0; y < flow_->channels(); ++y) {
            result.push_back(observe_.output(y, 0));
            if (observe_.undefined()) result.back().r = detail::infinity;
        }
        return result;
    }

private:
    flow const* flow_;
    parametric_runge_kutta<N, D> run_;
    series<polynomial> observe_;
    bool running_ = false;
};

} // namespace paving_detail

/// A `run_maker`: `options.test.run.make = runge_kutta_run<>` with a `method` in the enclosure's
/// options. Up to three unknowns (parameters and starts with a width) by degree 4, up to six by 2.
/// Smooth models only: kinks are not crossed, the outputs end there.
/// @tparam Most  unknowns that code is made for, 3 or 6
/// @throws std::invalid_argument  for more unknowns, or without a method
template <std::size_t Most = 6>
[[nodiscard]] std::unique_ptr<experiment_run>
runge_kutta_run(flow const& f, experiment const& e, record const& samples, box const& initial,
                box const& prior, run_options const& options) {
    using namespace paving_detail;
    auto const unknowns = unknown_count(initial, prior);
    if (unknowns <= 3) {
        return std::make_unique<taylor_run<3, 4, double, runge_kutta_lane<3, 4>>>(f, e, samples,
                                                                                  options);
    }
    if constexpr (Most > 3) {
        if (unknowns <= 6) {
            return std::make_unique<taylor_run<6, 2, double, runge_kutta_lane<6, 2>>>(f, e, samples,
                                                                                      options);
        }
    }
    throw std::invalid_argument("runge_kutta_run: " + std::to_string(unknowns) +
                                " unknowns; Taylor models follow a Runge-Kutta method in " +
                                (Most > 3 ? "six" : "three") +
                                " at most: use sets of first order, or the Taylor series");
}

} // namespace sivid

#endif
