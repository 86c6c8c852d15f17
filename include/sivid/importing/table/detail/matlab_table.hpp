// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_MATLAB_TABLE_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_MATLAB_TABLE_HPP

#include <sivid/importing/table/detail/recorded_rows.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// A variable of a MATLAB file, or a field of a structure there ("log.theta").
struct matlab_variable {
    std::string name;
    std::string about;   ///< "double 1000x3"
    bool object = false; ///< a table, datetime, string...: only MATLAB takes it apart
    std::size_t rows = 0, columns = 0;
    /// Column by column; nothing where it is no full real matrix of numbers.
    std::variant<std::monostate, std::vector<double>, std::vector<float>, std::vector<std::int64_t>,
                 std::vector<std::uint64_t>>
        numbers;

    [[nodiscard]] bool numeric() const { return numbers.index() != 0; }
    [[nodiscard]] bool single() const {
        return std::holds_alternative<std::vector<float>>(numbers);
    }

    /// The number in a row and column from 0, exactly.
    /// @returns nothing  for NaN
    /// @throws std::range_error  for an infinite one
    [[nodiscard]] std::optional<exact_decimal> at(std::size_t row, std::size_t column) const {
        return read(row, column, [](auto x) {
            if constexpr (std::is_integral_v<decltype(x)>)
                return exact_decimal::parse(std::to_string(x));
            else
                return std::optional{exact_decimal::of(static_cast<double>(x))};
        });
    }

    /// The decimal that a number was computed from: the shortest that its precision tells, so 0.3,
    /// not 0.299999999999999989. Integers are what they are.
    /// @throws std::range_error  as `at`
    [[nodiscard]] std::optional<exact_decimal> meant_at(std::size_t row, std::size_t column) const {
        return read(row, column, [](auto x) {
            std::array<char, 32> text;
            auto* const end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
            return exact_decimal::parse({text.data(), static_cast<std::size_t>(end - text.data())});
        });
    }

private:
    template <class F>
    [[nodiscard]] std::optional<exact_decimal> read(std::size_t row, std::size_t column,
                                                    F const& decimal_of) const {
        auto const number = [&]<class T>(T const& all) -> std::optional<exact_decimal> {
            if constexpr (std::is_same_v<T, std::monostate>) {
                return std::nullopt;
            } else {
                auto const x = all[column * rows + row];
                if constexpr (std::is_floating_point_v<typename T::value_type>) {
                    if (std::isnan(x)) return std::nullopt;
                    if (std::isinf(x)) throw std::range_error{"infinite"};
                }
                return decimal_of(x);
            }
        };
        return std::visit(number, numbers);
    }
};

/// The variables of a MATLAB file.
struct matlab_file {
    std::string name;
    std::vector<matlab_variable> variables;
};

/// A row or a column of a variable.
struct matlab_vector {
    matlab_variable const* variable = nullptr;
    bool along_rows = true; ///< its numbers stand below each other
    std::size_t fixed = 0;  ///< the other index, from 0

    [[nodiscard]] std::size_t size() const {
        return along_rows ? variable->rows : variable->columns;
    }
    [[nodiscard]] std::optional<exact_decimal> operator[](std::size_t i) const {
        return along_rows ? variable->at(i, fixed) : variable->at(fixed, i);
    }
    /// As `matlab_variable::meant_at`.
    [[nodiscard]] std::optional<exact_decimal> meant(std::size_t i) const {
        return along_rows ? variable->meant_at(i, fixed) : variable->meant_at(fixed, i);
    }
};

/// What a mapping's "column" means in a MATLAB file: "t", "log.theta", "X(:,3)" or "X(3,:)".
/// @throws input_error  with the mapping's place
[[nodiscard]] inline matlab_vector find_vector(column_reference const& c, matlab_file const& file) {
    auto const fail = [&](std::string const& problem, std::string const& remedy) {
        throw input_error{c.place, text_of(file.name, problem), remedy};
    };
    if (c.number > 0)
        fail(": a variable has no number", "name it, such as \"t\", \"log.t\" or \"X(:,3)\"");
    std::string_view name = c.heading, index;
    bool const whole = std::any_of(file.variables.begin(), file.variables.end(),
                                   [&](auto const& v) { return v.name == name; });
    if (auto const open = name.find('(');
        !whole && open != std::string_view::npos && name.back() == ')') {
        index = name.substr(open + 1, name.size() - open - 2);
        name = name.substr(0, open);
    }
    matlab_variable const* found = nullptr;
    std::string known;
    bool objects = false;
    for (auto const& v : file.variables) {
        objects = objects || v.object;
        bool const inside = v.object && name.starts_with(v.name + ".");
        if (v.name == name || inside) found = &v; // the last one, as in MATLAB
        if (known.size() < 400)
            known += text_of(known.empty() ? "" : ", ", in_quotes(v.name), " (", v.about, ")");
    }
    constexpr std::string_view of_objects =
        "save vectors of numbers there: t = T.t of a table T, t = seconds(d - d(1)) of times d, "
        "y = double(s) of texts s";
    if (found == nullptr && objects)
        fail(text_of(" has no variable ", in_quotes(std::string{name}),
                     ", or it is an object, such as a table, which MATLAB alone can take apart"),
             text_of(of_objects, "; it has: ", known));
    if (found == nullptr)
        fail(text_of(" has no variable ", in_quotes(std::string{name})), "it has: " + known);
    auto const what = text_of(": ", in_quotes(found->name), " is ", found->about);
    if (found->object) fail(what + ", which MATLAB alone can take apart", std::string{of_objects});
    if (!found->numeric())
        fail(what + ", no full real matrix of numbers", "name another; it has: " + known);
    matlab_vector result{found, true, 0};
    if (index.empty()) {
        result.along_rows = found->columns == 1;
        if (found->columns != 1 && found->rows != 1)
            fail(what + ", no vector", text_of("write \"", name, "(:,1)\" for its first column"));
        return result;
    }
    bool const column = index.starts_with(":,"), row = index.ends_with(",:");
    std::string_view number; // nothing where both are named, which would share a colon
    if (column != row) number = column ? index.substr(2) : index.substr(0, index.size() - 2);
    auto const* const end = number.data() + number.size();
    std::size_t at = 0;
    if (column == row || number.empty() || std::from_chars(number.data(), end, at).ptr != end ||
        at < 1 || at > (column ? found->columns : found->rows))
        fail(text_of(what, ", not to be read by ", in_quotes("(" + std::string{index} + ")")),
             "write (:,k) for its k-th column or (k,:) for its k-th row, from 1");
    result.along_rows = column;
    result.fixed = at - 1;
    return result;
}

/// Reads the vectors that the mapping names out of a MATLAB file as the columns of one table: row k
/// holds their k-th numbers. NaN is no reading. Times are the decimals that they were computed
/// from; how coarse single-precision ones are is noted.
/// @throws input_error  for vectors of different lengths, infinite numbers, times that do not
///                      increase
[[nodiscard]] inline recorded_table
read_matlab_table(scenario_mapping const& s, matlab_file const& file, import_protocol& protocol) {
    auto const fail = [&](std::size_t line, std::string const& heading, std::string const& problem,
                          std::string const& remedy) {
        throw input_error{{.file = file.name, .line = line, .heading = heading}, problem, remedy};
    };
    recorded_rows rows{s, protocol,
                       [&](std::size_t line, bool, auto const& problem, auto const& remedy) {
                           fail(line, s.time.column.heading, problem, remedy);
                       }};
    auto references = columns_of(s);
    if (!s.time.sample_time) references.push_back(s.time.column);
    std::vector<matlab_vector> vectors;
    for (auto const& c : references) {
        vectors.push_back(find_vector(c, file));
        if (vectors.back().size() != vectors.front().size())
            throw input_error{c.place,
                              text_of(file.name, ": ", in_quotes(c.heading), " has ",
                                      std::to_string(vectors.back().size()), " numbers, ",
                                      in_quotes(references.front().heading), " has ",
                                      std::to_string(vectors.front().size())),
                              "name vectors that were recorded together"};
    }
    auto const is_time = [&](std::size_t i) {
        return !s.time.sample_time && i + 1 == vectors.size();
    };
    double latest = 0;
    for (std::size_t k = 0; k < vectors.front().size(); ++k) {
        std::vector<std::optional<exact_decimal>> cells;
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            try {
                cells.push_back(is_time(i) ? vectors[i].meant(k) : vectors[i][k]);
            } catch (std::range_error const&) {
                fail(k + 1, references[i].heading, "an infinite number",
                     "write NaN where there is no reading");
            }
        }
        std::optional<exact_decimal> stamp;
        if (!s.time.sample_time) {
            stamp = cells.back();
            cells.pop_back();
            if (stamp) latest = std::max(latest, std::abs(*nearest(*stamp)));
        }
        rows.add(k + 1, stamp, std::move(cells));
    }
    if (!s.time.sample_time && vectors.back().variable->single()) {
        auto const most = static_cast<float>(std::min(latest, 1e38));
        auto const step = std::nextafter(most, HUGE_VALF) - most;
        protocol.add(import_protocol::kind::assumed, s.name, "",
                     text_of("the times are of single precision: the shortest decimals are taken, "
                             "and no bound allows for steps of ",
                             rounded_up(exact_decimal::shortest(step), 2).text(), " ", s.time.unit,
                             " between the numbers that there are"));
    }
    return rows.take();
}

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_MATLAB_TABLE_HPP
