// SPDX-License-Identifier: MIT
#ifndef SIVID_APPROXIMATE_CANDIDATE_DETAIL_EPISODE_SEARCH_HPP
#define SIVID_APPROXIMATE_CANDIDATE_DETAIL_EPISODE_SEARCH_HPP

#include <sivid/approximate/candidate/detail/episode_fit.hpp>
#include <sivid/executor.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Looks among single effects for one that begins or ends in the midst of experiments. Nothing here
/// is proved.
class episode_search {
public:
    struct single {
        effect e;
        std::vector<double> always; ///< parameters of a fit with the effect all the time
    };
    struct questions {
        std::function<bool(std::string const&)> may_try; ///< for any thread
        std::function<bool()> in_time;                   ///< the same
    };

    /// @param base  without effects; outlives this object and what it finds
    episode_search(identification_problem const& base, std::vector<single> effects,
                   executor workers, questions ask)
        : base_(&base),
          effects_(std::move(effects)),
          workers_(std::move(workers)),
          ask_(std::move(ask)) {}

    /// Effects that begin in each experiment at a time of its own; where none of these explains the
    /// data, such that end so; then such that do both, of those that came closest.
    /// @param ends  whether the latter two are tried
    /// @returns  those that explain the data
    /// @cost  two rough fits for each effect and question, seven or more for four of them
    [[nodiscard]] std::vector<episode_fit> operator()(bool ends) const {
        fits begin = roughly({.begins = true, .ends = false}, " from a time on");
        if (auto found = explaining(begin); !found.empty() || !ends) return found;
        fits end = roughly({.begins = false, .ends = true}, " until a time");
        if (auto found = explaining(end); !found.empty()) return found;
        fits both;
        for (auto const* some : {&begin, &end}) {
            for (auto const& one : *some) {
                auto const same = [&](episode_fit const& x) { return x.name() == one.name(); };
                if (std::any_of(both.begin(), both.end(), same)) continue;
                both.push_back(
                    posed(*std::find_if(effects_.begin(), effects_.end(),
                                        [&](single const& x) { return x.e.name == one.name(); }),
                          {true, true}));
            }
        }
        workers_(both.size(), [&](std::size_t k) {
            if (!ask_.may_try(both[k].name() + " for a time")) return;
            both[k].look_roughly();
            for (auto const* some : {&begin, &end})
                for (auto const& one : *some)
                    if (one.name() == both[k].name()) both[k].look_roughly(one);
        });
        return explaining(both);
    }

private:
    using fits = std::vector<episode_fit>;
    static constexpr std::ptrdiff_t most = 4; ///< that are looked at closely

    [[nodiscard]] episode_fit posed(single const& s, episode_ends which) const {
        return {*base_, s.e, s.always, which, ask_.in_time};
    }
    [[nodiscard]] fits roughly(episode_ends which, char const* words) const {
        fits all;
        for (auto const& s : effects_) all.push_back(posed(s, which));
        workers_(all.size(), [&](std::size_t k) {
            if (ask_.may_try(all[k].name() + words)) all[k].look_roughly();
        });
        return all;
    }
    /// Leaves the closest, looks at them closely.
    [[nodiscard]] fits explaining(fits& all) const {
        std::stable_sort(all.begin(), all.end(),
                         [](auto const& a, auto const& b) { return a.squares() < b.squares(); });
        if (std::ssize(all) > most) all.erase(all.begin() + most, all.end());
        workers_(all.size(), [&](std::size_t k) {
            if (ask_.in_time()) all[k].look_closely();
        });
        fits found;
        std::copy_if(all.begin(), all.end(), std::back_inserter(found),
                     [](episode_fit const& f) { return f.explains(); });
        return found;
    }

    identification_problem const* base_;
    std::vector<single> effects_;
    executor workers_;
    questions ask_;
};

} // namespace sivid

#endif
