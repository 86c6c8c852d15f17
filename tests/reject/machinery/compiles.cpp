// SPDX-License-Identifier: MIT
// reject 1: never seen
int main() { return SIVID_REJECT; }
