// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_WIRE_HPP
#define SIVID_CLUSTER_WIRE_HPP

/// @file
/// Values as bytes, for messages between processes: integers of eight bytes, least first; doubles
/// by their bits; lists with their length in front. What is read is checked as it is read.

#include <sivid/number/interval.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid::cluster {

/// A message that nobody of this version has written.
struct wire_error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Puts values behind each other.
class wire_writer {
public:
    wire_writer& put(std::uint64_t x) {
        for (int k = 0; k < 8; ++k, x >>= 8) bytes_ += static_cast<char>(x & 0xff);
        return *this;
    }
    wire_writer& put(double x) { return put(std::bit_cast<std::uint64_t>(x)); }
    wire_writer& put(bool x) { return put(std::uint64_t{x ? 1U : 0U}); }
    wire_writer& put(std::string_view text) {
        put(std::uint64_t{text.size()});
        bytes_ += text;
        return *this;
    }
    wire_writer& put(std::vector<double> const& list) {
        put(std::uint64_t{list.size()});
        for (double const x : list) put(x);
        return *this;
    }
    wire_writer& put(box const& x) {
        put(std::uint64_t{x.size()});
        for (auto const& side : x) put(side.lower()).put(side.upper());
        return *this;
    }
    wire_writer& put(exclusion_proof const& proof) {
        put(std::uint64_t{proof.size()});
        for (auto const& s : proof) {
            put(static_cast<std::uint64_t>(s.what)).put(std::uint64_t{s.index});
            put(s.upper).put(s.at).put(std::uint64_t{s.why.size()});
            for (auto const& group : s.why) {
                put(std::uint64_t{group.size()});
                for (auto const& w : group) {
                    put(std::uint64_t{w.experiment}).put(std::uint64_t{w.output}).put(w.value);
                }
            }
        }
        return *this;
    }
    /// All but the knowledge, which stays where it was found.
    template <class Knowledge>
    wire_writer& put(assessment<Knowledge> const& a) {
        put(static_cast<std::uint64_t>(a.verdict)).put(a.rest).put(a.smear).put(a.blind);
        return put(std::uint64_t{a.cost}).put(a.proof);
    }

    [[nodiscard]] std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

/// Takes values one after the other.
class wire_reader {
public:
    /// @param bytes  are referred to
    explicit wire_reader(std::string_view bytes) : rest_(bytes) {}

    /// @throws wire_error  (all of these) for what cannot have been written
    [[nodiscard]] std::uint64_t number() {
        auto const text = take(8);
        std::uint64_t x = 0;
        for (std::size_t k = 8; k-- > 0;) x = x << 8 | static_cast<unsigned char>(text[k]);
        return x;
    }
    [[nodiscard]] double real() { return std::bit_cast<double>(number()); }
    [[nodiscard]] bool flag() { return below(2) != 0; }
    /// A number below a bound.
    [[nodiscard]] std::uint64_t below(std::uint64_t bound) {
        auto const x = number();
        require(x < bound, "a number out of its range");
        return x;
    }
    /// How many items follow: never more than there are bytes for.
    [[nodiscard]] std::size_t count(std::size_t bytes_each) {
        auto const n = number();
        require(n <= rest_.size() / bytes_each, "a length beyond the message");
        return static_cast<std::size_t>(n);
    }
    [[nodiscard]] std::string_view text() { return take(count(1)); }
    [[nodiscard]] std::vector<double> reals() {
        std::vector<double> list(count(8));
        for (auto& x : list) x = real();
        return list;
    }
    /// A box that is not empty in any side, with so many sides.
    [[nodiscard]] box sides(std::size_t dimension) {
        require(count(16) == dimension, "a box of another dimension");
        std::vector<interval> list;
        for (std::size_t k = 0; k < dimension; ++k) {
            double const lower = real(), upper = real();
            require(lower <= upper, "a box with an empty side");
            list.push_back(interval_traits<interval>::bounds(lower, upper));
        }
        return box(std::move(list));
    }
    [[nodiscard]] exclusion_proof proof() {
        using kind = proof_step::kind;
        exclusion_proof steps(count(40));
        for (auto& s : steps) {
            s.what = static_cast<kind>(below(static_cast<std::uint64_t>(kind::leaf) + 1));
            s.index = static_cast<std::size_t>(number());
            s.upper = flag();
            s.at = real();
            s.why.resize(count(8));
            for (auto& group : s.why) {
                group.resize(count(24));
                for (auto& w : group) {
                    w.experiment = static_cast<std::size_t>(number());
                    w.output = static_cast<std::size_t>(number());
                    w.value = real();
                }
            }
        }
        return steps;
    }
    /// What a test says of a box.
    template <class Knowledge>
    [[nodiscard]] assessment<Knowledge> answer(box const& about) {
        assessment<Knowledge> a;
        a.verdict = static_cast<box_verdict>(below(static_cast<std::uint64_t>(last_verdict) + 1));
        a.rest = rest_of(about);
        a.smear = reals();
        require(a.smear.empty() || a.smear.size() == about.size(), "a smear of another dimension");
        a.blind = flag();
        a.cost = static_cast<std::size_t>(number());
        a.proof = proof();
        return a;
    }
    /// @throws wire_error  where something is left
    void finish() const { require(rest_.empty(), "bytes after its end"); }

    static void require(bool holds, char const* what) {
        if (!holds) throw wire_error(std::string{"a damaged message: "} + what);
    }

private:
    static constexpr box_verdict last_verdict = box_verdict::pending;

    [[nodiscard]] std::string_view take(std::size_t size) {
        require(size <= rest_.size(), "it ends too early");
        auto const text = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return text;
    }
    /// A part of a box, which may be empty.
    [[nodiscard]] box rest_of(box const& about) {
        require(count(16) == about.size(), "a box of another dimension");
        std::vector<interval> list;
        for (auto const& side : about) {
            double const lower = real(), upper = real();
            bool const empty = !(lower <= upper);
            require(empty || (side.lower() <= lower && upper <= side.upper()),
                    "what is left of a box is no part of it");
            list.push_back(empty ? interval_traits<interval>::empty()
                                 : interval_traits<interval>::bounds(lower, upper));
        }
        return box(std::move(list));
    }

    std::string_view rest_;
};

} // namespace sivid::cluster

#endif
