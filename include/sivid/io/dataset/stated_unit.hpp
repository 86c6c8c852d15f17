// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DATASET_STATED_UNIT_HPP
#define SIVID_IO_DATASET_STATED_UNIT_HPP

#include <sivid/io/dataset/unit_conversion.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/model/unit.hpp>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// The unit of a text as it stands in a file.
/// @throws input_error  for a text that is no unit
[[nodiscard]] inline unit read_unit(json_value const& entry) {
    unit result(entry.any_string());
    if (!result.fault().empty())
        entry.fail(text_of(in_quotes(entry.any_string()), " is no unit: ", result.fault()),
                   "write one such as \"rad/s\", \"kg m^2/s\" or \"counts\"");
    return result;
}

/// The unit in which a file states a quantity, beside the model's: what is stated is read in it.
/// The same unit leaves every number as it is; one of the same dimension converts.
class stated_unit {
public:
    /// The model's.
    stated_unit() = default;

    /// @param entry  the text of the unit
    /// @param own    the model's unit
    /// @param what   it is the unit of, for messages: "the channel 'psi'"
    /// @throws input_error  for a text that is no unit, and for a unit of another dimension
    stated_unit(json_value const& entry, std::string const& own, std::string const& what) {
        auto const& stated = entry.any_string();
        if (stated == own) return;
        auto const from = read_unit(entry);
        unit const to(own);
        auto const ratio = from.in(to);
        if (ratio && ratio->is_one()) return;
        if (ratio) change_ = unit_conversion::of(*ratio);
        if (!change_)
            entry.fail(text_of(in_quotes(stated), " is the unit of ", what,
                               ", which does not convert to the model's ",
                               in_quotes(own.empty() ? "1" : own)),
                       text_of("convert the numbers and state ", in_quotes(own.empty() ? "1" : own),
                               ", or correct the unit"));
        name_ = stated;
    }

    /// As the file has it; empty: numbers are the model's as they stand.
    [[nodiscard]] std::string const& name() const { return name_; }

    /// The nearest double of x in the model's unit; nothing beyond the largest one.
    [[nodiscard]] std::optional<double> nearest(exact_decimal const& x) const {
        if (!change_) return sivid::nearest(x);
        auto const y = (*change_)(x);
        return y ? sivid::nearest(y->value) : std::nullopt;
    }

    /// [lower, upper] in the model's unit, outward where no decimal is exact.
    /// @returns  nothing beyond the largest double
    [[nodiscard]] std::optional<stated_range> range(exact_decimal lower,
                                                    exact_decimal upper) const {
        if (change_) {
            auto const a = (*change_)(lower), b = (*change_)(upper);
            if (!a || !b) return std::nullopt;
            lower = a->value - a->rounding;
            upper = b->value + b->rounding;
        }
        auto const enclosure = enclose(lower, upper);
        if (!enclosure) return std::nullopt;
        return stated_range{std::move(lower), std::move(upper), *enclosure};
    }

    /// value +/- error in the model's unit, what the conversion rounds added to the error.
    /// @returns  nothing beyond the largest double
    [[nodiscard]] std::optional<stated_measurement> operator()(stated_measurement m) const {
        if (!change_) return m;
        auto y = (*change_)(m.value);
        if (!y) return std::nullopt;
        auto error = change_->bound(m.error, unit_conversion::digits);
        if (!y->rounding.is_zero())
            error = rounded_up(error + y->rounding, unit_conversion::digits);
        return stated_measurement{std::move(y->value), std::move(error)};
    }

    /// The error bound of a sample whose nearest double `read` stands for `m.value`.
    [[nodiscard]] std::optional<exact_decimal> error_of(double read, stated_measurement m) const {
        if (!change_) return std::move(m.error);
        auto const y = (*this)(std::move(m));
        if (!y || !std::isfinite(read)) return std::nullopt;
        return rounded_up(y->error + magnitude(exact_decimal::of(read) - y->value), 15);
    }

private:
    std::optional<unit_conversion> change_;
    std::string name_;
};

/// The units of the tables of a data set; what is not stated is in the model's.
struct stated_units {
    stated_unit time;
    std::vector<stated_unit> channels, inputs; ///< empty, or one for each of the model's

    [[nodiscard]] static stated_unit const& of(std::vector<stated_unit> const& list,
                                               std::size_t i) {
        static stated_unit const own;
        return list.empty() ? own : list.at(i);
    }
};

} // namespace sivid

#endif // SIVID_IO_DATASET_STATED_UNIT_HPP
