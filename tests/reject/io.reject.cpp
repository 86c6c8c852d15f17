// SPDX-License-Identifier: MIT
// Numbers of a file reach the library as decimals, never as a parser's double.
// reject 1: cannot convert|could not convert|no viable conversion|conversion from
// reject 2: no match for|invalid operands|deleted|no viable|cannot convert|conversion from
#include <sivid/io/text/json_document.hpp>

#if SIVID_REJECT == 1
double read(sivid::json_value const& value) { return value.number(); }
#elif SIVID_REJECT == 2
sivid::interval read(sivid::json_value const& value) { return value.number(); }
#else
sivid::interval read(sivid::json_value const& value) { return *sivid::enclose(value.number()); }
#endif
