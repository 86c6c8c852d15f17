// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_RANKING_DETAIL_EFFECT_COVER_HPP
#define SIVID_DECISION_RANKING_DETAIL_EFFECT_COVER_HPP

#include <sivid/model/problem.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace sivid::decision_detail {

/// The measurements of one channel in one experiment.
struct ranked_channel {
    std::size_t experiment = 0, channel = 0;
    std::vector<std::size_t> samples; ///< that count, in the order of time
    std::size_t all = 0;
    std::size_t exact = 0; ///< with a bound of width 0
};

/// A prior in parts, with bounds of what each parameter moves in each.
///   Within a part only the terms of an output's polynomial that contain p_j change with it. On a
/// line along p_j two motions differ by what is moved in the two end parts and by the steps from
/// end to end of the parts between, which have signs. One tree of parts serves all parameters: the
/// lines that meet the same parts are found by cutting the box of the other parameters where a part
/// is cut.
class effect_cover {
public:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr std::size_t none = ~std::size_t{0};

    struct part {
        box set;
        response_list known; ///< of a box around it
        /// [parameter * samples + sample], in error bounds: the most that is moved, and the step
        /// from the lower end of p_j to the upper one, up to `blur`.
        std::vector<double> moves, step, blur;
        std::size_t side = none; ///< along which it was split; its halves
        double cut = 0;
        std::size_t halves[2] = {none, none};
    };
    /// The lines along a parameter on which a channel may move most, with the parts on them.
    struct line {
        double bound = -1;
        std::size_t sample = 0;
        std::vector<std::size_t> parts;
        box others;                      ///< where the other parameters are
        std::size_t first = 0, last = 0; ///< of the parts: those from and to which it moves most
    };
    struct advice {
        std::size_t side = none;
        double slack = 0; ///< how much of the bound may not be reached
        bool stale = false;
    };

    /// @param acts  [parameter][channel]
    effect_cover(identification_problem const& problem, feasibility_test& test,
                 std::vector<std::vector<bool>> acts)
        : problem_(&problem), test_(&test), acts_(std::move(acts)) {
        for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
            first_.push_back(scale_.size());
            std::map<std::size_t, ranked_channel> found;
            auto const& samples = test.record_of(e);
            for (std::size_t k = 0; k < samples.size(); ++k) {
                double const w = rad(samples[k].bound);
                bool const counts = w > 0 && std::isfinite(w);
                scale_.push_back(counts ? 1 / w : 0);
                channel_.push_back(samples[k].channel);
                auto& own = found[samples[k].channel];
                own.experiment = e;
                own.channel = samples[k].channel;
                ++own.all;
                own.exact += w == 0 ? 1 : 0;
                if (counts) own.samples.push_back(first_.back() + k);
            }
            for (auto& [c, own] : found) channels_.push_back(std::move(own));
        }
        first_.push_back(scale_.size());
        parts_.emplace_back();
        parts_[0].set = problem.prior;
        parts_[0].known.resize(problem.experiments.size());
        std::vector<bool> const all(problem.experiments.size(), true);
        integrate({{0, all}});
        bound(parts_[0], nullptr);
    }

    [[nodiscard]] std::vector<ranked_channel> const& channels() const { return channels_; }
    [[nodiscard]] bool acts(std::size_t j, std::size_t channel) const { return acts_[j][channel]; }
    [[nodiscard]] std::size_t parts() const { return (parts_.size() + 1) / 2; }
    [[nodiscard]] part const& at(std::size_t k) const { return parts_[k]; }
    /// The measurement that a sample is, in its experiment.
    [[nodiscard]] std::size_t place_of(std::size_t sample) const {
        return sample - first_[experiment_of(sample)];
    }
    /// 1 over the error bound; 0 for what does not count.
    [[nodiscard]] double scale(std::size_t sample) const { return scale_[sample]; }

    /// For each wanted channel the lines along p_j with the greatest bound.
    [[nodiscard]] std::vector<line> worst_lines(std::size_t j,
                                                std::vector<bool> const& wanted) const {
        std::vector<line> best(channels_.size());
        visit(j, {0}, problem_->prior, wanted, best);
        return best;
    }

    /// What would sharpen the bound of a part for a parameter and a sample; where this was not
    /// reached, for the last one that was.
    /// @param between  of the part only its step from end to end matters
    [[nodiscard]] advice advise(std::size_t k, std::size_t j, std::size_t sample,
                                bool between) const {
        auto const& p = parts_[k];
        auto const& r = *p.known[experiment_of(sample)];
        auto const outputs = r.outputs();
        bool const reached = place_of(sample) < outputs;
        std::vector<double> score(r.table->variables, 0.0);
        double slack = 0, lost = 0;
        if (outputs > 0) {
            auto const y = std::min(place_of(sample), outputs - 1);
            unknowns_of_part const here(r, p.set);
            auto const [c, rounding] = shifted(r, here.middle);
            lost = 2 * (r.radius[y] + rounding[y]);
            auto const own = variable(r, j);
            std::vector<double> top(score.size(), 0.0);
            double all = 0;
            for (std::size_t m = 1; m < r.table->size(); ++m) {
                auto const& x = r.table->exponents[m];
                auto const degree = std::accumulate(x.begin(), x.end(), std::size_t{0});
                double const size = std::abs(c[m * outputs + y]) * product(x, here.reach);
                auto const mine = own == none ? std::size_t{0} : x[own];
                bool const counts =
                    between ? mine % 2 == 1 && degree > mine : mine > 0 && degree > 1;
                double const mixed = counts ? 2 * size : 0;
                double const last = degree == r.table->degree ? size : 0;
                slack += mixed;
                for (std::size_t v = 0; v < x.size(); ++v) {
                    if (x[v] == 0) continue;
                    score[v] += mixed;
                    top[v] += last;
                    all += last;
                }
            }
            // What is lost is about like the terms of the highest degree.
            for (std::size_t v = 0; v < score.size() && all > 0; ++v)
                score[v] += lost * top[v] / all;
            slack += lost;
        }
        advice result{none, reached ? slack : infinity, !reached || lost > 0.2 * slack};
        double most = -1;
        for (std::size_t i = 0; i < p.set.size(); ++i) {
            double const share = width(p.set[i]) / width(problem_->prior[i]);
            auto const v = variable(r, i);
            double const value = (v == none ? 0 : score[v]) + 1e-9 * share;
            if (!(share > 1e-9) || !(value > most)) continue;
            most = value;
            result.side = i;
        }
        return result;
    }

    /// Halves parts, each along a side, and integrates the marked experiments anew over the halves.
    struct plan {
        std::size_t side = 0;
        std::vector<bool> stale; ///< per experiment
    };
    void split(std::map<std::size_t, plan> const& plans) {
        std::vector<std::pair<std::size_t, std::vector<bool>>> blind;
        std::vector<std::pair<std::size_t, std::size_t>> made;
        for (auto const& [k, how] : plans) {
            double const cut = mid(parts_[k].set[how.side]);
            auto const sets = bisect(parts_[k].set, how.side, cut);
            parts_[k].side = how.side;
            parts_[k].cut = cut;
            for (std::size_t h = 0; h < 2; ++h) {
                part half;
                half.set = h == 0 ? sets.first : sets.second;
                half.known = parts_[k].known;
                parts_[k].halves[h] = parts_.size();
                made.emplace_back(parts_.size(), k);
                blind.emplace_back(parts_.size(), how.stale);
                parts_.push_back(std::move(half));
            }
        }
        integrate(blind);
        for (auto const& [k, of] : made) bound(parts_[k], &parts_[of]);
    }

    /// About the value of a sample, at a start and parameters in a part; nothing where it was not
    /// reached.
    [[nodiscard]] std::optional<double> guess(std::size_t k, std::size_t sample,
                                              std::vector<double> const& start,
                                              std::vector<double> const& p) const {
        auto const& r = *parts_[k].known[experiment_of(sample)];
        auto const y = place_of(sample);
        if (y >= r.outputs()) return std::nullopt;
        std::vector<double> q(r.table->variables, 0.0);
        auto const put = [&q](auto const& sides, std::vector<double> const& x) {
            for (std::size_t i = 0; i < x.size(); ++i) {
                auto const& s = sides[i];
                if (s.radius > 0) q[s.variable] = (x[i] - s.centre) / s.radius;
            }
        };
        put(r.unknowns.initial, start);
        put(r.unknowns.parameters, p);
        double value = 0;
        for (std::size_t m = 0; m < r.table->size(); ++m)
            value += r.coefficients[m * r.outputs() + y] * product(r.table->exponents[m], q);
        return value;
    }

private:
    [[nodiscard]] std::size_t experiment_of(std::size_t sample) const {
        auto const next = std::upper_bound(first_.begin(), first_.end(), sample);
        return static_cast<std::size_t>(next - first_.begin()) - 1;
    }
    [[nodiscard]] static std::size_t variable(response const& r, std::size_t j) {
        auto const& side = r.unknowns.parameters[j];
        return side.radius > 0 ? side.variable : none;
    }
    [[nodiscard]] static double product(std::vector<std::uint8_t> const& x,
                                        std::vector<double> const& q) {
        double result = 1;
        for (std::size_t v = 0; v < x.size(); ++v) {
            for (std::size_t k = 0; k < x[v]; ++k) result *= q[v];
        }
        return result;
    }

    void integrate(std::vector<std::pair<std::size_t, std::vector<bool>>> const& blind) {
        for (std::size_t e = 0; e + 1 < first_.size(); ++e) {
            std::vector<box> sets;
            std::vector<std::size_t> whose;
            for (auto const& [k, stale] : blind) {
                if (!stale[e]) continue;
                sets.push_back(parts_[k].set);
                whose.push_back(k);
            }
            if (sets.empty()) continue;
            auto const answers = test_->run(e, problem_->experiments[e].initial, sets);
            for (std::size_t n = 0; n < whose.size(); ++n) {
                auto& p = parts_[whose[n]];
                // A run that was ended early may know less than what was known around it.
                if (p.known[e] && answers[n]->outputs() < p.known[e]->outputs()) continue;
                p.known[e] = answers[n];
            }
        }
    }

    /// Bounds of a part: by its responses, and what holds for the part that it was split from.
    void bound(part& p, part const* around) const {
        auto const samples = scale_.size(), n = p.set.size();
        p.moves.assign(n * samples, infinity);
        p.step.assign(n * samples, 0.0);
        p.blur.assign(n * samples, infinity);
        for (std::size_t e = 0; e + 1 < first_.size(); ++e) {
            auto const& r = *p.known[e];
            unknowns_of_part const here(r, p.set);
            auto const [c, rounding] = shifted(r, here.middle);
            for (std::size_t j = 0; j < n; ++j) {
                auto const at = j * samples + first_[e];
                bound(r, c, rounding, here.reach, variable(r, j), p.moves.data() + at,
                      p.step.data() + at, p.blur.data() + at);
            }
        }
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t s = 0; s < samples; ++s) {
                auto const at = j * samples + s;
                double const w = scale_[s];
                p.moves[at] = p.moves[at] * w * (1 + 1e-12);
                p.step[at] *= w;
                p.blur[at] = (p.blur[at] * w + 1e-15 * std::abs(p.step[at])) * (1 + 1e-12);
                if (around != nullptr) p.moves[at] = std::min(p.moves[at], around->moves[at]);
                if (!acts_[j][channel_[s]]) p.moves[at] = p.step[at] = p.blur[at] = 0;
                if (!(p.moves[at] >= 0)) p.moves[at] = infinity;
            }
        }
    }
    /// Of one experiment and one parameter, whose variable is v.
    static void bound(response const& r, std::vector<double> const& c,
                      std::vector<double> const& rounding, std::vector<double> const& reach,
                      std::size_t v, double* moves, double* step, double* blur) {
        auto const outputs = r.outputs();
        for (std::size_t y = 0; y < outputs; ++y) {
            moves[y] = blur[y] = 2 * (r.radius[y] + rounding[y]) + 1e-290;
        }
        for (std::size_t m = 1; m < r.table->size() && v != none; ++m) {
            auto const& x = r.table->exponents[m];
            if (x[v] == 0) continue;
            double const f = product(x, reach);
            bool const even = x[v] % 2 == 0; // d^k then lies in [0, 1]
            bool const alone = std::accumulate(x.begin(), x.end(), std::size_t{0}) == x[v];
            auto const* row = c.data() + m * outputs;
            for (std::size_t y = 0; y < outputs; ++y) {
                moves[y] += (even ? f : 2 * f) * std::abs(row[y]);
                if (even) continue; // the same at both ends
                (alone ? step : blur)[y] += 2 * f * (alone ? row[y] : std::abs(row[y]));
            }
        }
    }

    /// Looks at all lines along p_j through a box of the others.
    /// @param list  parts that hold these lines, in the order of p_j
    void visit(std::size_t j, std::vector<std::size_t> list, box const& others,
               std::vector<bool> const& wanted, std::vector<line>& best) const {
        std::size_t undecided = none; // in the list: some lines are in one half, some in the other
        for (std::size_t n = 0; n < list.size();) {
            auto const& p = parts_[list[n]];
            if (p.side == j) {
                list[n] = p.halves[0];
                list.insert(list.begin() + static_cast<std::ptrdiff_t>(n) + 1, p.halves[1]);
            } else if (p.side != none && others[p.side].upper() <= p.cut) {
                list[n] = p.halves[0];
            } else if (p.side != none && others[p.side].lower() >= p.cut) {
                list[n] = p.halves[1];
            } else {
                if (p.side != none) undecided = n;
                ++n;
            }
        }
        bool worse = false;
        for (std::size_t c = 0; c < best.size(); ++c) {
            if (!wanted[c]) continue;
            for (auto const s : channels_[c].samples) {
                auto l = along(list, j * scale_.size() + s);
                if (!(l.bound > best[c].bound)) continue;
                worse = true;
                if (undecided != none) continue;
                l.sample = s;
                l.parts = list;
                l.others = others;
                best[c] = std::move(l);
            }
        }
        if (!worse || undecided == none) return;
        auto const& p = parts_[list[undecided]];
        auto const [below, above] = bisect(others, p.side, p.cut);
        visit(j, list, below, wanted, best);
        visit(j, std::move(list), above, wanted, best);
    }
    /// The most that is moved between two points of lines through these parts: in one part, or in
    /// two and by the steps between.
    [[nodiscard]] line along(std::vector<std::size_t> const& list, std::size_t at) const {
        line most;
        double steps = 0, blurs = 0, size = 0;
        struct begin {
            double value = -infinity;
            std::size_t part = 0;
        } up, down;
        for (std::size_t n = 0; n < list.size(); ++n) {
            auto const& p = parts_[list[n]];
            double const moves = p.moves[at];
            auto const end = [&](double value, std::size_t first) {
                if (!(value > most.bound)) return;
                most.bound = value;
                most.first = first;
                most.last = n;
            };
            end(moves, n);
            if (!(moves < infinity)) return most;
            end(moves + up.value + steps + blurs, up.part);
            end(moves + down.value - steps + blurs, down.part);
            steps += p.step[at];
            blurs += p.blur[at];
            size += moves + std::abs(p.step[at]) + p.blur[at];
            if (moves - steps - blurs > up.value) up = {moves - steps - blurs, n};
            if (moves + steps - blurs > down.value) down = {moves + steps - blurs, n};
        }
        if (list.size() > 1) most.bound += 1e-12 * size;
        return most;
    }

    identification_problem const* problem_;
    feasibility_test* test_;
    std::vector<std::vector<bool>> acts_;
    std::vector<std::size_t> first_;   ///< sample of each experiment, then their number
    std::vector<double> scale_;        ///< per sample
    std::vector<std::size_t> channel_; ///< per sample
    std::vector<ranked_channel> channels_;
    std::vector<part> parts_;
};

} // namespace sivid::decision_detail

#endif
