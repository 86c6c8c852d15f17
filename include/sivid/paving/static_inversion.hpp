// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_INVERSION_HPP
#define SIVID_PAVING_STATIC_INVERSION_HPP

#include <sivid/number/guard.hpp>
#include <sivid/number/pack_traits.hpp>
#include <sivid/paving/flat_paving.hpp>
#include <sivid/paving/static_judge.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

struct static_inversion_options {
    /// A side is not split below this share of the prior's side.
    double accuracy = 1e-3;
    /// Stop when the volume that is neither inside nor outside falls to this share of the prior's.
    double uncertain = 0;
    double seconds = 60;
    std::size_t boxes = 100'000'000;
    sivid::first_order forms = sivid::first_order::always;
    std::function<bool()> keep_going; ///< asked once a block; false ends the work
};

/// Set inversion for static problems: largest boxes first, eight at a time, with every measurement
/// that a box's parent decided left alone.
///   Waiting boxes lie in blocks of flat arrays. Each is tested by the enclosures of its open
///   measurements
///   (`static_judge`), then kept, dropped, or cut where its open outputs spread most.
/// @guarantee  boxes `inside` are feasible throughout; every feasible parameter of the prior lies
/// in a box
/// @cost  about 10 to 100 ns a box for small models
/// @ref  Jaulin and Walter, Automatica 29 (1993): SIVIA
template <std::size_t W = 8>
class static_inversion {
public:
    static_inversion(static_problem const& problem, static_inversion_options options)
        : judge_(problem, options.forms),
          prior_(problem.prior),
          options_(std::move(options)),
          result_(problem.prior) {}

    [[nodiscard]] flat_paving operator()() {
        require_sound_environment();
        require_pack_support();
        auto const begin = std::chrono::steady_clock::now();
        auto const seconds = [&] {
            return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        };
        prepare();
        while (!waiting_.empty()) {
            if (options_.keep_going && !options_.keep_going()) {
                stop(stop_reason::cancelled);
            } else if (seconds() > options_.seconds) {
                stop(stop_reason::time_budget);
            } else if (result_.tested >= options_.boxes) {
                stop(stop_reason::box_budget);
            } else {
                work_through();
            }
        }
        result_.seconds = seconds();
        return std::move(result_);
    }

private:
    using block = static_block;

    void prepare() {
        auto& first = block_for(1);
        for (std::size_t j = 0; j < prior_.size(); ++j) {
            least_.push_back(options_.accuracy * width(prior_[j]));
            thick_.push_back(prior_[j].lower() < prior_[j].upper());
            scale_.push_back(thick_[j] != 0 ? 1 / width(prior_[j]) : 0);
            first.boxes.lower(j)[0] = prior_[j].lower();
            first.boxes.upper(j)[0] = prior_[j].upper();
        }
        judge_.open_all(first, 0);
        first.count = 1;
        uncertain_ = approximate_volume(first, 0);
        allowed_ = options_.uncertain * uncertain_;
    }

    /// A block with room for boxes of a volume.
    block& block_for(double volume) {
        auto& list = waiting_[volume > 0 ? std::ilogb(volume) / 2 : -2000];
        if (!list.empty() && !list.back()->full()) return *list.back();
        if (spare_.empty()) {
            list.push_back(std::make_unique<block>(prior_.size(), judge_.words()));
        } else {
            list.push_back(std::move(spare_.back()));
            spare_.pop_back();
        }
        list.back()->count = 0;
        return *list.back();
    }

    /// All that waits stays open.
    void stop(stop_reason why) {
        result_.reason = why;
        for (auto const& [size, list] : waiting_) {
            for (auto const& b : list) {
                for (std::size_t i = 0; i < b->count; ++i) result_.open.add(b->boxes, i);
            }
        }
        waiting_.clear();
    }

    [[nodiscard]] double approximate_volume(block const& b, std::size_t i) const {
        double v = 1;
        for (std::size_t j = 0; j < prior_.size(); ++j) {
            double const w = b.boxes.upper(j)[i] - b.boxes.lower(j)[i];
            v *= thick_[j] != 0 ? w : 1;
        }
        return v;
    }

    /// Tests a block of the largest boxes.
    void work_through() {
        auto& list = waiting_.begin()->second;
        auto now = std::move(list.front());
        list.pop_front();
        if (list.empty()) waiting_.erase(waiting_.begin());
        now->pad(W);
        for (std::size_t i = 0; i < now->count; i += W) {
            auto const lanes = std::min(W, now->count - i);
            double before = 0;
            for (std::size_t l = 0; l < lanes; ++l) before += approximate_volume(*now, i + l);
            auto const found = judge_(*now, i);
            result_.tested += lanes;
            double after = 0;
            for (std::size_t l = 0; l < lanes; ++l) {
                auto const bit = std::uint64_t{1} << l;
                if ((found.outside & bit) != 0) continue;
                if ((found.inside & bit) != 0) {
                    result_.inside.add(now->boxes, i + l);
                    continue;
                }
                keep_core(*now, i + l, l);
                after += approximate_volume(*now, i + l);
                split(*now, i + l, l);
            }
            uncertain_ -= before - after;
            if (allowed_ > 0 && uncertain_ <= allowed_) {
                for (auto k = i + lanes; k < now->count; ++k) result_.open.add(now->boxes, k);
                stop(stop_reason::accuracy_reached);
                return;
            }
        }
        spare_.push_back(std::move(now));
    }

    /// Cuts off what is inside and keeps the core.
    void keep_core(block& b, std::size_t i, std::size_t lane) {
        for (std::size_t j = 0; j < prior_.size(); ++j) {
            double& lo = b.boxes.lower(j)[i];
            double& hi = b.boxes.upper(j)[i];
            double const from = judge_.core_lower(j, lane), to = judge_.core_upper(j, lane);
            if (lo < from) {
                double const end = std::exchange(hi, from);
                result_.inside.add(b.boxes, i);
                hi = end;
                lo = from;
            }
            if (to < hi) {
                double const begin = std::exchange(lo, to);
                result_.inside.add(b.boxes, i);
                lo = begin;
                hi = to;
            }
        }
    }

    /// Halves of box i at the end of what waits; or the box stays open.
    void split(block const& from, std::size_t i, std::size_t lane) {
        std::size_t side = prior_.size();
        double most = -1, widest = 0;
        for (std::size_t j = 0; j < prior_.size(); ++j) {
            double const w = from.boxes.upper(j)[i] - from.boxes.lower(j)[i];
            if (!(w > least_[j])) continue;
            double const rank = judge_.slope(j, lane) * w, share = w * scale_[j];
            // Where the slopes say nothing (none, or unbounded ones) the widest side.
            if (rank > most || (rank == most && share > widest)) {
                most = rank;
                widest = share;
                side = j;
            }
        }
        if (side < prior_.size()) {
            double const lo = from.boxes.lower(side)[i], hi = from.boxes.upper(side)[i];
            double const middle = lo + 0.5 * (hi - lo);
            if (lo < middle && middle < hi) {
                // Two places: blocks are even.
                auto& to = block_for(0.5 * approximate_volume(from, i));
                to.copy(from, i, to.count);
                to.copy(from, i, to.count + 1);
                to.boxes.upper(side)[to.count] = middle;
                to.boxes.lower(side)[to.count + 1] = middle;
                to.count += 2;
                return;
            }
        }
        result_.reason = stop_reason::accuracy_reached;
        result_.open.add(from.boxes, i);
    }

    static_judge<W> judge_;
    box prior_;
    static_inversion_options options_;
    flat_paving result_;
    /// Blocks of boxes of about one size, by the binary exponent of their volume, largest first.
    std::map<int, std::deque<std::unique_ptr<block>>, std::greater<>> waiting_;
    std::vector<std::unique_ptr<block>> spare_;
    std::vector<double> least_, scale_; ///< least width to split, 1 / width of the prior
    std::vector<char> thick_;
    double uncertain_ = 0, allowed_ = 0;
};

/// Finds the parameters in the prior that satisfy the measurements.
[[nodiscard]] inline flat_paving invert_static(static_problem const& problem,
                                               static_inversion_options options = {}) {
    return static_inversion<8>(problem, std::move(options))();
}

} // namespace sivid

#endif
