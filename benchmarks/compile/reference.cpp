// SPDX-License-Identifier: MIT
// What a program costs that uses the packages below sivid directly: the measure for
// `scripts/compile-times --goals`.
#include <Eigen/Dense>
#include <boost/numeric/interval.hpp>
#include <boost/numeric/odeint.hpp>

#include <array>
#include <iostream>

namespace {

using oscillator = std::array<double, 2>;

oscillator after(double seconds) {
    namespace odeint = boost::numeric::odeint;
    oscillator x{1, 0};
    auto const stepper =
        odeint::make_controlled(1e-9, 1e-9, odeint::runge_kutta_dopri5<oscillator>());
    auto const rate = [](oscillator const& s, oscillator& ds, double /*t*/) { ds = {s[1], -s[0]}; };
    odeint::integrate_adaptive(stepper, rate, x, 0.0, seconds, 0.1);
    return x;
}

} // namespace

int main() {
    auto const x = after(7);
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(6, 4);
    a(5, 3) = x[0];
    Eigen::VectorXd const b = Eigen::VectorXd::Constant(6, x[1]);
    std::cout << a.colPivHouseholderQr().solve(b).transpose() << '\n'
              << a.jacobiSvd(Eigen::ComputeThinU | Eigen::ComputeThinV).singularValues().transpose()
              << '\n'
              << boost::numeric::interval<double>(x[0]).upper() << '\n';
}
