//! The double nearest to a whole number divided by a power of ten.

/// The double nearest to `number / 10^power`, of two the even one; none where that takes more than one multiplication.
#[inline]
pub(super) fn nearest(number: u64, power: usize) -> Option<f64> {
    let reciprocal = RECIPROCALS.get(power)?;
    if number == 0 {
        return Some(0.0);
    }
    let zeros = number.leading_zeros();
    let product = u128::from(number << zeros) * u128::from(reciprocal.significand);
    // The product is too small by less than 2^64, and by less than 3 * 2^64 with what is cut off here. Where what is
    // above and what is below round to the same double, so does the quotient. Both have 62 or 63 bits.
    let below = (product >> 65) as i64;
    let above = below + 2;
    let value = below as f64;
    let is_sure = value.to_bits() == (above as f64).to_bits();
    let exponent = reciprocal.exponent - i64::from(zeros) + 65;
    is_sure.then(|| value * power_of_two(exponent))
}

/// `10^-power` is `significand * 2^exponent`, or more by less than `2^exponent`.
#[derive(Clone, Copy, Debug)]
struct Reciprocal {
    /// At least 2^63.
    significand: u64,
    exponent: i64,
}

/// Those of the powers of ten whose powers of five fit into 64 bits.
const RECIPROCALS: [Reciprocal; 28] = {
    let mut reciprocals = [Reciprocal { significand: 1 << 63, exponent: -63 }; 28];
    let mut five: u128 = 1;
    let mut power = 1;
    while power < reciprocals.len() {
        five *= 5;
        let shift = 63 + five.ilog2() + 1;
        reciprocals[power] = Reciprocal {
            significand: ((1 << shift) / five) as u64,
            exponent: -(shift as i64) - power.cast_signed() as i64,
        };
        power += 1;
    }
    reciprocals
};

/// 2 to the power of an exponent from -1022 to 1023.
#[inline]
fn power_of_two(exponent: i64) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}
