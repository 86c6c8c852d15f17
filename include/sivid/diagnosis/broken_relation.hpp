// SPDX-License-Identifier: MIT
#ifndef SIVID_DIAGNOSIS_BROKEN_RELATION_HPP
#define SIVID_DIAGNOSIS_BROKEN_RELATION_HPP

#include <sivid/diagnosis/linear_refutation.hpp>
#include <sivid/diagnosis/observed_motion.hpp>
#include <sivid/diagnosis/separation.hpp>
#include <sivid/diagnosis/window_integrals.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/paving/problem.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

namespace diagnosis_detail {

/// Six digits, for the text of an assumption.
inline std::string short_text(double x) {
    std::array<char, 32> text{};
    auto const end =
        std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::general, 6);
    return {text.data(), end.ptr};
}

} // namespace diagnosis_detail

/// A time window of an experiment.
struct relation_window {
    std::string scenario;
    double from = 0, to = 0;
};

/// What has to be added to an equation on the average over a window, so that it holds there.
struct missing_rate {
    relation_window window;
    interval value;   ///< certified over the whole prior
    std::string unit; ///< of the state, per s
};

/// What was found out about one state equation together with the sensors in its row.
struct relation_finding {
    std::size_t equation = 0;
    std::string name;                  ///< of the state whose rate it is
    std::vector<std::string> channels; ///< the sensors in the row
    /// Proved: for no parameter of the prior do the equation and all bounds of these sensors hold,
    /// if the assumptions do.
    bool proved = false;
    std::vector<std::string> assumptions;
    std::vector<relation_window> windows; ///< that carry the proof
    /// Certified: if every window's equation were allowed to be off by less than this many times
    /// what the bounds leave open in it, nothing would change.
    double margin = 0;
    std::optional<missing_rate> missing; ///< of the window where it is clearest
    std::string reason;                  ///< why nothing could be tried
};

struct relation_options {
    motion_options motion;
    double shortest = 0.3, longest = 10; ///< of the windows [s]
    std::size_t most_windows = 20000;    ///< of one equation
    /// A margin below this is not called a proof, although it is one.
    double least_margin = 0.02;
};

/// Examines the equations of a problem one by one.
///   Integrated over a window, \f$ x_i' = \phi_0 + \sum_j \theta_j \phi_j \f$ says
///   \f$ x_i(t_b) - x_i(t_a) = a_0 + \sum_j \theta_j a_j \f$ with
///   \f$ a_j = \int \phi_j dt \f$, which the tubes of the measured states enclose without any
///   integration of the model. Every window gives two linear inequalities on \f$ \theta \f$; if
///   those of all windows contradict each other and the prior, which `proved_margin` checks in
///   intervals, the equation and its sensors cannot both hold.
class relation_examiner {
    using traits = interval_traits<interval>;

public:
    /// @param problem  outlives this object
    /// @throws std::invalid_argument if the problem is not valid
    relation_examiner(identification_problem const& problem, relation_options const& options)
        : problem_(&problem), options_(options) {
        problem.require_valid();
        for (auto const& e : problem.experiments) {
            if (e.outliers == 0) experiments_.push_back(&e);
        }
        if (!problem.model.input_delays.empty() || !problem.model.channel_delays.empty()) {
            reason_ = "the model has delays";
            return;
        }
        if (experiments_.empty()) {
            reason_ = "every experiment has an outlier budget";
            return;
        }
        std::vector<signal> const open(problem.model.about.inputs.size(),
                                       sampled_signal({0.0}, {0.0}, interpolation::linear));
        model_ = bind(problem.model, problem.choice, open);
        channels_ = direct_channels(model_);
        auto const laws = declare_variations(model_, problem.prior, experiments_, options.motion);
        for (std::size_t e = 0; e < experiments_.size(); ++e) {
            motions_.push_back(observe_motion(model_, problem.prior, *experiments_[e], laws[e],
                                              options.motion.cells_per_gap));
        }
        for (std::size_t q = 0; q < model_.state_count(); ++q) {
            auto const& n = model_.g[model_.rate[q]];
            if (n.op != operation::state || !channels_[q]) continue;
            auto const r = static_cast<std::size_t>(n.index);
            if (r != q && channels_[r]) pairs_.push_back({r, q});
        }
    }

    [[nodiscard]] relation_finding examine(std::size_t equation) {
        relation_finding result;
        result.equation = equation;
        result.name = problem_->model.about.states.at(equation).name;
        result.reason = reason_;
        if (!reason_.empty()) return result;
        if (!channels_[equation]) {
            result.reason = "no channel shows " + result.name;
            return result;
        }
        auto const row = separate_row(equation);
        for (auto const s : row.states) {
            if (channels_[s]) continue;
            result.reason = "no channel shows " + state_name(s);
            return result;
        }
        if (!row.bounded) {
            result.reason = "a coefficient is unbounded over the prior";
            return result;
        }
        auto const set = integrand_set::of(model_.g, row.functions, model_.state_count());
        std::vector<window_integrals> integrals;
        for (auto const& m : motions_) {
            if (m.cells.empty()) continue;
            integrals.emplace_back(set, m.cells, pairs_);
        }
        bool parts = false;
        for (std::size_t j = 0; j < row.functions.size() && !integrals.empty(); ++j) {
            parts = parts || integrals.front().has_parts(j);
        }
        for (int with = 0; with <= (parts ? 1 : 0) && !result.proved; ++with) {
            attempt(row, integrals, with == 1, result);
        }
        return result;
    }

    [[nodiscard]] std::size_t equations() const { return problem_->model.about.states.size(); }

private:
    /// One equation: its coefficients \f$ \theta_j = anchor_j + width_j z_j, z_j \in [0, 1] \f$,
    /// and its functions, the one without a coefficient last.
    struct equation_row {
        std::size_t equation = 0;
        std::vector<interval> range;
        std::vector<double> anchor, width;
        std::vector<parameter_product> theta;
        std::vector<node_id> functions;
        std::set<std::size_t> states;
        bool bounded = true, inputs = false;
    };
    /// One window's enclosed equation \f$ d = a_0 + \sum \theta_j a_j \f$.
    struct window_row {
        std::size_t motion = 0;
        double from = 0, to = 0;
        interval difference;
        std::vector<interval> a;
    };

    [[nodiscard]] std::string const& state_name(std::size_t i) const {
        return problem_->model.about.states[i].name;
    }

    [[nodiscard]] equation_row separate_row(std::size_t equation) {
        equation_row row;
        row.equation = equation;
        auto& g = model_.g;
        auto const split = separate(g, model_.rate[equation]);
        std::vector<node_id> atoms;
        for (auto const& t : split.terms) {
            for (auto const& factor : t.theta) atoms.push_back(factor.first);
        }
        atoms_.emplace(g, atoms);
        atoms_->evaluate({traits::point(0.0), {}, problem_->prior, {}});
        for (auto const& t : split.terms) {
            auto const range = range_of(t.theta, *atoms_);
            row.bounded = row.bounded && is_bounded(range);
            row.range.push_back(range);
            row.theta.push_back(t.theta);
            row.functions.push_back(t.function);
            // From the end that is closest to zero, so that rows lose nothing.
            bool const falling = std::abs(range.upper()) < std::abs(range.lower());
            row.anchor.push_back(falling ? range.upper() : range.lower());
            row.width.push_back(falling ? -width(range) : width(range));
        }
        row.functions.push_back(split.rest);
        auto const needed = reachable(g, row.functions);
        for (std::size_t k = 0; k < needed.size(); ++k) {
            auto const& n = g.nodes()[k];
            if (!needed[k]) continue;
            if (n.op == operation::state) row.states.insert(static_cast<std::size_t>(n.index));
            if (n.op == operation::input) row.inputs = true;
        }
        return row;
    }

    [[nodiscard]] std::vector<window_row> windows(equation_row const& row,
                                                  std::vector<window_integrals> const& integrals,
                                                  bool parts) const {
        std::vector<window_row> result;
        std::size_t total = 0;
        for (int pass = 0; pass < 2; ++pass) {
            std::size_t count = 0;
            auto const stride = total / options_.most_windows + 1;
            std::size_t used = 0;
            for (std::size_t m = 0; m < motions_.size(); ++m) {
                if (motions_[m].cells.empty()) continue;
                auto const& integral = integrals[used++];
                auto const& tube = *motions_[m].tubes[row.equation];
                for (std::size_t b = 1; b < tube.times().size(); ++b) {
                    for (std::size_t a = b; a-- > 0;) {
                        double const from = tube.times()[a];
                        double const to = tube.times()[b];
                        if (to - from > options_.longest * (1 + 1e-9)) break;
                        if (to - from < options_.shortest * (1 - 1e-9)) continue;
                        if (++count % stride != 0 || pass == 0) continue;
                        window_row w{m, from, to, {}, {}};
                        if (fill(row, integral, a, b, parts, w)) result.push_back(std::move(w));
                    }
                }
            }
            total = count;
        }
        return result;
    }

    [[nodiscard]] bool fill(equation_row const& row, window_integrals const& integral,
                            std::size_t a, std::size_t b, bool parts, window_row& w) const {
        auto const& motion = motions_[w.motion];
        auto const& tube = *motion.tubes[row.equation];
        w.difference = traits::sub(tube.bound(b), tube.bound(a));
        auto const first = motion.boundary_at(w.from);
        auto const last = motion.boundary_at(w.to);
        auto const q_at = [&](std::size_t q, std::size_t boundary) {
            double const t = motion.boundaries[boundary];
            return motion.tubes[q]->covers(t, t) ? motion.tubes[q]->over(t, t) : traits::entire();
        };
        for (std::size_t j = 0; j < row.functions.size(); ++j) {
            auto integrated = integral.direct(j, first, last);
            if (parts && integral.has_parts(j)) {
                auto const both = intersect(integrated, integral.by_parts(j, first, last, q_at));
                if (!sivid::is_empty(both)) integrated = both;
            }
            if (!is_bounded(integrated)) return false;
            w.a.push_back(integrated);
        }
        return is_bounded(w.difference);
    }

    /// Two inequalities a window, then what the prior says about ratios of coefficients.
    [[nodiscard]] linear_system system_of(equation_row const& row,
                                          std::vector<window_row> const& list) const {
        auto const n = row.range.size();
        linear_system system(n);
        std::vector<double> low(n), high(n);
        for (auto const& w : list) {
            auto right = traits::sub(w.difference, w.a.back());
            double open = width(right);
            for (std::size_t j = 0; j < n; ++j) {
                right = traits::sub(right, traits::mul(w.a[j], traits::point(row.anchor[j])));
                auto const slope = traits::mul(w.a[j], traits::point(row.width[j]));
                low[j] = slope.lower();
                high[j] = -slope.upper();
                open += mag(row.range[j]) * width(w.a[j]);
            }
            double const weight = std::max(open / 2, 1e-300);
            system.add(low, right.upper(), weight);
            system.add(high, -right.lower(), weight);
        }
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t k = 0; k < n; ++k) add_ratio(row, j, k, system);
        }
        return system;
    }
    /// \f$ \theta_j \le \rho \theta_k \f$ or \f$ \theta_j \ge \rho \theta_k \f$, where the
    /// quotient's factors cancel and \f$ \theta_k > 0 \f$.
    void add_ratio(equation_row const& row, std::size_t j, std::size_t k,
                   linear_system& system) const {
        if (j == k || !(row.range[k].lower() > 0)) return;
        auto const ratio = range_of(quotient(row.theta[j], row.theta[k]), *atoms_);
        bool undefined = false;
        auto const plain = traits::div(row.range[j], row.range[k], undefined);
        for (bool const above : {true, false}) {
            double const rho = above ? ratio.upper() : ratio.lower();
            double const known = above ? plain.upper() : plain.lower();
            if (!std::isfinite(rho) || std::abs(rho - known) < 1e-6 * mag(plain)) continue;
            // sign (theta_j - rho theta_k) <= 0 in z: coefficients downward, the bound upward.
            auto const sign = traits::point(above ? 1.0 : -1.0);
            auto const against = traits::mul(traits::neg(sign), traits::point(rho));
            std::vector<double> entries(row.range.size(), 0.0);
            entries[j] = traits::mul(sign, traits::point(row.width[j])).lower();
            entries[k] = traits::mul(against, traits::point(row.width[k])).lower();
            auto const fixed = traits::add(traits::mul(sign, traits::point(row.anchor[j])),
                                           traits::mul(against, traits::point(row.anchor[k])));
            system.add(entries, traits::neg(fixed).upper(), 0);
        }
    }

    void attempt(equation_row const& row, std::vector<window_integrals> const& integrals,
                 bool parts, relation_finding& result) const {
        auto const list = windows(row, integrals, parts);
        if (list.empty()) {
            result.reason = "no window with all its sensors";
            return;
        }
        auto const system = system_of(row, list);
        auto const relaxed = least_relaxation(system);
        result.margin = proved_margin(system, relaxed.multipliers);
        result.missing = clearest(row, list);
        if (!(result.margin >= std::max(options_.least_margin, 1e-12))) return;
        result.proved = true;
        std::set<std::size_t> motions;
        std::set<std::pair<std::size_t, std::pair<double, double>>> seen;
        bool from_begin = false;
        for (auto const& [i, factor] : relaxed.multipliers.multipliers) {
            if (i >= 2 * list.size()) continue;
            auto const& w = list[i / 2];
            if (!seen.insert({w.motion, {w.from, w.to}}).second) continue;
            auto const& motion = motions_[w.motion];
            motions.insert(w.motion);
            from_begin = from_begin || w.from == motion.boundaries.front();
            result.windows.push_back({motion.name, w.from, w.to});
        }
        describe(row, motions, parts, from_begin, result);
    }

    [[nodiscard]] std::optional<missing_rate> clearest(equation_row const& row,
                                                       std::vector<window_row> const& list) const {
        std::optional<missing_rate> result;
        double best = -1;
        for (auto const& w : list) {
            auto const value = missing(row, w);
            double const clear = std::abs(mid(value)) / (width(value) + 1e-300);
            if (!(clear > best)) continue;
            best = clear;
            auto const& state = problem_->model.about.states[row.equation];
            result = missing_rate{{motions_[w.motion].name, w.from, w.to},
                                  value,
                                  unit(state.unit).times(unit("s"), -1).text()};
        }
        return result;
    }
    [[nodiscard]] interval missing(equation_row const& row, window_row const& w) const {
        auto value = traits::sub(w.difference, w.a.back());
        for (std::size_t j = 0; j < row.range.size(); ++j) {
            value = traits::sub(value, traits::mul(row.range[j], w.a[j]));
        }
        bool undefined = false;
        auto const length = traits::sub(traits::point(w.to), traits::point(w.from));
        return traits::div(value, length, undefined);
    }

    void describe(equation_row const& row, std::set<std::size_t> const& motions, bool parts,
                  bool from_begin, relation_finding& result) const {
        auto const& about = problem_->model.about;
        auto sensors = row.states;
        if (parts) {
            for (auto const& pair : pairs_) {
                if (row.states.count(pair.r) == 0) continue;
                sensors.insert(pair.q);
                result.assumptions.push_back(state_name(pair.q) + "' = " + state_name(pair.r));
            }
        }
        for (auto const s : sensors) {
            std::string text;
            for (auto const m : motions) {
                auto const& law = motions_[m].variation[s];
                text += (text.empty() ? "" : ", ") + diagnosis_detail::short_text(law.variation) +
                        " " + unit(about.states[s].unit).times(unit("s"), -1).text() + " in " +
                        motions_[m].name;
            }
            auto const& law = motions_[*motions.begin()].variation[s];
            result.assumptions.push_back(state_name(s) + "' varies within " +
                                         diagnosis_detail::short_text(law.period) +
                                         " s by at most " + text);
        }
        if (row.inputs) result.assumptions.push_back("inputs exact");
        if (from_begin) result.assumptions.push_back("initial states in their boxes");
        sensors.insert(row.equation);
        for (auto const s : sensors) result.channels.push_back(about.channels[*channels_[s]].name);
    }

    identification_problem const* problem_;
    relation_options options_;
    std::string reason_;
    std::vector<experiment const*> experiments_;
    bound_model model_;
    std::vector<std::optional<std::size_t>> channels_;
    std::vector<observed_motion> motions_;
    std::vector<derivative_pair> pairs_;
    std::optional<graph_range> atoms_;
};

/// Examines every state equation; those about which nothing could be said have a reason.
[[nodiscard]] inline std::vector<relation_finding>
examine_relations(identification_problem const& problem, relation_options const& options = {}) {
    relation_examiner examiner(problem, options);
    std::vector<relation_finding> result;
    for (std::size_t i = 0; i < examiner.equations(); ++i) result.push_back(examiner.examine(i));
    return result;
}

} // namespace sivid

#endif
