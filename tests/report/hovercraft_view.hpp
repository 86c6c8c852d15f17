// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_REPORT_HOVERCRAFT_VIEW_HPP
#define SIVID_TESTS_REPORT_HOVERCRAFT_VIEW_HPP

#include <sivid/report/identification_page.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// A made-up identification shaped like that of the hovercraft's third scenario: the motion by
/// plain numeric integration, tubes by a stated half-width, and a paving of the thin curved sheet
/// L Sg = 0.012. Nothing in it is proved; it only fills a page.
namespace sivid_tests {

using state = std::array<double, 6>; // u v r x y psi

inline state hovercraft_rate(double t, state const& s, double Sv, double LSg) {
    double const m = 1.297, Iz = 0.058, rho = 1.225, Cd = 0.6, CL = 1.891, A = 0.025447, Ff = 0.5;
    double const delta = 3.14159265358979 / 12 * (1 + std::sin(3.14159265358979 * t / 2));
    double const F = 1.19576;
    auto const [u, v, r, x, y, psi] = s;
    double const V = std::sqrt(u * u + v * v + 0.0025);
    double const X = F - Ff * u / V - 0.5 * rho * Cd * 0.1276 * V * u;
    double const Y =
        CL * Sv * F * delta / (4 * A) - Ff * v / V - 0.5 * rho * Cd * Sv * V * v - 0.2 * v;
    double const N = -LSg * CL * F * delta / (4 * A) - 0.1 * r;
    return {v * r + X / m,
            -u * r + Y / m,
            N / Iz,
            u * std::cos(psi) - v * std::sin(psi),
            u * std::sin(psi) + v * std::cos(psi),
            r};
}

inline std::vector<state> hovercraft_motion(double duration, std::size_t steps) {
    std::vector<state> out{{2, 0, 0, 0, 0, 0}};
    double const h = duration / static_cast<double>(steps);
    for (std::size_t k = 0; k < steps; ++k) {
        double const t = h * static_cast<double>(k);
        auto const moved = [&](state const& d, double f) {
            state s = out.back();
            for (std::size_t i = 0; i < 6; ++i) {
                s[i] += f * d[i];
            }
            return s;
        };
        state const a = hovercraft_rate(t, out.back(), 0.22, 0.012);
        state const b = hovercraft_rate(t + h / 2, moved(a, h / 2), 0.22, 0.012);
        state const c = hovercraft_rate(t + h / 2, moved(b, h / 2), 0.22, 0.012);
        state const d = hovercraft_rate(t + h, moved(c, h), 0.22, 0.012);
        state next = out.back();
        for (std::size_t i = 0; i < 6; ++i) {
            next[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        }
        out.push_back(next);
    }
    return out;
}

/// Bisects the prior in (Sv, Sg, L) and keeps what is not outside the sheet.
class sheet_paving {
public:
    using box3 = std::array<sivid::report::range, 3>;
    struct leaf {
        box3 box;
        sivid::report::region verdict;
    };
    explicit sheet_paving(std::size_t most) {
        std::vector<box3> wave{{{{0.20, 0.25}, {0.0042, 0.0754}, {0.25, 0.35}}}};
        while (!wave.empty()) {
            bool const last = 2 * wave.size() + leaves.size() > most;
            std::vector<box3> next;
            for (box3 const& b : wave) {
                auto const verdict = test(b);
                if (verdict == sivid::report::region::undecided && !last) {
                    auto const [low, high] = halves(b);
                    next.push_back(low);
                    next.push_back(high);
                } else if (verdict != sivid::report::region::outside) {
                    leaves.push_back({b, verdict});
                }
            }
            wave = std::move(next);
        }
    }
    std::vector<leaf> leaves;

    [[nodiscard]] std::vector<sivid::report::projected_box> on(std::size_t i, std::size_t j) const {
        std::vector<sivid::report::projected_box> out;
        for (leaf const& l : leaves) {
            out.push_back({l.box[i], l.box[j], l.verdict});
        }
        return out;
    }

private:
    static sivid::report::region test(box3 const& b) {
        double const lo = b[1].lo * b[2].lo, hi = b[1].hi * b[2].hi;
        using enum sivid::report::region;
        if (hi < 0.011926 || lo > 0.012074 || b[0].hi < 0.21820 || b[0].lo > 0.22181) {
            return outside;
        }
        return lo > 0.011926 && hi < 0.012074 && b[0].lo > 0.21820 && b[0].hi < 0.22181 ? inside
                                                                                        : undecided;
    }
    static std::pair<box3, box3> halves(box3 const& b) {
        std::array<double, 3> const scale{0.004, 0.0003, 0.002};
        std::size_t widest = 0;
        for (std::size_t i = 1; i < 3; ++i) {
            widest = (b[i].hi - b[i].lo) / scale[i] > (b[widest].hi - b[widest].lo) / scale[widest]
                         ? i
                         : widest;
        }
        auto low = b, high = b;
        low[widest].hi = high[widest].lo = (b[widest].lo + b[widest].hi) / 2;
        return {low, high};
    }
};

inline sivid::report::scenario_view hovercraft_scenario(bool with_outliers) {
    using namespace sivid::report;
    std::array<char const*, 6> const name{"u", "v", "r", "x", "y", "psi"};
    std::array<char const*, 6> const unit{"m/s", "m/s", "rad/s", "m", "m", "rad"};
    std::array<double, 6> const error{0.02, 0.02, 0.05, 0.02, 0.02, 0.03};
    std::size_t const steps = 120;
    auto const motion = hovercraft_motion(3, steps);
    scenario_view out{.name = "S3", .measurements = 180, .outlier_budget = with_outliers ? 3u : 0u};
    std::uint32_t seed = 12345;
    auto const noise = [&] {
        seed = seed * 1664525u + 1013904223u;
        return static_cast<double>(seed >> 8) / 8388608.0 - 1;
    };
    for (std::size_t c = 0; c < 6; ++c) {
        channel_series series{.name = name[c], .unit = unit[c]};
        for (std::size_t k = 0; k < steps; ++k) {
            double const t = 0.025 * static_cast<double>(k);
            double const a = motion[k][c], b = motion[k + 1][c], wide = 0.12 * error[c] * t;
            series.tube.push_back({t, t + 0.025, {std::fmin(a, b) - wide, std::fmax(a, b) + wide}});
            series.reference.push_back({t, a});
        }
        for (std::size_t k = 4; k <= steps; k += 4) {
            double const t = 0.025 * static_cast<double>(k),
                         middle = motion[k][c] + 0.55 * error[c] * noise();
            measured_sample sample{.time = t, .value = {middle - error[c], middle + error[c]}};
            sample.enclosure = {motion[k][c] - 0.12 * error[c] * t,
                                motion[k][c] + 0.12 * error[c] * t};
            if (with_outliers && c == 2 && (k == 36 || k == 84)) {
                sample.value = {sample.value.lo + (k == 36 ? 1.6 : -2.1),
                                sample.value.hi + (k == 36 ? 1.6 : -2.1)};
                sample.state = sample_state::forced_outlier;
            }
            if (with_outliers && c == 4 && k == 60) {
                sample.value = {sample.value.lo + 0.06, sample.value.hi + 0.06};
                sample.state = sample_state::suspect;
            }
            series.measured.push_back(sample);
        }
        out.channels.push_back(std::move(series));
    }
    plane_series plane;
    for (std::size_t k = 0; k < steps; ++k) {
        plane.tube.push_back({out.channels[3].tube[k].value, out.channels[4].tube[k].value});
        plane.reference.push_back({motion[k][3], motion[k][4]});
        if (k % 15 == 7) {
            plane.poses.push_back({motion[k][3], motion[k][4], motion[k][5]});
        }
    }
    for (std::size_t k = 0; k < out.channels[3].measured.size(); ++k) {
        plane.measured.push_back(
            {out.channels[3].measured[k].value, out.channels[4].measured[k].value});
    }
    out.plane = std::move(plane);
    return out;
}

/// The whole view; `boxes` bounds the size of the paving.
inline sivid::report::identification_view hovercraft_view(std::size_t boxes, bool with_outliers) {
    using namespace sivid::report;
    identification_view v{.dataset = "h3", .model = "hovercraft", .verdict = outcome::proved};
    v.sentence = "A parameter vector that meets all 180 measurements was verified; everything that "
                 "can explain them lies in a curved sheet that fills at most 0.06 % of the prior.";
    v.parameters = {
        {"Sv", "m^2", {0.20, 0.25}, {0.21811, 0.22190}, "side area in the sway equation"},
        {"Sg", "m^2", {0.0042, 0.0754}, {0.03407, 0.04832}, "rudder area"},
        {"L", "m", {0.25, 0.35}, {0.25, 0.35}, "distance of the rudder"}};
    v.combinations = {
        {"L*Sg",
         "m^3",
         {0.011921, 0.012079},
         {0.00105, 0.02639},
         "L and Sg enter the model only through this product: no data can tell them apart."}};
    v.volume_inner = {2.11e-4, 2.12e-4};
    v.volume_outer = {5.71e-4, 5.72e-4};
    v.witness =
        sivid::named_witness{{{"Sv", "m^2", 0.22003}, {"Sg", "m^2", 0.0399871}, {"L", "m", 0.3001}},
                             {{"S3", {{"u", "m/s", 2}, {"v", "m/s", 0}}}}};
    v.assumptions = {
        "The inputs W and delta are exact and linear between their samples.",
        "Every measurement is within its stated bound" +
            std::string{with_outliers ? ", except for at most 3 in scenario S3." : "."},
        "The constants not listed as parameters have exactly their nominal values."};
    v.statistics = {12.34, 184211, 1532, "the accuracy asked for is reached"};
    v.scenarios = {hovercraft_scenario(with_outliers)};
    if (with_outliers) {
        v.warnings = {"One measurement of y at 1.5 s is missed by the witness, though not proved "
                      "to be an outlier."};
    }
    v.tube_meaning = "every motion of a parameter vector in the outer paving";
    v.reference_meaning = "plain numeric integration at the witness";
    sheet_paving const sheet{boxes};
    axis const Sv{"Sv", "m^2", {0.20, 0.25}}, Sg{"Sg", "m^2", {0.0042, 0.0754}},
        L{"L", "m", {0.25, 0.35}};
    v.pavings = {{L, Sg, sheet.on(2, 1), point{0.3001, 0.0399871}},
                 {Sv, Sg, sheet.on(0, 1), point{0.22003, 0.0399871}},
                 {Sv, L, sheet.on(0, 2), point{0.22003, 0.3001}}};
    v.comparison = {{"contraction (default)",
                     12.34,
                     184211,
                     1532,
                     {2.11e-4, 2.12e-4},
                     {5.71e-4, 5.72e-4},
                     "",
                     true},
                    {"Algorithm 1 of the report",
                     58.9,
                     1310720,
                     655360,
                     {0, 0},
                     {0.0712, 0.0713},
                     "bisection only; nothing proved inside"}};
    v.footer = {"sivid 0.1.0", "2024-11-20", "2 cores, x86-64",
                "hovercraft identify h3 --out out/hovercraft"};
    return v;
}

} // namespace sivid_tests

#endif
