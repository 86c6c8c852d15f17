// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_EXPERIMENT_RUN_HPP
#define SIVID_PAVING_EXPERIMENT_RUN_HPP

#include <sivid/enclosure/observation.hpp>
#include <sivid/enclosure/parametric_flow.hpp>
#include <sivid/enclosure/trajectory.hpp>
#include <sivid/paving/detail/affine_output.hpp>
#include <sivid/paving/problem.hpp>
#include <sivid/paving/response.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/paving/taylor_kernels.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// One experiment over boxes of parameters and starts: integrates, stepping onto the measurements,
/// and keeps the measured outputs as polynomials. Owns its work space; one object per thread.
class experiment_run {
public:
    virtual ~experiment_run() = default;
    /// @returns for each box of parameters the outputs that were reached; fewer than all when the
    ///          enclosure failed, became hopeless, or more measurements than allowed already fail
    ///          for the whole box
    [[nodiscard]] virtual std::vector<std::shared_ptr<response const>>
    operator()(box const& initial, std::vector<box> const& parameters) = 0;
    [[nodiscard]] std::shared_ptr<response const> operator()(box const& initial,
                                                             box const& parameters) {
        return (*this)(initial, std::vector<box>{parameters})[0];
    }
    /// How many boxes are best given together.
    [[nodiscard]] virtual std::size_t at_once() const { return 1; }
};

namespace paving_detail {

/// What an output says of a measurement.
struct kept_output {
    bool fails = false;
    bool hopeless = false;
};

/// The place of one run in the measurements of a record, which are met group by group in time.
class measurement_walk {
public:
    measurement_walk(record const& samples, std::size_t allowed)
        : samples_(&samples), allowed_(allowed) {}

    [[nodiscard]] bool done() const { return over_ || next_ >= samples_->size(); }
    /// Time of the next measurements.
    [[nodiscard]] double time() const { return (*samples_)[next_].time; }
    /// Takes the measurements of the present time.
    /// @param keep  (channel, bound) -> kept_output
    template <class Keep>
    void take(Keep&& keep) {
        double const t = time();
        bool hopeless = true;
        for (; next_ < samples_->size() && (*samples_)[next_].time == t; ++next_) {
            auto const verdict = keep((*samples_)[next_].channel, (*samples_)[next_].bound);
            failed_ += verdict.fails ? 1 : 0;
            hopeless = hopeless && verdict.hopeless;
        }
        over_ = failed_ > allowed_ || hopeless;
    }

private:
    record const* samples_;
    std::size_t allowed_;
    std::size_t next_ = 0;
    std::size_t failed_ = 0;
    bool over_ = false;
};

[[nodiscard]] inline std::shared_ptr<response> start_response(experiment const& e,
                                                              record const& samples,
                                                              box const& initial,
                                                              box const& parameters) {
    auto answer = std::make_shared<response>(
        response{normalised_unknowns(initial, parameters), nullptr, {}, {}, {}, {}, 0, 0});
    answer->measurements = samples.size();
    answer->allowed = e.outliers;
    return answer;
}

/// Taylor models in lanes: a lane that is done takes the next box. Points are run one by one.
template <std::size_t N, std::size_t D, class C = std::conditional_t<D == 0, double, lanes<8>>>
class taylor_run final : public experiment_run {
public:
    taylor_run(flow const& f, experiment const& e, record const& samples,
               run_options const& options)
        : experiment_(&e), samples_(&samples), options_(options), flow_(f, options.enclosure) {}

    using experiment_run::operator();
    [[nodiscard]] std::size_t at_once() const override { return width; }

    std::vector<std::shared_ptr<response const>>
    operator()(box const& initial, std::vector<box> const& parameters) override {
        std::vector<std::shared_ptr<response const>> answers(parameters.size());
        std::array<std::optional<lane>, width> lanes;
        for (std::size_t l = 0; l < width; ++l) flow_.end(l);
        std::size_t next = 0;
        std::size_t in_work = 0;
        while (next < parameters.size() || in_work > 0) {
            C limit(experiment_->begin);
            for (std::size_t l = 0; l < width; ++l) {
                while (!lanes[l] && next < parameters.size()) {
                    lanes[l] = begin(l, next, initial, parameters[next]);
                    ++next;
                    ++in_work;
                    if (!lanes[l]->walk.done()) continue;
                    answers[next - 1] = std::move(*lanes[l]).finish();
                    lanes[l].reset();
                    --in_work;
                }
                if (lanes[l]) lane_traits<C>::put(limit, l, lanes[l]->walk.time());
            }
            (void)flow_.advance(limit);
            std::vector<taylor_model<N, D, C>> seen;
            for (std::size_t l = 0; l < width; ++l) {
                if (!lanes[l]) continue;
                auto& mine = *lanes[l];
                bool over = flow_.failure(l).has_value();
                while (!over && !mine.walk.done() && !(flow_.time(l) < mine.walk.time())) {
                    if (seen.empty()) seen = flow_.outputs();
                    mine.walk.take([&](std::size_t channel, interval const& bound) {
                        return mine.keep(lane_of(seen[channel], l), bound, options_.hopeless);
                    });
                }
                if (!over && !mine.walk.done()) continue;
                auto const index = mine.box;
                answers[index] = std::move(mine).finish();
                lanes[l].reset();
                flow_.end(l);
                --in_work;
            }
        }
        return answers;
    }

private:
    static constexpr std::size_t width = lane_traits<C>::count;

    /// What is known of the box in one lane.
    struct lane {
        std::size_t box = 0;
        measurement_walk walk;
        std::shared_ptr<response> answer;
        std::vector<std::size_t> place; ///< of the used monomials among all
        response_builder collected;

        kept_output keep(taylor_model<N, D> const& y, interval const& bound, double hopeless) {
            collected.add([&](std::size_t m) { return y.c[place[m]]; }, y.r, bound);
            auto const value = rough_range(y);
            double const known = 2 * y.spread() + sivid::width(bound);
            return {interval_traits<interval>::disjoint(value, bound),
                    !(2 * y.r <= hopeless * known)};
        }
        std::shared_ptr<response const> finish() && {
            std::move(collected).finish(*answer);
            return answer;
        }
    };

    lane begin(std::size_t l, std::size_t index, box const& initial, box const& parameters) {
        auto answer = start_response(*experiment_, *samples_, initial, parameters);
        flow_.begin(l, experiment_->begin, initial, parameters);
        auto& table = tables_[answer->unknowns.variables];
        if (!table) {
            table = std::make_shared<monomial_table const>(
                monomial_table::of<N, D>(answer->unknowns.variables));
        }
        answer->table = table;
        std::vector<std::size_t> place;
        for (std::size_t m = 0; m < monomials<N, D>::count; ++m) {
            auto const& exponents = monomials<N, D>::data.exponents[m];
            if (std::all_of(exponents.begin() + static_cast<std::ptrdiff_t>(table->variables),
                            exponents.end(), [](std::uint8_t x) { return x == 0; })) {
                place.push_back(m);
            }
        }
        auto const terms = place.size();
        auto const allowed = answer->allowed;
        return {index, measurement_walk(*samples_, allowed), std::move(answer), std::move(place),
                response_builder(terms)};
    }

    experiment const* experiment_;
    record const* samples_;
    run_options options_;
    parametric_flow<N, D, C> flow_;
    std::map<std::size_t, std::shared_ptr<monomial_table const>> tables_;
};

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

/// Not inline, so that it can be compiled once and apart from what uses it
/// (SIVID_COMPILED).
template <std::size_t N, std::size_t D>
std::unique_ptr<experiment_run> make_taylor_run(flow const& f, experiment const& e,
                                                record const& samples, run_options const& options) {
    return std::make_unique<taylor_run<N, D>>(f, e, samples, options);
}

/// Number of sides of an experiment that have a width.
[[nodiscard]] inline std::size_t unknown_count(box const& initial, box const& prior) {
    return normalised_unknowns(initial, prior).variables;
}

/// The smallest step for an experiment. A smallest step that is not much shorter than the pieces of
/// an input ends runs that only have to start gently after each knot: then every piece may take 500
/// steps. Samples that nearly coincide do not count.
[[nodiscard]] inline double minimum_step_for(experiment const& e, double asked) {
    double shortest = detail::infinity;
    for (auto const& input : e.inputs) {
        auto const* u = std::get_if<sampled_signal>(&input);
        if (u == nullptr) continue;
        for (std::size_t k = 1; k < u->times().size(); ++k) {
            shortest = std::min(shortest, u->times()[k] - u->times()[k - 1]);
        }
    }
    if (!(shortest < 40 * asked)) return asked;
    return std::min(asked, std::max(shortest / 500, 1e-6));
}

#ifdef SIVID_COMPILED
// The library sivid::kernels holds these: the dear part of every program that identifies.
#define SIVID_KERNEL(N, D)                                                                         \
    extern template std::unique_ptr<experiment_run> make_taylor_run<N, D>(                         \
        flow const&, experiment const&, record const&, run_options const&);
SIVID_TAYLOR_KERNELS(SIVID_KERNEL)
#undef SIVID_KERNEL
#endif

} // namespace paving_detail

/// The kernel that fits the number of unknowns; beyond the largest the sets are of first order.
/// @param initial, prior  what the boxes to come lie in
[[nodiscard]] inline std::unique_ptr<experiment_run> make_run(flow const& f, experiment const& e,
                                                              record const& samples,
                                                              box const& initial, box const& prior,
                                                              run_options options) {
    using namespace paving_detail;
    options.enclosure.minimum_step = minimum_step_for(e, options.enclosure.minimum_step);
    auto const unknowns = unknown_count(initial, prior);
    // What uncertain inputs cost, no smaller box gives back.
    if (f.uncertain()) options.hopeless = 1e300;
    if (options.set == carried_set::taylor_model) {
        auto run = with_taylor_kernel(unknowns, [&]<std::size_t N, std::size_t D>() {
            return make_taylor_run<N, D>(f, e, samples, options);
        });
        if (run) return run;
    }
    return std::make_unique<doubleton_run>(f, e, samples, options);
}
[[nodiscard]] inline std::unique_ptr<experiment_run> make_run(flow const& f, experiment const& e,
                                                              record const& samples,
                                                              box const& prior,
                                                              run_options const& options) {
    return make_run(f, e, samples, e.initial, prior, options);
}

} // namespace sivid

#endif
