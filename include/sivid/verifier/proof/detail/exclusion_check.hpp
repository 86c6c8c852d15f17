// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_EXCLUSION_CHECK_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_EXCLUSION_CHECK_HPP

#include <sivid/paving/contract/detail/cut_program.hpp>
#include <sivid/paving/contract/detail/misfit_block.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/run/experiment_run.hpp>
#include <sivid/verifier/proof/detail/certificate.hpp>
#include <sivid/verifier/proof/detail/proof_walk.hpp>
#include <sivid/verifier/proof/detail/response_audit.hpp>
#include <sivid/verifier/proof/detail/weighted_outputs.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Proves that boxes are excluded, by all experiments together: Taylor models in scalars over
/// regions around many boxes, then for each box weights of the measurements, proposed by a linear
/// program in doubles and proved by `weighted_outputs` in the arithmetic of I. What a region leaves
/// open is run again over less.
///   Neither the packs of the search nor its decisions and its splitting take part.
/// @guarantee  `proved` claims are; the others are left as they were
template <class I>
class exclusion_check {
public:
    exclusion_check(identification_problem const& problem, certificate_options options,
                    run_options how = {})
        : problem_(&problem), options_(std::move(options)), audit_(problem, options_) {
        samples_.reserve(problem.experiments.size()); // the runs keep references
        for (auto const& e : problem.experiments) {
            flows_.push_back(std::make_unique<flow>(problem.model, problem.choice, e.inputs));
            samples_.push_back(sorted(e.measurements));
            runs_.push_back(
                make_scalar_run(*flows_.back(), e, samples_.back(), e.initial, problem.prior, how));
        }
    }

    [[nodiscard]] std::size_t runs() const { return count_; }
    /// Whether the time is up.
    [[nodiscard]] bool over() const { return !limit_(); }

    /// Follows a proof from the prior on: each step is proved by its weights, or else by weights of
    /// the check's own.
    /// @param rows  of which nothing is claimed
    /// @returns  boxes that hold all of the prior that is in no row and not proved to be excluded;
    ///           once it is `over`, of rows as well
    [[nodiscard]] std::vector<box> follow(exclusion_proof const& proof,
                                          std::vector<box> const& rows) {
        proof_walk walk(problem_->prior, rows, runs_.size(), [this] { return !over(); });
        for (auto const& step : proof) {
            if (walk.done() || over()) break;
            if (step.what == proof_step::kind::run) {
                if (step.index < runs_.size()) {
                    walk.learn(step.index, run(step.index, walk.cell()));
                }
                continue;
            }
            walk.take(step, [&](response_list const& known, box const& part) {
                bool const by_weights = weights_exclude<I>(known, part, step.why);
                bool const proved = by_weights || excludes(known, part);
                by_weights_ += by_weights ? 1 : 0;
                steps_ += proved ? 1 : 0;
                return proved;
            });
        }
        return std::move(walk).open();
    }
    /// Steps of proofs that were proved, and those among them by the weights that came with them.
    [[nodiscard]] std::size_t steps() const { return steps_; }
    [[nodiscard]] std::size_t by_weights() const { return by_weights_; }

    /// Enclosures that sets of first order contradict at a point: a defect. They prove nothing.
    [[nodiscard]] std::size_t contradictions() const { return contradictions_; }

    /// Tries the claims that are open and say `outside`.
    void operator()(std::vector<box_claim>& claims) {
        settle(book_.open(claims,
                          [](box_claim const& c) { return c.what == box_claim::kind::outside; }));
    }

private:
    using piece = io_detail::claim_piece;
    using group = std::vector<piece>;

    /// More groups of measurements than this are not tried (`lp_contractor` neither).
    static constexpr std::size_t most_groups = 8;
    /// So many open pieces are cut further without a run.
    static constexpr std::size_t most_leaves = 64;
    /// A box is cut so often before it is left to others.
    static constexpr std::size_t most_cuts = 200;

    /// One experiment over a region; nothing where two integrators contradict each other.
    [[nodiscard]] std::shared_ptr<response const> run(std::size_t e, box const& region) {
        ++count_;
        auto found = (*runs_[e])(problem_->experiments[e].initial, region);
        if (audit_(*found, e, region)) return found;
        ++contradictions_;
        return nullptr;
    }

    /// One region: the experiments in turn, each over what the ones before leave open.
    void settle(group pieces) {
        std::erase_if(pieces, [this](piece const& p) { return book_.gave_up[p.claim]; });
        if (pieces.empty()) return;
        if (over()) return book_.give_up(pieces);
        auto const region = io_detail::hull_of(pieces);
        response_list known;
        for (std::size_t e = 0; e < runs_.size() && !pieces.empty(); ++e) {
            known.push_back(run(e, io_detail::hull_of(pieces)));
            group open;
            for (auto& p : pieces) {
                if (excludes(known, p.set)) {
                    book_.prove(p);
                } else {
                    open.push_back(std::move(p));
                }
            }
            pieces = std::move(open);
        }
        refine(pieces, known);
        if (pieces.empty()) return;
        auto const rest = io_detail::hull_of(pieces);
        if (relative_volume(rest, region).upper() <= 0.5) return settle(std::move(pieces));
        split(std::move(pieces), rest, known);
    }

    /// Cuts what is open as long as what is known proves parts of it: that is cheap against a run.
    void refine(group& pieces, response_list const& known) {
        while (!pieces.empty() && pieces.size() <= most_leaves && !over()) {
            group halves;
            std::vector<piece> proved;
            for (auto const& p : pieces) {
                auto const side = side_to_cut(p.set, known);
                if (!side || p.cuts >= most_cuts) {
                    halves.push_back(p);
                    continue;
                }
                auto [low, high] = bisect(p.set, *side, mid(p.set[*side]));
                for (auto* const half : {&low, &high}) {
                    piece next{std::move(*half), p.claim, p.cuts + 1};
                    (excludes(known, next.set) ? proved : halves).push_back(std::move(next));
                }
            }
            if (proved.empty()) return; // nothing was gained: the pieces stay whole
            for (auto const& p : pieces) --book_.left[p.claim];
            for (auto const& p : halves) ++book_.left[p.claim];
            for (auto const& p : proved) ++book_.left[p.claim];
            for (auto const& p : proved) book_.prove(p);
            pieces = std::move(halves);
        }
    }

    void split(group pieces, box const& region, response_list const& known) {
        if (pieces.size() == 1) {
            auto const side = side_to_cut(pieces[0].set, known);
            if (!side || ++pieces[0].cuts > most_cuts) return book_.give_up(pieces);
            auto const& p = pieces[0];
            auto [low, high] = bisect(p.set, *side, mid(p.set[*side]));
            ++book_.left[p.claim];
            group halves{{std::move(low), p.claim, p.cuts}, {std::move(high), p.claim, p.cuts}};
            // What is known of the whole may do for a half.
            std::erase_if(halves, [&](piece const& half) {
                bool const done = excludes(known, half.set);
                if (done) book_.prove(half);
                return done;
            });
            for (auto& half : halves) settle({std::move(half)});
            return;
        }
        auto const widest = io_detail::widest_side(region, problem_->prior).value_or(0);
        // Boxes that reach far across the middle are cut there: with them no region shrinks.
        double const middle = mid(region[widest]);
        group low, high;
        for (auto& p : pieces) {
            auto const& side = p.set[widest];
            bool const across = side.lower() < middle && middle < side.upper() &&
                                width(side) > 0.5 * width(region[widest]) && p.cuts < most_cuts;
            if (across) {
                auto [a, b] = bisect(p.set, widest, middle);
                ++book_.left[p.claim];
                low.push_back({std::move(a), p.claim, p.cuts + 1});
                high.push_back({std::move(b), p.claim, p.cuts + 1});
            } else {
                (mid(side) <= middle ? low : high).push_back(std::move(p));
            }
        }
        if (low.empty() || high.empty()) { // all of them on one side: one by one
            auto& all = low.empty() ? high : low;
            auto const half = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
            auto& none = low.empty() ? low : high;
            none.assign(std::make_move_iterator(half), std::make_move_iterator(all.end()));
            all.erase(half, all.end());
        }
        settle(std::move(low));
        settle(std::move(high));
    }

    /// The side along which the outputs spread most, against their bounds.
    [[nodiscard]] std::optional<std::size_t> side_to_cut(box const& x,
                                                         response_list const& known) const {
        std::vector<double> spread(x.size(), 0.0);
        for (auto const& r : known) {
            if (!r) continue;
            auto const local = expand(*r, x);
            for (std::size_t j = 0; j < x.size(); ++j) {
                auto const& side = r->unknowns.parameters[j];
                if (side.radius == 0) continue;
                for (std::size_t y = 0; y < r->outputs(); ++y) {
                    double const slope = std::abs(local.slope[side.variable * r->outputs() + y]) /
                                         std::max(width(r->bounds[y]), 1e-300);
                    if (std::isfinite(slope)) spread[j] = std::max(spread[j], slope);
                }
            }
        }
        std::optional<std::size_t> best;
        for (std::size_t j = 0; j < x.size(); ++j) {
            double const middle = mid(x[j]);
            if (!(x[j].lower() < middle && middle < x[j].upper())) continue;
            double const own = width(x[j]) / width(problem_->prior[j]);
            double const rank = spread[j] + 1e-3 * own;
            if (!best || rank > spread[*best]) {
                best = j;
                spread[j] = rank;
            }
        }
        return best;
    }

    /// Whether no parameter of the part explains the experiments.
    [[nodiscard]] bool excludes(response_list const& known, box const& part) const {
        std::vector<minimax_block> blocks;
        std::vector<std::vector<double>> scales;
        std::vector<std::size_t> allowance;
        std::size_t unknowns = part.size(), allowed = 0;
        for (std::size_t e = 0; e < known.size(); ++e) {
            if (!known[e]) { // nothing is known of it
                blocks.emplace_back();
                scales.emplace_back();
                allowance.push_back(0);
                continue;
            }
            auto const& r = *known[e];
            auto const local = expand(r, part);
            std::vector<combined_polynomial::place> places(r.table->variables);
            for (std::size_t j = 0; j < part.size(); ++j) {
                auto const& side = r.unknowns.parameters[j];
                if (side.radius > 0) places[side.variable].unknown = j;
            }
            for (auto const& side : r.unknowns.initial) {
                if (side.radius > 0) places[side.variable].unknown = unknowns++;
            }
            std::size_t missed = 0;
            auto misfits = misfits_of(r, local, places, 1, [&](std::size_t y) {
                double spread = local.rest[y];
                for (std::size_t v = 0; v < places.size(); ++v) {
                    spread += std::abs(local.slope[v * r.outputs() + y]);
                }
                double const half = 0.5 * width(r.bounds[y]);
                double const off = local.value[y] - mid(r.bounds[y]);
                bool const proved =
                    missed <= r.allowed && std::abs(off) > spread + half &&
                    weighted_outputs<I>(known, part, {{e, y, off > 0 ? 1.0 : -1.0}}).positive();
                missed += proved ? 1 : 0;
                return std::abs(off) + spread > half && !(proved && r.allowed > 0);
            });
            if (missed > r.allowed) return true;
            allowance.push_back(r.allowed - missed);
            allowed += allowance.back();
            blocks.push_back(std::move(misfits.functions));
            scales.push_back(std::move(misfits.scale));
        }
        if (allowed >= most_groups) {
            for (std::size_t e = 0; e < known.size(); ++e) {
                if (allowance[e] > 0) blocks[e] = {};
            }
            allowed = 0;
        }
        // With so many outliers left, one of so many groups and one more holds none.
        for (std::size_t k = 0; k <= allowed; ++k) {
            auto const cut = cut_program(unknowns, blocks)(0, true);
            if (!cut.empty || cut.weights.empty()) return false;
            std::vector<measurement_weight> weights;
            for (auto const& w : cut.weights) {
                weights.push_back({w.block, w.function, w.value * scales[w.block][w.function]});
                if (allowance[w.block] > 0) {
                    blocks[w.block].margin[w.function] = std::numeric_limits<double>::infinity();
                }
            }
            if (!weighted_outputs<I>(known, part, weights).positive()) return false;
        }
        return true;
    }

    identification_problem const* problem_;
    certificate_options options_;
    response_audit<I> audit_;
    std::vector<std::unique_ptr<flow>> flows_;
    std::vector<record> samples_;
    std::vector<std::unique_ptr<experiment_run>> runs_;
    io_detail::claim_book book_;
    std::size_t count_ = 0, contradictions_ = 0, steps_ = 0, by_weights_ = 0;
    work_limit limit_{options_.seconds, options_.keep_going};
};

} // namespace sivid

#endif
