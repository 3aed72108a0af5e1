/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A report as data: sections that hold paragraphs, lists, tables, charts, figures and pictures, in the order in which
 * a reader meets them. Each call appends to the JSON text of the report (docs/report-format.md), which the page
 * (page/report.mjs) shows. A failure is remembered in json.status; later
 * calls do nothing. A document is all zero at first, and koksma__doc_append or koksma__json_writer_fini frees it.
 */
#ifndef KOKSMA_STUDY_REPORT_DOCUMENT_H
#define KOKSMA_STUDY_REPORT_DOCUMENT_H

#include <koksma/image.h>

#include "core/json_writer.h"
#include "plot/palette.h"
#include "stats/statistics.h"

typedef struct koksma__document {
    koksma__json_writer json;
    char style;   /* of the words that follow: '`' code, '*' strong, '_' emphasised, '^' superscript; 0: none */
    bool in_text; /* a run of words is open */
    bool in_rows; /* the open table has rows */
    bool curves[KOKSMA__CURVE_STYLES]; /* numbers that series of the open chart have */
} koksma__document;

/* Appends what `part` has, and empties it. */
void koksma__doc_append(koksma__document *d, koksma__document *part);

/* Whether nothing was written, or failed to be. */
bool koksma__doc_is_empty(const koksma__document *d);

/* ---- Words ------------------------------------------------------------------------------------------------- */

/* Appends words to the open heading, paragraph, item or caption. In `format` (not in its arguments) `code`,
   *strong*, _emphasised_ and ^superscript^ words stand between their marks. It takes %s, %d, %lld, %zu, and %f and %g with a
   precision and '+'; each number comes out as a value beside its text. */
void koksma__doc_say(koksma__document *d, const char *format, ...) KOKSMA_PRINTF(2, 3);

/* Ends the innermost section, series, chart, drawing or pictures. */
void koksma__doc_end(koksma__document *d);

/* A section with a heading; sections nest. id NULL: none; ids may repeat, the page tells them apart. collapsed: shown
   when its heading is clicked. Words of the heading: koksma__doc_say until koksma__doc_section_body. */
void koksma__doc_section_begin(koksma__document *d, const char *id, bool collapsed);
void koksma__doc_section_body(koksma__document *d);

/* A section with this heading, up to its body. */
void koksma__doc_section(koksma__document *d, const char *id, const char *heading);

/* A paragraph of words, or one that is said in pieces between begin and end. */
void koksma__doc_paragraph(koksma__document *d, const char *format, ...) KOKSMA_PRINTF(2, 3);
void koksma__doc_paragraph_begin(koksma__document *d);
void koksma__doc_paragraph_end(koksma__document *d);
/* A paragraph that answers what its section asks, which the page shows first: decided, or not yet. */
void koksma__doc_answer_begin(koksma__document *d, bool decided);

/* A list of items, each said between item and the next; numbered: notes that cells refer to. */
void koksma__doc_list_begin(koksma__document *d, const char *id, bool numbered);
void koksma__doc_item(koksma__document *d);
void koksma__doc_list_end(koksma__document *d);

/* Command lines that give the numbers above them, to be copied. */
void koksma__doc_commands(koksma__document *d, const char *const *lines, size_t n);

/* ---- Tables ------------------------------------------------------------------------------------------------ */

typedef enum koksma__column_type {
    KOKSMA__COLUMN_TEXT,
    KOKSMA__COLUMN_NUMBER,
    KOKSMA__COLUMN_INTERVAL, /* a value with its 95 % interval */
    KOKSMA__COLUMN_SPREAD,   /* a value with its standard deviation */
    KOKSMA__COLUMN_VERDICT   /* how a printed number goes with ours */
} koksma__column_type;

typedef struct koksma__column {
    const char *name;  /* head of the column in the CSV file */
    const char *title; /* head on the page; NULL: name */
    const char *group; /* head above equal neighbours; NULL: none */
    koksma__column_type type;
    int digits;  /* significant ones on the page, or decimals where `fixed` */
    bool fixed;  /* behind the point */
    bool hidden; /* on the page; in the data and the CSV file it is there */
    bool merged; /* cells of neighbouring rows with equal texts are one on the page */
} koksma__column;

/* A cell with more than a value: what applies is set, the rest NAN, 0 or NULL as koksma__cell_of leaves it. */
typedef struct koksma__cell_data {
    double value, low, high, sd;
    size_t sets;         /* printed after the value where the rows of a table have different numbers */
    const char *text;    /* shown instead of the value: a number as printed */
    size_t note;         /* number of a note below the table, from 1 */
    const char *verdict; /* koksma_study_verdict_name */
    double z, change;    /* of the verdict */
} koksma__cell_data;

koksma__cell_data koksma__cell_of(double value);

/* Columns come first, then rows; name is the CSV file's without its ending. Rows may end early. */
void koksma__doc_table_begin(koksma__document *d, const char *name);
/* Of a table that the page sorts by a column: by its values, or by the widths of its intervals. */
void koksma__doc_sorted_table_begin(koksma__document *d, const char *name, const char *column, bool by_width,
                                    bool descending);
void koksma__doc_column(koksma__document *d, const koksma__column *column);
void koksma__doc_head(koksma__document *d, const char *name); /* a column of texts */
void koksma__doc_head_number(koksma__document *d, const char *name, int digits);
void koksma__doc_head_interval(koksma__document *d, const char *name, int digits);
void koksma__doc_row(koksma__document *d);
void koksma__doc_text(koksma__document *d, const char *text);
void koksma__doc_number(koksma__document *d, double value); /* NAN: a dash */
void koksma__doc_interval(koksma__document *d, koksma__estimate estimate);
void koksma__doc_cell(koksma__document *d, const koksma__cell_data *cell);
void koksma__doc_table_end(koksma__document *d);

/* ---- Charts ------------------------------------------------------------------------------------------------ */

typedef struct koksma__chart {
    const char *title, *x_title, *y_title; /* title: also its text for those who don't see it */
    bool log_x, log_y;
} koksma__chart;

/* Lines joined at their marks; marks alone; a dashed line without marks, as of a theory; hollow marks in the style of
   the series of equal label, as of printed numbers. */
typedef enum koksma__series_style {
    KOKSMA__SERIES_LINE,
    KOKSMA__SERIES_MARKS,
    KOKSMA__SERIES_THEORY,
    KOKSMA__SERIES_HOLLOW
} koksma__series_style;

/* Series between begin and end. A series of lines or marks whose label begins with a pattern has its colour in all plots. */
void koksma__doc_chart_begin(koksma__document *d, const koksma__chart *chart);
void koksma__doc_series_begin(koksma__document *d, const char *label, koksma__series_style style);
/* low, high: the bar of y; NAN: none. */
void koksma__doc_point(koksma__document *d, double x, double y, double low, double high);

/* ---- Figures and pictures ---------------------------------------------------------------------------------- */

/* A figure: images or a drawing, then words of its caption from koksma__doc_caption on. */
void koksma__doc_figure_begin(koksma__document *d, const char *id);
/* An image `width` CSS pixels wide and high. */
void koksma__doc_svg(koksma__document *d, const unsigned char *svg, size_t size, int width, const char *alt);
/* An image as PNG, `scale` CSS pixels a pixel. */
koksma_status koksma__doc_image(koksma__document *d, const koksma_image *image, int scale, const char *alt);
/* A drawing of lines and dots, `width` CSS pixels wide; view: x and y of the corners at the lower left and the upper
   right. */
void koksma__doc_drawing_begin(koksma__document *d, int width, const double view[4], const char *alt);
void koksma__doc_line(koksma__document *d, double x0, double y0, double x1, double y1);
void koksma__doc_dot(koksma__document *d, double x, double y);
void koksma__doc_caption(koksma__document *d);
void koksma__doc_figure_end(koksma__document *d);

/* Images of one scene and size as 32-bit floats in base 64, little-endian, the first of which is the reference: the
   page shows them with their errors and compares any two. */
void koksma__doc_pictures_begin(koksma__document *d, const char *scene, int width, int height);
void koksma__doc_picture(koksma__document *d, const koksma_image *image, const char *name);

#endif
