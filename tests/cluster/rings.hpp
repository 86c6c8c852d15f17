// SPDX-License-Identifier: MIT
// A batch test that is cheap to ask, and whose answers depend on the companions of a box: a ring in
// the plane.
#ifndef SIVID_TESTS_CLUSTER_RINGS_HPP
#define SIVID_TESTS_CLUSTER_RINGS_HPP

#include <sivid/number/decimal.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace cluster_test {

using sivid::box;
using sivid::box_verdict;
using sivid::interval;

/// 1 <= x^2 + y^2 <= 2
class ring_test {
public:
    static constexpr bool concurrent = true;
    struct knowledge {
        box region;
        double share = 0; ///< a part smaller than this one is not seen
    };
    using answer = sivid::assessment<knowledge>;

    std::atomic<std::size_t> learnt = 0, judged = 0;
    std::function<bool()> keep_going = nullptr;
    bool cancelled() const { return keep_going && !keep_going(); }

    answer judge(box const& x, std::shared_ptr<knowledge const> const& known) {
        answer says{.rest = x};
        if (!known || !subset(x, known->region)) {
            says.blind = true;
            return says;
        }
        ++judged;
        double const share = width(x[0]) / width(known->region[0]);
        if (share < known->share) {
            says.blind = true;
            return says;
        }
        decide(says, x);
        says.knowledge = known;
        return says;
    }
    std::vector<answer> learn(std::vector<box> const& boxes) {
        std::vector<answer> result;
        double of_all = 0; // what the companions share
        for (auto const& x : boxes) of_all += x[0].lower() * x[1].upper();
        for (auto const& x : boxes) {
            ++learnt;
            answer says{.rest = x};
            says.cost = boxes.size();
            says.smear = {width(x[0]) + 1e-3 * std::abs(of_all), width(x[1])};
            says.proof.push_back({sivid::proof_step::kind::run, boxes.size(), false, of_all, {}});
            decide(says, x);
            if (says.verdict == box_verdict::undecided) {
                says.knowledge = std::make_shared<knowledge>(
                    knowledge{x, 0.1 + 0.2 * std::abs(std::sin(of_all))});
            }
            result.push_back(std::move(says));
        }
        return result;
    }
    std::size_t at_once() const { return 4; }
    std::size_t bytes(knowledge const& k) const { return 100 + k.region.size(); }

private:
    static void decide(answer& says, box const& x) {
        using traits = sivid::interval_traits<interval>;
        auto const r = traits::add(traits::mul(x[0], x[0]), traits::mul(x[1], x[1]));
        if (r.lower() > 2 || r.upper() < 1) {
            says.verdict = box_verdict::outside;
            says.proof.push_back(
                {sivid::proof_step::kind::empty, 0, false, 0, {{{1, 2, r.lower()}}}});
        } else if (r.lower() >= 1 && r.upper() <= 2) {
            says.verdict = box_verdict::inside;
        }
    }
};

inline box ring_prior() {
    using namespace sivid;
    return {sivid::hull(-1.6_dec, 1.7_dec), sivid::hull(-1.5_dec, 1.9_dec)};
}

} // namespace cluster_test

#endif
