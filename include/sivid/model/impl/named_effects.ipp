// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_NAMED_EFFECTS_IPP
#define SIVID_MODEL_IMPL_NAMED_EFFECTS_IPP

#include <sivid/model/named_effects.hpp>

#include <sivid/compiled.hpp>
#include <sivid/model/effects.hpp>
#include <sivid/model/unit.hpp>
#include <sivid/number/decimal.hpp>
#include <sivid/number/text/kept_decimal.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

namespace detail {

/// Cuts the time off that stands behind a sign at the end of "S4>=1.5" or "S4<4"; `otherwise` where
/// there is none.
inline double time_behind(std::string_view sign, std::string& experiment, double otherwise) {
    auto const at = experiment.find(sign);
    if (at == std::string::npos) return otherwise;
    auto const text = experiment.substr(at + sign.size());
    auto const t = parse_nearest(text);
    if (!t) throw std::invalid_argument("effect: '" + text + "' is no time");
    experiment.resize(at);
    return *t;
}

/// Splits "NAME@S4+S5"; without experiments the name as it is.
inline std::vector<std::string> experiments_in(std::string& name) {
    std::vector<std::string> result;
    auto const at = name.find('@');
    if (at == std::string::npos) return result;
    for (std::size_t begin = at + 1; begin <= name.size();) {
        auto const end = std::min(name.find('+', begin), name.size());
        result.push_back(name.substr(begin, end - begin));
        begin = end + 1;
    }
    name.resize(at);
    return result;
}

/// "sensor_lag(u:v)~0.5" in its parts.
struct fault_name {
    std::string whole, kind, size;
    std::vector<std::string> in_brackets;

    explicit fault_name(std::string const& text) : whole(text) {
        auto const opens = text.find('('), closes = text.find(")~");
        if (opens == std::string::npos || closes == std::string::npos || closes < opens)
            fail("no channels in brackets, or no size");
        kind = text.substr(0, opens);
        for (auto begin = opens + 1; begin <= closes;) {
            auto const end = std::min(text.find(':', begin), closes);
            in_brackets.push_back(text.substr(begin, end - begin));
            if (in_brackets.back().empty()) fail("a name is missing in the brackets");
            begin = end + 1;
        }
        size = text.substr(closes + 2);
        if (size.find_first_not_of("0123456789.") != std::string::npos || !parse_decimal(size) ||
            !(*parse_nearest(size) > 0))
            fail("'" + size + "' is no size above 0");
    }
    [[noreturn]] void fail(std::string const& why) const {
        throw std::invalid_argument("sensor fault '" + whole + "': " + why +
                                    "; write one as in sensor_drift(r)~0.1");
    }
    void need(std::size_t count) const {
        if (in_brackets.size() != count)
            fail(count == 1 ? "one channel is needed"
                            : std::to_string(count) + " names are needed");
    }
    [[nodiscard]] effects::range either_way() const {
        return {-kept_decimal(size), kept_decimal(size)};
    }
    [[nodiscard]] effects::range from(char const* power_of_ten) const {
        return {kept_decimal(size + power_of_ten), kept_decimal(size)};
    }
};

} // namespace detail

SIVID_DECL std::vector<std::string> faulty_channels(std::string const& name) {
    auto plain = name; // it may act in some experiments only, or be a wider one
    (void)detail::experiments_in(plain);
    if (plain.ends_with(detail::wider)) plain.resize(plain.size() - detail::wider.size());
    detail::fault_name f(plain);
    if (f.kind.ends_with("_arm") && f.in_brackets.size() == 3) f.in_brackets.pop_back(); // a state
    return f.in_brackets;
}

SIVID_DECL effect sensor_fault(std::string const& name, model_description const* about) {
    using namespace literals;
    namespace kinds = effects;
    detail::fault_name const f(name);
    auto const& channels = f.in_brackets;
    auto const unit_of = [about](std::string const& channel) {
        if (about == nullptr) return std::string{};
        auto const y = std::find_if(about->channels.begin(), about->channels.end(),
                                    [&](auto const& c) { return c.name == channel; });
        return y == about->channels.end() ? std::string{} : y->unit;
    };
    if (f.kind == "sensor_bias" || f.kind == "sensor_drift") {
        bool const drifts = f.kind == "sensor_drift";
        effect joint;
        for (auto const& y : channels) {
            auto const unit = unit_of(y);
            auto one = drifts
                           ? kinds::sensor_drift(
                                 name, y, unit.empty() ? unit : rate_unit(unit, about->time_unit),
                                 f.either_way())
                           : kinds::sensor_bias(name, y, unit, f.either_way());
            joint.name = name;
            joint.about += (joint.about.empty() ? "" : ", ") + one.about;
            joint.parameters.push_back(one.parameters.front());
            if (channels.size() > 1) joint.parameters.back().name += "_" + y;
        }
        joint.on_channels = [channels, drifts](effect_scope& m) {
            for (std::size_t k = 0; k < channels.size(); ++k)
                m.channel(channels[k]) += drifts ? m.parameter(k) * m.time() : m.parameter(k);
        };
        return joint;
    }
    if (f.kind == "sensor_scale") return kinds::sensor_scale(name, channels, f.either_way());
    if (f.kind == "sensor_latency")
        return kinds::sensor_latency(name, channels, {0_dec, kept_decimal(f.size)});
    if (f.kind == "sensor_lag") return kinds::sensor_lag(name, channels, f.from("e-2"));
    if (f.kind == "sensor_saturation") {
        f.need(1);
        return kinds::sensor_saturation(name, channels[0], unit_of(channels[0]), f.from("e-1"));
    }
    if (f.kind == "sensor_wrap") {
        f.need(1);
        return kinds::sensor_wrap(name, channels[0], unit_of(channels[0]), f.from("e-1"),
                                  *parse_nearest(f.size) / 4);
    }
    bool const arm = f.kind == "sensor_lever_arm", beside = f.kind == "sensor_velocity_arm";
    f.need(arm || beside ? 3 : 2);
    if (f.kind == "sensor_rotation") return kinds::sensor_rotation(name, channels, f.either_way());
    if (f.kind == "sensor_swap") return kinds::sensor_swap(name, channels, f.either_way());
    std::vector<std::string> const two{channels[0], channels[1]};
    auto const unit = unit_of(two[0]);
    if (arm) return kinds::sensor_lever_arm(name, two, channels[2], unit, f.either_way());
    if (beside) {
        auto const length =
            unit.empty() ? unit : sivid::unit(unit).times(sivid::unit(about->time_unit), 1).text();
        return kinds::sensor_velocity_arm(name, two, channels[2], length, f.either_way());
    }
    f.fail("there are sensor_bias, drift, scale, latency, lag, saturation, wrap, rotation, swap, "
           "lever_arm and velocity_arm");
}

SIVID_DECL std::vector<effect> effects_named(std::vector<effect> const& catalogue,
                                             std::vector<std::string> const& names,
                                             model_description const* about) {
    std::vector<effect> result;
    for (auto name : names) {
        bool known = std::any_of(catalogue.begin(), catalogue.end(),
                                 [&](effect const& e) { return e.name == name; });
        auto within = known ? std::vector<std::string>{} : detail::experiments_in(name);
        std::vector<double> since, until;
        for (auto& x : within) {
            until.push_back(detail::time_behind("<", x, effect::for_ever));
            since.push_back(detail::time_behind(">=", x, effect::from_start));
            if (!(since.back() < until.back()))
                throw std::invalid_argument("effect '" + name + "' ends in " + x +
                                            " before it begins");
        }
        known = std::any_of(catalogue.begin(), catalogue.end(),
                            [&](effect const& e) { return e.name == name; });
        bool const wider = !known && name.ends_with(detail::wider);
        if (wider) name.resize(name.size() - detail::wider.size());
        auto const in_catalogue = [&] { return catalogue[index_of(catalogue, name, "effect")]; };
        auto found = known                      ? in_catalogue()
                     : names_missing_term(name) ? missing_term(name)
                     : names_sensor_fault(name) ? sensor_fault(name, about)
                                                : in_catalogue();
        result.push_back(wider ? widened(std::move(found)) : std::move(found));
        if (!within.empty()) result.back() = only_within(result.back(), within, since, until);
    }
    return result;
}

} // namespace sivid

#endif
