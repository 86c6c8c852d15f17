// SPDX-License-Identifier: MIT
// reject 1: the expected message
static_assert(SIVID_REJECT == 0, "some other text");
int main() {}
