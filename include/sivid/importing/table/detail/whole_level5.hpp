// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_TABLE_DETAIL_WHOLE_LEVEL5_HPP
#define SIVID_IMPORTING_TABLE_DETAIL_WHOLE_LEVEL5_HPP

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sivid {

/// Whether a file of MATLAB's level 5 (save -v6, -v7) is whole: libmatio 1.5.23 makes up numbers
/// where such a file is cut, and may run for hours where a size in it is damaged. That each element
/// has the bytes that its sizes claim, and each compressed one its check sum, is seen here first.
class whole_level5 {
public:
    static constexpr std::size_t head = 128;

    /// @param text  of a file of level 5, its head included
    /// @param most  bytes that its compressed elements may have together
    whole_level5(std::string_view text, std::size_t most)
        : little_{text.substr(126, 2) == "IM"}, most_{most} {
        text.remove_prefix(head);
        while (whole_ && !text.empty()) {
            auto const e = next(text, false);
            if (e.type == compressed) {
                auto const inner = inflated(e.data);
                std::string_view rest = inner;
                if (whole_) element_within(next(rest));
            } else {
                element_within(e);
            }
        }
    }

    explicit operator bool() const { return whole_; }

private:
    static constexpr unsigned matrix = 14, compressed = 15;
    static constexpr std::size_t deepest = 64;
    struct element {
        unsigned type = 0;
        std::string_view data;
    };

    element damaged() {
        whole_ = false;
        return {};
    }
    [[nodiscard]] std::uint32_t word(std::string_view text, std::size_t at = 0) {
        if (text.size() < at + 4) {
            whole_ = false;
            return 0;
        }
        std::uint32_t x = 0;
        for (std::size_t i = 0; i < 4; ++i)
            x = x << 8 | static_cast<unsigned char>(text[at + (little_ ? 3 - i : i)]);
        return x;
    }

    /// Takes the next element off the text.
    element next(std::string_view& rest, bool padded = true) {
        auto const first = word(rest);
        if (first >> 16 != 0) { // small: type, size and data in 8 bytes
            auto const size = first >> 16;
            if (size > 4 || rest.size() < 8) return damaged();
            element const small{first & 0xFFFF, rest.substr(4, size)};
            rest.remove_prefix(8);
            return small;
        }
        std::size_t const size = word(rest, 4);
        if (!whole_ || size > rest.size() - 8) return damaged();
        element const large{first, rest.substr(8, size)};
        auto const used = 8 + size;
        bool const pad = padded || first != compressed;
        rest.remove_prefix(std::min(rest.size(), pad ? (used + 7) / 8 * 8 : used));
        return large;
    }

    void element_within(element const& e, std::size_t depth = 0) {
        if (!whole_ || e.type != matrix || e.data.empty()) return;
        auto body = e.data;
        auto const about = word(next(body).data);
        auto const kind = about & 0xFF;
        if (kind > 16) return; // an object: of it the name alone is read
        auto const dims = next(body).data;
        (void)next(body); // its name
        std::uint64_t count = 1;
        for (std::size_t i = 0; whole_ && i < dims.size(); i += 4) {
            count *= word(dims, i);
            if (count > e.data.size()) count = e.data.size() + 1; // too many, not to overflow
        }
        if (dims.size() < 8 || depth > deepest) whole_ = false;
        if (kind == 1) children(body, count, depth);
        if (kind == 2 || kind == 3) fields(body, kind == 3, count, depth);
        bool const complex = (about & 0x0800) != 0;
        for (int part = 0; whole_ && kind >= 6 && part < (complex ? 2 : 1); ++part)
            numbers(next(body), count);
    }
    void fields(std::string_view body, bool of_class, std::uint64_t count, std::size_t depth) {
        if (of_class) (void)next(body);
        auto const length = word(next(body).data);
        auto const names = next(body).data.size();
        if (!whole_ || length == 0 || names % length != 0) {
            whole_ = false;
            return;
        }
        children(body, count * (names / length), depth);
    }
    void children(std::string_view body, std::uint64_t count, std::size_t depth) {
        for (; whole_ && count > 0; --count) { // each takes bytes
            auto const e = next(body);
            if (e.type != matrix) whole_ = false;
            element_within(e, depth + 1);
        }
    }
    void numbers(element const& e, std::uint64_t count) {
        static constexpr std::array<std::size_t, 14> sizes{0, 1, 1, 2, 2, 4, 4,
                                                           4, 0, 8, 0, 0, 8, 8};
        auto const bytes = e.type < sizes.size() ? sizes[e.type] : 0;
        bool const none = count == 0 && e.data.empty();
        if (!none && (bytes == 0 || e.data.size() % bytes != 0 || e.data.size() / bytes != count))
            whole_ = false;
    }

    /// Undoes zlib's compression; the check sum at the end of it must hold.
    [[nodiscard]] std::string inflated(std::string_view packed) {
        std::string text;
        z_stream stream{};
        if (!whole_ || inflateInit(&stream) != Z_OK) return text;
        // zlib takes the input by a pointer that is not const, and leaves it alone.
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
        stream.avail_in = static_cast<uInt>(packed.size());
        std::array<char, 65536> buffer;
        int state = Z_OK;
        while (state == Z_OK && text.size() <= most_) {
            stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
            stream.avail_out = static_cast<uInt>(buffer.size());
            state = inflate(&stream, Z_NO_FLUSH);
            text.append(buffer.data(), buffer.size() - stream.avail_out);
        }
        inflateEnd(&stream);
        whole_ = state == Z_STREAM_END && text.size() <= most_;
        if (whole_) most_ -= text.size();
        return text;
    }

    bool little_;
    bool whole_ = true;
    std::size_t most_;
};

} // namespace sivid

#endif // SIVID_IMPORTING_TABLE_DETAIL_WHOLE_LEVEL5_HPP
