// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_DATASET_WRITER_IPP
#define SIVID_IO_IMPL_DATASET_WRITER_IPP

#include <sivid/io/dataset_writer.hpp>

namespace sivid {

SIVID_DECL void add_dataset(file_set& files, dataset const& data, model_names const& model) {
    for (auto const& s : data.scenarios) {
        files.add(s.name + ".inputs.csv", inputs_csv(s, model));
        files.add(s.name + ".measurements.csv", measurements_csv(s, model));
    }
    files.add("dataset.json", dataset_json(data, model));
}
SIVID_DECL void write_dataset(dataset const& data, model_names const& model,
                              std::filesystem::path const& folder) {
    file_set files(folder);
    add_dataset(files, data, model);
    files.commit();
}

} // namespace sivid

#endif
