// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_DISTURBANCE_DETAIL_DISTURBANCE_PROGRAM_HPP
#define SIVID_PAVING_DISTURBANCE_DETAIL_DISTURBANCE_PROGRAM_HPP

#include <sivid/model/disturbance.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/paving/disturbance/detail/disturbed_motion.hpp>
#include <sivid/paving/disturbance/detail/plain_motion.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/dense.hpp>
#include <sivid/work_clock.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// Weights of the measurements of each experiment.
using sample_weights = std::vector<std::vector<double>>;
/// Cells at which segments begin, of each experiment; those at which something is measured are
/// among them.
using segment_begins = std::vector<std::vector<std::size_t>>;

/// What a linear program finds: an estimate.
struct disturbance_proposal {
    double size = 0;
    std::vector<double> parameters; ///< steps from the middle
    std::vector<std::vector<double>> starts;
    /// Per experiment and disturbed equation: d in each segment.
    std::vector<std::vector<std::vector<double>>> disturbances;
    sample_weights weights; ///< multipliers of the measurements
    bool finite = false;
};

/// How far a program may go from the middle of what it is linearised about.
struct program_room {
    std::vector<interval> parameters;
    std::vector<box> starts;
};

/// The least size of disturbances that are constant in segments, with which a linearised problem
/// explains its measurements: a linear program in the size, the steps of parameters and starts,
/// and all disturbances,
///   \f$ \min W, \; |H_i z + G_i \pi - m_i| \le b_i + s_i W, \; |d| \le W s \f$, boxes of the
///   steps,
/// by a primal-dual interior point method. Its normal equations are those of a controlled motion
/// with quadratic costs, the parameters and the size being further states that do not change: a
/// Riccati recursion along each experiment solves them.
/// @cost  O(segments (n + parameters)^3) for each of some thirty rounds
/// @ref   S. Mehrotra, On the implementation of a primal-dual interior point method, SIAM J.
///        Optimization 2 (1992); C. V. Rao, S. J. Wright, J. B. Rawlings, Application of
///        interior-point methods to model predictive control, J. Optim. Theory Appl. 99 (1998)
class disturbance_program {
    using index = Eigen::Index;
    using matrix = Eigen::MatrixXd;
    using vector = Eigen::VectorXd;

public:
    disturbance_program(std::vector<disturbed_motion> const& motions,
                        std::vector<plain_motion> const& plain, disturbance_set const& set,
                        segment_begins const& segments, program_room const& room)
        : shared_(static_cast<index>(room.parameters.size()) + 1),
          disturbed_(static_cast<index>(set.equations.size())),
          driven_(disturbed_) {
        // What is left open drives each state, too, within bounds of its own.
        if (!plain.empty() && !plain[0].cells.empty()) driven_ += plain[0].cells[0].left.size();
        sized_ = vector::Zero(driven_);
        sized_.head(disturbed_).setOnes();
        scale_ = vector::Zero(disturbed_);
        for (index q = 0; q < disturbed_; ++q)
            scale_[q] = set.equations[static_cast<std::size_t>(q)].scale;
        choose_units(plain, set, room);
        for (std::size_t s = 0; s < motions.size(); ++s)
            add_chain(motions[s], plain[s], set, segments[s], room.starts[s]);
        for (auto const& side : room.parameters) add_sides(global_, side);
        global_.push_back({0, 1, 1, 0}); // W >= 0
        beta_ = vector::Zero(shared_);
        beta_[shared_ - 1] = 1;
        for_each_row([this](row&, double) { ++rows_; });
    }

    /// @param go_on  false ends it with what it has
    [[nodiscard]] disturbance_proposal operator()(std::function<bool()> const& go_on) {
        start();
        for (int round = 0; round < 60 && go_on(); ++round) {
            double const mu = complementarity();
            if (!std::isfinite(mu) ||
                (mu * static_cast<double>(rows_) < 1e-8 * (1 + size()) && infeasible_ < 1e-9))
                break;
            if (!factor()) break;
            aim(0, false);
            solve();
            double const guess = predicted(mu);
            aim(mu * guess * guess * guess, true);
            solve();
            follow();
        }
        return read();
    }

private:
    /// \f$ a \cdot v \le reach \f$ with its slack and multiplier; a is known from where it stands.
    struct row {
        double reach = 0, slack = 1, multiplier = 1, value = 0; ///< value: a . v
        double stiff = 0, push = 0, step = 0;                   ///< of the present round; a . dv
        double slack_step = 0, multiplier_step = 0;
    };
    struct sample {
        std::size_t name = 0; ///< among the motion's
        vector by_state;
        vector by_shared; ///< of parameters; W counts apart
        double scale = 0; ///< of W
        double size = 1;  ///< by which it is divided
        row above, below;
    };
    struct segment {
        matrix step, by_shared, kick;  ///< Phi, of parameters and W (0), of d
        std::vector<row> above, below; ///< d <= W, -d <= W
        vector d, move;
        matrix gain;    ///< of the factored round
        matrix inverse; ///< of Q_dd
        vector offset;
    };
    struct chain {
        index n = 0;
        vector unit;             ///< of the start
        std::vector<row> starts; ///< upper and lower side of each
        std::vector<segment> segments;
        std::vector<std::vector<sample>> at; ///< at the begin of each segment and at the end
        vector x0, move;                     ///< in its units
        matrix cost;                         ///< of the start and what is shared
        std::size_t samples = 0;
        matrix rest; ///< of the start, given what is shared
        vector rest_offset;
    };

    void choose_units(std::vector<plain_motion> const& plain, disturbance_set const& set,
                      program_room const& room) {
        std::vector<double> all;
        for (auto const& m : plain)
            for (auto const& c : m.cells)
                for (auto const& q : set.equations)
                    all.push_back(std::abs(c.defect[static_cast<index>(q.index)]) / q.scale);
        if (!all.empty()) {
            auto const high = all.begin() + static_cast<std::ptrdiff_t>(all.size() * 9 / 10);
            std::nth_element(all.begin(), high, all.end());
            if (*high > 1e-200 && std::isfinite(*high)) unit_ = *high;
        }
        parameter_unit_ = vector::Zero(shared_);
        for (index j = 0; j + 1 < shared_; ++j) {
            double const most = mag(room.parameters[static_cast<std::size_t>(j)]);
            parameter_unit_[j] = std::isfinite(most) ? most : 0.0;
        }
    }
    /// Of an unknown in units of the range's size; of one without room an unknown that does
    /// nothing.
    static void add_sides(std::vector<row>& to, interval const& range) {
        double const most = mag(range);
        bool const open = most > 0 && std::isfinite(most) && width(range) > 0;
        row upper, lower;
        upper.reach = open ? range.upper() / most : 1;
        lower.reach = open ? -range.lower() / most : 1;
        to.push_back(upper);
        to.push_back(lower);
    }
    void add_chain(disturbed_motion const& motion, plain_motion const& plain,
                   disturbance_set const& set, std::vector<std::size_t> const& begins,
                   box const& start) {
        chain c;
        c.n = static_cast<index>(start.size());
        c.unit = vector::Zero(c.n);
        for (index i = 0; i < c.n; ++i) {
            auto const& side = start[static_cast<std::size_t>(i)];
            add_sides(c.starts, side);
            if (width(side) > 0 && is_bounded(side)) c.unit[i] = mag(side);
        }
        c.x0 = vector::Zero(c.n);
        c.samples = motion.samples.size();
        c.at.resize(begins.size() + 1);
        std::vector<vector> still; // what the motion does by itself, at nodes
        still.push_back(vector::Zero(c.n));
        for (std::size_t k = 0; k < begins.size(); ++k) {
            auto const to = k + 1 < begins.size() ? begins[k + 1] : plain.cells.size();
            vector at = still.back();
            c.segments.push_back(joined_cells(plain, begins[k], to, set, c.n, at));
            still.push_back(std::move(at));
        }
        for (std::size_t i = 0; i < motion.samples.size(); ++i) {
            auto const& from = motion.samples[i];
            if (!is_bounded(from.rest)) continue;
            auto const k = static_cast<std::size_t>(
                std::lower_bound(begins.begin(), begins.end(), from.node) - begins.begin());
            auto const node = from.node < plain.cells.size() ? k : begins.size();
            c.at[node].push_back(sample_of(i, from, set, still[node]));
        }
        chains_.push_back(std::move(c));
    }
    [[nodiscard]] segment joined_cells(plain_motion const& plain, std::size_t from, std::size_t to,
                                       disturbance_set const& set, index n, vector& at) const {
        segment result;
        result.step = matrix::Identity(n, n);
        result.by_shared = matrix::Zero(n, shared_);
        result.kick = matrix::Zero(n, driven_);
        for (auto c = from; c < to; ++c) {
            auto const& cell = plain.cells[c];
            result.step = cell.step * result.step;
            result.by_shared = cell.step * result.by_shared;
            for (index j = 0; j + 1 < shared_; ++j)
                result.by_shared.col(j) +=
                    parameter_unit_[j] * (cell.kick * cell.by_parameter.col(j));
            result.kick = cell.step * result.kick;
            for (index q = disturbed_; q < driven_; ++q)
                result.kick(q - disturbed_, q) += cell.length * cell.left[q - disturbed_];
            for (index q = 0; q < disturbed_; ++q) {
                auto const& e = set.equations[static_cast<std::size_t>(q)];
                result.kick.col(q) += e.scale * unit_ * cell.kick.col(static_cast<index>(e.index));
            }
            at = cell.step * at + cell.kick * cell.defect;
        }
        result.above.resize(static_cast<std::size_t>(driven_));
        result.below.resize(static_cast<std::size_t>(driven_));
        for (auto* side : {&result.above, &result.below})
            for (auto q = static_cast<std::size_t>(disturbed_); q < side->size(); ++q)
                (*side)[q].reach = 1;
        result.d = vector::Zero(driven_);
        return result;
    }
    [[nodiscard]] sample sample_of(std::size_t i, disturbed_sample const& from,
                                   disturbance_set const& set, vector const& still) const {
        sample result;
        result.name = i;
        result.size = std::max({0.5 * width(from.rest), 1e-9 * mag(from.rest), 1e-250});
        auto const n = still.size();
        result.by_state = plain_motion::middles(from.by_state, n) / result.size;
        result.by_shared = vector::Zero(shared_);
        for (index j = 0; j + 1 < shared_; ++j)
            result.by_shared[j] = parameter_unit_[j] / result.size *
                                  mid(from.by_parameter[static_cast<std::size_t>(j)]);
        for (auto const& q : set.channels)
            if (q.index == from.channel) result.scale = q.scale * unit_ / result.size;
        double const alone = result.by_state.dot(still);
        result.above.reach = from.rest.upper() / result.size - alone;
        result.below.reach = alone - from.rest.lower() / result.size;
        return result;
    }

    [[nodiscard]] double size() const { return beta_[shared_ - 1]; }
    /// Calls f(row, a . v) with the present values; of the step instead where `steps`.
    template <class F>
    void for_each_row(F const& f, bool steps = false) {
        vector const& shared = steps ? beta_move_ : beta_;
        if (steps && shared.size() == 0) return;
        for (auto& c : chains_) {
            vector const& x0 = steps ? c.move : c.x0;
            for (index i = 0; i < c.n; ++i) {
                f(c.starts[static_cast<std::size_t>(2 * i)], x0[i]);
                f(c.starts[static_cast<std::size_t>(2 * i + 1)], -x0[i]);
            }
            vector x = c.unit.cwiseProduct(x0);
            for (std::size_t k = 0; k <= c.segments.size(); ++k) {
                for (auto& s : c.at[k]) {
                    double const y = s.by_state.dot(x) + s.by_shared.dot(shared);
                    double const more = s.scale * shared[shared_ - 1];
                    f(s.above, y - more);
                    f(s.below, -y - more);
                }
                if (k == c.segments.size()) break;
                auto& g = c.segments[k];
                vector const& d = steps ? g.move : g.d;
                for (index q = 0; q < driven_; ++q) {
                    auto const j = static_cast<std::size_t>(q);
                    f(g.above[j], d[q] - sized_[q] * shared[shared_ - 1]);
                    f(g.below[j], -d[q] - sized_[q] * shared[shared_ - 1]);
                }
                x = g.step * x + g.by_shared * shared + g.kick * d;
            }
        }
        for (index j = 0; j + 1 < shared_; ++j) {
            f(global_[static_cast<std::size_t>(2 * j)], shared[j]);
            f(global_[static_cast<std::size_t>(2 * j + 1)], -shared[j]);
        }
        f(global_.back(), -shared[shared_ - 1]);
    }
    void start() {
        for_each_row([](row& r, double v) {
            r.value = v;
            r.slack = std::max(r.reach - v, 1.0);
            r.multiplier = 1 / r.slack;
        });
    }
    [[nodiscard]] double complementarity() {
        double sum = 0;
        infeasible_ = 0;
        for_each_row([&](row& r, double v) {
            r.value = v;
            sum += r.slack * r.multiplier;
            infeasible_ =
                std::max(infeasible_, std::abs(v + r.slack - r.reach) / (1 + std::abs(r.reach)));
        });
        return sum / static_cast<double>(rows_);
    }
    /// Where the products of slacks and multipliers are to go.
    void aim(double goal, bool corrected) {
        for_each_row([&](row& r, double) {
            double const miss = r.value + r.slack - r.reach;
            double const wanted = goal - (corrected ? r.slack_step * r.multiplier_step : 0.0);
            r.push = wanted / r.slack + r.stiff * miss;
        });
    }
    /// The Riccati recursion of all experiments with the stiffness of the rows.
    [[nodiscard]] bool factor() {
        for_each_row([](row& r, double) { r.stiff = r.multiplier / r.slack; });
        matrix total = matrix::Zero(shared_, shared_);
        for (index j = 0; j + 1 < shared_; ++j)
            total(j, j) += global_[static_cast<std::size_t>(2 * j)].stiff +
                           global_[static_cast<std::size_t>(2 * j + 1)].stiff;
        total(shared_ - 1, shared_ - 1) += global_.back().stiff;
        for (auto& c : chains_) {
            if (!factor(c, total)) return false;
        }
        return shared_cost_.compute(total);
    }
    [[nodiscard]] bool factor(chain& c, matrix& total) {
        auto const all = c.n + shared_;
        auto const last = all - 1;
        work_clock::count(c.segments.size() * static_cast<std::size_t>(2 * all * all * all), 0.1);
        matrix p = matrix::Zero(all, all);
        for (auto k = c.segments.size() + 1; k-- > 0;) {
            if (k < c.segments.size()) {
                auto& g = c.segments[k];
                matrix a = matrix::Identity(all, all);
                a.topLeftCorner(c.n, c.n) = g.step;
                a.topRightCorner(c.n, shared_) = g.by_shared;
                matrix const pa = p * a;
                matrix cross = g.kick.transpose() * pa.topRows(c.n);
                matrix own = g.kick.transpose() * p.topLeftCorner(c.n, c.n) * g.kick;
                p = a.transpose() * pa;
                for (index q = 0; q < driven_; ++q) {
                    auto const j = static_cast<std::size_t>(q);
                    double const up = g.above[j].stiff, down = g.below[j].stiff;
                    own(q, q) += up + down;
                    cross(q, last) += sized_[q] * (down - up);
                    p(last, last) += sized_[q] * (up + down);
                }
                if (driven_ > 0) {
                    g.inverse = approximate_inverse(own);
                    g.gain = -g.inverse * cross;
                    p += cross.transpose() * g.gain;
                }
                p = (0.5 * (p + p.transpose())).eval();
            }
            for (auto const& s : c.at[k]) {
                for (bool const above : {true, false}) {
                    vector const e = entries(s, above, c.n);
                    p += (above ? s.above : s.below).stiff * e * e.transpose();
                }
            }
            if (!p.allFinite()) return false;
        }
        c.cost = p;
        // The start in its units, with its sides, is eliminated.
        matrix own = c.unit.asDiagonal() * p.topLeftCorner(c.n, c.n) * c.unit.asDiagonal();
        for (index i = 0; i < c.n; ++i)
            own(i, i) += c.starts[static_cast<std::size_t>(2 * i)].stiff +
                         c.starts[static_cast<std::size_t>(2 * i + 1)].stiff;
        matrix const cross = c.unit.asDiagonal() * p.topRightCorner(c.n, shared_);
        c.rest = approximate_inverse(own);
        total += p.bottomRightCorner(shared_, shared_) - cross.transpose() * c.rest * cross;
        return c.rest.allFinite();
    }
    [[nodiscard]] vector entries(sample const& s, bool above, index n) const {
        vector e(n + shared_);
        e << s.by_state, s.by_shared;
        if (!above) e = -e;
        e[n + shared_ - 1] -= s.scale;
        return e;
    }
    /// The step for the present pushes.
    void solve() {
        vector side = vector::Zero(shared_);
        side[shared_ - 1] = 1; // the goal
        for (index j = 0; j + 1 < shared_; ++j)
            side[j] += global_[static_cast<std::size_t>(2 * j)].push -
                       global_[static_cast<std::size_t>(2 * j + 1)].push;
        side[shared_ - 1] -= global_.back().push;
        for (auto& c : chains_) backward(c, side);
        beta_move_ = shared_cost_.solve(-side);
        for (auto& c : chains_) forward(c);
        for_each_row([](row& r, double v) { r.step = v; }, true);
        for_each_row([](row& r, double) {
            r.slack_step = -(r.value + r.slack - r.reach) - r.step;
            // By what the push aims at; see `aim`.
            r.multiplier_step = r.push - r.multiplier + r.stiff * r.step;
        });
    }
    void backward(chain& c, vector& side) const {
        auto const all = c.n + shared_;
        vector p = vector::Zero(all);
        for (auto k = c.segments.size() + 1; k-- > 0;) {
            if (k < c.segments.size()) {
                auto& g = c.segments[k];
                vector next = p;
                next.head(c.n) = g.step.transpose() * p.head(c.n);
                next.tail(shared_) += g.by_shared.transpose() * p.head(c.n);
                vector own = g.kick.transpose() * p.head(c.n);
                for (index q = 0; q < driven_; ++q) {
                    auto const j = static_cast<std::size_t>(q);
                    own[q] += g.above[j].push - g.below[j].push;
                    next[all - 1] -= sized_[q] * (g.above[j].push + g.below[j].push);
                }
                if (driven_ > 0) {
                    g.offset = -g.inverse * own;
                    next += g.gain.transpose() * own;
                }
                p = std::move(next);
            }
            for (auto const& s : c.at[k]) {
                if (s.above.push != 0) p += s.above.push * entries(s, true, c.n);
                if (s.below.push != 0) p += s.below.push * entries(s, false, c.n);
            }
        }
        vector own = c.unit.cwiseProduct(p.head(c.n));
        for (index i = 0; i < c.n; ++i)
            own[i] += c.starts[static_cast<std::size_t>(2 * i)].push -
                      c.starts[static_cast<std::size_t>(2 * i + 1)].push;
        c.rest_offset = own;
        matrix const cross = c.unit.asDiagonal() * c.cost.topRightCorner(c.n, shared_);
        side += p.tail(shared_) - cross.transpose() * (c.rest * own);
    }
    void forward(chain& c) const {
        matrix const cross = c.unit.asDiagonal() * c.cost.topRightCorner(c.n, shared_);
        c.move = -c.rest * (c.rest_offset + cross * beta_move_);
        vector x = c.unit.cwiseProduct(c.move);
        for (auto& g : c.segments) {
            g.move = vector::Zero(driven_);
            if (driven_ > 0)
                g.move =
                    g.offset + g.gain.leftCols(c.n) * x + g.gain.rightCols(shared_) * beta_move_;
            x = g.step * x + g.by_shared * beta_move_ + g.kick * g.move;
        }
    }
    /// How far slacks and multipliers may go along the step.
    [[nodiscard]] std::pair<double, double> lengths() {
        std::pair<double, double> result{1, 1};
        for_each_row([&](row& r, double) {
            if (r.slack_step < 0) result.first = std::min(result.first, -r.slack / r.slack_step);
            if (r.multiplier_step < 0)
                result.second = std::min(result.second, -r.multiplier / r.multiplier_step);
        });
        return result;
    }
    /// The share of their products that is left after a step without a centre.
    [[nodiscard]] double predicted(double mu) {
        auto const [primal, dual] = lengths();
        double sum = 0;
        for_each_row([&, primal = primal, dual = dual](row& r, double) {
            sum += (r.slack + primal * r.slack_step) * (r.multiplier + dual * r.multiplier_step);
        });
        return std::clamp(sum / (mu * static_cast<double>(rows_)), 0.05, 1.0);
    }
    void follow() {
        auto [primal, dual] = lengths();
        primal = std::min(1.0, 0.995 * primal);
        dual = std::min(1.0, 0.995 * dual);
        for_each_row([&, primal = primal, dual = dual](row& r, double) {
            r.slack += primal * r.slack_step;
            r.multiplier += dual * r.multiplier_step;
        });
        beta_ += primal * beta_move_;
        for (auto& c : chains_) {
            c.x0 += primal * c.move;
            for (auto& g : c.segments) g.d += primal * g.move;
        }
    }
    [[nodiscard]] disturbance_proposal read() const {
        disturbance_proposal to;
        to.size = size() * unit_;
        to.finite = beta_.allFinite();
        for (index j = 0; j + 1 < shared_; ++j)
            to.parameters.push_back(beta_[j] * parameter_unit_[j]);
        for (auto const& c : chains_) {
            vector const x0 = c.unit.cwiseProduct(c.x0);
            to.starts.emplace_back(x0.data(), x0.data() + x0.size());
            auto& own = to.disturbances.emplace_back(static_cast<std::size_t>(disturbed_));
            for (auto const& g : c.segments) {
                to.finite = to.finite && g.d.allFinite();
                for (index q = 0; q < disturbed_; ++q)
                    own[static_cast<std::size_t>(q)].push_back(g.d[q] * unit_ * scale_[q]);
            }
            auto& weights = to.weights.emplace_back(c.samples, 0.0);
            for (auto const& list : c.at)
                for (auto const& s : list)
                    weights[s.name] = (s.above.multiplier - s.below.multiplier) / s.size;
        }
        return to;
    }

    index shared_;             ///< parameters and the size
    index disturbed_, driven_; ///< disturbed equations; with what is left open
    vector sized_, scale_;     ///< of what drives: 1 where the size is its bound; its scale
    double unit_ = 1;          ///< of sizes
    vector parameter_unit_, beta_, beta_move_;
    std::vector<chain> chains_;
    std::vector<row> global_; ///< sides of parameters, then that of the size
    std::size_t rows_ = 0;
    double infeasible_ = 0;
    approximate_cholesky shared_cost_;
};

} // namespace sivid::paving_detail

#endif
