// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_SERIES_DETAIL_SERIES_STORAGE_HPP
#define SIVID_MODEL_SERIES_DETAIL_SERIES_STORAGE_HPP

#include <sivid/model/graph/arithmetic.hpp>
#include <sivid/work_clock.hpp>

#include <cstddef>
#include <vector>

namespace sivid {

namespace model_detail {
struct nothing {};
/// What an arithmetic keeps coefficients in for convolutions, if it does.
template <class Arithmetic>
struct rows_of {
    using type = nothing;
};
template <class Arithmetic>
    requires(Arithmetic::keeps_rows)
struct rows_of<Arithmetic> {
    using type = typename Arithmetic::rows;
};

/// What has to be known of the coefficients before there are any, and what they are kept in.
template <class T>
struct storage_of {
    struct size {}; ///< nothing: all values of the type have the same
    using type = std::vector<T>;
    static type make(std::size_t count, size) { return type(count, arithmetic_of<T>::point(0.0)); }
    template <class Rows>
    static Rows make_rows(std::size_t series, std::size_t orders, size) {
        return Rows(series, orders);
    }
};

/// Of a product, for the `work_clock`.
template <class T>
[[nodiscard]] double work_of(T const& value) {
    if constexpr (requires { value.shape().product_work; }) {
        return value.shape().product_work;
    } else {
        return work_clock::interval * (arithmetic_of<T>::lanes > 1 ? 2 : 1);
    }
}
} // namespace model_detail

/// See `model_detail::storage_of`.
template <class T>
using size_of_values = typename model_detail::storage_of<T>::size;

} // namespace sivid

#endif
