// SPDX-License-Identifier: MIT
#include <sivid/io/dataset.hpp>

int main() {
    try {
        sivid::read_dataset("no such folder", sivid::model_names{});
    } catch (sivid::input_error const&) {
        return 0;
    }
    return 1;
}
