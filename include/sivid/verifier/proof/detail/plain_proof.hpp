// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_PLAIN_PROOF_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_PLAIN_PROOF_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/paving/run/plain_run.hpp>
#include <sivid/space/box_cover.hpp>
#include <sivid/verifier/check_finding.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// All experiments of a problem by plain runs: what they say of regions and of their parts.
/// @tparam I  the interval type of the runs
template <class I>
class proved_campaign {
public:
    /// @param starts  where existence is to be proved from, a box per experiment; may be empty (all
    /// starts of the experiment then)
    proved_campaign(identification_problem const& problem, std::vector<box> starts,
                    enclosure_options const& options)
        : problem_(&problem), starts_(std::move(starts)) {
        for (auto const& e : problem.experiments) {
            runs_.push_back(
                std::make_unique<plain_run<I>>(problem.model, problem.choice, e, options));
            recorded_.emplace_back();
            if (!any_uncertain(e.inputs)) continue;
            auto exact = e;
            exact.inputs = nominal(e.inputs);
            recorded_.back() =
                std::make_unique<plain_run<I>>(problem.model, problem.choice, exact, options);
        }
    }

    /// What the experiments say of a region: of all of them, or of those up to one that refutes it.
    struct knowledge {
        /// For all starts and inputs, for the chosen starts and the recorded inputs.
        std::vector<plain_outputs<I>> all, chosen;
        bool refuted = false; ///< the whole region is
    };

    [[nodiscard]] std::size_t runs() const { return count_; }

    /// Runs experiments over the region until one refutes it.
    /// @cost  one validated run per experiment, two where starts are chosen
    [[nodiscard]] knowledge learn(box const& region) {
        knowledge known;
        for (std::size_t e = 0; e < runs_.size() && !known.refuted; ++e) {
            auto const& own = problem_->experiments[e];
            ++count_;
            known.all.push_back((*runs_[e])(own.initial, region));
            known.chosen.emplace_back();
            known.refuted = decide(known.all[e], runs_[e]->samples(), region, own.outliers) ==
                            run_finding::refuted;
            if (known.refuted || !has_chosen(e)) continue;
            ++count_;
            auto& exactly = *(recorded_[e] ? recorded_[e] : runs_[e]);
            known.chosen[e] = exactly(e < starts_.size() ? starts_[e] : own.initial, region);
        }
        return known;
    }

    /// Decides a part of the region that is known.
    /// @guarantee  explained: for each parameter of the part there are starts and inputs for which
    /// every experiment holds; refuted: for no parameter of it
    [[nodiscard]] run_finding judge(knowledge const& known, box const& part) const {
        if (known.refuted) return run_finding::refuted;
        bool explained = true;
        for (std::size_t e = 0; e < known.all.size(); ++e) {
            auto const q = problem_->experiments[e].outliers;
            auto const& samples = runs_[e]->samples();
            auto const says = decide(known.all[e], samples, part, q);
            if (says == run_finding::refuted) return says;
            bool const holds = says == run_finding::explained ||
                               (has_chosen(e) && decide(known.chosen[e], samples, part, q) ==
                                                     run_finding::explained);
            explained = explained && holds;
        }
        return explained ? run_finding::explained : run_finding::open;
    }

    /// How far side j of a part spreads an output, in widths of its measurement; a preference only.
    [[nodiscard]] double spread(knowledge const& known, box const& part, std::size_t j) const {
        double most = 0;
        for (std::size_t e = 0; e < known.all.size(); ++e) {
            auto const& samples = runs_[e]->samples();
            for (std::size_t k = 0; k < known.all[e].outputs.size(); ++k) {
                auto const& g = known.all[e].outputs[k].gradient;
                double const slope = std::abs(g[g.size() - part.size() + j]);
                double const room = std::max(width(samples[k].bound), 1e-300);
                most = std::max(most, slope * (part[j].upper() - part[j].lower()) / room);
            }
        }
        return most;
    }

private:
    [[nodiscard]] bool has_chosen(std::size_t e) const {
        return recorded_[e] ||
               (e < starts_.size() && !subset(problem_->experiments[e].initial, starts_[e]));
    }

    identification_problem const* problem_;
    std::vector<box> starts_;
    std::vector<std::unique_ptr<plain_run<I>>> runs_;
    std::vector<std::unique_ptr<plain_run<I>>> recorded_; ///< where inputs have error bounds
    std::size_t count_ = 0;
};

/// Something that a result says of a box of parameters, to be proved anew.
struct box_claim {
    enum class kind { inside, outside };
    enum class status { proved, refuted, open };

    box set;
    kind what = kind::outside;
    status found = status::open;
    std::vector<double> counterexample = {}; ///< a point that proves the contrary, when refuted
};

namespace io_detail {

/// The side of the highest rank above `least`, of those that can be cut in their middle.
/// @param rank  of a side, by its number
template <class Rank>
[[nodiscard]] std::optional<std::size_t> side_to_cut(box const& x, Rank const& rank,
                                                     double least = -1) {
    std::optional<std::size_t> best;
    for (std::size_t j = 0; j < x.size(); ++j) {
        double const middle = mid(x[j]);
        if (!(x[j].lower() < middle && middle < x[j].upper())) continue;
        double const own = rank(j);
        if (!(own > least)) continue;
        least = own;
        best = j;
    }
    return best;
}
/// The side that is widest against the prior's, of those that are wider than `least` of it.
[[nodiscard]] inline std::optional<std::size_t> widest_side(box const& x, box const& prior,
                                                            double least = -1) {
    auto const share = [&](std::size_t j) {
        return is_one_number(prior[j]) ? -1 : width(x[j]) / width(prior[j]);
    };
    return side_to_cut(x, share, least);
}

} // namespace io_detail

/// Proves or refutes claims about boxes by plain runs, in subdivisions of its own: claims that lie
/// close are run together; of a box alone that a run leaves open, the halves are run.
/// @guarantee  `proved` and `refuted` are proofs in the arithmetic of I, from the same model and
/// data; `open` says nothing
/// @tparam I  the interval type of the runs
template <class I>
class claim_checker {
public:
    /// @param starts  where existence is to be proved from, a box per experiment; may be empty (all
    /// starts of the experiment then)
    claim_checker(identification_problem const& problem, std::vector<box> starts,
                  certificate_options options)
        : prior_(problem.prior),
          campaign_(problem, std::move(starts), options),
          options_(std::move(options)) {}

    [[nodiscard]] std::size_t runs() const { return campaign_.runs(); }

    /// Tries the claims that are open.
    void operator()(std::vector<box_claim>& claims) {
        limit_ = work_limit(options_.seconds, options_.keep_going);
        std::vector<progress> books(claims.size());
        group all;
        for (std::size_t k = 0; k < claims.size(); ++k) {
            books[k].claim = &claims[k];
            if (claims[k].found == status::open) all.push_back({claims[k].set, &books[k]});
        }
        if (!all.empty()) settle(std::move(all));
    }

private:
    using status = box_claim::status;
    using knowledge = typename proved_campaign<I>::knowledge;
    struct progress {
        box_claim* claim = nullptr;
        std::size_t left = 1, runs = 0; ///< parts to prove; runs of one of them alone
        bool gave_up = false;
    };
    struct piece {
        box set;
        progress* of;
    };
    using group = std::vector<piece>;

    [[nodiscard]] static bool is_inside(piece const& p) {
        return p.of->claim->what == box_claim::kind::inside;
    }
    static void refute(piece const& p, std::vector<double> at) {
        p.of->claim->found = status::refuted;
        p.of->claim->counterexample = std::move(at);
    }

    /// Looks for a point inside the piece that contradicts its claim.
    void probe(piece const& p, knowledge const& known) {
        auto const wrong = is_inside(p) ? run_finding::refuted : run_finding::explained;
        auto const n = std::min<std::size_t>(p.set.size(), 4);
        for (std::size_t corner = 0; corner <= (std::size_t{1} << n); ++corner) {
            auto at = mid(p.set);
            for (std::size_t j = 0; j < n && corner > 0; ++j) {
                double const w = p.set[j].upper() - p.set[j].lower();
                double const x = at[j] + ((((corner - 1) >> j) & 1) != 0 ? 0.4 : -0.4) * w;
                if (contains(p.set[j], x)) at[j] = x;
            }
            if (campaign_.judge(known, point_box(at)) != wrong) continue;
            refute(p, at);
            return;
        }
    }

    void settle(group pieces) {
        std::erase_if(pieces, [](piece const& p) {
            return p.of->claim->found == status::refuted || p.of->gave_up;
        });
        if (pieces.empty()) return;
        bool const late = !limit_();
        for (auto const& p : pieces) p.of->gave_up = p.of->gave_up || late;
        if (late) return;
        auto region = pieces[0].set;
        for (auto const& p : pieces) region = hull(region, p.set);
        if (io_detail::widest_side(region, prior_, options_.widest_region) &&
            split(pieces, region, nullptr))
            return;
        auto const known = campaign_.learn(region);
        group rest;
        for (auto& p : pieces) {
            auto const says = campaign_.judge(known, p.set);
            auto const right = is_inside(p) ? run_finding::explained : run_finding::refuted;
            if (says == run_finding::open)
                rest.push_back(std::move(p));
            else if (says != right)
                refute(p, mid(p.set));
            else if (--p.of->left == 0)
                p.of->claim->found = status::proved;
        }
        if (rest.empty()) return;
        if (rest.size() == 1 && pieces.size() > 1) return settle(std::move(rest)); // by itself
        for (auto const& p : rest) probe(p, known);
        auto& first = *rest[0].of;
        bool const tired = rest.size() == 1 && ++first.runs >= options_.runs_per_claim;
        if (tired || !split(rest, region, &known)) first.gave_up = true;
    }

    /// A group in the middle of its widest side, a box alone where its outputs spread most.
    /// @returns false where that is not possible
    bool split(group& pieces, box const& region, knowledge const* known) {
        bool const alone = pieces.size() == 1;
        auto const side =
            alone && known != nullptr
                ? io_detail::side_to_cut(
                      region, [&](std::size_t j) { return campaign_.spread(*known, region, j); })
                : io_detail::widest_side(region, prior_);
        if (alone && !side) return false;
        group low, high;
        if (alone) {
            auto [a, b] = bisect(region, *side, mid(region[*side]));
            ++pieces[0].of->left;
            low.push_back({std::move(a), pieces[0].of});
            high.push_back({std::move(b), pieces[0].of});
        } else {
            auto const j = side.value_or(0);
            double const middle = mid(region[j]);
            for (auto& p : pieces) {
                auto const& own = p.set[j];
                bool const across = own.lower() < middle && middle < own.upper() &&
                                    width(own) > 0.5 * width(region[j]);
                if (across) { // with such pieces no region shrinks
                    auto [a, b] = bisect(p.set, j, middle);
                    ++p.of->left;
                    low.push_back({std::move(a), p.of});
                    high.push_back({std::move(b), p.of});
                } else {
                    (mid(own) <= middle ? low : high).push_back(std::move(p));
                }
            }
            if (low.empty()) std::swap(low, high);
            if (high.empty()) { // all of them on one side
                auto const half = low.begin() + static_cast<std::ptrdiff_t>(low.size() / 2);
                high.assign(std::make_move_iterator(half), std::make_move_iterator(low.end()));
                low.erase(half, low.end());
            }
        }
        settle(std::move(low));
        settle(std::move(high));
        return true;
    }

    box prior_;
    proved_campaign<I> campaign_;
    certificate_options options_;
    work_limit limit_{0};
};

namespace io_detail {

/// What validated runs prove of the parameters that a fit ended at.
/// @param at_its_starts  explained for the fitted starts; else refuted for all starts
/// @param keep_going  once false, nothing is proved; may be empty
template <class I>
[[nodiscard]] run_finding judge_point(identification_problem const& problem,
                                      approximate_fit const& f, bool at_its_starts,
                                      std::function<bool()> const& keep_going = nullptr) {
    std::vector<box> starts;
    for (std::size_t e = 0; e < f.starts.size() && at_its_starts; ++e) {
        starts.push_back(point_within(problem.experiments[e].initial, f.starts[e]));
    }
    enclosure_options fine{
        .order = 14, .tolerance = 1e-11, .relative_tolerance = 1e-3, .minimum_step = 1e-7};
    fine.keep_going = keep_going;
    proved_campaign<I> campaign(problem, std::move(starts), fine);
    auto const p = point_box(f.parameters);
    return campaign.judge(campaign.learn(p), p);
}

} // namespace io_detail

} // namespace sivid

#endif
