/* SPDX-License-Identifier: Apache-2.0 */
/* NumPy's .npy, versions 1 to 3: little- or big-endian arrays of shape (n, dim) or (n,), in C or Fortran order, of float16,
   float32, float64, or integers. An unsigned integer of b bits is a fraction of 2^b, as in the tables of renderers; a
   signed integer is that number, and so 0 or 1. A file is the magic bytes, the version, the length of a Python dictionary,
   the dictionary padded with spaces so that the data begin at a multiple of 64 bytes, and the data. Format:
   https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html */
#include "core/point_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/points.h"
#include "core/status.h"

enum { MAX_HEADER = 4096, ITEMS_AT_ONCE = 8192, /* read, or converted */ WRITTEN_AT_ONCE = 1 << 18 };

typedef struct layout {
    size_t n, dim;   /* of points */
    size_t shape[3]; /* sizes along the axes */
    int axes, most_axes;
    size_t item_size;
    char kind; /* NumPy's: f, u or i */
    bool big_endian, fortran_order;
    bool mapped; /* take all finite coordinates, not only those in [0,1] */
} layout;

static koksma_status malformed(const char *name, const char *reason)
{
    return koksma__fail(KOKSMA_MALFORMED, "%s: npy header: %s", name, reason);
}

/* Sets *value to the text after 'key': in the header's dictionary, or to NULL if the dictionary lacks the key. NumPy takes
   the last of two values of one key; such a header is refused, because it is either damaged or meant to deceive. */
static koksma_status find_value(const char *name, const char *header, const char *key, const char **value)
{
    char quoted[32];
    snprintf(quoted, sizeof quoted, "'%s':", key);
    const char *at = strstr(header, quoted);
    *value = NULL;
    if (at) {
        at += strlen(quoted);
        *value = at + strspn(at, " ");
        KOKSMA__FAIL_IF(strstr(at, quoted), KOKSMA_MALFORMED, "%s: npy header: '%s' is given twice", name, key);
    }
    return KOKSMA_OK;
}

/* Sets n and dim from the shape (n,) or (n, dim); digits: the sizes as the file has them. */
static koksma_status set_points(const char *name, char digits[3][32], layout *out)
{
    KOKSMA__FAIL_IF(out->shape[1] > KOKSMA_MAX_DIM || out->shape[0] > KOKSMA_MAX_COORDINATES / out->shape[1],
                    KOKSMA_MALFORMED,
                    "%s: npy header: claims %s points of %s dimensions, which is more than one set can have", name,
                    digits[0], digits[1]);
    out->n = out->shape[0];
    out->dim = out->shape[1];
    return KOKSMA_OK;
}

static koksma_status parse_shape(const char *name, const char *shape, layout *out)
{
    const char *expected = out->most_axes == 2 ? "the shape is not (n,) or (n, dim)"
                                               : "the shape is not (height, width) or (height, width, numbers)";
    char digits[3][32] = {"0", "1", "1"}; /* for messages: a number may be larger than any integer of C */
    out->shape[0] = 0;
    out->shape[1] = out->shape[2] = 1;
    const char *s = shape + 1;
    s += strspn(s, " ");
    while (*s != ')') {
        char *end;
        if (*s < '0' || *s > '9' || out->axes == out->most_axes) {
            return malformed(name, expected);
        }
        const unsigned long long size = strtoull(s, &end, 10); /* ULLONG_MAX for a larger number */
        out->shape[out->axes] = size > SIZE_MAX ? SIZE_MAX : (size_t)size;
        const bool fits = end - s < (ptrdiff_t)sizeof digits[0];
        snprintf(digits[out->axes++], sizeof digits[0], "%.*s%s", fits ? (int)(end - s) : 28, s, fits ? "" : "...");
        s = end + strspn(end, " ");
        if (*s == ',') {
            s += 1 + strspn(s + 1, " ");
        } else if (*s != ')') {
            return malformed(name, expected);
        }
    }
    if (out->shape[0] == 0 || out->shape[1] == 0 || out->shape[2] == 0 || out->axes < out->most_axes - 1) {
        return malformed(name, out->most_axes == 2 ? "no points" : expected);
    }
    return out->most_axes == 2 ? set_points(name, digits, out) : KOKSMA_OK;
}

static koksma_status parse_header(const char *name, const char *header, layout *out)
{
    const char *type, *order, *shape;
    KOKSMA__TRY(find_value(name, header, "descr", &type));
    KOKSMA__TRY(find_value(name, header, "fortran_order", &order));
    KOKSMA__TRY(find_value(name, header, "shape", &shape));
    if (!type || !order || !shape || *shape != '(') {
        return malformed(name, "descr, fortran_order or shape is missing");
    }
    const bool typed = type[0] == '\'' && type[1] && strchr("<>|", type[1]) && type[2] && strchr("fui", type[2]) &&
                       type[3] && strchr("1248", type[3]) && type[4] == '\'';
    if (!typed || (type[1] == '|') != (type[3] == '1') || (type[2] == 'f' && type[3] == '1')) {
        return koksma__fail(KOKSMA_MALFORMED,
                            "%s: npy header: the type is %.*s, not float16, float32, float64 or an integer", name,
                            *type == '[' ? 10 : (int)strcspn(type, ","), *type == '[' ? "structured" : type);
    }
    out->big_endian = type[1] == '>';
    out->kind = type[2];
    out->item_size = (size_t)(type[3] - '0');
    out->fortran_order = !strncmp(order, "True", 4);
    if (!out->fortran_order && strncmp(order, "False", 5) != 0) {
        return malformed(name, "fortran_order is neither True nor False");
    }
    return parse_shape(name, shape, out);
}

static koksma_status read_header(FILE *stream, const char *name, layout *out)
{
    unsigned char start[12];
    if (fread(start, 1, 8, stream) != 8 || memcmp(start, "\x93NUMPY", 6) != 0 || start[6] < 1 || start[6] > 3) {
        return malformed(name, "not a .npy file of version 1, 2 or 3");
    }
    const size_t length_bytes = start[6] == 1 ? 2 : 4;
    size_t length = 0;
    if (fread(start + 8, 1, length_bytes, stream) == length_bytes) {
        for (size_t i = length_bytes; i > 0; i--) {
            length = length << 8 | start[8 + i - 1];
        }
    }
    char header[MAX_HEADER + 1];
    if (length == 0 || length > MAX_HEADER || fread(header, 1, length, stream) != length) {
        return malformed(name, "cut short or longer than 4096 bytes");
    }
    header[length] = '\0';
    return parse_header(name, header, out);
}

/* The number with these 16 bits: a sign, 5 bits of exponent and 10 of mantissa (IEEE 754). */
static double half_float(uint64_t bits)
{
    const int exponent = (int)(bits >> 10 & 31);
    const double mantissa = (double)(bits & 1023), sign = bits >> 15 ? -1 : 1;
    return exponent == 31 ? sign * (mantissa > 0 ? (double)NAN : (double)INFINITY)
                          : sign * ldexp(exponent ? 1024 + mantissa : mantissa, (exponent ? exponent : 1) - 25);
}

static double decode(const unsigned char *bytes, const layout *l)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < l->item_size; i++) {
        bits = bits << 8 | bytes[l->big_endian ? i : l->item_size - 1 - i];
    }
    const int width = 8 * (int)l->item_size;
    if (l->kind == 'u') {
        return ldexp((double)bits, -width);
    }
    if (l->kind == 'i') { /* shifted, because the sign bit is the highest one of 64 then */
        const uint64_t high = bits << (64 - width);
        return high >> 63 ? -1 - (double)(~high >> (64 - width)) : (double)bits;
    }
    if (l->item_size == 2) {
        return half_float(bits);
    }
    if (l->item_size == 4) {
        const uint32_t bits32 = (uint32_t)bits;
        float x;
        memcpy(&x, &bits32, sizeof x);
        return (double)x;
    }
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Stores number `item` of the file in the points; fails if the number is not in [0,1] or, where l->mapped, not finite. */
static koksma_status put_item(const char *name, const layout *l, size_t item, double x, koksma_points *points)
{
    KOKSMA__FAIL_IF(l->mapped ? !isfinite(x) : !(x >= 0 && x <= 1), KOKSMA_MALFORMED,
                    "%s: item %zu: coordinate %.17g is %s", name, item, x,
                    l->mapped ? "not finite" : "outside [0,1]");
    const size_t place = l->fortran_order ? item % l->n * l->dim + item / l->n : item;
    points->xs[place] = x == 0 ? 0.0 : x;
    return KOKSMA_OK;
}

/* Returns whether all numbers are in [0,1] and none is -0: as unsigned integers, their bits are in the order of the numbers
   and not above those of 1, and the sign's bit is set neither in them nor in what is left to those. */
static bool are_coordinates(const double *xs, size_t n)
{
    const double one = 1;
    uint64_t most, signs = 0;
    memcpy(&most, &one, sizeof most);
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, &xs[i], sizeof bits);
        signs |= bits | (most - bits);
    }
    return !(signs >> 63);
}

/* Returns whether a double's lowest byte comes first in memory. */
static bool is_little_endian(void)
{
    const double one = 1;
    unsigned char bytes[sizeof one];
    memcpy(bytes, &one, sizeof one);
    return bytes[7] == 0x3f;
}

static koksma_status read_items(FILE *stream, const char *name, const layout *l, koksma_points *points)
{
    unsigned char bytes[8 * ITEMS_AT_ONCE];
    const size_t n_items = l->n * l->dim;
    const bool ready = l->kind == 'f' && l->item_size == sizeof *points->xs && !l->fortran_order &&
                       l->big_endian != is_little_endian();           /* the numbers lie in the file as in memory */
    const size_t at_once = ready ? 8 * ITEMS_AT_ONCE : ITEMS_AT_ONCE; /* 512 KiB of a cache, or the bytes here */
    for (size_t first = 0; first < n_items; first += at_once) {
        const size_t wanted = n_items - first < at_once ? n_items - first : at_once;
        double *xs = points->xs + first;
        const size_t got = fread(ready ? (void *)xs : bytes, l->item_size, wanted, stream);
        const bool done = ready && are_coordinates(xs, got);
        for (size_t i = 0; i < got && !done; i++) {
            KOKSMA__TRY(put_item(name, l, first + i, ready ? xs[i] : decode(bytes + i * l->item_size, l), points));
        }
        KOKSMA__FAIL_IF(got < wanted, KOKSMA_MALFORMED,
                        "%s: item %zu: the file ends before the %zu points of dim %zu that it claims", name,
                        first + got, l->n, l->dim);
    }
    KOKSMA__FAIL_IF(getc(stream) != EOF, KOKSMA_MALFORMED,
                    "%s: the file goes on after the %zu points of dim %zu that it claims", name, l->n, l->dim);
    return KOKSMA_OK;
}

/* Checks, before memory is allocated, that the file is as long as its header claims: a small file that claims 10^9
   points fails here. */
static koksma_status check_length(FILE *stream, const char *name, const layout *l)
{
    const long here = ftell(stream);
    if (here < 0 || fseek(stream, 0, SEEK_END)) {
        return KOKSMA_OK; /* a pipe has no length; read_items checks it */
    }
    const long end = ftell(stream);
    fseek(stream, here, SEEK_SET);
    KOKSMA__FAIL_IF((size_t)(end - here) / l->item_size < l->n * l->dim, KOKSMA_MALFORMED,
                    "%s: npy header: claims %zu points of dim %zu, but the file has %zu numbers", name, l->n, l->dim,
                    (size_t)(end - here) / l->item_size);
    return KOKSMA_OK;
}

/* Reads the numbers of an array whose header was read, as floats: item i of C order at numbers[i]. */
static koksma_status read_floats(FILE *stream, const char *name, const layout *l, float *numbers)
{
    const size_t count = l->n * l->dim;
    for (size_t i = 0; i < count; i++) {
        unsigned char bytes[8];
        KOKSMA__FAIL_IF(fread(bytes, l->item_size, 1, stream) != 1, KOKSMA_MALFORMED,
                        "%s: item %zu: the file ends before the %zu numbers that it claims", name, i, count);
        /* the middle of the interval of an unsigned integer */
        const double x = decode(bytes, l) + (l->kind == 'u' ? ldexp(0.5, -8 * (int)l->item_size) : 0);
        numbers[i] = (float)x;
    }
    KOKSMA__FAIL_IF(getc(stream) != EOF, KOKSMA_MALFORMED,
                    "%s: the file goes on after the %zu numbers that it claims", name, count);
    return KOKSMA_OK;
}

koksma_status koksma__npy_read_mask(const char *path, koksma__named by, size_t most, size_t shape[3], float **numbers)
{
    FILE *stream;
    layout l = {.most_axes = 3};
    *numbers = NULL;
    KOKSMA__TRY(koksma__file_open(path, KOKSMA__FILE_POINTS, by, &stream));
    koksma_status status = read_header(stream, path, &l);
    if (!status && (l.fortran_order || l.shape[0] > most || l.shape[1] > most || l.shape[2] > 4)) {
        status = malformed(path, l.fortran_order ? "a mask in Fortran order; numpy.ascontiguousarray converts it"
                                                 : "a mask larger than 1024 x 1024 pixels of 4 numbers");
    }
    if (!status) {
        l.n = l.shape[0] * l.shape[1];
        l.dim = l.shape[2];
        status = check_length(stream, path, &l);
    }
    if (!status) {
        *numbers = malloc(l.n * l.dim * sizeof **numbers);
        status =
            *numbers ? read_floats(stream, path, &l, *numbers) : koksma__fail_memory(l.n * l.dim * sizeof **numbers);
    }
    koksma__file_close(stream);
    memcpy(shape, l.shape, sizeof l.shape);
    if (status) {
        free(*numbers);
        *numbers = NULL;
    }
    return status;
}

koksma_status koksma__points_read_npy(FILE *stream, const char *name, bool mapped, koksma_points *points)
{
    layout l = {.most_axes = 2, .mapped = mapped};
    *points = (koksma_points){0};
    koksma_status status = read_header(stream, name, &l);
    if (!status) {
        status = check_length(stream, name, &l);
    }
    if (!status) {
        status = koksma__points_room(points, l.n, (int)l.dim);
    }
    if (!status) {
        status = read_items(stream, name, &l, points);
    }
    if (status) {
        koksma_points_fini(points);
    }
    return status;
}

void koksma__npy_put_header(FILE *stream, const char *descr, const char *shape)
{
    char header[KOKSMA__NPY_HEADER];
    const int size =
        snprintf(header, sizeof header, "{'descr': %s, 'fortran_order': False, 'shape': %s, }", descr, shape);
    const int total = (10 + size + 1 + 63) / 64 * 64, length = total - 10;
    fprintf(stream, "%cNUMPY%c%c%c%c", 0x93, 1, 0, length & 255, length >> 8);
    fprintf(stream, "%-*s\n", length - 1, header);
}

static void put_doubles(FILE *stream, const double *xs, size_t count)
{
    if (is_little_endian()) { /* without conversion */
        fwrite(xs, sizeof *xs, count, stream);
        return;
    }
    for (size_t i = 0; i < count && !ferror(stream); i += ITEMS_AT_ONCE) {
        unsigned char bytes[8 * ITEMS_AT_ONCE];
        const size_t n = count - i < ITEMS_AT_ONCE ? count - i : ITEMS_AT_ONCE;
        for (size_t j = 0; j < n; j++) {
            uint64_t bits;
            memcpy(&bits, &xs[i + j], sizeof bits);
            koksma__npy_set_word(bytes + 8 * j, bits);
        }
        fwrite(bytes, 8, n, stream);
    }
}

koksma_status koksma__points_put_npy(FILE *stream, const koksma_points *points, koksma__progress progress)
{
    const size_t count = points->n * (size_t)points->dim;
    for (size_t i = 0; i < count && !ferror(stream); i += WRITTEN_AT_ONCE) {
        const size_t n = count - i < WRITTEN_AT_ONCE ? count - i : WRITTEN_AT_ONCE;
        if (!koksma__keep_going(progress.run, progress.done + progress.share * (double)i / (double)count)) {
            return koksma__fail_interrupted();
        }
        put_doubles(stream, points->xs + i, n);
    }
    return KOKSMA_OK;
}
