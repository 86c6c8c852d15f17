// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SERIES_DETAIL_SERIES_TAIL_HPP
#define SIVID_MODEL_SERIES_DETAIL_SERIES_TAIL_HPP

#include <sivid/model/series/series.hpp>
#include <sivid/number/interval_traits.hpp>
#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/taylor_model.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid {

// Functions that hardly change far from 0, however fast their argument does: a force of friction
// while a body slides. For an argument \f$ A(s) \f$, a polynomial with
// \f$ B \ge h^k |A^{[k]}| \f$ on [0, h] for each k >= 1, and \f$ f(A + w) = \sum_j c_j w^j \f$,
// coefficient M of f(A(s)) times \f$ h^M \f$ is at most \f$ \sum_j |c_j| \binom{M-1}{j-1} B^j \f$:
// so many ways M has of being a sum of j numbers. It bounds Lagrange's remainder.
namespace model_detail {
/// Makes computed products and sums of a few dozen non-negative numbers upper bounds.
inline constexpr double far_up = 1 + 1e-12;

/// An upper bound of \f$ e^x \f$.
[[nodiscard]] inline double exp_above(double x) {
    using traits = interval_traits<interval>;
    return traits::exp(traits::point(x)).upper();
}

/// exp: \f$ c_j \le e^A / j! \f$.
/// @param most   A is nowhere more
/// @param moves  B
[[nodiscard]] inline double far_exp_tail(double most, double moves, std::size_t order) {
    double term = moves, sum = moves;
    for (std::size_t j = 1; j < order; ++j) {
        term *= moves * static_cast<double>(order - j) / static_cast<double>(j * (j + 1));
        sum += term;
    }
    return exp_above(most) * sum * far_up;
}

/// tanh: for R below the distance L of A from 0, the function less its sign is at most
/// \f$ \tau = 2 / (e^{2(L-R)} - 1) \f$ on the disc of radius R about A, all of which lies on one
/// side of the imaginary axis. So \f$ |c_j| \le \tau R^{-j} \f$, and the sum is
/// \f$ \tau (B/R) (1 + B/R)^{M-1} \f$.
/// @param least  L, more than 1
/// @param moves  B
[[nodiscard]] inline double far_tanh_tail(double least, double moves, std::size_t order) {
    double best = std::numeric_limits<double>::infinity();
    for (double const part : {2.0, 4.0, 8.0, 16.0}) {
        double const radius = least / part;
        double const below = exp_above(-2 * (least - radius)); // less than 1/e
        double const ratio = moves / radius * far_up;
        double bound = 2 * below / (1 - below) * ratio;
        for (std::size_t k = 1; k < order; ++k) bound *= 1 + ratio;
        bound *= far_up;
        if (bound < best) best = bound;
    }
    return best;
}

/// What tanh changes at most where its argument does by 1: \f$ 1 - \tanh^2 x \le 4 e^{-2|x|} \f$.
/// @param least  |x| is nowhere less
[[nodiscard]] inline double steepest_tanh(double least) {
    return least > 1 ? std::min(1.0, 4 * exp_above(-2 * least) * far_up) : 1.0;
}
} // namespace model_detail

/// What the Taylor series in time of every quantity of a tape leave out, from the sizes of their
/// coefficients alone.
///   Along a solution, quantity v is \f$ v(s) = \sum_{k<M} v_k s^k + r_v(s) \f$ with its true
///   coefficients. Where the states are known to have \f$ |r_x(s)| \le \rho_x (s/h)^M \f$ on
///   [0, h], so has every quantity, with a \f$ \rho_v \f$ of its own: of a product
///   \f$ \rho_{ab} = \sum_{i+j \ge M} |a_i| |b_j| h^{i+j} + \rho_a \|b\| + \rho_b \|a\| + \rho_a
///   \rho_b \f$, \f$ \|a\| = \sum_{k<M} |a_k| h^k \f$; of the others see
///   `docs/theory/taylor_models.md`. Low orders cancel exactly, so nothing is lost to roundings.
/// @tparam T     a Taylor model; sizes are its norms, so that everything holds for all of its
///               functions' arguments. With lanes: in each lane.
/// @cost         O(M) numbers a product, O(1) a product for each further `propagate`
/// @ref          Makino and Berz, Int. J. Pure Appl. Math. 4 (2003): remainders of operations
template <class T>
class series_tail {
public:
    using scalar = typename T::scalar;
    using side_by_side = lane_traits<scalar>;

    series_tail(tape const& program, std::size_t max_order)
        : program_(&program),
          stride_(max_order + 1),
          place_(program.slots(), nowhere),
          whole_(program.slots()),
          tail_(program.slots()) {
        for (auto const& i : program.varying()) {
            if (i.op == operation::tan) covered_ = false;
            if (!program.keeps_history(i.target)) continue;
            place_[i.target] = kept_++;
        }
        size_.resize(kept_ * stride_);
        above_.resize(kept_ * stride_);
    }

    /// Whether all operations of the tape have a rule here. tan has none.
    [[nodiscard]] bool covers() const { return covered_; }

    /// Enters the coefficients 0 .. orders - 1 of a series over [0, h].
    /// @param rest  also those beyond the tape's principal part
    /// @given  the series has them, and is neither undefined nor kinked; h >= 0
    void measure(series<T> const& s, std::size_t orders, scalar const& h, bool rest) {
        orders_ = orders;
        length_ = h;
        last_ = rest ? program_->varying().size() : program_->principal_varying();
        powers_.assign(orders, scalar(1.0));
        for (std::size_t k = 1; k < orders; ++k) powers_[k] = powers_[k - 1] * h;
        auto const fixed = [&](std::size_t slot) { whole_[slot] = s.coefficient(slot, 0).norm(); };
        for (auto const slot : program_->literal_slots()) fixed(slot);
        for (std::size_t n = 0; n < program_->constant().size(); ++n) {
            if (n < program_->principal_constant() || rest) fixed(program_->constant()[n].target);
        }
        for (std::size_t n = 0; n < last_; ++n) {
            auto const slot = program_->varying()[n].target;
            if (place_[slot] == nowhere) continue;
            scalar* const size = size_.data() + place_[slot] * stride_;
            scalar* const above = above_.data() + place_[slot] * stride_;
            for (std::size_t k = 0; k < orders; ++k) {
                size[k] = s.coefficient(slot, k).norm() * powers_[k];
            }
            above[0] = scalar(0.0);
            for (std::size_t k = 1; k < orders; ++k) above[k] = above[k - 1] + size[orders - k];
            whole_[slot] = (above[orders - 1] + size[0]) * up;
        }
        // What depends on the coefficients alone, in the order in which `propagate` reads it.
        own_.clear();
        for (std::size_t n = 0; n < last_; ++n) enter(s, program_->varying()[n]);
    }

    /// Bounds the tails of everything that was measured.
    /// @param states  \f$ \rho_x \f$
    /// @param slope   i -> coefficient 1 of input i
    template <class Slope>
    void propagate(std::vector<scalar> const& states, Slope const& slope) {
        next_ = 0;
        for (std::size_t n = 0; n < last_; ++n) {
            auto const& i = program_->varying()[n];
            scalar& r = tail_[i.target];
            switch (i.op) {
            case operation::time:
                r = orders_ < 2 ? length_ : scalar(0.0);
                break;
            case operation::state:
                r = states[static_cast<std::size_t>(i.index)];
                break;
            case operation::input:
                r = orders_ < 2 ? slope(static_cast<std::size_t>(i.index)).norm() * length_
                                : scalar(0.0);
                break;
            default:
                r = i.is_sum() ? sum(i) : of(i);
            }
            r = r * up + T::tiny;
        }
        if (next_ != own_.size()) rules_differ();
    }

    /// \f$ \rho \f$ of a slot; 0 for what does not vary. NaN or infinite where nothing is known.
    [[nodiscard]] scalar const& tail(std::size_t slot) const { return tail_[slot]; }
    /// \f$ \sum_{k<M} |v_k| h^k \f$, of a slot with history or one that does not vary
    [[nodiscard]] scalar const& whole(std::size_t slot) const { return whole_[slot]; }
    /// \f$ |v_k| h^k \f$, of a slot that varies and has history
    [[nodiscard]] scalar const& size(std::size_t slot, std::size_t k) const {
        return size_[place_[slot] * stride_ + k];
    }

private:
    static constexpr std::size_t nowhere = ~std::size_t{0};
    /// Makes computed sums of a few hundred non-negative numbers upper bounds.
    static constexpr double up = 1 + 1e-12;
    static constexpr double down = 1 - 1e-12;
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /// \f$ \sum_{i+j \ge M} |a_i| |b_j| h^{i+j} \f$
    [[nodiscard]] scalar beyond(std::size_t a, std::size_t b) const {
        scalar const* const x = size_.data() + place_[a] * stride_;
        scalar const* const y = above_.data() + place_[b] * stride_;
        scalar even{}, odd{};
        std::size_t k = 1;
        for (; k + 1 < orders_; k += 2) {
            even += x[k] * y[k];
            odd += x[k + 1] * y[k + 1];
        }
        if (k < orders_) even += x[k] * y[k];
        return (even + odd) * up + T::tiny;
    }
    /// \f$ \sum_{1 \le k < M} k/(M+k) |a_k| h^k \f$: what \f$ \int (\sigma/h)^M |a'(\sigma)|
    /// d\sigma \f$ is at most, as a multiple of \f$ (s/h)^M \f$
    [[nodiscard]] scalar change(std::size_t a) const {
        scalar sum{};
        for (std::size_t k = 1; k < orders_; ++k) {
            sum += size_[place_[a] * stride_ + k] *
                   (static_cast<double>(k) / static_cast<double>(orders_ + k));
        }
        return sum * up;
    }
    /// \f$ \sum_{1 \le k < M} |a_k| h^k \f$
    [[nodiscard]] scalar movement(std::size_t a) const {
        return above_[place_[a] * stride_ + orders_ - 1] * up;
    }
    /// \f$ \sum_{1 \le k < M} 2^{k-1} |a_k| h^k \ge h^k |a^{[k]}(s)| \f$ for all k >= 1 and s in
    /// [0, h]
    [[nodiscard]] scalar changes(std::size_t a) const {
        scalar sum{};
        double weight = 1;
        for (std::size_t k = 1; k < orders_; ++k, weight *= 2) {
            sum += size_[place_[a] * stride_ + k] * weight;
        }
        return sum * up;
    }
    /// What |a| is at least on [0, h] as far as its polynomial knows.
    [[nodiscard]] scalar distance(series<T> const& s, std::size_t a) const {
        return without(rough_bounds(s.coefficient(a, 0)).least(), movement(a));
    }
    /// A bound, or in lanes where x is more than 1 another one if that is less.
    template <class Far>
    static scalar or_far(scalar const& usual, scalar const& x, Far const& far) {
        if (!side_by_side::any(x > scalar(1.0))) return usual;
        auto const other = each_lane<scalar>([&](std::size_t l) {
            double const least = side_by_side::get(x, l);
            return least > 1 ? far(least, l) : infinity;
        });
        return side_by_side::select(other < usual, other, usual);
    }
    /// lower - taken, rounded down, both not negative; 0 where that is not positive, or unknown
    static scalar without(scalar const& lower, scalar const& taken) {
        scalar const rest = lower * down - taken * up;
        return side_by_side::select(rest > scalar(0.0), rest, scalar(0.0));
    }
    static scalar product(scalar const& own, scalar const& a, scalar const& b, scalar const& ra,
                          scalar const& rb) {
        return own + ra * (b + rb) + rb * a;
    }
    /// x / (1 - y) where y is below 1, else infinite
    static scalar over_rest(scalar const& x, scalar const& y) {
        scalar const rest = without(scalar(1.0), y);
        return quotient(x, rest);
    }
    /// x / y rounded up; infinite where y is 0
    static scalar quotient(scalar const& x, scalar const& y) {
        auto const good = y > scalar(0.0);
        scalar const safe = side_by_side::select(good, y, scalar(1.0));
        scalar const q = x / safe;
        return side_by_side::select(good, q * up, scalar(infinity));
    }

    void enter_sum(instruction const& i) {
        auto const* const terms = program_->terms(i);
        for (std::size_t n = 0; n < i.last_term - i.first_term; ++n) {
            auto const& t = terms[n];
            if (t.product && t.a_varies && t.b_varies) own_.push_back(beyond(t.a, t.b));
        }
    }
    void enter(series<T> const& s, instruction const& i) {
        if (i.is_sum()) return enter_sum(i);
        auto const least = [&](std::size_t slot) { return rough_bounds(s.coefficient(slot, 0)); };
        switch (i.op) {
        case operation::mul:
            if (i.a_varies && i.b_varies) own_.push_back(beyond(i.a, i.b));
            break;
        case operation::sqr:
            own_.push_back(beyond(i.a, i.a));
            break;
        case operation::pown:
            own_.push_back(beyond(is_squared_power(i.index) ? i.companion : i.a, i.companion));
            break;
        case operation::div: {
            scalar const lower = least(i.b).least();
            own_.push_back(i.b_varies ? without(lower, movement(i.b)) : lower);
            if (i.b_varies) own_.push_back(beyond(i.target, i.b));
            break;
        }
        case operation::sqrt:
            own_.push_back(without(least(i.target).lower, movement(i.target)));
            own_.push_back(beyond(i.target, i.target));
            break;
        case operation::exp:
            own_.push_back(exp_tail(s, i));
            break;
        case operation::log: {
            scalar const lower = without(least(i.a).lower, movement(i.a));
            own_.push_back(lower);
            own_.push_back(quotient(beyond(i.a, i.target), lower));
            break;
        }
        case operation::sin:
        case operation::cos:
            own_.push_back(sine_tail(i));
            break;
        case operation::atan: { // r_y' (1 + a^2) is known
            scalar const lower = distance(s, i.a);
            own_.push_back(lower);
            own_.push_back(
                quotient(beyond(i.companion, i.target) + beyond(i.a, i.a) * change(i.target),
                         (scalar(1.0) + lower * lower) * down));
            break;
        }
        case operation::tanh:
            own_.push_back(distance(s, i.a));
            own_.push_back(tanh_tail(i, own_.back()));
            break;
        case operation::abs:
        case operation::sign:
            own_.push_back(without(least(i.a).least(), movement(i.a)));
            break;
        case operation::min:
        case operation::max:
            own_.push_back(least_gap(s, i));
            break;
        default:
            break;
        }
    }
    /// What |a - b| is at least.
    [[nodiscard]] scalar least_gap(series<T> const& s, instruction const& i) const {
        scalar moved{};
        if (i.a_varies) moved += movement(i.a);
        if (i.b_varies) moved += movement(i.b);
        return without(rough_bounds(s.coefficient(i.a, 0) - s.coefficient(i.b, 0)).least(), moved);
    }
    /// Of sine or cosine: \f$ r_y \le T_y + w r_c, r_c \le T_c + w r_y \f$.
    [[nodiscard]] scalar sine_tail(instruction const& i) const {
        scalar const moved = change(i.a);
        return over_rest(beyond(i.companion, i.a) + beyond(i.target, i.a) * moved, moved * moved);
    }
    /// Of the exponential of a's polynomial.
    [[nodiscard]] scalar exp_tail(series<T> const& s, instruction const& i) const {
        scalar const below =
            without(-rough_bounds(s.coefficient(i.a, 0)).upper, movement(i.a)); // 0 if not negative
        scalar const moves = changes(i.a);
        return or_far(
            over_rest(beyond(i.target, i.a), change(i.a)), below, [&](double least, std::size_t l) {
                return model_detail::far_exp_tail(-least, side_by_side::get(moves, l), orders_);
            });
    }
    /// Of the tanh of a's polynomial.
    /// @param least  what that polynomial's absolute value is at least
    [[nodiscard]] scalar tanh_tail(instruction const& i, scalar const& least) const {
        scalar const moved = change(i.a);
        scalar const moves = changes(i.a);
        return or_far(over_rest(beyond(i.companion, i.a) + beyond(i.target, i.target) * moved,
                                (whole_[i.target] + scalar(1.0)) * moved),
                      least, [&](double x, std::size_t l) {
                          return model_detail::far_tanh_tail(x, side_by_side::get(moves, l),
                                                             orders_);
                      });
    }
    /// What `enter` has pushed for the operation at hand, in its order.
    scalar const& own() {
        if (next_ == own_.size()) rules_differ();
        return own_[next_++];
    }
    /// A rule that reads other numbers than it entered would give wrong bounds.
    [[noreturn]] void rules_differ() const {
        throw std::logic_error("series_tail: rules entered " + std::to_string(own_.size()) +
                               " numbers and read " +
                               (next_ < own_.size() ? std::to_string(next_) : "more"));
    }

    scalar sum(instruction const& i) {
        scalar total{};
        auto const* const terms = program_->terms(i);
        for (std::size_t n = 0; n < i.last_term - i.first_term; ++n) {
            auto const& t = terms[n];
            if (!t.product) {
                if (t.a_varies) total += tail_[t.a];
            } else if (t.a_varies && t.b_varies) {
                total += product(own(), whole_[t.a], whole_[t.b], tail_[t.a], tail_[t.b]);
            } else {
                total += t.a_varies ? tail_[t.a] * whole_[t.b] : tail_[t.b] * whole_[t.a];
            }
        }
        return total;
    }
    scalar of_root(scalar const& ra) {
        scalar const lower = own();
        scalar const rest = (ra + own()) * up;
        scalar const coarse = quotient(rest, lower);
        // The root itself is at least lower - coarse, and the polynomial at least lower.
        scalar const both = lower + without(lower, coarse);
        return side_by_side::select(coarse < lower * down, quotient(rest, both * down),
                                    scalar(infinity));
    }
    scalar of_quotient(instruction const& i, scalar const& ra, scalar const& rb) {
        scalar const lower = own();
        if (!i.b_varies) return quotient(ra, lower);
        scalar const cut = own();
        return quotient(ra + cut + whole_[i.target] * rb, without(lower, rb));
    }
    scalar of(instruction const& i) {
        // What does not vary has no tail, whatever its slot holds.
        scalar const ra = i.a_varies ? tail_[i.a] : scalar(0.0);
        scalar const rb = i.b_varies ? tail_[i.b] : scalar(0.0);
        scalar const unknown(infinity);
        switch (i.op) {
        case operation::neg:
            return ra;
        case operation::add:
        case operation::sub:
            return ra + rb;
        case operation::mul:
            if (i.a_varies && i.b_varies) return product(own(), whole_[i.a], whole_[i.b], ra, rb);
            return i.a_varies ? ra * whole_[i.b] : rb * whole_[i.a];
        case operation::sqr:
            return product(own(), whole_[i.a], whole_[i.a], ra, ra);
        case operation::pown: {
            auto const other = is_squared_power(i.index) ? i.companion : i.a;
            return product(own(), whole_[other], whole_[i.companion], tail_[other],
                           tail_[i.companion]);
        }
        case operation::div:
            return of_quotient(i, ra, rb);
        case operation::sqrt:
            return of_root(ra);
        case operation::exp: {
            scalar const mine = own();
            return side_by_side::select(ra <= scalar(1.0),
                                        mine + (whole_[i.target] + mine) * ra * (ra + scalar(1.0)),
                                        unknown);
        }
        case operation::log: {
            scalar const lower = own();
            return own() + quotient(ra, without(lower, ra));
        }
        case operation::sin:
        case operation::cos:
            return own() + ra;
        case operation::atan: {
            scalar const lower = without(own(), ra);
            return own() + quotient(ra, (scalar(1.0) + lower * lower) * down);
        }
        case operation::tanh: {
            scalar const lower = without(own(), ra);
            return own() + ra * or_far(scalar(1.0), lower, [](double least, std::size_t) {
                               return model_detail::steepest_tanh(least);
                           });
        }
        case operation::abs:
            return side_by_side::select(without(own(), ra) > scalar(0.0), ra, unknown);
        case operation::sign:
            return side_by_side::select(without(own(), ra) > scalar(0.0), scalar(0.0), unknown);
        case operation::min:
        case operation::max:
            return side_by_side::select(without(own(), ra + rb) > scalar(0.0),
                                        side_by_side::max(ra, rb), unknown);
        default:
            return unknown;
        }
    }

    tape const* program_;
    std::size_t stride_;
    bool covered_ = true;
    std::vector<std::size_t> place_; ///< of the slots that vary and have history
    std::size_t kept_ = 0;
    std::size_t orders_ = 0, last_ = 0, next_ = 0;
    scalar length_{};
    std::vector<scalar> size_;  ///< |v_k| h^k
    std::vector<scalar> above_; ///< [k]: the sum of the last k of them
    std::vector<scalar> whole_, tail_, powers_, own_;
};

} // namespace sivid

#endif
