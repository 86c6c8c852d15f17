// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STEP_PERTURBED_STEP_HPP
#define SIVID_ENCLOSURE_STEP_PERTURBED_STEP_HPP

#include <sivid/enclosure/uncertain_input.hpp>
#include <sivid/model/graph/tape.hpp>
#include <sivid/model/series/series.hpp>
#include <sivid/number/pack/lanes.hpp>
#include <sivid/number/text/needed_given.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sivid {

namespace detail {

/// A time in pieces that are short against a matrix.
template <class C>
struct short_pieces {
    typename lane_traits<C>::mask known; ///< where the matrix and the time are not too large
    double count = 1;                    ///< a power of two
};
/// @param finely  h |M| is at most 1/finely in each of them, |M| the largest sum of a row
/// @param most    what h |M| may be in all
template <class C>
[[nodiscard]] short_pieces<C> pieces_of(std::vector<C> const& m, std::size_t n, C const& h,
                                        double finely, double most) {
    using side_by_side = lane_traits<C>;
    short_pieces<C> result{typename side_by_side::mask(true)};
    C norm{};
    for (std::size_t i = 0; i < n; ++i) {
        C row{};
        for (std::size_t j = 0; j < n; ++j) row += side_by_side::abs(m[i * n + j]);
        result.known = result.known & (row * h <= C(most));
        norm = side_by_side::max(row, norm);
    }
    double largest = 0;
    for (std::size_t l = 0; l < side_by_side::count; ++l) {
        if (side_by_side::test(result.known, l)) {
            largest = std::max(largest, side_by_side::get(norm * h, l));
        }
    }
    while (result.count < finely * largest) result.count *= 2;
    return result;
}

/// Of n x n matrices, row by row, to nearest.
template <class C>
[[nodiscard]] std::vector<C> matrix_product(std::vector<C> const& x, std::vector<C> const& y,
                                            std::size_t n) {
    std::vector<C> z(n * n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t j = 0; j < n; ++j) z[i * n + j] += x[i * n + k] * y[k * n + j];
        }
    }
    return z;
}
/// The largest sum of a row's moduli, to nearest.
template <class C>
[[nodiscard]] C row_norm(std::vector<C> const& y, std::size_t n) {
    C most{};
    for (std::size_t i = 0; i < n; ++i) {
        C row{};
        for (std::size_t j = 0; j < n; ++j) row += lane_traits<C>::abs(y[i * n + j]);
        most = lane_traits<C>::max(row, most);
    }
    return most;
}

} // namespace detail

/// Bounds the distance d between a solution of x' = f(t, x) and one of x' = f(t, x) + w(t) with the
/// same start, where nothing is known of w but \f$ |w_i(s)| \le W_i(s) \f$: it may vary in any
/// measurable way. Componentwise
///   \f$ |d_i|' \le \sum_j M_{ij} |d_j| + W_i(s) \f$, \f$ d(0) = 0 \f$,
/// with \f$ M_{ii} \ge \sup \partial f_i/\partial x_i \f$ and \f$ M_{ij} \ge \sup |\partial
/// f_i/\partial x_j| \f$ where the two solutions are. Off the diagonal M is not negative, so the
/// solution of D' = M D + W bounds |d|. A stable diagonal is used, not its modulus.
///
/// D is summed as a Taylor series over pieces of length \f$ \le 1/\|M\| \f$; floating point in
/// whatever rounding mode, with a bound of its errors added to every piece.
/// @tparam C  `double`, or `lanes<W>`: W such problems side by side
/// @param m       M, n x n, row by row
/// @param begin   W(0), not negative
/// @param end     W(h); in between W is at most the straight line
/// @param h       up to a few units of its last place
/// @returns D(h); infinite where M or W is not finite or h |M| is beyond 4096
/// @cost  O(max(1, h |M|) n^2)
/// @ref   Walter, Differential and Integral Inequalities (1970), section 9; Kapela and Zgliczynski,
///        A Lohner-type algorithm for control systems and ordinary differential inclusions (2009)
template <class C>
[[nodiscard]] std::vector<C> bound_perturbation(std::vector<C> const& m,
                                                std::vector<C> const& begin,
                                                std::vector<C> const& end, C const& h) {
    using side_by_side = lane_traits<C>;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    // Covers the errors of a few thousand operations on each term.
    constexpr double slack = 1e-12;
    constexpr double tiny = 1e-290;
    constexpr std::size_t terms = 16;
    auto const n = begin.size();
    auto [known, pieces] = detail::pieces_of(m, n, h, 1, 4096);
    for (std::size_t i = 0; i < n; ++i) {
        C const from = begin[i], to = end[i];
        known = known & (from < C(1e300)) & (to < C(1e300));
    }
    C const step = h * (1 / pieces);
    auto const inverse = each_lane<C>([&](std::size_t l) { return 1 / side_by_side::get(h, l); });
    std::vector<C> d(n), mass(n), term(n), size(n), next(n), bigger(n);
    for (double piece = 0; piece < pieces; ++piece) {
        double const share = piece / pieces;
        term = size = mass = d;
        C last{};
        for (std::size_t k = 1; k <= terms; ++k) {
            C const factor = step * (1 / static_cast<double>(k));
            last = C(0.0);
            for (std::size_t i = 0; i < n; ++i) {
                C sum{}, total{};
                if (k == 1) {
                    sum = begin[i] + (end[i] - begin[i]) * share;
                    total = begin[i] + end[i];
                } else if (k == 2) { // W' once more
                    sum = (end[i] - begin[i]) * inverse * step;
                    total = (begin[i] + end[i]) * inverse * step;
                }
                for (std::size_t j = 0; j < n; ++j) {
                    sum += m[i * n + j] * term[j];
                    total += side_by_side::abs(m[i * n + j]) * size[j];
                }
                next[i] = sum * factor;
                bigger[i] = total * factor;
                last = side_by_side::max(bigger[i], last);
            }
            term.swap(next);
            size.swap(bigger);
            for (std::size_t i = 0; i < n; ++i) {
                d[i] += term[i];
                mass[i] += size[i];
            }
        }
        // step |M| <= 1, so the other terms together are less than the last one.
        for (std::size_t i = 0; i < n; ++i) {
            d[i] = side_by_side::max(d[i], C(0.0)) + mass[i] * slack + last + tiny;
        }
    }
    for (auto& x : d) x = side_by_side::select(known & (x < C(1e300)), x, C(infinity));
    return d;
}

/// The same bound from a matrix A in the middle of the Jacobian: for \f$ d' = A d + v \f$ with
/// \f$ |v_i(s)| \le W_i(s) \f$, what the entries beside A do included in W,
///   \f$ |d(h)| \le \sum_k |e^{A (h - s_{k+1})}| c_k \f$
/// over pieces of length \f$ \tau \le 1/(16 \|A\|) \f$, where \f$ c_k \f$ bounds what piece k
/// brings. Signs cancel in the exponentials, so that what oscillates is not taken for growth.
/// @param a  A, n x n, row by row; any signs
/// @returns a bound of |d(h)|, infinite where A or W is not finite or h |A| is beyond 16. For a W
///          that does not vary it bounds |d| on all of [0, h].
/// @cost  O(max(1, h |A|) n^3)
template <class C>
[[nodiscard]] std::vector<C> bound_linear_perturbation(std::vector<C> const& a,
                                                       std::vector<C> const& begin,
                                                       std::vector<C> const& end, C const& h) {
    using side_by_side = lane_traits<C>;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double unit = std::numeric_limits<double>::epsilon();
    constexpr double up = 1 + 1e-12;
    auto const n = begin.size();
    auto const [known, pieces] = detail::pieces_of(a, n, h, 16, 16);
    C const step = h * (1 / pieces);
    auto metzler = a;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            if (i != j) metzler[i * n + j] = side_by_side::abs(a[i * n + j]);
        }
    }
    // e^{A step} by ten terms, at a norm of at most 1/16, and its error as a norm of rows.
    std::vector<C> one(n * n);
    for (std::size_t i = 0; i < n; ++i) one[i * n + i] = 1.0;
    auto x = one;
    for (std::size_t k = 10; k >= 1; --k) { // Horner's rule
        x = detail::matrix_product(a, x, n);
        C const factor = step * (1 / static_cast<double>(k));
        for (std::size_t i = 0; i < n * n; ++i) x[i] = one[i] + x[i] * factor;
    }
    double const error = 8 * (static_cast<double>(n) + 32) * unit;
    auto const norm_of = [n](std::vector<C> const& y) { return detail::row_norm(y, n) * up; };
    C const size = norm_of(x) + error;
    std::vector<C> d(n), first(n), last(n);
    auto e = one; // e^{A (h - s)} for the pieces from the last one to the first
    C off{};      // of e, as a norm of rows
    for (double piece = pieces; piece-- > 0;) {
        for (std::size_t i = 0; i < n; ++i) {
            C const slope = end[i] - begin[i];
            double const slack = 1 + 8 * unit;
            first[i] = side_by_side::max(begin[i] + slope * (piece / pieces), C(0.0)) * slack +
                       (begin[i] + end[i]) * (4 * unit);
            last[i] = side_by_side::max(begin[i] + slope * ((piece + 1) / pieces), C(0.0)) * slack +
                      (begin[i] + end[i]) * (4 * unit);
        }
        auto const c = bound_perturbation(metzler, first, last, step);
        C most{};
        for (auto const& y : c) most = side_by_side::max(y, most);
        for (std::size_t i = 0; i < n; ++i) {
            C sum = off * most;
            for (std::size_t j = 0; j < n; ++j) sum += side_by_side::abs(e[i * n + j]) * c[j];
            d[i] += sum * up;
        }
        off = (off * size + norm_of(e) * error * 2) * up;
        e = detail::matrix_product(e, x, n);
    }
    for (auto& y : d) y = side_by_side::select(known & (y * up < C(1e300)), y * up, C(infinity));
    return d;
}

/// How a perturbation of the rates spreads during one step, whose length enters with its end:
///   \f$ |d|' \le M |d| + G e + r \f$, and \f$ |d' - A d| \le R |d| + G e + r \f$,
/// e the error bounds of the inputs, which run along lines, and |d| known to stay below `room`. The
/// bounds come from norms, so each state is measured in a unit of the size of its own
/// range.
template <class C>
struct perturbation_law {
    std::vector<C> growth; ///< M, states x states
    std::vector<C> middle; ///< A
    std::vector<C> beside; ///< R
    std::vector<C> gain;   ///< G, states x uncertain inputs
    std::vector<C> rate;   ///< r
    std::vector<C> room;
    std::vector<C> unit; ///< of each state, powers of two; none: 1

    /// Bounds |d| at the end of a step, the less of both ways.
    [[nodiscard]] std::vector<C> deviation(std::vector<C> const& begin, std::vector<C> const& end,
                                           C const& h) const {
        return bound(push(begin), push(end), h);
    }
    /// The same at all times of the step.
    [[nodiscard]] std::vector<C> largest_deviation(std::vector<C> const& begin,
                                                   std::vector<C> const& end, C const& h) const {
        auto most = push(begin);
        auto const other = push(end);
        for (std::size_t i = 0; i < most.size(); ++i) {
            most[i] = lane_traits<C>::max(most[i], other[i]);
        }
        return bound(most, most, h);
    }

private:
    static constexpr double up = 1 + 1e-12;

    static constexpr double tiny = 1e-290; ///< more than all underflows

    [[nodiscard]] C unit_of(std::size_t i) const { return unit.empty() ? C(1.0) : unit[i]; }
    /// A matrix of states by states, in their units.
    [[nodiscard]] std::vector<C> measured(std::vector<C> a) const {
        auto const n = rate.size();
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) a[i * n + j] *= unit_of(j) / unit_of(i);
        }
        return a;
    }
    [[nodiscard]] std::vector<C> bound(std::vector<C> begin, std::vector<C> end, C const& h) const {
        auto const n = rate.size();
        // What underflows in `measured` is below `tiny` for all |d| that are no nonsense.
        typename lane_traits<C>::mask usual(true);
        for (std::size_t i = 0; i < n; ++i) {
            usual = usual & (room[i] < unit_of(i) * 1e30);
            for (auto* w : {&begin, &end}) (*w)[i] = (*w)[i] / unit_of(i) + tiny;
        }
        auto result = bound_perturbation(measured(growth), begin, end, h);
        for (std::size_t i = 0; i < n; ++i) {
            C more{};
            for (std::size_t j = 0; j < n; ++j) more += beside[i * n + j] * room[j];
            more = more / unit_of(i) + tiny;
            begin[i] = (begin[i] + more) * up;
            end[i] = (end[i] + more) * up;
        }
        auto const other = bound_linear_perturbation(measured(middle), begin, end, h);
        for (std::size_t i = 0; i < n; ++i) {
            C const least = lane_traits<C>::min(result[i], other[i]) * unit_of(i) + tiny;
            result[i] =
                lane_traits<C>::select(usual, least, C(std::numeric_limits<double>::infinity()));
        }
        return result;
    }
    [[nodiscard]] std::vector<C> push(std::vector<C> const& e) const {
        auto w = rate;
        for (std::size_t i = 0; i < w.size(); ++i) {
            for (std::size_t k = 0; k < e.size(); ++k) w[i] += gain[i * e.size() + k] * e[k];
            w[i] *= up;
        }
        return w;
    }
};

/// Bounds how far solutions of a perturbed flow leave those of the nominal one during a step for
/// which a tube of the nominal ones is proved. The perturbation is what the inputs may differ from
/// their samples, and a bound of the rates, if one is set; it varies in time in any measurable way,
/// so that no derivative of it is taken: the nominal flow is expanded, and this bound is added.
///   With \f$ \hat d \f$ the tube widened by it holds both solutions as long as \f$ |d| < \hat d
///   \f$, and while it does, \f$ d' = J d + v \f$ with J in the range of \f$ \partial_x f \f$ and
///   \f$ |v| \le |\partial_u f| e + r \f$, by the mean value theorem (with Clarke's derivative at
///   kinks); a \f$ \hat d \f$ above the bound that follows is never reached. Where the right-hand
///   side may jump, or has no bounded derivative, d' is enclosed by the difference of the rates
///   themselves.
/// @tparam T  scalar of the tube: an interval, or a Taylor model in lanes
/// @guarantee  of each lane that `prove` returns: for every member of the tube's family, every
///             solution of the perturbed flow from the same start exists during the step, and its
///             distance to the nominal one is at most `largest()` during the step and at most
///             `at_end()` at its end
/// @cost  some evaluations of the rates and their Jacobian over the tube
template <class T>
class perturbed_step {
    using arithmetic = arithmetic_of<T>;
    using number = set_scalar<T>;

public:
    using scalar = typename number::scalar;
    using side_by_side = lane_traits<scalar>;
    using mask = typename side_by_side::mask;

    /// @param values  see `series`
    explicit perturbed_step(flow const& f, size_of_values<T> const& values = {}) : flow_(&f) {
        auto const& model = f.model();
        auto outputs = model.rate;
        for (auto const* derivatives : {&model.rate_dx, &model.rate_du}) {
            std::size_t const offset = derivatives == &model.rate_dx ? 0 : f.states();
            for (std::size_t i = 0; i < derivatives->size(); ++i) {
                for (std::size_t k = 0; k < (*derivatives)[i].size(); ++k) {
                    auto const d = (*derivatives)[i][k];
                    if (model.g.is(d, 0)) continue;
                    entries_.push_back({i, offset + k, outputs.size()});
                    outputs.push_back(d);
                }
            }
        }
        program_ = std::make_shared<tape const>(model.g, outputs, model.rate.size());
        series_ = std::make_unique<series<T>>(*program_, 0, values);
    }

    template <class Box>
    void set_parameters(Box const& p) {
        series_->set_parameters(p);
    }
    /// A perturbation of each rate beside that of the inputs: \f$ |x_i' - f_i| \le w_i \f$.
    /// @throws std::invalid_argument for a wrong number of bounds, or one that is negative or NaN
    void set_rate_bound(std::vector<double> w) {
        if (!w.empty() && w.size() != flow_->states()) {
            throw std::invalid_argument("perturbed_step: needs one rate bound per state" +
                                        needed_given(flow_->states(), w.size()));
        }
        for (double const x : w) {
            if (!(x >= 0)) throw std::invalid_argument("perturbed_step: a negative rate bound");
        }
        rate_bound_ = std::move(w);
    }

    /// @param from    begin of the step, in each lane
    /// @param to      its end, at most the next knot of a sampled input
    /// @param times   encloses all times of the step
    /// @param tube    all nominal solutions of the family, at all these times
    /// @param trying  the lanes that matter
    /// @returns the lanes of `trying` for which a bound was found
    template <class Tube>
    [[nodiscard]] mask prove(scalar const& from, scalar const& to, T const& times, Tube const& tube,
                             mask trying) {
        auto const n = flow_->states();
        law_.unit.clear();
        for (std::size_t i = 0; i < n; ++i)
            law_.unit.push_back(scalar(unit_below(flow_->own_range(i))));
        scalar const h = to - from;
        begin_ = input_errors(*flow_, from, from);
        end_ = input_errors(*flow_, from, to);
        std::vector<scalar> room(n);
        mask found{};
        for (int round = 0; round < 8 && side_by_side::any(trying & !found); ++round) {
            trying = trying & look(from, to, times, tube, room);
            auto const reach = law_.largest_deviation(begin_, end_, h);
            if (round > 0) { // the first round, without room, only says where to begin
                mask inside = trying;
                for (std::size_t i = 0; i < n; ++i) inside = inside & (reach[i] < room[i]);
                found = found | inside;
                largest_ = reach;
            }
            for (std::size_t i = 0; i < n; ++i) {
                trying = trying & (reach[i] < scalar(1e300));
                room[i] = side_by_side::select(found, room[i], reach[i] * 1.25 + 1e-280);
            }
        }
        found = found & trying;
        if (side_by_side::any(found)) at_end_ = law_.deviation(begin_, end_, h);
        return found;
    }

    /// Of the last `prove`, in the lanes that it returned.
    [[nodiscard]] std::vector<scalar> const& largest() const { return largest_; }
    [[nodiscard]] std::vector<scalar> const& at_end() const { return at_end_; }
    [[nodiscard]] perturbation_law<scalar> const& law() const { return law_; }

private:
    /// Rates and their derivatives over the tube and `room` beside it.
    /// @returns the lanes in which the rates are defined
    template <class Tube>
    [[nodiscard]] mask look(scalar const& from, scalar const& to, T const& times, Tube const& tube,
                            std::vector<scalar> const& room) {
        auto const n = flow_->states();
        auto const& uncertain = flow_->uncertain_inputs();
        input_pieces<T> const recorded(*flow_, from, times);
        auto const possible =
            widened(recorded, *flow_, largest_input_errors(*flow_, from, from, to));
        std::vector<T> around;
        for (std::size_t i = 0; i < n; ++i) around.push_back(number::widened(tube[i], room[i]));
        auto const at = [](auto const& x) {
            return [&x](std::size_t i, std::size_t) -> T const& { return x[i]; };
        };
        series_->start(times);
        series_->advance_principal(0, at(around), possible);
        mask const undefined = series_->undefined();
        mask rough = series_->jumped();
        series_->advance_rest(0, at(around), possible);
        rough = rough | series_->undefined();
        law_.room = room;
        law_.growth.assign(n * n, scalar(0.0));
        law_.middle = law_.beside = law_.growth;
        law_.gain.assign(n * uncertain.size(), scalar(0.0));
        for (auto const& e : entries_) {
            auto const& a = series_->output(e.output, 0);
            if (e.column < n) {
                auto const place = e.row * n + e.column;
                law_.growth[place] = e.row == e.column ? number::upper(a) : number::mag(a);
                law_.middle[place] = number::middle(a);
                law_.beside[place] = number::beside(a, law_.middle[place]);
            } else {
                law_.gain[e.row * uncertain.size() + e.column - n] = number::mag(a);
            }
        }
        law_.rate.assign(n, scalar(0.0));
        for (std::size_t i = 0; i < rate_bound_.size(); ++i) law_.rate[i] = rate_bound_[i];
        for (auto const* part : {&law_.beside, &law_.gain}) {
            for (auto const& x : *part) rough = rough | !(x < scalar(1e300));
        }
        if (!side_by_side::any(rough)) return !undefined;
        std::vector<T> rates;
        for (std::size_t i = 0; i < n; ++i) rates.push_back(series_->output(i, 0));
        series_->start(times);
        series_->advance_principal(0, at(tube), recorded);
        for (auto* part : {&law_.growth, &law_.middle, &law_.beside, &law_.gain}) {
            for (auto& x : *part) x = side_by_side::select(rough, scalar(0.0), x);
        }
        for (std::size_t i = 0; i < n; ++i) {
            scalar const apart = number::mag(arithmetic::sub(rates[i], series_->output(i, 0)));
            law_.rate[i] += side_by_side::select(rough, apart, scalar(0.0));
        }
        return !undefined;
    }

    flow const* flow_;
    std::vector<jacobian_entry> entries_;
    std::shared_ptr<tape const> program_; // the series points to it
    std::unique_ptr<series<T>> series_;
    std::vector<double> rate_bound_;
    std::vector<scalar> begin_, end_; ///< error bounds of the inputs
    perturbation_law<scalar> law_;
    std::vector<scalar> largest_, at_end_;
};

} // namespace sivid

#endif
