// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STIFF_DETAIL_DISSIPATIVE_STEP_HPP
#define SIVID_ENCLOSURE_STIFF_DETAIL_DISSIPATIVE_STEP_HPP

/// @file
/// Steps of implicit methods that are long against the time constants of a dissipative problem.

#include <sivid/compiled.hpp>
#include <sivid/enclosure/runge_kutta/runge_kutta.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/model/series/series.hpp>
#include <sivid/space/box.hpp>
#include <sivid/space/dense.hpp>
#include <sivid/space/matrix.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

namespace enclosure_detail {

/// Turns A into \f$ D^{-1} A D \f$, D diagonal of powers of two, whose rows and columns are about
/// as large as each other: as small as the units of its rows allow. What only acts, or is only
/// acted on, is measured so that it is as large as the rest.
/// @param h  the time of the exponential; a rate for matrices that have none of their own
/// @returns  D. No entry is rounded, but for those that leave the normal numbers: then A stays.
/// @ref  Osborne 1960; Parlett and Reinsch 1969
[[nodiscard]] inline std::vector<double> balance(Eigen::MatrixXd& a, double h) {
    auto const n = a.rows();
    std::vector<double> d(static_cast<std::size_t>(n), 1.0);
    if (n < 2 || !a.allFinite()) return d;
    auto const before = a;
    auto const sums = [&](Eigen::Index i) {
        double const own = std::abs(a(i, i));
        return std::pair{a.row(i).cwiseAbs().sum() - own, a.col(i).cwiseAbs().sum() - own};
    };
    auto const scale = [&](Eigen::Index i, double ratio) {
        double const f = std::ldexp(1.0, std::ilogb(ratio));
        if (!(f > 1e-60 && f < 1e60)) return;
        a.col(i) *= f;
        a.row(i) /= f;
        d[static_cast<std::size_t>(i)] *= f;
    };
    for (int sweep = 0; sweep < 6; ++sweep) {
        for (Eigen::Index i = 0; i < n; ++i) {
            auto const [row, column] = sums(i);
            if (row > 0 && column > 0) scale(i, std::sqrt(row / column));
        }
    }
    double rate = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
        auto const [row, column] = sums(i);
        rate = std::max({rate, std::abs(a(i, i)), std::sqrt(row) * std::sqrt(column)});
    }
    if (!(rate > 0)) rate = 1 / h;
    for (Eigen::Index i = 0; i < n; ++i) {
        auto const [row, column] = sums(i);
        if (column > 0 && !(row > 0)) scale(i, rate / column);
        if (row > 0 && !(column > 0)) scale(i, row / rate);
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) {
            double const f = d[static_cast<std::size_t>(j)] / d[static_cast<std::size_t>(i)];
            if (a(i, j) == before(i, j) * f && a(i, j) / f == before(i, j)) continue;
            a = before;
            d.assign(d.size(), 1.0);
            return d;
        }
    }
    return d;
}

} // namespace enclosure_detail

/// Encloses \f$ e^{h A} \f$ for a matrix of doubles and every h of an interval, by scaling and
/// squaring: with \f$ Z = 2^{-m} h A \f$ and \f$ \|Z\|_\infty \le z \le 1/2 \f$,
///   \f$ e^Z \in \sum_{k<K} Z^k/k! + [-r, r] \f$ entry by entry, \f$ r = 2 z^K / K! \f$.
///   A norm means little where the rows have units of their own, so all is done for
///   \f$ D^{-1} A D \f$ with a diagonal D of powers of two (`balance`).
/// @param terms  K, at least 1; with the default r is below the rounding
/// @given  h >= 0
/// @returns nothing when the entries are not finite, or too large
/// @cost  O((K + m) n^3)
/// @ref   Higham, Functions of Matrices (2008), section 10.3
template <class I>
[[nodiscard]] std::optional<interval_matrix<I>> enclose_exponential(Eigen::MatrixXd a, I const& h,
                                                                    std::size_t terms = 16) {
    using traits = interval_traits<I>;
    auto const n = static_cast<std::size_t>(a.rows());
    double size = 0;
    for (std::size_t l = 0; l < traits::lanes; ++l) size = std::max(size, traits::upper(h, l));
    auto const d = enclosure_detail::balance(a, size);
    double const norm = (a.array().abs().rowwise().sum().maxCoeff()) * size;
    if (!std::isfinite(norm) || norm > 1e9) return std::nullopt;
    int const squarings = norm > 0.4 ? static_cast<int>(std::ceil(std::log2(norm / 0.4))) : 0;
    I const scale = traits::mul(h, traits::point(std::ldexp(1.0, -squarings)));
    interval_matrix<I> z(n, n);
    I largest = traits::point(0.0);
    for (std::size_t i = 0; i < n; ++i) {
        I row = traits::point(0.0);
        for (std::size_t j = 0; j < n; ++j) {
            auto const entry = a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
            z(i, j) = traits::mul(scale, traits::point(entry));
            row = traits::add(row, traits::abs(z(i, j)));
        }
        largest = traits::max(largest, row);
    }
    // Horner's rule, with the remainder first.
    typename traits::mask never{};
    I remainder = traits::point(2.0);
    for (std::size_t k = 1; k <= terms; ++k) {
        remainder = traits::div(traits::mul(remainder, largest),
                                traits::point(static_cast<double>(k)), never);
    }
    for (std::size_t l = 0; l < traits::lanes; ++l) {
        if (!(traits::upper(largest, l) <= 0.5)) return std::nullopt;
    }
    interval_matrix<I> sum = interval_matrix<I>::identity(n);
    for (std::size_t k = terms - 1; k >= 1; --k) {
        sum = product(z, sum);
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                sum(i, j) = traits::div(sum(i, j), traits::point(static_cast<double>(k)), never);
            }
            sum(i, i) = traits::add(sum(i, i), traits::point(1.0));
        }
    }
    I const spread = traits::hull(traits::neg(remainder), remainder);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) sum(i, j) = traits::add(sum(i, j), spread);
    }
    for (int k = 0; k < squarings; ++k) sum = product(sum, sum);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j)
            sum(i, j) = traits::mul(sum(i, j), traits::point(d[i] / d[j]));
    }
    return sum;
}

/// Upper bounds of the entries of \f$ e^{h M} \f$, for a matrix M whose entries off the diagonal
/// are not negative: so are those of its exponential.
template <class I = interval>
[[nodiscard]] std::optional<Eigen::MatrixXd> bound_exponential(Eigen::MatrixXd const& m,
                                                               I const& h) {
    auto const e = enclose_exponential<I>(m, h);
    if (!e) return std::nullopt;
    Eigen::MatrixXd result(m.rows(), m.cols());
    for (std::size_t i = 0; i < e->rows(); ++i) {
        for (std::size_t j = 0; j < e->cols(); ++j) {
            double top = 0;
            for (std::size_t l = 0; l < interval_traits<I>::lanes; ++l) {
                top = std::max(top, interval_traits<I>::upper((*e)(i, j), l));
            }
            if (!std::isfinite(top)) return std::nullopt;
            result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = top;
        }
    }
    return result;
}

/// Finds boxes that no solution leaves during a step, however long against the time constants of
/// the problem. A box B that holds the initial states X is proved face by face; the face
/// \f$ x_i = \overline b_i \f$ is closed
///   - when \f$ f_i < 0 \f$ everywhere on it during the step, or
///   - when no solution in B is fast enough: \f$ \overline x_i + h \max(0, \sup f_i(B)) <
///     \overline b_i \f$,
/// and lower faces likewise. A solution that left B would do so first through a face, at a time
/// until which it was in B; there its derivative would point out, or it would have come too far.
/// @ref  Nagumo 1942; Walter, Differential and Integral Inequalities (1970)
template <class I>
class invariant_box {
    using traits = arithmetic_of<I>;
    static_assert(traits::lanes == 1, "faces are decided for one box at a time");

public:
    explicit invariant_box(flow const& f)
        : flow_(&f), rate_(f.rate(), 0), jacobian_(f.rate_jacobian(), 0) {}

    void set_parameters(basic_box<I> const& p) {
        rate_.set_parameters(p);
        jacobian_.set_parameters(p);
    }

    /// @param x       the states at `from`
    /// @param guess   where the search begins
    /// @param margin  a length for each state below which nothing has to be resolved
    /// @returns a box that holds all solutions from `x` over [from, to], if one was found
    [[nodiscard]] std::optional<basic_box<I>> find(double from, double to, basic_box<I> const& x,
                                                   basic_box<I> const& guess,
                                                   std::vector<double> const& margin) {
        auto const n = flow_->states();
        I const times = traits::bounds(from, to);
        I const length = traits::sub(traits::point(to), traits::point(from));
        input_pieces<I> const inputs(*flow_, from, times);
        auto b = hull(x, guess);
        for (std::size_t i = 0; i < n; ++i) {
            b[i] = traits::add(b[i], traits::bounds(-margin[i], margin[i]));
        }
        for (int round = 0; round < 12; ++round) {
            auto const everywhere = rates(times, b, inputs);
            if (!everywhere) return std::nullopt;
            auto const diagonal = own_slopes(times, b, inputs);
            auto next = b;
            bool closed = true;
            for (std::size_t i = 0; i < n; ++i) {
                for (bool const top : {true, false}) {
                    auto face = b;
                    double const bound = top ? traits::upper(b[i]) : traits::lower(b[i]);
                    face[i] = traits::point(bound);
                    auto const there = rates(times, face, inputs);
                    if (!there) return std::nullopt;
                    double const out =
                        top ? traits::upper((*there)[i]) : -traits::lower((*there)[i]);
                    if (out < 0) continue;
                    // As far as a solution comes in the time, seen from outside the box.
                    I const speed = top ? traits::max((*everywhere)[i], traits::point(0.0))
                                        : traits::min((*everywhere)[i], traits::point(0.0));
                    I const reach = traits::add(x[i], traits::mul(length, speed));
                    double const far = top ? traits::upper(reach) : -traits::lower(reach);
                    double const now = top ? bound : -bound;
                    if (far < now) continue;
                    if (!std::isfinite(far) || !std::isfinite(out)) return std::nullopt;
                    closed = false;
                    // Whichever way of closing the face is nearer.
                    double ahead = (round < 4 ? 1.1 : 2.5) * (far - now) + margin[i];
                    double const slope = -traits::upper(diagonal[i]);
                    if (slope > 0) ahead = std::min(ahead, 1.01 * out / slope + margin[i]);
                    double const moved = now + ahead;
                    next[i] = traits::hull(next[i], traits::point(top ? moved : -moved));
                }
            }
            if (closed) return b;
            b = next;
        }
        return std::nullopt;
    }

private:
    [[nodiscard]] std::optional<basic_box<I>> rates(I const& times, basic_box<I> const& x,
                                                    input_pieces<I> const& inputs) {
        rate_.evaluate(times, x, inputs);
        if (rate_.undefined() || rate_.jumped()) return std::nullopt;
        basic_box<I> result(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) result[i] = rate_.output(i, 0);
        return result;
    }
    /// \f$ \partial f_i / \partial x_i \f$: guides the search only.
    [[nodiscard]] basic_box<I> own_slopes(I const& times, basic_box<I> const& x,
                                          input_pieces<I> const& inputs) {
        jacobian_.evaluate(times, x, inputs);
        basic_box<I> result(x.size());
        for (auto const& e : flow_->entries()) {
            if (e.row == e.column) result[e.row] = jacobian_.output(e.output, 0);
        }
        return result;
    }

    flow const* flow_;
    series<I> rate_;
    series<I> jacobian_;
};

/// Steps of implicit methods that are long against the time constants of a dissipative problem,
/// where the Taylor coefficients of the solution say nothing any more. With u the polynomial whose
/// slopes at the nodes are the stages, \f$ d = u' - f(u) \f$ its defect and B a box that no
/// solution leaves:
///   \f$ |x(s) - u(s)| \le E(s),\; E' = M E + |d|,\; E(0) = 0 \f$
/// where \f$ M_{ii} \ge \partial_i f_i, M_{ij} \ge |\partial_j f_i| \f$ on the hull of B and u; a
/// negative diagonal of M makes E small whatever the length of the step. The derivatives V of the
/// flow, of states and parameters together, satisfy with \f$ A_c \pm D \f$ an enclosure of the
/// Jacobian
///   \f$ |V(h) - e^{h A_c}| \le \int_0^h e^{(h-s) M} D e^{s M} ds \f$,
/// the block above the diagonal of \f$ \exp(h [M, D; 0, M]) \f$.
/// @ref  Dahlquist 1959; Neumaier, Computing Suppl. 9 (1993) (dissipative problems); Van Loan 1978
template <class I>
class dissipative_step {
    using traits = arithmetic_of<I>;

public:
    /// @throws std::invalid_argument for a tableau of another shape, or not of its stated order
    dissipative_step(flow const& f, tableau const& method)
        : flow_(&f),
          stages_(f, method),
          boxes_(f),
          centre_rate_(f.rate(), method.stages() + 2),
          jacobian_(f.rate_jacobian(), 0) {
        for (auto const& c : method.c) nodes_.push_back(mid(c.template enclose<interval>()));
    }

    void set_parameters(basic_box<I> const& p, std::vector<double> const& centre) {
        stages_.set_parameters(point_box<I>(centre));
        centre_rate_.set_parameters(point_box<I>(centre));
        boxes_.set_parameters(p);
        jacobian_.set_parameters(p);
    }

    /// Order of the error in the length of the step.
    [[nodiscard]] std::size_t order() const { return nodes_.size(); }

    /// Largest row sum of the Jacobian at the states x, each measured in its own range: one over
    /// the shortest time constant.
    [[nodiscard]] double stiffness(double t, basic_box<I> const& x);

    /// A box that holds all solutions from `x` over [from, to].
    /// @param m       a point of `x`
    /// @param margin  a length for each state below which nothing has to be resolved
    [[nodiscard]] std::optional<basic_box<I>> enclose(double from, double to, basic_box<I> const& x,
                                                      std::vector<double> const& m,
                                                      std::vector<double> const& margin);

    /// The map of the step, on solutions that stay in `tube`.
    /// @returns nothing when the stages could not be proved or the Jacobian does not exist
    [[nodiscard]] std::optional<step_map<I>>
    map(double from, double to, std::vector<double> const& m, basic_box<I> const& tube);

private:
    /// The Jacobian by states and parameters as centre and radius, and M.
    struct jacobian_bounds {
        Eigen::MatrixXd centre, radius, bound;
    };
    [[nodiscard]] std::optional<jacobian_bounds> bound_jacobian(double from, double to,
                                                                basic_box<I> const& around);

    static constexpr std::size_t pieces = 8;
    static constexpr double up = 1 + 1e-12;

    /// u as a polynomial in s/h, [state][power].
    using path = std::vector<std::vector<double>>;

    [[nodiscard]] std::optional<path> interpolate(double from, I const& h,
                                                  std::vector<double> const& m);
    /// Coefficient k of u about each point of `at`.
    [[nodiscard]] static I shifted(std::vector<double> const& u, I const& at, std::size_t k);
    [[nodiscard]] static basic_box<I> range(path const& u, I const& at);
    /// Bounds of |d| on a piece of the step; nothing where it is not smooth.
    [[nodiscard]] std::optional<Eigen::VectorXd> defect(double from, I const& h, path const& u,
                                                        std::size_t piece);
    [[nodiscard]] static I part(std::size_t piece) {
        auto const share = [](std::size_t k) {
            return static_cast<double>(k) / static_cast<double>(pieces);
        };
        return traits::bounds(share(piece), share(piece + 1));
    }

    flow const* flow_;
    implicit_stages<I> stages_;
    invariant_box<I> boxes_;
    series<I> centre_rate_;
    series<I> jacobian_;
    std::vector<double> nodes_;
};

template <class I>
double dissipative_step<I>::stiffness(double t, basic_box<I> const& x) {
    I const time = traits::point(t);
    input_pieces<I> const inputs(*flow_, t, time);
    jacobian_.evaluate(time, x, inputs);
    std::vector<double> rows(flow_->states(), 0.0);
    for (auto const& e : flow_->entries()) {
        if (e.column >= rows.size()) continue;
        rows[e.row] += traits::mag(jacobian_.output(e.output, 0)) *
                       (flow_->own_range(e.column) / flow_->own_range(e.row));
    }
    double largest = 0;
    for (double const r : rows) largest = std::max(largest, r);
    return largest;
}

/// Any polynomial with u(0) = m will do: nothing rests on the rounding here.
template <class I>
auto dissipative_step<I>::interpolate(double from, I const& h, std::vector<double> const& m)
    -> std::optional<path> {
    auto const n = flow_->states();
    auto const s = nodes_.size();
    auto const start = point_box<I>(m);
    auto const k = stages_.prove(from, std::vector<I>(start.begin(), start.end()), h);
    if (!k) return std::nullopt;
    Eigen::MatrixXd powers(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(s));
    Eigen::MatrixXd slopes(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(n));
    for (std::size_t i = 0; i < s; ++i) {
        for (std::size_t j = 0; j < s; ++j) {
            powers(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                j == 0 ? 1 : std::pow(nodes_[i], static_cast<double>(j));
        }
        for (std::size_t l = 0; l < n; ++l) {
            slopes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(l)) =
                traits::mid(k->value[i * n + l]);
        }
    }
    Eigen::MatrixXd const w = approximate_solution(powers, slopes);
    if (!w.allFinite()) return std::nullopt;
    path u(n);
    for (std::size_t l = 0; l < n; ++l) {
        u[l].push_back(m[l]);
        for (std::size_t j = 0; j < s; ++j) {
            u[l].push_back(w(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(l)) *
                           traits::mid(h) / static_cast<double>(j + 1));
        }
    }
    return u;
}

template <class I>
I dissipative_step<I>::shifted(std::vector<double> const& u, I const& at, std::size_t k) {
    I value = traits::point(0.0);
    for (std::size_t j = u.size(); j-- > k;) {
        double choose = 1; // j over k, exact for the few powers of a method
        for (std::size_t l = 0; l < k; ++l) {
            choose = choose * static_cast<double>(j - l) / static_cast<double>(l + 1);
        }
        value = traits::add(traits::mul(traits::point(choose), traits::point(u[j])),
                            traits::mul(at, value));
    }
    return value;
}

template <class I>
basic_box<I> dissipative_step<I>::range(path const& u, I const& at) {
    // The mean-value form: tighter than Horner's rule over a piece.
    I const centre = traits::point(traits::mid(at));
    I const off = traits::sub(at, centre);
    basic_box<I> result(u.size());
    for (std::size_t l = 0; l < u.size(); ++l) {
        result[l] = traits::add(shifted(u[l], centre, 0), traits::mul(off, shifted(u[l], at, 1)));
    }
    return result;
}

template <class I>
std::optional<Eigen::VectorXd> dissipative_step<I>::defect(double from, I const& h, path const& u,
                                                           std::size_t piece) {
    auto const n = flow_->states();
    auto const order = nodes_.size() + 2;
    I const whole = part(piece);
    I const centre = traits::point(traits::mid(whole));
    I const off = traits::sub(whole, centre);
    typename traits::mask never{};
    // Taylor's formula for d in s/h about the centre of the piece.
    auto const expand = [&](I const& at) {
        I const time = traits::add(traits::point(from), traits::mul(h, at));
        input_pieces<I> const inputs(*flow_, from, time);
        centre_rate_.start(time, h);
        for (std::size_t k = 0; k <= order; ++k) {
            centre_rate_.advance(
                k, [&](std::size_t l, std::size_t j) { return shifted(u[l], at, j); },
                [&](std::size_t i, std::size_t j) {
                    return j == 1 ? traits::mul(h, inputs(i, 1)) : inputs(i, j);
                });
        }
        return !centre_rate_.undefined() && !centre_rate_.kinked() && !centre_rate_.jumped();
    };
    auto const coefficient = [&](I const& at, std::size_t l, std::size_t k) {
        I const slope =
            traits::mul(traits::point(static_cast<double>(k + 1)), shifted(u[l], at, k + 1));
        bool const zero = k > 0 && !flow_->rate().output_varies(l);
        I const rate = zero ? traits::point(0.0) : centre_rate_.output(l, k);
        return traits::sub(traits::div(slope, h, never), rate);
    };
    if (!expand(whole)) return std::nullopt;
    std::vector<I> sum;
    for (std::size_t l = 0; l < n; ++l) sum.push_back(coefficient(whole, l, order));
    if (!expand(centre)) return std::nullopt;
    Eigen::VectorXd result(static_cast<Eigen::Index>(n));
    for (std::size_t l = 0; l < n; ++l) {
        for (std::size_t k = order; k-- > 0;) {
            sum[l] = traits::add(coefficient(centre, l, k), traits::mul(off, sum[l]));
        }
        result[static_cast<Eigen::Index>(l)] = traits::mag(sum[l]);
    }
    return result;
}

template <class I>
std::optional<basic_box<I>>
dissipative_step<I>::enclose(double from, double to, basic_box<I> const& x,
                             std::vector<double> const& m, std::vector<double> const& margin) {
    I const h = traits::sub(traits::point(to), traits::point(from));
    auto const u = interpolate(from, h, m);
    if (!u) return std::nullopt;
    auto guess = point_box<I>(m);
    for (std::size_t k = 0; k < pieces; ++k) guess = hull(guess, range(*u, part(k)));
    return boxes_.find(from, to, x, guess, margin);
}

/// On all of a box, during a step; nothing where that is not finite.
template <class I>
std::optional<typename dissipative_step<I>::jacobian_bounds>
dissipative_step<I>::bound_jacobian(double from, double to, basic_box<I> const& around) {
    I const times = traits::bounds(from, to);
    input_pieces<I> const inputs(*flow_, from, times);
    jacobian_.evaluate(times, around, inputs);
    if (jacobian_.undefined() || jacobian_.jumped()) return std::nullopt;
    auto const size = static_cast<Eigen::Index>(flow_->states() + flow_->parameters());
    Eigen::MatrixXd const none = Eigen::MatrixXd::Zero(size, size);
    jacobian_bounds result{none, none, none};
    for (auto const& e : flow_->entries()) {
        auto const i = static_cast<Eigen::Index>(e.row);
        auto const c = static_cast<Eigen::Index>(e.column);
        I const& a = jacobian_.output(e.output, 0);
        result.centre(i, c) = traits::mid(a);
        result.radius(i, c) = traits::mag(traits::sub(a, traits::point(result.centre(i, c))));
        result.bound(i, c) = i == c ? traits::upper(a) : traits::mag(a);
    }
    if (!result.bound.allFinite() || !result.centre.allFinite() || !result.radius.allFinite())
        return std::nullopt;
    return result;
}

template <class I>
std::optional<step_map<I>> dissipative_step<I>::map(double from, double to,
                                                    std::vector<double> const& m,
                                                    basic_box<I> const& tube) {
    auto const n = flow_->states();
    auto const columns = n + flow_->parameters();
    I const h = traits::sub(traits::point(to), traits::point(from));
    auto const u = interpolate(from, h, m);
    if (!u) return std::nullopt;
    auto around = tube;
    std::vector<Eigen::VectorXd> defects;
    for (std::size_t k = 0; k < pieces; ++k) {
        around = hull(around, range(*u, part(k)));
        auto d = defect(from, h, *u, k);
        if (!d || !d->allFinite()) return std::nullopt;
        defects.push_back(std::move(*d));
    }
    auto const jacobian = bound_jacobian(from, to, around);
    if (!jacobian) return std::nullopt;
    auto const& [centre, radius, bound] = *jacobian;
    auto const size = static_cast<Eigen::Index>(columns);
    auto const states = static_cast<Eigen::Index>(n);
    step_map<I> result;
    // [e^{M s}, its integral] over one piece.
    Eigen::MatrixXd steady = Eigen::MatrixXd::Zero(2 * states, 2 * states);
    steady.topLeftCorner(states, states) = bound.topLeftCorner(states, states);
    steady.topRightCorner(states, states).setIdentity();
    auto const piece = bound_exponential<I>(steady, traits::mul(h, traits::point(1.0 / pieces)));
    if (!piece) return std::nullopt;
    result.error = Eigen::VectorXd::Zero(states);
    for (auto const& d : defects) {
        result.error = (piece->topLeftCorner(states, states) * result.error +
                        piece->topRightCorner(states, states) * d) *
                       up;
        result.error.array() += 1e-290;
    }
    auto const flat = enclose_exponential<I>(centre, h);
    Eigen::MatrixXd coupled = Eigen::MatrixXd::Zero(2 * size, 2 * size);
    coupled.topLeftCorner(size, size) = bound;
    coupled.bottomRightCorner(size, size) = bound;
    coupled.topRightCorner(size, size) = radius;
    auto const change = bound_exponential<I>(coupled, h);
    if (!flat || !change || !result.error.allFinite()) return std::nullopt;
    result.slack = change->topRightCorner(states, size);
    result.derivative = interval_matrix<I>(n, columns);
    result.image = basic_box<I>(n);
    for (std::size_t i = 0; i < n; ++i) {
        double const e = result.error[static_cast<Eigen::Index>(i)];
        result.image[i] =
            traits::add(shifted((*u)[i], traits::point(1.0), 0), traits::bounds(-e, e));
        for (std::size_t c = 0; c < columns; ++c) {
            double const d =
                result.slack(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c));
            result.derivative(i, c) = traits::add((*flat)(i, c), traits::bounds(-d, d));
        }
    }
    return result;
}

#ifdef SIVID_COMPILED_ALIKE // its members are compiled once
extern template class dissipative_step<interval>;
#endif

} // namespace sivid

#endif
