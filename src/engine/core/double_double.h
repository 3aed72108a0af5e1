/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers of about 106 bits as unevaluated sums of two doubles (Dekker 1971, and Hida, Li and Bailey 2001), for sums
   that are as small as 1e-12 times their terms. Exact products use Dekker's splitting, because the machine may lack a
   fused multiply-add. */
#ifndef KOKSMA_CORE_DOUBLE_DOUBLE_H
#define KOKSMA_CORE_DOUBLE_DOUBLE_H

typedef struct koksma__dd {
    double hi, lo;
} koksma__dd;

#ifdef __SIZEOF_INT128__ /* compilers for 32-bit processors lack this type */
__extension__ typedef __int128 koksma__int128;
#endif

/* a + b exactly. */
static inline koksma__dd koksma__dd_sum(double a, double b)
{
    const double s = a + b, t = s - a;
    return (koksma__dd){s, (a - (s - t)) + (b - t)};
}

/* a + b exactly, where |a| >= |b|. */
static inline koksma__dd koksma__dd_quick_sum(double a, double b)
{
    const double s = a + b;
    return (koksma__dd){s, b - (s - a)};
}

/* Returns the exact product a b; |a| and |b| must be below 2^900 to prevent overflow. */
static inline koksma__dd koksma__dd_product(double a, double b)
{
    const double p = a * b, sa = a * 134217729.0, sb = b * 134217729.0;
    const double ah = sa - (sa - a), al = a - ah, bh = sb - (sb - b), bl = b - bh;
    return (koksma__dd){p, ((ah * bh - p) + ah * bl + al * bh) + al * bl};
}

static inline koksma__dd koksma__dd_add(koksma__dd a, koksma__dd b)
{
    const koksma__dd s = koksma__dd_sum(a.hi, b.hi), t = koksma__dd_sum(a.lo, b.lo);
    const koksma__dd v = koksma__dd_quick_sum(s.hi, s.lo + t.hi);
    return koksma__dd_quick_sum(v.hi, v.lo + t.lo);
}

static inline koksma__dd koksma__dd_mul(koksma__dd a, koksma__dd b)
{
    const koksma__dd p = koksma__dd_product(a.hi, b.hi);
    return koksma__dd_quick_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

static inline koksma__dd koksma__dd_scale(koksma__dd a, double b)
{
    const koksma__dd p = koksma__dd_product(a.hi, b);
    return koksma__dd_quick_sum(p.hi, p.lo + a.lo * b);
}

/* Returns a / b with a relative error of about 1e-31. */
static inline koksma__dd koksma__dd_divide(koksma__dd a, double b)
{
    const double q = a.hi / b;
    const koksma__dd p = koksma__dd_product(q, b);
    const koksma__dd rest = koksma__dd_add(a, (koksma__dd){-p.hi, -p.lo});
    return koksma__dd_quick_sum(q, rest.hi / b);
}

#ifdef __SIZEOF_INT128__
static inline koksma__dd koksma__dd_of_int(koksma__int128 v)
{
    const double hi = (double)v;
    return (koksma__dd){hi, (double)(v - (koksma__int128)hi)};
}
#endif

#endif
