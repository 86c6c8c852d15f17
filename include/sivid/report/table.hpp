// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_TABLE_HPP
#define SIVID_REPORT_TABLE_HPP

#include <sivid/compiled.hpp>
#include <sivid/report/text/escape.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sivid::report {

enum class column_kind {
    text,
    symbol, ///< a name that stands out
    number, ///< right-aligned, digits of equal width
    note    ///< quiet text
};

struct column {
    std::string head{};
    column_kind kind = column_kind::text;
};

/// A table of finished texts; short rows are filled with empty cells, long ones cut.
struct table {
    std::vector<column> columns{};
    std::vector<std::vector<std::string>> rows{};
    std::string caption{};
    std::optional<std::size_t> chosen_row{}; ///< set off from the others
};

/// The table as HTML. A column without any entry is left out.
[[nodiscard]] SIVID_DECL std::string table_html(table const& t);

} // namespace sivid::report

#ifndef SIVID_COMPILED
#include <sivid/report/impl/table.ipp>
#endif

#endif
