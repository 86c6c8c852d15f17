// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_PROOF_DETAIL_PLAIN_PROOF_HPP
#define SIVID_VERIFIER_PROOF_DETAIL_PLAIN_PROOF_HPP

#include <sivid/approximate/approximate_fit.hpp>
#include <sivid/paving/contract/detail/start_rule.hpp>
#include <sivid/paving/run/plain_run.hpp>
#include <sivid/space/box_cover.hpp>
#include <sivid/verifier/check_finding.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

/// Starts that follow the parameters of a part by an affine rule, found and proved by the affine
/// forms of a plain run. What `explaining_starts` is for polynomials; it shares only the guess.
/// @tparam I  the interval type of the run
template <class I>
class plain_start_rule {
    using traits = interval_traits<I>;

public:
    /// @param starts  that the run was made over
    /// @param part    a subset of the region that it was made over
    plain_start_rule(plain_outputs<I> const& known, record const& samples, box const& starts,
                     box const& part)
        : plain_start_rule(known, samples, starts, part, starts) {}

    /// @param choice  rules are looked for among these starts; where they are not among those of
    ///   the run its forms extrapolate, which may guide but proves nothing
    plain_start_rule(plain_outputs<I> const& known, record const& samples, box const& starts,
                     box const& part, box const& choice)
        : known_(&known), samples_(&samples), starts_(&starts) {
        auto const& d = known.deviation;
        for (std::size_t c = 0; c < starts.size(); ++c) {
            if (is_decimal(choice[c])) {
                fixed_.push_back({c, 0, 0, d[c]});
                continue;
            }
            I const own = traits::sub(traits::bounds(choice[c].lower(), choice[c].upper()),
                                      centre_of(starts[c]));
            double const middle = traits::mid(own);
            double const reach = traits::mag(traits::sub(own, traits::point(middle)));
            free_.push_back({c, middle, reach, d[c]});
        }
        for (std::size_t j = 0; j < part.size(); ++j) {
            auto const c = starts.size() + j;
            I const own = traits::intersect(
                d[c], traits::sub(traits::bounds(part[j].lower(), part[j].upper()),
                                  traits::point(known.parameter_centre[j])));
            double const middle = traits::mid(own);
            double const reach = traits::mag(traits::sub(own, traits::point(middle)));
            parameters_.push_back({c, middle, reach, own});
        }
    }

    /// A decimal's enclosure: not a start to choose.
    [[nodiscard]] static bool is_decimal(interval const& x) { return rad(x) <= 1e-13 * mag(x); }

    /// A rule that should explain all but q measurements, if there seems to be one.
    /// @param by_rests  counts what is not affine; else only its middle
    /// @param bounds    half-widths of measurements by which outputs may be off, 1 to explain them
    [[nodiscard]] std::optional<start_rule> search(std::size_t q, bool by_rests,
                                                   double bounds = 1) const {
        if (free_.empty() || known_->outputs.size() + q < samples_->size()) return std::nullopt;
        auto const n = known_->outputs.size();
        misfit_forms f;
        f.parameters = parameters_.size();
        f.starts = free_.size();
        f.by_parameter.assign(f.parameters * n, 0.0);
        f.by_start.assign(f.starts * n, 0.0);
        for (std::size_t k = 0; k < n; ++k) {
            auto const& o = known_->outputs[k];
            auto const& bound = (*samples_)[k].bound;
            double const e = std::max(rad(bound), std::numeric_limits<double>::min());
            double offset = traits::mid(o.rest) - mid(bound);
            for (std::size_t j = 0; j < f.parameters; ++j) {
                double const g = o.gradient[parameters_[j].column];
                f.by_parameter[j * n + k] = g * parameters_[j].reach / e;
                offset += g * parameters_[j].middle;
            }
            for (std::size_t i = 0; i < f.starts; ++i) {
                double const g = o.gradient[free_[i].column];
                f.by_start[i * n + k] = g * free_[i].reach / e;
                offset += g * free_[i].middle;
            }
            double const lost = by_rests ? 0.5 * traits::width(o.rest) / e : 0;
            bool const usable = o.defined && std::isfinite(offset) && std::isfinite(lost);
            f.offset.push_back(usable ? offset / e : 0);
            f.margin.push_back(usable ? std::max(bounds - lost, -1e9) : -1e9);
        }
        return start_rule_search()(f, q);
    }

    /// @guarantee  true: for every parameter of the part the rule's start lies in the run's starts,
    ///   and with it all but q measurements hold
    [[nodiscard]] bool proves(start_rule const& rule, std::size_t q) const {
        for (std::size_t i = 0; i < free_.size(); ++i) {
            if (!stays(i, rule)) return false;
        }
        std::size_t held = 0;
        for (std::size_t k = 0; k < known_->outputs.size(); ++k) {
            auto const& o = known_->outputs[k];
            auto const& bound = (*samples_)[k].bound;
            if (o.defined && lies_in(value(o, rule), bound)) ++held;
        }
        return held + q >= samples_->size();
    }

    /// The starts of the rule for the middle of the part; others as in the middle of the run's.
    [[nodiscard]] std::vector<double> middle(start_rule const& rule) const {
        auto result = mid(*starts_);
        for (std::size_t i = 0; i < free_.size(); ++i) {
            result[free_[i].column] += free_[i].middle + free_[i].reach * rule.middle[i];
        }
        return result;
    }

    /// A box of starts around those of the rule, off the bounds of `initial`.
    [[nodiscard]] box around(start_rule const& rule, box const& initial) const {
        auto result = initial;
        auto const at = middle(rule);
        for (std::size_t i = 0; i < free_.size(); ++i) {
            auto const& own = free_[i];
            double const middle = at[own.column];
            // Wider, so that rules for other linearisations lie within, too.
            double const reach =
                1.5 * own.reach * reach_of(rule, i) + 0x1p-10 * rad(initial[own.column]);
            auto& side = result[own.column];
            double const off = 0x1p-40 * rad(side);
            side = interval_traits<interval>::intersect(
                interval_traits<interval>::bounds(middle - reach, middle + reach),
                interval_traits<interval>::bounds(std::nextafter(side.lower() + off, HUGE_VAL),
                                                  std::nextafter(side.upper() - off, -HUGE_VAL)));
        }
        return result;
    }

private:
    /// An unknown as middle + reach * [-1, 1] about the centre of the run.
    struct unknown {
        std::size_t column = 0;
        double middle = 0, reach = 0;
        I range;
    };

    /// Where a run puts the centre of a side of its starts.
    [[nodiscard]] static I centre_of(interval const& side) {
        return traits::point(traits::mid(traits::bounds(side.lower(), side.upper())));
    }

    /// Sum of the sizes of a start's slopes, about.
    [[nodiscard]] double reach_of(start_rule const& rule, std::size_t i) const {
        double sum = 0;
        for (std::size_t j = 0; j < parameters_.size(); ++j) {
            sum += std::abs(rule.slope[i * parameters_.size() + j]);
        }
        return sum;
    }

    /// Whether a start of the rule stays in its side of the run's starts.
    [[nodiscard]] bool stays(std::size_t i, start_rule const& rule) const {
        auto const n = parameters_.size();
        I s = traits::point(rule.middle[i]);
        for (std::size_t j = 0; j < n; ++j) {
            double const size = std::abs(rule.slope[i * n + j]);
            s = traits::add(s, traits::bounds(-size, size));
        }
        I const moved = traits::add(traits::point(free_[i].middle),
                                    traits::mul(traits::point(free_[i].reach), s));
        auto const& side = (*starts_)[free_[i].column];
        I const centre = centre_of(side);
        I const below = traits::sub(traits::point(side.lower()), centre);
        I const above = traits::sub(traits::point(side.upper()), centre);
        return traits::upper(below) <= traits::lower(moved) &&
               traits::upper(moved) <= traits::lower(above);
    }

    /// Encloses an output over the part when the starts follow the rule.
    [[nodiscard]] I value(observation<I> const& o, start_rule const& rule) const {
        I y = o.rest;
        auto const slope = [&o](std::size_t c) { return traits::point(o.gradient[c]); };
        for (auto const& u : fixed_) {
            if (o.gradient[u.column] != 0)
                y = traits::add(y, traits::mul(slope(u.column), u.range));
        }
        std::vector<I> by_start;
        for (std::size_t i = 0; i < free_.size(); ++i) {
            auto const& own = free_[i];
            by_start.push_back(traits::mul(slope(own.column), traits::point(own.reach)));
            y = traits::add(y, traits::mul(by_start[i], traits::point(rule.middle[i])));
            y = traits::add(y, traits::mul(slope(own.column), traits::point(own.middle)));
        }
        for (std::size_t j = 0; j < parameters_.size(); ++j) {
            auto const& p = parameters_[j];
            y = traits::add(y, traits::mul(slope(p.column), traits::point(p.middle)));
            I change = traits::mul(slope(p.column), traits::point(p.reach));
            for (std::size_t i = 0; i < free_.size(); ++i) {
                auto const k = traits::point(rule.slope[i * parameters_.size() + j]);
                change = traits::add(change, traits::mul(by_start[i], k));
            }
            y = traits::add(y, traits::mul(change, traits::bounds(-1.0, 1.0)));
        }
        return y;
    }

    plain_outputs<I> const* known_;
    record const* samples_;
    box const* starts_;
    std::vector<unknown> free_, fixed_, parameters_;
};

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
        /// For starts near a rule that seems to explain the region, and the recorded inputs; empty
        /// where there is none or none is needed.
        std::vector<plain_outputs<I>> guided;
        std::vector<box> guide; ///< those starts
        bool refuted = false;   ///< the whole region is
    };

    [[nodiscard]] std::size_t runs() const { return count_; }

    /// Runs experiments over the region until one refutes it.
    /// @param seek  look for starts that explain the region
    /// @cost  one validated run per experiment, two where starts are chosen, up to `shots` and one
    ///   more where they are sought
    [[nodiscard]] knowledge learn(box const& region, bool seek = true) {
        knowledge known;
        for (std::size_t e = 0; e < runs_.size() && !known.refuted; ++e) {
            auto const& own = problem_->experiments[e];
            ++count_;
            known.all.push_back((*runs_[e])(own.initial, region));
            known.chosen.emplace_back();
            known.guided.emplace_back();
            known.guide.emplace_back();
            auto const says = decide(known.all[e], runs_[e]->samples(), region, own.outliers);
            known.refuted = says == run_finding::refuted;
            if (known.refuted) continue;
            bool explained = says == run_finding::explained;
            auto& exactly = *(recorded_[e] ? recorded_[e] : runs_[e]);
            if (has_chosen(e)) {
                ++count_;
                auto const& starts = e < starts_.size() ? starts_[e] : own.initial;
                known.chosen[e] = exactly(starts, region);
                explained = explained || decide(known.chosen[e], runs_[e]->samples(), region,
                                                own.outliers) == run_finding::explained;
            }
            if (!seek || explained || !has_choice(own.initial)) continue;
            auto starts = shoot(e, exactly, region);
            if (!starts) continue;
            ++count_;
            known.guided[e] = exactly(*starts, region);
            known.guide[e] = std::move(*starts);
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
                                                     run_finding::explained) ||
                               is_guided(known, e, part);
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
    /// Linearisations by which starts are sought, and how far the last may move a start, in
    /// half-widths of its box.
    static constexpr int shots = 6;
    static constexpr double close = 1.0 / 64;
    /// Reach of the starts in a shot, in half-widths of their boxes.
    static constexpr double near = 0x1p-20;

    [[nodiscard]] static bool has_choice(box const& initial) {
        return std::any_of(initial.begin(), initial.end(), [](interval const& side) {
            return !plain_start_rule<I>::is_decimal(side);
        });
    }

    /// Starts around a rule that seems to explain the region, by shooting: all starts of a long
    /// experiment are too many for sets of first order, so the outputs are linearised about single
    /// starts, each about the one that is best by the last linearisation. A guess: what is returned
    /// is for a run to judge.
    [[nodiscard]] std::optional<box> shoot(std::size_t e, plain_run<I>& exactly,
                                           box const& region) {
        auto const& own = problem_->experiments[e];
        aims_.resize(runs_.size());
        auto& aim = aims_[e];
        if (aim.empty()) aim = mid(e < starts_.size() ? starts_[e] : own.initial);
        std::optional<box> result;
        for (int shot = 0; shot < shots; ++shot) {
            auto at = own.initial;
            for (std::size_t i = 0; i < at.size(); ++i) {
                if (plain_start_rule<I>::is_decimal(at[i])) continue;
                double const reach = near * rad(at[i]);
                at[i] = intersect(at[i], interval(aim[i] - reach, aim[i] + reach));
            }
            if (is_empty(at)) break;
            ++count_;
            auto const known = exactly(at, region);
            plain_start_rule<I> const forms(known, exactly.samples(), at, region, own.initial);
            auto rule = forms.search(own.outliers, false);
            bool const explains = rule.has_value();
            for (double bounds = 4; !rule && bounds < 1e4; bounds *= 4) {
                rule = forms.search(own.outliers, false, bounds); // the best that there is
            }
            result.reset();
            if (!rule) break;
            auto const next = forms.middle(*rule);
            double moved = 0;
            for (std::size_t i = 0; i < at.size(); ++i) {
                if (plain_start_rule<I>::is_decimal(at[i])) continue;
                moved = std::max(moved, std::abs(next[i] - aim[i]) / rad(own.initial[i]));
            }
            if (explains) result = forms.around(*rule, own.initial);
            aim = next;
            if (moved <= close) break;
        }
        if (result && is_empty(*result)) result.reset();
        if (!result) aim.clear();
        return result;
    }

    /// Whether starts near those that seemed to explain the region do explain the part.
    [[nodiscard]] bool is_guided(knowledge const& known, std::size_t e, box const& part) const {
        if (known.guide[e].size() == 0) return false;
        auto const q = problem_->experiments[e].outliers;
        plain_start_rule<I> const starts(known.guided[e], runs_[e]->samples(), known.guide[e],
                                         part);
        auto const rule = starts.search(q, true);
        return rule && starts.proves(*rule, q);
    }
    [[nodiscard]] bool has_chosen(std::size_t e) const {
        return recorded_[e] ||
               (e < starts_.size() && !subset(problem_->experiments[e].initial, starts_[e]));
    }

    identification_problem const* problem_;
    std::vector<box> starts_;
    std::vector<std::vector<double>> aims_; ///< where the last search for starts ended
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

/// A part of a claim's box.
struct claim_piece {
    box set;
    std::size_t claim;
    std::size_t cuts = 0; ///< of the claim's box that led to it
};

[[nodiscard]] inline box hull_of(std::vector<claim_piece> const& pieces) {
    auto region = pieces[0].set;
    for (auto const& p : pieces) region = hull(region, p.set);
    return region;
}

/// What is left to prove of claims.
struct claim_book {
    std::vector<box_claim>* claims = nullptr;
    std::vector<std::size_t> left; ///< pieces to prove, by claim
    std::vector<bool> gave_up;

    /// @param wanted  of claims that are open. @returns their boxes
    template <class Wanted>
    std::vector<claim_piece> open(std::vector<box_claim>& all, Wanted const& wanted) {
        claims = &all;
        left.assign(all.size(), 0);
        gave_up.assign(all.size(), false);
        std::vector<claim_piece> pieces;
        for (std::size_t k = 0; k < all.size(); ++k) {
            if (all[k].found != box_claim::status::open || !wanted(all[k])) continue;
            left[k] = 1;
            pieces.push_back({all[k].set, k});
        }
        return pieces;
    }
    [[nodiscard]] box_claim& of(claim_piece const& p) const { return (*claims)[p.claim]; }
    void prove(claim_piece const& p) {
        if (--left[p.claim] == 0 && !gave_up[p.claim]) of(p).found = box_claim::status::proved;
    }
    void give_up(std::vector<claim_piece> const& pieces) {
        for (auto const& p : pieces) gave_up[p.claim] = true;
    }

    /// A box is cut so often before it is left to others.
    static constexpr std::size_t most_cuts = 200;

    /// Parts a group at the middle of a side of its hull. Pieces that reach far across it are cut
    /// there: with them no region shrinks. A piece alone is cut, unless it was `most_cuts` times.
    [[nodiscard]] std::pair<std::vector<claim_piece>, std::vector<claim_piece>>
    halves(std::vector<claim_piece> pieces, box const& region, std::size_t side) {
        double const middle = mid(region[side]);
        std::vector<claim_piece> low, high;
        for (auto& p : pieces) {
            auto const& own = p.set[side];
            bool const across = own.lower() < middle && middle < own.upper() &&
                                width(own) > 0.5 * width(region[side]) && p.cuts < most_cuts;
            if (across) {
                auto [a, b] = bisect(p.set, side, middle);
                ++left[p.claim];
                low.push_back({std::move(a), p.claim, p.cuts + 1});
                high.push_back({std::move(b), p.claim, p.cuts + 1});
            } else {
                (mid(own) <= middle ? low : high).push_back(std::move(p));
            }
        }
        if (low.empty()) std::swap(low, high);
        if (high.empty()) { // all of them on one side: one by one
            auto const half = low.begin() + static_cast<std::ptrdiff_t>((low.size() + 1) / 2);
            high.assign(std::make_move_iterator(half), std::make_move_iterator(low.end()));
            low.erase(half, low.end());
        }
        return {std::move(low), std::move(high)};
    }
};

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

/// Proves or refutes claims about boxes by plain runs, in subdivisions of its own.
///   Claims are run together while they lie close; what the run leaves open is split: the group
///   about its median, a single box where its outputs spread most.
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
        spent_.assign(claims.size(), 0);
        settle(book_.open(claims, [](box_claim const&) { return true; }));
    }

private:
    using status = box_claim::status;
    using piece = io_detail::claim_piece;
    using group = std::vector<piece>;
    using knowledge = typename proved_campaign<I>::knowledge;

    [[nodiscard]] bool is_inside(piece const& p) const {
        return book_.of(p).what == box_claim::kind::inside;
    }
    [[nodiscard]] bool over() const { return !limit_(); }
    void refute(piece const& p, std::vector<double> at) {
        book_.of(p).found = status::refuted;
        book_.of(p).counterexample = std::move(at);
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

    /// The side along which the outputs of the piece spread most, if it can be cut.
    [[nodiscard]] std::optional<std::size_t> side_to_cut(box const& x,
                                                         knowledge const* known) const {
        return io_detail::side_to_cut(x, [&](std::size_t j) {
            return known != nullptr ? campaign_.spread(*known, x, j)
                                    : (x[j].upper() - x[j].lower()) / width(prior_[j]);
        });
    }

    void settle(group pieces) {
        std::erase_if(pieces, [this](piece const& p) {
            return book_.of(p).found == status::refuted || book_.gave_up[p.claim];
        });
        if (pieces.empty()) return;
        if (over()) return book_.give_up(pieces);
        auto const region = io_detail::hull_of(pieces);
        bool wide = false;
        for (std::size_t j = 0; j < region.size(); ++j) {
            wide = wide || (!is_one_number(prior_[j]) &&
                            width(region[j]) > options_.widest_region * width(prior_[j]));
        }
        if (wide && split(pieces, region, nullptr)) return;
        bool const seek = std::any_of(pieces.begin(), pieces.end(),
                                      [this](piece const& p) { return is_inside(p); });
        auto const known = campaign_.learn(region, seek);
        group rest;
        for (auto& p : pieces) {
            auto const says = campaign_.judge(known, p.set);
            auto const right = is_inside(p) ? run_finding::explained : run_finding::refuted;
            if (says == right) {
                book_.prove(p);
            } else if (says != run_finding::open) {
                refute(p, mid(p.set));
            } else {
                rest.push_back(std::move(p));
            }
        }
        if (rest.size() == 1 && pieces.size() > 1) { // a region of its own says more
            settle(std::move(rest));
            return;
        }
        for (auto const& p : rest) probe(p, known);
        if (rest.size() == 1 && ++spent_[rest[0].claim] >= options_.runs_per_claim) {
            return book_.give_up(rest);
        }
        if (!rest.empty() && !split(rest, region, &known)) book_.give_up(rest);
    }

    /// @returns false where that is not possible
    bool split(group& pieces, box const& region, knowledge const* known) {
        bool const alone = pieces.size() == 1;
        auto const side =
            alone ? side_to_cut(region, known) : io_detail::widest_side(region, prior_);
        if (alone && (!side || pieces[0].cuts >= io_detail::claim_book::most_cuts)) return false;
        auto [low, high] = book_.halves(std::move(pieces), region, side.value_or(0));
        settle(std::move(low));
        settle(std::move(high));
        return true;
    }

    box prior_;
    proved_campaign<I> campaign_;
    certificate_options options_;
    io_detail::claim_book book_;
    std::vector<std::size_t> spent_; ///< single runs, by claim
    work_limit limit_{0};
};

namespace io_detail {

/// What validated runs prove of the parameters that a fit ended at.
/// @param at_its_starts  explained for the fitted starts; else refuted for all starts
template <class I>
[[nodiscard]] run_finding judge_point(identification_problem const& problem,
                                      approximate_fit const& f, bool at_its_starts) {
    std::vector<box> starts;
    for (std::size_t e = 0; e < f.starts.size() && at_its_starts; ++e) {
        starts.push_back(point_within(problem.experiments[e].initial, f.starts[e]));
    }
    enclosure_options const fine{
        .order = 14, .tolerance = 1e-11, .relative_tolerance = 1e-3, .minimum_step = 1e-7};
    proved_campaign<I> campaign(problem, std::move(starts), fine);
    auto const p = point_box(f.parameters);
    return campaign.judge(campaign.learn(p, false), p);
}

} // namespace io_detail

} // namespace sivid

#endif
