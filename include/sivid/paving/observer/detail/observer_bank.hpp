// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_OBSERVER_DETAIL_OBSERVER_BANK_HPP
#define SIVID_PAVING_OBSERVER_DETAIL_OBSERVER_BANK_HPP

#include <sivid/model/problem.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/paving/observer/interval_observer.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// The interval observers of all experiments of a problem, those that refute often asked first.
class observer_bank {
public:
    static constexpr std::size_t width = interval_observer::width;

    /// @given  a problem whose model has no delays; it outlives this
    explicit observer_bank(identification_problem const& problem) {
        require_sound_environment();
        problem.require_valid();
        for (std::size_t s = 0; s < problem.experiments.size(); ++s) {
            observers_.emplace_back().observe = std::make_unique<interval_observer>(problem, s);
        }
    }

    struct finding {
        std::vector<bool> refuted; ///< per box: some experiment contradicts all of it
        /// Per box and parameter: how much its width moves the rates, over the experiments that
        /// were asked; estimates.
        std::vector<std::vector<double>> influence;
    };

    /// @param boxes  at most `width`, of one size
    /// @param level  inflation of the measured bounds
    /// @param go_on  false ends it with what is refuted by then
    [[nodiscard]] finding operator()(std::vector<box> const& boxes, double level,
                                     std::function<bool()> const& go_on) {
        auto const n = boxes.front().size();
        finding result{std::vector<bool>(boxes.size(), false),
                       std::vector<std::vector<double>>(boxes.size(), std::vector<double>(n, 0.0))};
        for (std::size_t k = 0; k < observers_.size(); ++k) {
            std::vector<box> rest;
            std::vector<std::size_t> whose;
            for (std::size_t b = 0; b < boxes.size(); ++b) {
                if (result.refuted[b]) continue;
                rest.push_back(boxes[b]);
                whose.push_back(b);
            }
            if (rest.empty()) break;
            auto& by = observers_[k];
            by.observe->keep_going = go_on;
            auto const found = (*by.observe)(rest, level, by.worth());
            bool any = false;
            for (std::size_t r = 0; r < rest.size(); ++r) {
                if ((found.refuted >> r & 1u) != 0) {
                    result.refuted[whose[r]] = any = true;
                    by.note(found.samples[r]);
                }
                for (std::size_t j = 0; j < n; ++j) {
                    result.influence[whose[r]][j] += found.influence[j][r];
                }
            }
            if (any && k > 0) std::swap(observers_[k], observers_[k - 1]);
        }
        return result;
    }

private:
    /// The observer of one experiment, and how many of its measurements it is worth to look at:
    /// where boxes used to be refuted early, half of one that was not soon is.
    struct watcher {
        std::unique_ptr<interval_observer> observe;
        std::vector<std::size_t> last; ///< measurements that the last refutations took, a ring
        std::size_t refuted = 0, asked = 0;

        [[nodiscard]] std::size_t worth() {
            // Now and then all of them: more may refute what fewer do not.
            if (last.size() < memory || ++asked % 4 == 0)
                return std::numeric_limits<std::size_t>::max();
            auto sorted = last;
            std::sort(sorted.begin(), sorted.end());
            auto const most_of_them = sorted[3 * memory / 4];
            return most_of_them + most_of_them / 4 + 1;
        }
        void note(std::size_t samples) {
            if (last.size() < memory) last.push_back(samples);
            last[refuted++ % memory] = samples;
        }
        static constexpr std::size_t memory = 32;
    };

    std::vector<watcher> observers_;
};

} // namespace sivid

#endif
