//! The clock, read at the door only, and how times are written.

use jiff::Timestamp;

/// Milliseconds since 1970, by the clock of this computer.
pub fn now_ms() -> i64 {
    Timestamp::now().as_millisecond()
}

/// Milliseconds since 1970 as RFC 3339 in UTC; the nearest year from -9999 to 9999 for times beyond.
pub fn rfc3339(milliseconds: i64) -> String {
    let nearest = if milliseconds < 0 { Timestamp::MIN } else { Timestamp::MAX };
    Timestamp::from_millisecond(milliseconds).unwrap_or(nearest).to_string()
}

/// Milliseconds since 1970 of an RFC 3339 time, if it is one.
pub fn milliseconds(rfc3339: &str) -> Option<i64> {
    rfc3339.parse::<Timestamp>().ok().map(Timestamp::as_millisecond)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_written_in_utc_and_read_with_any_offset() {
        assert_eq!(rfc3339(0), "1970-01-01T00:00:00Z");
        assert_eq!(rfc3339(1_500), "1970-01-01T00:00:01.5Z");
        assert_eq!(milliseconds("1970-01-01T01:00:01.5+01:00"), Some(1_500));
        assert_eq!(milliseconds("yesterday"), None);
        assert!(rfc3339(i64::MAX).starts_with("9999-12-3"));
        assert!(rfc3339(i64::MIN).starts_with("-009999-"));
    }
}
