/* Numbers as text: the fewest of 15, 16 or 17 digits that read back. */
#include "base/base.h"

#include <math.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide;

/* d d d ... times 10^ten, a point behind the first one; n digits of %.*g asked for `asked`. */
typedef struct {
    uint64_t digits;
    int n, asked, ten;
} decimal;

static const uint64_t powers_of_five[] = {1,
                                          5,
                                          25,
                                          125,
                                          625,
                                          3125,
                                          15625,
                                          78125,
                                          390625,
                                          1953125,
                                          9765625,
                                          48828125,
                                          244140625,
                                          1220703125,
                                          6103515625,
                                          30517578125,
                                          152587890625,
                                          762939453125,
                                          3814697265625,
                                          19073486328125,
                                          95367431640625,
                                          476837158203125,
                                          2384185791015625,
                                          11920928955078125,
                                          59604644775390625,
                                          298023223876953125,
                                          1490116119384765625,
                                          7450580596923828125};
enum { POWERS_OF_FIVE = sizeof powers_of_five / sizeof *powers_of_five };

/* m 5^k, and 5^k, in the unit 2^(64 * limbs): without a limb they are exact, with one each is
 * less than 1 below its value. */
static void times_power_of_five(uint64_t m, int k, int limbs, wide *product, wide *five)
{
    const wide first = powers_of_five[limbs ? POWERS_OF_FIVE - 1 : k];
    const wide second = powers_of_five[limbs ? k - POWERS_OF_FIVE + 1 : 0];
    const wide p = (wide)m * first;

    *product = limbs ? (p >> 64) * second + ((wide)(uint64_t)p * second >> 64) : p;
    *five = limbs ? first * second >> 64 : first;
}

static wide distance(wide a, wide b)
{
    return a > b ? a - b : b - a;
}

/* Of x = m 2^e > 0, in integers: x 10^k = m 5^k 2^-s with k such that 17 digits are before the
 * point, so that each rounding and the distance from x are known exactly, or of small numbers to
 * 1 of 2^64 parts.  0: these integers are too large, the number below x is nearer than the one
 * above, or such a part decides. */
static int decimal_of(double x, decimal *d)
{
    enum { FRACTION = 52, LEAST = 1075, MOST_DIGITS = 17, LIMB = 64 };
    static const uint64_t most = UINT64_C(100000000000000000);
    uint64_t bits;

    memcpy(&bits, &x, sizeof bits);
    const uint64_t one = UINT64_C(1) << FRACTION, m = (bits & (one - 1)) | one;
    const int e = (int)(bits >> FRACTION) - LEAST;
    if (m == one || e < -LEAST || e > 0)
        return 0;
    /* floor(log10(2^(e + 52))), or one more where m is larger */
    for (int ten = (int)floor((e + FRACTION) * 0.30102999566398120), again = 0; again < 2;
         again++, ten++) {
        const int k = MOST_DIGITS - 1 - ten, limbs = k >= POWERS_OF_FIVE;
        const int s = -(e + k) - limbs * LIMB;
        if (k < 0 || k > 2 * (POWERS_OF_FIVE - 1) || s < 1)
            return 0;
        wide exact, five;
        times_power_of_five(m, k, limbs, &exact, &five);
        const uint64_t whole = (uint64_t)(exact >> s);
        if (whole >= most)
            continue;
        for (uint64_t unit = 100; unit > 0; unit /= 10) {
            uint64_t q = whole / unit;
            const wide below = exact - ((wide)(q * unit) << s), half = ((wide)unit << s) >> 1;
            const int rises = below > half || (below == half && (q & 1));
            const wide off = rises ? ((wide)unit << s) - below : below;
            if (limbs && (distance(below, half) <= 1 || distance(2 * off, five) <= 3))
                return 0;
            /* it reads back within half of the distance to the next number, at just that if m is
             * even; 17 digits always do */
            if (unit > 1 && !(2 * off < five || (2 * off == five && !(m & 1))))
                continue;
            q += (uint64_t)rises;
            *d = (decimal){q, MOST_DIGITS - (unit > 1) - (unit > 10), 0, ten};
            d->asked = d->n;
            if (q * unit == most) {
                d->digits /= 10;
                d->ten++;
            }
            return 1;
        }
    }
    return 0;
}

/* As %.*g of as many digits as were asked for. */
static void write_decimal(decimal d, char *text)
{
    char digit[20];

    for (int i = d.n - 1; i >= 0; i--, d.digits /= 10)
        digit[i] = (char)('0' + d.digits % 10);
    while (d.n > 1 && digit[d.n - 1] == '0')
        d.n--;
    const int by_power = d.ten < -4 || d.ten >= d.asked, point = by_power ? 0 : d.ten;
    if (point < 0) {
        memcpy(text, "0.0000", 6);
        text += 1 - point;
        memcpy(text, digit, (size_t)d.n);
        text += d.n;
    } else {
        for (int i = 0; i < d.n || i <= point; i++) {
            if (i == point + 1)
                *text++ = '.';
            *text++ = i < d.n ? digit[i] : '0';
        }
    }
    if (by_power) {
        const int power = d.ten < 0 ? -d.ten : d.ten; /* below 100 */
        *text++ = 'e';
        *text++ = d.ten < 0 ? '-' : '+';
        *text++ = (char)('0' + power / 10);
        *text++ = (char)('0' + power % 10);
    }
    *text = '\0';
}

char *rb_number_text(double x, char text[RB_NUMBER_TEXT])
{
    decimal d;

    if (x == 0.0)
        return strcpy(text, signbit(x) ? "-0" : "0");
    if (isfinite(x) && decimal_of(fabs(x), &d)) {
        *text = '-';
        write_decimal(d, text + (x < 0.0));
        return text;
    }
    /* a decimal of 15 digits or fewer survives the way to binary and back, and %g drops
     * zeros, so that the first of these three that reads back is the shortest */
    for (int digits = 15; digits <= 17; digits++) {
        rb_format(text, RB_NUMBER_TEXT, "%.*g", digits, x);
        if (rb_read_number(text, NULL) == x)
            break;
    }
    return text;
}
