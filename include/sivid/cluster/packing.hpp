// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_PACKING_HPP
#define SIVID_CLUSTER_PACKING_HPP

/// @file
/// Values as bytes, in messages between processes of one program: Boost.Serialization's binary
/// archives, so that every bit of a double comes back.

#include <sivid/number/interval.hpp>
#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/paving/set_test.hpp>
#include <sivid/space/box.hpp>

#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

namespace boost::serialization {

template <class Archive>
void serialize(Archive& a, sivid::measurement_weight& w, unsigned) {
    a& w.experiment& w.output& w.value;
}
template <class Archive>
void serialize(Archive& a, sivid::proof_step& s, unsigned) {
    a& s.what& s.index& s.upper& s.at& s.why;
}
template <class Archive>
void save(Archive& a, sivid::box const& x, unsigned) {
    std::vector<std::pair<double, double>> sides;
    for (auto const& side : x) sides.emplace_back(side.lower(), side.upper());
    a << sides;
}
template <class Archive>
void load(Archive& a, sivid::box& x, unsigned) {
    using traits = sivid::interval_traits<sivid::interval>;
    std::vector<std::pair<double, double>> sides;
    a >> sides;
    std::vector<sivid::interval> list;
    for (auto const& [lower, upper] : sides)
        list.push_back(lower <= upper ? traits::bounds(lower, upper) : traits::empty());
    x = sivid::box(std::move(list));
}
template <class Archive>
void serialize(Archive& a, sivid::box& x, unsigned version) {
    split_free(a, x, version);
}
/// All but the knowledge, which stays where it was found.
template <class Archive, class Knowledge>
void serialize(Archive& a, sivid::assessment<Knowledge>& says, unsigned) {
    a& says.verdict& says.rest& says.smear& says.blind& says.cost& says.work& says.proof;
}

} // namespace boost::serialization

namespace sivid::cluster {

/// Puts values behind each other.
class packer {
public:
    template <class T>
    packer& put(T const& value) {
        archive_ << value;
        return *this;
    }
    [[nodiscard]] std::string take() const { return std::move(bytes_).str(); }

private:
    std::ostringstream bytes_;
    boost::archive::binary_oarchive archive_{bytes_, boost::archive::no_header |
                                                         boost::archive::no_codecvt};
};

/// Takes values, one after the other.
/// @throws boost::archive::archive_exception  where there is none left
class unpacker {
public:
    explicit unpacker(std::string_view bytes) : bytes_(std::string{bytes}) {}
    template <class T>
    [[nodiscard]] T take() {
        T value{};
        archive_ >> value;
        return value;
    }

private:
    std::istringstream bytes_;
    boost::archive::binary_iarchive archive_{bytes_, boost::archive::no_header |
                                                         boost::archive::no_codecvt};
};

template <class... T>
[[nodiscard]] std::string packed(T const&... values) {
    packer out;
    (out.put(values), ...);
    return out.take();
}

} // namespace sivid::cluster

#endif
