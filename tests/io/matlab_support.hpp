// SPDX-License-Identifier: MIT
// Writes MATLAB files of level 5, for tests.
#ifndef SIVID_TESTS_IO_MATLAB_SUPPORT_HPP
#define SIVID_TESTS_IO_MATLAB_SUPPORT_HPP

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace io_support {

/// Elements in one byte order.
class matlab_writer {
public:
    explicit matlab_writer(bool little = true) : little_{little} {}

    template <class T>
    [[nodiscard]] std::string number(T x) const {
        std::string raw(sizeof(T), '\0');
        std::memcpy(raw.data(), &x, sizeof(T));
        if (!little_) std::reverse(raw.begin(), raw.end());
        return raw;
    }
    template <class T>
    [[nodiscard]] std::string numbers(std::vector<T> const& all) const {
        std::string text;
        for (T const x : all) text += number(x);
        return text;
    }
    [[nodiscard]] std::string element(std::uint32_t type, std::string const& data,
                                      bool padded = true) const {
        if (data.size() <= 4 && !data.empty() && padded) // small
            return number(static_cast<std::uint32_t>(data.size() << 16 | type)) + data +
                   std::string(4 - data.size(), '\0');
        auto const size = static_cast<std::uint32_t>(data.size());
        return number(type) + number(size) + data +
               std::string(padded ? (8 - data.size() % 8) % 8 : 0, '\0');
    }
    /// The content of a matrix: class, name, sizes, and what follows.
    [[nodiscard]] std::string matrix(std::uint32_t kind, std::string const& name, int rows,
                                     int columns, std::string const& rest) const {
        return element(14, element(6, number(kind) + number(std::uint32_t{0})) +
                               element(5, number(rows) + number(columns)) + element(1, name) +
                               rest);
    }
    [[nodiscard]] std::string doubles(std::string const& name, int rows, int columns,
                                      std::vector<double> const& all) const {
        return matrix(6, name, rows, columns, element(9, numbers(all)));
    }
    /// An object, as of a table: name, system, class, and what refers to a store in the file.
    [[nodiscard]] std::string object(std::string const& name, std::string const& type) const {
        return element(14, element(6, number(std::uint32_t{17}) + number(std::uint32_t{0})) +
                               element(1, name) + element(1, "MCOS") + element(1, type) +
                               matrix(13, "", 6, 1, element(6, std::string(24, '\1'))));
    }
    /// A structure of one element from fields, each a matrix without a name.
    [[nodiscard]] std::string
    structure(std::string const& name,
              std::vector<std::pair<std::string, std::string>> const& fields) const {
        constexpr std::size_t length = 16;
        std::string names, values;
        for (auto const& [field, value] : fields) {
            names += field + std::string(length - field.size(), '\0');
            values += value;
        }
        return matrix(2, name, 1, 1,
                      element(5, number(std::int32_t{length})) + element(1, names) + values);
    }
    [[nodiscard]] std::string file(std::string const& elements) const {
        std::string head = "MATLAB 5.0 MAT-file, for a test";
        head.resize(124, ' ');
        return head + number(std::uint16_t{0x0100}) + (little_ ? "IM" : "MI") + elements;
    }

private:
    bool little_;
};

} // namespace io_support

#endif // SIVID_TESTS_IO_MATLAB_SUPPORT_HPP
