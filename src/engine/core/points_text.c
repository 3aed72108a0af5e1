/* SPDX-License-Identifier: Apache-2.0 */
/* Reads and writes points as text: one point per line, with numbers as `%.17g`, after lines `# key value`. Reading
   accepts blanks, commas and tabs between fields, comments from a # to the end of the line, and a CSV header. A line with
   nothing but a # ends a set in the files of UTK (utk-team/utk), which may hold several; one set is read, so that points
   after such a line are an error. If there
   is a line `# n N` or `# dim D`, it must match the points. Test files with known values have another form: a preamble
   of lines `key number`, ended by a line `points`. Its lines `n N` and `dim D` must also match. */
#include "core/point_files.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/files.h"
#include "core/parallel.h"
#include "core/status.h"

enum { MAX_LINE = 1 << 18, BLOCK = 2 * MAX_LINE, SHOWN = 40 };

typedef struct reader {
    FILE *stream;
    const char *name;
    bool mapped; /* take all finite coordinates, not only those in [0,1] */
    char *block; /* BLOCK + 1 bytes; those from `at` to `held` have not been used yet */
    size_t at, held;
    bool at_end;
    char *line; /* the line, as a pointer into the block */
    size_t line_number, length;
    uint64_t bytes; /* total length of all lines so far */
    bool header_seen;
    size_t ended_at; /* the line that ended the set; 0: none */
    /* of parts between blank lines: the coordinates of the first, how many are whole, whether one has another size, and
       whether the last line was blank */
    size_t part, parts;
    bool uneven, blank;
    bool in_preamble; /* true after a line `key number`, until the line `points` */
    size_t header_fields;
    unsigned long long promised_n, promised_dim; /* 0: nothing promised */
    size_t capacity;                             /* capacity of xs, in coordinates */
    koksma_points *points;
} reader;

static koksma_status malformed(const reader *r, const char *reason)
{
    return koksma__fail(KOKSMA_MALFORMED, "%s: line %zu: %s", r->name, r->line_number, reason);
}

/* Reads one line without its line end. Returns false at the end of the file. */
static bool read_line(reader *r, koksma_status *status)
{
    char *end;
    while (!(end = memchr(r->block + r->at, '\n', r->held - r->at)) && r->held - r->at <= MAX_LINE && !r->at_end) {
        r->held -= r->at;
        memmove(r->block, r->block + r->at, r->held);
        r->at = 0;
        const size_t got = fread(r->block + r->held, 1, BLOCK - r->held, r->stream);
        r->held += got;
        r->at_end = got == 0;
    }
    r->line = r->block + r->at;
    r->length = (end ? (size_t)(end - r->block) : r->held) - r->at;
    const bool any = end || r->length;
    r->line_number += any;
    if (r->length > MAX_LINE) {
        *status = malformed(r, *r->line ? "longer than 262144 characters"
                                        : "zero bytes, as in a file that was not written whole");
        return false;
    }
    r->at += r->length + (end != NULL);
    if (r->length && r->line[r->length - 1] == '\r') {
        r->length--;
    }
    r->line[r->length] = '\0';
    r->bytes += r->length + 1;
    /* a pipe may send comments or empty lines without end */
    if (r->bytes > koksma__file_most(KOKSMA__FILE_POINTS)) {
        *status = koksma__file_too_long(r->name, KOKSMA__FILE_POINTS);
        return false;
    }
    return any;
}

static bool is_separator(char c)
{
    return c == ' ' || c == '\t' || c == ',' || c == ';';
}

static const char *skip_blanks(const char *s)
{
    while (*s == ' ' || *s == '\t') {
        s++;
    }
    return s;
}

/* Returns the start of the next field, given the end of a field. One comma or semicolon may separate the fields; if
   there are two, it returns NULL. */
static const char *next_field(const char *s)
{
    s = skip_blanks(s);
    if (*s == ',' || *s == ';') {
        s = skip_blanks(s + 1);
        if (*s == ',' || *s == ';') {
            return NULL;
        }
    }
    return s;
}

static koksma_status read_promise(reader *r, const char *line, const char *format)
{
    char key[8];
    char digits[24];
    char after = ' '; /* "# n 1e2 points" is an ordinary comment */
    if (sscanf(line, format, key, digits, &after) >= 2 && (after == ' ' || after == '\t')) {
        unsigned long long *promise = !strcmp(key, "n")     ? &r->promised_n
                                      : !strcmp(key, "dim") ? &r->promised_dim
                                                            : NULL;
        if (promise) {
            *promise = strtoull(digits, NULL, 10);
            KOKSMA__FAIL_IF(*promise > KOKSMA_MAX_COORDINATES, KOKSMA_MALFORMED,
                            "%s: line %zu: claims %s = %llu, but at most %zu fit into one set", r->name,
                            r->line_number, key, *promise, KOKSMA_MAX_COORDINATES);
        }
    }
    return KOKSMA_OK;
}

/* Reads a line of the preamble: a word and a number, or `points`. Returns false for any other line. */
static bool take_preamble(reader *r, const char *s, koksma_status *status)
{
    if (!strcmp(s, "points") && r->in_preamble) {
        r->in_preamble = false;
        r->header_seen = true;
        return true;
    }
    const size_t word = strcspn(s, " \t,;");
    const char *number = next_field(s + word);
    char *end;
    const bool letter = (*s | 32) >= 'a' && (*s | 32) <= 'z';
    if (!letter || !number || !*number || (koksma__strtod(number, &end), *skip_blanks(end)) || end == number) {
        return false;
    }
    koksma__strtod(s, &end);
    if (end != s) { /* a line that begins with a number, such as "nan 0.5", is a malformed point, not a header */
        return false;
    }
    r->in_preamble = true;
    *status = read_promise(r, s, "%7[a-z] %23[0-9]%c");
    return true;
}

static koksma_status append(reader *r, double x)
{
    koksma_points *p = r->points;
    const size_t used = p->n; /* while reading, n counts coordinates */
    KOKSMA__FAIL_IF(used == KOKSMA_MAX_COORDINATES, KOKSMA_MALFORMED,
                    "%s: line %zu: more coordinates than the %zu that fit into one set", r->name, r->line_number,
                    KOKSMA_MAX_COORDINATES);
    if (used == r->capacity) {
        const size_t capacity = used ? 2 * used : 64;
        double *xs = realloc(p->xs, capacity * sizeof *xs);
        KOKSMA__REQUIRE_MEMORY(xs, capacity * sizeof *xs);
        p->xs = xs;
        r->capacity = capacity;
    }
    p->xs[p->n++] = x;
    return KOKSMA_OK;
}

/* Returns whether a first line is a CSV header: each field begins with a letter or _, perhaps after a quote. If the
   line has commas or semicolons, names may contain blanks. */
static bool take_header(reader *r, const char *s)
{
    const char *separators = strpbrk(s, ",;") ? ",;" : " \t";
    size_t fields = 0;
    while (s && *s) {
        const char first = s[*s == '"'];
        char *end;
        koksma__strtod(s, &end); /* a line with a number, such as "nan 0.5", is a malformed point */
        if (!((first | 32) >= 'a' && (first | 32) <= 'z') && first != '_') {
            return false;
        }
        if (end != s && (is_separator(*end) || !*end)) {
            return false;
        }
        fields++;
        s = next_field(s + strcspn(s, separators));
    }
    if (!s) {
        return false;
    }
    r->header_seen = true;
    r->header_fields = fields;
    return true;
}

/* What a field that is no number probably belongs to, by its first character. */
static const char *field_hint(const char *field)
{
    static const struct {
        const char *first, *hint;
    } hints[] = {
        {"[({\"'", "; write one point a line, bare numbers between blanks or commas"},
        {"%/!", "; a comment begins with #"},
        {"<", "; this looks like a page of the web in place of the file"},
    };
    char *end;
    koksma__strtod(field, &end);
    if (end != field) {
        return *end == '%'          ? "; write 0.5 for 50%"
               : strchr("dD", *end) ? "; write an exponent with e, as in 5e-1"
               : *end == '/'        ? "; write 0.5 for 1/2"
                                    : "; write bare numbers, without units or suffixes";
    }
    for (size_t i = 0; i < sizeof hints / sizeof *hints; i++) {
        if (strchr(hints[i].first, *field)) {
            return hints[i].hint;
        }
    }
    const bool letter = (*field | 32) >= 'a' && (*field | 32) <= 'z';
    return letter ? "; a column of names, or a second line of words, has to go" : "";
}

static koksma_status bad_number(const reader *r, const char *field)
{
    int length = 0;
    while (length < SHOWN && field[length] && !is_separator(field[length])) {
        length++;
    }
    const bool nameless = !r->points->dim && (*field == ',' || !strncmp(field, "\"\"", 2)); /* by pandas, and by R */
    return koksma__fail(
        KOKSMA_MALFORMED, "%s: line %zu: '%.*s' is not a number%s", r->name, r->line_number, length, field,
        nameless ? "; a header whose first name is empty has an index column: leave that out" : field_hint(field));
}

/* Whether a line has decimal commas: a comma between digits, and another separator of fields. */
static bool has_decimal_commas(const char *line)
{
    bool comma = false, other = false;
    for (const char *s = line; *s && *s != '#'; s++) {
        const bool inside = s > line && strchr("0123456789", s[-1]) && s[1] && strchr("0123456789", s[1]);
        comma |= *s == ',' && inside;
        other |= *s == ';' || *s == '\t' || (*s == ' ' && s > line && s[-1] != ',' && s[1] && s[1] != ',');
    }
    return comma && other;
}

/* The end of a message on coordinate number `field` of a row, which is outside [0,1]: what the file probably has. */
static const char *outside_hint(const reader *r, double x, int field, const char *end)
{
    const koksma_points *p = r->points; /* n counts coordinates */
    const size_t rows = p->dim ? p->n / (size_t)p->dim : 0;
    const char *next = next_field(end);
    const bool more = next && *next;
    if (has_decimal_commas(r->line)) {
        return "; the line has decimal commas: write points, as in 0.5";
    }
    if (rows > 0 && p->dim > 1 && (field == 0) == more && x == p->xs[field] + (double)rows) {
        return more ? "; the first column counts the rows: leave it out"
                    : "; the last column counts the rows: leave it out";
    }
    if (field == 0 && rows == 0 && x == floor(x) && !strpbrk(r->line, ".eE")) {
        return "; a line that says how many points follow is a comment, as in '# n 64'";
    }
    if (x < 0 && x >= -1) {
        return x < -0.5 ? "; points of [-1,1] are (x + 1) / 2 here"
                        : "; points of [-1/2,1/2] are x + 1/2 here, of [-1,1] (x + 1) / 2";
    }
    return "";
}

/* Counts the parts of a file that blank lines divide, when a part begins. */
static void begin_part(reader *r)
{
    const size_t n = r->points->n;
    r->part = r->part ? r->part : n;
    r->parts++;
    r->uneven |= n != r->parts * r->part;
    r->blank = false;
}

static koksma_status read_row(reader *r, const char *s)
{
    int fields = 0;
    if (r->blank) {
        begin_part(r);
    }
    while (s && *s) {
        char *end;
        const double x = koksma__strtod(s, &end);
        if (end == s || !(is_separator(*end) || !*end)) {
            return bad_number(r, s);
        }
        KOKSMA__FAIL_IF(r->mapped ? !isfinite(x) : !(x >= 0 && x <= 1), KOKSMA_MALFORMED,
                        "%s: line %zu: coordinate %.17g is %s%s", r->name, r->line_number, x,
                        r->mapped ? "not finite" : "outside [0,1]", r->mapped ? "" : outside_hint(r, x, fields, end));
        if (++fields > KOKSMA_MAX_DIM) {
            return malformed(r, "more than 4096 coordinates");
        }
        const koksma_status status = append(r, x == 0 ? 0.0 : x); /* no -0 */
        if (status) {
            return status;
        }
        s = next_field(end);
    }
    if (!s) {
        return malformed(r, "an empty field");
    }
    if (r->points->dim == 0) {
        r->points->dim = fields;
    }
    KOKSMA__FAIL_IF(fields != r->points->dim, KOKSMA_MALFORMED,
                    "%s: line %zu: ragged row: %d coordinates, but the rows before have %d", r->name, r->line_number,
                    fields, r->points->dim);
    return KOKSMA_OK;
}

/* Cuts a comment, and the blanks before it, from the end of a line. Names in a CSV header may contain a #, so that in a
   line of words a blank must come before it. */
static void cut_comment(char *s)
{
    const bool words = !strchr("+-.0123456789", *s);
    char *cut = strchr(s, '#');
    while (cut && words && cut[-1] != ' ' && cut[-1] != '\t') {
        cut = strchr(cut + 1, '#');
    }
    while (cut && cut > s && (cut[-1] == ' ' || cut[-1] == '\t')) {
        cut--;
    }
    if (cut) {
        *cut = '\0';
    }
}

static koksma_status take_line(reader *r)
{
    bool control = false, high = false;
    for (size_t i = 0; i < r->length; i++) {
        const unsigned char c = (unsigned char)r->line[i];
        control |= (c < 0x20) & (c != '\t');
        high |= c >= 0x80;
    }
    const unsigned char *head = (const unsigned char *)r->line;
    if (r->line_number == 1 && ((head[0] == 0xff && head[1] == 0xfe) || (head[0] == 0xfe && head[1] == 0xff))) {
        return malformed(r, "the text is UTF-16; save the file as UTF-8");
    }
    if (control) {
        return malformed(r, r->line_number == 1 && !strncmp(r->line, "PK", 2)
                                ? "an archive, such as .npz or .xlsx; save one array as .npy, or points as text"
                            : r->line_number == 1 && head[0] == 0x1f && head[1] == 0x8b
                                ? "packed by gzip; unpack it with gunzip"
                                : "not text (a control character); it takes text, or an array of numpy.save");
    }
    /* the byte order mark that Excel writes before UTF-8 */
    const bool marked = r->line_number == 1 && !strncmp(r->line, "\xef\xbb\xbf", 3);
    char *const line = r->line + (marked ? 3 : 0), *const s = line + (skip_blanks(line) - line);
    if (*s == '\0') {
        r->blank = r->points->n > 0;
        return KOKSMA_OK;
    }
    if (*s == '#') {
        const bool ends = r->points->dim && !*skip_blanks(s + 1);
        r->ended_at = ends && !r->ended_at ? r->line_number : r->ended_at;
        return read_promise(r, s, "# %7[a-z] %23[0-9]%c");
    }
    KOKSMA__FAIL_IF(r->ended_at, KOKSMA_MALFORMED,
                    "%s: line %zu: the line '#' ends a set of %zu points, but more follow; put each set into a file",
                    r->name, r->ended_at, r->points->n / (size_t)r->points->dim);
    cut_comment(s);
    koksma_status status = KOKSMA_OK;
    if (r->points->dim == 0 && !r->header_seen && take_preamble(r, s, &status)) {
        return status;
    }
    if (r->in_preamble) {
        return malformed(r, "the line is neither a key with a number nor the line 'points'");
    }
    if (r->points->dim == 0 && !r->header_seen && take_header(r, s)) {
        return KOKSMA_OK;
    }
    return high && strchr("+-.0123456789", *s) == NULL
               ? malformed(r, "not text of numbers; it takes one point a line, or an array of numpy.save")
               : read_row(r, s);
}

static koksma_status check_promises(const reader *r, size_t n)
{
    const int dim = r->points->dim;
    KOKSMA__FAIL_IF(r->line_number == 0, KOKSMA_MALFORMED, "%s: the file is empty; it takes one point a line",
                    r->name);
    KOKSMA__FAIL_IF(n == 0, KOKSMA_MALFORMED, "%s: line %zu: no points in the file", r->name, r->line_number);
    KOKSMA__FAIL_IF(r->promised_n && r->promised_n != n, KOKSMA_MALFORMED,
                    n < r->promised_n
                        ? "%s: line %zu: the file ends after %zu of %llu points"
                        : "%s: line %zu: the file has %zu points, not %llu as it claims; is it two files?",
                    r->name, r->line_number, n, r->promised_n);
    const size_t rows = r->part / (size_t)dim, sets = r->parts + 1;
    KOKSMA__FAIL_IF(
        rows > 1 && !r->uneven && n == sets * rows && !r->promised_n, KOKSMA_MALFORMED,
        "%s: line %zu: blank lines divide it into %zu sets of %zu points; put each into a file, or leave the "
        "lines out",
        r->name, r->line_number, sets, rows);
    KOKSMA__FAIL_IF((r->promised_dim && r->promised_dim != (unsigned)dim) ||
                        (r->header_fields && r->header_fields != (size_t)dim),
                    KOKSMA_MALFORMED, "%s: line %zu: rows have %d coordinates, but the header claims %llu", r->name,
                    r->line_number, dim, r->promised_dim ? r->promised_dim : r->header_fields);
    return KOKSMA_OK;
}

koksma_status koksma__points_read_text(FILE *stream, const char *name, bool mapped, koksma_points *points)
{
    *points = (koksma_points){0};
    reader r = {.stream = stream, .name = name, .mapped = mapped, .points = points, .block = malloc(BLOCK + 1)};
    koksma_status status = r.block ? KOKSMA_OK : koksma__fail_memory(BLOCK + 1);
    while (!status && read_line(&r, &status)) {
        status = take_line(&r);
    }
    if (!status && ferror(stream)) {
        status = koksma__fail(KOKSMA_MISSING, "%s: can't be read: %s", name, strerror(errno));
    }
    if (!status) {
        points->n /= points->dim ? (size_t)points->dim : 1;
        status = check_promises(&r, points->n);
    }
    free(r.block);
    if (status) {
        koksma_points_fini(points);
    }
    return status;
}

koksma_status koksma__points_put_rows(FILE *stream, const koksma_points *points, char separator,
                                      koksma__progress progress)
{
    char text[256 * (KOKSMA__DECIMAL_ROOM + 1)];
    size_t length = 0;
    for (size_t i = 0; i < points->n && (i % 256 || !ferror(stream)); i++) {
        if (i % 256 == 0 &&
            !koksma__keep_going(progress.run, progress.done + progress.share * (double)i / (double)points->n)) {
            return koksma__fail_interrupted();
        }
        for (int k = 0; k < points->dim; k++) {
            const double x = points->xs[i * (size_t)points->dim + (size_t)k];
            const size_t quick = koksma__decimal_write(x, text + length);
            length += quick ? quick : (size_t)koksma__snprintf(text + length, KOKSMA__DECIMAL_ROOM, "%.17g", x);
            text[length++] = k + 1 < points->dim ? separator : '\n';
            if (length > sizeof text - KOKSMA__DECIMAL_ROOM - 1) {
                fwrite(text, 1, length, stream);
                length = 0;
            }
        }
    }
    fwrite(text, 1, length, stream);
    return KOKSMA_OK;
}

void koksma__points_begin_text(FILE *stream, uint64_t n, int dim, const char *comment)
{
    fprintf(stream, "# koksma %s\n", koksma_version());
    while (comment && *comment) {
        fputs("# ", stream);
        for (; *comment && *comment != '\n';
             comment++) { /* readers would mistake a file with control characters for a binary format */
            putc((unsigned char)*comment >= 0x20 ? *comment : '?', stream);
        }
        putc('\n', stream);
        comment += *comment == '\n';
    }
    fprintf(stream, "# n %llu\n# dim %d\n", (unsigned long long)n, dim);
}
