// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_IMPL_IDENTIFICATION_CHECK_IPP
#define SIVID_VERIFIER_IMPL_IDENTIFICATION_CHECK_IPP

#include <sivid/verifier/claim/detail/identification_check_work.hpp>
#include <sivid/verifier/identification_check.hpp>

namespace sivid {

template <class Exact, class Fast>
std::vector<check_finding> identification_check<Exact, Fast>::operator()(
    std::function<void(check_finding const&)> const& tell) const {
    return io_detail::identification_check_work<Exact, Fast>(*problem_, *stored_, options_)(tell);
}

} // namespace sivid

#endif
