// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_MATLAB_FILE_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_MATLAB_FILE_HPP

#include <sivid/io/dataset/unit_conversion.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/text_file.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// Undoes the compression of zlib: the text, or nothing when it is damaged or longer than so many
/// bytes. The library itself has none.
using inflate_function = std::function<std::optional<std::string>(std::string_view, std::size_t)>;

/// A variable of a MATLAB file, or a field of a structure there ("log.theta").
struct matlab_variable {
    std::string name;
    std::string about;    ///< "double 1000x3"
    bool numeric = false; ///< real numbers, readable by `at`
    bool single = false;  ///< in single precision
    bool object = false;  ///< a table, datetime, string...: only MATLAB takes it apart
    std::size_t rows = 0, columns = 0;

    /// The number in a row and column from 0, column by column, exactly.
    /// @returns nothing  for NaN
    /// @throws std::range_error  for an infinite one
    [[nodiscard]] std::optional<exact_decimal> at(std::size_t row, std::size_t column) const {
        auto const* p = data.data() + (column * rows + row) * bytes;
        auto const read = [&]<class T>(T value) {
            std::array<char, sizeof(T)> raw;
            std::copy_n(p, sizeof(T), raw.begin());
            if (swapped) std::reverse(raw.begin(), raw.end());
            std::memcpy(&value, raw.data(), sizeof(T));
            return value;
        };
        auto const whole = [](auto n) { return exact_decimal::parse(std::to_string(n)); };
        switch (type) {
        case 1:
            return whole(static_cast<int>(read(std::int8_t{})));
        case 2:
            return whole(static_cast<int>(read(std::uint8_t{})));
        case 3:
            return whole(read(std::int16_t{}));
        case 4:
            return whole(read(std::uint16_t{}));
        case 5:
            return whole(read(std::int32_t{}));
        case 6:
            return whole(read(std::uint32_t{}));
        case 12:
            return whole(read(std::int64_t{}));
        case 13:
            return whole(read(std::uint64_t{}));
        default:
            break;
        }
        double const x = type == 7 ? static_cast<double>(read(float{})) : read(double{});
        if (std::isnan(x)) return std::nullopt;
        if (std::isinf(x)) throw std::range_error{"infinite"};
        return exact_decimal::of(x);
    }

    /// The decimal that a number was computed from: the shortest that its precision tells, so 0.3,
    /// not 0.299999999999999989. Integers are what they are.
    /// @throws std::range_error  as `at`
    [[nodiscard]] std::optional<exact_decimal> meant_at(std::size_t row, std::size_t column) const {
        auto const exact = at(row, column);
        if (!exact || (type != 7 && type != 9)) return exact;
        double const x = *nearest(*exact);
        if (type == 9) return exact_decimal::shortest(x);
        std::array<char, 32> buffer;
        auto* const end =
            std::to_chars(buffer.data(), buffer.data() + buffer.size(), static_cast<float>(x)).ptr;
        return exact_decimal::parse({buffer.data(), static_cast<std::size_t>(end - buffer.data())});
    }

    unsigned type = 0;     ///< how the numbers are stored
    std::size_t bytes = 0; ///< of each
    bool swapped = false;  ///< in the other byte order
    std::string_view data; ///< in the file that has the variable
};

/// The variables of a file in MATLAB's format of level 5 (`save -v6`, `-v7`): real full matrices of
/// numbers, also as fields of structures; others are listed and cannot be read.
class matlab_file {
public:
    /// @param inflate  for the compressed variables of -v7; nothing: they are refused
    /// @throws input_error  for other formats and for damaged files
    /// @cost  linear in the size, inflated
    matlab_file(std::string file, std::string text, inflate_function inflate)
        : file_{std::move(file)}, inflate_{std::move(inflate)} {
        texts_.push_back(std::move(text));
        std::string_view rest = texts_.front();
        check_head(rest);
        rest.remove_prefix(head);
        while (!rest.empty()) top(next(rest, false));
    }
    matlab_file(matlab_file const&) = delete;
    matlab_file& operator=(matlab_file const&) = delete;

    [[nodiscard]] std::vector<matlab_variable> const& variables() const { return variables_; }
    [[nodiscard]] std::string const& name() const { return file_; }

private:
    static constexpr std::size_t head = 128, deepest = 8;
    static constexpr unsigned matrix = 14, compressed = 15; // elements
    static constexpr unsigned opaque = 17;                  // a class
    struct element {
        unsigned type = 0;
        std::string_view data;
    };

    [[noreturn]] void fail(std::string const& problem, char const* remedy) const {
        throw input_error{{.file = file_}, problem, remedy};
    }
    [[noreturn]] void damaged() const {
        fail("the file is cut or damaged", "save it again, with save -v6");
    }

    void check_head(std::string_view text) {
        constexpr std::string_view hdf = "\x89HDF\r\n";
        if (text.starts_with("MATLAB 7.3") || text.starts_with(hdf) ||
            (text.size() > 520 && text.substr(512).starts_with(hdf)))
            fail("a MATLAB file of version 7.3 (HDF5), which is not read",
                 "save it with save -v6 in MATLAB");
        auto const order = text.size() < head ? std::string_view{} : text.substr(126, 2);
        little_ = order == "IM";
        if (!little_ && order != "MI")
            fail("no MATLAB file of level 5", "save it with save -v6, or export a table");
        if (text[little_ ? 125 : 124] != 1)
            fail("a MATLAB file of another version than level 5", "save it with save -v6");
    }

    [[nodiscard]] std::uint32_t word(std::string_view text, std::size_t at) const {
        if (text.size() < at + 4) damaged();
        std::uint32_t x = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            auto const byte = static_cast<unsigned char>(text[at + (little_ ? 3 - i : i)]);
            x = x << 8 | byte;
        }
        return x;
    }

    /// Takes the next element off the text.
    element next(std::string_view& rest, bool padded = true) const {
        auto const first = word(rest, 0);
        element result;
        if (first >> 16 != 0) { // small: type, size and data in 8 bytes
            auto const size = first >> 16;
            if (size > 4 || rest.size() < 8) damaged();
            result = {first & 0xFFFF, rest.substr(4, size)};
            rest.remove_prefix(8);
            return result;
        }
        std::size_t const size = word(rest, 4);
        if (size > rest.size() - 8) damaged();
        result = {first, rest.substr(8, size)};
        auto const used = 8 + size;
        bool const pad = padded || first != compressed;
        rest.remove_prefix(std::min(rest.size(), pad ? (used + 7) / 8 * 8 : used));
        return result;
    }

    void top(element const& e) {
        if (e.type == matrix) return add(e.data, "", 0);
        if (e.type != compressed) return; // nothing that MATLAB writes
        if (!inflate_)
            fail("its variables are compressed, and this program was built without zlib",
                 "save it with save -v6, or install zlib and build again");
        auto text = inflate_(e.data, static_cast<std::size_t>(largest_text) - inflated_);
        if (!text)
            fail("a compressed variable is damaged, or all are larger than 1 GB",
                 "save it again, with save -v6");
        inflated_ += text->size();
        texts_.push_back(std::move(*text));
        std::string_view rest = texts_.back();
        auto const inner = next(rest);
        if (inner.type == matrix) add(inner.data, "", 0);
    }

    void add(std::string_view body, std::string const& prefix, std::size_t depth) {
        static constexpr std::array<char const*, 16> classes{
            "",     "cell",  "struct", "object", "char",  "sparse", "double", "single",
            "int8", "uint8", "int16",  "uint16", "int32", "uint32", "int64",  "uint64"};
        if (body.empty()) return; // an empty field
        auto const about = word(next(body).data, 0);
        auto const kind = about & 0xFF;
        matlab_variable v;
        if (kind == opaque) { // its name, "MCOS", its class, and what MATLAB alone knows
            v.name = prefix + std::string{next(body).data};
            (void)next(body);
            v.about = "an object of class " + in_quotes(next(body).data);
            v.object = true;
            variables_.push_back(std::move(v));
            return;
        }
        auto const dims = next(body), name = next(body);
        v.name = prefix + std::string{name.data};
        if (v.name.empty()) return; // MATLAB's store of what its objects hold
        v.about = kind > 0 && kind < classes.size() ? classes[kind] : "something else";
        bool const complex = (about & 0x0800) != 0;
        if (complex) v.about = "complex " + v.about;
        if (dims.data.size() < 8 || dims.data.size() % 4 != 0) damaged();
        for (std::size_t i = 0; i < dims.data.size(); i += 4)
            v.about += (i == 0 ? " " : "x") + std::to_string(word(dims.data, i));
        v.rows = word(dims.data, 0);
        v.columns = word(dims.data, 4);
        v.swapped = little_ != (std::endian::native == std::endian::little);
        bool const flat = dims.data.size() == 8;
        if (kind == 2 && flat && v.rows == 1 && v.columns == 1 && depth < deepest)
            return fields(body, v.name + ".", depth + 1);
        if (kind >= 6 && kind < classes.size() && flat && !complex) {
            auto const real = next(body);
            static constexpr std::array<std::size_t, 14> sizes{0, 1, 1, 2, 2, 4, 4,
                                                               4, 0, 8, 0, 0, 8, 8};
            v.type = real.type;
            v.bytes = real.type < sizes.size() ? sizes[real.type] : 0;
            v.data = real.data;
            // Both below 2^32: the product is no more than 64 bits hold, but for the bytes of each.
            auto const count = static_cast<std::uint64_t>(v.rows) * v.columns;
            if (v.bytes == 0 || v.data.size() % v.bytes != 0 || v.data.size() / v.bytes != count)
                damaged();
            v.numeric = true;
            v.single = kind == 7;
        }
        variables_.push_back(std::move(v));
    }

    /// The fields of a structure of one element.
    void fields(std::string_view body, std::string const& prefix, std::size_t depth) {
        auto const length = next(body), names = next(body);
        auto const size = word(length.data, 0);
        if (size == 0 || names.data.size() % size != 0) damaged();
        for (std::size_t i = 0; i < names.data.size(); i += size) {
            auto name = names.data.substr(i, size);
            name = name.substr(0, std::min(name.find('\0'), name.size()));
            auto const e = next(body);
            if (e.type != matrix) damaged();
            add(e.data, prefix + std::string{name}, depth);
        }
    }

    std::string file_;
    inflate_function inflate_;
    std::deque<std::string> texts_; ///< the file, and what was inflated
    std::size_t inflated_ = 0;
    bool little_ = true;
    std::vector<matlab_variable> variables_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_MATLAB_FILE_HPP
