/* SPDX-License-Identifier: MIT
 * The checker for random damages: it gives up after seconds. */
#define main checker_main
#include "../../examples/certificate/check_certificate.c"
#undef main

int main(int argc, char **argv) {
    work_left = 2e8;
    return checker_main(argc, argv);
}
