// SPDX-License-Identifier: MIT
// A kernel of the library that is broken, as a compiler might: every solver has to refuse.
#include <sivid/number/pack.hpp>


namespace sivid::simd {
template <>
bounds<vector<1>> sin(bounds<vector<1>> const& x) noexcept {
    return cos(x);
}
} // namespace sivid::simd

#include <sivid/impl/library.ipp>
#include <sivid/number/impl/guard.ipp>

#include <cstdio>
#include <string>

int main() {
    try {
        sivid::require_sound_environment();
    } catch (sivid::unsound_environment const& e) {
        std::puts(e.what());
        return std::string{e.what()}.find("sin of pack<1>") == std::string::npos ? 1 : 0;
    }
    std::puts("accepted");
    return 1;
}
