// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_RUNGE_KUTTA_IMPLICIT_TABLEAU_HPP
#define SIVID_ENCLOSURE_RUNGE_KUTTA_IMPLICIT_TABLEAU_HPP

#include <sivid/enclosure/runge_kutta/tableau.hpp>

#include <vector>

namespace sivid {

// The implicit methods, with the nodes of the Gauss, Radau and Lobatto quadratures; the roots are
// enclosed when a method is used.
// Reference: Hairer and Wanner, Solving Ordinary Differential Equations II (1996), section IV.5.

/// Gauss, one stage: the implicit midpoint rule, order 2.
[[nodiscard]] inline tableau gauss2() { return {"gauss2", 2, {{{1, 2}}}, {{1, 1}}, {{1, 2}}}; }

/// Gauss, two stages, order 4.
[[nodiscard]] inline tableau gauss4() {
    return {"gauss4",
            4,
            {{{1, 4}, {3, 12, -2, 3}}, {{3, 12, 2, 3}, {1, 4}}},
            {{1, 2}, {1, 2}},
            {{3, 6, -1, 3}, {3, 6, 1, 3}}};
}

/// Gauss, three stages, order 6.
[[nodiscard]] inline tableau gauss6() {
    return {"gauss6",
            6,
            {{{5, 36}, {10, 45, -3, 15}, {25, 180, -6, 15}},
             {{10, 72, 3, 15}, {2, 9}, {10, 72, -3, 15}},
             {{25, 180, 6, 15}, {10, 45, 3, 15}, {5, 36}}},
            {{5, 18}, {4, 9}, {5, 18}},
            {{5, 10, -1, 15}, {1, 2}, {5, 10, 1, 15}}};
}

/// Radau IIA, two stages, order 3.
[[nodiscard]] inline tableau radau_iia3() {
    return {"radau_iia3",
            3,
            {{{5, 12}, {-1, 12}}, {{3, 4}, {1, 4}}},
            {{3, 4}, {1, 4}},
            {{1, 3}, {1, 1}}};
}

/// Radau IIA, three stages, order 5.
[[nodiscard]] inline tableau radau_iia5() {
    return {"radau_iia5",
            5,
            {{{88, 360, -7, 6}, {296, 1800, -169, 6}, {-2, 225, 3, 6}},
             {{296, 1800, 169, 6}, {88, 360, 7, 6}, {-2, 225, -3, 6}},
             {{16, 36, -1, 6}, {16, 36, 1, 6}, {1, 9}}},
            {{16, 36, -1, 6}, {16, 36, 1, 6}, {1, 9}},
            {{4, 10, -1, 6}, {4, 10, 1, 6}, {1, 1}}};
}

/// Lobatto IIIC, two stages, order 2.
[[nodiscard]] inline tableau lobatto_iiic2() {
    return {"lobatto_iiic2",
            2,
            {{{1, 2}, {-1, 2}}, {{1, 2}, {1, 2}}},
            {{1, 2}, {1, 2}},
            {{0, 1}, {1, 1}}};
}

/// Lobatto IIIC, three stages, order 4.
[[nodiscard]] inline tableau lobatto_iiic4() {
    return {"lobatto_iiic4",
            4,
            {{{1, 6}, {-1, 3}, {1, 6}}, {{1, 6}, {5, 12}, {-1, 12}}, {{1, 6}, {2, 3}, {1, 6}}},
            {{1, 6}, {2, 3}, {1, 6}},
            {{0, 1}, {1, 2}, {1, 1}}};
}

/// Lobatto IIIC, four stages, order 6.
[[nodiscard]] inline tableau lobatto_iiic6() {
    return {"lobatto_iiic6",
            6,
            {{{1, 12}, {0, 12, -1, 5}, {0, 12, 1, 5}, {-1, 12}},
             {{1, 12}, {1, 4}, {10, 60, -7, 5}, {0, 60, 1, 5}},
             {{1, 12}, {10, 60, 7, 5}, {1, 4}, {0, 60, -1, 5}},
             {{1, 12}, {5, 12}, {5, 12}, {1, 12}}},
            {{1, 12}, {5, 12}, {5, 12}, {1, 12}},
            {{0, 1}, {5, 10, -1, 5}, {5, 10, 1, 5}, {1, 1}}};
}

/// All methods that sivid brings along, explicit ones first; each has its `name`.
[[nodiscard]] inline std::vector<tableau> shipped_methods() {
    return {
        explicit_midpoint(), heun(),          kutta3(),        rk4(),          dormand_prince5(),
        butcher6(),          gauss2(),        gauss4(),        gauss6(),       radau_iia3(),
        radau_iia5(),        lobatto_iiic2(), lobatto_iiic4(), lobatto_iiic6()};
}

} // namespace sivid

#endif
