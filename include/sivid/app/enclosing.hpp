// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_ENCLOSING_HPP
#define SIVID_APP_ENCLOSING_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/enclosed_motion.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/paving/run_options.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sivid::app {

/// `--method` and `--set`: how trajectories are enclosed.
struct enclosing {
    std::string method = "taylor"; ///< or one of `method_names`
    std::string set;               ///< first-order or taylor-model
};

/// taylor, and every Runge-Kutta method that sivid has.
[[nodiscard]] SIVID_DECL std::vector<std::string> method_names();

/// The method's coefficients; none for the Taylor series.
/// @throws bad_request  for a method that does not exist
[[nodiscard]] SIVID_DECL std::optional<tableau> method_of(enclosing const& how);

/// Whether it says what experiments do anyway: Taylor models that follow the Taylor series.
[[nodiscard]] inline bool is_usual(enclosing const& how) {
    return how.method == "taylor" && how.set == "taylor-model";
}

/// Lets what runs experiments enclose so.
SIVID_DECL void apply(enclosing const& how, run_options& run);
/// The method alone, for sets of first order.
SIVID_DECL void apply(enclosing const& how, enclosure_options& options);

/// The motions from a box of starts.
[[nodiscard]] SIVID_DECL enclosed_motion enclosed(enclosing const& how,
                                                  std::shared_ptr<flow const> f, box const& start,
                                                  double duration, enclosure_options options = {});

} // namespace sivid::app

#ifndef SIVID_COMPILED
#include <sivid/app/impl/enclosing.ipp>
#endif

#endif
