/* SPDX-License-Identifier: MIT
 * The checker's arithmetic for tests: what it computes of an operation. */
#define main checker_main
#include "../../examples/certificate/check_certificate.c"
#undef main

void checker_function(int which, double lo, double hi, double lo2, double hi2, double *result);
void checker_number(const char *text, double *result);
int checker_has_digest(const char *text, const char *digest);

void checker_function(int which, double lo, double hi, double lo2, double hi2, double *result) {
    iv a = between(lo, hi), b = between(lo2, hi2), y = zero;
    switch (which) {
    case 0: y = add(a, b); break;
    case 1: y = sub(a, b); break;
    case 2: y = mul(a, b); break;
    case 3: y = quotient(a, b); break;
    case 4: y = square(a); break;
    case 5: y = root(a); break;
    case 6: y = between(exp_at(a.lo).lo, exp_at(a.hi).hi); break;
    case 7: y = sine(a, 0); break;
    default: y = sine(a, 1); break;
    }
    result[0] = y.lo, result[1] = y.hi;
}
void checker_number(const char *text, double *result) {
    iv x = number(text);
    result[0] = x.lo, result[1] = x.hi;
}
int checker_has_digest(const char *text, const char *digest) {
    struct sha s = {{0}, 0, {0}};
    sha_add(&s, text, strlen(text));
    return sha_is(&s, digest);
}
