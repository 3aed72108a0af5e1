/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A report as data: sections that hold paragraphs, lists, tables, charts, figures and pictures, in the order in
 * which they are shown. Each call appends to the JSON text of the report (docs/report-format.md), which the page
 * (page/report.mjs) shows. A block ends where the next one begins, or its section ends: only sections have an end. A
 * failure is stored in json.status, and later calls then do nothing. A document is all zero at first, and
 * koksma__doc_append or koksma__json_writer_fini frees it.
 */
#ifndef KOKSMA_STUDY_REPORT_DOCUMENT_H
#define KOKSMA_STUDY_REPORT_DOCUMENT_H

#include <koksma/image.h>

#include "core/json_writer.h"
#include "plot/plot.h"
#include "stats/stats.h"

typedef struct koksma__document {
    koksma__json_writer json;
    int level;       /* depth of the JSON in which blocks are written */
    char style;      /* style of the next words: '`' code, '*' strong, '_' emphasised, '^' superscript; 0: none */
    bool in_text;    /* whether a run of words is open */
    bool in_columns; /* whether a table is open that has no row yet */
    bool in_heading; /* whether a section is open that has no content yet */
    size_t curves[KOKSMA__COLOURS]; /* how many series of the open chart have each colour */
} koksma__document;

/* Appends the content of `part`, and empties `part`. */
void koksma__doc_append(koksma__document *d, koksma__document *part);

/* Begins the text of a page: its format and version, title and description; plan: the name of a study's plan, or NULL.
   Members of the caller may follow, then koksma__doc_content begins the content, and koksma__doc_close ends it (and of a
   part its last block). */
void koksma__doc_head(koksma__document *d, const char *format, const char *title, const char *about,
                      const char *plan);
void koksma__doc_content(koksma__document *d);
void koksma__doc_close(koksma__document *d);

/* Whether nothing was written and nothing failed. */
bool koksma__doc_is_empty(const koksma__document *d);

/* The plural ending of a noun after the number n: "1 set", "2 sets". */
static inline const char *koksma__plural(double n)
{
    return n == 1 ? "" : "s";
}

/* Appends `more` to a list in a text of limited size, after `between` unless it is the first; nothing if they do not
   fit. */
void koksma__text_join(char *text, size_t size, const char *between, const char *more);

/* ---- Words ------------------------------------------------------------------------------------------------- */

/* Appends words to the open heading, paragraph, item or caption. The marks in `format` (not in its arguments) give
   words a style: `code`, *strong*, _emphasised_, ^superscript^. The conversions are %s, %d, %lld, %zu, and %f and %g
   with a precision and '+'; each number is written as a value with its text. */
void koksma__doc_say(koksma__document *d, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Appends words that were said in a document of their own, and empties it. */
void koksma__doc_say_words(koksma__document *d, koksma__document *words);

/* Begins a section with a heading, and its content; sections nest. id = NULL: no id; if ids repeat, the page makes them
   unique. A collapsed section is hidden until its heading is clicked. koksma__doc_end ends the innermost section. */
void koksma__doc_begin_section(koksma__document *d, const char *id, bool collapsed);
void koksma__doc_end(koksma__document *d);
#define koksma__doc_section(d, id, ...) (koksma__doc_begin_section(d, id, false), koksma__doc_say(d, __VA_ARGS__))
#define koksma__doc_collapsed_section(d, id, ...)                                                                    \
    (koksma__doc_begin_section(d, id, true), koksma__doc_say(d, __VA_ARGS__))

/* Begins what words are written into: a paragraph that answers the question of its section, which the page also shows
   in its overview; any other paragraph, or one that warns of doubtful or missing numbers; an item of a list; a caption.
   An answer's kind: whether the data decide the question (true or false), or what they say of a conclusion. */
typedef enum koksma__words_kind {
    KOKSMA__ANSWER_UNDECIDED,
    KOKSMA__ANSWER_DECIDED,
    KOKSMA__ANSWER_HOLDS,
    KOKSMA__ANSWER_PARTLY,
    KOKSMA__ANSWER_FAILS,
    KOKSMA__PARAGRAPH,
    KOKSMA__WARNING,
    KOKSMA__ITEM,
    KOKSMA__CAPTION
} koksma__words_kind;
void koksma__doc_begin(koksma__document *d, koksma__words_kind kind);

/* Each begins with its first words. */
#define koksma__doc_answer(d, kind, ...) (koksma__doc_begin(d, kind), koksma__doc_say(d, __VA_ARGS__))
#define koksma__doc_paragraph(d, ...) koksma__doc_answer(d, KOKSMA__PARAGRAPH, __VA_ARGS__)
#define koksma__doc_warning(d, ...) koksma__doc_answer(d, KOKSMA__WARNING, __VA_ARGS__)
#define koksma__doc_item(d, ...) koksma__doc_answer(d, KOKSMA__ITEM, __VA_ARGS__)
#define koksma__doc_caption(d, ...) koksma__doc_answer(d, KOKSMA__CAPTION, __VA_ARGS__)

/* A list. numbered: the items are notes that table cells refer to by number. */
void koksma__doc_list(koksma__document *d, const char *id, bool numbered);

/* Begins a list of command lines, for the reader to copy, that reproduce the numbers above them; adds one. A command is
   cut at twice the size of a list of names in it. */
enum { KOKSMA__DOC_COMMAND = 8192 };
void koksma__doc_commands(koksma__document *d);
void koksma__doc_command(koksma__document *d, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* ---- Tables ------------------------------------------------------------------------------------------------ */

/* A cell with more than a value. koksma__cell_of sets the value and all other fields to NAN, 0 or NULL, which means
   unused. */
typedef struct koksma__cell_data {
    double value, low, high, sd;
    size_t sets;         /* number of point sets, shown after the value if it differs between the rows of the table */
    const char *text;    /* the number as published, which is shown instead of the value */
    size_t note;         /* number of a note below the table, from 1 */
    const char *verdict; /* koksma_study_verdict_name */
    double z, change;    /* the numbers that the verdict is based on */
} koksma__cell_data;

koksma__cell_data koksma__cell_of(double value);

/* Begins a table, whose name the format gives: write by which column the page sorts it, if any, its columns, then its rows,
   which may have fewer cells than columns. */
void koksma__doc_table(koksma__document *d, const char *format, ...) KOKSMA_PRINTF(2, 3);
void koksma__doc_sort(koksma__document *d, const char *column, bool descending);
/* Columns, such as "t pattern;n7 cases;i3fh %s, slope#slope#%s". Each has a letter for its type: t text, n number, i value
   with its 95 % interval, s value with its standard deviation, v verdict on a published number; then the digits on the
   page; then letters: f the digits are decimal places, h the page hides the column, m it merges cells of neighbouring rows
   with equal texts. After a blank follow the name; after '#' the head on the page if that
   differs; after another '#' a common head above neighbouring columns. The conversions are %s and %lld; a head that is
   empty, or "%s" alone for NULL, is left out. */
void koksma__doc_columns(koksma__document *d, const char *columns, ...) KOKSMA_PRINTF(2, 3);
/* Begins a row with its first cells; koksma__doc_cells adds more. types has a letter for each, which is the type of its
   argument: t a text, n a double, z a size_t, d a long long, i a koksma__estimate. NAN: a dash. */
void koksma__doc_begin_row(koksma__document *d);
#define koksma__doc_row(d, ...) (koksma__doc_begin_row(d), koksma__doc_cells(d, __VA_ARGS__))
void koksma__doc_cells(koksma__document *d, const char *types, ...);
void koksma__doc_cell(koksma__document *d, const koksma__cell_data *cell);

/* ---- Charts ------------------------------------------------------------------------------------------------ */

typedef struct koksma__chart {
    const char *title, *x_title, *y_title; /* title: the title, which is also the chart's text alternative */
    bool log_x, log_y;
    /* which y is better: -1 smaller, 1 larger, 0 neither; of too many lines, the page first draws the best */
    int better;
} koksma__chart;

/* How a series is drawn: LINE: marks joined by lines; MARKS: marks alone; THEORY: a dashed line without marks;
   HOLLOW: hollow marks in the style of the series with the same label, for published numbers. */
typedef enum koksma__series_style {
    KOKSMA__SERIES_LINE,
    KOKSMA__SERIES_MARKS,
    KOKSMA__SERIES_THEORY,
    KOKSMA__SERIES_HOLLOW
} koksma__series_style;

/* Begins a chart; write its series, and the points of each. A series of lines or marks has the colour of its
   pattern, which is the same in all plots; pattern NULL: of the pattern with whose name its label begins. */
void koksma__doc_chart(koksma__document *d, const koksma__chart *chart);
void koksma__doc_series(koksma__document *d, const char *label, const char *pattern, koksma__series_style style);
/* Adds a point to the open series. low, high: the ends of the error bar of y; NAN: no bar. */
void koksma__doc_point(koksma__document *d, double x, double y, double low, double high);

/* ---- Figures and pictures ---------------------------------------------------------------------------------- */

/* Begins a figure: write its images or a drawing, then its caption. */
void koksma__doc_figure(koksma__document *d, const char *id);
/* An image `width` CSS pixels wide and high. */
void koksma__doc_svg(koksma__document *d, const unsigned char *svg, size_t size, int width, const char *alt);
/* An image as PNG, with `scale` CSS pixels per pixel. */
koksma_status koksma__doc_image(koksma__document *d, const koksma_image *image, int scale, const char *alt);
/* Begins a drawing of lines and dots, `width` CSS pixels wide. view: x and y of the lower left corner, then of the
   upper right corner. */
void koksma__doc_drawing(koksma__document *d, int width, const double view[4], const char *alt);
void koksma__doc_line(koksma__document *d, double x0, double y0, double x1, double y1);
void koksma__doc_dot(koksma__document *d, double x, double y);

/* Begins a set of images of one scene and size, stored as little-endian 32-bit floats in base 64. The first image is
   the reference; the page shows the others with their errors, and compares any two. */
void koksma__doc_pictures(koksma__document *d, const char *scene, int width, int height);
void koksma__doc_picture(koksma__document *d, const koksma_image *image, const char *name);

/* ---- The page ---------------------------------------------------------------------------------------------- */

/* A page that is published does not show where its author keeps files. koksma__folder_join makes `folder`, at first empty,
   the folder that it and the absolute paths of a text, a path or a pattern, have in common, with a slash at its end;
   koksma__doc_hide_folder removes it from all texts of a finished document, unless it is the root. */
enum { KOKSMA__FOLDER = 4096 };
void koksma__folder_join(char folder[KOKSMA__FOLDER], const char *text);
void koksma__doc_hide_folder(koksma__document *d, const char folder[KOKSMA__FOLDER]);

/* Returns the page with the JSON text in it, which the caller frees; NULL: out of memory. */
char *koksma__page_text(const char *json);

/* Writes the style of the pages, an element <style>. */
void koksma__page_style(FILE *f);

/* Writes the JSON text as report.json, and the page that shows it as report.html, into a folder. */
koksma_status koksma__page_write(const char *folder, const char *json);

#endif
