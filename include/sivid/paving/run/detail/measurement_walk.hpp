// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_MEASUREMENT_WALK_HPP
#define SIVID_PAVING_RUN_DETAIL_MEASUREMENT_WALK_HPP

#include <sivid/measurement/record.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/response/response.hpp>

#include <cstddef>
#include <memory>

namespace sivid {

namespace paving_detail {

/// What an output says of a measurement.
struct kept_output {
    bool fails = false;
    bool hopeless = false;
};

/// The place of one run in the measurements of a record, which are met group by group in time.
class measurement_walk {
public:
    measurement_walk(record const& samples, std::size_t allowed)
        : samples_(&samples), allowed_(allowed) {}

    [[nodiscard]] bool done() const { return over_ || next_ >= samples_->size(); }
    /// Time of the next measurements.
    [[nodiscard]] double time() const { return (*samples_)[next_].time; }
    /// Takes the measurements of the present time.
    /// @param keep  (channel, bound) -> kept_output
    template <class Keep>
    void take(Keep&& keep) {
        double const t = time();
        bool hopeless = true;
        for (; next_ < samples_->size() && (*samples_)[next_].time == t; ++next_) {
            auto const verdict = keep((*samples_)[next_].channel, (*samples_)[next_].bound);
            failed_ += verdict.fails ? 1 : 0;
            hopeless = hopeless && verdict.hopeless;
        }
        over_ = failed_ > allowed_ || hopeless;
    }

private:
    record const* samples_;
    std::size_t allowed_;
    std::size_t next_ = 0;
    std::size_t failed_ = 0;
    bool over_ = false;
};

[[nodiscard]] inline std::shared_ptr<response> start_response(experiment const& e,
                                                              record const& samples,
                                                              box const& initial,
                                                              box const& parameters) {
    auto answer = std::make_shared<response>(
        response{normalised_unknowns(initial, parameters), nullptr, {}, {}, {}, {}, 0, 0});
    answer->measurements = samples.size();
    answer->allowed = e.outliers;
    return answer;
}

} // namespace paving_detail

} // namespace sivid

#endif
