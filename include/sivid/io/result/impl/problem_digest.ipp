// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_IMPL_PROBLEM_DIGEST_IPP
#define SIVID_IO_RESULT_IMPL_PROBLEM_DIGEST_IPP

#include <sivid/io/result/problem_digest.hpp>

namespace sivid {

SIVID_DECL std::string problem_digest(identification_problem const& problem,
                                      identify_options const& options, std::string const& also) {
    model_detail::canonical_text text;
    describe(text, problem);
    io_detail::describe(text, options);
    return sha256(text("also", also).text());
}

SIVID_DECL std::string problem_digest(identification_problem const& problem) {
    model_detail::canonical_text text;
    io_detail::describe_meaning(text, problem);
    return sha256(text.text());
}

} // namespace sivid

#endif
