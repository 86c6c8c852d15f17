// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_IDENTIFICATION_CHECK_IPP
#define SIVID_IO_IMPL_IDENTIFICATION_CHECK_IPP

#include <sivid/io/detail/identification_check_work.hpp>
#include <sivid/io/identification_check.hpp>

#include <functional>
#include <vector>

namespace sivid {

template <class Exact, class Fast>
std::vector<check_finding> identification_check<Exact, Fast>::operator()(
    std::function<void(check_finding const&)> const& tell) const {
    return io_detail::identification_check_work<Exact, Fast>(*problem_, *stored_, options_)(tell);
}

} // namespace sivid

#endif
