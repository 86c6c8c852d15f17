// SPDX-License-Identifier: MIT
// Random products of matrices: the radii contain every product of members, in every rounding mode,
// and are hardly wider than those of intervals.
#include <sivid/enclosure/sensitivity/sensitive_flow.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

#include <sivid/number/interval.hpp>
#include <sivid/space/frame/orthogonal_frame.hpp>
#include <sivid/space/matrix.hpp>

#include <algorithm>
#include <array>
#include <cfenv>
#include <cmath>
#include <limits>
#include <vector>

using namespace sivid;
using traits = interval_traits<interval>;
using support::draws;
using real_matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::MatrixXd drawn(draws& d, std::size_t rows, std::size_t columns, double least, double most) {
    Eigen::MatrixXd m(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
        for (Eigen::Index j = 0; j < m.cols(); ++j) m(i, j) = d.uniform(least, most);
    }
    return m;
}
real_matrix within(draws& d, Eigen::MatrixXd const& centre, Eigen::MatrixXd const& radius) {
    real_matrix m = centre.cast<long double>();
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
        for (Eigen::Index j = 0; j < m.cols(); ++j) {
            double const share = d.coin() ? (d.coin() ? 1 : -1) : d.uniform(-1, 1);
            m(i, j) += share * static_cast<long double>(radius(i, j));
        }
    }
    return m;
}
/// The same by products of interval matrices, frame by frame.
class framed_intervals {
public:
    framed_intervals(std::size_t n, std::size_t columns)
        : axes_(Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(n),
                                          static_cast<Eigen::Index>(n))),
          inside_(n, columns) {}
    void map(interval_matrix<interval> const& a, interval_matrix<interval> const& rest) {
        auto const turned = product(a, axes_);
        std::vector<double> weights(inside_.rows(), 0.0);
        for (std::size_t c = 0; c < inside_.cols(); ++c) { // each column in its own unit
            double most = 0;
            for (std::size_t i = 0; i < inside_.rows(); ++i)
                most = std::max(most, mag(inside_(i, c)));
            for (std::size_t i = 0; i < inside_.rows() && most > 0; ++i)
                weights[i] = std::max(weights[i], mag(inside_(i, c)) / most);
        }
        auto const frame = make_frame<interval>(approximate_mid(turned), weights);
        auto const old = product(product(frame.inverse, turned), inside_);
        auto const fresh = product(frame.inverse, rest);
        for (std::size_t i = 0; i < inside_.rows(); ++i) {
            for (std::size_t c = 0; c < inside_.cols(); ++c) {
                inside_(i, c) = traits::add(old(i, c), fresh(i, c));
            }
        }
        axes_ = frame.axes;
    }
    [[nodiscard]] double size(std::size_t i, std::size_t c) const {
        interval sum(0.0);
        for (std::size_t k = 0; k < inside_.rows(); ++k) {
            double const b = axes_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
            sum = traits::add(sum, traits::mul(traits::point(b), inside_(k, c)));
        }
        return mag(sum);
    }

private:
    Eigen::MatrixXd axes_;
    interval_matrix<interval> inside_;
};
[[gnu::noinline]] void in_mode(int mode, auto const& f) {
    std::fesetround(mode);
    f();
    std::fesetround(FE_TONEAREST);
}

} // namespace

TEST_CASE("Framed radii: products of members are within, no wider than by intervals") {
    draws d(71);
    for (int round = 0; round < 120; ++round) {
        auto const n = 1 + d.below(6), m = 1 + d.below(9);
        auto const rows = static_cast<Eigen::Index>(n), columns = static_cast<Eigen::Index>(m);
        int const mode = std::array{FE_TONEAREST, FE_UPWARD, FE_DOWNWARD,
                                    FE_TOWARDZERO}[static_cast<std::size_t>(round % 4)];
        framed_radii set(n, m);
        framed_intervals reference(n, m);
        std::vector<real_matrix> members(6, real_matrix::Zero(rows, columns));
        double const width = std::pow(10, -d.uniform(1, 14));
        double const size = std::pow(10, -d.uniform(0, 12));
        for (int step = 0; step < 10; ++step) {
            Eigen::MatrixXd centre = drawn(d, n, n, -0.4, 0.4);
            centre += Eigen::MatrixXd::Identity(rows, rows);
            Eigen::MatrixXd const spread = drawn(d, n, n, 0, width);
            Eigen::MatrixXd const rest = drawn(d, n, m, 0, size);
            in_mode(mode, [&] { set.map(centre, spread, rest); });
            interval_matrix<interval> a(n, n), lost(n, m);
            for (std::size_t i = 0; i < n; ++i) {
                auto const row = static_cast<Eigen::Index>(i);
                for (std::size_t l = 0; l < n; ++l) {
                    auto const k = static_cast<Eigen::Index>(l);
                    a(i, l) = traits::add(traits::point(centre(row, k)),
                                          interval(-spread(row, k), spread(row, k)));
                }
                for (std::size_t c = 0; c < m; ++c) {
                    double const r = rest(row, static_cast<Eigen::Index>(c));
                    lost(i, c) = interval(-r, r);
                }
            }
            reference.map(a, lost);
            for (auto& s : members) {
                s = within(d, centre, spread) * s;
                s += within(d, Eigen::MatrixXd::Zero(rows, columns), rest);
            }
        }
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t c = 0; c < m; ++c) {
                CAPTURE(n, m, round, mode, i, c, width, size);
                double r = 0;
                in_mode(mode, [&] { r = set(i, c); });
                for (auto const& s : members) {
                    auto const x = s(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c));
                    CHECK(std::fabs(x) <= static_cast<long double>(r) * (1 + 1e-15L));
                }
                if (mode == FE_TONEAREST) CHECK(r <= reference.size(i, c) * (1 + 1e-9));
            }
        }
    }
}

TEST_CASE("Framed radii: what the frame's own roundings add is there") {
    // The same turn again and again, exactly as long as the doubles say: nothing may get lost.
    for (int const mode : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        framed_radii set(2, 1);
        Eigen::MatrixXd turn(2, 2), none = Eigen::MatrixXd::Zero(2, 2), rest(2, 1);
        turn << 0.6, -0.8, 0.8, 0.6;
        rest << 1, 0;
        real_matrix x = rest.cast<long double>();
        set.map(turn, none, rest);
        rest << 0, 0;
        for (int step = 0; step < 2000; ++step) {
            in_mode(mode, [&] { set.map(turn, none, rest); });
            x = turn.cast<long double>() * x;
        }
        double const first = set(0, 0), second = set(1, 0);
        CHECK(std::fabs(x(0, 0)) <= static_cast<long double>(first));
        CHECK(std::fabs(x(1, 0)) <= static_cast<long double>(second));
        CHECK(first < 1.5);
        CHECK(second < 1.5);
    }
}

TEST_CASE("Framed radii: rotations do not wrap") {
    // 400 turns of 0.1 rad that lose 1e-9 each: boxes would grow by (cos + sin)^400 = 1e16.
    Eigen::MatrixXd turn(2, 2), none = Eigen::MatrixXd::Zero(2, 2);
    double const c = std::cos(0.1), s = std::sin(0.1);
    turn << c, -s, s, c;
    framed_radii set(2, 1);
    for (int step = 0; step < 400; ++step) {
        set.map(turn, none, Eigen::MatrixXd::Constant(2, 1, 1e-9));
    }
    CHECK(set(0, 0) < 1e-5);
    CHECK(set(0, 0) > 4e-7);
}

TEST_CASE("Framed radii: what is not known stays so, in its column") {
    for (bool const by_map : {false, true}) {
        framed_radii set(3, 3);
        Eigen::MatrixXd centre = Eigen::MatrixXd::Identity(3, 3);
        Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(3, 3);
        Eigen::MatrixXd rest = Eigen::MatrixXd::Zero(3, 3);
        rest.col(1).setConstant(1e-9);
        rest(2, 2) = infinity;
        set.map(centre, spread, rest);
        CHECK(set(0, 0) == 0);
        CHECK(set(2, 1) < 2e-9);
        CHECK(set(2, 2) == infinity);
        if (!by_map) continue;
        rest.setZero();
        spread(1, 1) = infinity;
        set.map(centre, spread, rest);
        CHECK(set(0, 0) == 0); // there was nothing to be carried
        CHECK(set(1, 1) == infinity);
        centre(0, 0) = std::numeric_limits<double>::quiet_NaN();
        set.map(centre, spread, rest);
        CHECK(set(0, 1) == infinity);
        CHECK(set(1, 1) == infinity);
    }
    framed_radii set(2, 1);
    Eigen::MatrixXd rest(2, 1), none = Eigen::MatrixXd::Zero(2, 2);
    rest << 1e-200, 1e-200;
    set.map(Eigen::MatrixXd::Identity(2, 2), none, rest);
    rest.setZero();
    for (int const mode : {FE_TONEAREST, FE_DOWNWARD, FE_TOWARDZERO}) {
        auto huge = set;
        in_mode(mode, [&] { huge.map(Eigen::MatrixXd::Constant(2, 2, 1.5e308), none, rest); });
        CHECK(huge(0, 0) == infinity);
    }
}
