//! Arithmetic of integers of a few words of 64 bits, the least significant first: plain loops, because numbers of 256
//! bits are used in unoptimised builds of the macro.

/// Words of a mantissa.
pub const MANTISSA: usize = 4;
/// Words of a mantissa that was raised by up to 512 digits.
pub const RAISED: usize = 12;

/// The digits from one on, as many as a mantissa has; zeros beyond both ends.
pub fn window(digits: &[u64], from: i64) -> [u64; MANTISSA] {
    let (whole, part) = (from.div_euclid(64), from.rem_euclid(64) as u32);
    let at = |k: i64| if k >= 0 && (k as usize) < digits.len() { digits[k as usize] } else { 0 };
    let (mut window, mut k) = ([0; MANTISSA], 0);
    while k < MANTISSA {
        let place = whole + k as i64;
        window[k] = at(place) >> part;
        if part > 0 {
            window[k] |= at(place + 1) << (64 - part);
        }
        k += 1;
    }
    window
}

/// One digit.
pub const fn bit(digits: &[u64], place: i64) -> bool {
    digits[(place / 64) as usize] >> (place % 64) & 1 == 1
}

/// Adds one; whether that goes beyond its words.
pub fn increment(mantissa: &mut [u64; MANTISSA]) -> bool {
    for word in mantissa {
        *word = word.wrapping_add(1);
        if *word != 0 {
            return false;
        }
    }
    true
}

/// m·2ⁿ of n up to 512.
pub fn raised(mantissa: [u64; MANTISSA], by: usize) -> [u64; RAISED] {
    let (whole, part) = (by / 64, by % 64);
    let (mut digits, mut k) = ([0; RAISED], 0);
    while k < MANTISSA {
        digits[whole + k] |= mantissa[k] << part;
        if part > 0 {
            digits[whole + k + 1] = mantissa[k] >> (64 - part);
        }
        k += 1;
    }
    digits
}

/// Adds a mantissa to `digits`, which have a word to spare or are raised so far that both do not overlap.
pub fn add(digits: &mut [u64; RAISED], mantissa: [u64; MANTISSA]) {
    let (mut carry, mut k) = (false, 0);
    while k < MANTISSA || carry && k < RAISED {
        let other = if k < MANTISSA { mantissa[k] } else { 0 };
        let (sum, first) = digits[k].overflowing_add(other);
        let (sum, second) = sum.overflowing_add(carry as u64);
        (digits[k], carry) = (sum, first || second);
        k += 1;
    }
}

/// Replaces `digits` by |`digits` − `mantissa`|. True where the mantissa is larger, so that the caller turns the sign.
pub fn subtract(digits: &mut [u64; RAISED], mantissa: [u64; MANTISSA]) -> bool {
    let (mut borrow, mut k) = (false, 0);
    while k < MANTISSA || borrow && k < RAISED {
        let other = if k < MANTISSA { mantissa[k] } else { 0 };
        let (rest, first) = digits[k].overflowing_sub(other);
        let (rest, second) = rest.overflowing_sub(borrow as u64);
        (digits[k], borrow) = (rest, first || second);
        k += 1;
    }
    if borrow {
        // −n is the complement and one.
        let (mut carry, mut k) = (true, 0);
        while k < RAISED {
            (digits[k], carry) = (!digits[k]).overflowing_add(carry as u64);
            k += 1;
        }
    }
    borrow
}

/// The product of two mantissas.
pub fn product(a: [u64; MANTISSA], b: [u64; MANTISSA]) -> [u64; 2 * MANTISSA] {
    let (mut digits, mut i) = ([0; 2 * MANTISSA], 0);
    while i < MANTISSA {
        let (mut carry, mut j) = (0, 0);
        // Of what has few digits most words are zero.
        while a[i] != 0 && j < MANTISSA {
            let sum = a[i] as u128 * b[j] as u128 + digits[i + j] as u128 + carry as u128;
            digits[i + j] = sum as u64;
            carry = (sum >> 64) as u64;
            j += 1;
        }
        digits[i + MANTISSA] = carry;
        i += 1;
    }
    digits
}

/// The quotient by one word, without what is left.
pub fn quotient(mut digits: [u64; RAISED], divisor: u64) -> [u64; RAISED] {
    let (mut rest, mut k) = (0, RAISED);
    while k > 0 {
        k -= 1;
        if digits[k] == 0 && rest == 0 {
            continue;
        }
        let part = (rest as u128) << 64 | digits[k] as u128;
        digits[k] = (part / divisor as u128) as u64;
        rest = (part % divisor as u128) as u64;
    }
    digits
}
