// SPDX-License-Identifier: MIT
// Verdicts over affine outputs against the sums by their definition, at corners and inner points.
#include <sivid/number/interval.hpp>
#include <sivid/paving/confidence/sign_perturbed_sums.hpp>

#include "support/catch.hpp"
#include "support/random.hpp"

using namespace sivid;

namespace {

/// Outputs, and all that is fixed about them.
struct drawn {
    Eigen::VectorXd measured;
    Eigen::MatrixXd weights;
    std::size_t sums = 0, above = 0;
    std::uint64_t seed = 0;
    output_forms y;

    explicit drawn(support::draws& d) {
        auto const n = static_cast<Eigen::Index>(2 + d.below(9));
        measured = d.matrix(n, 1);
        weights = d.matrix(n, static_cast<Eigen::Index>(1 + d.below(3)));
        weights.row(1).setZero(); // one does not count
        y.forms = d.matrix(n, static_cast<Eigen::Index>(1 + d.below(4)));
        y.forms.rightCols(y.forms.cols() - 1) *= d.coin() ? 0.05 : 1;
        y.rest = y.radius = d.matrix(n, 1).cwiseAbs() * (d.coin() ? 0 : 0.02);
        sums = 3 + d.below(12);
        above = 1 + d.below(sums - 1);
        seed = d.below(1000);
    }
    /// How many sums are above S_0 for these residuals, and its norm.
    [[nodiscard]] std::pair<std::size_t, double> rank_of(Eigen::VectorXd const& error) const {
        sign_source draw(seed);
        auto const own = draw();
        std::vector<bool> wins;
        for (std::size_t k = 1; k < sums; ++k) wins.push_back(draw() > own);
        std::size_t count = 0;
        double const mine = (weights.transpose() * error).norm();
        for (std::size_t k = 1; k < sums; ++k) {
            auto signed_error = error;
            Eigen::Index minus = 0;
            for (Eigen::Index i = 0; i < error.size(); ++i) {
                bool const is_minus = draw() >> 63U != 0;
                if (is_minus) signed_error[i] = -error[i];
                minus += is_minus && i != 1 ? 1 : 0;
            }
            bool const tie = minus == 0 || minus == error.size() - 1;
            bool const larger = (weights.transpose() * signed_error).norm() > mine;
            count += (tie ? wins[k - 1] : larger) ? 1 : 0;
        }
        return {count, mine};
    }
};

} // namespace

TEST_CASE("no point of a box has another rank than the verdict says") {
    support::draws d(77);
    std::size_t inside = 0, outside = 0, reached = 0;
    for (int round = 0; round < 4000; ++round) {
        drawn const x(d);
        sign_perturbed_sums const sums(x.measured, x.weights, x.seed, x.sums, x.above);
        auto const says = sums(x.y);
        inside += says.verdict == box_verdict::inside ? 1 : 0;
        outside += says.verdict == box_verdict::outside ? 1 : 0;
        for (int point = 0; point < 12; ++point) {
            Eigen::VectorXd at = Eigen::VectorXd::Ones(x.y.forms.cols());
            for (Eigen::Index v = 1; v < at.size(); ++v) at[v] = d.in(interval(-1, 1));
            Eigen::VectorXd error = x.measured - x.y.forms * at;
            for (Eigen::Index i = 0; i < error.size(); ++i)
                error[i] += d.in(interval(-x.y.rest[i], x.y.rest[i]));
            auto const [count, norm] = x.rank_of(error);
            bool const member = count >= x.above;
            CAPTURE(round, x.sums, x.above, count);
            CHECK((says.verdict != box_verdict::inside || member));
            CHECK((says.verdict != box_verdict::outside || !member));
            CHECK((!member || norm <= says.reach * (1 + 1e-12)));
            reached += member && norm > 0.5 * says.reach ? 1 : 0;
            Eigen::VectorXd const sum = x.weights.transpose() * error;
            auto const off = (sum - says.sum.transpose() * at).cwiseAbs().array();
            CHECK((off <= says.rest.array() + 1e-13).all());
        }
    }
    CHECK(inside > 300);
    CHECK(outside > 300);
    CHECK(reached > 1000);
}

TEST_CASE("what is not finite decides nothing") {
    support::draws d(3);
    output_forms const good{d.matrix(30, 2), Eigen::VectorXd::Zero(30), Eigen::VectorXd::Zero(30)};
    sign_perturbed_sums const sums(d.matrix(30, 1), d.matrix(30, 2), 5, 20, 10);
    for (double const bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        for (int const where : {0, 1, 2}) {
            auto y = good;
            (where == 2 ? y.rest[7] : y.forms(7, where)) = bad;
            CHECK(sums(y).verdict == box_verdict::undecided);
        }
    }
}
