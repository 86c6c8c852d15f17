// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_CHECKPOINT_IPP
#define SIVID_IO_IMPL_CHECKPOINT_IPP

#include <sivid/io/checkpoint.hpp>

namespace sivid {

SIVID_DECL void write_checkpoint(std::filesystem::path const& file,
                                 identification_state const& state, std::string const& problem) {
    write_durably(file, checkpoint_text(state, problem));
}

} // namespace sivid

#endif
