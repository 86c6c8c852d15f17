// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_NUMBER_IPP
#define SIVID_IMPL_NUMBER_IPP

#include <sivid/impl/work_clock.ipp>
#include <sivid/number/impl/decimal.ipp>
#include <sivid/number/impl/decimal_output.ipp>
#include <sivid/number/impl/guard.ipp>
#include <sivid/number/polynomial/detail/model_shape.hpp>

#include <cstddef>

namespace sivid {

template model_shape<double> model_shape<double>::make(std::size_t, std::size_t);
template model_shape<lanes<8>> model_shape<lanes<8>>::make(std::size_t, std::size_t);

} // namespace sivid

#endif
