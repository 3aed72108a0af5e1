/* SPDX-License-Identifier: Apache-2.0 */
/* Charts of a report as SVG in the page's own colours: lines or marks, axes linear or logarithmic. */
#ifndef KOKSMA_STUDY_REPORT_REPORT_CHART_H
#define KOKSMA_STUDY_REPORT_REPORT_CHART_H

#include "study/report/html.h"

enum { KOKSMA__CHART_SERIES = 24, KOKSMA__CHART_POINTS = 64 };

typedef struct koksma__chart_series {
    char label[96];
    bool line;   /* joined, else marks alone; which is whose tells the legend, by colour and shape */
    bool theory; /* a dashed line without marks */
    bool hollow; /* larger marks that are not filled, without a line in the legend */
    size_t like; /* the number, from 1, of the series whose colour and shape it has; 0: its own */
    size_t n;
    double x[KOKSMA__CHART_POINTS], y[KOKSMA__CHART_POINTS];
    double low[KOKSMA__CHART_POINTS], high[KOKSMA__CHART_POINTS]; /* of y; equal or NaN for none */
} koksma__chart_series;

typedef struct koksma__chart {
    const char *title, *x_title, *y_title; /* title: also its text for those who don't see it */
    bool log_x, log_y;
    size_t n;
    koksma__chart_series *series; /* room for KOKSMA__CHART_SERIES */
    size_t left_out;              /* what else there is, which the caption counts */
} koksma__chart;

/* Non-finite points, and on logarithmic axes those that are not positive, are left out. */
void koksma__html_chart(koksma__html *html, const koksma__chart *chart);

#endif
