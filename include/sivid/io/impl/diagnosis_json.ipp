// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_DIAGNOSIS_JSON_IPP
#define SIVID_IO_IMPL_DIAGNOSIS_JSON_IPP

#include <sivid/io/diagnosis_json.hpp>

namespace sivid {

SIVID_DECL std::string diagnosis_json(diagnosis const& d, std::string const& dataset) {
    return io_detail::diagnosis_writer(d).text(dataset);
}

} // namespace sivid

#endif
