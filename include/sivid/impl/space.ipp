// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPL_SPACE_IPP
#define SIVID_IMPL_SPACE_IPP

#include <sivid/space/exact/impl/certified_rank.ipp>
#include <sivid/space/exact/impl/rational_basis.ipp>
#include <sivid/space/frame/impl/orthogonal_frame.ipp>
#include <sivid/space/impl/dense.ipp>

#endif
