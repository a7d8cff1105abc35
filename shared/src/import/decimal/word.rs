//! Eight digits at a time in a word of 64 bits, the first digit lowest.

/// How many bytes a word has.
pub(super) const WORD: usize = 8;

/// The eight bytes of `text` from `at` on, which must be there: no digits where they are not.
#[inline]
pub(super) fn eight<const LENGTH: usize>(text: &[u8; LENGTH], at: usize) -> [u8; WORD] {
    // A copy of a slice is one load; eight bytes taken one by one are eight in WebAssembly.
    text.get(at..).and_then(<[u8]>::first_chunk).copied().unwrap_or_default()
}

/// The values of eight bytes of text as digits, a byte each; what is more than nine is no digit.
#[inline]
pub(super) fn digits(bytes: [u8; WORD]) -> u64 {
    u64::from_le_bytes(bytes) ^ u64::from_le_bytes([b'0'; WORD])
}

/// How many digits there are before the first byte that is none.
#[inline]
pub(super) fn count(digits: u64) -> usize {
    const HIGHEST: u64 = u64::from_le_bytes([0x80; WORD]);
    const TO_HIGHEST: u64 = u64::from_le_bytes([0x80 - 10; WORD]);
    // What overflows into a next byte comes from one that is no digit.
    let beyond_nine = (digits.wrapping_add(TO_HIGHEST) | digits) & HIGHEST;
    (beyond_nine.trailing_zeros() / 8) as usize
}

/// The first `count` digits, fewer than eight, and nothing behind them.
#[inline]
pub(super) fn first(digits: u64, count: usize) -> u64 {
    digits & ((1 << (8 * count)) - 1)
}

/// The number that the first `count` digits make, up to eight of them; that of none is 0.
#[inline]
pub(super) fn number(digits: u64, count: usize) -> u64 {
    // As if there were as many zeros before them as make a word. Then pairs of digits become numbers, then pairs of these.
    let ones = digits.checked_shl(8 * (WORD - count) as u32).unwrap_or(0);
    let pairs = (ones * 10 + (ones >> 8)) & 0x00ff_00ff_00ff_00ff;
    let fours = (pairs * 100 + (pairs >> 16)) & 0x0000_ffff_0000_ffff;
    (fours * 10_000 + (fours >> 32)) & 0xffff_ffff
}
