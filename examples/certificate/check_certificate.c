/* SPDX-License-Identifier: MIT
 * check_certificate FILE [FOLDER] checks a certificate (sivid-certificate-1, README.md)
 * without sivid; its data have to be those of the folder. Exit codes: 0 all that is claimed is
 * proved here; 2 refused: damaged, malformed, other data; 3 something is not proved here.
 * Taken for granted: C99, doubles with + - * / as IEEE 754 says, rounded to nearest, subnormals
 * (tried at the start), strtod off by less than a unit in the last place. Bounds move outward. Of
 * libm sqrt guesses; functions are series with remainders. A motion x(t; q), q = starts and
 * parameters, is enclosed by c + C (q - mid q) + r, step by step: Taylor polynomial in mean value
 * form, remainder over a box that Picard's operator maps into itself. A box of q is excluded where
 * more measurements than the allowed outliers miss their bounds, if need be halved. */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__FAST_MATH__) || FLT_EVAL_METHOD != 0
#error "doubles have to be IEEE 754: no -ffast-math, no x87"
#endif
#define EACH(i, n) for (i = 0; i < (n); ++i)
enum { ORDER = 8, NODES = 1000, ITEMS = 40, SIDES = 12, EXPERIMENTS = 20, FILES = 60, FIELDS = 8,
       DEPTH = 200, LARGEST = 1 << 24 };
static double work_left = 4e10, line_no; /* work: operations, some minutes; then it gives up */
static void refuse(const char *why) { exit((printf("REFUSED, line %.0f: %s\n", line_no, why), 2)); }
/* ---- intervals ---- */
typedef struct { double lo, hi; } iv;
static const iv whole = {-INFINITY, INFINITY}, zero = {0, 0};
/* |x| 2^-52 is at least the distance to the next double, 2^-1074 the least of all */
static double up(double x) { return x + (fabs(x) * 0x1p-52 + 0x1p-1074); }
static double down(double x) { return x - (fabs(x) * 0x1p-52 + 0x1p-1074); }
static double least(double a, double b) { return a < b ? a : b; }
static double most(double a, double b) { return a > b ? a : b; }
static iv make(double lo, double hi) { iv x = {lo, hi}; return x; }
static iv between(double lo, double hi) { return lo <= hi ? make(lo, hi) : whole; } /* for NaN */
static iv point(double x) { return between(x, x); }
static int same(iv a, iv b) { return a.lo == b.lo && a.hi == b.hi; }
static int within(iv a, iv b) { return b.lo <= a.lo && a.hi <= b.hi; }
static double mag(iv a) { return most(-a.lo, a.hi); }
static double mid(iv a) { return 0.5 * a.lo + 0.5 * a.hi; }
static double width(iv a) { return a.hi - a.lo; }
static iv sym(double r) { return between(-r, r); }
static iv hull(iv a, iv b) { return between(least(a.lo, b.lo), most(a.hi, b.hi)); }
static iv common(iv a, iv b) { return between(most(a.lo, b.lo), least(a.hi, b.hi)); }
static iv add(iv a, iv b) {
    return same(a, zero) ? b : same(b, zero) ? a : between(down(a.lo + b.lo), up(a.hi + b.hi));
}
static iv neg(iv a) { return between(-a.hi, -a.lo); }
static iv sub(iv a, iv b) { return add(a, neg(b)); }
static iv of_four(double p, double q, double r, double s) {
    if (!(p + q + r + s == p + q + r + s)) return whole; /* NaN is among them, or may be */
    return between(down(least(least(p, q), least(r, s))), up(most(most(p, q), most(r, s))));
}
static iv mul(iv a, iv b) {
    if (same(a, zero) || same(b, zero)) return mag(a) + mag(b) < INFINITY ? zero : whole;
    return of_four(a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi);
}
static iv quotient(iv a, iv b) {
    if (b.lo <= 0 && b.hi >= 0) return whole;
    return of_four(a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi);
}
static iv square(iv a) {
    double n = most(0, most(a.lo, -a.hi));
    return between(most(0, down(n * n)), up(mag(a) * mag(a)));
}
/* ---- functions: at a point by power series, over an interval by what is known of them ---- */
static iv root(iv a) { /* of numbers >= 0: a guess, moved until its square proves it */
    double lo = sqrt(a.lo) * (1 - 1e-15), hi = sqrt(a.hi) * (1 + 1e-15) + 0x1p-500;
    lo = square(point(lo)).hi <= a.lo ? lo : 0;
    return a.lo >= 0 ? between(lo, square(point(hi)).lo >= a.hi ? hi : INFINITY) : whole;
}
static iv exp_at(double x) { /* exp(x/2^m) squared m times; 0.5^19/19! < 1e-22 */
    iv sum = point(1);
    int k, m = 0;
    if (!(fabs(x) < 700)) return x > 0 ? between(1e304, INFINITY) : between(0, 1e-304);
    for (; fabs(x) > 0.5; x *= 0.5) ++m;
    for (k = 18; k > 0; --k) sum = add(point(1), quotient(mul(sum, point(x)), point(k)));
    for (sum = add(sum, sym(1e-21)); m > 0; --m) sum = square(sum);
    return sum;
}
/* sin(x + n pi/2): y = x - k pi/2, |y| < 1, series up to y^21 or y^20, the rest is below 1/22! */
static iv sin_at(double x, int n) {
    double k = (double)(long)(x * 0.6366197723675814 + (x < 0 ? -0.5 : 0.5));
    iv low = {0x1.1a62633145c06p-54, 0x1.1a62633145c07p-54}, sum = point(1); /* of pi/2 */
    iv y = sub(sub(point(x), mul(point(k), point(0x1.921fb54442d18p+0))), mul(point(k), low));
    int i, turn = (int)(((long)k + n) & 3), odd = turn & 1;
    for (i = 20; i > 0; i -= 2)
        sum = sub(point(1), quotient(mul(sum, square(y)), point(odd ? i * (i - 1) : i * (i + 1))));
    sum = mag(y) < 1 ? add(odd ? sum : mul(sum, y), sym(1e-20)) : sym(1);
    return turn & 2 ? neg(sum) : sum;
}
static iv sine(iv a, int n) { /* the same: f(m + d) = f(m) + f'(m) d + [-1, 1] d^2/2 */
    iv d = sub(a, point(mid(a)));
    if (!(mag(a) < 1e6)) return sym(1);
    d = add(add(sin_at(mid(a), n), mul(sin_at(mid(a), n + 1), d)), mul(sym(0.5), square(d)));
    return common(sym(1), d);
}
/* ---- SHA-256 (FIPS 180-4) ---- */
static const uint32_t keys[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};
static struct sha { uint32_t h[8]; uint64_t bytes; unsigned char block[64]; } of_data, of_file;
static const uint32_t sha_begin[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
static uint32_t turned(uint32_t x, int n) { return x >> n | x << (32 - n); }
static void sha_block(struct sha *s) {
    uint32_t w[64], v[8], one, two;
    int i;
    memcpy(v, s->bytes == 64 ? sha_begin : s->h, sizeof v), memcpy(s->h, v, sizeof v);
    EACH(i, 16)
        w[i] = (uint32_t)s->block[4 * i] << 24 | (uint32_t)s->block[4 * i + 1] << 16 |
               (uint32_t)s->block[4 * i + 2] << 8 | s->block[4 * i + 3];
    for (; i < 64; ++i)
        w[i] = w[i - 16] + (turned(w[i - 15], 7) ^ turned(w[i - 15], 18) ^ w[i - 15] >> 3) +
               w[i - 7] + (turned(w[i - 2], 17) ^ turned(w[i - 2], 19) ^ w[i - 2] >> 10);
    EACH(i, 64) {
        one = v[7] + (turned(v[4], 6) ^ turned(v[4], 11) ^ turned(v[4], 25)) +
              ((v[4] & v[5]) ^ (~v[4] & v[6])) + keys[i] + w[i];
        two = (turned(v[0], 2) ^ turned(v[0], 13) ^ turned(v[0], 22)) +
              ((v[0] & v[1]) ^ (v[0] & v[2]) ^ (v[1] & v[2]));
        memmove(v + 1, v, 7 * sizeof *v), v[4] += one, v[0] = one + two;
    }
    EACH(i, 8) s->h[i] += v[i];
}
static void sha_add(struct sha *s, const char *p, size_t n) {
    for (; n > 0; --n)
        if (s->block[s->bytes++ % 64] = (unsigned char)*p++, s->bytes % 64 == 0) sha_block(s);
}
static int sha_is(struct sha *s, const char *expected) {
    char hex[65], byte;
    uint64_t bits = 8 * s->bytes;
    int i;
    for (sha_add(s, "\x80", 1); s->bytes % 64 != 56;) sha_add(s, "", 1);
    for (i = 56; i >= 0; i -= 8) byte = (char)(bits >> i & 255), sha_add(s, &byte, 1);
    EACH(i, 8) sprintf(hex + 8 * i, "%08x", (unsigned)s->h[i]);
    return !strncmp(hex, expected, 64);
}
/* ---- the file: lines of fields with tabs between them, and blocks of bytes ---- */
static char *rest, *end_of_file, *fields[FIELDS];
static int next_line(void) { /* how many fields it has */
    char *p = rest, *end = memchr(rest, '\n', (size_t)(end_of_file - rest));
    int n = 0;
    ++line_no;
    if (!end) refuse("the file ends too early");
    for (*end = 0; p && n < FIELDS; ++n) {
        fields[n] = p;
        if ((p = strchr(p, '\t')) != NULL) *p++ = 0;
        if (*fields[n] == 0) refuse("a field is empty");
    }
    if (p) refuse("too many fields");
    return rest = end + 1, n;
}
static int all_of(const char *s, const char *known) { return *s && s[strspn(s, known)] == 0; }
static int whole_number(const char *s, int limit) {
    int n = all_of(s, "0123456789") && strlen(s) < 9 ? atoi(s) : -1;
    return n < 0 || n > limit ? refuse("not in range"), 0 : n;
}
static char *block(const char *size) { /* so many bytes and a line end */
    char *all = rest, *p;
    int n = whole_number(size, 99999999);
    if (n >= end_of_file - rest || rest[n] != '\n') refuse("a block has another size");
    for (p = rest; p <= rest + n; ++p) line_no += *p == '\n';
    return rest[n] = 0, rest += n + 1, all;
}
static iv number(const char *s) { /* encloses a decimal: 12, -0.25, 1e-3 */
    char *end;
    double x = strtod(s, &end);
    if (*end != 0 || !all_of(s, "0123456789.e+-") || !(fabs(x) < 1e300)) refuse("not a number");
    if (all_of(s, "0.-")) return zero;
    return strlen(s) < 16 && all_of(s, "0123456789") ? point(x) : between(down(x), up(x));
}
/* ---- the model: one operation a line ---- */
enum kind { STATE, PARAMETER, INPUT, OUTPUT, LITERAL, TIME, ADD, SUB, MUL, DIV, SQR, EXP, SQRT, SIN,
            COS };
/* a, b: a leaf's number; operands; a function's argument and its derivative by that */
static struct node { enum kind op; int a, b; iv value; char *name; } nodes[NODES];
static struct item { char *name; iv range; int node, rate; } items[OUTPUT + 1][ITEMS];
static int node_count, count[OUTPUT + 1], S, Q; /* how many states, states and parameters */
static int node(enum kind op, int a, int b) {
    struct node n = {op, a, b, {0, 0}, NULL};
    return node_count < NODES ? nodes[node_count] = n, node_count++ : (refuse("too long"), 0);
}
static int literal(iv value) { return nodes[node(LITERAL, 0, 0)].value = value, node_count - 1; }
static int known(const char *name) {
    int i = node_count - 1;
    for (; i >= 0 && !(nodes[i].name && !strcmp(nodes[i].name, name)); --i) continue;
    return i;
}
static int operand(const char *s) {
    int i = known(s);
    if (i >= 0) return i;
    if (!strcmp(s, "t")) return node(TIME, 0, 0);
    return strchr("0123456789.-", *s) ? literal(number(s)) : (refuse("an unknown name"), 0);
}
static struct item *find(enum kind kind, const char *name) {
    int i;
    EACH(i, count[kind]) if (!strcmp(items[kind][i].name, name)) return &items[kind][i];
    return refuse("a name is not declared"), NULL;
}
static struct item *declare(enum kind kind, char *name, int i) {
    struct item *item = &items[kind][count[kind]++];
    EACH(S, count[kind] - 1) if (!strcmp(items[kind][S].name, name)) refuse("a name stands twice");
    S = count[STATE], Q = S + count[PARAMETER];
    if (count[kind] >= ITEMS || Q > SIDES || count[INPUT] > SIDES) refuse("too many quantities");
    return item->name = name, item->node = i, item->rate = -1, item;
}
static int operation(char **word, int n) { /* A, A + B, - A, sin A with its derivative */
    static const char *const names[] = {"+", "-", "*", "/", "sqr", "exp", "sqrt", "sin", "cos"};
    int k = 0, a = operand(word[n - 1]), f, b;
    if (n == 1) return a;
    while (k < 9 && strcmp(word[n - 2], names[k])) ++k;
    if (k == 9 || (n == 3) != (k < 4 && !(k == 1 && n == 2))) refuse("an unknown operation");
    f = k > 3 ? a : n == 3 ? operand(word[0]) : literal(zero);
    f = b = node((enum kind)(ADD + k), f, a);
    if (k < 4) return f;
    if (k == 6) b = literal(point(0.5)), b = node(DIV, b, f);
    if (k == 7) b = literal(zero), b = node(SUB, b, f), b = node(COS, a, b);
    if (k == 8) a = node(SIN, a, f), b = literal(zero), b = node(SUB, b, a);
    return nodes[f].b = b, f;
}
/* ---- power series in time, with derivatives by states and parameters ---- */
static iv V[NODES][ORDER + 2][1 + SIDES], clock; /* node, order; value and derivatives */
#define X(s) V[items[STATE][s].node]
static int dims; /* how many derivatives are carried */
struct place { iv q[SIDES], u[SIDES], slope[SIDES], t; }; /* q: states and parameters */
static void convolve(iv *y, int a, int b, int k, int from, int weighted) {
    int j, d; /* y += sum over j >= from of a_j b_(k-j), j times as much if weighted */
    for (j = from; j <= k; ++j) EACH(d, dims + 1) {
        iv *p = V[a][j], *q = V[b][k - j];
        iv x = d ? add(mul(p[d], q[0]), mul(p[0], q[d])) : mul(p[0], q[0]);
        y[d] = add(y[d], weighted ? mul(point(j), x) : x);
    }
}
static void term(int i, int k, const struct place *at) {
    struct node *n = &nodes[i];
    iv *y = V[i][k], *a = V[n->a][k], *b = V[n->b][k], slope = zero;
    int d, first = k == 0;
    if (n->op == STATE && !first) return; /* it is there */
    EACH(d, dims + 1) y[d] = zero;
    if (n->op > SQR && !first) { /* k f_k = sum of j a_j f'_(k-j) */
        convolve(y, n->a, n->b, k, 1, 1);
        for (d = 0; d <= dims; ++d) y[d] = quotient(y[d], point(k));
        return;
    }
    switch (n->op) {
    case INPUT: y[0] = first ? at->u[n->a] : k == 1 ? at->slope[n->a] : zero; return;
    case TIME: y[0] = first ? at->t : k == 1 ? point(1) : zero; return;
    case LITERAL: y[0] = first ? n->value : zero; return;
    case ADD: EACH(d, dims + 1) y[d] = add(a[d], b[d]); return;
    case SUB: EACH(d, dims + 1) y[d] = sub(a[d], b[d]); return;
    case MUL: convolve(y, n->a, n->b, k, 0, 0); return;
    case DIV: /* y_k = (a_k - sum of b_j y_(k-j)) / b_0 */
        convolve(y, n->b, i, k, 1, 0), b = V[n->b][0];
        y[0] = quotient(sub(a[0], y[0]), b[0]);
        EACH(d, dims) y[1 + d] = quotient(sub(sub(a[1 + d], y[1 + d]), mul(y[0], b[1 + d])), b[0]);
        return;
    case SQR: convolve(y, n->a, n->a, k, 0, 0), y[0] = first ? square(a[0]) : y[0]; return;
    case EXP: y[0] = slope = between(exp_at(a[0].lo).lo, exp_at(a[0].hi).hi); break;
    case SQRT: y[0] = root(a[0]), slope = quotient(point(0.5), y[0]); break;
    case SIN: y[0] = sine(a[0], 0), slope = sine(a[0], 1); break;
    case COS: y[0] = sine(a[0], 1), slope = sine(a[0], 2); break;
    default: y[0] = first ? at->q[n->a] : zero, y[1 + n->a] = point(first); return; /* in q */
    }
    EACH(d, dims) y[1 + d] = mul(slope, a[1 + d]);
}
static void series(const struct place *at, int order, int derivatives) {
    int i, k, d;
    work_left -= node_count * (1. + derivatives) * (1 + order) * (2 + order);
    for (dims = derivatives, k = 0; k <= order; ++k) {
        EACH(i, node_count) term(i, k, at);
        EACH(i, S) EACH(d, dims + 1)
            X(i)[k + 1][d] = quotient(V[items[STATE][i].rate][k][d], point(k + 1));
    }
}
static iv polynomial(int s, int d, iv h, int k) {
    return k > ORDER ? zero : add(X(s)[k][d], mul(h, polynomial(s, d, h, k + 1)));
}
/* ---- experiments; inner, outer: bounds of a measurement, rounded inward and outward ---- */
struct reading { iv t, u, inner, outer; int channel; };
static struct experiment {
    struct track { struct reading *all; int count; } measured, inputs[SIDES];
    iv start[SIDES], from[SIDES]; /* from: where the witness starts */
    int hold, outliers, started;
} experiments[EXPERIMENTS];
static int experiment_count, hits, misses; /* measurements that hold for all of q, for none */
static void keep(struct track *to, struct reading r) {
    const struct reading *last = to->count ? &to->all[to->count - 1] : &r;
    if (!(last->t.hi < r.t.lo) && !same(last->t, r.t)) refuse("times go back");
    if (to->count % 64 == 0) to->all = realloc(to->all, (size_t)(to->count + 64) * sizeof r);
    if (!to->all) refuse("not enough memory");
    to->all[to->count++] = r;
}
static char *next_cell(char **p, int *last) { /* and whether it is the last of its row */
    char *own = *p, *end = own + strcspn(own, ",\n");
    return *last = *end != ',', *p = end + (*end != 0), *end = 0, own;
}
static void read_table(char *p, enum kind kind, struct experiment *e) { /* t, name[, name_err] */
    int row, i, last, column[ITEMS], columns = 0;
    char *time, *value, *error;
    for (row = 0; *p; ++row) {
        time = next_cell(&p, &last);
        for (i = 0; i < ITEMS && !last; ++i) {
            value = error = next_cell(&p, &last);
            if (kind == OUTPUT) error = last ? (refuse("no errors"), value) : next_cell(&p, &last);
            if (row == 0) {
                column[columns = i] = (int)(find(kind, value) - items[kind]), ++columns;
                if (kind == OUTPUT && (strncmp(error, value, strlen(value)) ||
                                       strcmp(error + strlen(value), "_err")))
                    refuse("a column without its errors");
            } else if (*value && i < columns) {
                iv unit = items[kind][column[i]].range, u = mul(number(value), unit);
                iv by = error == value ? zero : mul(number(error), unit);
                struct reading r = {mul(number(time), clock), u, zero, zero, column[i]};
                if (by.lo < 0) refuse("an error bound below 0");
                r.outer = hull(sub(u, by), add(u, by));
                r.inner = make(sub(u, by).hi, add(u, by).lo);
                keep(kind == OUTPUT ? &e->measured : &e->inputs[column[i]], r);
            }
        }
        if (!last || i != columns || (row == 0 && strcmp(time, "t"))) refuse("not a table");
    }
}
/* ---- one run: starts and parameters q, states c + C (q - mid q) + r ---- */
static struct place now, centre; /* of all q, of the middle of q */
static double C[SIDES][SIDES], last, weight[SIDES]; /* weight: how far each of q moves an output */
static iv deviation[SIDES], left[SIDES]; /* q - mid q, r */
static int picard(double h, struct place *over) { /* x + [0, h] f(over) lies in over */
    int i, tries, fits = 0;
    for (*over = now, i = 0; i < count[INPUT]; ++i)
        over->u[i] = add(now.u[i], mul(now.slope[i], between(0, h)));
    for (over->t = add(now.t, between(0, h)), tries = 0; tries < 12 && !fits; ++tries) {
        series(over, 0, 0), fits = 1;
        EACH(i, S) {
            iv next = add(now.q[i], mul(between(0, h), V[items[STATE][i].rate][0][0]));
            if (!(mag(next) < 1e100)) return 0;
            if ((fits = fits && within(next, over->q[i])) != 0) continue;
            next = hull(next, over->q[i]), over->q[i] = add(next, sym(0.1 * width(next) + 1e-300));
        }
    }
    return fits;
}
static int step(iv until) { /* at most twice as long as the last one */
    struct place over;
    iv T[SIDES], J[SIDES][SIDES], r[SIDES], h = sub(until, now.t), next = until, x;
    double D[SIDES][SIDES], end = h.hi, span = least(end, 2 * last);
    int s, d, k, tries, fits = 0;
    for (tries = 0; tries < 40 && !fits; ++tries, span *= fits ? 1 : 0.6) {
        if (work_left < 0) return 0;
        next = span < 0.9 * end ? point(now.t.hi + span) : until, h = sub(next, now.t);
        fits = h.lo > 0 && (same(next, until) || next.hi < until.lo) && picard(h.hi, &over);
        if (!fits) continue;
        for (series(&over, ORDER, 0), x = h, k = 0; k < ORDER; ++k) x = mul(x, h);
        for (fits = 1, s = 0; s < S; ++s) {
            T[s] = mul(X(s)[ORDER + 1][0], x);
            fits = fits && mag(T[s]) <= 1e-10 * mag(over.q[s]) + 1e-3 * width(now.q[s]) + 1e-300;
        }
    }
    if (!fits) return 0;
    series(&centre, ORDER, 0);
    EACH(s, S) T[s] = add(T[s], polynomial(s, 0, h, 0));
    series(&now, ORDER, Q);
    EACH(s, S) EACH(d, Q) J[s][d] = polynomial(s, 1 + d, h, 0);
    EACH(s, S) {
        r[s] = sub(T[s], point(mid(T[s])));
        EACH(k, S) r[s] = add(r[s], mul(J[s][k], left[k]));
        EACH(d, Q) {
            x = d < S ? zero : J[s][d];
            EACH(k, S) x = add(x, mul(J[s][k], point(C[k][d])));
            D[s][d] = mid(x), r[s] = add(r[s], mul(sub(x, point(D[s][d])), deviation[d]));
        }
    }
    EACH(s, S) {
        memcpy(C[s], D[s], sizeof D[s]), left[s] = r[s];
        centre.q[s] = point(mid(T[s])), x = add(centre.q[s], r[s]);
        EACH(d, Q) x = add(x, mul(point(C[s][d]), deviation[d]));
        now.q[s] = hull(x, centre.q[s]);
    }
    return last = span, now.t = next, 1;
}
static void look(const struct reading *r, int contract) { /* contract q to what explains it */
    int d, k, o = items[OUTPUT][r->channel].node;
    iv y, all, g[SIDES], part[SIDES];
    series(&centre, 0, 0), all = V[o][0][0], series(&now, 0, Q);
    EACH(k, S) all = add(all, mul(V[o][0][1 + k], left[k]));
    for (y = all, d = 0; d < Q; y = add(y, part[d++])) {
        g[d] = d < S ? zero : V[o][0][1 + d];
        EACH(k, S) g[d] = add(g[d], mul(V[o][0][1 + k], point(C[k][d])));
        part[d] = mul(g[d], deviation[d]);
        weight[d] = most(weight[d], mag(g[d]) * width(deviation[d]) / (width(r->outer) + 1e-300));
    }
    y = common(y, V[o][0][0]);
    hits += within(y, r->inner), misses += y.lo > r->outer.hi || y.hi < r->outer.lo;
    if (contract) EACH(d, Q) {
        for (y = sub(r->outer, all), k = 0; k < Q; ++k) y = k == d ? y : sub(y, part[k]);
        y = quotient(y, g[d]), y = make(most(y.lo, deviation[d].lo), least(y.hi, deviation[d].hi));
        misses += y.lo > y.hi, deviation[d] = y.lo > y.hi ? deviation[d] : y;
    }
}
static iv next_knot(const struct experiment *e, int *knot, iv until) { /* or until, if first */
    int i;
    EACH(i, count[INPUT]) {
        const struct track *all = &e->inputs[i];
        const struct reading *u = all->all + knot[i], *end = all->all + all->count;
        while (u + 1 < end && (u[1].t.hi < now.t.lo || same(u[1].t, now.t))) ++u, ++knot[i];
        now.u[i] = u->u, now.slope[i] = zero;
        if (u + 1 < end && !e->hold) now.slope[i] = quotient(sub(u[1].u, u->u), sub(u[1].t, u->t));
        if (!same(now.t, u->t)) now.u[i] = add(u->u, mul(now.slope[i], sub(now.t, u->t)));
        if (u + 1 < end && u[1].t.lo < until.lo) until = u[1].t;
        centre.u[i] = now.u[i], centre.slope[i] = now.slope[i];
    }
    return centre.t = now.t, until;
}
static void run(const struct experiment *e, const iv *q, int most_misses) { /* hits and misses */
    int d, k, knot[SIDES] = {0};
    iv t, until;
    memset(C, 0, sizeof C), memset(left, 0, sizeof left);
    now.t = zero, last = INFINITY, hits = misses = 0;
    EACH(d, Q) {
        now.q[d] = q[d], centre.q[d] = point(mid(q[d])), deviation[d] = sub(q[d], centre.q[d]);
        C[d][d] = d < S, weight[d] = 1e-9 * width(q[d]);
    }
    for (k = 0; k < e->measured.count && misses <= most_misses; ++k) {
        for (t = e->measured.all[k].t; until = next_knot(e, knot, t), !same(now.t, t);)
            if (!step(until)) return;
        look(&e->measured.all[k], most_misses == 0);
    }
}
static int excluded(const struct experiment *e, const iv *box, int depth) {
    int d, side = 0;
    iv own, q[SIDES];
    memcpy(q, box, sizeof q), run(e, q, e->outliers);
    if (misses > e->outliers || depth == 0) return misses > e->outliers;
    EACH(d, Q) side = weight[d] > weight[side] ? d : side;
    EACH(d, Q) q[d] = common(q[d], add(point(mid(q[d])), deviation[d]));
    own = q[side], q[side].hi = mid(own);
    return excluded(e, q, depth - 1) &&
           (q[side] = between(mid(own), own.hi), excluded(e, q, depth - 1));
}
static iv kept[SIDES], hulls[SIDES], witness[SIDES];
static struct { const char *name; char *text; } files[FILES];
static int kept_boxes, out_boxes, open_boxes, seen[128]; /* statements by their first letters */
static void tree(iv *p, int depth) { /* p: the parameters of a box */
    int n = next_line(), j;
    iv own, at, q[2 * SIDES];
    if (n == 3 && !strcmp(fields[0], "split") && depth < DEPTH) {
        j = whole_number(fields[1], Q - S - 1), at = number(fields[2]), own = p[j];
        if (!(own.lo < at.lo && at.hi < own.hi)) refuse("a box is divided where it is not");
        p[j].hi = at.hi, tree(p, depth + 1), p[j] = between(at.lo, own.hi), tree(p, depth + 1);
        p[j] = own;
        return;
    }
    if (n == 2 && !strcmp(fields[0], "out")) {
        j = whole_number(fields[1], experiment_count - 1);
        memcpy(q, experiments[j].start, sizeof kept), memcpy(q + S, p, sizeof kept);
        if (excluded(&experiments[j], q, 12) && ++out_boxes) return;
        ++open_boxes;
    } else if (n != 1 || strcmp(fields[0], "keep")) refuse("a tree that makes no sense");
    EACH(j, Q - S) kept[j] = kept_boxes ? hull(kept[j], p[j]) : p[j];
    ++kept_boxes;
}
static int witness_holds(void) {
    struct experiment *e = experiments;
    int k, j, good = 1;
    iv q[2 * SIDES];
    for (k = 0; k < experiment_count; ++k, ++e) {
        memcpy(q, e->from, sizeof kept), memcpy(q + S, witness, sizeof kept);
        EACH(j, Q) good = good && within(q[j], j < S ? e->start[j] : items[PARAMETER][j - S].range);
        run(e, q, e->measured.count), good = good && hits + e->outliers >= e->measured.count;
    }
    return good;
}
static iv range(const char *lower, const char *upper) {
    if (!(number(lower).lo <= number(upper).hi)) refuse("a range whose ends are exchanged");
    return between(number(lower).lo, number(upper).hi);
}
static void read_file(char **f, const char *folder) { /* of the data */
    char *all = block(f[2]), path[5000];
    size_t n = strlen(all), i;
    FILE *other;
    sha_add(&of_data, path, (size_t)sprintf(path, "%.2000s\n%s\n", f[1], f[2]));
    sha_add(&of_data, all, n);
    if (seen['f'] > FILES || seen['d'] > 0) refuse("too many files, or one behind the digest");
    if (files[seen['f'] - 1].name = f[1], files[seen['f'] - 1].text = all, !folder) return;
    sprintf(path, "%.2000s/%.2000s", folder, f[1]);
    other = strstr(f[1], "..") ? NULL : fopen(path, "rb");
    EACH(i, n + 1)
        if (!other || fgetc(other) != (i < n ? (unsigned char)all[i] : EOF)) refuse("other data");
    fclose(other);
}
static char *file(const char *name) { /* once */
    int i;
    EACH(i, seen['f']) if (!strcmp(files[i].name, name)) return files[i].name = "", files[i].text;
    return refuse("a table that is missing, or used twice"), NULL;
}
static void model_line(char **f, int n) {
    int kind = *f[0] == 's' ? STATE : *f[0] == 'p' ? PARAMETER : INPUT, k; /* or c, l */
    if (experiment_count > 0) refuse("a line of the model behind an experiment");
    if (*f[0] == 'r' && find(STATE, f[1])->rate >= 0) refuse("a rate stands twice");
    if (*f[0] == 'r') find(STATE, f[1])->rate = operand(f[3]);
    if (*f[0] == 'o') declare(OUTPUT, f[1], operand(f[6]))->range = range(f[3], f[4]);
    if (*f[0] == 'r' || *f[0] == 'o') return;
    if (known(f[1]) >= 0 || strchr("0123456789.-", *f[1])) refuse("not a name, or taken");
    if (kind == STATE && Q > S) refuse("a state behind a parameter");
    k = *f[0] == 'c' ? literal(range(f[3], f[n - 1])) : *f[0] == 'l' ? operation(f + 3, n - 3)
        : node((enum kind)kind, count[kind] + (kind == PARAMETER ? S : 0), 0);
    if (nodes[k].name) k = node(ADD, k, literal(zero));
    nodes[k].name = f[1];
    if (*f[0] == 'c' || *f[0] == 'l') return;
    declare((enum kind)kind, f[1], k)->range = kind == STATE ? zero : range(f[3], f[4]);
}
static void begin_experiment(char **f) {
    struct experiment *e = &experiments[experiment_count++];
    struct track *u = e->inputs, *y = &e->measured;
    int i;
    if (experiment_count > EXPERIMENTS || !seen['d'] || !seen['t']) refuse("too many, or no data");
    e->hold = !strcmp(f[4], "hold"), e->outliers = whole_number(f[5], 99999999);
    if (!e->hold && strcmp(f[4], "linear")) refuse("neither linear nor hold");
    read_table(file(f[2]), OUTPUT, e);
    if (count[INPUT] > 0) read_table(file(f[3]), INPUT, e);
    if (y->count == 0 || y->all[0].t.lo < 0) refuse("no measurements, or some before the begin");
    EACH(i, count[INPUT]) if (u[i].count == 0 || u[i].all[0].t.hi > 0 ||
                              u[i].all[u[i].count - 1].t.hi < y->all[y->count - 1].t.lo)
        refuse("an input that does not last");
}
static void statement(const char *folder) {
    static const char forms[] = " title5 model3 file3 data3 state3 parameter5 input5 constant4 "
        "constant5 let4 let5 let6 rate4 output7 experiment6 begins4 begins5 witness3 hull4 assume2 "
        "noted2 unproved2 verdict2 ";
    char form[40], **f = fields;
    int n = next_line(), i, key = *f[0];
    struct experiment *e = &experiments[experiment_count - (experiment_count > 0)];
    sprintf(form, " %.20s%d ", f[0], n);
    if (!strstr(forms, form) || strchr(f[0], ' ')) refuse("an unknown statement, or its fields");
    EACH(i, n) printf("%s%s", i ? " " : "", f[i]);
    puts(""), ++seen[key];
    if (strchr("spiclro", key)) model_line(f, n);
    if (key == 't') clock = seen['t'] > 1 ? (refuse("two titles"), zero) : range(f[3], f[4]);
    if (key == 'm') block(f[2]);
    if (key == 'f') read_file(f, folder);
    if (key == 'e') begin_experiment(f);
    if (key == 'd' && (seen['d'] > 1 || strlen(f[1]) != 64 || !sha_is(&of_data, f[1])))
        refuse("not the digest of the data");
    if (key == 'b') {
        i = e->started++;
        if (i >= S || !experiment_count || find(STATE, f[1]) != &items[STATE][i])
            refuse("not the next state of an experiment");
        e->start[i] = range(f[2], f[3]), e->from[i] = n == 5 ? number(f[4]) : whole;
    }
    if (key == 'w' || key == 'h') {
        i = seen[key] - 1;
        if (find(PARAMETER, f[1]) != &items[PARAMETER][i]) refuse("not the next parameter");
        *(key == 'w' ? &witness[i] : &hulls[i]) = key == 'w' ? number(f[2]) : range(f[2], f[3]);
    }
}
static int told(int ok, const char *s) { return printf("%sPROVED: %s\n", ok ? "" : "NOT ", s), ok; }
static int judged(const char *verdict) { /* whether all that is claimed is proved */
    const char *needed = "tmfdsproeban";
    int i, good = 1, has_tree = rest < end_of_file, point_ = seen['w'] > 0, hull_ = seen['h'] > 0;
    int none = has_tree && !hull_;
    int bad = strcmp(verdict, point_ ? "consistent" : none ? "inconsistent" : "undecided");
    iv p[SIDES];
    for (; *needed; ++needed) bad = bad || !seen[(int)*needed];
    bad = bad || (point_ && seen['w'] != Q - S) || (hull_ && (!has_tree || seen['h'] != Q - S));
    EACH(i, S) bad = bad || items[STATE][i].rate < 0;
    EACH(i, experiment_count) bad = bad || experiments[i].started != S;
    if (bad || (point_ ? none : !has_tree)) refuse("statements are missing");
    if (point_) good = told(witness_holds(), "the witness explains the measurements");
    if (!has_tree) return good;
    EACH(i, Q - S) p[i] = items[PARAMETER][i].range;
    if (tree(p, 0), rest < end_of_file) refuse("something stands behind the tree");
    printf("boxes: %d excluded, %d kept, %d of them in vain\n", out_boxes, kept_boxes, open_boxes);
    EACH(i, Q - S) hull_ = hull_ && within(kept[i], hulls[i]);
    return told(hull_ || kept_boxes == 0, none ? "no parameter of the prior explains them"
                : "no parameter of the prior beyond the hull explains them") && good && !open_boxes;
}
int main(int argc, char **argv) {
    FILE *in = argc == 2 || argc == 3 ? fopen(argv[1], "rb") : NULL;
    volatile double small = DBL_MIN, one = 1;
    static char all[LARGEST + 1];
    size_t n, i;
    if (!in) return puts("usage: check_certificate FILE [FOLDER OF THE DATA]"), 2;
    n = fread(all, 1, LARGEST + 1, in), fclose(in);
    if (one + 0x1p-53 != 1 || one + 0x1.8p-53 == 1 || -one - 0x1p-53 != -1 || small / 2 == 0)
        refuse("doubles are not those of IEEE 754, rounded to nearest");
    if (n < 70 || n > LARGEST || memcmp(all + n - 70, "\nend\t", 5) || all[n - 1] != '\n')
        refuse("cut off, or too large");
    EACH(i, n) if ((unsigned char)all[i] < (i && all[i - 1] == '\xc2' ? 160 : 32) || all[i] == 127)
        if (all[i] != '\t' && all[i] != '\n') refuse("control characters");
    sha_add(&of_file, all, n - 69), rest = all, end_of_file = all + n - 69;
    if (!sha_is(&of_file, all + n - 65)) refuse("damaged: not the digest of the file");
    if (next_line() != 1 || strcmp(fields[0], "sivid-certificate-1")) refuse("another format");
    while (!seen['v']) statement(argv[2]);
    return told(judged(fields[1]), "all that is claimed") ? 0 : 3;
}
