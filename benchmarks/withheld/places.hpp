// SPDX-License-Identifier: MIT
// Which equations and sensors an effect breaks: what a relation that is proved wrong must touch,
// and where a diagnosis should point first.
#ifndef WITHHELD_PLACES_HPP
#define WITHHELD_PLACES_HPP

#include <set>
#include <string>

namespace withheld {

struct places {
    std::set<std::string> equations, sensors, inputs;
};

/// Unknown names have no places, so that everything said of them is wrong.
places places_of(std::string const& effect);
places places_of(std::set<std::string> const& effects);

/// Does this place, of kind equation, sensor or input, lie among them? `position` is x or y.
bool holds(places const& all, std::string const& kind, std::string const& name);
/// The same for the name of a place, where x and y are one instrument.
bool holds_instrument(places const& all, std::string const& kind, std::string const& name);

/// Does anything act in this equation or in one of these sensors?
bool touches(places const& all, std::string const& equation, std::set<std::string> const& sensors);

} // namespace withheld

#endif
