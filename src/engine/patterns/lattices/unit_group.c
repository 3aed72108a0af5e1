/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Generators of the group of units modulo m. Modulo a power of an odd prime p the units are the powers of a primitive
 * root g of p with g^(p-1) not 1 modulo p^2 (if it is 1, then g + p is taken). Modulo 2^e the units are +-5^x. For a
 * product of such prime powers q, the generator for each q is chosen such that it is 1 modulo the other factors
 * (Chinese remainder theorem). If 4 divides m, identifying u and -u removes the axis of the signs modulo 2^e (the
 * factor of order 2 that -1 generates); otherwise it halves the longest axis. Source: textbooks on number theory,
 * such as Hardy & Wright.
 */
#include "patterns/lattices/lattices.h"

static uint64_t power(uint64_t base, uint64_t exponent, uint64_t m)
{
    uint64_t result = 1 % m;
    for (base %= m; exponent; exponent /= 2) {
        result = exponent % 2 ? result * base % m : result;
        base = base * base % m;
    }
    return result;
}

int koksma__primes_of(uint64_t n, uint64_t primes[KOKSMA__MAX_PRIMES])
{
    int count = 0;
    for (uint64_t p = 2; n > 1; p += p == 2 ? 1 : 2) {
        if (p * p > n) {
            p = n;
        }
        if (n % p == 0) {
            primes[count++] = p;
            while (n % p == 0) {
                n /= p;
            }
        }
    }
    return count;
}

static uint64_t primitive_root(uint64_t p, bool squared)
{
    uint64_t primes[KOKSMA__MAX_PRIMES];
    const int count = koksma__primes_of(p - 1, primes);
    uint64_t root = 1;
    bool found = false;
    while (!found) {
        found = ++root % p != 0;
        for (int i = 0; i < count; i++) {
            found = found && power(root, (p - 1) / primes[i], p) != 1;
        }
    }
    return squared && power(root, p - 1, p * p) == 1 ? root + p : root;
}

/* Returns the number below m that is g modulo q and 1 modulo m / q, where q is a power of the prime p. */
static uint64_t lift(uint64_t g, uint64_t p, uint64_t q, uint64_t m)
{
    const uint64_t others = m / q, inverse = power(others, q / p * (p - 1) - 1, q);
    return 1 + others * ((g - 1) % q * inverse % q);
}

int koksma__unit_axes(uint64_t m, koksma__unit_axis axes[KOKSMA__MAX_PRIMES], bool *cut)
{
    uint64_t primes[KOKSMA__MAX_PRIMES];
    const int n_primes = koksma__primes_of(m, primes);
    int count = 0, longest = 0;
    for (int i = 0; i < n_primes; i++) {
        const uint64_t p = primes[i];
        uint64_t q = p;
        while (m % (q * p) == 0) {
            q *= p;
        }
        if (p > 2) {
            axes[count++] = (koksma__unit_axis){q / p * (p - 1), lift(primitive_root(p, q > p), p, q, m), true};
        } else if (q > 4) {
            axes[count++] = (koksma__unit_axis){q / 4, lift(5, 2, q, m), false};
        }
    }
    *cut = m % 4 != 0;
    for (int i = 1; i < count; i++) {
        longest = axes[i].length > axes[longest].length ? i : longest;
    }
    if (count) {
        const koksma__unit_axis first = axes[longest];
        axes[longest] = axes[0];
        axes[0] = first;
        axes[0].length /= *cut ? 2 : 1;
    }
    return count;
}
