// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_ELEMENTARY_HPP
#define SIVID_NUMBER_ELEMENTARY_HPP

/// @file
/// All elementary functions of the vocabulary type. Each has the meaning of IEEE 1788: the hull of
/// the values on the part of the argument where the function is defined. The forms with a last
/// argument `bool& cut` set it if some part was left out; a proof that needs the function
/// everywhere must look.

#include <sivid/number/elementary/detail/hyperbolic.hpp>
#include <sivid/number/elementary/detail/inverse_trigonometric.hpp>
#include <sivid/number/elementary/detail/piecewise.hpp>
#include <sivid/number/elementary/detail/power.hpp>
#include <sivid/number/elementary/detail/trigonometric.hpp>
#include <sivid/number/elementary/exponential.hpp>

#endif
