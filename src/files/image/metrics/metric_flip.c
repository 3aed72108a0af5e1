/* SPDX-License-Identifier: Apache-2.0 */
/*
 * ldr-flip and hdr-flip: the difference that a viewer sees who flips between two images, 0 to 1 in each pixel.
 *
 * LDR-FLIP (Andersson et al. 2020), on linear RGB clamped to [0,1]:
 *   colour   RGB -> XYZ (sRGB primaries) -> YyCxCz, with X, Y, Z divided by those of RGB (1,1,1): Yy = 116 Y - 16,
 *            Cx = 500 (X - Y), Cz = 200 (Y - Z); filtered by the contrast sensitivity of each channel at ppd pixels
 *            per degree; clamped to [0,1] in RGB; CIELAB with a* and b* times L* / 100 (Hunt); the distance HyAB
 *            |dL| + sqrt(da^2 + db^2), to the power 0.7. M is the value of this distance between green and blue. The
 *            colour error c is linear: from 0 to 0.95 for distances up to 0.4 M, then from 0.95 to 1 at M
 *   feature  (Yy + 16) / 116 is filtered by the first (edges) and the second (points) derivative of a Gaussian of
 *            standard deviation 0.041 ppd pixels, each with positive weights of sum 1 and negative weights of sum -1.
 *            The lengths of the gradients of image and reference differ by e (edges) and p (points), and
 *            f = sqrt(max(e, p) / sqrt 2)
 *   error    c^(1 - f)
 * The contrast sensitivities are Gaussians sum_k a_k sqrt(pi / b_k) exp(-pi^2 x^2 / b_k), x in degrees: (a, b) is
 * (1, 0.0047) for Yy, (1, 0.0053) for Cx, (34.1, 0.04) and (13.5, 0.025) for Cz, all cut off at three standard
 * deviations of the widest, with weights of sum 1 in two dimensions. Pixels beyond the border repeat those on it. All
 * filters are separable, which takes O(n radius).
 *
 * HDR-FLIP (Andersson et al. 2021): both images are multiplied by 2^e and tone-mapped, for max(2, ceil(e1 - e0))
 * exposures e, equally spaced from e0 = log2(x / largest luminance) to e1 = log2(x / median luminance) of the
 * reference, where the tone-mapper maps grey x to 0.85; but for at most 64. The value of a pixel is its largest
 * LDR-FLIP over all exposures. A median of 0, a case that the paper leaves open, is replaced by the median of the
 * pixels above 0; a black reference has only the exposure e = 0. The authors' program (flip-evaluator 1.7) takes 2^-23
 * for such a median, which adds exposures up to 23 stops in which the image is white but for its black pixels, and
 * refuses black references.
 *
 * ppd: pixels per degree = (distance / width of the monitor) x (pixels across the monitor) x pi / 180; the papers'
 * default is 67.02, for 3840 pixels across 0.7 m, seen from 0.7 m.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"
#include "core/vector.h"
#include "image/formats.h"
#include "image/metrics/metrics.h"

#define PPD 67.02064327658225 /* 0.7 (3840 / 0.7) pi / 180 */
#define LN2 0.693147180559945309417

enum { MOST_RADIUS = 160, MOST_EXPOSURES = 64 };

/* ---- Colours --------------------------------------------------------------------------------------------- */

/* The matrix from RGB to XYZ for the primaries and the white of sRGB (IEC 61966-2-1), as fractions that are exact for
   its chromaticities. */
static const double to_xyz[9] = {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794,
                                 2613072.0 / 12288897,  8788810.0 / 12288897, 887015.0 / 12288897,
                                 1425312.0 / 73733382,  8788810.0 / 73733382, 70074185.0 / 73733382};

typedef struct colours {
    double from_xyz[9], white[3]; /* from_xyz: inverse of to_xyz; white: XYZ of RGB (1,1,1) */
} colours;

static void multiply(const double matrix[9], const double x[3], double out[3])
{
    for (int i = 0; i < 3; i++) {
        out[i] = koksma__dot(matrix + 3 * i, x);
    }
}

static double clamp(double x)
{
    return x > 0 ? x < 1 ? x : 1 : 0;
}

static double power(double x, double exponent)
{
    return x > 0 ? koksma__exp(exponent * koksma__log(x)) : 0;
}

static void to_ycxcz(const colours *c, const double rgb[3], double out[3])
{
    double xyz[3];
    multiply(to_xyz, rgb, xyz);
    const double x = xyz[0] / c->white[0], y = xyz[1] / c->white[1], z = xyz[2] / c->white[2];
    out[0] = 116 * y - 16;
    out[1] = 500 * (x - y);
    out[2] = 200 * (y - z);
}

static double lab_root(double t)
{
    const double d = 6.0 / 29;
    return t > d * d * d ? power(t, 1.0 / 3) : t / (3 * d * d) + 4.0 / 29;
}

/* CIELAB of XYZ relative to the white, with its chroma times L* / 100. */
static void hunt_lab(const double xyz[3], double out[3])
{
    const double x = lab_root(xyz[0]), y = lab_root(xyz[1]), z = lab_root(xyz[2]);
    out[0] = 116 * y - 16;
    out[1] = 0.01 * out[0] * 500 * (x - y);
    out[2] = 0.01 * out[0] * 200 * (y - z);
}

/* CIELAB (hunt_lab) of linear RGB. */
static void rgb_to_lab(const colours *c, const double rgb[3], double out[3])
{
    double xyz[3];
    multiply(to_xyz, rgb, xyz);
    for (int i = 0; i < 3; i++) {
        xyz[i] /= c->white[i];
    }
    hunt_lab(xyz, out);
}

/* CIELAB (hunt_lab) of filtered YyCxCz, clamped to the colours of a monitor. */
static void ycxcz_to_lab(const colours *c, const double in[3], double out[3])
{
    const double y = (in[0] + 16) / 116;
    const double xyz[3] = {(y + in[1] / 500) * c->white[0], y * c->white[1], (y - in[2] / 200) * c->white[2]};
    double rgb[3];
    multiply(c->from_xyz, xyz, rgb);
    for (int i = 0; i < 3; i++) {
        rgb[i] = clamp(rgb[i]);
    }
    rgb_to_lab(c, rgb, out);
}

static double hyab(const double a[3], const double b[3])
{
    const double da = a[1] - b[1], db = a[2] - b[2];
    return power(fabs(a[0] - b[0]) + sqrt(da * da + db * db), 0.7);
}

/* ---- Filters --------------------------------------------------------------------------------------------- */

typedef struct filter {
    int radius;
    double w[2 * MOST_RADIUS + 1];
} filter;

/* A Gaussian exp(-x^2 / (2 s^2)) with sum 1. For derivative = 1 it is multiplied by -x, for derivative = 2 by x^2 /
   s^2 - 1; then its positive weights have the sum 1 and its negative weights the sum -1. x is in units of `step`. */
static void gaussian(filter *f, int radius, double step, double s, int derivative)
{
    double positive = 0, negative = 0;
    f->radius = radius;
    for (int i = -radius; i <= radius; i++) {
        const double x = i * step, g = koksma__exp(-x * x / (2 * s * s));
        const double w = derivative == 0 ? g : derivative == 1 ? -x * g : (x * x / (s * s) - 1) * g;
        f->w[i + radius] = w;
        *(w > 0 ? &positive : &negative) += fabs(w);
    }
    for (int i = 0; i <= 2 * radius; i++) {
        f->w[i] /= f->w[i] > 0 ? positive : negative > 0 ? negative : 1;
    }
}

/* out = in filtered along x by f and along y by g. The outer loops run over lines and over the filter's weights, the
   inner ones over adjacent numbers. scratch: as many numbers as the image has, and one line extended by the radius at
   both ends. */
static void filter_image(const filter *f, const filter *g, const double *in, int width, int height, double *scratch,
                         double *out)
{
    const size_t w = (size_t)width, radius = (size_t)f->radius;
    double *const line = scratch + w * (size_t)height;
    for (size_t row = 0; row < w * (size_t)height; row += w) {
        for (size_t x = 0; x < w + 2 * radius; x++) {
            line[x] = in[row + (x < radius ? 0 : x - radius < w ? x - radius : w - 1)];
        }
        memset(scratch + row, 0, w * sizeof *scratch);
        for (size_t k = 0; k <= 2 * radius; k++) {
            for (size_t x = 0; x < w; x++) {
                scratch[row + x] += f->w[k] * line[x + k];
            }
        }
    }
    memset(out, 0, w * (size_t)height * sizeof *out);
    for (int y = 0; y < height; y++) {
        for (int k = -g->radius; k <= g->radius; k++) {
            const int at = y + k < 0 ? 0 : y + k < height ? y + k : height - 1;
            const double weight = g->w[k + g->radius];
            for (size_t x = 0; x < w; x++) {
                out[(size_t)y * w + x] += weight * scratch[(size_t)at * w + x];
            }
        }
    }
}

/* ---- LDR-FLIP --------------------------------------------------------------------------------------------- */

typedef struct flip {
    colours colours;
    filter sensitivity[4]; /* filters of Yy, Cx, and the two Gaussians of Cz */
    double share;          /* share of the first Gaussian in the sum of all weights of Cz's filter in two
                              dimensions */
    filter smooth, edge, point;
    int width, height;
    size_t n;
    double largest;                            /* the distance HyAB of green and blue, to the power 0.7 */
    double *planes, *scratch, *filtered, *sum; /* planes has 3 n numbers, the others n each */
    double *lab[2], *edges[2], *points[2];     /* for the image and for the reference: 3 n, n and n numbers */
    double *memory;
} flip;

/* The sum of the weights of a one-dimensional Gaussian before normalisation. */
static double weight_sum(const filter *f, double step, double s)
{
    double sum = 0;
    for (int i = -f->radius; i <= f->radius; i++) {
        sum += koksma__exp(-(i * step) * (i * step) / (2 * s * s));
    }
    return sum;
}

static void init_filters(flip *f, double ppd)
{
    static const double b[4] = {0.0047, 0.0053, 0.04, 0.025}, a[4] = {1, 1, 34.1, 13.5};
    const double step = 1 / ppd, feature = 0.5 * 0.082 * ppd;
    const int radius = (int)ceil(3 * sqrt(0.04 / (2 * M_PI * M_PI)) * ppd), feature_radius = (int)ceil(3 * feature);
    double total[4];
    for (int i = 0; i < 4; i++) { /* exp(-pi^2 x^2 / b): s^2 = b / (2 pi^2) */
        const double s = sqrt(b[i] / (2 * M_PI * M_PI));
        gaussian(&f->sensitivity[i], radius, step, s, 0);
        const double sum = weight_sum(&f->sensitivity[i], step, s);
        total[i] = a[i] * sqrt(M_PI / b[i]) * sum * sum;
    }
    f->share = total[2] / (total[2] + total[3]);
    gaussian(&f->smooth, feature_radius, 1, feature, 0);
    gaussian(&f->edge, feature_radius, 1, feature, 1);
    gaussian(&f->point, feature_radius, 1, feature, 2);
}

static koksma_status flip_init(flip *f, double ppd, int width, int height)
{
    const double green[3] = {0, 1, 0}, blue[3] = {0, 0, 1};
    double lab[2][3];
    f->width = width;
    f->height = height;
    f->n = (size_t)width * (size_t)height;
    const size_t size = (16 * f->n + (size_t)width + 2 * MOST_RADIUS) * sizeof *f->memory;
    f->memory = malloc(size);
    KOKSMA__REQUIRE_MEMORY(f->memory, size);
    double *at = f->memory;
    double **const parts[] = {&f->planes,   &f->lab[0],   &f->lab[1],    &f->filtered,  &f->sum,
                              &f->edges[0], &f->edges[1], &f->points[0], &f->points[1], &f->scratch};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        *parts[i] = at;
        at += i < 3 ? 3 * f->n : f->n;
    }
    koksma__invert(to_xyz, f->colours.from_xyz);
    multiply(to_xyz, (const double[3]){1, 1, 1}, f->colours.white);
    init_filters(f, ppd);
    rgb_to_lab(&f->colours, green, lab[0]);
    rgb_to_lab(&f->colours, blue, lab[1]);
    f->largest = hyab(lab[0], lab[1]);
    return KOKSMA_OK;
}

/* The lengths of the gradients whose components are the derivatives along x and along y. */
static void find_features(flip *f, const filter *derivative, const double *grey, double *out)
{
    filter_image(derivative, &f->smooth, grey, f->width, f->height, f->scratch, f->filtered);
    filter_image(&f->smooth, derivative, grey, f->width, f->height, f->scratch, f->sum);
    for (size_t p = 0; p < f->n; p++) {
        out[p] = sqrt(f->filtered[p] * f->filtered[p] + f->sum[p] * f->sum[p]);
    }
}

/* Computes, from clamped RGB, the features and colours of one image, which pixel_error compares with those of the
   other. */
static void analyse(flip *f, const double *rgb, int which)
{
    double *const y = f->planes, *const cx = y + f->n, *const cz = cx + f->n, *lab = f->lab[which];
    for (size_t p = 0; p < f->n; p++) {
        double c[3];
        to_ycxcz(&f->colours, rgb + 3 * p, c);
        y[p] = c[0];
        cx[p] = c[1];
        cz[p] = c[2];
    }
    for (int i = 0; i < 4; i++) { /* until the next loop `lab` holds the filtered Yy, Cx and Cz */
        const double *const in = f->planes + (size_t)(i < 3 ? i : 2) * f->n;
        const filter *s = &f->sensitivity[i];
        filter_image(s, s, in, f->width, f->height, f->scratch, f->filtered);
        for (size_t p = 0; p < f->n; p++) {
            double *const out = &lab[3 * p + (size_t)(i < 3 ? i : 2)];
            *out = i < 2    ? f->filtered[p]
                   : i == 2 ? f->share * f->filtered[p]
                            : *out + (1 - f->share) * f->filtered[p];
        }
    }
    for (size_t p = 0; p < f->n; p++) {
        const double filtered[3] = {lab[3 * p], lab[3 * p + 1], lab[3 * p + 2]};
        ycxcz_to_lab(&f->colours, filtered, lab + 3 * p);
        y[p] = (y[p] + 16) / 116;
    }
    find_features(f, &f->edge, y, f->edges[which]);
    find_features(f, &f->point, y, f->points[which]);
}

/* The error of pixel p between the image and the reference. */
static double pixel_error(const flip *f, size_t p)
{
    const double distance = hyab(f->lab[0] + 3 * p, f->lab[1] + 3 * p), knee = 0.4 * f->largest;
    const double colour =
        distance < knee ? 0.95 / knee * distance : 0.95 + (distance - knee) / (f->largest - knee) * (1 - 0.95);
    const double edge = fabs(f->edges[0][p] - f->edges[1][p]), point = fabs(f->points[0][p] - f->points[1][p]);
    return power(clamp(colour), 1 - clamp(sqrt(fmax(edge, point) / sqrt(2))));
}

/* ---- The two metrics ------------------------------------------------------------------------------------- */

static koksma_status ldr_errors(const koksma_metric_input *in, double *out)
{
    flip f;
    KOKSMA__TRY(flip_init(&f, in->params[0], in->width, in->height));
    double *const clamped = malloc(3 * f.n * sizeof *clamped);
    for (int which = 0; clamped && which < 2; which++) {
        for (size_t i = 0; i < 3 * f.n; i++) {
            clamped[i] = clamp((which ? in->reference : in->image)[i]);
        }
        analyse(&f, clamped, which);
    }
    for (size_t p = 0; clamped && p < f.n; p++) {
        out[p] = pixel_error(&f, p);
    }
    free(f.memory);
    free(clamped);
    return clamped ? KOKSMA_OK : koksma__fail_memory(3 * f.n * sizeof *clamped);
}

/* A tone-mapper maps grey x to (a x^2 + b x + c) / (d x^2 + e x + g); all but reinhard apply this function to each
   channel. aces: Narkowicz's (2015) fit to ACES with the exposure 0.6; hable: Hable's (2010) curve divided by its
   value at 11.2, with the exposure 2; reinhard: x / (1 + x), where colours are divided by 1 + their luminance. */
enum { ACES, HABLE, REINHARD };
static const char *const tone_mappers[] = {"aces", "hable", "reinhard", NULL};

typedef struct curve {
    double a, b, c, d, e, g;
} curve;

static curve curve_of(int tone_mapper)
{
    if (tone_mapper == ACES) {
        return (curve){0.36 * 2.51, 0.6 * 0.03, 0, 0.36 * 2.43, 0.6 * 0.59, 0.14};
    }
    if (tone_mapper == REINHARD) {
        return (curve){0, 1, 0, 0, 1, 1};
    }
    /* Hable's curve h(x) = (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F, as h(2 x) / h(11.2) for light x */
    const double A = 0.15, B = 0.50, C = 0.10, D = 0.20, E = 0.02, F = 0.30, white = 11.2;
    const double top = (white * (A * white + C * B) + D * E) / (white * (A * white + B) + D * F) - E / F;
    return (curve){(A - A * E / F) / top * 4, (C * B - B * E / F) / top * 2, 0, A * 4, B * 2, D * F};
}

static double map_tone(const curve *t, double x)
{
    return ((t->a * x + t->b) * x + t->c) / ((t->d * x + t->e) * x + t->g);
}

/* The linear value that the tone curve maps to y. */
static double invert_tone(const curve *t, double y)
{
    const double a = t->a - y * t->d, b = t->b - y * t->e, c = t->c - y * t->g;
    return a == 0 ? -c / b : (-b + (a < 0 ? -1 : 1) * sqrt(b * b - 4 * a * c)) / (2 * a);
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The first and the last exposure for a reference; scratch has one number for each pixel. */
static void find_exposures(const double *reference, size_t n, const curve *t, double *scratch, double *first,
                           double *last)
{
    for (size_t p = 0; p < n; p++) {
        scratch[p] = KOKSMA__LUMINANCE(reference + 3 * p);
    }
    qsort(scratch, n, sizeof *scratch, by_size);
    size_t dark = 0;
    while (dark < n && !(scratch[dark] > 0)) {
        dark++;
    }
    const double x = invert_tone(t, 0.85), median = scratch[n / 2 < dark ? dark + (n - dark) / 2 : n / 2];
    *first = dark < n ? koksma__log(x / scratch[n - 1]) / LN2 : 0;
    *last = dark < n ? koksma__log(x / median) / LN2 : 0;
}

/* A median of 0 is where find_exposures leaves the implementation of the paper's authors. */
static const char *black_caveat(const koksma_metric_input *in)
{
    const size_t n = (size_t)in->width * (size_t)in->height;
    size_t dark = 0;
    for (size_t p = 0; p < n; p++) {
        dark += !(KOKSMA__LUMINANCE(in->reference + 3 * p) > 0);
    }
    return dark <= n / 2 ? NULL
           : dark == n
               ? "the whole reference is black, so the exposure is 2^0 alone; the authors' flip-evaluator refuses it"
               : "more than half of the reference is black, so the largest exposure follows from the median of "
                 "the pixels above 0; the authors' flip-evaluator takes 2^-23, and can give much larger values";
}

static void expose(const double *in, size_t n, double scale, int tone_mapper, const curve *t, double *out)
{
    for (size_t p = 0; p < 3 * n; p += 3) {
        const double rgb[3] = {scale * in[p], scale * in[p + 1], scale * in[p + 2]}, y = KOKSMA__LUMINANCE(rgb);
        for (int c = 0; c < 3; c++) {
            out[p + (size_t)c] = clamp(tone_mapper == REINHARD ? rgb[c] / (1 + y) : map_tone(t, rgb[c]));
        }
    }
}

static koksma_status hdr_errors(const koksma_metric_input *in, double *out)
{
    flip f;
    KOKSMA__TRY(flip_init(&f, in->params[0], in->width, in->height));
    const int tone_mapper = (int)in->params[1];
    const curve t = curve_of(tone_mapper);
    double first, last, *const mapped = malloc(3 * f.n * sizeof *mapped);
    if (mapped) {
        find_exposures(in->reference, f.n, &t, f.scratch, &first, &last);
        const int count = (int)fmin(fmax(ceil(last - first), 2), MOST_EXPOSURES);
        memset(out, 0, f.n * sizeof *out);
        for (int i = 0; i < count; i++) {
            const double scale = koksma__exp(LN2 * (first + (last - first) * i / (count - 1)));
            expose(in->image, f.n, scale, tone_mapper, &t, mapped);
            analyse(&f, mapped, 0);
            expose(in->reference, f.n, scale, tone_mapper, &t, mapped);
            analyse(&f, mapped, 1);
            for (size_t p = 0; p < f.n; p++) {
                out[p] = fmax(out[p], pixel_error(&f, p));
            }
        }
    }
    free(f.memory);
    free(mapped);
    return mapped ? KOKSMA_OK : koksma__fail_memory(3 * f.n * sizeof *mapped);
}

static const koksma_param params[] = {
    {"ppd", "pixels per degree of the viewer's field of view", PPD, 1, 1000, NULL, false},
    {0},
};

static const koksma_param hdr_params[] = {
    {"ppd", "pixels per degree of the viewer's field of view", PPD, 1, 1000, NULL, false},
    {"tone-mapper", "the tone-mapping curve from linear light to the monitor", ACES, 0, 2, tone_mappers, true},
    {0},
};

const koksma_metric koksma__metric_ldr_flip = {
    .name = "ldr-flip",
    .title = "LDR-FLIP: the visible difference of RGB images clamped to 0..1; from 0 to 1",
    .cite = "andersson2020",
    .revision = 1, /* own elementary functions */
    .params = params,
    .channels = 3,
    .errors = ldr_errors,
};

const koksma_metric koksma__metric_hdr_flip = {
    .name = "hdr-flip",
    .title =
        "HDR-FLIP: the largest LDR-FLIP over a range of exposures; from 0 to 1. If more than half of the reference "
        "is black, the median that sets the largest exposure is that of the pixels above 0; the authors' "
        "flip-evaluator takes 2^-23 for it, exposes up to 23 stops further, and can give much larger values",
    .cite = "andersson2021",
    .revision = 1,
    .params = hdr_params,
    .channels = 3,
    .errors = hdr_errors,
    .caveat = black_caveat,
};
