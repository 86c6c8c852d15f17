// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_FRAME_HPP
#define SIVID_CLUSTER_FRAME_HPP

#include <sivid/cluster/wire.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace sivid::cluster {

/// A message between the coordinator and a worker of its pool.
struct frame {
    enum class kind : std::uint8_t {
        hello,   ///< to a worker: who the coordinator is, what it works on
        welcome, ///< back: who the worker is
        ask,     ///< a request
        answer,  ///< to the request with that number
        fault,   ///< back: the worker cannot go on; why
        stop,    ///< what is asked for is no longer wanted: end it soon
        end      ///< the service is over
    };
    kind what = kind::end;
    std::uint64_t number = 0; ///< of the request
    std::string body = {};
};

namespace frame_detail {

/// Changed whenever messages are laid out otherwise.
inline constexpr std::string_view format = "sividw01";
inline constexpr std::size_t head = 8 + 8 + 8 + 8 + 8; ///< format, kind, number, size, sum

/// FNV-1a: tells bytes that were changed or mixed up, no forgery.
[[nodiscard]] inline std::uint64_t sum_of(std::string_view bytes,
                                          std::uint64_t sum = 0xcbf29ce484222325U) {
    for (char const c : bytes) {
        sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    }
    return sum;
}
/// Kind, number and size, as they stand in the message.
[[nodiscard]] inline std::string middle(frame const& f) {
    return wire_writer()
        .put(static_cast<std::uint64_t>(f.what))
        .put(f.number)
        .put(std::uint64_t{f.body.size()})
        .take();
}

} // namespace frame_detail

/// The bytes of a message: format, kind, number, size of the body, check sum, body.
[[nodiscard]] inline std::string to_bytes(frame const& f) {
    auto bytes = std::string{frame_detail::format} + frame_detail::middle(f);
    auto const sum = frame_detail::sum_of(f.body, frame_detail::sum_of(bytes));
    bytes += wire_writer().put(sum).take();
    return bytes += f.body;
}

/// @throws wire_error  for bytes that are not a message of this version, whole and unchanged
[[nodiscard]] inline frame frame_of(std::string_view bytes) {
    auto const require = wire_reader::require;
    require(bytes.substr(0, frame_detail::format.size()) == frame_detail::format,
            "it is of another program, or of another version of sivid");
    require(bytes.size() >= frame_detail::head, "it ends too early");
    wire_reader in(bytes.substr(8, frame_detail::head - 8));
    frame f;
    f.what = static_cast<frame::kind>(in.below(static_cast<std::uint64_t>(frame::kind::end) + 1));
    f.number = in.number();
    require(in.number() == bytes.size() - frame_detail::head, "its length is not what it says");
    auto const sum = in.number();
    auto const body = bytes.substr(frame_detail::head);
    auto const own =
        frame_detail::sum_of(body, frame_detail::sum_of(bytes.substr(0, frame_detail::head - 8)));
    require(own == sum, "its check sum is not that of its bytes");
    f.body = body;
    return f;
}

} // namespace sivid::cluster

#endif
