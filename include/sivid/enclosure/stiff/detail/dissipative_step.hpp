// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_STIFF_DETAIL_DISSIPATIVE_STEP_HPP
#define SIVID_ENCLOSURE_STIFF_DETAIL_DISSIPATIVE_STEP_HPP

#include <sivid/enclosure/stiff/detail/dissipative_step_class.hpp>
#include <sivid/space/dense.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

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
    // The Jacobian by states and parameters on all of it, as centre and radius, and M.
    I const times = traits::bounds(from, to);
    input_pieces<I> const inputs(*flow_, from, times);
    jacobian_.evaluate(times, around, inputs);
    if (jacobian_.undefined() || jacobian_.jumped()) return std::nullopt;
    auto const size = static_cast<Eigen::Index>(columns);
    auto const states = static_cast<Eigen::Index>(n);
    Eigen::MatrixXd centre = Eigen::MatrixXd::Zero(size, size);
    Eigen::MatrixXd radius = centre;
    Eigen::MatrixXd bound = centre;
    for (auto const& e : flow_->entries()) {
        auto const i = static_cast<Eigen::Index>(e.row);
        auto const c = static_cast<Eigen::Index>(e.column);
        I const& a = jacobian_.output(e.output, 0);
        centre(i, c) = traits::mid(a);
        radius(i, c) = traits::mag(traits::sub(a, traits::point(centre(i, c))));
        bound(i, c) = i == c ? traits::upper(a) : traits::mag(a);
    }
    if (!bound.allFinite() || !centre.allFinite() || !radius.allFinite()) return std::nullopt;
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

} // namespace sivid

#endif
