// SPDX-License-Identifier: MIT
#ifndef SERVO_AXIS_BALANCE_HPP
#define SERVO_AXIS_BALANCE_HPP

#include "balance_tables.hpp"
#include "polytope.hpp"

#include <sivid/number/elementary.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace servo {

using sivid::box;
/// Contracts boxes of (M, F_v, F_c, offset) by the equation of motion, multiplied by a weight
/// w(sigma) = 1 - exp(-lambda (tau - sigma)) and integrated from the start of a window to a sample,
/// tau later. Two integrations by parts leave no derivative of q but the start's velocity:
///
///   M A + (F_v - lambda M) E + F_c int w s(v) + offset int w = int w F,
///     A = lambda (q(tau) - q_0) - w(0) v_0,
///     E = lambda int exp(-lambda (tau - sigma)) (q - q_0).
///
/// Positions are known from the samples, the force exactly, and s(v) = v/sqrt(v^2 + eps^2) wherever
/// an enclosure of v stays away from zero. This is linear in the parameters and has no dynamics
/// left: wide boxes, for which enclosures of trajectories are useless, shrink all the same. With
/// lambda near F_v/M the samples under the integral hardly count, and the relation is as sharp as
/// the solution itself.
/// @guarantee  no parameter is removed for which some start in the window's box explains all of
///             its samples
class balance_test {
    using traits = sivid::interval_traits<interval>;

public:
    balance_test(std::vector<window> const& windows, interval const& epsilon) : epsilon_(epsilon) {
        for (double r = 0.25; r < 10; r *= 1.15) rates_.push_back(r);
        for (auto const& w : windows) {
            auto& all = windows_.emplace_back();
            all.position = w.position[0];
            all.velocity = w.velocity;
            // What is left over at the end of a window is not used.
            for (std::size_t k = 0; k + knots < w.times.size(); k += knots) {
                all.blocks.push_back(cut(w, k));
            }
            for (double const rate : rates_) all.relations.push_back(relate(w, rate));
            order_.push_back(order_.size());
        }
    }

    [[nodiscard]] sivid::assessment<> operator()(box const& parameters) {
        sivid::assessment<> result{.rest = parameters};
        result.smear.assign(4, 0.0);
        std::vector<linear_relation<4>> relations;
        for (std::size_t i = 0; i < order_.size(); ++i) {
            if (contract(windows_[order_[i]], result.rest, result.smear, relations)) continue;
            // What refutes one box often refutes its neighbours: asked earlier next time.
            if (i > 0) std::swap(order_[i], order_[i / 2]);
            result.verdict = sivid::box_verdict::outside;
            return result;
        }
        if (!polytope<4>(result.rest, relations).contract(result.rest)) {
            result.verdict = sivid::box_verdict::outside;
        }
        return result;
    }

private:
    struct prepared {
        interval position, velocity; ///< of the start
        std::vector<block> blocks;
        std::vector<std::vector<relation>> relations; ///< by lambda
    };

    /// s at a point. Far from zero 1 - eps^2/(2 v^2) <= |s| <= 1.
    [[nodiscard]] interval direction(double v) const {
        interval const x(v);
        bool cut = false;
        return traits::div(x, traits::sqrt(traits::add(traits::sqr(x), traits::sqr(epsilon_)), cut),
                           cut);
    }
    /// s over a range: it increases.
    [[nodiscard]] interval direction(interval const& v) const {
        double const far = 64 * epsilon_.upper();
        if (v.lower() > far) return interval(1 - 0x1p-13, 1.0);
        if (v.upper() < -far) return interval(-1.0, 0x1p-13 - 1);
        return sivid::hull(direction(v.lower()), direction(v.upper()));
    }

    /// All trajectories that start a slice at the point v: where they are during it and at its end.
    struct motion {
        interval over, end, way; ///< way: by how far the position changes
    };
    [[nodiscard]] bool follow(box const& p, slice const& s, double v, motion& out) const {
        interval const start(v);
        bool undefined = false;
        auto const brake = [&](interval const& over) {
            return traits::add(
                traits::add(traits::mul(p[1], over), traits::mul(p[2], direction(over))), p[3]);
        };
        auto guess = start;
        for (int round = 0; round < 8; ++round) {
            auto const force = brake(guess);
            auto const image =
                traits::add(start, traits::div(traits::sub(s.pushes, traits::mul(s.elapsed, force)),
                                               p[0], undefined));
            if (round > 0 && sivid::subset(image, guess)) {
                out.over = image;
                out.end = traits::add(start,
                                      traits::div(traits::sub(s.push, traits::mul(s.length, force)),
                                                  p[0], undefined));
                out.way = traits::add(
                    traits::mul(s.length, start),
                    traits::div(
                        traits::sub(s.travel, traits::mul(traits::mul(traits::sqr(s.length), force),
                                                          interval(0.5))),
                        p[0], undefined));
                return true;
            }
            double const room = 0.15 * sivid::width(image) + 1e-9;
            guess = traits::add(image, interval(-room, room));
        }
        return false;
    }

    [[nodiscard]] std::size_t nearest_rate(box const& p) const {
        double const wanted = sivid::mid(p[1]) / sivid::mid(p[0]);
        std::size_t best = 0;
        for (std::size_t i = 1; i < rates_.size(); ++i) {
            if (std::abs(std::log(rates_[i] / wanted)) <
                std::abs(std::log(rates_[best] / wanted))) {
                best = i;
            }
        }
        return best;
    }

    /// Where a window has got to.
    struct progress {
        interval position, velocity;
        interval once = interval(0.0);     ///< int s
        interval weighted = interval(0.0); ///< int w s
        interval over;                     ///< velocities of the last block
    };
    /// Follows the velocity through a node of a block.
    [[nodiscard]] bool pass(box const& p, block const& b, relation const& c, std::size_t node,
                            std::size_t level, progress& now) const {
        auto const& part = b.nodes[node];
        // Solutions of a scalar equation do not cross: the fastest and the slowest start bound all.
        motion low, high;
        bool const followed = follow(p, part, now.velocity.lower(), low) &&
                              follow(p, part, now.velocity.upper(), high);
        interval s(-1.0, 1.0);
        interval over;
        if (followed) {
            over = interval(low.over.lower(), high.over.upper());
            s = direction(over);
        }
        if (level + 1 < levels && (!followed || sivid::width(s) > 0.02)) {
            return pass(p, b, c, 2 * node + 1, level + 1, now) &&
                   pass(p, b, c, 2 * node + 2, level + 1, now);
        }
        if (!followed) return false;
        auto const& m = c.level[level];
        now.velocity = interval(low.end.lower(), high.end.upper());
        now.position = traits::add(now.position, interval(low.way.lower(), high.way.upper()));
        now.over = sivid::is_empty(now.over) ? over : sivid::hull(now.over, over);
        now.weighted = traits::add(
            traits::add(traits::mul(m.decay, now.weighted), traits::mul(m.grown, now.once)),
            traits::mul(m.gained, s));
        now.once = traits::add(now.once, traits::mul(part.length, s));
        return true;
    }

    bool contract(prepared const& w, box& p, std::vector<double>& smear,
                  std::vector<linear_relation<4>>& relations) const {
        auto const rate = nearest_rate(p);
        interval const lambda(rates_[rate]);
        progress now;
        now.position = w.position;
        now.velocity = w.velocity;
        interval bent(0.0);
        for (std::size_t k = 0; k < w.blocks.size(); ++k) {
            auto const& b = w.blocks[k];
            auto const& c = w.relations[rate][k];
            now.over = traits::empty();
            if (!pass(p, b, c, 0, 0, now)) return true;
            now.position = traits::intersect(now.position, c.position);
            if (sivid::is_empty(now.position)) return false;
            // Between samples q leaves its chord by -(u (h - u)/2) v', under the integral h^3/12.
            bool undefined = false;
            auto const brake = traits::add(
                traits::add(traits::mul(p[1], now.over), traits::mul(p[2], direction(now.over))),
                p[3]);
            auto const a = traits::div(traits::sub(b.nodes[0].force, brake), p[0], undefined);
            bent = traits::add(traits::mul(c.level[0].decay, bent), traits::mul(c.bend, a));
            std::array<interval, 4> const factor{c.a, interval(0.0), now.weighted, c.weight};
            relations.push_back(reduce(p, factor, lambda, traits::add(c.e, bent), c.impulse));
            if (!solve(p, relations.back(), smear)) return false;
        }
        return true;
    }

    /// A M + E (F_v - lambda M) + S F_c + W offset = target. E is split into its middle, which goes
    /// to the factors of M and F_v, and a rest that is small when F_v - lambda M is.
    static linear_relation<4> reduce(box const& p, std::array<interval, 4> factor,
                                     interval const& lambda, interval const& e, interval target) {
        interval const middle(sivid::mid(e));
        target = traits::sub(target, traits::mul(traits::sub(e, middle),
                                                 traits::sub(p[1], traits::mul(lambda, p[0]))));
        factor[0] = traits::sub(factor[0], traits::mul(lambda, middle));
        factor[1] = middle;
        return {factor, target};
    }

    /// Removes from each side what the others exclude. @returns false when nothing is left
    static bool solve(box& p, linear_relation<4> const& relation, std::vector<double>& smear) {
        auto const& [factor, target] = relation;
        std::array<interval, 4> term;
        double noise = sivid::width(target);
        for (std::size_t j = 0; j < 4; ++j) {
            term[j] = traits::mul(factor[j], p[j]);
            noise += sivid::mag(p[j]) * sivid::width(factor[j]);
        }
        for (std::size_t j = 0; j < 4; ++j) {
            smear[j] = std::max(smear[j], sivid::mag(factor[j]) * sivid::width(p[j]) / noise);
            interval others = target;
            for (std::size_t l = 0; l < 4; ++l) {
                if (l != j) others = traits::sub(others, term[l]);
            }
            if (sivid::contains(factor[j], 0.0)) {
                if (sivid::disjoint(others, term[j])) return false;
                continue;
            }
            bool undefined = false;
            p[j] = sivid::intersect(p[j], traits::div(others, factor[j], undefined));
            if (sivid::is_empty(p[j])) return false;
            term[j] = traits::mul(factor[j], p[j]);
        }
        return true;
    }

    std::vector<double> rates_; ///< the choices of lambda [1/s]: F_v/M of the prior is 0.25 to 10
    std::vector<prepared> windows_;
    std::vector<std::size_t> order_; ///< in which the windows are asked
    interval epsilon_;
};

} // namespace servo

#endif
