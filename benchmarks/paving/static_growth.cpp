// SPDX-License-Identifier: MIT
// Static problems over sizes: hulls of all parameters that explain the measurements, proved, beside
// least squares in plain doubles. One process, sizes ascending, so that the peak of memory is a
// row's.
#include "problems.hpp"

#include <sivid/paving/static_inversion.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <sys/resource.h>

namespace {

using namespace paving_benchmark;
using sivid::interval;
using vector = Eigen::VectorXd;

/// A model in plain doubles: the output, its gradient written to g.
using plain_model = double (*)(double t, vector const& c, double* g);

double plain_exponentials(double t, vector const& c, double* g) {
    double y = 0;
    for (Eigen::Index j = 0; j < c.size(); j += 2) {
        g[j] = std::exp(-c[j + 1] * t);
        g[j + 1] = -t * c[j] * g[j];
        y += c[j] * g[j];
    }
    return y;
}
double plain_polynomial(double t, vector const& c, double* g) {
    double power = 1, y = 0;
    for (Eigen::Index j = 0; j < c.size(); ++j, power *= t) {
        g[j] = power;
        y += c[j] * power;
    }
    return y;
}

struct row {
    std::string name;
    sivid::recorded_model model;
    plain_model plain;
    std::vector<double> truth;
    double horizon, error, prior; ///< noise fills the error; the prior is the truth +- this share
    std::size_t outliers = 0, planted = 0;
};

sivid::static_problem pose(row const& r, std::size_t n) {
    sivid::static_problem p{r.model, {}, {}, {}, r.outliers};
    std::vector<interval> sides;
    for (std::size_t j = 0; j < r.truth.size(); ++j) {
        p.choice.unknown.push_back(r.model.about.constants[j].name);
        sides.push_back(interval(r.truth[j] * (1 - r.prior), r.truth[j] * (1 + r.prior)));
    }
    p.prior = sivid::box(sides);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> u(-1, 1);
    vector const c = vector::Map(r.truth.data(), static_cast<Eigen::Index>(r.truth.size()));
    std::vector<double> g(r.truth.size());
    p.measurements.reserve(n);
    for (std::size_t k = 0; k < n; ++k) {
        double const t = r.horizon * static_cast<double>(k) / static_cast<double>(n - 1);
        double y = r.plain(t, c, g.data()) + 0.9999 * r.error * u(random);
        if (r.planted > 0 && k % (n / r.planted) == 3) y += 5 * r.error;
        p.measurements.push_back({t, 0, interval(y - r.error, y + r.error)});
    }
    return p;
}

double since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}
double peak_megabytes() {
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    return static_cast<double>(use.ru_maxrss) / 1024;
}

struct fit {
    double seconds = 0;
    vector two_sigma;
};
/// Gauss-Newton from the middle of the prior.
fit least_squares(row const& r, sivid::static_problem const& p) {
    auto const begin = std::chrono::steady_clock::now();
    auto const n = static_cast<Eigen::Index>(r.truth.size());
    vector c(n), g(n);
    for (Eigen::Index j = 0; j < n; ++j) {
        c[j] = 1.05 * mid(p.prior[static_cast<std::size_t>(j)]);
    }
    Eigen::MatrixXd normal(n, n);
    double squares = 0;
    for (int k = 0; k < 12; ++k) {
        normal.setZero();
        vector right = vector::Zero(n);
        squares = 0;
        for (auto const& m : p.measurements) {
            double const miss = mid(m.bound) - r.plain(m.time, c, g.data());
            squares += miss * miss;
            right += miss * g;
            normal.selfadjointView<Eigen::Lower>().rankUpdate(g);
        }
        vector const step = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
        c += step;
        if (step.cwiseAbs().maxCoeff() < 1e-10) break;
    }
    fit result;
    Eigen::MatrixXd const full = normal.selfadjointView<Eigen::Lower>();
    double const variance = squares / static_cast<double>(p.measurements.size());
    result.two_sigma = 2 * (variance * full.inverse().diagonal()).cwiseSqrt();
    result.seconds = since(begin);
    return result;
}

void measure(row const& r, std::size_t n, double accuracy) {
    auto const p = pose(r, n);
    auto const before = peak_megabytes();
    sivid::static_inversion_options options;
    options.accuracy = accuracy;
    options.only_hulls = true;
    options.seconds = 20;
    double seconds = HUGE_VAL;
    sivid::flat_paving found(p.prior);
    for (int k = 0; k < (n <= 10'000 ? 5 : 1); ++k) {
        auto const begin = std::chrono::steady_clock::now();
        found = sivid::invert_static(p, options);
        seconds = std::min(seconds, since(begin));
    }
    auto const after = peak_megabytes();
    auto const fitted = least_squares(r, p);
    auto const hull = found.hull(), inner = found.inside.hull();
    double least = HUGE_VAL, most = 0, beyond = 0, against = 0;
    for (std::size_t j = 0; j < hull.size(); ++j) {
        double const share = width(hull[j]) / width(p.prior[j]);
        least = std::min(least, share);
        most = std::max(most, share);
        beyond = std::max(beyond, width(hull[j]) / width(inner[j]));
        against = std::max(against,
                           0.5 * width(hull[j]) / fitted.two_sigma[static_cast<Eigen::Index>(j)]);
        if (!contains(hull[j], r.truth[j])) std::printf("LOST ");
    }
    auto const data = static_cast<double>(n * sizeof(sivid::measurement)) / 1e6;
    std::printf("%-22s %8zu %9.2f ms %5zu %8.1f %8.1f to %5.1f MB %8.3f %8.3f %% %7.3f x %8.2f ms "
                "%6.2f\n",
                r.name.c_str(), n, 1e3 * seconds, found.tested,
                static_cast<double>(found.asked) / static_cast<double>(n), data, after - before,
                100 * least, 100 * most, beyond, 1e3 * fitted.seconds, against);
    std::fflush(stdout);
}

} // namespace

int main() {
    std::printf("%-22s %8s %12s %5s %8s %20s %19s %9s %11s %6s\n", "", "samples", "hulls", "boxes",
                "asked", "data, more memory", "of the prior", "of inner", "LS", "/ 2 sd");
    auto const decaying = sivid::record_static_model<decay>();
    auto const two = sivid::record_static_model<two_decays>();
    row const rows[] = {
        {"decay", decaying, plain_exponentials, {2, 0.3}, 10, 0.05, 0.2},
        {"two exponentials", two, plain_exponentials, {2, 0.3, 1, 2}, 10, 0.05, 0.2},
        {"decay, few outliers", decaying, plain_exponentials, {2, 0.3}, 10, 0.05, 0.2, 3, 3},
    };
    for (auto const& r : rows) {
        for (std::size_t const n : {100U, 1000U, 10'000U, 100'000U, 1'000'000U}) {
            measure(r, n, 1e-3);
        }
    }
    measure({"50 outliers spare", decaying, plain_exponentials, {2, 0.3}, 10, 0.05, 0.2, 50}, 200,
            1e-2);
    []<std::size_t... N>(std::index_sequence<N...>) {
        (measure({"polynomial, " + std::to_string(N), sivid::record_static_model<polynomial<N>>(),
                  plain_polynomial, std::vector<double>(N, 1.0), 1, 0.1, 1},
                 100, 1e-3),
         ...);
    }
    (std::index_sequence<1, 2, 3, 4, 6, 8, 12>{});
}
