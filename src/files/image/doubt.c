/* SPDX-License-Identifier: Apache-2.0 */
/* What in an image, beside the reference that it is compared with, looks like a mistake, but can be compared. */
#include "image/doubt.h"

#include <math.h>

#include "core/c_locale.h"
#include "image/image.h"

enum {
    LEAST = 256,    /* pixels, below which nothing is said of noise and factors */
    MOST = 1 << 15, /* about as many are looked at, in rows that are equally far apart: 1 ms */
};

static size_t rows_apart(const koksma_image *image)
{
    return 1 + (size_t)image->width * (size_t)image->height / MOST;
}

/* Sums over pixels of the luminances x of an image and y of its reference, and of their squares and products; the same of
   their roughness, the difference between a pixel and the mean of its neighbours at the left and right. */
typedef struct sums {
    double x, y, xx, xy, yy, rough_xx, rough_xy, rough_yy, n, inner;
    double doubt;    /* of the squares of roughness y (roughness y - roughness x), whose sum tells the noise of y */
    double rgb, bgr; /* squared differences of the colours, and with those of the image in reverse */
    bool equal, grey;
} sums;

/* Whether a pixel of one image has a colour where the other has none. */
static bool lacks_colour(const koksma_image *image, const koksma_image *other, size_t p)
{
    const float *rgb = image->pixels + 3 * p;
    return image->channels == 3 && other->channels == 1 && (rgb[0] != rgb[1] || rgb[1] != rgb[2]);
}

static void add_colours(sums *s, const float *image, const float *reference)
{
    for (size_t k = 0; k < 3; k++) {
        const double of = (double)reference[k], same = (double)image[k] - of, other = (double)image[2 - k] - of;
        s->rgb += same * same;
        s->bgr += other * other;
    }
}

/* Adds the pixels first .. end - 1, which are a row, but those that are black in `lit`, unless it is NULL. */
static void add_row(sums *s, const koksma_image *image, const koksma_image *reference, const koksma_image *lit,
                    size_t first, size_t end)
{
    const bool colours = image->channels == 3 && reference->channels == 3;
    double x = 0, y = 0, next_x = koksma__luminance(image, first), next_y = koksma__luminance(reference, first);
    for (size_t p = first; p < end; p++) {
        const double last_x = x, last_y = y;
        x = next_x;
        y = next_y;
        if (p + 1 < end) {
            next_x = koksma__luminance(image, p + 1);
            next_y = koksma__luminance(reference, p + 1);
        }
        if (lit && koksma__luminance(lit, p) == 0) {
            continue;
        }
        s->n++;
        s->x += x;
        s->y += y;
        s->xx += x * x;
        s->xy += x * y;
        s->yy += y * y;
        s->equal &= x == y;
        if (colours) {
            add_colours(s, image->pixels + 3 * p, reference->pixels + 3 * p);
        }
        s->grey |= lacks_colour(image, reference, p) || lacks_colour(reference, image, p);
        if (p > first && p + 1 < end) {
            const double rough_x = x - (last_x + next_x) / 2, rough_y = y - (last_y + next_y) / 2;
            s->rough_xx += rough_x * rough_x;
            s->rough_xy += rough_x * rough_y;
            s->rough_yy += rough_y * rough_y;
            s->doubt += rough_y * rough_y * (rough_y - rough_x) * (rough_y - rough_x);
            s->inner++;
        }
    }
}

static sums sums_of(const koksma_image *image, const koksma_image *reference, const koksma_image *lit)
{
    const size_t width = (size_t)image->width, n = width * (size_t)image->height, step = rows_apart(image) * width;
    sums s = {.equal = true};
    for (size_t first = 0; first < n; first += step) {
        add_row(&s, image, reference, lit, first, first + width);
    }
    for (size_t p = 0; s.equal && step > width && p < n; p++) {
        s.equal = koksma__luminance(image, p) == koksma__luminance(reference, p);
    }
    return s;
}

/* The number of pixels that are black in an image, but not in the one beside it, as after an interruption; 0 if they are
   few, or as in a noisy picture, where black pixels are single ones or little light is: here a pixel and the one at its
   right differ only at the edge of what is missing. */
static double cut_off(const koksma_image *image, const koksma_image *beside)
{
    const size_t width = (size_t)image->width, all = width * (size_t)image->height, apart = rows_apart(image);
    double n = 0, black = 0, lit = 0, edges = 0, light = 0, missed = 0;
    bool before = false;
    for (size_t p = 0; p < all; p += (p + 1) % width ? 1 : 1 + (apart - 1) * width) {
        n++;
        const double y = koksma__luminance(beside, p);
        const bool is_lit = koksma__luminance(image, p) != 0, is_black = y != 0 && !is_lit;
        edges += p % width && is_black != before;
        before = is_black;
        black += is_black;
        lit += is_lit;
        light += y;
        missed += is_black ? y : 0;
    }
    return 100 * black >= n && 4 * edges <= black && (!lit || 4 * edges <= lit) && 4 * missed * n >= light * black
               ? black * (double)all / n
               : 0;
}

static double noise(const sums *s, double c)
{
    const double rough = (s->rough_xx / c - 2 * s->rough_xy) / c + s->rough_yy;
    return s->inner > 0 ? rough / 1.5 / s->inner : 0; /* the roughness of white noise has 3/2 of its variance */
}

/* What noise leaves of the mean square difference between the image, divided by c, and the reference, beyond rounding. */
static double residue(const sums *s, double c)
{
    const double square = (s->xx / c - 2 * s->xy) / c + s->yy;
    return (square - 1e-9 * s->yy) / s->n - noise(s, c);
}

/* What noise leaves of the mean square difference is above half of the reference's variance. */
static bool is_another(const sums *s)
{
    const double mean = s->y / s->n;
    return residue(s, 1) > (s->yy / s->n - mean * mean) / 2;
}

koksma__likeness koksma__image_likeness(const koksma_image *image, const koksma_image *reference, bool order,
                                        double *number)
{
    const sums s = sums_of(image, reference, NULL);
    const double c = s.x / s.y, mean = s.y / s.n, apart = s.x / s.n - mean, whole = residue(&s, 1);
    *number = c;
    if (s.equal && !s.grey) {
        return KOKSMA__LIKE_ITSELF;
    }
    if (s.n < LEAST) {
        return s.grey ? KOKSMA__LIKE_GREY : KOKSMA__LIKE_NOISE;
    }
    const double here = cut_off(image, reference), there = cut_off(reference, image);
    if (here > 0 || there > 0) {
        const sums rest = sums_of(image, reference, here > 0 ? image : reference);
        if (!is_another(&rest)) {
            *number = here > 0 ? here : there;
            return here > 0 ? KOKSMA__LIKE_CUT : KOKSMA__LIKE_WHOLE;
        }
    }
    /* A factor is larger than 5 standard errors of the mean, and leaves little of the difference. */
    if (isfinite(c) && (c > 1.5 || (c > 0 && c < 1 / 1.5)) && apart * apart * s.n > 25 * c * c * noise(&s, c) &&
        residue(&s, c) < whole / 10) {
        return KOKSMA__LIKE_SCALED;
    }
    if (is_another(&s)) {
        return KOKSMA__LIKE_ANOTHER;
    }
    if (4 * s.bgr < s.rgb) {
        return KOKSMA__LIKE_REVERSED;
    }
    /* With independent noises the mean of y (y - x) is that of the reference's noise alone, and counts if it is above 2.5
       standard errors. What differs otherwise, as by gamma or swapped channels, is no noise. */
    const double theirs = s.rough_yy - s.rough_xy, part = theirs / (s.rough_xx - s.rough_xy + theirs);
    if (!s.grey && whole < noise(&s, 1) && theirs > 2.5 * sqrt(s.doubt) && part > 0.2) {
        *number = 100 * (sqrt(1 / (1 - fmin(part, 0.96))) - 1);
        return order && part > 0.75 ? KOKSMA__LIKE_SMOOTHER : KOKSMA__LIKE_NOISY;
    }
    return s.grey ? KOKSMA__LIKE_GREY : KOKSMA__LIKE_NOISE;
}

const char *koksma_image_doubt(const koksma_image *image, const koksma_image *reference, bool order)
{
    static _Thread_local char counted[160];
    static const char *const said[] = {
        [KOKSMA__LIKE_NOISE] = "",
        [KOKSMA__LIKE_ITSELF] = "its luminance is that of the reference in all pixels; is it the same image?",
        [KOKSMA__LIKE_CUT] =
            "%.0f of its pixels are black, and not in the reference: was it interrupted, or is it of direct light?",
        [KOKSMA__LIKE_WHOLE] =
            "%.0f pixels of the reference are black, and not in it: was that interrupted, or is it of direct light?",
        [KOKSMA__LIKE_SCALED] = "its mean is %.4g times that of the reference; divide by this, if the units differ",
        [KOKSMA__LIKE_ANOTHER] = "it differs from the reference by more than noise: another scene, view or exposure?",
        [KOKSMA__LIKE_REVERSED] = "its colours are like the reference's in reverse: are they blue, green and red?",
        [KOKSMA__LIKE_SMOOTHER] = "it has less noise than the reference, which comes last; are the two swapped?",
        [KOKSMA__LIKE_NOISY] = "the reference has noise of its own, by which errors are about %.0f %% too large",
        [KOKSMA__LIKE_GREY] =
            "only one of it and the reference has colours; errors are of luminance but for metrics of colours",
    };
    double number;
    if (!image || !reference || koksma__image_check_sizes(image, reference)) {
        return "";
    }
    const char *text = said[koksma__image_likeness(image, reference, order, &number)];
    koksma__snprintf(counted, sizeof counted, text, number);
    return counted;
}
