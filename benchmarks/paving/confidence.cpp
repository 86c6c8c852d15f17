// SPDX-License-Identifier: MIT
// sivid_benchmark_confidence: areas of proved 95 % regions beside the asymptotic ellipse of least
// squares, and how often each holds the truth; 20 measurements, 200 records a row. Weights by
// derivatives at the middle of the prior, and, for comparison, at the truth, which nobody knows:
// about what derivatives at each p itself would give. Records of which the ellipse is larger than
// the prior, or least squares diverges, are left out of the areas.
#include <sivid/paving/confidence_region.hpp>

#include "paving/confidence/confidence_models.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <cstdio>

using namespace sivid;
using namespace confidence_models;

namespace {

constexpr std::size_t samples = 20, records = 200;
constexpr double f_quantile = 3.5546; // 95 % of F with 2 and 18 degrees of freedom

struct ellipse {
    double area = 0;
    bool holds = false;
};

/// Least squares from the truth on, and its ellipse by the derivatives there.
template <class Model>
ellipse of_least_squares(recorded<Model> const& data) {
    auto p = data.truth;
    Eigen::MatrixXd g(samples, 2);
    Eigen::VectorXd e(samples);
    auto const linearise = [&] {
        for (std::size_t i = 0; i < samples; ++i) {
            auto const row = static_cast<Eigen::Index>(i);
            e[row] = data.seen[i] - Model::output(data.times[i], p);
            for (std::size_t j = 0; j < 2; ++j) {
                auto up = p, down = p;
                up[j] += 1e-6;
                down[j] -= 1e-6;
                g(row, static_cast<Eigen::Index>(j)) =
                    (Model::output(data.times[i], up) - Model::output(data.times[i], down)) / 2e-6;
            }
        }
    };
    for (int step = 0; step < 20; ++step) {
        linearise();
        Eigen::Vector2d const move = (g.transpose() * g).ldlt().solve(g.transpose() * e);
        p[0] += move[0];
        p[1] += move[1];
    }
    linearise();
    Eigen::Matrix2d const information = g.transpose() * g;
    double const limit = 2 * f_quantile * e.squaredNorm() / (samples - 2);
    Eigen::Vector2d const off(p[0] - data.truth[0], p[1] - data.truth[1]);
    return {3.141592653589793 * limit / std::sqrt(information.determinant()),
            off.dot(information * off) <= limit};
}

double area(confident_region const& region) {
    auto const share = hull(region.found.paving.inner_volume(), region.found.paving.outer_volume());
    auto const& prior = region.found.paving.prior();
    return mid(share) * width(prior[0]) * width(prior[1]);
}

template <class Model>
void row(noise kind, char const* errors, recorded<Model> data, double size) {
    support::draws d(17);
    double asymptotic = 0, middle = 0, truth = 0, seconds = 0;
    std::size_t held = 0, ellipses = 0, boxes = 0;
    double const whole = width(data.problem.prior[0]) * width(data.problem.prior[1]);
    for (std::size_t n = 0; n < records; ++n) {
        data.draw(kind, size, d);
        auto const usual = of_least_squares(data);
        bool const converged = usual.area < whole; // else left out of the areas
        asymptotic += converged ? usual.area : 0;
        ellipses += usual.holds ? 1 : 0;
        confidence_options options{.seed = n + 1};
        options.search.sufficient_ratio = 0.9;
        auto const region = confidence_region(data.problem, 0.95, options);
        middle += converged ? area(region) : 0;
        boxes += region.found.tested;
        seconds += region.found.seconds;
        confidence_test test(data.problem, options.test);
        (void)prepare_confidence(test, 0.95, options);
        held += test.learn({point_box(data.truth)})[0].verdict == box_verdict::inside ? 1 : 0;
        for (std::size_t j = 0; j < 2; ++j) options.nominal[region.names[j]] = data.truth[j];
        if (converged) truth += area(confidence_region(data.problem, 0.95, options));
    }
    std::printf("| %s, %s | %.2f | %.2f | %zu | %zu | %.0f | %.0f ms |\n", Model::name, errors,
                middle / asymptotic, truth / asymptotic, held, ellipses,
                static_cast<double>(boxes) / records, 1e3 * seconds / records);
    std::fflush(stdout);
}

template <class Model>
void rows(recorded<Model> const& data, double size) {
    row(noise::gaussian, "Gaussian", data, size);
    row(noise::laplace, "Laplace", data, size);
    row(noise::uniform, "uniform", data, size);
    row(noise::mixed, "mixed", data, size);
}

} // namespace

int main() {
    std::printf(
        "| model, errors | area / ellipse | derivatives at the truth | held of %zu | ellipse "
        "held | boxes | time |\n|---|---|---|---|---|---|---|\n",
        records);
    rows<line>({{1, 0.5}, {interval(-10, 10), interval(-10, 10)}, samples, 2}, 0.1);
    rows<decay>({{1, 0.5}, {interval(0.2, 4), interval(0.1, 2)}, samples, 4}, 0.05);
}
