// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DETAIL_TAYLOR_CONTINUATION_HPP
#define SIVID_PAVING_DETAIL_TAYLOR_CONTINUATION_HPP

#include <sivid/enclosure/parametric_flow.hpp>
#include <sivid/paving/taylor_kernels.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace paving_detail {

/// Taylor models in lanes; a family keeps its lane until it ends.
template <std::size_t N, std::size_t D>
class taylor_continuation final : public continued_run {
public:
    taylor_continuation(flow const& f, double begin, enclosure_options const& options)
        : flow_(&f), begin_(begin), options_(options) {}

    [[nodiscard]] std::size_t at_once() const override { return width; }

    [[nodiscard]] family begin(box const& initial, box const& parameters) override {
        std::size_t b = 0, l = 0;
        auto const is_free = [&] { return !banks_[b]->lanes[l]; };
        while (b < banks_.size() && !is_free()) {
            if (++l < width) continue;
            l = 0;
            ++b;
        }
        if (b == banks_.size()) banks_.push_back(std::make_unique<bank>(*flow_, options_));
        auto& own = *banks_[b];
        own.carried.begin(l, begin_, initial, parameters);
        auto& lane = own.lanes[l].emplace(normalised_unknowns(initial, parameters));
        lane.table = std::make_shared<monomial_table const>(
            monomial_table::of<N, D>(lane.unknowns.variables));
        for (std::size_t m = 0; m < monomials<N, D>::count; ++m) {
            auto const& e = monomials<N, D>::data.exponents[m];
            if (std::all_of(e.begin() + static_cast<std::ptrdiff_t>(lane.unknowns.variables),
                            e.end(), [](std::uint8_t x) { return x == 0; })) {
                lane.place.push_back(m);
            }
        }
        return b * width + l;
    }
    void end(family f) override {
        banks_[f / width]->carried.end(f % width);
        banks_[f / width]->lanes[f % width].reset();
    }
    [[nodiscard]] normalised_unknowns const& unknowns(family f) const override {
        return lane_of_family(f).unknowns;
    }
    [[nodiscard]] std::shared_ptr<monomial_table const> table(family f) const override {
        return lane_of_family(f).table;
    }

    [[nodiscard]] std::vector<std::vector<output_polynomial>>
    read(std::vector<family> const& which, double time,
         std::vector<std::size_t> const& channels) override {
        std::vector<std::vector<output_polynomial>> result(which.size());
        for (std::size_t b = 0; b < banks_.size(); ++b) {
            std::array<bool, width> wanted{};
            for (auto const f : which) {
                if (f / width == b) wanted[f % width] = true;
            }
            auto& run = banks_[b]->carried;
            scalar limit(0.0);
            for (std::size_t l = 0; l < width; ++l) {
                lane_traits<scalar>::put(limit, l, wanted[l] ? time : run.time(l));
            }
            bool any = false;
            for (bool moves = true; moves;) {
                moves = any = false;
                for (std::size_t l = 0; l < width; ++l) {
                    if (!wanted[l] || run.failure(l)) continue;
                    any = true;
                    moves = moves || run.time(l) < time;
                }
                if (moves) (void)run.advance(limit);
            }
            if (!any) continue;
            auto const seen = run.outputs();
            for (std::size_t k = 0; k < which.size(); ++k) {
                auto const l = which[k] % width;
                if (which[k] / width != b || run.failure(l)) continue;
                auto const& place = banks_[b]->lanes[l]->place;
                for (auto const c : channels) {
                    auto const y = lane_of(seen[c], l);
                    auto& out = result[k].emplace_back();
                    for (auto const m : place) out.coefficients.push_back(y.c[m]);
                    out.radius = y.r;
                }
            }
        }
        return result;
    }

private:
    using scalar = lanes<8>;
    static constexpr std::size_t width = lane_traits<scalar>::count;

    struct occupant {
        explicit occupant(normalised_unknowns u) : unknowns(std::move(u)) {}
        normalised_unknowns unknowns;
        std::shared_ptr<monomial_table const> table;
        std::vector<std::size_t> place; ///< of the used monomials among all
    };
    struct bank {
        bank(flow const& f, enclosure_options const& options) : carried(f, options) {}
        parametric_flow<N, D, scalar> carried;
        std::array<std::optional<occupant>, width> lanes;
    };
    [[nodiscard]] occupant const& lane_of_family(family f) const {
        return *banks_[f / width]->lanes[f % width];
    }

    flow const* flow_;
    double begin_;
    enclosure_options options_;
    std::vector<std::unique_ptr<bank>> banks_;
};

/// Not inline, for the same reason as `make_taylor_run`.
template <std::size_t N, std::size_t D>
std::unique_ptr<continued_run> make_taylor_continuation(flow const& f, double begin,
                                                        enclosure_options const& options) {
    return std::make_unique<taylor_continuation<N, D>>(f, begin, options);
}

#ifdef SIVID_COMPILED
#define SIVID_KERNEL(N, D)                                                                         \
    extern template std::unique_ptr<continued_run> make_taylor_continuation<N, D>(                 \
        flow const&, double, enclosure_options const&);
SIVID_TAYLOR_KERNELS(SIVID_KERNEL)
#undef SIVID_KERNEL
#endif

} // namespace paving_detail

} // namespace sivid

#endif
