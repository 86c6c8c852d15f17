// SPDX-License-Identifier: MIT
#include <Eigen/Core>

int main() {}
