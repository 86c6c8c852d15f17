// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IDENTIFICATION_CHECK_HPP
#define SIVID_VERIFIER_IDENTIFICATION_CHECK_HPP

#include <sivid/compiled.hpp>
#include <sivid/io/result/same_problem.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/interval.hpp>
#include <sivid/verifier/check_finding.hpp>

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid {

namespace io_detail {

template <class Exact, class Fast>
class identification_check_work;

/// Whether there is a check in these types for this source: its own, or that of sivid::compiled.
template <class Exact, class Fast>
constexpr bool check_is_defined() {
    return (std::is_same_v<Exact, interval> && std::is_same_v<Fast, interval>) || requires {
        sizeof(identification_check_work<Exact, Fast>);
    };
}

} // namespace io_detail

/// Checks a stored identification against its problem, from nothing but the model and the data.
///   sivid::compiled has it for doubles, and sivid::compiled_mpfi what
///   `mp_identification_check.hpp` makes of it; a source that takes other types and links to either
///   includes `impl/identification_check.ipp`.
/// @tparam Exact  interval type of the runs at the witness (mp_interval: 40 digits)
/// @tparam Fast   interval type of the runs over boxes
template <class Exact, class Fast>
class identification_check {
public:
    /// @given  `require_same_problem`; the problem has the outlier budgets of the result
    identification_check(identification_problem const& problem, stored_identification const& stored,
                         identification_check_options options)
        : problem_(&problem), stored_(&stored), options_(std::move(options)) {
        static_assert(io_detail::check_is_defined<Exact, Fast>(),
                      "sivid::compiled has no check in these interval types: include "
                      "<sivid/verifier/impl/identification_check.ipp>");
    }

    /// All findings, each handed to `tell` as soon as it is there.
    std::vector<check_finding>
    operator()(std::function<void(check_finding const&)> const& tell = nullptr) const;

private:
    identification_problem const* problem_;
    stored_identification const* stored_;
    identification_check_options options_;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/verifier/impl/identification_check.ipp>
#endif

#endif // SIVID_VERIFIER_IDENTIFICATION_CHECK_HPP
