/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The random lines that Mitchell 1992 (section 5) measures edges with: in the square, and as points (m, b) of the
 * lines y = m x + b, where those that meet the square fill a bow-tie, 0 < b < 1 - m for m < 0 and -m < b < 1 for m >
 * 0.
 */
#include <math.h>

#include "measures/shared/lines.h"
#include "study/report/report.h"

enum { SIDE = 280, MARGIN = 6 };
static const double MOST_SLOPE = 3; /* of the points that are shown */

/* The two places where a x + b y = c meets the square's border; false: fewer. */
static bool meet_square(double a, double b, double c, double ends[2][2])
{
    int n = 0;
    for (int side = 0; side < 4 && n < 2; side++) {
        const double at = side % 2; /* x = 0, x = 1, y = 0, y = 1 */
        const double along = side < 2 ? (c - a * at) / b : (c - b * at) / a;
        if (along >= 0 && along < 1) {
            ends[n][0] = side < 2 ? at : along;
            ends[n++][1] = side < 2 ? along : at;
        }
    }
    return n == 2;
}

static void add_line(koksma__html *h, double a, double b, double c)
{
    double ends[2][2];
    const double scale = SIDE - 2 * MARGIN;
    if (meet_square(a, b, c, ends)) {
        koksma__html_add(h, "<path d=\"M%.2f %.2fL%.2f %.2f\"/>", MARGIN + scale * ends[0][0],
                         SIDE - MARGIN - scale * ends[0][1], MARGIN + scale * ends[1][0],
                         SIDE - MARGIN - scale * ends[1][1]);
    }
}

/* m over -3 .. 3 and b over -3 .. 4. */
static void place_dual(double m, double b, double at[2])
{
    at[0] = MARGIN + (SIDE - 2 * MARGIN) * (m + MOST_SLOPE) / (2 * MOST_SLOPE);
    at[1] = SIDE - MARGIN - (SIDE - 2 * MARGIN) * (b + MOST_SLOPE) / (2 * MOST_SLOPE + 1);
}

static void add_bow_tie(koksma__html *h)
{
    static const double corners[][2] = {{-3, 0}, {0, 0}, {3, -3}, {3, 1}, {0, 1}, {-3, 4}};
    koksma__html_add(h, "<path stroke-width=\"0.5\" d=\"");
    for (size_t i = 0; i < sizeof corners / sizeof *corners; i++) {
        double at[2];
        place_dual(corners[i][0], corners[i][1], at);
        koksma__html_add(h, "%c%.2f %.2f", i ? 'L' : 'M', at[0], at[1]);
    }
    koksma__html_add(h, "Z\"/>");
}

void koksma__report_lines(koksma__html *h, const koksma__figure *f, uint64_t seed)
{
    koksma__html_add(h, "<svg viewBox=\"0 0 %d %d\" width=\"%d\" role=\"img\" aria-label=\"", SIDE, SIDE, SIDE);
    koksma__html_text(h, f->title);
    koksma__html_add(h, "\"><g fill=\"none\" stroke=\"currentColor\" stroke-width=\"0.7\">");
    if (f->dual) {
        add_bow_tie(h);
    } else {
        koksma__html_add(h, "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"/>", MARGIN, MARGIN, SIDE - 2 * MARGIN,
                         SIDE - 2 * MARGIN);
    }
    for (long long i = 0; i < f->n; i++) {
        double a, b, c, at[2];
        koksma__random_line(KOKSMA__LINES_MITCHELL, seed, (uint64_t)i, &a, &b, &c);
        if (!f->dual) {
            add_line(h, a, b, c);
        } else if (fabs(a / b) <= MOST_SLOPE) {
            place_dual(-a / b, c / b, at);
            koksma__html_add(h, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"1.8\" fill=\"currentColor\"/>", at[0], at[1]);
        }
    }
    koksma__html_add(h, "</g></svg>");
}
