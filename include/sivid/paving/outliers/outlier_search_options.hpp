// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_OUTLIERS_OUTLIER_SEARCH_OPTIONS_HPP
#define SIVID_PAVING_OUTLIERS_OUTLIER_SEARCH_OPTIONS_HPP

#include <sivid/paving/judge/feasibility_test_options.hpp>
#include <sivid/paving/strategy/strategy.hpp>

#include <cstddef>
#include <functional>
#include <limits>

namespace sivid {

struct outlier_search_options {
    feasibility_test_options test{};
    double seconds = 10;
    std::size_t boxes = 20'000;
    std::size_t memory = std::numeric_limits<std::size_t>::max(); ///< bytes, see `used_up`
    /// Asked by any thread; false ends the search with what is proved until then. It stays false.
    std::function<bool()> keep_going = nullptr;
    /// Asked what is left for parameters that violate fewer measurements than are known to do.
    sivid::strategy strategy = default_strategy();
};

} // namespace sivid

#endif
