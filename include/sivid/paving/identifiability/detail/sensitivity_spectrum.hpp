// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_IDENTIFIABILITY_DETAIL_SENSITIVITY_SPECTRUM_HPP
#define SIVID_PAVING_IDENTIFIABILITY_DETAIL_SENSITIVITY_SPECTRUM_HPP

#include <sivid/model/structure/symmetry.hpp>
#include <sivid/paving/identifiability/detail/output_sensitivities.hpp>
#include <sivid/space/dense.hpp>
#include <sivid/space/exact/detail/rational_basis.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sivid::paving_detail {

/// What the sensitivities at a few points say in floating point; nothing here is proved.
///   Their rows are divided by the half-widths of the bounds, and their columns multiplied by the
///   width of the prior, in the coordinate itself or in its logarithm.
class sensitivity_spectrum {
public:
    /// @param there  the sensitivities over `at` and `starts`, whose middles are the first point
    sensitivity_spectrum(identification_problem const& problem, sensitivity_runs const& runs,
                         box const& at, std::vector<box> const& starts,
                         output_sensitivities const& there)
        : unknowns_(runs.unknowns()) {
        auto const thin = [](box const& b) { return std::all_of(b.begin(), b.end(), is_known); };
        if (thin(at) && std::all_of(starts.begin(), starts.end(), thin)) {
            add_point(there, mid(at), starts);
        } else {
            add_point(runs, mid(at), starts);
        }
        // Two more, at no special place of the prior.
        for (double const share : {0.3819, 0.7242}) {
            std::vector<box> other = starts;
            std::size_t k = 0;
            auto const place = [&](interval const& side) {
                double const s = std::fmod(share + 0.6180339887 * static_cast<double>(k++), 1.0);
                return is_known(side) ? side : interval(side.lower() + s * width(side));
            };
            std::vector<double> p;
            for (auto const& side : problem.prior) p.push_back(mid(place(side)));
            for (std::size_t e = 0; e < other.size(); ++e) {
                for (std::size_t i = 0; i < other[e].size(); ++i) {
                    other[e][i] = place(problem.experiments[e].initial[i]);
                }
            }
            add_point(runs, p, other);
        }
    }

    [[nodiscard]] std::size_t rank() const {
        auto const s = approximate_svd(scaled(points_.front(), natural())).values;
        double const least = threshold(s, natural());
        return static_cast<std::size_t>(
            std::count_if(s.begin(), s.end(), [least](double x) { return x > least; }));
    }

    /// Of the first point, in the coordinates that suit each unknown.
    [[nodiscard]] std::vector<sensitive_direction> directions() const {
        auto const m = scaled(points_.front(), natural());
        approximate_svd const system(m);
        std::vector<sensitive_direction> result;
        for (Eigen::Index k = 0; k < system.right.cols(); ++k) {
            Eigen::VectorXd v = system.right.col(k);
            Eigen::Index largest = 0;
            v.cwiseAbs().maxCoeff(&largest);
            v /= v(largest);
            result.push_back({{v.begin(), v.end()}, noticed(m, v)});
        }
        std::stable_sort(result.begin(), result.end(),
                         [](sensitive_direction const& a, sensitive_direction const& b) {
                             return a.noticed > b.noticed;
                         });
        return result;
    }

    /// Vectors of small integers that no output notices at any of the points.
    [[nodiscard]] std::vector<free_motion> free_motions() const {
        std::vector<free_motion> result;
        for (auto const kind : {motion_kind::scaling, motion_kind::translation}) {
            auto const columns = columns_of(kind);
            Eigen::MatrixXd all(0, static_cast<Eigen::Index>(unknowns_.size()));
            for (auto const& p : points_) {
                auto const m = scaled(p, columns);
                Eigen::MatrixXd both(all.rows() + m.rows(), all.cols());
                both << all, m;
                all = std::move(both);
            }
            auto const chosen = selected(all, columns);
            approximate_svd const system(chosen);
            auto const& s = system.values;
            double const least = threshold(s, columns);
            std::vector<Eigen::VectorXd> space;
            for (Eigen::Index k = 0; k < chosen.cols(); ++k) {
                if (s(k) <= least) space.push_back(system.right.col(k));
            }
            for (auto& m : rounded(space, columns, kind, 1e-3)) {
                m.noticed = noticed(all, crossing(m));
                if (m.noticed <= 10 * least && !known(m, result, 1e-6)) {
                    result.push_back(std::move(m));
                }
            }
        }
        return result;
    }

    /// The same at the first point for those that no output notices by a half-width of its bound.
    [[nodiscard]] std::vector<free_motion> nearly_free_motions() const {
        std::vector<free_motion> result;
        auto all_known = free_motions();
        for (auto const kind : {motion_kind::scaling, motion_kind::translation}) {
            auto const columns = columns_of(kind);
            auto const m = scaled(points_.front(), columns);
            auto const chosen = selected(m, columns);
            approximate_svd const system(chosen);
            std::vector<Eigen::VectorXd> space;
            for (Eigen::Index k = 0; k < chosen.cols(); ++k) {
                Eigen::VectorXd const v = system.right.col(k);
                if (noticed(chosen, v / v.cwiseAbs().maxCoeff()) < 1) space.push_back(v);
            }
            for (auto& found : rounded(space, columns, kind, 0.1)) {
                found.noticed = noticed(m, crossing(found));
                if (!(found.noticed < 1) || known(found, all_known, 0.3)) continue;
                all_known.push_back(found);
                result.push_back(std::move(found));
            }
        }
        return result;
    }

private:
    struct point {
        Eigen::MatrixXd rows;       ///< divided by the half-widths of the bounds
        Eigen::MatrixXd errors;     ///< half-widths of the entries' enclosures, divided likewise
        std::vector<double> values; ///< of the unknowns
    };
    /// How an unknown is measured; `left_out` of the motions considered.
    enum class coordinate { plain, logarithm, left_out };
    using coordinates = std::vector<coordinate>;

    void add_point(sensitivity_runs const& runs, std::vector<double> const& parameters,
                   std::vector<box> const& starts) {
        std::vector<box> middles;
        for (auto const& b : starts) middles.push_back(point_box(mid(b)));
        add_point(runs(point_box(parameters), middles), parameters, middles);
    }
    void add_point(output_sensitivities const& s, std::vector<double> const& parameters,
                   std::vector<box> const& starts) {
        point p;
        p.rows.resize(static_cast<Eigen::Index>(s.values.rows()),
                      static_cast<Eigen::Index>(unknowns_.size()));
        p.errors = p.rows;
        Eigen::Index used = 0;
        for (std::size_t i = 0; i < s.values.rows(); ++i) {
            bool bounded = true;
            for (std::size_t c = 0; c < unknowns_.size(); ++c) {
                bounded = bounded && std::isfinite(mag(s.values(i, c)));
                auto const column = static_cast<Eigen::Index>(c);
                p.rows(used, column) = mid(s.values(i, c)) * s.weights[i];
                p.errors(used, column) = rad(s.values(i, c)) * s.weights[i];
            }
            used += bounded ? 1 : 0;
        }
        p.rows.conservativeResize(used, Eigen::NoChange);
        p.errors.conservativeResize(used, Eigen::NoChange);
        for (auto const& q : unknowns_) {
            p.values.push_back(q.experiment ? mid(starts[*q.experiment][q.index])
                                            : parameters[q.index]);
        }
        points_.push_back(std::move(p));
    }

    [[nodiscard]] coordinates natural() const {
        coordinates c;
        for (auto const& q : unknowns_) {
            c.push_back(q.relative() ? coordinate::logarithm : coordinate::plain);
        }
        return c;
    }
    [[nodiscard]] coordinates columns_of(motion_kind kind) const {
        if (kind == motion_kind::translation)
            return coordinates(unknowns_.size(), coordinate::plain);
        auto c = natural();
        std::replace(c.begin(), c.end(), coordinate::plain, coordinate::left_out);
        return c;
    }
    [[nodiscard]] double prior_width(std::size_t c, coordinate kind) const {
        auto const& prior = unknowns_[c].prior;
        if (kind == coordinate::plain) return width(prior);
        return std::abs(std::log(prior.upper() / prior.lower()));
    }

    [[nodiscard]] Eigen::MatrixXd scaled(point const& p, coordinates const& how) const {
        return scaled(p.rows, p.values, how);
    }
    [[nodiscard]] Eigen::MatrixXd scaled(Eigen::MatrixXd m, std::vector<double> const& values,
                                         coordinates const& how) const {
        for (std::size_t c = 0; c < how.size(); ++c) {
            double const factor = how[c] == coordinate::left_out ? 0.0 : prior_width(c, how[c]);
            m.col(static_cast<Eigen::Index>(c)) *=
                how[c] == coordinate::logarithm ? factor * values[c] : factor;
        }
        return m;
    }
    /// Singular values up to this count as 0: what the enclosures leave open, but not less than a
    /// 10^-8th of the largest, nor more than a 10^-6th.
    [[nodiscard]] double threshold(Eigen::VectorXd const& singular, coordinates const& how) const {
        double open = 0;
        for (auto const& p : points_) open += scaled(p.errors, p.values, how).norm();
        double const largest = singular.size() == 0 ? 0.0 : singular(0);
        return std::clamp(open, 1e-8 * largest, 1e-6 * largest);
    }
    [[nodiscard]] static Eigen::MatrixXd selected(Eigen::MatrixXd const& m,
                                                  coordinates const& how) {
        Eigen::MatrixXd result(m.rows(), m.cols());
        Eigen::Index used = 0;
        for (std::size_t c = 0; c < how.size(); ++c) {
            if (how[c] != coordinate::left_out)
                result.col(used++) = m.col(static_cast<Eigen::Index>(c));
        }
        return result.leftCols(used);
    }
    [[nodiscard]] static double noticed(Eigen::MatrixXd const& m, Eigen::VectorXd const& v) {
        return m.rows() == 0 ? 0.0 : (m * v).cwiseAbs().maxCoeff();
    }

    [[nodiscard]] std::vector<free_motion> rounded(std::vector<Eigen::VectorXd> const& space,
                                                   coordinates const& how, motion_kind kind,
                                                   double tolerance) const {
        if (space.empty()) return {};
        Eigen::MatrixXd basis(space.front().size(), static_cast<Eigen::Index>(space.size()));
        for (std::size_t k = 0; k < space.size(); ++k) {
            basis.col(static_cast<Eigen::Index>(k)) = space[k];
        }
        std::vector<std::size_t> columns;
        for (std::size_t c = 0; c < how.size(); ++c) {
            if (how[c] == coordinate::left_out) continue;
            basis.row(static_cast<Eigen::Index>(columns.size())) *= prior_width(c, how[c]);
            columns.push_back(c);
        }
        std::vector<free_motion> result;
        for (auto const& w : approximate_integer_basis(basis, tolerance, 4)) {
            free_motion m{kind, std::vector<int>(unknowns_.size(), 0), 0};
            for (std::size_t k = 0; k < columns.size(); ++k) m.weights[columns[k]] = w[k];
            result.push_back(std::move(m));
        }
        return result;
    }

    /// The motion in widths of the prior until it has crossed the first of them.
    [[nodiscard]] Eigen::VectorXd crossing(free_motion const& m) const {
        Eigen::VectorXd v = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(m.weights.size()));
        auto const how = m.kind == motion_kind::scaling ? coordinate::logarithm : coordinate::plain;
        for (std::size_t c = 0; c < m.weights.size(); ++c) {
            if (m.weights[c] != 0)
                v(static_cast<Eigen::Index>(c)) = m.weights[c] / prior_width(c, how);
        }
        return v / v.cwiseAbs().maxCoeff();
    }
    /// Whether at the first point the motion goes nearly where others together go.
    [[nodiscard]] bool known(free_motion const& m, std::vector<free_motion> const& others,
                             double tolerance) const {
        auto const velocity = [&](free_motion const& x) {
            Eigen::VectorXd v(static_cast<Eigen::Index>(unknowns_.size()));
            for (std::size_t c = 0; c < unknowns_.size(); ++c) {
                double const size =
                    x.kind == motion_kind::scaling ? points_.front().values[c] : 1.0;
                v(static_cast<Eigen::Index>(c)) =
                    x.weights[c] * size / prior_width(c, coordinate::plain);
            }
            return Eigen::VectorXd(v.normalized());
        };
        if (others.empty()) return false;
        Eigen::MatrixXd span(static_cast<Eigen::Index>(unknowns_.size()),
                             static_cast<Eigen::Index>(others.size()));
        for (std::size_t k = 0; k < others.size(); ++k) {
            span.col(static_cast<Eigen::Index>(k)) = velocity(others[k]);
        }
        auto const v = velocity(m);
        return (v - span * approximate_least_squares(span, v)).norm() < tolerance;
    }

    std::vector<unknown_quantity> unknowns_;
    std::vector<point> points_;
};

} // namespace sivid::paving_detail

#endif
