// SPDX-License-Identifier: MIT
// Right-hand sides x' = rate(t, x, p, u) behind functions, one for each scalar: what tests them is
// compiled once for all systems, not once for each.
#ifndef SIVID_TESTS_SUPPORT_RATES_HPP
#define SIVID_TESTS_SUPPORT_RATES_HPP

#include <functional>
#include <tuple>
#include <vector>

namespace support {

template <class T>
using rate_on = std::function<std::vector<T>(T const&, std::vector<T> const&, std::vector<T> const&,
                                             std::vector<T> const&)>;

/// One generic function on several scalars.
template <class... Scalars>
class rate_for {
public:
    template <class Rate>
    rate_for(Rate const& rate) : on_(rate_on<Scalars>(rate)...) {}

    template <class T>
    [[nodiscard]] rate_on<T> const& on() const {
        return std::get<rate_on<T>>(on_);
    }
    template <class T>
    operator rate_on<T> const&() const {
        return on<T>();
    }
    template <class T>
    std::vector<T> operator()(T const& t, std::vector<T> const& x, std::vector<T> const& p,
                              std::vector<T> const& u) const {
        return on<T>()(t, x, p, u);
    }

private:
    std::tuple<rate_on<Scalars>...> on_;
};

} // namespace support

#endif
