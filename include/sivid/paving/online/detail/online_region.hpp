// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_ONLINE_DETAIL_ONLINE_REGION_HPP
#define SIVID_PAVING_ONLINE_DETAIL_ONLINE_REGION_HPP

#include <sivid/paving/contract/detail/weighted_certificate.hpp>
#include <sivid/paving/response/detail/growing_response.hpp>
#include <sivid/paving/run/detail/continued_run_class.hpp>
#include <sivid/space/box.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// A family of trajectories that is carried on until nobody needs it any more.
class carried_family {
public:
    carried_family(continued_run& run, box const& initial, box const& parameters)
        : run_(&run), family_(run.begin(initial, parameters)) {}
    carried_family(carried_family&& other) noexcept
        : run_(std::exchange(other.run_, nullptr)), family_(other.family_) {}
    carried_family& operator=(carried_family&& other) noexcept {
        std::swap(run_, other.run_);
        std::swap(family_, other.family_);
        return *this;
    }
    ~carried_family() {
        if (run_ != nullptr) run_->end(family_);
    }
    [[nodiscard]] continued_run::family id() const { return family_; }

private:
    continued_run* run_;
    continued_run::family family_;
};

/// A box of parameters with the trajectories of all experiments over it.
struct online_region {
    /// One experiment, for all starts or for a box of them.
    struct run_state {
        box starts;
        std::optional<carried_family> family; ///< empty once the enclosure failed or says nothing
        growing_response known;
    };
    box domain; ///< what the trajectories are of
    box live;   ///< what of it may still be feasible
    std::vector<run_state> all;
    std::vector<std::optional<run_state>> chosen; ///< for starts from which existence is proved
    bool refuted = false;

    [[nodiscard]] response_list responses(bool of_chosen) const {
        response_list list;
        for (std::size_t e = 0; e < all.size(); ++e) {
            list.push_back(of_chosen && chosen[e] ? chosen[e]->known.known()
                                                  : all[e].known.known());
        }
        return list;
    }
    template <class Visit>
    void for_each_run(std::size_t e, Visit&& visit) {
        visit(all[e]);
        if (chosen[e]) visit(*chosen[e]);
    }
    /// What comes from now on is new.
    void forget_news() {
        for (std::size_t e = 0; e < all.size(); ++e) {
            for_each_run(e, [](run_state& run) { run.known.forget_news(); });
        }
    }
    /// Whether what is new can change what is known of a part.
    [[nodiscard]] bool concerned(box const& part) const {
        for (std::size_t e = 0; e < all.size(); ++e) {
            if (all[e].known.concerned(part)) return true;
        }
        return false;
    }
    /// Only this of it may still be feasible.
    void narrow(box const& rest) {
        live = rest;
        for (std::size_t e = 0; e < all.size(); ++e) {
            for_each_run(e, [&](run_state& run) { run.known.settle(live); });
            refuted = refuted || all[e].known.refuted();
        }
    }
};

} // namespace sivid

#endif
