// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DETAIL_TAYLOR_RUN_HPP
#define SIVID_PAVING_DETAIL_TAYLOR_RUN_HPP

#include <sivid/enclosure/parametric_flow.hpp>
#include <sivid/paving/detail/measurement_walk.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/paving/taylor_kernels.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Taylor models in lanes: a lane that is done takes the next box. Points are run one by one.
/// @tparam Flow  what carries the sets
template <std::size_t N, std::size_t D, class C = std::conditional_t<D == 0, double, lanes<8>>,
          class Flow = parametric_flow<N, D, C>>
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
    Flow flow_;
    std::map<std::size_t, std::shared_ptr<monomial_table const>> tables_;
};

/// Not inline, so that it can be compiled once and apart from what uses it
/// (SIVID_COMPILED).
template <std::size_t N, std::size_t D>
std::unique_ptr<experiment_run> make_taylor_run(flow const& f, experiment const& e,
                                                record const& samples, run_options const& options) {
    return std::make_unique<taylor_run<N, D>>(f, e, samples, options);
}

#ifdef SIVID_COMPILED
// The library sivid::compiled holds these: the expensive part of every program that identifies.
#define SIVID_KERNEL(N, D)                                                                         \
    extern template std::unique_ptr<experiment_run> make_taylor_run<N, D>(                         \
        flow const&, experiment const&, record const&, run_options const&);
SIVID_TAYLOR_KERNELS(SIVID_KERNEL)
#undef SIVID_KERNEL
#endif

} // namespace paving_detail

} // namespace sivid

#endif
