// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_TEXT_ESCAPE_HPP
#define SIVID_REPORT_TEXT_ESCAPE_HPP

#include <sivid/compiled.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace sivid::report {

/// Text made safe as XML or HTML content and inside a quoted attribute: markup characters become
/// entities, everything that is not valid text becomes U+FFFD.
/// @guarantee  the result has no '<', '>', '"', ''' and no '&' but that of an entity, and is valid
///             UTF-8 without control characters.
[[nodiscard]] SIVID_DECL std::string escape(std::string_view text);

/// A rough width of the text in a sans-serif font of the given size, for laying out labels.
[[nodiscard]] SIVID_DECL double approximate_text_width(std::string_view text, double size);

/// The text cut to a number of code points, with an ellipsis when something was cut.
[[nodiscard]] SIVID_DECL std::string shorten(std::string_view text, std::size_t longest);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/text/impl/escape.ipp>
#endif

#endif
