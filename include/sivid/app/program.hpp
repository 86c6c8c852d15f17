// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_PROGRAM_HPP
#define SIVID_APP_PROGRAM_HPP

#include <sivid/app/outputs.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/io/text/printable_text.hpp>
#include <sivid/io/text/text_file.hpp>

#include <csignal>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

/// @file
/// What a command line program of sivid's is made of: exit codes, options in decimals, one message
/// for whatever goes wrong.
namespace sivid::app {

/// Exit codes of sivid's programs.
enum exit_code {
    done = 0,
    consistent = 0,
    bad_input = 2,
    undecided = 3,
    inconsistent = 4,
    refuted = 5, ///< of a check: the result is not what its data prove
    internal_error = 70
};

/// A request that cannot be met: the message says why.
class bad_request : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

/// The command as it was given, for the report's footer.
inline std::string command_line(std::string program, int argc, char** argv) {
    for (int i = 1; i < argc; ++i) program += std::string{" "} + argv[i];
    return program;
}

/// What was printed has arrived.
/// @throws output_error
inline void require_printed() {
    if (!result_stream().flush())
        throw output_error("the standard output cannot be written; check permissions and "
                           "space");
}

/// What went wrong, in words for people, and what a program ends with then.
struct failure {
    int code = internal_error;
    std::string words;
};
/// Bad input, requests that cannot be met (std::invalid_argument), more than the memory holds and
/// files that cannot be written are bad_input, all else is an internal error.
inline failure failure_of(std::exception const& e) {
    if (auto const* const f = dynamic_cast<std::filesystem::filesystem_error const*>(&e))
        return {bad_input, printable_path(f->path1().string()) + ": " + f->code().message() +
                               "; check the path and its permissions"};
    if (dynamic_cast<std::bad_alloc const*>(&e) != nullptr)
        return {bad_input, "the memory does not suffice; ask for less: fewer samples, a coarser "
                           "accuracy, a shorter duration"};
    // Whatever a message quotes, it must not steer the terminal, nor fill it.
    auto const text = printable_text(e.what(), 4000, true);
    bool const refused = dynamic_cast<input_error const*>(&e) != nullptr ||
                         dynamic_cast<output_error const*>(&e) != nullptr ||
                         dynamic_cast<std::invalid_argument const*>(&e) != nullptr ||
                         // a model or motion that is not defined there
                         dynamic_cast<std::domain_error const*>(&e) != nullptr;
    return refused ? failure{bad_input, text} : failure{internal_error, "internal error: " + text};
}

/// Runs a program that speaks there, and turns what it throws into one message and an exit code.
template <class Program>
int guarded(std::string const& name, outputs const& to, Program const& program) {
    detail::speaking const there(to);
#ifdef SIGXFSZ
    std::signal(SIGXFSZ, SIG_IGN); // a file beyond the limit is an error of writing, with a message
#endif
    try {
        int const code = program();
        require_printed();
        return code;
    } catch (std::exception const& e) {
        auto const failed = failure_of(e);
        to.notices << name << ": " << failed.words << "\n";
        return failed.code;
    }
}

/// The value of an option that is a decimal number. @throws bad_request
inline exact_decimal decimal_of(std::string const& text, std::string const& what) {
    auto const value = exact_decimal::parse(text);
    if (!value || !enclose(*value))
        throw bad_request(what + ": " + in_quotes(text) + " is not a decimal number");
    return *value;
}
/// And one above 0. @throws bad_request
inline exact_decimal positive_decimal(std::string const& text, std::string const& what) {
    auto const value = decimal_of(text, what);
    if (!value.is_positive())
        throw bad_request(what + ": " + in_quotes(text) + " is not a decimal number above 0");
    return value;
}

/// Creates the folder for results.
/// @throws output_error
inline void prepare_folder(std::filesystem::path const& folder) {
    if (folder.empty()) throw output_error("--out is empty: give a folder for the results");
    std::error_code fault;
    auto const name = printable_path(folder.string());
    if (std::filesystem::exists(folder, fault) && !std::filesystem::is_directory(folder, fault))
        throw output_error(name + " is a file; give a folder for the results");
    fault.clear();
    std::filesystem::create_directories(folder, fault);
    if (fault || !std::filesystem::is_directory(folder))
        throw output_error("the folder " + name + " cannot be created" +
                           (fault ? ": " + fault.message() : std::string{}));
}

} // namespace sivid::app

#endif
