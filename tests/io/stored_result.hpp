// SPDX-License-Identifier: MIT
// The stored identification of a small problem, to be read, checked and tampered with.
#ifndef SIVID_TESTS_IO_STORED_RESULT_HPP
#define SIVID_TESTS_IO_STORED_RESULT_HPP

#include "io/small_identification.hpp"
#include "io/support.hpp"

#include <sivid/io/identification_csv.hpp>
#include <sivid/io/identification_json.hpp>
#include <sivid/io/identification_reader.hpp>
#include <sivid/io/result/certificates_csv.hpp>

#include <string>
#include <utility>
#include <vector>

namespace io_support {

/// The same data with one unknown rate: its result states nothing but what its boxes say.
inline sivid::identification_problem one_rate(sivid::identification_problem problem) {
    problem.choice.unknown = {"a"};
    problem.prior = {problem.prior[0]};
    return problem;
}
inline sivid::identification_problem one_rate_problem(bool spoilt = false) {
    return one_rate(two_rates_problem(spoilt));
}

/// The first row with this verdict.
inline std::size_t first_row(std::vector<sivid::paved_box> const& rows, sivid::box_verdict v) {
    std::size_t k = 0;
    while (rows[k].verdict != v) ++k;
    return k;
}

class stored_result {
public:
    explicit stored_result(sivid::identification_problem const& problem)
        : stored_result(problem, two_rates_result(problem)) {}
    stored_result(sivid::identification_problem const& problem, sivid::identification const& found,
                  sivid::explaining_motion const* motion = nullptr) {
        if (motion != nullptr) outputs_ = sivid::outputs_csv(problem, found, motion);
        json_ = sivid::identification_json(problem, found,
                                           {.dataset = "small",
                                            .source_folder = "../data",
                                            .source_digest = std::string(64, '0'),
                                            .outputs = motion != nullptr ? &outputs_ : nullptr,
                                            .motion = motion});
        csv_ = sivid::boxes_csv(problem, found);
        products_ = sivid::products_csv(found);
        if (!found.proof.empty()) certificates_ = sivid::certificates_csv(found.proof);
    }
    [[nodiscard]] std::string const& json() const { return json_; }
    [[nodiscard]] std::string const& csv() const { return csv_; }
    [[nodiscard]] std::string const& products() const { return products_; }
    void set_json(std::string text) { json_ = std::move(text); }
    /// Replaces the first occurrence; false when there is none.
    bool replace_json(std::string const& from, std::string const& to) {
        return replace(json_, from, to);
    }
    bool replace_csv(std::string const& from, std::string const& to) {
        return replace(csv_, from, to);
    }
    [[nodiscard]] sivid::stored_identification read() const {
        temporary_folder const folder;
        folder.write("result.json", json_);
        folder.write("boxes.csv", csv_);
        if (!products_.empty()) folder.write("products.csv", products_);
        if (!certificates_.empty()) folder.write("certificates.csv", certificates_);
        if (!outputs_.empty()) folder.write("outputs.csv", outputs_);
        return sivid::read_identification(folder.path());
    }

private:
    static bool replace(std::string& text, std::string const& from, std::string const& to) {
        auto const at = text.find(from);
        if (at == std::string::npos) return false;
        text.replace(at, from.size(), to);
        return true;
    }
    std::string json_, csv_, products_, certificates_, outputs_;
};

} // namespace io_support

#endif
