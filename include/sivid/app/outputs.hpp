// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_OUTPUTS_HPP
#define SIVID_APP_OUTPUTS_HPP

#include <ostream>
#include <utility>

namespace sivid::app {

/// Where the words of a command go; both outlive it.
struct outputs {
    std::ostream& results; ///< what it found
    std::ostream& notices; ///< progress, errors
};

namespace detail {
inline outputs const* outputs_of_command = nullptr;
/// For who asks outside of a command.
inline std::ostream& no_output() {
    static std::ostream none(nullptr);
    return none;
}
/// For as long as it lives, commands speak there.
class speaking {
public:
    explicit speaking(outputs const& to) : before_{std::exchange(outputs_of_command, &to)} {}
    ~speaking() { outputs_of_command = before_; }
    speaking(speaking const&) = delete;
    speaking& operator=(speaking const&) = delete;

private:
    outputs const* before_;
};
} // namespace detail

/// Where the command that runs prints what it found.
inline std::ostream& result_stream() {
    return detail::outputs_of_command ? detail::outputs_of_command->results : detail::no_output();
}
/// Where it prints everything else.
inline std::ostream& notice_stream() {
    return detail::outputs_of_command ? detail::outputs_of_command->notices : detail::no_output();
}

} // namespace sivid::app

#endif
